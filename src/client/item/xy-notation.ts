// X and Y of a PLC nobody knows: refused where octal and hexadecimal mean different inputs and outputs.
import { RequestError } from '../../errors'
import { type ParsedItem, tryParseItem } from './item'
import type { Item } from './parts'

/**
 * Only the profile tells whether X10 is the 8th or the 16th input, and a wrong guess switches another output.
 *
 * Where both notations say the same (X0 to X7, `X0[16]`, link direct devices), there is nothing to guess.
 *
 * @throws RequestError BAD_ADDRESS
 */
export function refuseAmbiguousXy(item: Item, parsed: ParsedItem): void {
  const { device } = parsed.address
  if (device !== 'X' && device !== 'Y') return
  const octal = tryParseItem(item, { xyRadix: 8 })
  const hexadecimal = tryParseItem(item, { xyRadix: 16 })
  if (!('error' in octal) && !('error' in hexadecimal)) {
    if (octal.address.number === hexadecimal.address.number && octal.count === hexadecimal.count) return
  }
  throw new RequestError(
    'BAD_ADDRESS',
    `${device} numbers from 10 on are octal on iQ-F and FX and hexadecimal elsewhere, and the profile generic does not say which. ` +
      'Set the profile (iq-r, iq-f, q, l) or xyRadix to 8 or 16.',
    'xyRadix',
  )
}
