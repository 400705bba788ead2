// What stands in front of the data of every 1C request: the two characters of the command and the message wait (44.2).
import { field, type ValueCodec } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { Front } from '../../link/link'

const STEP = 10
const LONGEST = 150
const DIGITS = '0123456789ABCDEF'

/** The time in ms before the PLC answers at the earliest: one digit, in units of 10 ms. */
const messageWait: ValueCodec<number> = {
  name: 'message wait',
  takes: `a number of ms from 0 to ${LONGEST}, a multiple of ${STEP}`,
  example: 0,
  write(writer, wait) {
    checkWait(wait)
    writer.text(DIGITS.charAt(wait / STEP))
  },
  read(reader) {
    const digit = DIGITS.indexOf(reader.text(1))
    return digit < 0 ? reader.fail('BAD_DIGIT', 'the message wait is one of 0 to F') : digit * STEP
  },
  size: () => 1,
}

/** The fields in front. */
export const frontShape = { command: field.text(2), messageWait: field.value(messageWait) } as const

/** @throws RequestError BAD_OPTION for a time that the frame cannot say */
export function checkWait(wait: number): void {
  if (Number.isInteger(wait) && wait >= 0 && wait <= LONGEST && wait % STEP === 0) return
  const message = `messageWait must be 0 to ${LONGEST} ms in steps of ${STEP}, is ${wait}.`
  throw new RequestError('BAD_OPTION', message, 'messageWait')
}

/** @throws RequestError BAD_OPTION for a time that the frame cannot say */
export function oneCFront(wait: number): Front {
  checkWait(wait)
  return {
    shape: frontShape,
    messageOf: ({ code }) => ({
      command: String.fromCharCode(code >> 8, code & 0xff),
      messageWait: wait,
    }),
    codeOf: ({ command }) => (typeof command === 'string' ? codeOf(command) : undefined),
  }
}

/** The number of a command by its two characters, as the manual prints it: BR is 4252H. */
export function codeOf(characters: string): number {
  return (characters.charCodeAt(0) << 8) | characters.charCodeAt(1)
}
