/** Several clients on one real line against stations in another program, and what became of their calls. */
import { createMelsecClient, createMelsecLine, type MelsecClient, PlcError } from '../../src/index'
import { serialTransport } from '../../src/transport/serial'
import type { OpenTransport } from '../../src/transport/transport'
import { Random } from '../fuzz/random'
import { Far, type Truth } from './serial-far'
import { judge, type SerialViolation, type Told } from './serial-judge'

export interface SerialKind {
  readonly name: string
  readonly frame: '1C' | '3C' | '4C'
  readonly messageFormat: 1 | 4 | 5
  readonly baudRate: 9600 | 115_200
  readonly noise: boolean
  readonly sumCheck: boolean
  readonly pace: boolean
  readonly echo: boolean
}

export interface SerialLaneOptions {
  readonly kind: SerialKind
  readonly seed: number
  readonly requests: number
  /** Kinds of faults; of those that the kind can see. */
  readonly faults: (name: string) => boolean
  readonly double?: SerialDouble
}

/** A client that breaks its word. */
export interface SerialDouble {
  readonly name: string
  readonly client?: (client: MelsecClient) => Pick<MelsecClient, 'read' | 'readValues' | 'write'>
  readonly transport?: (open: OpenTransport) => OpenTransport
  /** Calls after which it is found out. */
  readonly requests: number
  /** All its calls read one word: answers are alike. */
  readonly isSimple?: true
  /** Of the requests with which something goes wrong. Silent stations are not asked, and who is not asked takes nothing for an answer. */
  readonly share?: number
  /** Its times, where they are not those that the stations keep. */
  readonly times?: { readonly answerTime: number; readonly quiet: number; readonly gap: number }
}

export interface SerialTally {
  readonly kind: SerialKind
  readonly told: number
  readonly outcomes: Readonly<Record<string, number>>
  readonly truth: Truth
  readonly violations: readonly SerialViolation[]
  /** What went over the wire about the first of them. */
  readonly story: readonly string[]
  readonly ms: number
}

const STATIONS = [1, 2, 3, 4] as const
const CELLS = 64
/** Values of the memory at first, and behind them those that are written, each one once. */
const FIRST = 1
const WRITTEN = 1000
const CALLERS = 2
/** ms. Longer than the stations take, unless that is the fault. */
const NOISY = { answerTime: 90, betweenBytes: 30, quiet: 40 } as const
/** Nothing is lost on a computer that is busy. */
const QUIET = { answerTime: 10_000, betweenBytes: 5000, quiet: 100 } as const
const SHARE = 0.08
/** Of a hundred calls. */
const WRITES = 45
const SETTLED = 30_000
/** ms of the story before a call. */
const BEFORE = 500

/** Faults that a client can see without a sum: those that change no character. */
const wholeFaults = ['silence', 'drop', 'slow', 'late', 'held', 'split', 'dribble', 'cut', 'refusal'] as const
export const serialFaults = [
  ...wholeFaults,
  'duplicate',
  'garbage',
  'damaged',
  'misheard',
  'wrongSum',
  'noise',
  'stranger',
  'wire request',
  'wire answer',
  'wire both',
  'wire initialise',
] as const

/** Answers that come later than any may: what was asked is ended by EOT, and in format 5 by nothing. */
const endedByEot: readonly string[] = ['late', 'held']

const now = (): number => Number(process.hrtime.bigint()) / 1e6

export async function serialLane({ kind, seed, requests, faults, double }: SerialLaneOptions): Promise<SerialTally> {
  const started = now()
  const { frame, messageFormat, baudRate, sumCheck, pace, echo } = kind
  const known: readonly string[] = sumCheck ? serialFaults : wholeFaults
  const isSeen = (name: string) => messageFormat !== 5 || !endedByEot.includes(name)
  const far = await Far.start({
    baudRate,
    messageFormat,
    sumCheck,
    pace,
    echo,
    seed,
    stations: STATIONS,
    cells: CELLS,
    first: FIRST,
    refusal: frame === '1C' ? 0x06 : 0x7143,
    noise: kind.noise
      ? { share: double?.share ?? SHARE, kinds: known.filter((name) => faults(name) && isSeen(name)), ...NOISY }
      : undefined,
  })
  const port = { baudRate, dataLength: 8, parity: 'none' } as const
  const open = serialTransport({ ...port, path: far.near })
  const line = createMelsecLine({
    frame,
    messageFormat,
    sumCheck,
    // Nothing but a pause tells an answer that comes twice from the next one.
    serial: { ...port, ...(kind.noise ? { ...NOISY, gap: 12 } : QUIET), ...double?.times },
    openTransport: double?.transport?.(open) ?? open,
  })
  const clients = STATIONS.map((station) =>
    createMelsecClient({
      line,
      profile: 'fx5-serial',
      route: { station },
      allowWrites: true,
      timeout: kind.noise ? 1000 : 20_000,
      reconnect: { first: 20, longest: 200 },
    }),
  )
  const lane = new Lane(requests, seed, double?.isSimple === true)
  try {
    await Promise.all(
      clients.flatMap((client, at) =>
        Array.from({ length: CALLERS }, () =>
          lane.calls(STATIONS[at] ?? 0, client, double?.client?.(client) ?? client),
        ),
      ),
    )
    const truth = await far.truth()
    const violations = judge({
      initial: (station, number) => FIRST + station * CELLS + number,
      carried: truth.done,
      told: lane.told,
      isQuiet: !kind.noise,
    })
    const story = await storyOf(far, violations)
    return { kind, told: lane.told.length, outcomes: lane.outcomes(), truth, violations, story, ms: now() - started }
  } finally {
    await Promise.all(clients.map((client) => client.close()))
    await far.close()
  }
}

