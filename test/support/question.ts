import { type BodyLength, type Framing, framed, type Head, type Question } from '../../src/link/link'

/** Any body in any frame, past every protocol. */
export function questionOf<H extends Head>(
  framing: Framing<H>,
  head: H,
  body: Buffer,
  responseLength: BodyLength = () => undefined,
): Question {
  return { responseLength, ...framed({ framing, head }, { body, responseLength }) }
}
