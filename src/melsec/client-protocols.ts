// The protocol of each frame.
import { protocolOver1e } from './a-compatible/slmp-over-1e'
import type { ClientProtocol, ProtocolOptions } from './client-protocol'
import type { FrameName, SlmpFrameName } from './frame/frames'
import { clientProtocolOver1c } from './one-c/slmp-over-1c'
import { serialProtocol } from './serial-protocol'
import { slmpProtocol } from './slmp-protocol'

const protocols: Readonly<Record<FrameName, (options: ProtocolOptions) => ClientProtocol>> = {
  '3E': slmpIn('3E'),
  '4E': slmpIn('4E'),
  ext: slmpIn('ext'),
  '1E': protocolOver1e,
  '1C': clientProtocolOver1c,
  '3C': (options) => serialProtocol({ ...options, frame: '3C' }),
  '4C': (options) => serialProtocol({ ...options, frame: '4C' }),
}

function slmpIn(frame: SlmpFrameName): (options: ProtocolOptions) => ClientProtocol {
  return (options) => slmpProtocol({ ...options, frame })
}

/** @throws RequestError BAD_OPTION when the PLC does not take the frame, or not with this route or data code */
export function clientProtocolOf(options: ProtocolOptions): ClientProtocol {
  return protocols[options.frame](options)
}
