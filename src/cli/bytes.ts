// Bytes as people copy them: from a protocol analyser, a log, a manual.
import { RequestError } from '../index'
import { piecesOf } from './pasted'

/**
 * Bytes as they are pasted: one or several Buffers of Node.js, `b'...'` of Python, a hex dump with offsets, or digits.
 * @throws RequestError BAD_VALUE that points at what is wrong.
 */
export function pastedBytes(text: string, what: string): Buffer[] {
  return piecesOf(text, what) ?? [bytesOfHex(text, what)]
}

/**
 * Hexadecimal digits, two per byte; spaces, commas, colons, hyphens and `0x` between bytes do not matter.
 * @throws RequestError BAD_VALUE that points at what is wrong.
 * @example bytesOfHex('50 00 00 FF', 'the frame')
 */
function bytesOfHex(text: string, what: string): Buffer {
  const digits = text.replace(/0x(?=[0-9a-f])/gi, '').replace(/[\s,:;_-]/g, '')
  const wrong = /[^0-9a-f]/i.exec(digits)
  if (wrong !== null) {
    throw new RequestError(
      'BAD_VALUE',
      `${what}: ${JSON.stringify(wrong[0])} is no hexadecimal digit. A frame in ASCII code can be given as its characters with --text.`,
      what,
    )
  }
  if (digits.length === 0) throw new RequestError('BAD_VALUE', `${what}: there are no bytes.`, what)
  if (digits.length % 2 !== 0) {
    throw new RequestError(
      'BAD_VALUE',
      `${what}: ${digits.length} hexadecimal digits are no whole number of bytes.`,
      what,
    )
  }
  return Buffer.from(digits, 'hex')
}

/** The characters of a frame in ASCII code, without line ends and spaces around. */
export function bytesOfText(text: string): Buffer {
  return Buffer.from(text.trim(), 'latin1')
}
