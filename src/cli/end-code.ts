// End codes as the manuals and GX Works write them.
import { endCodeDigits } from '../basics/end-code-digits'
import { type EndCodeFamily, RequestError } from '../index'

/**
 * Up to four hexadecimal digits, also as `0xC059` and `C059H`.
 * @throws RequestError BAD_VALUE
 */
export function endCodeOf(text: string): number {
  const [, digits] = /^(?:0x)?([0-9a-f]{1,4})h?$/i.exec(text.trim()) ?? []
  if (digits !== undefined) return Number.parseInt(digits, 16)
  throw new RequestError(
    'BAD_VALUE',
    `${JSON.stringify(text)} is no end code: write up to four hexadecimal digits, e.g. C056.`,
    'end code',
  )
}

/** e.g. `C059H`; of 1E and 1C frames `5BH` */
export function endCodeText(endCode: number, family: EndCodeFamily = 'slmp'): string {
  return `${endCodeDigits(endCode, family)}H`
}
