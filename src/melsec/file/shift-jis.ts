// File names of Q and L are text in Shift-JIS (SLMP reference manual 5.8, File name).
import { decodePage, encodePage } from '../../basics/code-page'

const CODE = 'cp932'

/** The bytes, one character U+0000 to U+00FF each; `undefined` when a character does not exist in Shift-JIS. */
export function toShiftJis(text: string): string | undefined {
  const bytes = encodePage(text, CODE)
  // Reading back what will be written is the one test that holds for every character: no '?' gets through.
  return decodePage(bytes, CODE) === text ? bytes.toString('latin1') : undefined
}

/** The text; U+FFFD for bytes that are none, which no name that is written can hold. */
export function fromShiftJis(bytes: string): string {
  return decodePage(Buffer.from(bytes, 'latin1'), CODE)
}