async function storyOf(far: Far, [first]: readonly SerialViolation[]): Promise<string[]> {
  if (first === undefined) return []
  const story = await far.story()
  const about = story.filter(([at]) => at > first.from - BEFORE && at < first.to + 1)
  return about.map(([at, what]) => `${at.toFixed(1)} ${what}`)
}

class Lane {
  readonly told: Told[] = []
  readonly #random = new Random()
  #left: number
  #written = WRITTEN

  constructor(
    requests: number,
    seed: number,
    readonly isSimple: boolean,
  ) {
    this.#left = requests
    this.#random.restart(seed, 1)
  }

  outcomes(): Record<string, number> {
    const counts: Record<string, number> = {}
    for (const { kind, outcome } of this.told) {
      const name = `${kind} ${outcome}`
      counts[name] = (counts[name] ?? 0) + 1
    }
    return counts
  }

  /** One call after another, as long as there are any left. A station that is not there is waited for. */
  async calls(station: number, real: MelsecClient, client: Pick<MelsecClient, 'read' | 'readValues' | 'write'>) {
    while (this.#left > 0) {
      this.#left -= 1
      if (!this.isSimple && this.#random.below(100) < WRITES) await this.#write(station, client)
      else await this.#read(station, client)
      await isThere(real)
    }
  }

  #numbers(): number[] {
    const [count, first] = [1 + this.#random.below(4), this.#random.below(CELLS - 16)]
    const shape = this.#random.below(10)
    if (shape < 4 || this.isSimple) return [first]
    if (shape < 7) return Array.from({ length: shape === 6 ? 16 : count }, (_, i) => first + i)
    const scattered = new Set(Array.from({ length: 1 + count }, () => this.#random.below(CELLS)))
    return [...scattered].sort((a, b) => a - b)
  }

  async #write(station: number, client: Pick<MelsecClient, 'write'>): Promise<void> {
    const numbers = this.#numbers()
    const values = numbers.map(() => this.#written++)
    const write = isInRow(numbers)
      ? () => client.write(`D${numbers[0]}:UINT[${numbers.length}]`, values)
      : () => client.write(Object.fromEntries(numbers.map((number, i) => [`D${number}:UINT`, values[i] ?? 0])))
    await this.#call(
      { kind: 'write', station, numbers },
      async () => {
        await write()
        return values
      },
      values,
    )
  }

  async #read(station: number, client: Pick<MelsecClient, 'read' | 'readValues'>): Promise<void> {
    const numbers = this.#numbers()
    await this.#call({ kind: 'read', station, numbers }, async () => {
      if (!isInRow(numbers)) return client.readValues(numbers.map((number) => `D${number}:UINT`))
      if (numbers.length === 1) return [await client.read(`D${numbers[0]}:UINT`)]
      const values: unknown = await client.read(`D${numbers[0]}:UINT[${numbers.length}]`)
      return values as readonly unknown[]
    })
  }

  async #call(
    what: Pick<Told, 'kind' | 'station' | 'numbers'>,
    call: () => Promise<readonly unknown[]>,
    written: readonly unknown[] = [],
  ): Promise<void> {
    const { kind, station, numbers } = what
    const name = `call ${this.told.length}: ${kind} of ${numbers.map((number) => `D${number}`).join(' ')}, station ${station}`
    const from = now()
    const tell = (outcome: Told['outcome'], values: readonly unknown[], error?: unknown) =>
      void this.told.push({ ...what, name, from, to: now(), values, outcome, error })
    let late: NodeJS.Timeout | undefined
    const never = new Promise<never>((_, reject) => {
      late = setTimeout(() => reject(new Error('it never settled')), SETTLED)
    })
    try {
      tell('done', await Promise.race([call(), never]))
    } catch (error) {
      tell(error instanceof PlcError ? error.outcome : 'no PlcError', written, error)
    } finally {
      clearTimeout(late)
    }
  }
}

/** Or does not come back for long. */
export async function isThere(client: MelsecClient): Promise<void> {
  if (client.state.name === 'connected') return
  await new Promise<void>((resolve) => {
    const late = setTimeout(done, SETTLED)
    const stop = client.on('state', ({ name }) => {
      if (name === 'connected') done()
    })
    function done(): void {
      clearTimeout(late)
      stop()
      resolve()
    }
  })
}

function isInRow(numbers: readonly number[]): boolean {
  return numbers.every((number, i) => i === 0 || number === (numbers[i - 1] ?? 0) + 1)
}
