// What stands at the front of the bytes that a session has received.
import type { AnswerFraming, BodyLength, RequestFrame, ResponseFrame, Scanned } from './framing'

/** `unasked`: an answer that belongs to no request. */
export type Found =
  | { readonly used: number; readonly kind: 'answer'; readonly answer: Scanned<ResponseFrame> }
  | { readonly used: number; readonly kind: 'unsolicited'; readonly frame: RequestFrame }
  | { readonly used: number; readonly kind: 'unasked' }
  /** An answer, if nothing more comes. */
  | { readonly used: 0; readonly kind: 'held' }

/** What the session knows when it looks. */
export interface Known {
  /** An answer may come: a request was sent and has none, or its serial number tells. */
  readonly isAsked: boolean
  readonly responseLength: BodyLength
  /** Nothing more comes for now, or whatever follows does not matter. */
  readonly isAll: boolean
}

const HELD: Found = { used: 0, kind: 'held' }

/** The frame at the front, or `undefined` when it is not complete. @throws ProtocolError when it can be none */
export function findFrame(framing: AnswerFraming, bytes: Buffer, known: Known): Found | undefined {
  if (framing.response.isUnsolicited?.(bytes) === true) {
    const unsolicited = framing.request.scan(bytes, () => undefined)
    return unsolicited && { used: unsolicited.used, kind: 'unsolicited', frame: unsolicited.frame }
  }
  // With nothing asked, an answer without a serial number belongs to nobody; 1E could not even tell where it ends.
  if (!known.isAsked) return { used: bytes.length, kind: 'unasked' }
  const scanned = framing.response.scan(bytes, known.responseLength)
  if (scanned === undefined) return undefined
  // Only silence behind it shows that it is this frame.
  if (scanned.endsWithSilence === true && !known.isAll && scanned.used === bytes.length) return HELD
  return { used: scanned.used, kind: 'answer', answer: scanned }
}

/** Whether the datagram holds what was found and nothing behind it but what may follow. */
export function endsWith(found: Found, datagram: Buffer): boolean {
  const rest = datagram.subarray(found.used)
  if (rest.length === 0 || found.kind !== 'answer') return rest.length === 0
  return found.answer.surplus === true || found.answer.mayFollow?.equals(rest) === true
}
