// Settings of a unit and its parameters: a layout that is declared once, and what is read from it.
import { isPlainObject } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import {
  decode,
  encode,
  type Field,
  isVisible,
  type Message,
  measure,
  readerOf,
  type Shape,
  writerOf,
} from '../../codec/codec'
import { annotate, type Leaf, showBytes } from '../../codec/explanation'
import { ProtocolError, RequestError } from '../../errors'
import { leavesOf, type ParameterLeaf, type ParameterSection, type ParameterTableRow, parameterTable } from './layout'
import { checkBlocks, type ParameterBlock, parameterText } from './parameter-area'

/** What is wrong with settings, or what is odd. */
export interface ParameterProblem {
  /** `error`: a rule of the manual refuses it. `warning`: it is allowed, but is it meant? */
  readonly severity: 'error' | 'warning'
  /** Name of the setting, e.g. `slaves.0.sendBytes`. */
  readonly setting: string
  /** What is wrong and what to do, as sentences. */
  readonly message: string
}

/** Parameters to be written. */
export interface WrittenParameters {
  /** With reserved parameters between settings as 0. */
  readonly blocks: readonly ParameterBlock[]
  /** What is allowed, and perhaps not meant. */
  readonly warnings: readonly ParameterProblem[]
}

/** What the parameters of a unit say. */
export interface ReadParameters<R> {
  /** Undefined when a parameter holds what no setting can say: see the problems. */
  readonly settings: R | undefined
  /** Errors are what the unit refuses, or reports as its error; they do not hide the settings. */
  readonly problems: readonly ParameterProblem[]
}

/** One parameter in words. */
export interface ParameterRow {
  /** Of the first byte. */
  readonly address: number
  /** Bytes. */
  readonly length: number
  /** Path of the setting; of a reserved parameter the name of its field. */
  readonly setting: string
  /** As hexadecimal digits. */
  readonly bytes: string
  /** What they mean. */
  readonly text: string
}

/** What makes a map. `R`: settings as they are read; `A`: what the unit knows from its switches and the parameters do not hold. */
export interface ParameterMapParts<R, A> {
  /** Which units it is of. */
  readonly unit: string
  readonly manual: string
  /** When the unit uses these parameters. */
  readonly when: string
  readonly sections: readonly ParameterSection[]
  /** What the manual refuses and what it advises. */
  rules(settings: R, about: A): readonly ParameterProblem[]
  /** A value in words, where its plain form does not do; `index`: of the element of a list, counting from 0. */
  words?(leaf: Leaf, about: A | undefined, index: number | undefined): string | undefined
}

/**
 * Settings as they are given (`S`) and read (`R`), to parameters and back.
 * @experimental How it is made may change in any version; `write`, `read`, `explain` and `areas` do not.
 */
export class ParameterMap<S extends object, R extends S, A> {
  readonly unit: string
  readonly manual: string
  /** When the unit uses these parameters. */
  readonly when: string
  /** Every parameter that the manual names, in the order of addresses. */
  readonly leaves: readonly ParameterLeaf[]
  readonly #parts: ParameterMapParts<R, A>

  constructor(parts: ParameterMapParts<R, A>) {
    this.unit = parts.unit
    this.manual = parts.manual
    this.when = parts.when
    this.leaves = parts.sections.flatMap(leavesOf)
    this.#parts = parts
  }

  /** What `read` needs of the parameters. */
  get areas(): readonly { readonly address: number; readonly length: number }[] {
    return this.#parts.sections.map(({ address, shape }) => ({ address, length: sizeOf(shape) }))
  }

  /** The parameters for documentation; of a list the first element stands for all. */
  table(): readonly ParameterTableRow[] {
    return parameterTable(this.leaves)
  }

