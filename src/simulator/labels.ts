// Global labels of the simulated PLC, with "Access from External Device" ticked: a table by name.
import { RequestError } from '../errors'
import type { LabelArea } from '../melsec/label/codec'
import {
  BIT_TYPE_ID,
  expandLabel,
  type LabelAddress,
  type LabelDataType,
  labelDataTypes,
  parseLabel,
} from '../melsec/label/label'
import { decodeValue, encodeValue, type PlcValue, parseType, type ValueType } from '../value/value'
import type { ProgramLabels } from './program'
import { Refusal, requestErrors } from './refusal'

/** A label: its type as in `parseType` (without BCD and 64-bit integers), or a timer or counter, which has members S, C and N. */
export interface SimulatedLabel {
  /** Its type. */
  readonly type: string
  /** Elements of an array, one to three numbers: `[10]` is `[0]` to `[9]`. Default: no array. */
  readonly dimensions?: readonly number[]
  /** What it holds at the beginning, of an array its elements, the last index counting first. Default 0, false, ''. */
  readonly value?: PlcValue | readonly PlcValue[]
}

/** Labels by name; members of structures by their full name: `{ 'Line1.Speed': { type: 'REAL' } }`. */
export type SimulatedLabels = Readonly<Record<string, SimulatedLabel>>

interface Label {
  readonly data: LabelDataType
  readonly type: ValueType
  readonly dimensions: readonly number[]
  /** Words of one element. */
  readonly size: number
  readonly words: Uint16Array
  /** Member of a timer or counter: not for the array commands. */
  readonly isTimer: boolean
}

/** Background (error codes of the iQ-R CPU, label communications); the SLMP manual refers to the CPU's manual. */
const NO_SUCH_LABEL = 0x40c0

/** Timers and counters are structures (5.3 "Label name"): contact, coil and current value. */
const TIMERS: Readonly<Record<string, 'WORD' | 'DWORD'>> = {
  TIMER: 'WORD',
  COUNTER: 'WORD',
  'RETENTIVE TIMER': 'WORD',
  'LONG TIMER': 'DWORD',
  'LONG COUNTER': 'DWORD',
  'LONG RETENTIVE TIMER': 'DWORD',
}

/** Most elements of one label here: more than a CPU holds. */
const MOST_ELEMENTS = 1_000_000

function bad(name: string, message: string): never {
  throw new RequestError('BAD_OPTION', `labels: ${name}: ${message}`, `labels.${name}`)
}

export class LabelTable implements ProgramLabels {
  readonly #labels = new Map<string, Label>()

  /** @throws RequestError BAD_OPTION, BAD_ADDRESS, BAD_TYPE, BAD_VALUE */
  constructor(labels: SimulatedLabels) {
    for (const [name, label] of Object.entries(labels)) this.#add(name, label)
  }

