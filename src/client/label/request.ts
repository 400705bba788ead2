// The requests of label access: names in as few as fit, apart again when the PLC refuses one of them.
import type { DataCode } from '../../codec/codec'
import { ClosedError, type EndCodeAbout, EndCodeError, PlcError, ProtocolError } from '../../errors'
import type { Command, RequestOf, ResponseOf } from '../../melsec/commands/command'
import { type CommandName, commands } from '../../melsec/commands/commands'
import { limitsOf, requestBytes } from '../../melsec/device/limit'
import type { LabelArea } from '../../melsec/label/codec'
import { abbreviated, inRequests } from '../../melsec/label/label'
import type { Profile } from '../../melsec/profiles/profile'
import { about } from '../item/about'
import { stopsOrder } from '../item/write-outcome'
import type { AskedLabel } from './item'
import type { LabelContent } from './value'

/** Sends the requests of one call. */
export interface LabelCall {
  readonly protocol: { readonly profile: Profile; readonly code: DataCode }
  readonly send: <C extends Command>(command: C, message: RequestOf<C>) => Promise<ResponseOf<C>>
}

/** What Label Read Random says of a label. */
export interface LabelAnswer {
  readonly typeId: number
  readonly data: readonly number[]
}

export interface LabelWrite {
  readonly asked: AskedLabel
  readonly content: LabelContent
}

/** One array, or a piece of it, to be read. */
export interface ArrayRead {
  readonly name: string
  readonly extent: Pick<LabelArea, 'unit' | 'length'>
}

export class LabelRequests {
  readonly protocol: LabelCall['protocol']
  readonly #send: LabelCall['send']

  constructor({ protocol, send }: LabelCall) {
    this.protocol = protocol
    this.#send = send
  }

  /** Bytes one request of the command may have. */
  #most(name: CommandName): number {
    const { profile, code } = this.protocol
    const limits = limitsOf(profile, name, 'short', code).filter(({ unit }) => unit === 'bytes')
    return Math.min(Number.MAX_SAFE_INTEGER, ...limits.map(({ max }) => max))
  }

  #fits(name: CommandName, message: Readonly<Record<string, unknown>>): boolean {
    return requestBytes(name, this.protocol.code, message) <= this.#most(name)
  }

  /** Label Read Random of many labels; each has its own answer or error. */
  async random(asked: readonly AskedLabel[]): Promise<Map<AskedLabel, LabelAnswer | PlcError>> {
    const answers = new Map<AskedLabel, LabelAnswer | PlcError>()
    const read = async (some: readonly AskedLabel[]) => {
      const { labels } = await this.#send(commands.readRandomLabels, randomMessage(some))
      some.forEach((one, at) => {
        const answer = labels[at]
        if (answer !== undefined) answers.set(one, answer)
      })
    }
    for (const some of this.randomRequests(asked)) {
      await this.#apart(some, read, (one, error) => answers.set(one, error))
    }
    return answers
  }

  /** The labels of each request of Label Read Random. */
  randomRequests(asked: readonly AskedLabel[]): AskedLabel[][] {
    return inRequests(asked, (some) => this.#fits('readRandomLabels', randomMessage(some)))
  }

  /** The pieces of each request of Array Label Read. `most`: bytes of the data of an answer. */
  arrayRequests<R extends ArrayRead>(reads: readonly R[], most: number): R[][] {
    return inRequests(
      reads,
      (some) =>
        some.reduce((sum, { extent }) => sum + bytesOf(extent), 0) <= most &&
        this.#fits('readArrayLabels', arrayMessage(some)),
    )
  }

  /** Array Label Read of many pieces; each has its own answer or error. */
  async arrays<R extends ArrayRead>(reads: readonly R[], most: number): Promise<Map<R, LabelAnswerArea | PlcError>> {
    const answers = new Map<R, LabelAnswerArea | PlcError>()
    const read = async (some: readonly R[]) => {
      const { arrays } = await this.#send(commands.readArrayLabels, arrayMessage(some))
      some.forEach((one, at) => {
        const answer = arrays[at]
        if (answer === undefined) return
        const { unit, length } = answer.area
        const isAsked = unit === one.extent.unit && length === one.extent.length
        answers.set(one, isAsked ? answer : notAsked(one))
      })
    }
    for (const some of this.arrayRequests(reads, most)) {
      await this.#apart(some, read, (one, error) => answers.set(one, error))
    }
    return answers
  }

  /** Reads may be repeated: when the PLC refuses a request, its halves are asked, until only the bad ones are left. */
  async #apart<T>(
    some: readonly T[],
    read: (some: readonly T[]) => Promise<void>,
    failed: (one: T, error: PlcError) => void,
  ): Promise<void> {
    try {
      await read(some)
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      if (some.length > 1 && isAboutLabels(error)) {
        const half = some.length >> 1
        await this.#apart(some.slice(0, half), read, failed)
        await this.#apart(some.slice(half), read, failed)
      } else for (const one of some) failed(one, error)
    }
  }

  /**
   * Writes in order. What stands behind a write of unknown outcome is not sent.
   * @param stops nothing is sent behind any failure
   * @returns the errors; a label without one was written
   */
  async write(writes: readonly LabelWrite[], stops = false): Promise<Map<AskedLabel, PlcError>> {
    const errors = new Map<AskedLabel, PlcError>()
    let before: PlcError | undefined
    for (const some of this.#writeRequests(writes)) {
      const error = before === undefined ? await this.#attempt(some) : notWritten(before)
      if (error === undefined) continue
      const subjects = some.map(({ asked }) => ({ item: asked.address.name }))
      const told = error instanceof EndCodeError ? about(error, subjects) : error
      for (const { asked } of some) errors.set(asked, told)
      if (stops || stopsOrder(error)) before ??= error
    }
    return errors
  }

  /** Labels and arrays have commands of their own; the order is kept all the same. */
  #writeRequests(writes: readonly LabelWrite[]): LabelWrite[][] {
    return inRequests(writes, (some) => {
      const first = some[0]
      const last = some.at(-1)
      if (first === undefined || last === undefined || 'area' in first.content !== 'area' in last.content) return false
      const isArray = 'area' in first.content
      if (some.slice(0, -1).some((before) => meets(before, last, isArray))) return false
      return isArray ? this.#fits('writeArrayLabels', arraysOf(some)) : this.#fits('writeRandomLabels', labelsOf(some))
    })
  }

  async #attempt(some: readonly LabelWrite[]): Promise<PlcError | undefined> {
    try {
      const [first] = some
      if (first !== undefined && 'area' in first.content) await this.#send(commands.writeArrayLabels, arraysOf(some))
      else await this.#send(commands.writeRandomLabels, labelsOf(some))
      return undefined
    } catch (error) {
      if (error instanceof PlcError) return error
      throw error
    }
  }
}