  /**
   * The parameters for these settings. Reserved parameters between them are 0; those behind them are not touched.
   * @throws RequestError BAD_VALUE for settings that cannot be written or that the manual refuses, all of them in one message;
   * `field` is the first.
   */
  write(settings: S, about: A): WrittenParameters {
    const blocks = this.#encode(settings)
    const { problems } = this.#read(blocks, about, settings)
    const errors = problems.filter(({ severity }) => severity === 'error')
    if (errors.length > 0) {
      const messages = errors.map(({ setting, message }) => `${setting}: ${message}`)
      throw new RequestError('BAD_VALUE', `${this.unit}: ${messages.join(' ')}`, errors[0]?.setting)
    }
    return { blocks, warnings: problems }
  }

  #encode(settings: S): ParameterBlock[] {
    try {
      const given = checkedNames(settings, this.#parts.sections)
      return this.#parts.sections.map(({ address, shape }) => {
        const writer = writerOf('binary')
        encode<Shape>(shape, partFor(shape, given, ''), writer)
        return { address, bytes: writer.take() }
      })
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      throw new RequestError('BAD_VALUE', `${this.unit}: ${error.message.replace(/\.?$/, '.')}`, error.field)
    }
  }

  /**
   * The settings that parameters hold: those of `areas`, in one block or several.
   * @throws RequestError BAD_VALUE when a parameter is missing among the blocks
   * @example flNetParameters.read([{ address: 0, bytes }])
   */
  read(blocks: readonly ParameterBlock[], about: A): ReadParameters<R> {
    return this.#read(blocks, about, {})
  }

  /** `given`: settings of which the blocks were made; their lists stay as long as they are. */
  #read(blocks: readonly ParameterBlock[], about: A, given: object): ReadParameters<R> {
    const image = this.#imageOf(blocks)
    const problems: ParameterProblem[] = []
    const settings: Record<string, unknown> = {}
    for (const leaf of this.leaves) {
      const bytes = image.subarray(leaf.address, leaf.address + leaf.length)
      if (leaf.field.kind === 'spare') problems.push(...reservedProblem(leaf, bytes))
      else problems.push(...readInto(settings, leaf, bytes))
    }
    if (problems.some(({ severity }) => severity === 'error')) return { settings: undefined, problems }
    withoutEmptyEnd(settings, new Map(Object.entries(given)))
    // The leaves are those of the shapes, from which R was made.
    const read = settings as R
    return { settings: read, problems: [...problems, ...this.#parts.rules(read, about)] }
  }

  /** Each parameter in words, also of a unit whose parameters are wrong. */
  explain(blocks: readonly ParameterBlock[], about?: A): readonly ParameterRow[] {
    const image = this.#imageOf(blocks)
    return this.leaves.map((leaf) => {
      const { address, length, path, index } = leaf
      const bytes = image.subarray(address, address + length)
      const describe = (found: Leaf) => this.#parts.words?.(found, about, index)
      const { rows, fault } = annotate(leaf.shape, bytes, { code: 'binary', describe })
      const text = fault === undefined ? rows.map((row) => row.text).join(' ') : `not known: ${fault.message}`
      return { address, length, setting: path, bytes: showBytes(bytes, 'binary'), text }
    })
  }

  /** The parameters at their addresses; what the map does not name may be missing. */
  #imageOf(blocks: readonly ParameterBlock[]): Buffer {
    checkBlocks(blocks)
    const end = Math.max(0, ...blocks.map(({ address, bytes }) => address + bytes.length))
    const image = Buffer.alloc(end)
    const known = new Set<number>()
    for (const { address, bytes } of blocks) {
      image.set(bytes, address)
      for (let i = 0; i < bytes.length; i++) known.add(address + i)
    }
    for (const { address, length, path } of this.leaves) {
      for (let at = address; at < address + length; at++) {
        if (!known.has(at))
          throw new RequestError(
            'BAD_VALUE',
            `${this.unit}: parameter ${parameterText(at)} is missing. Read it too.`,
            path,
          )
      }
    }
    return image
  }
}

function sizeOf(shape: Shape): number {
  return measure(shape, { ascii: false, form: 0 })
}

