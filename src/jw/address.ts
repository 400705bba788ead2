import { RequestError } from '../errors'

/**
 * Where a byte lives in a Sharp JW: a file number and a byte address in the file. `extended`: the form that only the JW300
 * knows, with four bytes of address (JW300 option unit manual, "Memory addresses of the CU"). The basic form of file
 * 1 + n is the 64 KB page n of extended file 1, so both forms of files 0 and 1 below 10000H name the same byte.
 */
export interface JwAddress {
  /** File number (SEG): basic 00-80H; extended 0 or 1. */
  readonly file: number
  /** Byte address (ADR): basic 0-FFFFH; extended file 0 0-FFFFH, file 1 0-7FFFFFH. */
  readonly address: number
  /** The form with four bytes of address. */
  readonly extended?: true
}

/** An address where a command has room for the extended form only. */
export interface JwExtendedAddress extends JwAddress {
  /** Always. */
  readonly extended: true
}

/** Last file number of the basic form. */
export const LAST_FILE = 0x80
/** Extended file of the file registers of a JW300. */
export const FILE_REGISTERS = 1
/** Bytes of a file of the basic form, and of a page of the file registers. */
export const PAGE = 0x10000
const LAST_EXTENDED = [PAGE - 1, LAST_FILE * PAGE - 1]

/** @throws RequestError for an address that does not exist */
export function checkJwAddress(value: JwAddress): void {
  if (value.extended !== undefined && value.extended !== true) {
    throw new RequestError('BAD_MESSAGE', `extended is true or left out, not ${String(value.extended)}`)
  }
  const last = lastAddress(value)
  if (last === undefined) throw outOfRange('file', value.file)
  if (!Number.isInteger(value.address) || value.address < 0 || value.address > last)
    throw outOfRange('address', value.address)
}

/** Last byte address of the file, `undefined` when there is no such file. */
export function lastAddress({ file, extended }: Pick<JwAddress, 'file' | 'extended'>): number | undefined {
  if (extended === true) return LAST_EXTENDED[file]
  return Number.isInteger(file) && file >= 0 && file <= LAST_FILE ? PAGE - 1 : undefined
}

function outOfRange(what: string, found: number): RequestError {
  return new RequestError('OUT_OF_RANGE', `${what} ${found} does not exist in a Sharp JW address`)
}

/** The basic form of a byte of the file registers: its page is a file of its own, from file 1 on. */
export function pageOfRegisters(address: number): JwAddress {
  return { file: FILE_REGISTERS + Math.floor(address / PAGE), address: address % PAGE }
}

/** The extended form of a byte of a page of the file registers: the reverse of {@link pageOfRegisters}. */
export function registersOfPage(file: number, address: number): JwExtendedAddress {
  return { file: FILE_REGISTERS, address: (file - FILE_REGISTERS) * PAGE + address, extended: true }
}
