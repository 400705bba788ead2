// What a program must know of an end code beside its number, from small tables: the texts of the codes are elsewhere.
import { type EndCodeAbout, type EndCodeDetail, endCodeAbouts } from '../errors'
import type { NamedCommand } from './head-protocol'

/** One code, or the first and last of a range. */
export type Codes = readonly (number | readonly [from: number, to: number])[]

/** End codes of one family, by what they are about. A code that stands nowhere is about something unknown. */
export interface EndCodeTable {
  readonly about: { readonly [A in Exclude<EndCodeAbout, 'unknown'>]?: Codes }
  /**
   * Codes with which the request may have been carried out, all or in part: somebody on the way did not get the answer
   * in time, or it failed in the middle. So may it be with every code that stands nowhere.
   */
  readonly perhapsCarriedOut: Codes
}

/** What an `EndCodeError` says of the code, beside its texts. */
export type RefusalFacts = Pick<EndCodeDetail, 'about' | 'carriedOut' | 'command' | 'commandName'>

export interface EndCodeFacts {
  about(endCode: number): EndCodeAbout
  /** Of a command that got the code. */
  refusal(command: NamedCommand, endCode: number): RefusalFacts
}

/** @example endCodeFacts(table).refusal(commands.writeWords, 0xc056).about // 'item' */
export function endCodeFacts(table: EndCodeTable): EndCodeFacts {
  const known = new Map<number, EndCodeAbout>()
  for (const name of endCodeAbouts) {
    if (name !== 'unknown') for (const code of each(table.about[name] ?? [])) known.set(code, name)
  }
  const perhaps = new Set(each(table.perhapsCarriedOut))
  const about = (endCode: number): EndCodeAbout => known.get(endCode) ?? 'unknown'
  return {
    about,
    refusal({ name, title, effect }, endCode) {
      const changesNothing = effect === 'read' || effect === 'diagnose'
      const isRefused = changesNothing || (known.has(endCode) && !perhaps.has(endCode))
      return { command: title, commandName: name, about: about(endCode), ...(isRefused ? { carriedOut: false } : {}) }
    },
  }
}

/** What a message says became of a command. `code`: e.g. `end code C056`. */
export function endedWith({ carriedOut }: RefusalFacts, code: string): string {
  if (carriedOut === false) return `was refused with ${code}`
  return `ended with ${code}, which leaves open whether anything of it was carried out`
}

/** Every code of a list with ranges. */
export function each(codes: Codes): readonly number[] {
  return codes.flatMap((entry) =>
    typeof entry === 'number' ? [entry] : Array.from({ length: entry[1] - entry[0] + 1 }, (_, i) => entry[0] + i),
  )
}
