// Single integers at known places of a frame head, where a cursor would be in the way.
import { DIGITS, VALUE } from './ascii'
import { failAt, type Width } from './cursor'

/** Writes an unsigned integer at `at` and returns the offset behind it. Binary low byte first, ASCII high digit first. */
export function putUint(buffer: Buffer, at: number, value: number, width: Width, ascii: boolean): number {
  if (!ascii) {
    for (let i = 0; i < width; i++) buffer[at + i] = value >>> (8 * i)
    return at + width
  }
  for (let i = width * 2 - 1, rest = value; i >= 0; i--, rest >>>= 4) buffer[at + i] = DIGITS[rest & 15] as number
  return at + width * 2
}

/**
 * The unsigned integer at `at`. The caller has checked that the bytes are there.
 * @throws ProtocolError BAD_DIGIT
 */
export function uintAt(buffer: Buffer, at: number, width: Width, ascii: boolean): number {
  let value = 0
  if (!ascii) {
    for (let i = width - 1; i >= 0; i--) value = value * 256 + (buffer[at + i] as number)
    return value
  }
  for (let i = 0; i < width * 2; i++) {
    const digit = VALUE[buffer[at + i] as number] as number
    if (digit < 0) failAt('BAD_DIGIT', at + i, buffer, 'not a hexadecimal digit 0-9, A-F')
    value = value * 16 + digit
  }
  return value
}

/** Value of a hexadecimal digit of ASCII code by its character code, -1 for any other character. */
export function digitValue(character: number): number {
  return VALUE[character] ?? -1
}

/** Whether two characters of ASCII code are the same digit, whichever case. */
export function isSameDigit(one: number | undefined, other: number | undefined): boolean {
  const value = digitValue(one ?? 0)
  return value >= 0 && value === digitValue(other ?? 0)
}
