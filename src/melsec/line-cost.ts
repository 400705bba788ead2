// What requests cost where every byte takes time: on a serial line.
import { answerBytes, type Envelope, type Head } from '../link/link'

/** What a request costs beside the bytes of its bodies, in bytes on the line. */
export interface LineCost {
  /** One that is answered with data. */
  readonly read: number
  /** One that is answered without. */
  readonly write: number
}

const NO_BODY = new Uint8Array()

/**
 * The bytes around the bodies, and the turn-round of the line; `undefined` where a request costs the same whatever it carries.
 * What a frame adds for what stands in a body (a second DLE in format 5) is not known before the answer, and not counted.
 *
 * @param turnRound time from the end of a request to its answer and from there to the next request, as bytes at the bit rate
 */
export function lineCostOf<H extends Head>(envelope: Envelope<H>, turnRound = 0): LineCost | undefined {
  const { framing, head } = envelope
  if (framing.recovery === undefined) return undefined
  const request = framing.request.write(head, 0, NO_BODY).length + turnRound
  return { read: request + answerBytes(envelope, 1) - 1, write: request + answerBytes(envelope, 0) }
}
