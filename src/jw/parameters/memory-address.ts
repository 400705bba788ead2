// Addresses of the CU's memory inside parameters: file number and file address (JW300 option unit manual, "How memory
// addresses are set in parameters", printed for each unit).

import { hex } from '../../basics/hex'
import { octal } from '../../basics/octal'
import { isPlainObject } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { badMessage, type ValueCodec } from '../../codec/codec'
import { FILE_REGISTERS, type JwAddress, LAST_FILE, PAGE, pageOfRegisters, registersOfPage } from '../address'

/** An address as it stands in a parameter. */
export interface StoredAddress {
  /** 00H: file 0; above it the 64 KB pages of the file registers. */
  readonly fileNumber: number
  /** In it, as the unit counts. */
  readonly fileAddress: number
}

/** A place in the memory: by the address of its byte, or as the parameter holds it. */
export type ParameterAddress = JwAddress | StoredAddress

/**
 * `whole`: the file address counts bytes (JW-255CM, JW-25TCM, JW-22CM, JW-21MN, JW-22SU). `halved`: the file address of a
 * file register is divided by two (FL-net units).
 */
export type AddressNotation = 'whole' | 'halved'

/** `lastPage`: file number of the last page of file registers that the unit reaches. */
const notations = {
  whole: { bytes: 1, lastPage: LAST_FILE },
  halved: { bytes: 2, lastPage: 0x7f },
} as const satisfies Record<AddressNotation, object>

/**
 * What a parameter holds for a place.
 * @throws RequestError BAD_MESSAGE saying what is wrong; it gets the name of the setting where it is caught
 * @example storedAddress({ file: 1, address: 0o200000, extended: true }, 'halved')   // { fileNumber: 2, fileAddress: 0 }
 */
export function storedAddress(place: ParameterAddress, notation: AddressNotation): StoredAddress {
  if (!isPlainObject(place as unknown)) badMessage(`must be ${takesOf(notation)}; it is ${shown(place)}`)
  if (isStored(place)) return checkedStored(place, notation)
  const { fileNumber, byte } = pageOf(place)
  const { bytes, lastPage } = notations[notation]
  if (fileNumber > lastPage)
    badMessage(`is behind the file registers that the unit reaches: ${lastByte(lastPage)} octal`)
  if (bytes > 1 && fileNumber === 0)
    badMessage(
      'is in file 0: how it is set there is not printed. Give fileNumber 0 and fileAddress as the tool of the unit shows it',
    )
  if (byte % bytes !== 0)
    badMessage(`is at an odd byte, ${octal(byte, 6)} octal; the unit counts words, so use an even one`)
  return { fileNumber, fileAddress: byte / bytes }
}

function isStored(place: ParameterAddress): place is StoredAddress {
  return 'fileNumber' in place
}

/** The names of an address as the parameter holds it, and nothing else. */
function checkedStored(place: StoredAddress, notation: AddressNotation): StoredAddress {
  const { fileNumber, fileAddress } = place
  const { bytes, lastPage } = notations[notation]
  const other = Object.keys(place).find((name) => name !== 'fileNumber' && name !== 'fileAddress')
  if (other !== undefined) badMessage(`has ${other} beside fileNumber; give ${takesOf(notation)}`)
  if (!isWithin(fileNumber, lastPage)) badMessage(`fileNumber is ${shown(fileNumber)}, must be 0 to ${lastPage}`)
  const last = fileNumber === 0 ? PAGE - 1 : PAGE / bytes - 1
  if (!isWithin(fileAddress, last))
    badMessage(`fileAddress is ${shown(fileAddress)}, must be 0 to ${octal(last, 6)} octal`)
  return { fileNumber, fileAddress }
}

