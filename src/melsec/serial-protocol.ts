// The SLMP set as a client speaks it on a serial line: 3C and 4C frames.
import type { ClientProtocol, ProtocolOptions } from './client-protocol'
import { nameOfCommand } from './commands/command-name'
import { slmpExplainer } from './explain/slmp-explainer'
import { type SerialHead, serialRoute } from './frame/serial-frames'
import { serialFraming } from './frame/serial-framing'
import { MelsecProtocol } from './protocol'
import { serialOptionsOf } from './serial-options'

export interface SerialOptions extends ProtocolOptions {
  readonly frame: '3C' | '4C'
}

/**
 * @throws RequestError BAD_OPTION when the frame does not have the format
 */
export function serialProtocol(options: SerialOptions): ClientProtocol {
  const { frame, profile, asciiXy, asciiZr } = options
  const { head, turnRound = 0, ...serial } = serialOptionsOf(options)
  const framing = serialFraming({ ...serial, frame })
  const { code } = framing
  const protocol = new MelsecProtocol<SerialHead>({
    framing,
    head,
    turnRound,
    connectedHead: serialRoute(frame, { station: head.station }),
    ...(head.moduleIo === undefined ? {} : { moduleIo: head.moduleIo }),
    profile,
    code,
    asciiXy,
    asciiZr,
  })
  return {
    framing,
    profile,
    code,
    exchange: (command, message, given) => protocol.exchange(command, message, given),
    check: (command, message) => protocol.check(command, message),
    bodyBytes: (command, message, form) => protocol.bodyBytes(command, message, form),
    answerBytes: (body) => protocol.answerBytes(body),
    lineCost: protocol.lineCost,
    nameOf: nameOfCommand,
    explainer: (shownAs) => slmpExplainer({ ...options, code, framing, messageFormat: serial.format, ...shownAs }),
  }
}
