// The program's side of the memory: what a simulated process or a test reads and writes, by operand and type.
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import type { JwAddress } from '../../jw/address'
import { jwKind } from '../../jw/operand/kind'
import type { JwOperandOptions } from '../../jw/operand/map'
import type { JwOperand } from '../../jw/operand/notation'
import { parseJwOperand } from '../../jw/operand/parse'
import { type JwPlace, jwAddressOf, placeOfJw } from '../../jw/operand/place'
import { timerValue } from '../../jw/operand/timer'
import { type ByteType, bytesOf, formatByteType, parseByteType } from '../../value/byte-type'
import { bytesOfValues, valuesOfBytes } from '../../value/byte-value'
import type { PlcValue, ValueFormat } from '../../value/value'
import { Refusal } from '../refusal'
import type { JwParts } from './handler'

/**
 * Memory as a program in the PLC sees it: write mode and run state do not matter.
 * Every method throws RequestError: BAD_ADDRESS, BAD_TYPE, BAD_VALUE, or OUT_OF_RANGE for what is not there.
 */
export interface JwProgramMemory {
  /**
   * The value of an operand. Without a type: BOOL of a bit, BYTE of a byte, UINT of a timer or counter.
   * @example memory.read('09012:INT'); memory.read('004033'); memory.read('F1:00001234:REAL'); memory.read('TMR0012')
   */
  read(item: string, format?: ValueFormat): PlcValue
  /** Writes the value; all of it or, when it is refused, nothing. */
  write(item: string, value: PlcValue, format?: ValueFormat): void
}

type Memory = Pick<JwParts, 'files' | 'systemMemory' | 'timers'>

/** What an item means: where, and as what. */
interface Target {
  readonly text: string
  readonly operand: JwOperand
  readonly place: JwPlace
  readonly type: ByteType
}

/** Items that are kept as they were understood. */
const MOST_PARSED = 1024

export class OperandMemory implements JwProgramMemory {
  readonly #memory: Memory
  readonly #options: JwOperandOptions
  readonly #parsed = new Map<string, Target>()

  constructor(memory: Memory, options: JwOperandOptions) {
    this.#memory = memory
    this.#options = options
    // Areas that are none are refused now, not with the first operand.
    placeOfJw({ kind: 'register', number: 0 }, options)
  }

  read(item: string, format?: ValueFormat): PlcValue {
    const target = this.#target(item)
    return inRange(item, () => this.#read(target, format))
  }

  write(item: string, value: PlcValue, format?: ValueFormat): void {
    const target = this.#target(item)
    inRange(item, () => this.#write(target, value, format))
  }

  #read({ operand, place, type }: Target, format: ValueFormat | undefined): PlcValue {
    if (place.in === 'timer') return this.#readTimer(operand, type)
    if (place.bit !== undefined) return ((this.#bytes(place, 1)[0] ?? 0) & (1 << place.bit)) !== 0
    const [value] = valuesOfBytes(type, this.#bytes(place, bytesOf(type)), 0, 1, format)
    return value ?? 0
  }

  #write({ text, operand, place, type }: Target, value: PlcValue, format: ValueFormat | undefined): void {
    if (place.in === 'timer') {
      if (type.name === 'UINT') this.#memory.timers.setValue(operand.number, value)
      else this.#memory.timers.setWord(operand.number, wordIn(value, format))
    } else if (place.bit === undefined) {
      this.#setBytes(place, bytesOfValues(type, [value], format))
    } else {
      if (typeof value !== 'boolean')
        throw new RequestError('BAD_VALUE', `${text} is true or false, not ${show(value)}.`)
      const before = this.#bytes(place, 1)[0] ?? 0
      const mask = 1 << place.bit
      this.#setBytes(place, Uint8Array.of(value ? before | mask : before & ~mask))
    }
  }

  #readTimer({ kind, number }: JwOperand, type: ByteType): PlcValue {
    const { timers } = this.#memory
    const word = timers.word(number)
    return type.name === 'UINT' ? timerValue(word, timers.attributeOf(number), kind).value : word
  }

  #bytes(place: Exclude<JwPlace, { in: 'timer' }>, length: number): Buffer {
    if (place.in === 'file') return this.#memory.files.read(addressOf(place), length)
    return this.#systemBytes(place.address, length)
  }

  #setBytes(place: Exclude<JwPlace, { in: 'timer' }>, bytes: Uint8Array): void {
    if (place.in === 'file') this.#memory.files.write(addressOf(place), bytes)
    else this.#systemBytes(place.address, bytes.length).set(bytes)
  }

  /** Operands `#` are in segment 08. */
  #systemBytes(address: number, length: number): Buffer {
    const bytes = this.#memory.systemMemory[8]?.subarray(address, address + length)
    if (bytes?.length === length) return bytes
    throw new RequestError('OUT_OF_RANGE', 'The system memory ends at #2177.')
  }

  #target(item: string): Target {
    const known = this.#parsed.get(item)
    if (known !== undefined) return known
    const target = targetOf(item, this.#options)
    if (this.#parsed.size < MOST_PARSED) this.#parsed.set(item, target)
    return target
  }
}

/** A colon in front of a digit is that of a file: `F1:00001234:REAL`. */
const ITEM = /^((?:[^:]|:(?=\s*\d))*)(?::(.*))?$/s

function targetOf(item: string, options: JwOperandOptions): Target {
  const [, first = '', typeText] = typeof item === 'string' ? (ITEM.exec(item) ?? []) : []
  const operand = parseJwOperand(first, options)
  const unit = operand.bit === undefined ? jwKind(operand.kind).unit : 'bit'
  const type = typeText === undefined ? { name: USUAL[unit] } : parseByteType(typeText)
  if (!fits(unit, type)) {
    throw new RequestError('BAD_TYPE', `${item}: ${UNITS[unit]}, not ${formatByteType(type)}.`)
  }
  return { text: item, operand, place: placeOfJw(operand, options), type }
}

const USUAL = { bit: 'BOOL', byte: 'BYTE', timer: 'UINT' } as const
type Unit = keyof typeof USUAL
const UNITS: Readonly<Record<Unit, string>> = {
  bit: 'it is one bit, a BOOL',
  byte: 'it is bytes; a bit of them is named with a dot, as 09012.0',
  timer: 'it has a current value, UINT, or its word as it is, WORD',
}

function fits(unit: Unit, { name }: ByteType): boolean {
  if (unit === 'byte') return name !== 'BOOL'
  return unit === 'bit' ? name === 'BOOL' : name === 'UINT' || name === 'WORD'
}

function addressOf(place: Extract<JwPlace, { in: 'file' }>): JwAddress {
  return jwAddressOf(place, 'extended')
}

function wordIn(value: PlcValue, format: ValueFormat | undefined): number {
  return Buffer.from(bytesOfValues({ name: 'WORD' }, [value], format)).readUInt16LE()
}

function inRange<T>(item: string, run: () => T): T {
  try {
    return run()
  } catch (error) {
    if (!(error instanceof Refusal)) throw error
    throw new RequestError('OUT_OF_RANGE', `${item}: the simulated JW refuses: ${error.message}.`)
  }
}
