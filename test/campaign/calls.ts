/** One call of the client: what it asks for, and what is held against the ledger when it ends. */
import { type MelsecClient, PlcError } from '../../src/index'
import type { Random } from '../fuzz/random'
import type { Journal } from './journal'
import {
  deviceName,
  headOf,
  type Ledger,
  type Outcome,
  regions,
  type Span,
  type ViolationKind,
  type Watch,
} from './ledger'

/** What the campaign uses of a client; a double can stand in for it. */
export type Client = Pick<
  MelsecClient,
  'connect' | 'close' | 'read' | 'write' | 'plan' | 'planWrite' | 'selfTest' | 'on' | 'state' | 'statistics'
>

export interface Options {
  readonly timeout?: number
  readonly signal?: AbortSignal
}

type Value = number | boolean | number[] | boolean[]

/** One item, and how its value is made of words. */
interface Item {
  readonly text: string
  readonly span: Span
  readonly of: (words: readonly number[]) => Value
  /** @returns `undefined` for what is no value of the item */
  readonly words: (value: unknown) => number[] | undefined
}

/** Gives each call cells of its own, as long as there are some, or hot ones. */
export class Cells {
  readonly #next: Record<'D' | 'M', number> = { D: regions.D.cold.from, M: regions.M.cold.from }

  take(device: 'D' | 'M', cells: number, hot: boolean, random: Random): Span {
    if (hot) {
      const { from, to } = regions[device].hot
      return { device, cell: from + random.below(to - from - cells + 1), cells }
    }
    const { from, to } = regions[device].cold
    if (this.#next[device] + cells > to) this.#next[device] = from
    const cell = this.#next[device]
    // One is left between: neighbours would be read together.
    this.#next[device] += cells + 1
    return { device, cell, cells }
  }
}

export type CallKind = 'read' | 'write' | 'read list' | 'write list' | 'self test'
const KINDS: readonly CallKind[] = ['read', 'read', 'read', 'write', 'write', 'write', 'read list', 'write list']

export interface CallParts {
  readonly ledger: Ledger
  readonly journal: Journal
  readonly cells: Cells
  readonly random: Random
  /** Whether to hold what a call is told against the ledger: one that read hot cells shares them with others. */
  readonly violation: (call: Call, kind: ViolationKind, detail: string) => void
}

/** ms that a call may end after its deadline: the machine has other things to do. */
const SLACK = 2_000

export class Call {
  readonly #parts: CallParts
  readonly kind: CallKind
  readonly hot: boolean
  readonly #items: readonly Item[]
  readonly #echo: string
  #watches: Watch[][] = []
  #values: number[][] = []
  #options: Options = {}
  startedAt = 0
  /** What became of it, for counting; `undefined`: it has not ended. */
  ended: Outcome | 'done' | 'no PlcError' | undefined

  constructor(parts: CallParts) {
    const { random } = parts
    this.#parts = parts
    this.kind = random.oneIn(40) ? 'self test' : random.pick(KINDS)
    this.hot = random.oneIn(3)
    const count = this.kind.endsWith('list') ? 2 + random.below(4) : this.kind === 'self test' ? 0 : 1
    this.#items = disjoint(Array.from({ length: count }, () => this.#item()))
    this.#echo = random.next().toString(16).toUpperCase().padStart(8, '0')
  }

  #item(): Item {
    const { random, cells } = this.#parts
    const form = random.below(8)
    const take = (device: 'D' | 'M', count: number): Span => cells.take(device, count, this.hot, random)
    if (form < 2) return wordItem(take('D', 1))
    if (form === 2) return signedItem(take('D', 1))
    if (form === 3) return doubleItem(take('D', 2))
    if (form < 6) return wordsItem(take('D', 2 + random.below(8)))
    if (form === 6) return bitsItem(take('M', 1 + random.below(2)))
    return digitsItem(take('M', 1))
  }

