// What a PLC sends unasked: On-demand, and whatever else comes in the form of a request.
import { ProtocolError, RequestError } from '../../errors'
import type { RequestFrame } from '../../link/link'
import { wordsOfBytes } from '../../melsec/commands/on-demand'
import { bodies } from '../../melsec/frame/body'
import type { Head3e } from '../../melsec/frame/slmp-frame'
import { readOnDemand } from '../../melsec/on-demand'
import type { OnDemand, UnsolicitedFrame } from './client-events'
import type { MelsecClientOptions, Settings } from './options'

/** A frame that came unasked: the frame itself, and its data when it is On-demand that can be read. */
export interface Unsolicited {
  readonly frame: UnsolicitedFrame
  readonly onDemand: OnDemand | undefined
}

/** @param timestamp milliseconds since 1970 */
export function unsolicitedOf(
  { head, body }: RequestFrame<Head3e>,
  { frame: name, code }: Pick<Settings, 'frame' | 'code'>,
  timestamp: number,
): Unsolicited {
  const { route } = head
  // A copy: the bytes of the chunk are somebody else's as soon as this returns.
  const frame: UnsolicitedFrame = { route, body: Buffer.from(body), timestamp }
  try {
    // A 1E frame never comes unasked.
    const { reserved } = bodies[name === '1E' ? '3E' : name]
    const data = Buffer.from(readOnDemand(code, body, reserved))
    return { frame, onDemand: { route, data, words: wordsOfBytes(data), timestamp } }
  } catch (error) {
    if (!(error instanceof ProtocolError)) throw error
    return { frame: { ...frame, error }, onDemand: undefined }
  }
}

/**
 * Nobody who listens may wait in vain for what can never come.
 * @throws RequestError UNSUPPORTED with 1E, BAD_OPTION over UDP without a port that the PLC can know
 */
export function checkOnDemand(
  { frame, transport }: Settings,
  { localPort, openTransport }: Pick<MelsecClientOptions, 'localPort' | 'openTransport'>,
): void {
  if (frame === '1E') {
    throw new RequestError('UNSUPPORTED', 'The 1E frame has no On-demand: use 3E or 4E, if the PLC has them.', 'frame')
  }
  if (transport === 'tcp' || (localPort ?? 0) > 0 || openTransport !== undefined) return
  const message =
    'On-demand over UDP needs localPort: the PLC sends to the port in its open settings, and without localPort this client ' +
    'has another one each time (with the 3E frame after every answer). Set it as in the PLC, or use TCP.'
  throw new RequestError('BAD_OPTION', message, 'localPort')
}
