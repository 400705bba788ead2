// Devices of one kind in one place, and by which commands they can be reached: the ground both planners stand on.
import { RequestError } from '../../errors'
import { type CommandName, commands } from '../../melsec/commands/commands'
import type { DeviceUse } from '../../melsec/device/access'
import { formatDevice } from '../../melsec/device/address'
import { type DeviceAddress, type DeviceInfo, deviceInfo } from '../../melsec/device/device'
import type { DeviceForm } from '../../melsec/device/device-form'
import { type FormProblem, formOrProblem } from '../../melsec/device/form'
import { tallyOf } from '../../melsec/device/limit'
import { doubtfulUse, doubtOf, type Profile } from '../../melsec/profiles/profile'
import { boundsOf, fits, type Load, largest, type PlanProtocol } from './limit'

/** What a cell of an area is: one bit, one word (of a bit device its 16 points), or all words of a device of several. */
export type CellKind = 'bit' | 'word' | 'record'

/** The command for cells in a row, for scattered cells and for blocks, as far as the area has them. */
export interface Ways {
  readonly form: DeviceForm
  /** Cells in a row. */
  readonly direct?: 'readWords' | 'readBits' | 'writeWords' | 'writeBits'
  /** The list of the random command its cells stand in; words in a row may stand in pairs as double words. */
  readonly random?: 'words' | 'doubleWords' | 'bits'
  readonly block?: 'wordBlocks' | 'bitBlocks'
}

/** Devices of one kind in one place, counted in cells. Cells of one area can go into one request. */
export interface Area {
  readonly key: string
  readonly info: DeviceInfo
  readonly kind: CellKind
  readonly template: DeviceAddress
  /** Device number of cell 0. */
  readonly base: number
  readonly numbersPerCell: 1 | 16
  readonly bitsPerCell: number
  /** Field of a load for its points, where a limit counts this device in another way than the others. */
  readonly tally?: string
  readonly ways: Ways
}

export type Direction = 'read' | 'write'

/** An index register, `@`, or a network or module that is indexed: only the PLC knows which device it is. */
export function isModified({ index, indirect, extensionIndex }: DeviceAddress): boolean {
  return index !== undefined || indirect !== undefined || extensionIndex !== undefined
}

/** In a network module or a buffer memory, or modified: such addresses never share a request with ordinary ones. */
export function isExtended(address: DeviceAddress): boolean {
  return address.extension !== undefined || isModified(address)
}

/** Areas with the same group may share a request. */
export function groupOf({ ways, template }: Area): string {
  return `${ways.form} ${isExtended(template) ? 'extended' : 'ordinary'}`
}

export function addressAt(area: Area, cell: number): DeviceAddress {
  return { ...area.template, number: area.base + cell * area.numbersPerCell }
}

/** Words of the answer per cell, for cells of whole words. */
export function wordsPerCell(area: Area): number {
  return area.bitsPerCell / 16
}

type Try = (use: DeviceUse) => DeviceForm | FormProblem

/** What is modified has no known neighbours: each address is an area of its own. */
export function areaKey(kind: CellKind, address: DeviceAddress): string {
  return `${kind} ${formatDevice(isModified(address) ? address : { ...address, number: 0 }, { xyRadix: 16 })}`
}

/**
 * The area of a device, or why it cannot be reached.
 * @throws RequestError of the command that would have been the natural one.
 */
export function areaOf(protocol: PlanProtocol, direction: Direction, kind: CellKind, address: DeviceAddress): Area {
  const info = deviceInfo(address.device)
  const template = { ...address, number: 0 }
  return {
    key: areaKey(kind, address),
    info,
    kind,
    template,
    base: isModified(address) ? address.number : 0,
    numbersPerCell: kind === 'word' && info.unit === 'bit' ? 16 : 1,
    bitsPerCell: kind === 'bit' ? 1 : kind === 'word' ? 16 : 16 * (info.wordsPerDevice ?? 2),
    ...(countedTwice(protocol.profile, info) ? { tally: tallyOf(info.name) } : {}),
    ways: waysOf(protocol, direction, kind, template),
  }
}

function countedTwice({ limits }: Profile, { name }: DeviceInfo): boolean {
  return limits.some(({ twice }) => twice?.includes(name) === true)
}

function tried(protocol: PlanProtocol, address: DeviceAddress, use: DeviceUse): DeviceForm | FormProblem {
  return formOrProblem(protocol.profile, commands[use.command], [{ field: '', address, use }], protocol.code, 0)
}

const USES = {
  read: { word: 'readWords', bit: 'readBits', randomWords: 'readRandom', randomBits: undefined, block: 'readBlock' },
  write: {
    word: 'writeWords',
    bit: 'writeBits',
    randomWords: 'writeRandomWords',
    randomBits: 'writeRandomBits',
    block: 'writeBlock',
  },
} as const