/** A misspelt setting would otherwise be the usual one, without a word. */
function checkedNames(settings: object, sections: readonly ParameterSection[]): Message {
  if (!isPlainObject(settings)) throw new RequestError('BAD_VALUE', `settings are an object, not ${shown(settings)}`)
  const fields = sections.flatMap(({ shape }) => Object.entries(shape))
  refuseOthers(settings, fields, '')
  for (const [name, value] of Object.entries(settings)) {
    const items = fields.flatMap(([of, field]) =>
      of === name && field.kind === 'list' ? Object.entries(field.item) : [],
    )
    if (items.length === 0 || !Array.isArray(value)) continue
    value.forEach((element: unknown, i) => {
      if (isPlainObject(element)) refuseOthers(element, items, `${name}.${i}.`)
    })
  }
  return settings
}

function refuseOthers(given: Message, fields: readonly (readonly [string, Field])[], prefix: string): void {
  const names = [...new Set(fields.filter(([, field]) => isVisible(field)).map(([name]) => name))]
  const other = Object.keys(given).find((name) => given[name] !== undefined && !names.includes(name))
  if (other === undefined) return
  const path = `${prefix}${other}`
  throw new RequestError('BAD_VALUE', `there is no setting ${path}; there are ${names.join(', ')}`, path)
}

/** What of the settings stands in a section. Lists that are shorter than the unit's are filled up with zeros. */
function partFor(shape: Shape, given: Message, prefix: string): Message {
  const entries = Object.entries(shape).filter(([, field]) => isVisible(field))
  return Object.fromEntries(
    entries.map(([name, field]) => {
      const value = given[name]
      return [name, field.kind === 'list' ? filledUp(field, value, `${prefix}${name}`) : value]
    }),
  )
}

function filledUp({ item, count }: Extract<Field, { kind: 'list' }>, given: unknown, path: string): unknown {
  if (!Array.isArray(given)) return given
  const room = Number(count)
  if (given.length > room)
    throw new RequestError('BAD_VALUE', `${path}: has ${given.length} elements, the unit has room for ${room}`, path)
  const names = Object.keys(item)
  const empty = Object.fromEntries(names.map((name) => [name, 0]))
  return Array.from({ length: room }, (_, i) => {
    if (i >= given.length) return empty
    const element: unknown = given[i]
    return isPlainObject(element) ? partFor(item, element, `${path}.${i}.`) : element
  })
}

function reservedProblem({ address, path }: ParameterLeaf, bytes: Buffer): readonly ParameterProblem[] {
  const at = bytes.findIndex((byte) => byte !== 0)
  if (at < 0) return []
  const message = `Parameter ${parameterText(address + at)} is reserved and holds ${shown(bytes[at])}; writing the settings makes it 0.`
  return [{ severity: 'warning', setting: path, message }]
}

/** Puts the value of a parameter into the settings; says what is wrong where it has none. */
function readInto(settings: Record<string, unknown>, leaf: ParameterLeaf, bytes: Buffer): readonly ParameterProblem[] {
  const { path, name, list, index = 0, shape, address } = leaf
  try {
    const { [name]: value } = decode<Shape>(shape, readerOf('binary', bytes))
    if (list === undefined) settings[name] = value
    else elementOf(settings, list, index)[name] = value
    return []
  } catch (error) {
    if (!(error instanceof ProtocolError)) throw error
    const { fault } = annotate(shape, bytes, { code: 'binary' })
    const message = `Parameter ${parameterText(address)} holds what no setting says: ${fault?.message ?? error.message}.`
    return [{ severity: 'error', setting: path, message }]
  }
}

function elementOf(settings: Record<string, unknown>, list: string, index: number): Record<string, unknown> {
  settings[list] ??= []
  const elements = settings[list] as Record<string, unknown>[]
  elements[index] ??= {}
  return elements[index]
}

/** Elements at the end of a list that hold zeros only are not there, but for those that were given. */
function withoutEmptyEnd(settings: Record<string, unknown>, given: ReadonlyMap<string, unknown>): void {
  for (const [name, list] of Object.entries(settings)) {
    if (!Array.isArray(list)) continue
    const givenList = given.get(name)
    const least = Array.isArray(givenList) ? givenList.length : 0
    while (list.length > least && Object.values(list.at(-1) as object).every((part) => part === 0)) list.pop()
  }
}
