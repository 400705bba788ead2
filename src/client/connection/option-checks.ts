// Options that every client has, whatever its family: checked before a connection is tried.
import { wholeNumber } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { RequestError } from '../../errors'

/** Longest time of an option, ms: a day. */
export const LONGEST = 24 * 60 * 60 * 1000

/** Pauses after failed attempts to connect: the first one, doubled up to the longest. */
export interface ReconnectOptions {
  /** ms */
  readonly first?: number
  /** ms */
  readonly longest?: number
}

/** Names of the options of `reconnect`. */
export const PAUSE_NAMES = { first: true, longest: true } as const satisfies Record<keyof ReconnectOptions, true>

/** @throws RequestError BAD_OPTION */
export function checkObject(field: string, given: object | undefined): void {
  if (given === undefined || (typeof given === 'object' && given !== null)) return
  throw new RequestError('BAD_OPTION', `${field} is ${shown(given)}; it must be an object.`, field)
}

/** @throws RequestError BAD_OPTION */
export function checkFunction(field: string, given: unknown): void {
  if (given === undefined || typeof given === 'function') return
  throw new RequestError('BAD_OPTION', `${field} is ${shown(given)}; it must be a function.`, field)
}

/** @throws RequestError BAD_OPTION */
export function checkLocalAddress(given: unknown): void {
  if (given === undefined || typeof given === 'string') return
  throw new RequestError('BAD_OPTION', 'localAddress is the address of a network interface, as text.', 'localAddress')
}

/** @throws RequestError BAD_OPTION */
export function checkPeer({ host, port }: { readonly host?: unknown; readonly port?: unknown }): void {
  if (typeof host !== 'string' || host.trim() === '') {
    throw new RequestError('BAD_OPTION', 'host is missing: give the address of the PLC, e.g. 192.168.3.39.', 'host')
  }
  wholeNumber('port', port as number, 1, 65_535)
}

/** @throws RequestError BAD_OPTION */
export function pausesOf({ first, longest }: ReconnectOptions): { readonly first: number; readonly longest: number } {
  const most = wholeNumber('reconnect.longest', longest ?? Math.max(30_000, first ?? 0), 1, LONGEST)
  const least = wholeNumber('reconnect.first', first ?? Math.min(500, most), 1, LONGEST)
  if (least <= most) return { first: least, longest: most }
  const message = `reconnect.first is ${least} ms and reconnect.longest ${most} ms: the first pause cannot be longer than the longest.`
  throw new RequestError('BAD_OPTION', message, 'reconnect.first')
}
