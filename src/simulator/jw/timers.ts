// Timers, counters and MD of a simulated JW. Which there are, the options say: no program tells it.
import { badOption, checkBooleans, checkNames, isPlainObject, oneOf, wholeNumber } from '../../basics/option-checks'
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import type { JwAddress } from '../../jw/address'
import type { JwKindName } from '../../jw/operand/kind'
import { BITS, type JwOperandOptions, positionIn, rowWith } from '../../jw/operand/map'
import { readOperand } from '../../jw/operand/notation'
import { jwAddressOf } from '../../jw/operand/place'
import { type TimerAttribute, timerAttributes } from '../../jw/operand/timer'
import { Refusal } from '../refusal'
import type { Files } from './files'
import { result } from './result'

/** What a timer, counter or MD of a simulated JW is. */
export interface SimulatedTimer {
  /** Whether it counts down or up; of timers and counters. Default `down`. */
  readonly direction?: 'down' | 'up'
  /** How its value is coded; of timers and counters. Default `BCD`. */
  readonly coding?: 'BCD' | 'binary'
  /** Its preset, up to 7999 in BCD, 32767 in binary code: reset puts a value that counts down there, set one that counts up. Default 0. */
  readonly preset?: number
  /** Bit 15 of its word, whose meaning no manual prints. Default false. */
  readonly flag?: boolean
}

/** Timers, counters and MD by their operands: `{ TMR0000: {}, CNT0001: { direction: 'up', coding: 'binary' }, MD0002: {} }`. */
export type SimulatedTimers = Readonly<Record<string, SimulatedTimer>>

const NAMES = { direction: true, coding: true, preset: true, flag: true } as const
const MD = 1
/** Numbers are two bytes. */
const NUMBERS = 0x10000
const FLAG = 0x8000
const MOST = { BCD: 7999, binary: 32_767 } as const

interface Defined {
  readonly attribute: number
  readonly known: TimerAttribute
  readonly preset: number
}

export class Timers {
  readonly #files: Files
  readonly #options: JwOperandOptions
  readonly #defined = new Map<number, Defined>()
  /** Words of numbers whose bytes no source places. */
  readonly #elsewhere = new Map<number, number>()

  /** @throws RequestError BAD_OPTION */
  constructor(timers: SimulatedTimers, files: Files, options: JwOperandOptions) {
    this.#files = files
    this.#options = options
    if (!isPlainObject(timers)) badOption('timers', `timers is an object of operands, not ${show(timers)}.`)
    for (const [text, timer] of Object.entries(timers)) this.#define(text, timer)
  }

  /** Words and attributes of numbers in a row. @throws Refusal behind the last number there can be */
  monitor(first: number, points: number): { readonly words: number[]; readonly attributes: Uint8Array } {
    if (first + points > NUMBERS) throw new Refusal(result.capacity, 'there are no such numbers')
    const numbers = Array.from({ length: points }, (_, i) => first + i)
    return {
      words: numbers.map((number) => this.word(number)),
      attributes: Uint8Array.from(numbers, (number) => this.#defined.get(number)?.attribute ?? 0),
    }
  }

  /** Set: as if its time were over or its count reached; reset: as at its beginning. @throws Refusal */
  set(number: number, on: boolean): void {
    const defined = this.#defined.get(number)
    if (defined === undefined) throw new Refusal(result.noPreset, 'the number is no timer or counter')
    const { known, preset } = defined
    if (known.use === 'MD') throw new Refusal(result.isMd, 'an MD is neither set nor reset')
    const isUp = known.direction === 'up'
    this.setValue(number, isUp === on ? preset : 0)
  }

  word(number: number): number {
    const place = this.#placeOf(number)
    return place === undefined ? (this.#elsewhere.get(number) ?? 0) : this.#files.read(place, 2).readUInt16LE()
  }

  setWord(number: number, word: number): void {
    const place = this.#placeOf(number)
    if (place === undefined) this.#elsewhere.set(number, word)
    else this.#files.write(place, Uint8Array.of(word & 0xff, word >>> 8))
  }

  /** The attribute byte, for who reads the value by it. */
  attributeOf(number: number): number {
    return this.#defined.get(number)?.attribute ?? 0
  }

  /** Its value; bit 15 stays. @throws RequestError BAD_VALUE when it does not fit, or nobody says how it is coded */
  setValue(number: number, value: unknown): void {
    const coding = this.#defined.get(number)?.known.coding
    if (coding === undefined) {
      throw new RequestError(
        'BAD_VALUE',
        'This number is no timer or counter here: name it in the option timers, or write its WORD.',
      )
    }
    if (typeof value !== 'number' || !Number.isInteger(value) || value < 0 || value > MOST[coding]) {
      throw new RequestError(
        'BAD_VALUE',
        `A value in ${coding} is a whole number from 0 to ${MOST[coding]}, not ${show(value)}.`,
      )
    }
    const bits = coding === 'BCD' ? Number.parseInt(String(value), 16) : value
    this.setWord(number, (this.word(number) & FLAG) | bits)
  }

  #define(text: string, timer: SimulatedTimer): void {
    const field = `timers.${text}`
    const { kind, number } = operandIn(text, field)
    checkNames(`${field}.`, timer, NAMES)
    checkBooleans(timer, ['flag'])
    if (this.#defined.has(number))
      badOption(field, `${field}: timers and counters share their numbers, and this one is given twice.`)
    const { direction = 'down', coding = 'BCD', preset = 0, flag = false } = timer
    oneOf(`${field}.direction`, direction, ['down', 'up'])
    oneOf(`${field}.coding`, coding, ['BCD', 'binary'])
    wholeNumber(`${field}.preset`, preset, 0, MOST[coding])
    const attribute = kind === 'MD' ? MD : attributeFor({ use: kind, direction, coding })
    const known = timerAttributes[attribute]
    // Every use has one for each direction and coding.
    if (known === undefined) throw new TypeError(`${field}: there is no attribute ${attribute}`)
    this.#defined.set(number, { attribute, known, preset })
    if (flag) this.setWord(number, FLAG)
    if (kind !== 'MD' && direction === 'down') this.setValue(number, preset)
  }

  /** Where its two bytes are, as far as anybody says it. */
  #placeOf(number: number): JwAddress | undefined {
    const row = rowWith('b', 2 * number, this.#options)
    if (row === undefined || 2 * number + 1 > row.last) return undefined
    const address = positionIn(row, 2 * number) / BITS
    return jwAddressOf({ in: 'file', file: row.file, address }, 'extended')
  }
}

const USES = ['TMR', 'CNT', 'MD'] as const
type Use = (typeof USES)[number]

function operandIn(text: string, field: string): { readonly kind: Use; readonly number: number } {
  const operand = readOperand(text)
  const kind = USES.find((use): use is Use & JwKindName => use === operand.kind)
  if (kind === undefined)
    badOption(field, `${field}: its name is a timer (TMR0000), a counter (CNT0000) or an MD (MD0000).`)
  return { kind, number: operand.number }
}

function attributeFor({ use, direction, coding }: Pick<TimerAttribute, 'use' | 'direction' | 'coding'>): number {
  const found = Object.entries(timerAttributes).find(
    ([, known]) => known.use === use && known.direction === direction && known.coding === coding,
  )
  return Number(found?.[0])
}
