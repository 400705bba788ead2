// Which MELSEC-Q modules Extend Unit (0601, 1601) reaches, and how their buffer memory is addressed there
// (SLMP reference manual 5.5). Other modules: module access devices, U3\G100.
import { badOption } from '../basics/option-checks'
import { RequestError } from '../errors'

/** Modules that are addressed alike. */
export interface ExtendUnitInfo {
  /** Model names of the module. */
  readonly models: readonly string[]
  /** Start address of the buffer memory, bytes. */
  readonly startAddress: number
  /**
   * "Module No. when mounted on slot 0". `undefined`: the cell is not legible in the edition at hand, so it must be said.
   */
  readonly slot0: number | undefined
}

function row(startAddress: number, slot0: number | undefined, ...models: string[]): ExtendUnitInfo {
  return { models, startAddress, slot0 }
}

// The column of slot 0 is merged over rows: from QD35ID1 on 0 (Q64TCTTBW and Q64TCRTBW 1), from QD72P3C3 on 0. In between
// a 1 is printed beside QD60P8-G, and how far down it holds cannot be seen; QD70D4 and QD70D8 have 1 of their own.
/** Modules whose buffer memory the Extend Unit commands name by model, with where it starts. */
export const extendUnits: readonly ExtendUnitInfo[] = [
  row(0x4000, 0, 'QD35ID1', 'QD35ID2'),
  row(0x1008, 0, 'Q62AD-DGH', 'Q64AD', 'Q64AD-GH', 'Q66AD-DG', 'Q68AD-G', 'Q68ADV', 'Q68ADI'),
  row(0x1008, 0, 'Q62DA', 'Q62DA-FG', 'Q62DAN', 'Q64DA', 'Q64DAN', 'Q66DA-G'),
  row(0x1008, 0, 'Q68DAV', 'Q68DAI', 'Q68DAVN', 'Q68DAIN'),
  row(0x2000, 0, 'Q64AD2DA'),
  row(0x10000, 0, 'Q62HLC'),
  row(0x1000, 0, 'Q64TCTT', 'Q64TCRT'),
  row(0x2000, 0, 'Q61LD'),
  row(0x1000, 1, 'Q64TCTTBW', 'Q64TCRTBW'),
  row(0x2000, 0, 'Q64TD (function version B)', 'Q64RD (function version B)'),
  row(0x8000, 0, 'Q64TD (function version C)', 'Q64TDV-GH', 'Q64RD (function version C)', 'Q64RD-G'),
  row(0x1008, 0, 'Q68TD-G-H01', 'Q68TD-G-H02'),
  row(0x1008, 0, 'Q68RD3-G'),
  row(0x10000, 0, 'QD51', 'QD51-R24'),
  row(0x2000, undefined, 'QD60P8-G'),
  row(0x3c, undefined, 'QD62', 'QD62E', 'QD62D'),
  row(0x2000, undefined, 'QD63P6'),
  row(0x2000, undefined, 'QD64D2'),
  row(0x5000, undefined, 'QD70P4', 'QD70P8'),
  row(0x5000, 1, 'QD70D4', 'QD70D8'),
  row(0x5000, 0, 'QD72P3C3'),
  row(0x10000, 0, 'QD75P1', 'QD75P2', 'QD75P4', 'QD75D1', 'QD75D2', 'QD75D4'),
  row(0x10000, 0, 'QD75M1', 'QD75M2', 'QD75M4', 'QD75MH1', 'QD75MH2', 'QD75MH4'),
  row(0x10000, 0, 'QD81DL96'),
  row(0x10000, 0, 'QJ61BT11', 'QJ61BT11N'),
  row(0x1b4, 0, 'QJ61CL12'),
  row(0x10000, 0, 'QJ71C24N', 'QJ71C24N-R2', 'QJ71C24N-R4', 'QJ71C24', 'QJ71C24-R2'),
  row(0x10000, 0, 'QJ71AS92'),
  row(0x10000, 0, 'QJ71CMO', 'QJ71CMON'),
  row(0x10000, 0, 'QJ71E71-100', 'QJ71E71-B5', 'QJ71E71-B2'),
  row(0x10000, 0, 'QJ71FL71-T', 'QJ71FL71-B5', 'QJ71FL71-B2', 'QJ71FL71-F01'),
  row(0x10000, 0, 'QJ71MES96'),
  row(0x10000, 0, 'QJ71WS96'),
]