/** File number and byte of an address in either form: page n of the file registers is file 1 + n. */
function pageOf({ file, address, extended }: JwAddress): { fileNumber: number; byte: number } {
  const pages = notations.whole.lastPage
  const registers = extended === true && file === FILE_REGISTERS
  const files = extended === true ? 1 : pages
  if (extended !== undefined && typeof extended !== 'boolean')
    badMessage(`extended is ${shown(extended)}, must be true or left out`)
  if (!isWithin(file, files)) badMessage(`file is ${shown(file)}, must be 0 to ${files}`)
  const last = registers ? pages * PAGE - 1 : PAGE - 1
  if (!isWithin(address, last)) badMessage(`address is ${shown(address)}, must be 0 to ${octal(last, 6)} octal`)
  if (!registers) return { fileNumber: file, byte: address }
  const page = pageOfRegisters(address)
  return { fileNumber: page.file, byte: page.address }
}

/**
 * The place that a parameter means: a byte of file 0, or of the file registers in the extended form.
 * `undefined` where the manual does not print it: file 0 of the FL-net units, and what is behind the last page.
 */
export function placeOf({ fileNumber, fileAddress }: StoredAddress, notation: AddressNotation): JwAddress | undefined {
  const { bytes, lastPage } = notations[notation]
  const byte = fileAddress * bytes
  if (fileNumber > lastPage || byte >= PAGE) return undefined
  if (fileNumber > 0) return registersOfPage(fileNumber, byte)
  return bytes === 1 ? { file: 0, address: byte } : undefined
}

/** Whether an area leaves its file or page: the units count by 64 KB. `undefined` where it cannot be told. */
export function leavesPage(place: ParameterAddress, length: number, notation: AddressNotation): boolean | undefined {
  const start = byteOf(place, notation)
  return start === undefined ? undefined : (start % PAGE) + length > PAGE
}

/** Number of a byte in the row of file 0 and the pages behind it. */
export function byteOf(place: ParameterAddress, notation: AddressNotation): number | undefined {
  const { fileNumber, fileAddress } = storedAddress(place, notation)
  const { bytes } = notations[notation]
  return fileNumber === 0 && bytes > 1 ? undefined : fileNumber * PAGE + fileAddress * bytes
}

/** An address in three bytes: file address, low byte first, then file number. */
export function addressThenFile(notation: AddressNotation): ValueCodec<ParameterAddress> {
  return {
    name: notation === 'halved' ? 'halved address' : 'address',
    takes: takesOf(notation),
    example: { file: 1, address: 0o10000, extended: true },
    write(writer, place) {
      const { fileNumber, fileAddress } = storedAddress(place, notation)
      writer.uint(fileAddress, 2)
      writer.uint(fileNumber, 1)
    },
    read(reader) {
      const fileAddress = reader.uint(2)
      const stored = { fileNumber: reader.uint(1), fileAddress }
      const place = placeOf(stored, notation)
      if (place === undefined && stored.fileNumber > 0)
        reader.fail('BAD_FIELD', `${storedText(stored)} is no address that the unit reaches`)
      return place ?? stored
    },
    size: () => 3,
  }
}

function takesOf(notation: AddressNotation): string {
  const file0 = notation === 'whole' ? '{ file: 0, address }, ' : ''
  return `an address as ${file0}{ file: 1, address, extended: true } or { fileNumber, fileAddress }`
}

/** A place in words, numbers as the manuals print them. */
export function placeText(place: ParameterAddress): string {
  if (isStored(place)) return storedText(place)
  const { file, address, extended } = place
  return `file ${hex(file)}, byte ${octal(address, extended === true && file === FILE_REGISTERS ? 8 : 6)} octal`
}

function storedText({ fileNumber, fileAddress }: StoredAddress): string {
  return `file number ${hex(fileNumber, 2)}H, file address ${octal(fileAddress, 6)} octal`
}

function lastByte(page: number): string {
  return `00000000 to ${octal(page * PAGE - 1, 8)}`
}

function isWithin(value: number, last: number): boolean {
  return Number.isInteger(value) && value >= 0 && value <= last
}