export interface LabelAnswerArea {
  readonly typeId: number
  readonly area: LabelArea
}

function bytesOf({ unit, length }: ArrayRead['extent']): number {
  return unit === 0 ? Math.ceil(length / 8) : length
}

function notAsked({ name }: ArrayRead): ProtocolError {
  return new ProtocolError('ECHO_MISMATCH', `${name}: the PLC answered another unit or length than was asked for.`)
}

/** Two writes of the same label: which one stays is sure only when they are sent one after the other. */
function meets({ asked: a }: LabelWrite, { asked: b }: LabelWrite, isArray: boolean): boolean {
  // Background: GX Works3 does not tell upper from lower case in the names of labels.
  const [one, other] = isArray ? [a.address.stem, b.address.stem] : [a.address.name, b.address.name]
  return one.toLowerCase() === other.toLowerCase()
}

/** Of what stands behind a write that failed. */
export function notWritten(cause: PlcError): ClosedError {
  const reason =
    cause.outcome === 'unknown'
      ? 'whether the write before it was carried out is not known.'
      : `an earlier request of this write failed: ${cause.message}`
  return new ClosedError('ABORTED', `It was not written: ${reason}`, 'notSent', cause)
}

/** Label Read Random of these labels, names abbreviated. */
export function randomMessage(asked: readonly AskedLabel[]) {
  const { abbreviations, names } = abbreviated(asked.map(({ address }) => address.name))
  return { abbreviations, labels: names.map((name) => ({ name })) }
}

/** Array Label Read of these pieces. */
export function arrayMessage(reads: readonly ArrayRead[]) {
  const { abbreviations, names } = abbreviated(reads.map(({ name }) => name))
  return { abbreviations, arrays: reads.map(({ extent }, at) => ({ name: names[at] ?? '', ...extent })) }
}

function labelsOf(writes: readonly LabelWrite[]) {
  const { abbreviations, names } = abbreviated(writes.map(({ asked }) => asked.address.name))
  const labels = writes.map(({ content }, at) => ({
    name: names[at] ?? '',
    data: 'data' in content ? content.data : [],
  }))
  return { abbreviations, labels }
}

function arraysOf(writes: readonly LabelWrite[]) {
  const { abbreviations, names } = abbreviated(writes.map(({ asked }) => asked.address.name))
  const arrays = writes.flatMap(({ content }, at) =>
    'area' in content ? [{ name: names[at] ?? '', area: content.area }] : [],
  )
  return { abbreviations, arrays }
}

/** Whether the PLC may read the other labels of the request. It answers a wrong length to a label of another type. */
function isAboutLabels(error: PlcError): boolean {
  return error instanceof EndCodeError && ABOUT_LABELS.has(error.about)
}

const ABOUT_LABELS: ReadonlySet<EndCodeAbout> = new Set(['item', 'size', 'request', 'unknown'])
