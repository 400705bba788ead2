// All texts together. Loaded when the first code is explained (end-code.ts): most programs never meet one.
import { each } from '../../link/link'
import { endCodes1c, endCodes1e, onlineChangeOff } from './a-compatible'
import { cpuEndCodes } from './cpu'
import { cpuFileEndCodes } from './cpu-file'
import { cpuRouteEndCodes } from './cpu-route'
import type { EndCodeEntry } from './entry'
import { ethernetEndCodes } from './ethernet'
import { ethernetFunctionEndCodes } from './ethernet-function'
import { ethernetModuleEndCodes } from './ethernet-module'
import { ethernetModuleParameterEndCodes } from './ethernet-module-parameter'
import type { MelsecEndCodeFamily } from './family'
import { inverterEndCodes } from './inverter'
import { operationEndCodes } from './operation'
import { routeAndPasswordEndCodes } from './route-and-password'
import { serialEndCodes } from './serial'
import { serialFunctionEndCodes } from './serial-function'
import { slmpEndCodes } from './slmp'

export { endCodeGroups } from './groups'
export { endCodeHints } from './hints'
export { placesOf } from './places'
export { remedies } from './remedies'

/** By family. */
export const endCodeEntries: Readonly<Record<MelsecEndCodeFamily, readonly EndCodeEntry[]>> = {
  slmp: [
    onlineChangeOff,
    ...slmpEndCodes,
    ...routeAndPasswordEndCodes,
    ...cpuEndCodes,
    ...cpuRouteEndCodes,
    ...cpuFileEndCodes,
    ...serialEndCodes,
    ...serialFunctionEndCodes,
    ...inverterEndCodes,
    ...operationEndCodes,
    ...ethernetEndCodes,
    ...ethernetFunctionEndCodes,
    ...ethernetModuleEndCodes,
    ...ethernetModuleParameterEndCodes,
  ],
  '1E': endCodes1e,
  '1C': endCodes1c,
}

/** Entries by code; a range under every code of it. */
export const entryByCode: Readonly<Record<MelsecEndCodeFamily, ReadonlyMap<number, EndCodeEntry>>> = {
  slmp: byCode(endCodeEntries.slmp),
  '1E': byCode(endCodes1e),
  '1C': byCode(endCodes1c),
}

function byCode(entries: readonly EndCodeEntry[]): ReadonlyMap<number, EndCodeEntry> {
  return new Map(
    entries.flatMap((entry) => {
      const codes = each([[entry.code, entry.to ?? entry.code]])
      return codes.map((code) => [code, entry] as const)
    }),
  )
}
