/**
 * Numbers in 1, 2 or 4 words, low word first and low byte first (other orders are arranged before and after, in
 * convert.ts). Source: MELSEC iQ-R Programming Manual (CPU Module Instructions), 1.2 "Data Specification Method".
 */
import { badContent, badValue } from './fault'
import { type NumberName, type TypeNameOf, valueTypes } from './type'
import { formatWord, type Words, wordAt } from './word'

// One scratch for every conversion between bits and floating-point or 64-bit numbers; used up within each function.
const scratch = new DataView(new ArrayBuffer(8))

export function unsigned16(words: Words, at: number): number {
  return wordAt(words, at)
}

export function signed16(words: Words, at: number): number {
  return (wordAt(words, at) << 16) >> 16
}

export function signed32(words: Words, at: number): number {
  return wordAt(words, at) | (wordAt(words, at + 1) << 16)
}

export function unsigned32(words: Words, at: number): number {
  return signed32(words, at) >>> 0
}

export function real32(words: Words, at: number): number {
  scratch.setInt32(0, signed32(words, at), true)
  return scratch.getFloat32(0, true)
}

function load64(words: Words, at: number): DataView {
  scratch.setInt32(0, signed32(words, at), true)
  scratch.setInt32(4, signed32(words, at + 2), true)
  return scratch
}

function decimal(name: TypeNameOf<'bcd'>, words: Words, at: number): number {
  let value = 0
  for (let word = valueTypes[name].words - 1; word >= 0; word--) {
    const digits = wordAt(words, at + word)
    for (let shift = 12; shift >= 0; shift -= 4) {
      const digit = (digits >>> shift) & 0xf
      if (digit > 9)
        throw badContent(name, formatWord(digits), 'a digit is above 9; read it as WORD, or correct its type')
      value = value * 10 + digit
    }
  }
  return value
}

/** Reads one number of each type at an index. */
export const readers: { readonly [N in NumberName]: (words: Words, at: number) => number | bigint } = {
  INT: signed16,
  UINT: unsigned16,
  WORD: unsigned16,
  DINT: signed32,
  UDINT: unsigned32,
  DWORD: unsigned32,
  TIME: signed32,
  LINT: (words, at) => load64(words, at).getBigInt64(0, true),
  ULINT: (words, at) => load64(words, at).getBigUint64(0, true),
  REAL: real32,
  LREAL: (words, at) => load64(words, at).getFloat64(0, true),
  BCD16: (words, at) => decimal('BCD16', words, at),
  BCD32: (words, at) => decimal('BCD32', words, at),
}

/** Checks a whole number of a type; the range is looked up once, not per number. */
function wholeNumber(name: TypeNameOf<'integer' | 'bcd'>): (value: unknown) => number {
  const { min, max } = valueTypes[name]
  return (value) => {
    // A BigInt is exact, so one within the range is the number it says; outside it stays refused.
    const number = typeof value === 'bigint' ? Number(value) : value
    if (typeof number === 'number' && number >= min && number <= max && Number.isInteger(number)) return number
    throw badValue(name, value, `a whole number from ${min} to ${max}`)
  }
}

function long(name: TypeNameOf<'long'>): (value: unknown) => bigint {
  const { min, max } = valueTypes[name]
  return (value) => {
    if (typeof value === 'bigint' || (typeof value === 'number' && Number.isSafeInteger(value))) {
      const exact = BigInt(value)
      if (exact >= min && exact <= max) return exact
    }
    throw badValue(name, value, `a BigInt from ${min}n to ${max}n, or a whole number up to ${Number.MAX_SAFE_INTEGER}`)
  }
}

/** Not-a-number and infinity are refused: the CPU's real instructions answer them with an operation error. */
function finite(name: TypeNameOf<'real'>, value: unknown): number {
  if (typeof value === 'number' && Number.isFinite(value)) return value
  throw badValue(name, value, 'a finite number')
}

function store32(bits: number, out: number[], at: number): void {
  out[at] = bits & 0xffff
  out[at + 1] = (bits >>> 16) & 0xffff
}

function store64(out: number[], at: number): void {
  store32(scratch.getInt32(0, true), out, at)
  store32(scratch.getInt32(4, true), out, at + 2)
}

function toDecimal(value: number): number {
  let bits = 0
  for (let rest = value, shift = 0; rest > 0; rest = Math.floor(rest / 10), shift += 4) bits |= (rest % 10) << shift
  return bits
}

type Writer = (value: unknown, out: number[], at: number) => void

function writer16(name: TypeNameOf<'integer'>): Writer {
  const check = wholeNumber(name)
  return (value, out, at) => {
    out[at] = check(value) & 0xffff
  }
}

function writer32(name: TypeNameOf<'integer'>): Writer {
  const check = wholeNumber(name)
  return (value, out, at) => store32(check(value), out, at)
}

function writer64(name: TypeNameOf<'long'>): Writer {
  const check = long(name)
  return (value, out, at) => {
    // The low 64 bits are the same for both signs.
    scratch.setBigUint64(0, BigInt.asUintN(64, check(value)), true)
    store64(out, at)
  }
}

function writerOfDigits(name: TypeNameOf<'bcd'>): Writer {
  const check = wholeNumber(name)
  const { words } = valueTypes[name]
  return (value, out, at) => {
    const digits = toDecimal(check(value))
    if (words === 1) out[at] = digits
    else store32(digits, out, at)
  }
}

function writeReal(value: unknown, out: number[], at: number): void {
  const number = finite('REAL', value)
  // Rounded to the nearest REAL, as every real is; what would round to infinity does not fit.
  if (!Number.isFinite(Math.fround(number))) throw badValue('REAL', value, 'a number up to 3.4028235e38')
  scratch.setFloat32(0, number, true)
  store32(scratch.getInt32(0, true), out, at)
}

function writeLongReal(value: unknown, out: number[], at: number): void {
  scratch.setFloat64(0, finite('LREAL', value), true)
  store64(out, at)
}

/** Checks and writes one number of each type at an index. */
export const writers: { readonly [N in NumberName]: Writer } = {
  INT: writer16('INT'),
  UINT: writer16('UINT'),
  WORD: writer16('WORD'),
  DINT: writer32('DINT'),
  UDINT: writer32('UDINT'),
  DWORD: writer32('DWORD'),
  TIME: writer32('TIME'),
  LINT: writer64('LINT'),
  ULINT: writer64('ULINT'),
  REAL: writeReal,
  LREAL: writeLongReal,
  BCD16: writerOfDigits('BCD16'),
  BCD32: writerOfDigits('BCD32'),
}
