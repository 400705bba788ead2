import type { EndCodeAbout, EndCodeDetail, EndCodeFamily } from './errors/end-code-kinds'

export {
  type EndCodeAbout,
  type EndCodeDetail,
  type EndCodeFamily,
  endCodeAbouts,
  endCodeFamilies,
} from './errors/end-code-kinds'

/**
 * Every error of this package. One base, a closed `code`, and the one fact every plant needs: `outcome`.
 *
 * - `notSent`: nothing left this program; the PLC did not see the request.
 * - `refused`: the PLC answered that it did not carry it out.
 * - `unknown`: the request may or may not have been carried out. A write with this outcome is never repeated here.
 *
 * The classes are branded with `Symbol.for`, because one Node-RED installation can hold two copies of this package
 * and `instanceof` must work across them.
 */
export type Outcome = 'notSent' | 'refused' | 'unknown'

/** The caller's mistake: found before anything is sent. */
export const REQUEST_CODES = [
  'BAD_ADDRESS', // the text is not an address
  'BAD_TYPE', // the type does not exist, or does not fit the device
  'BAD_VALUE', // the value does not fit the type
  'BAD_OPTION', // an option of the client, simulator or call
  'BAD_MESSAGE', // a message of `request()` does not fit the command's declaration
  'OUT_OF_RANGE', // a number outside what the wire form or the profile can say
  'LIMIT_EXCEEDED', // more points, blocks or bytes than one request may carry
  'UNSUPPORTED', // this profile, frame or code does not have it
  'NOT_PERMITTED', // allowWrites / allowControl is off
] as const
/** What is wrong with what the caller gave. */
export type RequestErrorCode = (typeof REQUEST_CODES)[number]
/** The PLC refused: see `endCode`. */
export type EndCodeErrorCode = 'END_CODE'
/** The peer sent what the protocol does not allow. */
export const PROTOCOL_CODES = [
  'TRUNCATED', // fewer bytes than the declaration needs
  'TRAILING', // bytes left over
  'BAD_DIGIT', // not a digit of the expected radix
  'BAD_FIELD', // a field with a value that cannot be
  'BAD_FRAME', // subheader, length or control code
  'BAD_SUM', // sum check
  'ECHO_MISMATCH', // route, command or another echoed field differs from the request
  'UNEXPECTED_ANSWER', // an answer nobody asked for, where no serial number tells which request it belongs to
] as const
/** What is wrong with what the peer sent. */
export type ProtocolErrorCode = (typeof PROTOCOL_CODES)[number]
/** No answer before the deadline. */
export type TimeoutErrorCode = 'TIMEOUT'
export const CONNECTION_CODES = [
  'CONNECT_FAILED',
  'DISCONNECTED',
  'ENTRY_BUSY', // accepted, then closed at once: all entries of the PLC are taken
  'PORT_UNAVAILABLE', // the local port or serial port is taken
  'SILENT', // connected, but nothing answers
  'OFFLINE', // failing fast while the connection is being restored
] as const
/** What is wrong with the connection. */
export type ConnectionErrorCode = (typeof CONNECTION_CODES)[number]
export const CLOSED_CODES = ['CLOSED', 'ABORTED', 'QUEUE_FULL', 'OVERLOADED'] as const
/**
 * Who ended it on this side: `CLOSED` by `close()`, `ABORTED` by a signal, `QUEUE_FULL` and `OVERLOADED` because more
 * is asked than the PLC answers.
 */
export type ClosedErrorCode = (typeof CLOSED_CODES)[number]
/** Remote control was carried out, but the CPU is not in the state it was to be in. */
export type VerifyErrorCode = 'NOT_VERIFIED'
/** A call of several requests failed when some had changed the PLC already. */
export type UnfinishedErrorCode = 'UNFINISHED'
/** Of a write of many, one or more were not written. */
export type WriteErrorCode = 'NOT_ALL_WRITTEN'
/** Every code of an error of this package. Each belongs to one class. */
export type PlcErrorCode =
  | RequestErrorCode
  | EndCodeErrorCode
  | ProtocolErrorCode
  | TimeoutErrorCode
  | ConnectionErrorCode
  | ClosedErrorCode
  | VerifyErrorCode
  | UnfinishedErrorCode
  | WriteErrorCode

const BRAND = 'melsec-jw.error'

/** Base of every error thrown here. `message` says what, where and what to do. */
abstract class BaseError extends Error {
  /**
   * Name of the class in its brand, written out: a bundler renames classes. Programs may extend the classes; what they
   * extend has no kind of its own and is told apart as any class.
   */
  protected static readonly kind: string = 'PlcError'
  abstract readonly code: string
  abstract readonly outcome: Outcome

