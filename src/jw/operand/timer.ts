/**
 * What command 23H says of a timer, counter or MD: a word and an attribute.
 *
 * Sources: JW300 option unit manual, command 23H (attribute bits); JW-20FL5 manual, 9-28 (names; its example answers 9234H for the
 * current value 1234 and D678H for 5678, so bit 15 of the word is not part of the value).
 */
import { hex } from '../../basics/hex'
import { ProtocolError } from '../../errors'
import type { JwKindName } from './kind'

/** What an attribute says. Missing is what it does not say. */
export interface TimerAttribute {
  readonly title: string
  /** What the number is used as. */
  readonly use?: 'TMR' | 'CNT' | 'MD'
  readonly direction?: 'down' | 'up'
  /** How the current value is coded. */
  readonly coding?: 'BCD' | 'binary'
}

/** Every attribute byte that is printed: 0000JXYZ. */
export const timerAttributes: Readonly<Record<number, TimerAttribute>> = {
  0: { title: 'not used' },
  1: { title: 'MD', use: 'MD' },
  2: { title: 'ZW counter', use: 'CNT' },
  4: { title: 'ZW timer', use: 'TMR' },
  8: { title: 'DTMR (BCD)', use: 'TMR', direction: 'down', coding: 'BCD' },
  9: { title: 'DTMR (BIN)', use: 'TMR', direction: 'down', coding: 'binary' },
  10: { title: 'UTMR (BCD)', use: 'TMR', direction: 'up', coding: 'BCD' },
  11: { title: 'UTMR (BIN)', use: 'TMR', direction: 'up', coding: 'binary' },
  12: { title: 'DCNT (BCD)', use: 'CNT', direction: 'down', coding: 'BCD' },
  13: { title: 'DCNT (BIN)', use: 'CNT', direction: 'down', coding: 'binary' },
  14: { title: 'UCNT (BCD)', use: 'CNT', direction: 'up', coding: 'BCD' },
  15: { title: 'UCNT (BIN)', use: 'CNT', direction: 'up', coding: 'binary' },
}

/** Bit 15 of the word: set in the printed example; no source says what it means. */
const FLAG = 0x8000

/** The current value of a timer or counter. */
export interface TimerValue extends TimerAttribute {
  /** 0 to 7999 in BCD, 0 to 32767 in binary code. */
  readonly value: number
  /** Bit 15 of the word, whose meaning is not printed. */
  readonly flag: boolean
}

/**
 * @param word as it arrived, low byte first
 * @param kind what the user takes the number for: a `TMR` that is a counter in the PLC is no value
 * @throws ProtocolError BAD_FIELD when the number is used as something else, when nobody says how its value is coded, or when
 *   a digit is none. It is about this value alone, not about the connection.
 * @example timerValue(0x9234, 0x08, 'TMR').value // 1234
 */
export function timerValue(word: number, attribute: number, kind: JwKindName): TimerValue {
  const known = timerAttributes[attribute]
  const fail = (why: string): never => {
    throw new ProtocolError('BAD_FIELD', `${why} Its word is ${hex(word, 4)}H; the type WORD gives it as it is.`)
  }
  if (known === undefined) return fail(`The PLC says the attribute ${hex(attribute, 2)}H, which is not printed.`)
  if (known.use !== kind) return fail(`In the PLC this number is ${known.title}, not ${kind}.`)
  if (known.coding === undefined)
    return fail(`In the PLC this number is ${known.title}, and no source says how its value is coded.`)
  const bits = word & ~FLAG
  const value = known.coding === 'binary' ? bits : decimal(bits)
  if (value === undefined) return fail('A digit of the current value is above 9.')
  return { ...known, value, flag: (word & FLAG) !== 0 }
}

function decimal(bits: number): number | undefined {
  const digits = hex(bits)
  return /^\d+$/.test(digits) ? Number(digits) : undefined
}
