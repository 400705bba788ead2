/**
 * Every error of this package. One base, a closed `code`, and the one fact every plant needs: `outcome`.
 *
 * - `notSent`: nothing left this program; the PLC did not see the request.
 * - `refused`: the PLC answered and did not carry it out.
 * - `unknown`: the request may or may not have been carried out. A write with this outcome is never repeated here.
 *
 * The classes are branded with `Symbol.for`, because one Node-RED installation can hold two copies of this package
 * and `instanceof` must work across them.
 */
export type Outcome = 'notSent' | 'refused' | 'unknown'

/** The caller's mistake: found before anything is sent. */
export type RequestErrorCode =
  | 'BAD_ADDRESS' // the text is not an address
  | 'BAD_TYPE' // the type does not exist, or does not fit the device
  | 'BAD_VALUE' // the value does not fit the type
  | 'BAD_OPTION' // an option of the client, simulator or call
  | 'BAD_MESSAGE' // a message of `request()` does not fit the command's declaration
  | 'OUT_OF_RANGE' // a number outside what the wire form or the profile can say
  | 'LIMIT_EXCEEDED' // more points, blocks or bytes than one request may carry
  | 'UNSUPPORTED' // this profile, frame or code does not have it
  | 'NOT_PERMITTED' // allowWrites / allowControl is off
/** The PLC refused: see `endCode`. */
export type EndCodeErrorCode = 'END_CODE'
/** The peer sent what the protocol does not allow. */
export type ProtocolErrorCode =
  | 'TRUNCATED' // fewer bytes than the declaration needs
  | 'TRAILING' // bytes left over
  | 'BAD_DIGIT' // not a digit of the expected radix
  | 'BAD_FIELD' // a field with a value that cannot be
  | 'BAD_FRAME' // subheader, length or control code
  | 'BAD_SUM' // sum check
  | 'ECHO_MISMATCH' // route, command or another echoed field differs from the request
  | 'UNEXPECTED_ANSWER' // an answer nobody asked for, where no serial number tells which request it belongs to
export type TimeoutErrorCode = 'TIMEOUT'
export type ConnectionErrorCode =
  | 'CONNECT_FAILED'
  | 'DISCONNECTED'
  | 'ENTRY_BUSY' // accepted, then closed at once: all entries of the PLC are taken
  | 'PORT_UNAVAILABLE' // the local port or serial port is taken
  | 'SILENT' // connected, but nothing answers
  | 'OFFLINE' // failing fast while the connection is being restored
export type ClosedErrorCode = 'CLOSED' | 'ABORTED' | 'QUEUE_FULL' | 'OVERLOADED'
export type VerifyErrorCode = 'NOT_VERIFIED'
export type UnfinishedErrorCode = 'UNFINISHED'
export type WriteErrorCode = 'NOT_ALL_WRITTEN'
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

/** By class: `instanceof` asks for them again and again. */
const BRANDS = new Map<string, symbol>()

function brand(name: string): symbol {
  const known = BRANDS.get(name)
  if (known !== undefined) return known
  const made = Symbol.for(`${BRAND}.${name}`)
  BRANDS.set(name, made)
  return made
}

function carries(value: unknown, name: string): boolean {
  return typeof value === 'object' && value !== null && brand(name) in value
}

/** Base of every error thrown here. `message` says what, where and what to do. */
export abstract class PlcError extends Error {
  abstract readonly code: PlcErrorCode
  abstract readonly outcome: Outcome

  constructor(className: string, message: string, cause?: unknown) {
    super(message, cause === undefined ? undefined : { cause })
    this.name = className
    for (const name of ['PlcError', className]) Object.defineProperty(this, brand(name), { value: true })
  }

  static override [Symbol.hasInstance](value: unknown): boolean {
    // biome-ignore lint/complexity/noThisInStatic: `this` is the class on the right of instanceof, also a subclass.
    return carries(value, this.name)
  }
}

/** Bad address, value, option or message, or not permitted. The connection lives. */
export class RequestError extends PlcError {
  readonly outcome = 'notSent'
  constructor(
    readonly code: RequestErrorCode,
    message: string,
    /** The item, field or option the message is about, when there is one. */
    readonly field?: string,
  ) {
    super('RequestError', message)
  }
}

