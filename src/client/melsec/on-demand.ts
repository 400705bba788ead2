// What a PLC sends unasked: On-demand, and whatever else comes in the form of a request.
import { ProtocolError, RequestError } from '../../errors'
import type { ClientProtocol, UnaskedFrame } from '../../melsec/client-protocol'
import { wordsOfBytes } from '../../melsec/commands/on-demand'
import { frameFacts } from '../../melsec/frame/frames'
import type { OnDemand, UnsolicitedFrame } from './client-events'
import type { MelsecClientOptions } from './options'
import type { Settings } from './settings'

/** A frame that came unasked: the frame itself, and its data when it is On-demand that can be read. */
export interface Unsolicited {
  readonly frame: UnsolicitedFrame
  readonly onDemand: OnDemand | undefined
}

/** @param timestamp milliseconds since 1970 */
export function unsolicitedOf({ route, data }: UnaskedFrame, body: Buffer, timestamp: number): Unsolicited {
  // A copy: the bytes of the chunk are somebody else's as soon as this returns.
  const frame: UnsolicitedFrame = { route, body: Buffer.from(body), timestamp }
  if (data instanceof ProtocolError) return { frame: { ...frame, error: data }, onDemand: undefined }
  return { frame, onDemand: { route, data, words: wordsOfBytes(data), timestamp } }
}

/**
 * Nobody who listens may wait in vain for what can never come.
 * @throws RequestError UNSUPPORTED with 1E, BAD_OPTION over UDP without a port that the PLC can know
 */
export function checkOnDemand(
  { readUnasked }: ClientProtocol,
  { frame, transport }: Settings,
  { localPort, openTransport }: Pick<MelsecClientOptions, 'localPort' | 'openTransport'>,
): void {
  if (readUnasked === undefined) {
    const message = `The ${frameFacts[frame].title} frame has no On-demand: use 3E or 4E, if the PLC has them.`
    throw new RequestError('UNSUPPORTED', message, 'frame')
  }
  if (transport !== 'udp' || (localPort ?? 0) > 0 || openTransport !== undefined) return
  const message =
    'On-demand over UDP needs localPort: the PLC sends to the port in its open settings, and without localPort this client ' +
    'has another one each time (with the 3E frame after every answer). Set it as in the PLC, or use TCP.'
  throw new RequestError('BAD_OPTION', message, 'localPort')
}
