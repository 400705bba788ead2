/** The two ways a value can be wrong: the caller's, and the one the PLC holds. One place decides what each throws. */
import { show } from '../basics/show'
import { ProtocolError, RequestError } from '../errors'
import { formatType, type ValueType } from './type'

/** The caller's value does not fit the type; nothing has been sent. */
export function badValue(type: string, value: unknown, takes: string): RequestError {
  return new RequestError('BAD_VALUE', `${show(value)} is not a value of ${type}: it takes ${takes}`)
}

/**
 * The frame was right, but what the PLC holds is no value of the declared type. It concerns this value alone: whoever
 * decodes values (after the session has accepted the frame) keeps the connection.
 */
export function badContent(type: ValueType | string, what: string, remedy: string): ProtocolError {
  const name = typeof type === 'string' ? type : formatType(type)
  return new ProtocolError('BAD_FIELD', `${what} in the PLC is not a value of ${name}: ${remedy}`)
}
