import type { Effect } from '../codec/codec'
import type { Framing, Head, Question, ResponseFrame } from './framing'

/**
 * One request ready to be sent, and how to read what comes back: what a protocol family hands to the client's shell. What
 * stands in the head of its frame is its own business.
 */
export interface Exchange<T> extends Question {
  /** Manual's name of the command, for messages and traces. */
  readonly title: string
  readonly effect: Effect
  /** The message the body says. */
  readonly message: Readonly<Record<string, unknown>>
  readonly body: Buffer
  /** `false`: the PLC does not answer when it succeeds (Remote Reset). */
  readonly answered: boolean
  /** Bytes of the body of an answer that takes the request; `undefined` when only the answer tells. */
  answerBody(): number | undefined
  /** Bytes of the frame of such an answer; `undefined` when only the answer tells. */
  answerSize(): number | undefined
  /** @throws EndCodeError when the PLC refused, ProtocolError when the answer cannot be one to this request. */
  decode(frame: ResponseFrame): T
}

const NOTHING = Buffer.alloc(0)
const CHARACTER = '0'

/** What stands around a body. */
export interface Envelope<H extends Head> {
  readonly framing: Framing<H>
  readonly head: H
}

/** What of an exchange depends on its frame. */
export type OfFrame = 'write' | 'mismatch' | 'answerBody' | 'answerSize'

/** What depends on the frame of an exchange. Without a serial number the frame is always the same, so it is written once. */
export function framed<H extends Head>(
  { framing, head }: Envelope<H>,
  { body, responseLength }: Pick<Exchange<unknown>, 'body' | 'responseLength'>,
): Pick<Exchange<unknown>, OfFrame> {
  let always: Buffer | undefined
  const answerBody = () => responseLength(head, NOTHING)
  let size: number | undefined
  const isSerial = framing.correlation === 'serial'
  return {
    write(serial) {
      if (isSerial) return framing.request.write(head, serial, body)
      always ??= framing.request.write(head, serial, body)
      return always
    },
    mismatch: (answered) => framing.mismatch(head, answered),
    answerBody,
    answerSize() {
      const length = size === undefined ? answerBody() : undefined
      if (length !== undefined) size = answerBytes({ framing, head }, length)
      return size
    },
  }
}

/** Bytes of the frame of an answer that takes the request, with a body of so many: characters, which every frame carries as they are. */
export function answerBytes<H extends Head>({ framing, head }: Envelope<H>, body: number): number {
  return framing.response.write(head, 0, 0, Buffer.alloc(body, CHARACTER)).length
}