  constructor(kind: string, message: string, cause?: unknown) {
    super(message, cause === undefined ? undefined : { cause })
    this.name = kind
    for (const name of ['PlcError', kind]) Object.defineProperty(this, brand(name), { value: true })
  }

  static override [Symbol.hasInstance](value: unknown): boolean {
    // biome-ignore lint/complexity/noThisInStatic: `this` is the class on the right of instanceof, also a subclass.
    if (!Object.hasOwn(this, 'kind')) return Function.prototype[Symbol.hasInstance].call(this, value)
    // biome-ignore lint/complexity/noThisInStatic: see above.
    return typeof value === 'object' && value !== null && brand(this.kind) in value
  }

  /** Plain data, for JSON, workers and other processes: `plcErrorFrom()` makes the error of it again. */
  toJSON(): PlcErrorData {
    return dataOf(this)
  }
}

/** By kind: `instanceof` asks for them again and again. */
const BRANDS = new Map<string, symbol>()

function brand(kind: string): symbol {
  const known = BRANDS.get(kind)
  if (known !== undefined) return known
  const made = Symbol.for(`${BRAND}.${kind}`)
  BRANDS.set(kind, made)
  return made
}

/** Bad address, value, option or message, or not permitted. The connection lives. */
export class RequestError extends BaseError {
  protected static override readonly kind: string = 'RequestError'
  /** Always `notSent`: it is found before anything is sent. */
  readonly outcome = 'notSent'
  constructor(
    /** What is wrong. */
    readonly code: RequestErrorCode,
    message: string,
    /** The item, field or option the message is about, when there is one. */
    readonly field?: string,
  ) {
    super(RequestError.kind, message)
  }
}

/**
 * The PLC answered with an end code other than 0. The connection lives. The outcome is `refused`, or `unknown` for a write
 * or control command whose end code does not say that nothing of it was done.
 */
export class EndCodeError extends BaseError {
  protected static override readonly kind: string = 'EndCodeError'
  /** Always `END_CODE`: see `endCode`. */
  readonly code = 'END_CODE'
  /** `refused`; `unknown` where a write or control command may have been carried out in part. */
  readonly outcome: 'refused' | 'unknown'
  /** Whose number it is: the same one means something else in another family. */
  readonly family: EndCodeFamily
  /** What it is about, as far as it is known. */
  readonly about: EndCodeAbout
  /** `false`: the PLC did nothing of it. Undefined: it may have been carried out, all or in part. */
  readonly carriedOut: false | undefined
  /** Manual's name of the command, e.g. `Read (word units)`. */
  readonly command: string | undefined
  /** Name of the command in its set, e.g. `readWords`. */
  readonly commandName: string | undefined
  /** Station that reported the error, where the frame says so. */
  readonly station: string | undefined
  /** Of a 1E frame with end code 5BH: the code behind it, which says why. */
  readonly abnormalCode: number | undefined
  /**
   * What the code means, in English; `explainEndCode()` has other languages. Undefined for a number nobody has a text
   * for.
   */
  readonly meaning: string | undefined
  /** What to do about it, in English. */
  readonly remedy: string | undefined
  constructor(
    /** The number the PLC sent, e.g. 0xC056. */
    readonly endCode: number,
    message: string,
    detail: EndCodeDetail,
  ) {
    super(EndCodeError.kind, message)
    this.outcome = detail.carriedOut === false ? 'refused' : 'unknown'
    this.family = detail.family
    this.about = detail.about ?? 'unknown'
    this.carriedOut = detail.carriedOut
    this.command = detail.command
    this.commandName = detail.commandName
    this.station = detail.station
    this.abnormalCode = detail.abnormalCode
    this.meaning = detail.meaning
    this.remedy = detail.remedy
  }
}

/** What a `ProtocolError` knows beside its message. */
export interface ProtocolErrorDetail {
  /** Offset in `bytes` where it went wrong. */
  readonly offset?: number
  /** What was received, cut to a sensible length. */
  readonly bytes?: Uint8Array
  /** Path of the field that is wrong, as in `RequestError`, e.g. `words.0.device`. */
  readonly field?: string
}

/** The peer broke the protocol. The connection is dropped, because the byte stream can no longer be trusted. */
export class ProtocolError extends BaseError {
  protected static override readonly kind: string = 'ProtocolError'
  /** Always `unknown`: what came cannot be believed, so nobody knows what the PLC did. */
  readonly outcome = 'unknown'
  /** Offset in `bytes` where it went wrong. */
  readonly offset: number | undefined
  /** What was received, cut to a sensible length. */
  readonly bytes: Uint8Array | undefined
  /** Path of the field that is wrong, e.g. `words.0.device`; undefined when it is none of the message. */
  readonly field: string | undefined
  constructor(
    /** What is wrong. */
    readonly code: ProtocolErrorCode,
    message: string,
    detail: ProtocolErrorDetail = {},
  ) {
    super(ProtocolError.kind, message)
    this.offset = detail.offset
    // A copy: the memory of what was received holds something else soon.
    this.bytes = detail.bytes && Uint8Array.prototype.slice.call(detail.bytes)
    this.field = detail.field
  }
}

