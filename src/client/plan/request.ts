// From a draft to a request that can be sent again and again, and from its answer to words in a row.

import type { Exchange } from '../../link/link'
import { type CommandName, commands } from '../../melsec/commands/commands'
import { type AddressOptions, formatDevice } from '../../melsec/device/address'
import type { DeviceAddress } from '../../melsec/device/device'
import type { DeviceForm } from '../../melsec/device/device-form'
import { subcommandOf } from '../../melsec/device/form'
import type { Words } from '../../value/value'
import { type Area, addressAt, wordsPerCell } from './area'
import type { Stretch } from './chunk'
import type { PlanProtocol } from './limit'
import type { Draft } from './pack'

/** Sends one request and resolves with what it answered. It may be called again before the last answer has come. */
export type SendExchange = <T>(exchange: Exchange<T>) => Promise<T>

/** One request as people see it. */
export interface RequestDescription {
  readonly command: CommandName
  /** Form of the device specification; label commands have none. */
  readonly form?: DeviceForm
  readonly subcommand: number
  readonly points: number
  /** Bytes of the whole frame; missing while it depends on types of labels that the PLC has not said yet. */
  readonly requestBytes?: number
  /** Bytes of the whole frame of a success; missing likewise. */
  readonly responseBytes?: number
  /** Texts of the items it is for. */
  readonly items: readonly string[]
  /** e.g. `Read (word units): D100 to D149, 50 points` */
  readonly text: string
}

/** One request of any plan. */
export interface Prepared {
  readonly command: CommandName
  readonly form: DeviceForm
  readonly points: number
  readonly exchange: Exchange<unknown>
  /** What it does, without the command. */
  readonly text: string
}

/** A request that reads words (bits are packed into words, the first in bit 0). */
export interface PreparedRead extends Prepared {
  /** Bit of the words at which each run starts. */
  readonly offsets: ReadonlyMap<Stretch, number>
  fetch(send: SendExchange): Promise<Words>
}

/** @throws RequestError when the request cannot be sent. */
export function prepareRead(protocol: PlanProtocol, draft: Draft, options: AddressOptions): PreparedRead {
  switch (draft.kind) {
    case 'direct':
      return draft.run.area.kind === 'bit'
        ? readBits(protocol, draft.run, options)
        : readWords(protocol, draft.run, options)
    case 'random':
      return readRandom(protocol, draft.runs)
    case 'block':
      return readBlock(protocol, draft.runs)
    default:
      return draft satisfies never
  }
}

/** First and last device, e.g. `D100 to D149`. */
export function rangeText(area: Area, from: number, to: number, options: AddressOptions): string {
  const first = addressAt(area, from)
  const last: DeviceAddress = { ...first, number: addressAt(area, to).number - 1 }
  const text = formatDevice(first, options)
  return last.number === first.number ? text : `${text} to ${formatDevice(last, options)}`
}

export function pointsText(points: number, unit = 'point'): string {
  return `${points} ${unit}${points === 1 ? '' : 's'}`
}

function readWords(protocol: PlanProtocol, run: Stretch, options: AddressOptions): PreparedRead {
  const { area, from, to } = run
  const points = (to - from) * wordsPerCell(area)
  const exchange = protocol.exchange(commands.readWords, { head: addressAt(area, from), points })
  return {
    command: 'readWords',
    form: area.ways.form,
    points,
    exchange,
    text: `${rangeText(area, from, to, options)}, ${pointsText(points)}`,
    offsets: new Map([[run, 0]]),
    fetch: async (send) => (await send(exchange)).values,
  }
}

function readBits(protocol: PlanProtocol, run: Stretch, options: AddressOptions): PreparedRead {
  const { area, from, to } = run
  const points = to - from
  const exchange = protocol.exchange(commands.readBits, { head: addressAt(area, from), points })
  return {
    command: 'readBits',
    form: area.ways.form,
    points,
    exchange,
    text: `${rangeText(area, from, to, options)}, ${pointsText(points)}`,
    offsets: new Map([[run, 0]]),
    fetch: async (send) => wordsOfBits((await send(exchange)).values),
  }
}

function wordsOfBits(bits: readonly boolean[]): number[] {
  const words = new Array<number>(Math.ceil(bits.length / 16)).fill(0)
  bits.forEach((bit, i) => {
    if (bit) words[i >> 4] = (words[i >> 4] ?? 0) | (1 << (i & 15))
  })
  return words
}

/** Words of a run: a double word for each pair or record, a word for what is left. */
interface Scatter {
  readonly words: { readonly device: DeviceAddress }[]
  readonly doubleWords: { readonly device: DeviceAddress }[]
  /** Index among the words of the answer for each of them. */
  readonly wordAt: number[]
  readonly doubleWordAt: number[]
  length: number
}