/** Where a module is. */
export interface ModulePlace {
  /** Start I/O number as GX Works shows it, a multiple of 10H: X/Y 30 to 4F is `0x30`. */
  readonly startIo: number
  /** "Module No. when mounted on slot 0", for modules whose cell in the manual is not legible. */
  readonly slot0?: number
}

/** A module as Extend Unit addresses it. */
export interface ExtendUnit {
  readonly model: string
  readonly startAddress: number
  readonly moduleNumber: number
}

const LAST_START_IO = 0xff0
const LAST_ADDRESS = 0xffffffff

/**
 * @throws RequestError BAD_OPTION when the module is not in the table, or its place cannot be
 * @example extendUnitOf('Q62DA', { startIo: 0x30 }) // { startAddress: 0x1008, moduleNumber: 3, ... }
 */
export function extendUnitOf(model: string, { startIo, slot0 }: ModulePlace): ExtendUnit {
  const found = infoOf(model)
  if (!Number.isInteger(startIo) || startIo < 0 || startIo > LAST_START_IO || startIo % 16 !== 0) {
    badOption(
      'startIo',
      `startIo is ${String(startIo)}; it is a multiple of 16 from 0 to 0xFF0, as X/Y 30 to 4F has 0x30.`,
    )
  }
  const first = slot0 ?? found.info.slot0
  if (first === undefined) {
    badOption(
      'slot0',
      `The module No. of ${found.model} on slot 0 is not legible in the manual at hand: look it up in the table of Extend ` +
        'Unit in your SLMP manual and give it as slot0 (0 or 1). A wrong one would reach another module.',
    )
  }
  if (first !== 0 && first !== 1) badOption('slot0', `slot0 is ${String(first)}; it is 0 or 1.`)
  if (slot0 !== undefined && found.info.slot0 !== undefined && slot0 !== found.info.slot0) {
    badOption('slot0', `slot0 is ${slot0}, but of ${found.model} it is ${found.info.slot0}: leave it out.`)
  }
  return { model: found.model, startAddress: found.info.startAddress, moduleNumber: startIo / 16 + first }
}

function infoOf(model: string): { readonly model: string; readonly info: ExtendUnitInfo } {
  const wanted = String(model).trim().toUpperCase()
  for (const info of extendUnits) {
    const name = info.models.find((known) => known.toUpperCase() === wanted)
    if (name !== undefined) return { model: name, info }
  }
  const versions = extendUnits
    .flatMap(({ models }) => models)
    .filter((name) => name.toUpperCase().startsWith(`${wanted} (`))
  return badOption(
    'model',
    versions.length > 0
      ? `${wanted} differs by its function version: say ${versions.join(' or ')}.`
      : `Extend Unit does not know the module ${JSON.stringify(String(model).slice(0, 40))}. Use module access devices instead, e.g. U3\\G100.`,
  )
}

/** Byte address of a word of the buffer memory. @throws RequestError OUT_OF_RANGE */
export function byteAddressOf(unit: ExtendUnit, address: number): number {
  const bytes = 2 * address + unit.startAddress
  if (Number.isInteger(address) && address >= 0 && bytes <= LAST_ADDRESS) return bytes
  throw new RequestError(
    'OUT_OF_RANGE',
    `${String(address)} is not a buffer memory address of ${unit.model}.`,
    'address',
  )
}
