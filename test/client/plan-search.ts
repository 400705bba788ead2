/**
 * The least that reading some items costs, by trying every way to distribute them over requests: for characters on a line as
 * well as for the number of requests. It knows the commands and asks the protocol what it takes, but nothing of the planner.
 */
import type { ParsedItem } from '../../src/client/item/item'
import type { PlanProtocol } from '../../src/client/plan/limit'
import { RequestError } from '../../src/errors'
import type { Exchange } from '../../src/link/link'
import { commands } from '../../src/melsec/commands/commands'
import { type DeviceName, deviceInfo } from '../../src/melsec/device/device'
import { wordsOf } from '../../src/value/value'

/** What a request costs; infinite for one that cannot be. */
export type CostOf = (exchange: Exchange<unknown>) => number

/** Each request costs the same. */
export const requestCost: CostOf = () => 1

/** Characters of both frames, without the DLEs that format 5 adds. */
export function characterCost(protocol: PlanProtocol): CostOf {
  return (exchange) => plainLength(exchange.write(0)) + protocol.answerBytes(exchange.answerBody() ?? 0)
}

const DLE = 0x10

/** Length of a request of format 5 without added DLEs; of any other as it is. */
function plainLength(frame: Buffer): number {
  if (frame[0] !== DLE) return frame.length
  let added = 0
  // Behind DLE STX, up to DLE ETX and, where there is one, the sum.
  const end = frame.length - (frame.at(-2) === DLE ? 2 : 4)
  for (let at = 2; at < end; at++) {
    if (frame[at] !== DLE) continue
    added++
    at++
  }
  return frame.length - added
}

/** The least sum over all partitions of `count` things, where `costOf` is asked for each set of them (bit `i`: thing `i`). */
export function leastPartition(count: number, costOf: (set: number) => number): number {
  const all = 2 ** count - 1
  const costs = Array.from({ length: all + 1 }, (_, set) => (set === 0 ? 0 : costOf(set)))
  const best = new Array<number>(all + 1).fill(Number.POSITIVE_INFINITY)
  best[0] = 0
  for (let set = 1; set <= all; set++) {
    // The part that holds the lowest thing.
    const lowest = set & -set
    for (let part = set; part > 0; part = (part - 1) & set) {
      if ((part & lowest) === 0) continue
      best[set] = Math.min(best[set] ?? 0, (costs[part] ?? 0) + (best[set ^ part] ?? 0))
    }
  }
  return best[all] ?? 0
}

/** The least sum over all ways to cut `count` things in a row; `costOf(from, to)`: things `from` to `to - 1` together. */
export function leastCut(count: number, costOf: (from: number, to: number) => number): number {
  const best = [0]
  for (let to = 1; to <= count; to++) {
    best.push(Math.min(...best.map((before, from) => before + costOf(from, to))))
  }
  return best[count] ?? 0
}

/** The least that reading the items costs; a Read or a block has at most `gap` words in a row that nobody wants. */
export function leastReading(
  items: readonly ParsedItem[],
  protocol: PlanProtocol,
  gap: number,
  costOf: CostOf = characterCost(protocol),
): number {
  return leastPartition(items.length, (set) =>
    leastRequest(
      items.filter((_, i) => (set & (1 << i)) !== 0),
      protocol,
      gap,
      costOf,
    ),
  )
}

/** Device numbers `from` to `to - 1`. */
interface Wanted {
  readonly device: DeviceName
  readonly from: number
  readonly to: number
}

function wantedOf({ address, type, digits, count = 1 }: ParsedItem): Wanted {
  const { device, number } = address
  const size = digits === undefined ? (type.name === 'BOOL' ? 1 : wordsOf(type)) : 4 * digits
  return { device, from: number, to: number + size * count }
}

/** Words of a bit device are counted by their first bit. */
function inWords({ device, from, to }: Wanted): Wanted {
  if (deviceInfo(device).unit !== 'bit') return { device, from, to }
  return { device, from: Math.floor(from / 16), to: Math.ceil(to / 16) }
}

function headOf({ device, from }: Wanted) {
  return { device, number: deviceInfo(device).unit === 'bit' ? 16 * from : from }
}

/** One request for all of them. */
function leastRequest(items: readonly ParsedItem[], protocol: PlanProtocol, gap: number, costOf: CostOf): number {
  const wanted = items.map(wantedOf)
  const runs = runsOf(wanted.map(inWords))
  const exchanges = [
    ...inOne(runs, gap).map((row) => () => protocol.exchange(commands.readWords, readOf(headOf(row), row))),
    ...inBits(wanted, runs, gap).map((row) => () => {
      const head = { device: row.device, number: row.from }
      return protocol.exchange(commands.readBits, readOf(head, row))
    }),
    () => protocol.exchange(commands.readRandom, randomOf(runs)),
    ...joinings(runs, gap).map((blocks) => () => protocol.exchange(commands.readBlock, blocksOf(blocks))),
  ]
  return Math.min(...exchanges.map((make) => cost(make, costOf)))
}

function cost(make: () => Exchange<unknown>, costOf: CostOf): number {
  try {
    return costOf(make())
  } catch (error) {
    if (error instanceof RequestError) return Number.POSITIVE_INFINITY
    throw error
  }
}

const readOf = (head: { device: DeviceName; number: number }, { from, to }: Wanted) => ({ head, points: to - from })

/** Rows without a gap, of each device apart. */
function runsOf(wanted: readonly Wanted[]): Wanted[] {
  const runs: Wanted[] = []
  for (const one of [...wanted].sort((a, b) =>
    a.device < b.device ? -1 : a.device > b.device ? 1 : a.from - b.from,
  )) {
    const last = runs.at(-1)
    if (last?.device === one.device && one.from <= last.to) {
      runs[runs.length - 1] = { ...last, to: Math.max(last.to, one.to) }
    } else runs.push(one)
  }
  return runs
}

