import type { EndCodeFamily } from '../../errors'

/** Families of end codes that have texts. */
export const melsecEndCodeFamilies = ['slmp', '1E', '1C'] as const satisfies readonly EndCodeFamily[]
/** Families of end codes that there are texts for. */
export type MelsecEndCodeFamily = (typeof melsecEndCodeFamilies)[number]

export function isMelsecFamily(family: EndCodeFamily): family is MelsecEndCodeFamily {
  return melsecEndCodeFamilies.some((known) => known === family)
}
