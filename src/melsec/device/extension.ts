/**
 * The fields that the extended form (subcommand 008x) puts around a device code and number: where the device is
 * (network, module, CPU), index registers and `@` (SLMP reference manual appendix 1).
 * Their meaning is checked by the caller; here are only the bytes.
 */

import { hex } from '../../basics/hex'
import type { Reader, Writer } from '../../codec/codec'
import { CPU_UNIT, type DeviceAddress, type DeviceExtension } from './device'

type Extension = Pick<DeviceAddress, 'extension' | 'extensionIndex'>
type Modification = Pick<DeviceAddress, 'index' | 'indirect'>
type Index = NonNullable<DeviceAddress['index']>

/** Direct memory specification, binary code only (SLMP p. 218). */
const DIRECT_MEMORY = { link: 0xf9, module: 0xf8, cpu: 0xfa } as const
/** High byte of a modification: the kind of index register; bit 3 says indirect. */
const MODIFIED_BY = { Z: 0x40, LZ: 0x80 } as const
const INDIRECT = 0x08

/** Value of the extension field: network, or upper three digits of the start I/O number. */
function extensionValue(extension: DeviceExtension): number {
  switch (extension.kind) {
    case 'link':
      return extension.network
    case 'module':
      return extension.unit
    case 'cpu':
      return CPU_UNIT + extension.cpu - 1
    default:
      return extension satisfies never
  }
}

/** The CPU behind a start I/O number, or undefined when it is a module. */
function cpuOf(unit: number): 1 | 2 | 3 | 4 | undefined {
  const cpu = unit - CPU_UNIT + 1
  return cpu === 1 || cpu === 2 || cpu === 3 || cpu === 4 ? cpu : undefined
}

function unitExtension(unit: number): DeviceExtension {
  const cpu = cpuOf(unit)
  return cpu === undefined ? { kind: 'module', unit } : { kind: 'cpu', cpu }
}

/** Device modification and indirect specification: 2 bytes before the number. */
export function writeBinaryModification(writer: Writer, { index, indirect }: Modification): void {
  const kind = (index === undefined ? 0 : MODIFIED_BY[index.register]) | (indirect === undefined ? 0 : INDIRECT)
  writer.uint((index?.number ?? 0) | (kind << 8), 2)
}

/** Extension modification, extension and direct memory: 5 bytes after the code. */
export function writeBinaryExtension(writer: Writer, { extension, extensionIndex }: Extension): void {
  writer.uint(extensionIndex === undefined ? 0 : extensionIndex.number | (MODIFIED_BY.Z << 8), 2)
  writer.uint(extension === undefined ? 0 : extensionValue(extension), 2)
  writer.uint(extension === undefined ? 0 : DIRECT_MEMORY[extension.kind], 1)
}

export function readBinaryModification(reader: Reader): Modification {
  const word = reader.uint(2)
  const number = word & 0xff
  const kind = word >>> 8
  const indirect = (kind & INDIRECT) === 0 ? {} : ({ indirect: true } as const)
  switch (kind & ~INDIRECT) {
    case 0:
      if (number !== 0) reader.fail('BAD_FIELD', `device modification names register ${number} but no kind of it`)
      return indirect
    case MODIFIED_BY.Z:
      return { index: { register: 'Z', number }, ...indirect }
    case MODIFIED_BY.LZ:
      return { index: { register: 'LZ', number }, ...indirect }
    default:
      return reader.fail('BAD_FIELD', `device modification ${hex(word, 4)}H is not a Z, LZ or indirect one`)
  }
}

export function readBinaryExtension(reader: Reader): Extension {
  const modification = reader.uint(2)
  const value = reader.uint(2)
  const extension = binaryExtension(reader, reader.uint(1), value)
  if (modification === 0) return extension === undefined ? {} : { extension }
  if (extension === undefined) reader.fail('BAD_FIELD', 'extension modification without an extension')
  if (modification >>> 8 !== MODIFIED_BY.Z) {
    reader.fail('BAD_FIELD', `extension modification ${hex(modification, 4)}H is not by Z`)
  }
  return { extension, extensionIndex: { register: 'Z', number: modification & 0xff } }
}