/** All of it as one row, where gaps allow. */
function inOne(runs: readonly Wanted[], gap: number): Wanted[] {
  return joinings(runs, gap).flatMap((rows) => (rows.length === 1 ? rows : []))
}

/** Bits beside one another or in near words. */
function inBits(wanted: readonly Wanted[], words: readonly Wanted[], gap: number): Wanted[] {
  const [first] = wanted
  if (first === undefined || deviceInfo(first.device).unit !== 'bit' || inOne(words, gap).length === 0) return []
  const from = Math.min(...wanted.map((one) => one.from))
  return [{ device: first.device, from, to: Math.max(...wanted.map((one) => one.to)) }]
}

/** Every way to join neighbours whose gap is allowed. */
function joinings(runs: readonly Wanted[], gap: number): Wanted[][] {
  const [first, ...others] = runs
  if (first === undefined) return [[]]
  return others.reduce<Wanted[][]>(
    (found, run) =>
      found.flatMap((rows) => {
        const last = rows.at(-1)
        const apart = [...rows, run]
        if (last === undefined || last.device !== run.device || run.from - last.to > gap) return [apart]
        return [apart, [...rows.slice(0, -1), { ...last, to: run.to }]]
      }),
    [[first]],
  )
}

function randomOf(runs: readonly Wanted[]) {
  const words: { device: { device: DeviceName; number: number } }[] = []
  const doubleWords: typeof words = []
  for (const { device, from, to } of runs) {
    for (let at = from; at < to; at += 2) {
      const entry = { device: headOf({ device, from: at, to }) }
      if (at + 2 <= to) doubleWords.push(entry)
      else words.push(entry)
    }
  }
  return { words, doubleWords }
}

function blocksOf(rows: readonly Wanted[]) {
  const block = (row: Wanted) => readOf(headOf(row), row)
  const isBit = ({ device }: Wanted) => deviceInfo(device).unit === 'bit'
  return { wordBlocks: rows.filter((row) => !isBit(row)).map(block), bitBlocks: rows.filter(isBit).map(block) }
}

/** The least that writing the items costs in their order, nothing beside them written. */
export function leastWriting(
  items: readonly ParsedItem[],
  protocol: PlanProtocol,
  costOf: CostOf = characterCost(protocol),
): number {
  return leastCut(items.length, (from, to) => leastWrite(items.slice(from, to).map(writtenOf), protocol, costOf))
}

/** Devices `from` to `to - 1`, in words or bit by bit. */
interface Written extends Wanted {
  readonly inWords: boolean
}

function writtenOf(item: ParsedItem): Written {
  const wanted = wantedOf(item)
  const isBit = deviceInfo(wanted.device).unit === 'bit'
  const isWhole = item.type.name !== 'BOOL' && wanted.from % 16 === 0 && (wanted.to - wanted.from) % 16 === 0
  return { ...(isBit && isWhole ? inWords(wanted) : wanted), inWords: !isBit || isWhole }
}

/** One request for all of them. */
function leastWrite(items: readonly Written[], protocol: PlanProtocol, costOf: CostOf): number {
  const [first] = items
  if (first === undefined || items.some((item) => item.inWords !== first.inWords)) return Number.POSITIVE_INFINITY
  const runs = runsOf(items)
  const exchanges = first.inWords ? wordWrites(items, runs, protocol) : bitWrites(items, runs, protocol)
  return Math.min(...exchanges.map((make) => cost(make, costOf)))
}

function wordWrites(items: readonly Written[], runs: readonly Wanted[], protocol: PlanProtocol) {
  const values = ({ from, to }: Wanted) => new Array<number>(to - from).fill(0)
  const block = (row: Wanted) => ({ head: headOf(row), values: values(row) })
  const isBit = ({ device }: Wanted) => deviceInfo(device).unit === 'bit'
  // The two words of a number stay in one entry, so neighbours are not paired.
  const scattered = items.map((item) => randomOf([item]))
  const valued = (list: 'words' | 'doubleWords') =>
    scattered.flatMap((one) => one[list].map(({ device }) => ({ device, value: 0 })))
  return [
    ...(runs.length === 1 ? runs : []).map((row) => () => protocol.exchange(commands.writeWords, block(row))),
    () => protocol.exchange(commands.writeRandomWords, { words: valued('words'), doubleWords: valued('doubleWords') }),
    () =>
      protocol.exchange(commands.writeBlock, {
        wordBlocks: runs.filter((row) => !isBit(row)).map(block),
        bitBlocks: runs.filter(isBit).map(block),
      }),
  ]
}

function bitWrites(items: readonly Written[], runs: readonly Wanted[], protocol: PlanProtocol) {
  const [only, ...others] = runs
  const bits = items.flatMap(({ device, from, to }) =>
    Array.from({ length: to - from }, (_, i) => ({ device: { device, number: from + i }, value: false })),
  )
  const random = () => protocol.exchange(commands.writeRandomBits, { bits })
  if (only === undefined || others.length > 0) return [random]
  const { device, from, to } = only
  const values = new Array<boolean>(to - from).fill(false)
  const row = () => protocol.exchange(commands.writeBits, { head: { device, number: from }, values })
  if (from % 16 !== 0 || to % 16 !== 0) return [random, row]
  const words = { head: { device, number: from }, values: new Array<number>((to - from) / 16).fill(0) }
  return [random, row, () => protocol.exchange(commands.writeWords, words)]
}
