// All texts together. Loaded when the first code is explained (end-code.ts): most programs never meet one.
import { aCompatibleEndCodes } from './a-compatible'
import { cpuEndCodes } from './cpu'
import { cpuFileEndCodes } from './cpu-file'
import { cpuRouteEndCodes } from './cpu-route'
import type { EndCodeEntry } from './entry'
import { ethernetEndCodes } from './ethernet'
import { ethernetFunctionEndCodes } from './ethernet-function'
import { ethernetModuleEndCodes } from './ethernet-module'
import { ethernetModuleParameterEndCodes } from './ethernet-module-parameter'
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

export const endCodeEntries: readonly EndCodeEntry[] = [
  ...slmpEndCodes,
  ...routeAndPasswordEndCodes,
  ...cpuEndCodes,
  ...cpuRouteEndCodes,
  ...cpuFileEndCodes,
  ...aCompatibleEndCodes,
  ...serialEndCodes,
  ...serialFunctionEndCodes,
  ...inverterEndCodes,
  ...operationEndCodes,
  ...ethernetEndCodes,
  ...ethernetFunctionEndCodes,
  ...ethernetModuleEndCodes,
  ...ethernetModuleParameterEndCodes,
]

/** Entries by code; a range under every code of it. */
export const entryByCode: ReadonlyMap<number, EndCodeEntry> = new Map(
  endCodeEntries.flatMap((entry) =>
    Array.from(
      { length: (entry.to ?? entry.code) - entry.code + 1 },
      (_, index) => [entry.code + index, entry] as const,
    ),
  ),
)
