// Errors that were plain data for a while: on their way from another process, a worker or a file.
import {
  CLOSED_CODES,
  ClosedError,
  CONNECTION_CODES,
  ConnectionError,
  EndCodeError,
  endCodeAbouts,
  endCodeFamilies,
  type Outcome,
  PlcError,
  PROTOCOL_CODES,
  ProtocolError,
  REQUEST_CODES,
  RequestError,
  TimeoutError,
  UnfinishedError,
  VerifyError,
  WriteError,
  type WriteResult,
} from '../errors'

/** Fields of an end code error that are texts. */
const END_CODE_TEXTS = ['command', 'commandName', 'station', 'meaning', 'remedy'] as const

/**
 * The error that `toJSON()` made plain data of: of the same class, with the same outcome. Its stack is where this is called.
 * @throws RequestError BAD_VALUE when it is none
 * @example process.on('message', (data) => handle(plcErrorFrom(data)))
 */
export function plcErrorFrom(data: unknown): PlcError {
  if (data instanceof PlcError) return data
  const given = bagOf(data)
  const { name, message } = given
  const make = typeof name === 'string' && Object.hasOwn(MAKERS, name) ? MAKERS[name] : undefined
  if (make === undefined || typeof message !== 'string') throw noError('name')
  return make(message, given)
}

type Bag = Readonly<Record<string, unknown>>

const MAKERS: Readonly<Record<string, (message: string, given: Bag) => PlcError>> = {
  RequestError: (message, given) =>
    new RequestError(oneOf(given, 'code', REQUEST_CODES), message, textIn(given, 'field')),
  EndCodeError: (message, given) => {
    const { endCode, abnormalCode, carriedOut } = given
    if (typeof endCode !== 'number') throw noError('endCode')
    return new EndCodeError(endCode, message, {
      family: oneOf(given, 'family', endCodeFamilies),
      about: oneOf(given, 'about', endCodeAbouts),
      ...(carriedOut === false ? { carriedOut } : {}),
      ...(typeof abnormalCode === 'number' ? { abnormalCode } : {}),
      ...textsIn(given, END_CODE_TEXTS),
    })
  },
  ProtocolError: (message, given) => {
    const { bytes, offset } = given
    return new ProtocolError(oneOf(given, 'code', PROTOCOL_CODES), message, {
      ...(typeof offset === 'number' ? { offset } : {}),
      ...(typeof bytes === 'string' ? { bytes: bytesOf(bytes) } : {}),
      ...textsIn(given, ['field']),
    })
  },
  TimeoutError: (message, given) => new TimeoutError(message, oneOf(given, 'outcome', UNANSWERED), causesIn(given)),
  ConnectionError: (message, given) => {
    const code = oneOf(given, 'code', CONNECTION_CODES)
    return new ConnectionError(code, message, oneOf(given, 'outcome', UNANSWERED), causeIn(given), causesIn(given))
  },
  ClosedError: (message, given) =>
    new ClosedError(oneOf(given, 'code', CLOSED_CODES), message, oneOf(given, 'outcome', UNANSWERED), causeIn(given)),
  VerifyError: (message, given) => new VerifyError(message, textIn(given, 'state'), causeIn(given)),
  UnfinishedError: (message, given) => new UnfinishedError(message, causeIn(given)),
  WriteError: (message, given) => {
    const { results } = given
    if (!Array.isArray(results)) throw noError('results')
    return new WriteError(
      message,
      oneOf(given, 'outcome', OUTCOMES),
      results.map(resultFrom),
      plcErrorFrom(given.cause),
    )
  },
}

const UNANSWERED = ['notSent', 'unknown'] as const
const OUTCOMES = ['notSent', 'refused', 'unknown'] as const satisfies readonly Outcome[]

function resultFrom(data: unknown): WriteResult {
  const { item, ok, error } = bagOf(data)
  if (typeof item !== 'string' || typeof ok !== 'boolean') throw noError('results')
  return ok ? { item, ok } : { item, ok, error: plcErrorFrom(error) }
}

function bagOf(data: unknown): Bag {
  if (typeof data !== 'object' || data === null) throw noError('name')
  return data as Bag
}

function bytesOf(hex: string): Uint8Array {
  return Uint8Array.from(hex.match(/[\da-f]{2}/gi) ?? [], (pair) => Number.parseInt(pair, 16))
}

function oneOf<const T extends string>(given: Bag, field: string, allowed: readonly T[]): T {
  const found = allowed.find((value) => value === given[field])
  if (found === undefined) throw noError(field)
  return found
}

function textIn(given: Bag, field: string): string | undefined {
  const value = given[field]
  return typeof value === 'string' ? value : undefined
}

/** Those of the fields that are texts. */
function textsIn<const F extends string>(given: Bag, fields: readonly F[]): { [K in F]?: string } {
  const texts: { [K in F]?: string } = {}
  for (const field of fields) {
    const text = textIn(given, field)
    if (text !== undefined) texts[field] = text
  }
  return texts
}

function causesIn({ causes }: Bag): readonly string[] {
  return Array.isArray(causes) ? causes.map(String) : []
}

function causeIn({ cause }: Bag): unknown {
  if (cause === undefined || cause === null) return undefined
  const { name, message } = bagOf(cause)
  if (typeof name === 'string' && Object.hasOwn(MAKERS, name)) return plcErrorFrom(cause)
  const error = new Error(String(message))
  error.name = String(name)
  return error
}

function noError(field: string): RequestError {
  return new RequestError('BAD_VALUE', `This is no error as toJSON() writes it: its ${field} is wrong.`, field)
}
