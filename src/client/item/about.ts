/**
 * The one place that says in front of a message which item it is about: `v17 (D99999999): ...`.
 *
 * What goes wrong with one item of many names it by the name the user gave it and by its address. What is about the
 * connection, and so about all items alike, names none.
 */
import { type EndCodeAbout, EndCodeError, type PlcError, RequestError } from '../../errors'

/** An item as messages call it. */
export interface Subject {
  readonly item: string
  /** What the user calls it; missing, or the item itself: it has no name of its own. */
  readonly name?: string | undefined
}

interface Headed {
  readonly bare: PlcError
  readonly head: string
  /** The likely ones first. */
  readonly subjects: readonly Subject[]
}

/** Errors that were made here, so that a name can take the place of an address alone. */
const HEADED = new WeakMap<PlcError, Headed>()
/** Items of one request that are named; the others are counted. */
const MOST_NAMED = 8
/** Characters of a name or an address. */
const LONGEST = 64

function called({ item, name = item }: Subject): string {
  return name === item ? shortened(item) : `${shortened(name)} (${shortened(item)})`
}

function shortened(text: string): string {
  return text.length <= LONGEST ? text : `${text.slice(0, LONGEST)}...`
}

/** Of several items that went out together nobody knows which the PLC refuses. */
function headOf(subjects: readonly Subject[]): string {
  const names = subjects.slice(0, MOST_NAMED).map(called).join(', ')
  if (subjects.length <= 1) return names
  const others = subjects.length - MOST_NAMED
  const all = others > 0 ? `${names} and ${others} more` : names
  return `${all}, written together (the PLC does not say which it refuses)`
}

/** The same error with the items in front of its message, unless they stand there already. */
export function about<E extends PlcError>(error: E, subjects: readonly Subject[]): E {
  const bare = (HEADED.get(error)?.bare as E | undefined) ?? error
  const head = headOf(subjects)
  const message = headed(bare.message, head, subjects)
  if (message === error.message) return error
  const copy = withMessage(bare, message)
  HEADED.set(copy, { bare, head, subjects })
  return copy
}

/** What stands in front of the message of an error, e.g. `v17 (D100)`; for the same message in another language. */
export function headOfError(error: PlcError): string | undefined {
  return HEADED.get(error)?.head
}

function headed(message: string, head: string, subjects: readonly Subject[]): string {
  const [only] = subjects
  const rest = subjects.length === 1 && only !== undefined ? behind(message, only.item) : undefined
  return rest === undefined ? `${head}: ${message}` : `${head}${rest}`
}

/** What follows the item where a message begins with it, as a text or in quotes. */
function behind(message: string, item: string): string | undefined {
  const start = [JSON.stringify(item), JSON.stringify(item.trim()), item].find(
    (text) => text !== '' && message.startsWith(text) && !/^[\p{L}\p{N}_]/u.test(message.slice(text.length)),
  )
  return start === undefined ? undefined : message.slice(start.length)
}

/** A copy with everything the error has but its message. It is an `Error` of the platform, so it can be cloned as one. */
function withMessage<E extends PlcError>(error: E, message: string): E {
  const own = Object.getOwnPropertyDescriptors(error)
  const copy: E = Object.setPrototypeOf(new Error(message), Object.getPrototypeOf(error))
  for (const key of Reflect.ownKeys(own)) {
    const descriptor = Object.getOwnPropertyDescriptor(error, key)
    if (key !== 'message' && key !== 'stack' && descriptor !== undefined) Object.defineProperty(copy, key, descriptor)
  }
  const stack = error.stack?.replace(error.message, () => message)
  Object.defineProperty(copy, 'stack', { value: stack, writable: true, configurable: true })
  return copy
}

/** Whether the error is about its item, and not about the connection or the whole call. */
function isAbout(error: PlcError, item: string): boolean {
  return HEADED.has(error) || error instanceof RequestError || behind(error.message, item) !== undefined
}

/** What every request meets alike, whatever it asks for. */
const MEETS_ALL: ReadonlySet<EndCodeAbout> = new Set(['state', 'transmission'])

/** Whether a refusal says nothing about the items: the PLC is locked, busy, in RUN, or the request arrived damaged. */
export function isAboutNoItem({ about: blamed }: EndCodeError): boolean {
  return MEETS_ALL.has(blamed)
}

/** The result of an item that may have failed. */
export interface ItemResult {
  /** The item as it was given. */
  readonly item: string
  /** Whether it worked. */
  readonly ok: boolean
  /** Why not. */
  readonly error?: PlcError
}

/**
 * Results whose errors call the items by their names: `v17 (D99999999): ...`. An error that several items share, because
 * they went out in one request, names them all.
 * @example nameResults(await plan.run(), ['level', 'v17'])
 */
export function nameResults<R extends ItemResult>(results: readonly R[], names: readonly string[]): R[] {
  const subjects = new Map<PlcError, Subject[]>()
  results.forEach(({ item, error }, index) => {
    if (error === undefined || !isAbout(error, item)) return
    const shared = subjects.get(error) ?? []
    subjects.set(error, [...shared, { item, name: names[index] }])
  })
  const named = new Map(
    [...subjects].map(([error, shared]) => [
      error,
      isShared(error, shared) ? error : about(error, likelyFirst(error, shared)),
    ]),
  )
  return results.map((result) => {
    const error = result.error === undefined ? undefined : named.get(result.error)
    return error === undefined || error === result.error ? result : { ...result, error }
  })
}

/** In the order of the error, where it has one. */
function likelyFirst(error: PlcError, subjects: readonly Subject[]): readonly Subject[] {
  const order = HEADED.get(error)?.subjects.map(({ item }) => item) ?? []
  return [...subjects].sort((a, b) => order.indexOf(a.item) - order.indexOf(b.item))
}

/** An error of several items that is about none of them, e.g. that writing is not permitted. */
function isShared(error: PlcError, subjects: readonly Subject[]): boolean {
  return subjects.length > 1 && !(error instanceof EndCodeError)
}