/** No answer before the deadline. */
export class TimeoutError extends BaseError {
  protected static override readonly kind: string = 'TimeoutError'
  /** Always `TIMEOUT`. */
  readonly code = 'TIMEOUT'
  constructor(
    message: string,
    /** `notSent`: the time was over before the request left. `unknown`: the PLC may have carried it out. */
    readonly outcome: 'notSent' | 'unknown',
    /** Ranked causes, most likely first, when the silence could be explained. */
    readonly causes: readonly string[] = [],
  ) {
    super(TimeoutError.kind, message)
  }
}

/** The network: no connection, or lost while a request was in flight. */
export class ConnectionError extends BaseError {
  protected static override readonly kind: string = 'ConnectionError'
  constructor(
    /** What is wrong. */
    readonly code: ConnectionErrorCode,
    message: string,
    /** `notSent`: the request did not leave. `unknown`: the connection was lost while it was under way. */
    readonly outcome: 'notSent' | 'unknown' = 'notSent',
    cause?: unknown,
    /** Ranked causes, most likely first. */
    readonly causes: readonly string[] = [],
  ) {
    super(ConnectionError.kind, message, cause)
  }
}

/** Closed, aborted or the queue was full: ended on this side. */
export class ClosedError extends BaseError {
  protected static override readonly kind: string = 'ClosedError'
  constructor(
    /** Who ended it. */
    readonly code: ClosedErrorCode,
    message: string,
    /** `notSent`: the request did not leave. `unknown`: it was under way. */
    readonly outcome: 'notSent' | 'unknown' = 'notSent',
    cause?: unknown,
  ) {
    super(ClosedError.kind, message, cause)
  }
}

/**
 * Remote control that the PLC has carried out, but the CPU is not in the state it was to be in, or does not tell. The
 * connection lives. The outcome is `unknown`: the command may take effect later, e.g. when somebody turns the switch.
 */
export class VerifyError extends BaseError {
  protected static override readonly kind: string = 'VerifyError'
  /** Always `NOT_VERIFIED`. */
  readonly code = 'NOT_VERIFIED'
  /** Always `unknown`: the command may take effect later, e.g. when somebody turns the switch. */
  readonly outcome = 'unknown'
  constructor(
    message: string,
    /** The state the CPU told last, e.g. `STOP`; undefined when it could not be read. */
    readonly state?: string,
    cause?: unknown,
  ) {
    super(VerifyError.kind, message, cause)
  }
}

/**
 * A call of several requests that failed when some of them had changed the PLC already, as writing a file: the message
 * says what is there now, and `cause` is what went wrong. The outcome is `unknown`, whatever that of the request that
 * failed: neither was nothing sent, nor was nothing carried out. Look before you send it again.
 */
export class UnfinishedError extends BaseError {
  protected static override readonly kind: string = 'UnfinishedError'
  /** Always `UNFINISHED`. */
  readonly code = 'UNFINISHED'
  /** Always `unknown`: a part of it was carried out. */
  readonly outcome = 'unknown'
  constructor(message: string, cause: unknown) {
    super(UnfinishedError.kind, message, cause)
  }
}

/** What became of one item of a write. `error.outcome` says whether the PLC may have been changed. */
export type WriteResult =
  | {
      /** The item as it was given. */
      readonly item: string
      /** Whether it was written. */
      readonly ok: true
    }
  | {
      readonly item: string
      readonly ok: false
      /** Why not. */
      readonly error: PlcError
    }

/**
 * A write of several items of which one or more were not written. `results` say what became of each, in their order;
 * `cause` is the error that matters most. The outcome is about the whole: `notSent` and `refused` when nothing at all was
 * written, `unknown` when something was, or may have been.
 */
export class WriteError extends BaseError {
  protected static override readonly kind: string = 'WriteError'
  /** Always `NOT_ALL_WRITTEN`. */
  readonly code = 'NOT_ALL_WRITTEN'
  constructor(
    message: string,
    /** About the whole: `unknown` when anything was written or may have been. */
    readonly outcome: Outcome,
    /** What became of each item, in their order. */
    readonly results: readonly WriteResult[],
    cause: PlcError,
  ) {
    super(WriteError.kind, message, cause)
  }
}