function binaryExtension(reader: Reader, directMemory: number, value: number): DeviceExtension | undefined {
  const found = unitExtension(value)
  switch (directMemory) {
    case 0:
      if (value === 0) return undefined
      return reader.fail('BAD_FIELD', `extension ${hex(value, 4)}H without a direct memory specification`)
    case DIRECT_MEMORY.link:
      return { kind: 'link', network: value }
    case DIRECT_MEMORY.module:
    case DIRECT_MEMORY.cpu:
      if (directMemory === DIRECT_MEMORY[found.kind]) return found
      return reader.fail(
        'BAD_FIELD',
        `direct memory ${hex(directMemory, 2)}H does not fit start I/O number ${hex(value, 3)}H`,
      )
    default:
      return reader.fail('BAD_FIELD', `direct memory ${hex(directMemory, 2)}H is not F8H, F9H, FAH or 00H`)
  }
}

/** Indirect specification, extension and extension modification: 9 or 10 characters before the code. */
export function writeAsciiExtension(writer: Writer, address: Extension & Modification, long: boolean): void {
  const { extension, extensionIndex, indirect } = address
  writer.text(indirect === undefined ? '00' : '0@')
  if (extension === undefined) writer.text('0000')
  else writer.text((extension.kind === 'link' ? 'J' : 'U') + hex(extensionValue(extension), 3))
  writeAsciiIndex(writer, extensionIndex, long)
}

/** Device modification: 3 or 4 characters after the number. */
export function writeAsciiModification(writer: Writer, { index }: Modification, long: boolean): void {
  writeAsciiIndex(writer, index, long)
}

function writeAsciiIndex(writer: Writer, index: Index | undefined, long: boolean): void {
  if (index === undefined) writer.text(long ? '0000' : '000')
  else writer.text(indexPrefix(index.register, long) + (index.number < 10 ? '0' : '') + index.number)
}

/** `Z` and a space, or `LZ`, in the long form; `Z` in the short one, which has no room for LZ. */
function indexPrefix(register: Index['register'], long: boolean): string {
  return register === 'LZ' ? 'LZ' : long ? 'Z ' : 'Z'
}

export function readAsciiExtension(reader: Reader, long: boolean): Extension & Modification {
  const head = reader.text(2)
  if (head !== '00' && head !== '0@') reader.fail('BAD_FIELD', `indirect specification ${show(head)} is not 00 or 0@`)
  const indirect = head === '00' ? {} : ({ indirect: true } as const)
  const extension = asciiExtension(reader, reader.text(4))
  const index = readAsciiIndex(reader, long)
  if (index === undefined) return extension === undefined ? indirect : { extension, ...indirect }
  if (extension === undefined) reader.fail('BAD_FIELD', 'extension modification without an extension')
  const { register, number } = index
  if (register !== 'Z') reader.fail('BAD_FIELD', `extension modification by ${register}: only Z may`)
  return { extension, extensionIndex: { register, number }, ...indirect }
}

function asciiExtension(reader: Reader, text: string): DeviceExtension | undefined {
  if (text === '0000') return undefined
  const digits = text.slice(1)
  if (!/^[JU]/.test(text)) reader.fail('BAD_FIELD', `extension ${show(text)} is not J, U or 0000`)
  if (!/^[0-9A-F]{3}$/i.test(digits)) reader.fail('BAD_DIGIT', `extension ${show(text)} needs three hexadecimal digits`)
  const value = Number.parseInt(digits, 16)
  return text.startsWith('J') ? { kind: 'link', network: value } : unitExtension(value)
}

export function readAsciiModification(reader: Reader, long: boolean): Pick<DeviceAddress, 'index'> {
  const index = readAsciiIndex(reader, long)
  return index === undefined ? {} : { index }
}

function readAsciiIndex(reader: Reader, long: boolean): Index | undefined {
  const text = reader.text(long ? 4 : 3)
  if (text === (long ? '0000' : '000')) return undefined
  const register = long && text.startsWith('LZ') ? 'LZ' : 'Z'
  const prefix = indexPrefix(register, long)
  if (!text.startsWith(prefix)) reader.fail('BAD_FIELD', `modification ${show(text)} is not an index register or 0`)
  const digits = text.slice(prefix.length)
  if (!/^[0-9]{2}$/.test(digits)) reader.fail('BAD_DIGIT', `modification ${show(text)} needs two decimal digits`)
  return { register, number: Number(digits) }
}

function show(text: string): string {
  return JSON.stringify(text)
}
