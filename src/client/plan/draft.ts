// A request to be, before anything is encoded.
import type { CommandName } from '../../melsec/commands/commands'
import type { Stretch } from './chunk'
import type { Piece } from './layout'

/** One request to be: the cells it asks for. */
export type Draft =
  | { readonly kind: 'direct'; readonly run: Stretch }
  | { readonly kind: 'random'; readonly runs: readonly Stretch[] }
  | { readonly kind: 'block'; readonly runs: readonly Stretch[] }

export interface PackOptions {
  /** Words that may be read in vain to merge near items. */
  readonly gap: number
  /** Commands the PLC has refused: not used again. */
  readonly without: ReadonlySet<CommandName>
  /** A piece of a bit device in bit units, so that nothing beside it is read; `undefined` when there is no such way. */
  readonly exact: (piece: Piece) => Piece | undefined
}

/** Bytes of the bodies of a draft, request and response together. */
export type BodyBytes = (draft: Draft) => number

export function firstItem({ members }: Stretch): number {
  let first = Number.POSITIVE_INFINITY
  for (const { item } of members) if (item < first) first = item
  return first
}

export function least(numbers: readonly number[]): number {
  let found = Number.POSITIVE_INFINITY
  for (const number of numbers) if (number < found) found = number
  return found
}

/** Numbers are asked for once for each, not with each comparison. */
export function sortedBy<T>(values: readonly T[], numberOf: (value: T) => number): T[] {
  return values
    .map((value) => ({ value, number: numberOf(value) }))
    .sort((a, b) => a.number - b.number)
    .map(({ value }) => value)
}

/** As the first of their items were given. */
export function inOrder(drafts: readonly Draft[]): Draft[] {
  return sortedBy(drafts, (draft) =>
    draft.kind === 'direct' ? firstItem(draft.run) : least(draft.runs.map((run) => firstItem(run))),
  )
}
