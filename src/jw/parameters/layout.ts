// Where each parameter stands: computed from the shapes of a map, for everybody who needs an address.
import { type Field, isVisible, measure, type Shape, takesOf } from '../../codec/codec'
import { parameterText } from './parameter-area'

/** Parameters that follow each other, from an address on. */
export interface ParameterSection {
  readonly address: number
  readonly shape: Shape
}

/** One parameter, reserved ones included. */
export interface ParameterLeaf {
  readonly address: number
  /** Bytes. */
  readonly length: number
  /** Path in the settings, e.g. `slaves.0.sendBytes`. */
  readonly path: string
  readonly name: string
  readonly field: Field
  /** The field alone, to be read by itself. */
  readonly shape: Shape
  /** In an element of a list: its name and which one, counting from 0. */
  readonly list?: string
  readonly index?: number
}

export function leavesOf({ address, shape }: ParameterSection): ParameterLeaf[] {
  return leavesFrom(address, shape, { prefix: '' })
}

interface Within {
  readonly prefix: string
  readonly list?: string
  readonly index?: number
}

function leavesFrom(start: number, shape: Shape, { prefix, ...within }: Within): ParameterLeaf[] {
  const leaves: ParameterLeaf[] = []
  let address = start
  for (const [name, field] of Object.entries(shape)) {
    const alone = { [name]: field }
    const length = sizeOf(alone)
    if (field.kind === 'list') {
      const size = sizeOf(field.item)
      for (let index = 0; index < length / size; index++)
        leaves.push(
          ...leavesFrom(address + index * size, field.item, { prefix: `${name}.${index}.`, list: name, index }),
        )
    } else leaves.push({ address, length, path: `${prefix}${name}`, name, field, shape: alone, ...within })
    address += length
  }
  return leaves
}

function sizeOf(shape: Shape): number {
  return measure(shape, { ascii: false, form: 0 })
}

/** A row of the documentation. */
export interface ParameterTableRow {
  /** Octal, of the first and the last byte; of a list that of its first element and how it goes on. */
  readonly address: string
  readonly setting: string
  readonly takes: string
  readonly doc: string
}

/** The parameters for a table: of a list the first element stands for all. */
export function parameterTable(leaves: readonly ParameterLeaf[]): readonly ParameterTableRow[] {
  return leaves
    .filter(({ index = 0 }) => index === 0)
    .map((leaf) => {
      const { name, list, field, shape } = leaf
      const setting = list === undefined ? name : `${list}[n].${name}`
      const reserved = !isVisible(field)
      return {
        address: addressText(leaf, leaves),
        setting: reserved ? '' : setting,
        takes: reserved ? 'reserved, 0' : (takesOf(shape, name) ?? ''),
        doc: field.doc ?? '',
      }
    })
}

function addressText({ address, length, list, name }: ParameterLeaf, leaves: readonly ParameterLeaf[]): string {
  const first = parameterText(address)
  const range = length === 1 ? first : `${first}-${parameterText(address + length - 1)}`
  const next = leaves.find((leaf) => list !== undefined && leaf.list === list && leaf.name === name && leaf.index === 1)
  if (next === undefined) return range
  const step = next.address - address
  return `${range} + ${step === 1 ? '' : step}n`
}
