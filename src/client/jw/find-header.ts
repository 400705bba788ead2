// Which header a unit wants, found by asking: a read that changes nothing.
import { checkNames } from '../../basics/option-checks'
import { ConnectionError, PlcError, ProtocolError, TimeoutError } from '../../errors'
import type { JwHeader } from '../../jw/header'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { createJwClient } from './jw-client'
import { JW_OPTION_NAMES, type JwClientOptions } from './options'

/** A header that was tried. */
export interface JwHeaderTried {
  /** What stood in front of the message. */
  readonly header: JwHeader
  /** Why it is not the one; absent: it is. */
  readonly error?: PlcError
}

/** What `findJwHeader` found. */
export interface JwHeaderFound {
  /** What the unit answers to. */
  readonly header: JwHeader
  /** All that was tried, the last one worked. */
  readonly tried: readonly JwHeaderTried[]
}

/**
 * 40 bytes first: a unit without header sees a message that does not exist, while one that waits for 40 bytes would take a
 * short message for the beginning of them. Each is tried on a connection of its own.
 */
const USUAL: readonly JwHeader[] = ['zero40', 'none']

/**
 * Finds the header that a unit wants in front of messages. Reads the write mode (E9H) with each, and changes nothing.
 * @param headers what to try, in this order
 * @throws ConnectionError SILENT when it answers to none of them; what `connect()` throws when it cannot be reached
 * @example const { header } = await findJwHeader({ host: '192.168.3.40', port: 10000 })
 */
export async function findJwHeader(
  options: Omit<JwClientOptions, 'header' | 'probe'>,
  headers: readonly JwHeader[] = USUAL,
  call: CallOptions = {},
): Promise<JwHeaderFound> {
  const { header: _header, probe: _probe, ...names } = JW_OPTION_NAMES
  checkNames('', options, names)
  const how = callOptionsOf(call)
  const tried: JwHeaderTried[] = []
  for (const header of headers) {
    const error = await failureWith({ ...options, header, probe: 'writeMode' }, how)
    if (error === undefined) return { header, tried: [...tried, { header }] }
    if (!isUnanswered(error)) throw error
    tried.push({ header, error })
  }
  const causes = tried.flatMap(({ error }) => (error instanceof ConnectionError ? error.causes : []))
  const message = `The unit answers with none of the headers ${headers.map(headerText).join(', ')}.`
  throw new ConnectionError('SILENT', message, 'notSent', tried.at(-1)?.error, [...new Set(causes)])
}

async function failureWith(options: JwClientOptions, call: CallOptions): Promise<PlcError | undefined> {
  const client = createJwClient(options)
  try {
    await client.connect(call)
    return undefined
  } catch (error) {
    if (error instanceof PlcError) return error
    throw error
  } finally {
    await client.close()
  }
}

/** Silence, closing, or what is no answer to the message, because the unit saw another one: what another header may change. */
function isUnanswered(error: PlcError): boolean {
  if (error instanceof ConnectionError) return error.code !== 'CONNECT_FAILED' && error.code !== 'PORT_UNAVAILABLE'
  return error instanceof TimeoutError || error instanceof ProtocolError
}

function headerText(header: JwHeader): string {
  if (typeof header === 'string') return header
  return header instanceof Uint8Array ? `${header.length} bytes` : `relay to station ${header.station}`
}
