// What a count refers to: the one rule that writing, reading and measuring share.
import type { Count, Field, Message, Shape } from './field'

/** The request a response answers: `echo`, `each` and counts refer to it. */
export interface Context {
  readonly shape: Shape
  readonly message: Message
}

/** @throws TypeError: it is a mistake of the caller's code, not of a message or of the peer. */
export function asked(context: Context | undefined): Context {
  if (context === undefined) throw new TypeError('A response is encoded and decoded with the request it answers')
  return context
}

/** The elements of the request's list `of`, each with its shape: what stands for one of them in an answer refers to it. */
export function elementsAsked(of: string, context: Context | undefined): readonly Context[] {
  const { shape, message } = asked(context)
  const list: Field | undefined = shape[of]
  if (list?.kind !== 'list') throw new TypeError(`The request has no list ${of}`)
  return (message[of] as readonly Message[]).map((element) => ({ shape: list.item, message: element }))
}

/** Arrays and typed arrays. A DataView is a view too, but has no elements. */
export function isArrayLike(given: unknown): given is ArrayLike<unknown> {
  return Array.isArray(given) || (ArrayBuffer.isView(given) && 'length' in given)
}

/**
 * The number a count refers to: a number, or the length of what has the name, in this message or else in the request.
 * `own` is the field that is counted: when it has the count's name too, the request's field is meant.
 * `undefined` when neither has it, as for a derived count of the message that is being encoded.
 */
export function countIn(count: Count, own: string, message: Message, context: Context | undefined): number | undefined {
  if (typeof count === 'number') return count
  const here = count === own ? undefined : sizeIn(message[count])
  return here ?? (context === undefined ? undefined : sizeInRequest(count, context))
}

/** As `countIn`, where the count must be known. */
export function countToRead(count: Count, own: string, message: Message, context: Context | undefined): number {
  const found = countIn(count, own, message, context)
  if (found === undefined) throw new TypeError(`Nothing tells the count ${count}`)
  return found
}

export function sizeIn(found: unknown): number | undefined {
  if (typeof found === 'number') return found
  return typeof found === 'string' || isArrayLike(found) ? found.length : undefined
}

function sizeInRequest(name: string, context: Context): number | undefined {
  const field = context.shape[name]
  return sizeIn(context.message[field?.kind === 'count' ? field.of : name])
}
