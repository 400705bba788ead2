// The requests of label access: names in as few as fit, apart again when the PLC refuses one of them.
import type { DataCode } from '../codec/codec'
import { ClosedError, EndCodeError, PlcError, ProtocolError } from '../errors'
import type { Command, RequestOf, ResponseOf } from '../melsec/command'
import { type CommandName, commands } from '../melsec/commands/commands'
import { abbreviated, inRequests } from '../melsec/label'
import type { LabelArea } from '../melsec/label-codec'
import { limitsOf, requestBytes } from '../melsec/limit'
import type { Profile } from '../melsec/profile'
import type { AskedLabel } from './label-item'
import type { LabelContent } from './label-value'

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
    const message = (some: readonly AskedLabel[]) => {
      const { abbreviations, names } = abbreviated(some.map(({ address }) => address.name))
      return { abbreviations, labels: names.map((name) => ({ name })) }
    }
    const fits = (some: readonly AskedLabel[]) => this.#fits('readRandomLabels', message(some))
    const read = async (some: readonly AskedLabel[]) => {
      const { labels } = await this.#send(commands.readRandomLabels, message(some))
      some.forEach((one, at) => {
        const answer = labels[at]
        if (answer !== undefined) answers.set(one, answer)
      })
    }
    for (const some of inRequests(asked, fits)) {
      await this.#apart(some, read, (one, error) => answers.set(one, error))
    }
    return answers
  }

  /** Array Label Read of many pieces; each has its own answer or error. `load`: words of the answer, at most `most`. */
  async arrays<R extends ArrayRead>(reads: readonly R[], most: number): Promise<Map<R, LabelAnswerArea | PlcError>> {
    const answers = new Map<R, LabelAnswerArea | PlcError>()
    const message = (some: readonly R[]) => {
      const { abbreviations, names } = abbreviated(some.map(({ name }) => name))
      return { abbreviations, arrays: some.map(({ extent }, at) => ({ name: names[at] ?? '', ...extent })) }
    }
    const fits = (some: readonly R[]) =>
      some.reduce((sum, { extent }) => sum + bytesOf(extent), 0) <= most && this.#fits('readArrayLabels', message(some))
    const read = async (some: readonly R[]) => {
      const { arrays } = await this.#send(commands.readArrayLabels, message(some))
      some.forEach((one, at) => {
        const answer = arrays[at]
        if (answer === undefined) return
        const { unit, length } = answer.area
        const isAsked = unit === one.extent.unit && length === one.extent.length
        answers.set(one, isAsked ? answer : notAsked(one))
      })
    }
    for (const some of inRequests(reads, fits)) {
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
      if (some.length > 1 && this.#isAboutLabels(error)) {
        const half = some.length >> 1
        await this.#apart(some.slice(0, half), read, failed)
        await this.#apart(some.slice(half), read, failed)
      } else for (const one of some) failed(one, error)
    }
  }

  #isAboutLabels(error: PlcError): boolean {
    return error instanceof EndCodeError && error.endCode !== this.protocol.profile.refusals.command
  }

  /** Writes in order. @returns the errors; a label without one was written */
  async write(writes: readonly LabelWrite[]): Promise<Map<AskedLabel, PlcError>> {
    const errors = new Map<AskedLabel, PlcError>()
    let unknown: PlcError | undefined
    for (const some of this.#writeRequests(writes)) {
      const error = unknown === undefined ? await this.#attempt(some) : notSent(unknown)
      if (error === undefined) continue
      for (const { asked } of some) errors.set(asked, error)
      if (error.outcome === 'unknown') unknown ??= error
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

function notSent(cause: PlcError): ClosedError {
  const message = 'It was not written: whether the write before it was carried out is not known.'
  return new ClosedError('ABORTED', message, 'notSent', cause)
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