/** What an `EndCodeError` knows beside its number. */
export interface EndCodeDetail {
  /** Manual's name of the command, e.g. `Read`. */
  readonly command?: string
  /** Station that reported the error, where the frame says so, e.g. `network 0, station 255, module I/O 03FF, multidrop 0`. */
  readonly station?: string
  /** Of a 1E frame with end code 5BH: the code behind it, which says why. */
  readonly abnormalCode?: number
  /** What the code means, in English. */
  readonly meaning?: string
  /** What to do about it, in English. */
  readonly remedy?: string
}

/** The PLC answered with an end code other than 0. The connection lives. */
export class EndCodeError extends PlcError {
  readonly code = 'END_CODE'
  readonly outcome = 'refused'
  readonly command: string | undefined
  readonly station: string | undefined
  readonly abnormalCode: number | undefined
  readonly meaning: string | undefined
  readonly remedy: string | undefined
  constructor(
    /** The number the PLC sent, e.g. 0xC056. */
    readonly endCode: number,
    message: string,
    detail: EndCodeDetail = {},
  ) {
    super('EndCodeError', message)
    this.command = detail.command
    this.station = detail.station
    this.abnormalCode = detail.abnormalCode
    this.meaning = detail.meaning
    this.remedy = detail.remedy
  }
}

/** The peer broke the protocol. The connection is dropped, because the byte stream can no longer be trusted. */
export class ProtocolError extends PlcError {
  readonly outcome = 'unknown'
  constructor(
    readonly code: ProtocolErrorCode,
    message: string,
    /** Offset in `bytes` where it went wrong. */
    readonly offset?: number,
    /** What was received, cut to a sensible length. */
    readonly bytes?: Uint8Array,
  ) {
    super('ProtocolError', message)
  }
}

/** No answer before the deadline. */
export class TimeoutError extends PlcError {
  readonly code = 'TIMEOUT'
  constructor(
    message: string,
    readonly outcome: 'notSent' | 'unknown',
    /** Ranked causes, most likely first, when the silence could be explained. */
    readonly causes: readonly string[] = [],
  ) {
    super('TimeoutError', message)
  }
}

/** The network: no connection, or lost while a request was in flight. */
export class ConnectionError extends PlcError {
  constructor(
    readonly code: ConnectionErrorCode,
    message: string,
    readonly outcome: 'notSent' | 'unknown' = 'notSent',
    cause?: unknown,
    /** Ranked causes, most likely first. */
    readonly causes: readonly string[] = [],
  ) {
    super('ConnectionError', message, cause)
  }
}

/** Closed, aborted or the queue was full: ended on this side. */
export class ClosedError extends PlcError {
  constructor(
    readonly code: ClosedErrorCode,
    message: string,
    readonly outcome: 'notSent' | 'unknown' = 'notSent',
    cause?: unknown,
  ) {
    super('ClosedError', message, cause)
  }
}

/**
 * Remote control that the PLC has carried out, but the CPU is not in the state it was to be in, or does not tell. The
 * connection lives. The outcome is `unknown`: the command may take effect later, e.g. when somebody turns the switch.
 */
export class VerifyError extends PlcError {
  readonly code = 'NOT_VERIFIED'
  readonly outcome = 'unknown'
  constructor(
    message: string,
    /** The state the CPU told last, e.g. `STOP`; undefined when it could not be read. */
    readonly state?: string,
    cause?: unknown,
  ) {
    super('VerifyError', message, cause)
  }
}

/**
 * A call of several requests that failed when some of them had changed the PLC already, as writing a file: the message
 * says what is there now, and `cause` is what went wrong. The outcome is `unknown`, whatever that of the request that
 * failed: neither was nothing sent, nor was nothing carried out. Look before you send it again.
 */
export class UnfinishedError extends PlcError {
  readonly code = 'UNFINISHED'
  readonly outcome = 'unknown'
  constructor(message: string, cause: unknown) {
    super('UnfinishedError', message, cause)
  }
}

/** What became of one item of a write. `error.outcome` says whether the PLC may have been changed. */
export type WriteResult =
  | { readonly item: string; readonly ok: true }
  | { readonly item: string; readonly ok: false; readonly error: PlcError }

/**
 * A write of several items of which one or more were not written. `results` say what became of each, in their order;
 * `cause` is the error that matters most. The outcome is about the whole: `notSent` and `refused` when nothing at all was
 * written, `unknown` when something was, or may have been.
 */
export class WriteError extends PlcError {
  readonly code = 'NOT_ALL_WRITTEN'
  constructor(
    message: string,
    readonly outcome: Outcome,
    readonly results: readonly WriteResult[],
    cause: PlcError,
  ) {
    super('WriteError', message, cause)
  }
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