function scatter(run: Stretch, into: Scatter): number {
  const { area, from, to } = run
  const start = into.length
  const size = wordsPerCell(area)
  const pair = area.ways.random === 'doubleWords' ? 1 : 2
  for (let cell = from; cell < to; cell += pair) {
    const device = addressAt(area, cell)
    const at = start + (cell - from) * size
    if (cell + pair > to) {
      into.words.push({ device })
      into.wordAt.push(at)
    } else {
      into.doubleWords.push({ device })
      into.doubleWordAt.push(at)
    }
  }
  into.length = start + (to - from) * size
  return 16 * start
}

function readRandom(protocol: PlanProtocol, runs: readonly Stretch[]): PreparedRead {
  const all: Scatter = { words: [], doubleWords: [], wordAt: [], doubleWordAt: [], length: 0 }
  const offsets = new Map(runs.map((run) => [run, scatter(run, all)]))
  const { words, doubleWords } = all
  const exchange = protocol.exchange(commands.readRandom, { words, doubleWords })
  return {
    command: 'readRandom',
    form: formOf(runs),
    points: words.length + doubleWords.length,
    exchange,
    text: `${pointsText(words.length, 'word')}, ${pointsText(doubleWords.length, 'double word')}`,
    offsets,
    fetch: async (send) => gathered(all, await send(exchange)),
  }
}

function gathered(
  { wordAt, doubleWordAt, length }: Scatter,
  answer: { readonly words: readonly number[]; readonly doubleWords: readonly number[] },
): number[] {
  const words = new Array<number>(length).fill(0)
  answer.words.forEach((word, i) => {
    words[wordAt[i] ?? 0] = word
  })
  answer.doubleWords.forEach((value, i) => {
    const at = doubleWordAt[i] ?? 0
    words[at] = value & 0xffff
    words[at + 1] = value >>> 16
  })
  return words
}

function readBlock(protocol: PlanProtocol, runs: readonly Stretch[]): PreparedRead {
  const wordRuns = runs.filter(({ area }) => area.ways.block !== 'bitBlocks')
  const bitRuns = runs.filter(({ area }) => area.ways.block === 'bitBlocks')
  const block = ({ area, from, to }: Stretch) => ({ head: addressAt(area, from), points: to - from })
  const exchange = protocol.exchange(commands.readBlock, {
    wordBlocks: wordRuns.map(block),
    bitBlocks: bitRuns.map(block),
  })
  const offsets = new Map<Stretch, number>()
  let points = 0
  for (const run of [...wordRuns, ...bitRuns]) {
    offsets.set(run, 16 * points)
    points += run.to - run.from
  }
  return {
    command: 'readBlock',
    form: formOf(runs),
    points,
    exchange,
    text: `${pointsText(wordRuns.length, 'word block')}, ${pointsText(bitRuns.length, 'bit block')}, ${pointsText(points)}`,
    offsets,
    fetch: async (send) => {
      const answer = await send(exchange)
      return [...answer.wordBlocks, ...answer.bitBlocks].flat()
    },
  }
}

function formOf(runs: readonly Stretch[]): DeviceForm {
  return runs[0]?.area.ways.form ?? 'short'
}

/** Bytes of the bodies of request and answer. */
export function bodyBytes({ exchange }: Prepared): number {
  return exchange.body.length + (exchange.answerBody() ?? 0)
}

export function describePrepared(
  protocol: PlanProtocol,
  prepared: Prepared,
  items: readonly string[],
): RequestDescription {
  const { command, form, points, exchange, text } = prepared
  const { profile } = protocol
  return {
    command,
    form,
    subcommand: subcommandOf(commands[command], form, profile),
    points,
    requestBytes: exchange.write(0).length,
    responseBytes: protocol.answerBytes(exchange.answerBody() ?? 0),
    items,
    text: `${exchange.title}: ${text}`,
  }
}

/** A plan for people to read. */
export interface PlanDescription {
  readonly requests: readonly RequestDescription[]
  readonly notes: readonly string[]
}

/** A plan as text: one line for each request, then the notes. */
export function planText({ requests, notes }: PlanDescription): string {
  const lines = requests.map(({ text, requestBytes, responseBytes, items }, i) => {
    const bytes = `${requestBytes ?? 'unknown'} bytes out, ${responseBytes ?? 'unknown'} in`
    return `${i + 1}. ${text} (${bytes}) for ${items.join(', ')}`
  })
  return [...lines, ...notes].join('\n')
}
