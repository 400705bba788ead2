/**
 * The kinds of operands of a Sharp JW and how they are written. All numbers are octal, file numbers hexadecimal.
 *
 * Sources: JW-20FL5 manual, 9-19 (relay 04033), 9-28 (TMR0000), 9-29 (register 09000); JW-21MN manual, 8-1 (KO, T-C, b) and
 * 10-6 (system memory #201); JW300 option unit manual, "Address specification" (files, bytes).
 */

import { FILE_REGISTERS, lastAddress } from '../address'

/** What one number of a kind is: one bit, one byte, or a timer, counter or MD with its current value. */
export type JwUnit = 'bit' | 'byte' | 'timer'

/** How the operands of a kind are written. */
export interface JwOperandKind {
  /** What it is called. */
  readonly title: string
  /** What one number is. */
  readonly unit: JwUnit
  /** What stands before the number; of relays and registers nothing. */
  readonly prefix: string
  /** Fewest and most digits that are taken. */
  readonly digits: readonly [fewest: number, most: number]
  /** Digits that are written, at least. */
  readonly shown: number
  /** The last number that can be written. Which exist depends on the PLC. */
  readonly last: number
  /** Of its notation. */
  readonly example: string
}

/** Every kind. A relay has 5 digits on JW20H and JW30H, 6 on a JW300; what is longer or shorter may be a byte or a slip. */
export const jwKinds = {
  relay: { title: 'relay', unit: 'bit', prefix: '', digits: [5, 6], shown: 6, last: 0o777777, example: '004033' },
  KO: {
    title: 'byte of relays',
    unit: 'byte',
    prefix: 'KO',
    digits: [4, 5],
    shown: 4,
    last: 0o77777,
    example: 'KO0403',
  },
  // The last is 999777: block 99, byte 777.
  register: {
    title: 'register',
    unit: 'byte',
    prefix: '',
    digits: [5, 6],
    shown: 5,
    last: 99 * 0o1000 + 0o777,
    example: '09012',
  },
  b: {
    title: 'byte of the current values of timers and counters',
    unit: 'byte',
    prefix: 'b',
    digits: [4, 5],
    shown: 4,
    last: 0o77777,
    example: 'b0012',
  },
  E: { title: 'register E', unit: 'byte', prefix: 'E', digits: [4, 5], shown: 4, last: 0o77777, example: 'E0012' },
  'T-C': {
    title: 'contact of a timer or counter',
    unit: 'bit',
    prefix: 'T-C',
    digits: [3, 6],
    shown: 4,
    last: 0xffff,
    example: 'T-C0012',
  },
  TMR: { title: 'timer', unit: 'timer', prefix: 'TMR', digits: [3, 6], shown: 4, last: 0xffff, example: 'TMR0012' },
  CNT: { title: 'counter', unit: 'timer', prefix: 'CNT', digits: [3, 6], shown: 4, last: 0xffff, example: 'CNT0012' },
  MD: {
    title: 'number of an MD',
    unit: 'timer',
    prefix: 'MD',
    digits: [3, 6],
    shown: 4,
    last: 0xffff,
    example: 'MD0012',
  },
  '#': {
    title: 'byte of the system memory',
    unit: 'byte',
    prefix: '#',
    digits: [3, 4],
    shown: 4,
    last: 0o2177,
    example: '#0201',
  },
  F: {
    title: 'byte of a file',
    unit: 'byte',
    prefix: 'F',
    digits: [1, 8],
    shown: 6,
    last: 0o37777777,
    example: 'F2:012345',
  },
} as const satisfies Readonly<Record<string, JwOperandKind>>

/** Name of a kind of operand. */
export type JwKindName = keyof typeof jwKinds

function isKindName(name: string): name is JwKindName {
  return Object.hasOwn(jwKinds, name)
}

/** The names of all kinds. */
export const jwKindNames: readonly JwKindName[] = Object.keys(jwKinds).filter(isKindName)

/** What is known of a kind. */
export function jwKind(name: JwKindName): JwOperandKind {
  return jwKinds[name]
}

/** Numbers of a register block: 09000 to 09777. */
export const REGISTER_BLOCK = 0o1000
/** Last byte of a file: of the file registers of a JW300 37777777 octal (8 MiB), of all others 177777 (64 KiB). */
export function lastByteOf(file: number): number {
  return lastAddress(file === FILE_REGISTERS ? { file, extended: true } : { file }) ?? 0
}