/** What a cause is as data, when it is no error of this package. */
export interface CauseData {
  /** Name of its class. */
  readonly name: string
  /** Its message. */
  readonly message: string
}

/** An error as plain data. What a class does not have is missing. */
export interface PlcErrorData {
  /** Name of its class, e.g. `RequestError`. */
  readonly name: string
  /** See `error.code` of the class. */
  readonly code: string
  /** What, where and what to do. */
  readonly message: string
  /** Whether the PLC may have been changed. */
  readonly outcome: Outcome
  /** Of a RequestError: the item, field or option it is about. */
  readonly field?: string
  /** Of an EndCodeError: the number the PLC sent. */
  readonly endCode?: number
  /** Of an EndCodeError: whose number it is. */
  readonly family?: EndCodeFamily
  /** Of an EndCodeError: what it is about. */
  readonly about?: EndCodeAbout
  /** Of an EndCodeError: `false` when nothing of it was done. */
  readonly carriedOut?: false
  /** Of an EndCodeError: the manual's name of the command. */
  readonly command?: string
  /** Of an EndCodeError: name of the command in its set. */
  readonly commandName?: string
  /** Of an EndCodeError: the station that reported it. */
  readonly station?: string
  /** Of an EndCodeError of a 1E frame: the code behind 5BH. */
  readonly abnormalCode?: number
  /** Of an EndCodeError: what it means, in English. */
  readonly meaning?: string
  /** Of an EndCodeError: what to do, in English. */
  readonly remedy?: string
  /** Of a ProtocolError: where in `bytes` it went wrong. */
  readonly offset?: number
  /** Hexadecimal digits. */
  readonly bytes?: string
  /** Of a TimeoutError or ConnectionError: ranked causes, most likely first. */
  readonly causes?: readonly string[]
  /** Of a VerifyError: the state the CPU told last. */
  readonly state?: string
  /** Of a WriteError: what became of each item. */
  readonly results?: readonly (
    | { readonly item: string; readonly ok: true }
    | { readonly item: string; readonly ok: false; readonly error: PlcErrorData }
  )[]
  /** What was behind it. */
  readonly cause?: PlcErrorData | CauseData
}

const TEXTS = ['field', 'family', 'about', 'command', 'commandName', 'station', 'meaning', 'remedy', 'state'] as const
const NUMBERS = ['endCode', 'abnormalCode', 'offset'] as const

function dataOf(error: BaseError): PlcErrorData {
  const { name, code, message, outcome, cause } = error
  const plain = [...TEXTS, ...NUMBERS, 'carriedOut', 'causes'].flatMap((field) => {
    const value: unknown = Reflect.get(error, field)
    return value === undefined ? [] : [[field, value]]
  })
  return {
    name,
    code,
    message,
    outcome,
    ...Object.fromEntries(plain),
    ...(error instanceof ProtocolError && error.bytes !== undefined ? { bytes: hexOf(error.bytes) } : {}),
    ...(error instanceof WriteError ? { results: error.results.map(resultData) } : {}),
    ...(cause === undefined ? {} : { cause: causeData(cause) }),
  }
}

// By hand: browsers have no Buffer.
function hexOf(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('')
}

function resultData(result: WriteResult): NonNullable<PlcErrorData['results']>[number] {
  const { item } = result
  return result.ok ? { item, ok: true } : { item, ok: false, error: result.error.toJSON() }
}

function causeData(cause: unknown): PlcErrorData | CauseData {
  if (cause instanceof PlcError) return cause.toJSON()
  return cause instanceof Error
    ? { name: cause.name, message: cause.message }
    : { name: 'Error', message: String(cause) }
}

/** Every error of this package: `error.code` says which, and narrows the type. */
export type PlcError =
  | RequestError
  | EndCodeError
  | ProtocolError
  | TimeoutError
  | ConnectionError
  | ClosedError
  | VerifyError
  | UnfinishedError
  | WriteError

/** For `instanceof`: true of every error of this package, also of another copy of it. */
export const PlcError = BaseError as unknown as (abstract new (
  ...given: never[]
) => BaseError) & {
  [Symbol.hasInstance](value: unknown): value is PlcError
}

/**
 * Whether an error ends the connection: the one place that decides it.
 * A refused or bad request leaves it alone; a broken protocol cannot be trusted any further; a missing answer does
 * end it when no serial number could tell the late answer from the next one.
 */
export function endsConnection(error: PlcError, correlation: 'serial' | 'order'): boolean {
  if (error instanceof ProtocolError || error instanceof ConnectionError) return true
  return error instanceof TimeoutError && error.outcome === 'unknown' && correlation === 'order'
}
