/** Items of a Sharp JW moved to other operands: for tables that serve many equal machines. */
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import { type JwKindName, jwKindNames } from '../../jw/operand/kind'
import type { JwOperandOptions } from '../../jw/operand/map'
import { advanceJw } from '../../jw/operand/place'
import { formatJwItem, parseJwItem } from './item'

/**
 * How far: every operand by so many steps, or each kind by its own; one that is not named stays. A step is what one number of the kind is: a bit of
 * relays, a byte of registers, a timer.
 */
export type JwOffset = number | { readonly [K in JwKindName]?: number }

/**
 * The item whose operand lies so many steps on, in one piece with it, in its shortest spelling. A bit of a byte, such as `09012.3`, moves by bytes, as
 * `D100.3` does in a MELSEC PLC.
 *
 * @throws RequestError BAD_ADDRESS and so on for what is no item, OUT_OF_RANGE when there is no such operand in one piece with it, BAD_OPTION for an offset
 *   that is no whole number from 0, or of no kind
 * @example moveJwItem('09770:INT', 8)                              // '19000:INT'
 * @example moveJwItem('004033', { relay: 8, register: 256 })       // '004043'
 */
export function moveJwItem(item: string, offset: JwOffset, options: JwOperandOptions = {}): string {
  checkOffset(offset)
  const parsed = parseJwItem(item, options)
  const { bit, ...whole } = parsed.operand
  const by = typeof offset === 'number' ? offset : (offset[whole.kind] ?? 0)
  if (by === 0) return item
  const operand = { ...advanceJw(whole, by, options), ...(bit === undefined ? {} : { bit }) }
  const moved = formatJwItem({ ...parsed, operand })
  // It may end behind the last operand there is.
  parseJwItem(moved, options)
  return moved
}

function checkOffset(offset: JwOffset): void {
  const offsets: unknown[] = typeof offset === 'object' && offset !== null ? Object.values(offset) : [offset]
  const at = offsets.findIndex((by) => typeof by !== 'number' || !Number.isSafeInteger(by) || by < 0)
  if (at >= 0) {
    const message = `An offset is a whole number of operands from 0, not ${show(offsets[at])}: let the table be that of the first machine.`
    throw new RequestError('BAD_OPTION', message, 'offset')
  }
  const unknown =
    typeof offset === 'object'
      ? Object.keys(offset).find((kind) => !jwKindNames.some((name) => name === kind))
      : undefined
  if (unknown === undefined) return
  throw new RequestError(
    'BAD_OPTION',
    `There is no kind ${show(unknown)} of operands to move; there is ${jwKindNames.join(', ')}.`,
    'offset',
  )
}
