// From a draft to a request that can be sent again and again, and from its answer to words in a row.

import type { Exchange } from '../../link/link'
import type { Command, RequestOf, ResponseOf } from '../../melsec/commands/command'
import { type CommandName, commands } from '../../melsec/commands/commands'
import { type AddressOptions, formatDevice } from '../../melsec/device/address'
import type { DeviceAddress } from '../../melsec/device/device'
import type { DeviceForm } from '../../melsec/device/device-form'
import { subcommandOf } from '../../melsec/device/form'
import type { Words } from '../../value/value'
import { type Area, addressAt, wordsPerCell } from './area'
import type { Stretch } from './chunk'
import type { Draft } from './draft'
import type { PlanProtocol } from './limit'

/** Sends one request and resolves with what it answered. It may be called again before the last answer has come. */
export type SendExchange = <T>(exchange: Exchange<T>) => Promise<T>

/** One request as people see it. */
export interface RequestDescription {
  /** Name of the command, e.g. `readWords`. */
  readonly command: string
  /** Form of the device specification; label commands have none. */
  readonly form?: DeviceForm
  /** As it is sent: units and form of the device specification; missing where commands have none. */
  readonly subcommand?: number
  /** Points it asks for, in the units of the command. */
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

/** What a draft asks for, before anything is encoded, and what the answer means. */
interface Question<C extends Command> {
  readonly name: CommandName
  readonly command: C
  readonly message: RequestOf<C>
  readonly form: DeviceForm
  readonly points: number
  readonly text: (options: AddressOptions) => string
  readonly offsets: ReadonlyMap<Stretch, number>
  readonly wordsOf: (answer: ResponseOf<C>) => Words
}

/** The draft's question, whatever command it is for. */
function withQuestion<R>(draft: Draft, use: <C extends Command>(question: Question<C>) => R): R {
  switch (draft.kind) {
    case 'direct':
      return draft.run.area.kind === 'bit' ? use(readBits(draft.run)) : use(readWords(draft.run))
    case 'random':
      return use(readRandom(draft.runs))
    case 'block':
      return use(readBlock(draft.runs))
    default:
      return draft satisfies never
  }
}

/** @throws RequestError when the request cannot be sent. */
export function prepareRead(protocol: PlanProtocol, draft: Draft, options: AddressOptions): PreparedRead {
  return withQuestion(draft, (question) => {
    const { name, command, message, form, points, offsets, text, wordsOf } = question
    const exchange = protocol.exchange(command, message)
    const asked = readAs(exchange, wordsOf)
    return {
      command: name,
      form,
      points,
      exchange,
      // Only people ask for it.
      get text() {
        return text(options)
      },
      offsets,
      fetch: (send) => send(asked),
    }
  })
}

/** Read Random with the same devices, registered once and asked for again and again. */
export interface PreparedMonitor extends Pick<PreparedRead, 'offsets' | 'fetch'> {
  readonly entry: Exchange<unknown>
}

/** @throws RequestError when they cannot be registered together. */
export function prepareMonitor(protocol: PlanProtocol, runs: readonly Stretch[]): PreparedMonitor {
  const { message, offsets, wordsOf } = readRandom(runs)
  const entry = protocol.exchange(commands.entryMonitorDevice, message)
  // Execute Monitor answers what Read Random would, so its words are taken apart the same way.
  const execute = readAs(protocol.exchange(commands.executeMonitor, {}, { context: message }), wordsOf)
  return { entry, offsets, fetch: (send) => send(execute) }
}

/** The same request, whose answer is read as something else: at once, so that nobody waits for a promise more. */
function readAs<A, T>(exchange: Exchange<A>, read: (answer: A) => T): Exchange<T> {
  return { ...exchange, decode: (frame) => read(exchange.decode(frame)) }
}

/** @throws RequestError when these cells alone could not be asked for. */
export function checkCells(protocol: PlanProtocol, run: Stretch): void {
  const { direct } = run.area.ways
  if (direct === undefined) protocol.check(commands.readRandom, readRandom([run]).message)
  else if (run.area.kind === 'bit') protocol.check(commands.readBits, messageInRow(run))
  else protocol.check(commands.readWords, messageInRow(run))
}

/** Bytes of the bodies of request and answer. */
export function bodyBytes(protocol: PlanProtocol, draft: Draft): number {
  return withQuestion(draft, ({ command, message, form }) => protocol.bodyBytes(command, message, form))
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

export function blocksText(wordBlocks: number, bitBlocks: number, points: number): string {
  return `${pointsText(wordBlocks, 'word block')}, ${pointsText(bitBlocks, 'bit block')}, ${pointsText(points)}`
}

function readWords(run: Stretch): Question<typeof commands.readWords> {
  return { ...inRow('readWords', run), command: commands.readWords, wordsOf: ({ values }) => values }
}

function readBits(run: Stretch): Question<typeof commands.readBits> {
  return { ...inRow('readBits', run), command: commands.readBits, wordsOf: ({ values }) => wordsOfBits(values) }
}

function inRow(name: CommandName, run: Stretch) {
  const { area, from, to } = run
  const message = messageInRow(run)
  return {
    name,
    message,
    form: area.ways.form,
    points: message.points,
    text: (options: AddressOptions) => `${rangeText(area, from, to, options)}, ${pointsText(message.points)}`,
    offsets: new Map([[run, 0]]),
  }
}

function messageInRow({ area, from, to }: Stretch): { readonly head: DeviceAddress; readonly points: number } {
  return { head: addressAt(area, from), points: area.kind === 'bit' ? to - from : (to - from) * wordsPerCell(area) }
}

/** Packed, the first bit in bit 0. */
export function wordsOfBits(bits: readonly boolean[]): number[] {
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

function readRandom(runs: readonly Stretch[]): Question<typeof commands.readRandom> {
  const all: Scatter = { words: [], doubleWords: [], wordAt: [], doubleWordAt: [], length: 0 }
  const offsets = new Map(runs.map((run) => [run, scatter(run, all)]))
  const { words, doubleWords } = all
  return {
    name: 'readRandom',
    command: commands.readRandom,
    message: { words, doubleWords },
    form: formOf(runs),
    points: words.length + doubleWords.length,
    text: () => `${pointsText(words.length, 'word')}, ${pointsText(doubleWords.length, 'double word')}`,
    offsets,
    wordsOf: (answer) => gathered(all, answer),
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

function readBlock(runs: readonly Stretch[]): Question<typeof commands.readBlock> {
  const wordRuns = runs.filter(({ area }) => area.ways.block !== 'bitBlocks')
  const bitRuns = runs.filter(({ area }) => area.ways.block === 'bitBlocks')
  const block = ({ area, from, to }: Stretch) => ({ head: addressAt(area, from), points: to - from })
  const offsets = new Map<Stretch, number>()
  let points = 0
  for (const run of [...wordRuns, ...bitRuns]) {
    offsets.set(run, 16 * points)
    points += run.to - run.from
  }
  return {
    name: 'readBlock',
    command: commands.readBlock,
    message: { wordBlocks: wordRuns.map(block), bitBlocks: bitRuns.map(block) },
    form: formOf(runs),
    points,
    text: () => blocksText(wordRuns.length, bitRuns.length, points),
    offsets,
    wordsOf: ({ wordBlocks, bitBlocks }) => [...wordBlocks, ...bitBlocks].flat(),
  }
}

function formOf(runs: readonly Stretch[]): DeviceForm {
  return runs[0]?.area.ways.form ?? 'short'
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
  /** The requests in the order they are sent. */
  readonly requests: readonly RequestDescription[]
  /** What one should know, e.g. that an array is read by several requests. */
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
