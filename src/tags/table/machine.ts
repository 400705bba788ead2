/**
 * One table for many equal machines: `{station}` stands for what differs in names, addresses and texts, and addresses move by an offset.
 * How an address moves is for its family of PLCs to say.
 */
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import { checkTags, PLACEHOLDER, type TagCheckOptions } from './check'
import type { Tag } from './tag'

/** What makes one machine different from the others. */
export interface TagMachine<Offset = number> {
  /** What stands in for `{station}` and others, by name. */
  readonly parameters?: Readonly<Record<string, string | number>>
  /** How far addresses move; what it looks like is for `move` to say. */
  readonly offset?: Offset
}

/**
 * The address so much further on, e.g. `D100:REAL` moved by 50 is `D150:REAL`; a family of PLCs gives it.
 * @throws RequestError for an address that cannot move so far
 */
export type MoveAddress<Offset = number> = (address: string, offset: Offset) => string

/**
 * The rows of a template for one machine.
 *
 * @param rows with `{station}` and other names in braces in `name`, `address`, `description`, `unit` and `scanClass`
 * @param move needed when the machine has an offset
 * @throws RequestError BAD_OPTION for a placeholder without a value and a value without a placeholder, and for rows that are no template
 * @example tagsOfMachine([{ name: 'm{station}.level', address: 'D{station}00:REAL' }], { parameters: { station: 3 } })
 *   // [{ name: 'm3.level', address: 'D300:REAL' }]
 */
export function tagsOfMachine<Offset = number>(
  rows: readonly Tag[],
  machine: TagMachine<Offset>,
  move?: MoveAddress<Offset>,
  options: Omit<TagCheckOptions, 'template'> = {},
): Tag[] {
  checkTags(rows, { template: true })
  const { parameters = {}, offset } = machine
  const used = new Set<string>()
  const fill = (text: string) =>
    text.replace(PLACEHOLDER, (whole, name: string) => {
      used.add(name)
      return parameterOf(parameters, name, whole)
    })
  const moved = moverOf(offset, move)
  const tags = rows.map((row): Tag => {
    const { description, unit, scanClass } = row
    return {
      ...row,
      name: fill(row.name),
      address: moved(fill(row.address)),
      ...(description === undefined ? {} : { description: fill(description) }),
      ...(unit === undefined ? {} : { unit: fill(unit) }),
      ...(scanClass === undefined ? {} : { scanClass: fill(scanClass) }),
    }
  })
  const unused = Object.keys(parameters).find((name) => !used.has(name))
  if (unused !== undefined && rows.length > 0) {
    throw new RequestError(
      'BAD_OPTION',
      `No tag has {${unused}}: leave this parameter out, or correct its name.`,
      unused,
    )
  }
  checkTags(tags, options)
  return tags
}

function parameterOf(parameters: NonNullable<TagMachine['parameters']>, name: string, whole: string): string {
  const value = Object.hasOwn(parameters, name) ? parameters[name] : undefined
  if (typeof value === 'string' || Number.isSafeInteger(value)) return String(value)
  const found = value === undefined ? 'has no value' : `is a text or a whole number, not ${show(value)}`
  throw new RequestError('BAD_OPTION', `${whole} ${found}: give it in parameters, as in { ${name}: 1 }.`, name)
}

function moverOf<Offset>(
  offset: Offset | undefined,
  move: MoveAddress<Offset> | undefined,
): (address: string) => string {
  if (offset === undefined) return (address) => address
  if (move !== undefined) return (address) => move(address, offset)
  throw new RequestError('BAD_OPTION', 'An offset needs the function that moves addresses.', 'offset')
}