  toString(): string {
    const items = this.#items.map(({ text }, at) => {
      const values = this.#values[at]
      return values === undefined || !this.kind.startsWith('write') ? text : `${text} = ${values.join(',')}`
    })
    const { timeout, signal } = this.#options
    const said = [timeout === undefined ? '' : `, timeout ${timeout}`, signal === undefined ? '' : ', with a signal']
    return `${this.kind} ${items.join(' ')}${said.join('')}`
  }

  /** Never rejects. */
  async run(client: Client, options: Options, number: number, usualTimeout: number): Promise<void> {
    const { journal } = this.#parts
    this.#begin(options)
    journal.add(`call ${number}: ${this}`)
    try {
      const results = await this.#perform(client)
      this.#check(results)
    } catch (error) {
      const results = resultsOf(error)
      if (results === undefined) this.#failed(error)
      else this.#check(results)
    }
    const took = performance.now() - this.startedAt
    if (took > (options.timeout ?? usualTimeout) + SLACK) this.#report('settled late', `it took ${Math.round(took)} ms`)
  }

  #begin(options: Options): void {
    const { ledger } = this.#parts
    const write = this.kind.startsWith('write')
    this.#options = options
    this.startedAt = performance.now()
    const report: Watch['report'] = (kind, detail) => this.#report(kind, detail)
    this.#watches = this.#items.map(({ span }) =>
      cellsOf(span).map((cell) => {
        if (write) return ledger.watchWrite(cell, ledger.fresh(cell), report)
        return ledger.watchRead(cell, !this.hot, report)
      }),
    )
    this.#values = this.#watches.map((watches) => watches.map(({ value }) => value ?? 0))
  }

  #perform(client: Client): Promise<readonly unknown[]> {
    const [first] = this.#items
    const options = this.#options
    const entries = this.#items.map(({ text, of }, at) => ({ item: text, value: of(this.#values[at] ?? []) }))
    const [entry] = entries
    if (first === undefined || entry === undefined) return client.selfTest(this.#echo, options).then(() => [])
    switch (this.kind) {
      case 'read':
        return client.read(first.text, options).then((value) => [{ ok: true, value }])
      case 'write':
        return client.write(entry.item, entry.value, options).then(() => [{ ok: true }])
      case 'read list':
        return client.plan(this.#items.map(({ text }) => text)).run(options)
      default:
        // Without results, or with an error that has them, the call says the same of each entry.
        return client
          .planWrite(entries)
          .run(options)
          .then((results: unknown) => (Array.isArray(results) ? results : entries.map(() => ({ ok: true }))))
    }
  }

  #check(results: readonly unknown[]): void {
    this.ended = 'done'
    this.#parts.journal.add(`ended: ${this}: ${results.map(resultText).join('; ')}`)
    this.#items.forEach((item, at) => {
      const result = results[at]
      const watches = this.#watches[at] ?? []
      if (typeof result !== 'object' || result === null) this.#report('wrong value', `no result for ${item.text}`)
      else if ('error' in result) this.#refused(watches, result.error)
      else this.#done(item, watches, 'value' in result ? result.value : undefined)
    })
  }

  #done(item: Item, watches: readonly Watch[], value: unknown): void {
    const { ledger } = this.#parts
    const words = this.kind.startsWith('read') ? item.words(value) : []
    if (words === undefined) this.#report('wrong value', `${item.text} gave ${String(value)}`)
    watches.forEach((watch, i) => {
      if (this.kind.startsWith('read')) ledger.check(watch, words?.[i])
      ledger.tell(watch, 'done', undefined)
      ledger.forget(watch)
    })
  }

  #failed(error: unknown): void {
    this.#parts.journal.add(`ended: ${this}: ${errorText(error)}`)
    if (error instanceof PlcError) this.ended = error.outcome
    for (const watches of this.#watches) this.#refused(watches, error)
    if (this.#watches.length === 0 && !(error instanceof PlcError)) this.#report('no PlcError', errorText(error))
  }

  #refused(watches: readonly Watch[], error: unknown): void {
    if (!(error instanceof PlcError)) {
      this.ended = 'no PlcError'
      this.#report('no PlcError', errorText(error))
      return
    }
    const { outcome } = error
    const endCode = 'endCode' in error && typeof error.endCode === 'number' ? error.endCode : undefined
    if (this.ended === 'done') this.ended = outcome
    for (const watch of watches) this.#parts.ledger.tell(watch, outcome, endCode)
  }

  #report(kind: ViolationKind, detail: string): void {
    this.#parts.violation(this, kind, detail)
  }
}