  #add(given: string, label: SimulatedLabel): void {
    const { name, index } = parseLabel(given)
    if (index !== undefined) bad(name, 'the elements of an array are given by dimensions')
    const current = TIMERS[label.type.trim().toUpperCase()]
    if (current === undefined) {
      this.#define(name, label, parseType(label.type), false)
      return
    }
    if (label.dimensions !== undefined || label.value !== undefined) {
      bad(name, 'a timer or counter has neither dimensions nor a value here')
    }
    this.#define(`${name}.S`, label, { name: 'BOOL' }, true)
    this.#define(`${name}.C`, label, { name: 'BOOL' }, true)
    this.#define(`${name}.N`, label, { name: current }, true)
  }

  #define(name: string, { dimensions = [], value }: SimulatedLabel, type: ValueType, isTimer: boolean): void {
    const data = dataTypeOf(type) ?? bad(name, `no label has the type ${type.name}`)
    const elements = dimensions.reduce((product, points) => product * points, 1)
    const whole = dimensions.every((points) => Number.isInteger(points) && points > 0)
    if (!whole || dimensions.length > 3 || elements > MOST_ELEMENTS) {
      bad(name, `dimensions are one to three whole numbers from 1, not ${dimensions.join(', ')}`)
    }
    const size = sizeOf(data, type)
    const label = { data, type, dimensions, size, words: new Uint16Array(elements * size), isTimer }
    this.#labels.set(name, label)
    if (value !== undefined) this.set(name, value)
  }

  /** The value of a label or element, as the program in the PLC sees it. @throws RequestError */
  get(name: string): PlcValue {
    const { label, at } = this.#place(name)
    if (label.type.name === 'BOOL') return label.words[at] === 1
    return decodeValue(label.type, label.words, at * label.size)
  }

  /** Sets a label or element; from an element of an array on also several. @throws RequestError */
  set(name: string, value: PlcValue | readonly PlcValue[]): void {
    const { label, at } = this.#place(name)
    const values = typeof value === 'object' ? value : [value]
    const words = values.flatMap((one) => wordsOf(label, one))
    if (at * label.size + words.length > label.words.length) bad(name, `${values.length} values are too many`)
    label.words.set(words, at * label.size)
  }

  #place(text: string): { readonly label: Label; readonly at: number } {
    const address = parseLabel(text)
    const found = this.#find(address)
    if (found === undefined) throw new RequestError('BAD_ADDRESS', `There is no label ${address.name}.`)
    return found
  }

  /** Where it stands; of an array named without an index the first element. */
  #find({ name, stem, index }: LabelAddress): { readonly label: Label; readonly at: number } | undefined {
    const label = this.#labels.get(index === undefined ? name : stem)
    if (label === undefined) return undefined
    if (index === undefined) return { label, at: 0 }
    const { dimensions } = label
    if (index.length !== dimensions.length) return undefined
    if (!index.every((number, at) => number < (dimensions[at] ?? 0))) return undefined
    return { label, at: index.reduce((at, number, dimension) => at * (dimensions[dimension] ?? 1) + number, 0) }
  }

  #asked(name: string, abbreviations: readonly { readonly name: string }[]) {
    const full = expandLabel(
      name,
      abbreviations.map((abbreviation) => abbreviation.name),
    )
    const found = full === undefined ? undefined : this.#find(addressOf(full))
    if (found === undefined) throw new Refusal(NO_SUCH_LABEL, `there is no label ${full ?? name}`)
    return found
  }

  /** Label Read Random. @throws Refusal */
  read(name: string, abbreviations: readonly { readonly name: string }[]) {
    const { label, at } = this.#asked(name, abbreviations)
    const data = [...label.words.subarray(at * label.size, (at + 1) * label.size)]
    return { typeId: label.data.id, spare: 0, data }
  }

  /** Label Write Random: what writes it, so that a request is refused whole. @throws Refusal */
  writer(name: string, abbreviations: readonly { readonly name: string }[], data: readonly number[]): () => void {
    const { label, at } = this.#asked(name, abbreviations)
    if (data.length !== label.size) {
      throw new Refusal(requestErrors.content, `${name} has ${2 * label.size} bytes, ${2 * data.length} were sent`)
    }
    const written = label.data.id === BIT_TYPE_ID ? [(data[0] ?? 0) & 1] : data
    return () => label.words.set(written, at * label.size)
  }

  /** Array Label Read. @throws Refusal */
  readArray(
    name: string,
    abbreviations: readonly { readonly name: string }[],
    { unit, length }: { readonly unit: number; readonly length: number },
  ): { readonly typeId: number; readonly area: LabelArea } {
    const { label, from, to } = this.#array(name, abbreviations, unit, length)
    const typeId = label.data.id
    const words = label.words.subarray(from, to)
    return { typeId, area: { unit: unit === 0 ? 0 : 1, length, words: unit === 0 ? packed(words) : [...words] } }
  }

  /** Array Label Write: what writes it. @throws Refusal */
  arrayWriter(name: string, abbreviations: readonly { readonly name: string }[], area: LabelArea): () => void {
    const { label, from } = this.#array(name, abbreviations, area.unit, area.length)
    const words = area.unit === 0 ? unpacked(area.words, area.length) : area.words
    return () => label.words.set(words, from)
  }

  #array(name: string, abbreviations: readonly { readonly name: string }[], unit: number, length: number) {
    const { label, at } = this.#asked(name, abbreviations)
    const isBit = label.data.id === BIT_TYPE_ID
    if (label.isTimer) throw new Refusal(requestErrors.content, `${name} belongs to a timer or counter`)
    if (isBit !== (unit === 0)) throw new Refusal(requestErrors.content, `${name} is not counted in this unit`)
    if (isBit && label.dimensions.length > 1) {
      throw new Refusal(requestErrors.content, `${name}: bit arrays have one dimension here`)
    }
    const words = isBit ? length : length / 2
    const from = at * label.size
    if (words % label.size !== 0 || from + words > label.words.length) {
      throw new Refusal(requestErrors.content, `${name} has no ${length} ${isBit ? 'bits' : 'bytes'} from there`)
    }
    return { label, from, to: from + words }
  }
}

/** A name that came over the wire may be anything. */
function addressOf(name: string): LabelAddress {
  try {
    return parseLabel(name)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    throw new Refusal(NO_SUCH_LABEL, error.message)
  }
}

/** UINT and UDINT are what GX Works3 calls WORD and DWORD. */
function dataTypeOf({ name }: ValueType): LabelDataType | undefined {
  const meant = name === 'UINT' ? 'WORD' : name === 'UDINT' ? 'DWORD' : name
  return labelDataTypes.find(
    ({ title, bytes }) => parseType(bytes === undefined ? `${title}(1)` : title).name === meant,
  )
}

/** Words of one element: a string has room for its NUL (5.3: 1 byte more than an odd number, 2 more than an even one). */
function sizeOf({ bytes }: LabelDataType, { name, length = 0 }: ValueType): number {
  if (bytes !== undefined) return bytes / 2
  return name === 'WSTRING' ? length + 1 : Math.floor(length / 2) + 1
}

function wordsOf({ type, size }: Label, value: PlcValue): number[] {
  if (type.name === 'BOOL') {
    if (typeof value !== 'boolean') throw new RequestError('BAD_VALUE', `BOOL: ${String(value)} is no boolean`)
    return [value ? 1 : 0]
  }
  const words = encodeValue(type, value)
  return [...words, ...new Array<number>(size - words.length).fill(0)]
}

/** Bits into words, the first one lowest: see `LabelArea`. */
function packed(bits: ArrayLike<number>): number[] {
  const words = new Array<number>(Math.ceil(bits.length / 16)).fill(0)
  for (let at = 0; at < bits.length; at++) {
    if (bits[at] === 1) words[at >> 4] = (words[at >> 4] ?? 0) | (1 << (at & 15))
  }
  return words
}

function unpacked(words: readonly number[], bits: number): number[] {
  return Array.from({ length: bits }, (_, at) => ((words[at >> 4] ?? 0) >> (at & 15)) & 1)
}
