/** Upper-case hexadecimal digits, at least so many: `hex(0xa, 2)` is `0A`. */
export function hex(value: number, digits = 1): string {
  return value.toString(16).toUpperCase().padStart(digits, '0')
}

/** The bytes as pairs of digits: `50 00 FF`. */
export function hexPairs(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) => hex(byte, 2)).join(' ')
}