function cellsOf({ cell, cells }: Span): number[] {
  return Array.from({ length: cells }, (_, i) => cell + i)
}

/** A list that names a cell twice is refused, and of hot cells it may. */
function disjoint(items: readonly Item[]): Item[] {
  const taken = new Set<number>()
  return items.filter(({ span }) => {
    const cells = cellsOf(span)
    if (cells.some((cell) => taken.has(cell))) return false
    for (const cell of cells) taken.add(cell)
    return true
  })
}

const isWord = (value: unknown): value is number =>
  typeof value === 'number' && Number.isInteger(value) && value >= 0 && value < 0x10000

function wordItem(span: Span): Item {
  return {
    text: `${deviceName(span.cell)}:WORD`,
    span,
    of: ([word = 0]) => word,
    words: (value) => (isWord(value) ? [value] : undefined),
  }
}

function signedItem(span: Span): Item {
  return {
    text: deviceName(span.cell),
    span,
    of: ([word = 0]) => (word > 0x7fff ? word - 0x10000 : word),
    words: (value) => (typeof value === 'number' && isWord(value & 0xffff) ? [value & 0xffff] : undefined),
  }
}

function doubleItem(span: Span): Item {
  return {
    text: `${deviceName(span.cell)}:DWORD`,
    span,
    of: ([low = 0, high = 0]) => low + high * 0x10000,
    words: (value) => (typeof value === 'number' ? [value % 0x10000, Math.floor(value / 0x10000)] : undefined),
  }
}

function wordsItem(span: Span): Item {
  return {
    text: `${deviceName(span.cell)}:WORD[${span.cells}]`,
    span,
    of: (words) => [...words],
    words: (value) => (Array.isArray(value) && value.length === span.cells && value.every(isWord) ? value : undefined),
  }
}

function bitsItem(span: Span): Item {
  const count = 16 * span.cells
  return {
    text: `M${headOf(span)}[${count}]`,
    span,
    of: (words) => Array.from({ length: count }, (_, i) => (((words[i >> 4] ?? 0) >> (i & 15)) & 1) === 1),
    words: (value) => {
      if (!Array.isArray(value) || value.length !== count || value.some((bit) => typeof bit !== 'boolean'))
        return undefined
      return cellsOf(span).map((_, cell) =>
        value.slice(16 * cell, 16 * cell + 16).reduce((word: number, bit, i) => word + (bit ? 2 ** i : 0), 0),
      )
    },
  }
}

function digitsItem(span: Span): Item {
  return { ...wordItem(span), text: `K4M${headOf(span)}:WORD` }
}

/** What an error about a list says of each entry. */
function resultsOf(error: unknown): readonly unknown[] | undefined {
  return error instanceof PlcError && 'results' in error && Array.isArray(error.results) ? error.results : undefined
}

function resultText(result: unknown): string {
  if (typeof result !== 'object' || result === null) return String(result)
  if ('error' in result) return errorText(result.error)
  return 'value' in result ? JSON.stringify(result.value) : 'written'
}

export function errorText(error: unknown): string {
  if (error instanceof PlcError) return `${error.code}/${error.outcome}: ${error.message.slice(0, 160)}`
  return error instanceof Error ? `${error.name}: ${error.message}` : String(error)
}