function waysOf(protocol: PlanProtocol, direction: Direction, kind: CellKind, address: DeviceAddress): Ways {
  const uses = USES[direction]
  const info = deviceInfo(address.device)
  const attempt: Try = (use) => tried(protocol, address, use)
  const directCommand = kind === 'bit' ? uses.bit : uses.word
  const direct = attempt({ command: directCommand, points: kind === 'record' ? (info.wordsPerDevice ?? 2) : 1 })
  const randomCommand = kind === 'bit' ? uses.randomBits : uses.randomWords
  const list = kind === 'record' ? 'doubleWords' : 'words'
  const random =
    randomCommand === undefined
      ? undefined
      : attempt({ command: randomCommand, ...(kind === 'bit' ? {} : ({ list } as const)) })
  const form = formIn(direct) ?? formIn(random)
  if (form === undefined) throw refusalOf(isModified(address) ? [random, direct] : [direct, random])
  const freely = randomCommand === undefined || chosenFreely(protocol, randomCommand, info, direct)
  // Blocks are written only to save characters: fewer requests than Write Random they do not make.
  const hasBlock = formIn(direct) !== undefined && (direction === 'read' || protocol.lineCost !== undefined)
  const block = hasBlock ? blockOf(protocol, uses.block, kind, info, form, attempt) : undefined
  return {
    form,
    ...(formIn(direct) === undefined ? {} : { direct: directCommand }),
    ...(formIn(random) === form && freely ? { random: kind === 'bit' ? 'bits' : list } : {}),
    ...(block === undefined ? {} : { block }),
  }
}

type Tried = ReturnType<Try> | undefined

function formIn(result: Tried): DeviceForm | undefined {
  return typeof result === 'string' ? result : undefined
}

function refusalOf(tried: readonly Tried[]): RequestError {
  const problem = tried.find((result): result is FormProblem => typeof result === 'object')
  return new RequestError(problem?.code ?? 'UNSUPPORTED', problem?.message ?? 'No command takes it.', problem?.field)
}

/** A command that not every CPU of the family has, or not for the device, is taken only where nothing else does it. */
function chosenFreely(protocol: PlanProtocol, command: CommandName, info: DeviceInfo, direct: Tried): boolean {
  return !isDoubtful(protocol.profile, command, info) || formIn(direct) === undefined
}

function isDoubtful(profile: Profile, command: CommandName, { name }: DeviceInfo): boolean {
  return doubtOf(profile, command) !== undefined || doubtfulUse(profile, command, name) !== undefined
}

function blockOf(
  protocol: PlanProtocol,
  command: 'readBlock' | 'writeBlock',
  kind: CellKind,
  info: DeviceInfo,
  form: DeviceForm,
  attempt: Try,
): Ways['block'] {
  if (kind !== 'word' || isDoubtful(protocol.profile, command, info)) return undefined
  const list = info.unit === 'bit' ? 'bitBlocks' : 'wordBlocks'
  return attempt({ command, list, points: 1 }) === form ? list : undefined
}

/** A load of so many points, with what a limit counts of them beside. */
export function withTally({ tally }: Area, load: Load, points: number): Load {
  return tally === undefined ? load : { ...load, [tally]: points }
}

/** Points of the random command for cells in a row: words in pairs, because a pair counts as one point. */
export function randomLoad(area: Area, cells: number): Load {
  switch (area.ways.random) {
    case 'words': {
      const [words, doubleWords] = [cells % 2, Math.floor(cells / 2)]
      return withTally(area, { words, doubleWords }, words + doubleWords)
    }
    case 'doubleWords':
      return withTally(area, { doubleWords: cells }, cells)
    default:
      return { bits: cells }
  }
}

export function blockLoad(area: Area, cells: number): Load {
  return area.ways.block === 'bitBlocks'
    ? { bitBlocks: 1, 'bitBlocks.points': cells }
    : { wordBlocks: 1, 'wordBlocks.points': cells }
}

/** The field of the direct command that holds its points. */
export function directLoad(area: Area, cells: number): Load {
  const points = area.kind === 'bit' ? cells : cells * wordsPerCell(area)
  return { points, values: points }
}

export function randomCommandOf(area: Area, direction: Direction): CommandName {
  const { randomBits, randomWords } = USES[direction]
  return area.kind === 'bit' && randomBits !== undefined ? randomBits : randomWords
}

/** Of what its devices are, where a limit depends on it. */
export function limitedUnit({ info }: Area): 'bit' | 'word' {
  return info.unit === 'bit' ? 'bit' : 'word'
}

/** Cells in a row that one request carries. */
export function capacityOf(protocol: PlanProtocol, direction: Direction, area: Area): number {
  const { direct, form } = area.ways
  if (direct !== undefined) {
    const bounds = boundsOf(protocol, direct, form, limitedUnit(area))
    return largest((cells) => fits(bounds, directLoad(area, cells)))
  }
  const bounds = boundsOf(protocol, randomCommandOf(area, direction), form)
  return largest((cells) => fits(bounds, randomLoad(area, cells)))
}
