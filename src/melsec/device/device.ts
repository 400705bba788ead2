/**
 * The devices of a MELSEC PLC as SLMP and the MC protocol (3E, 4E, 3C, 4C) address them: one row per device.
 * Source: SLMP reference manual, device codes (p. 36) and the restrictions of each command; `S` and the short form
 * of `LZ` come from the iQ-F (FX5) communication manual. What a PLC family lacks belongs to its profile, not here.
 */
import { RequestError } from '../../errors'

/** What one device is: a bit, a word of 16 bits, or a double word of 32. */
export type DeviceUnit = 'bit' | 'word' | 'doubleWord'

/** Radix of the number as an engineer writes it. */
export type Radix = 8 | 10 | 16

/** The commands that address devices, by their names in this package. */
export type DeviceCommand =
  | 'readBits'
  | 'readWords'
  | 'writeBits'
  | 'writeWords'
  | 'readRandom'
  | 'writeRandomBits'
  | 'writeRandomWords'
  | 'entryMonitorDevice'
  | 'readBlock'
  | 'writeBlock'

/** What a timer or counter device shows of the timer or counter. */
export type TimerPart = 'contact' | 'coil' | 'current value'

/** Where a device lives: `link` = also in a network module (`J1\W10`), `module`/`cpu` = only behind `U3\` or `U3E0\`. */
export type ExtensionKind = 'link' | 'module' | 'cpu'

/** What is known of a device. */
export interface DeviceRow {
  /** As GX Works writes it, e.g. `D`, `STN`. */
  readonly name: string
  /** The manual's term, e.g. `data register`. */
  readonly title: string
  /** What one device is. */
  readonly unit: DeviceUnit
  /** Of the number in GX Works' notation. Of X and Y see `octal`. */
  readonly radix: 10 | 16
  /** X and Y: numbered in octal on FX and iQ-F; the profile or the user decides. */
  readonly octal?: true
  /** Binary device code: one byte in the short form, the same value in two bytes in the long form. */
  readonly code: number
  /** ASCII device code of the short form as sent; missing where no manual gives a short form. */
  readonly text2?: string
  /** The SLMP manual allows only the long form (subcommands 0002, 0003, 0082, 0083). @internal */
  readonly longOnly?: true
  /** Timer or counter this device is a part of, e.g. `T`. */
  readonly group?: string
  /** What it shows of the timer or counter. */
  readonly part?: TimerPart
  /** May stand behind an extension of these kinds. */
  readonly extensions?: readonly ExtensionKind[]
  /** Exists only behind an extension. */
  readonly extensionOnly?: true
  /** Commands that cannot address it. @internal */
  readonly notIn?: readonly DeviceCommand[]
  /** Read Block and Write Block take it in a bit block only. @internal */
  readonly bitBlocksOnly?: true
  /** Words of one device in `readWords` and `writeWords`, when that is not 1 (or 16 bit devices to 1). @internal */
  readonly wordsPerDevice?: 2 | 4
  /** Commands in which the points must be a multiple of `wordsPerDevice`. @internal */
  readonly wholeDevices?: readonly DeviceCommand[]
  /** What an implementer must know: errata and differences between manuals. */
  readonly note?: string
}

const BLOCKS = ['readBlock', 'writeBlock'] as const
const BATCH = ['readBits', 'readWords', 'writeBits', 'writeWords'] as const

// The restrictions below are printed in the SLMP manual's sections of the commands 0401, 1401, 0403, 0801, 0406, 1406.

/** TS TC STS STC CS CC. */
const CONTACT = { notIn: ['entryMonitorDevice'], bitBlocksOnly: true } as const
/** LTS LTC LSTS LSTC. Reading LTN or LSTN gives coil and contact in the third word. */
const LONG_TIMER_CONTACT = { notIn: [...BATCH, 'readRandom', 'entryMonitorDevice', ...BLOCKS], longOnly: true } as const
/** LTN LSTN: four words per timer when read by 0401: value low, value high, b0 coil and b1 contact, system. */
const LONG_TIMER_VALUE = {
  notIn: ['writeBits', 'writeWords', 'entryMonitorDevice', ...BLOCKS],
  longOnly: true,
  wordsPerDevice: 4,
  wholeDevices: ['readWords'],
} as const
/** LCS LCC. */
const LONG_COUNTER_CONTACT = { notIn: ['readRandom', 'entryMonitorDevice', ...BLOCKS], longOnly: true } as const
/** LCN: 1401 writes it in units of two words. */
const LONG_COUNTER_VALUE = {
  notIn: ['entryMonitorDevice', ...BLOCKS],
  longOnly: true,
  wordsPerDevice: 2,
  wholeDevices: ['writeWords'],
} as const
/** LZ. */
const LONG_INDEX = { notIn: [...BATCH, ...BLOCKS], longOnly: true } as const
/** Link direct devices (SLMP p. 208). */
const LINK = { extensions: ['link'] } as const

const contact = { unit: 'bit', radix: 10, part: 'contact' } as const
const coil = { unit: 'bit', radix: 10, part: 'coil' } as const
const current = { unit: 'word', radix: 10, part: 'current value' } as const
const longCurrent = { unit: 'doubleWord', radix: 10, part: 'current value' } as const

const ROWS = [
  { name: 'SM', title: 'special relay', unit: 'bit', radix: 10, code: 0x91, text2: 'SM' },
  { name: 'SD', title: 'special register', unit: 'word', radix: 10, code: 0xa9, text2: 'SD' },
  { name: 'X', title: 'input', unit: 'bit', radix: 16, octal: true, code: 0x9c, text2: 'X*', ...LINK },
  { name: 'Y', title: 'output', unit: 'bit', radix: 16, octal: true, code: 0x9d, text2: 'Y*', ...LINK },
  { name: 'M', title: 'internal relay', unit: 'bit', radix: 10, code: 0x90, text2: 'M*' },
  { name: 'L', title: 'latch relay', unit: 'bit', radix: 10, code: 0x92, text2: 'L*' },
  { name: 'F', title: 'annunciator', unit: 'bit', radix: 10, code: 0x93, text2: 'F*' },
  { name: 'V', title: 'edge relay', unit: 'bit', radix: 10, code: 0x94, text2: 'V*' },
  { name: 'B', title: 'link relay', unit: 'bit', radix: 16, code: 0xa0, text2: 'B*', ...LINK },
  { name: 'D', title: 'data register', unit: 'word', radix: 10, code: 0xa8, text2: 'D*' },
  { name: 'W', title: 'link register', unit: 'word', radix: 16, code: 0xb4, text2: 'W*', ...LINK },
  { name: 'TS', title: 'timer contact', ...contact, group: 'T', code: 0xc1, text2: 'TS', ...CONTACT },
  { name: 'TC', title: 'timer coil', ...coil, group: 'T', code: 0xc0, text2: 'TC', ...CONTACT },
  { name: 'TN', title: 'timer current value', ...current, group: 'T', code: 0xc2, text2: 'TN' },
  { name: 'LTS', title: 'long timer contact', ...contact, group: 'LT', code: 0x51, ...LONG_TIMER_CONTACT },
  { name: 'LTC', title: 'long timer coil', ...coil, group: 'LT', code: 0x50, ...LONG_TIMER_CONTACT },
  { name: 'LTN', title: 'long timer current value', ...longCurrent, group: 'LT', code: 0x52, ...LONG_TIMER_VALUE },
  { name: 'STS', title: 'retentive timer contact', ...contact, group: 'ST', code: 0xc7, text2: 'SS', ...CONTACT },
  { name: 'STC', title: 'retentive timer coil', ...coil, group: 'ST', code: 0xc6, text2: 'SC', ...CONTACT },
  { name: 'STN', title: 'retentive timer current value', ...current, group: 'ST', code: 0xc8, text2: 'SN' },
  { name: 'LSTS', title: 'long retentive timer contact', ...contact, group: 'LST', code: 0x59, ...LONG_TIMER_CONTACT },
  { name: 'LSTC', title: 'long retentive timer coil', ...coil, group: 'LST', code: 0x58, ...LONG_TIMER_CONTACT },
  {
    name: 'LSTN',
    title: 'long retentive timer current value',
    ...longCurrent,
    group: 'LST',
    code: 0x5a,
    ...LONG_TIMER_VALUE,
  },
  { name: 'CS', title: 'counter contact', ...contact, group: 'C', code: 0xc4, text2: 'CS', ...CONTACT },
  { name: 'CC', title: 'counter coil', ...coil, group: 'C', code: 0xc3, text2: 'CC', ...CONTACT },
  { name: 'CN', title: 'counter current value', ...current, group: 'C', code: 0xc5, text2: 'CN' },
  { name: 'LCS', title: 'long counter contact', ...contact, group: 'LC', code: 0x55, ...LONG_COUNTER_CONTACT },
  { name: 'LCC', title: 'long counter coil', ...coil, group: 'LC', code: 0x54, ...LONG_COUNTER_CONTACT },
  { name: 'LCN', title: 'long counter current value', ...longCurrent, group: 'LC', code: 0x56, ...LONG_COUNTER_VALUE },
  { name: 'SB', title: 'link special relay', unit: 'bit', radix: 16, code: 0xa1, text2: 'SB', ...LINK },
  { name: 'SW', title: 'link special register', unit: 'word', radix: 16, code: 0xb5, text2: 'SW', ...LINK },
  { name: 'S', title: 'step relay', unit: 'bit', radix: 10, code: 0x98, text2: 'S*' },
  { name: 'DX', title: 'direct access input', unit: 'bit', radix: 16, code: 0xa2, text2: 'DX' },
  { name: 'DY', title: 'direct access output', unit: 'bit', radix: 16, code: 0xa3, text2: 'DY' },
  { name: 'Z', title: 'index register', unit: 'word', radix: 10, code: 0xcc, text2: 'Z*' },
  {
    name: 'LZ',
    title: 'long index register',
    unit: 'doubleWord',
    radix: 10,
    code: 0x62,
    text2: 'LZ',
    ...LONG_INDEX,
    note: 'The SLMP manual allows the long form only; the FX5 manual gives a short form, which its CPUs need.',
  },
  { name: 'R', title: 'file register (block switching)', unit: 'word', radix: 10, code: 0xaf, text2: 'R*' },
  {
    name: 'ZR',
    title: 'file register (serial number access)',
    unit: 'word',
    radix: 10,
    code: 0xb0,
    text2: 'ZR',
    note: 'The SLMP manual prints hexadecimal, the FX5 manual and GX Works decimal; it matters in ASCII code only.',
  },
  { name: 'RD', title: 'refresh data register', unit: 'word', radix: 10, code: 0x2c, longOnly: true },
  {
    name: 'G',
    title: 'module access device (buffer memory)',
    unit: 'word',
    radix: 10,
    code: 0xab,
    text2: 'G*',
    extensions: ['module', 'cpu'],
    extensionOnly: true,
  },
  {
    name: 'HG',
    title: 'CPU buffer memory, fixed scan communication area',
    unit: 'word',
    radix: 10,
    code: 0x2e,
    longOnly: true,
    extensions: ['cpu'],
    extensionOnly: true,
  },
] as const satisfies readonly DeviceRow[]

/** Name of a device as GX Works writes it, e.g. `D`, `STN`, `ZR`. */
export type DeviceName = (typeof ROWS)[number]['name']

/** The devices by name, for the compiler: what an address without a type holds, and how its number is written. */
export type DeviceTable = {
  readonly [R in (typeof ROWS)[number] as R['name']]: { readonly unit: R['unit']; readonly radix: R['radix'] }
}

/** One row of the device table. */
export interface DeviceInfo extends DeviceRow {
  /** As GX Works writes it. */
  readonly name: DeviceName
  /** ASCII device code of the long form as sent, e.g. `D***`. */
  readonly text4: string
}

/** A network (`J1\W10`), the buffer memory of a module (`U3\G100`) or of CPU No. 1 to 4 (`U3E0\HG0`). */
export type DeviceExtension =
  | {
      /** Which of the three it is. */
      readonly kind: 'link'
      /** Number of the network, 1 to 239; 0 too where an index register is added. */
      readonly network: number
    }
  | {
      readonly kind: 'module'
      /** Start I/O number of the module divided by 16: 3 is 0030H. */
      readonly unit: number
    }
  | {
      readonly kind: 'cpu'
      /** Number of the CPU in a multiple CPU system. */
      readonly cpu: 1 | 2 | 3 | 4
    }

/**
 * One device, or the head device of several. `number` is the value: X1F and octal X37 are both 31.
 * @example { device: 'D', number: 100 }
 * @example { device: 'G', number: 100, extension: { kind: 'module', unit: 3 } }   // U3\G100, start I/O number 0030
 */
export interface DeviceAddress {
  /** Name of the device, e.g. `D`. */
  readonly device: DeviceName
  /** 0 to 4294967295; what a wire form can say is less. */
  readonly number: number
  /** Where it is, when not in the CPU itself. */
  readonly extension?: DeviceExtension
  /** Index register whose value is added to the network or the start I/O number (`J1Z0\W100`). */
  readonly extensionIndex?: { readonly register: 'Z'; readonly number: number }
  /** Index register whose value is added to the device number (`D100Z2`, `D100LZ2`). */
  readonly index?: { readonly register: 'Z' | 'LZ'; readonly number: number }
  /** `@D0`: the two words at D0 hold the address of the device. */
  readonly indirect?: true
}

/** Highest index register of each kind (SLMP p. 218 and 220: iQ-R; other CPUs have fewer). */
export const LAST_INDEX = { Z: 24, LZ: 12 } as const

/** Highest device number of any wire form. */
export const LAST_NUMBER = 0xffffffff

/** Upper three digits of the start I/O numbers of CPU No. 1 to 4: 3E0H to 3E3H (SLMP p. 213). */
export const CPU_UNIT = 0x3e0

/** Every device, in the order of the manual. */
export const devices: readonly DeviceInfo[] = ROWS.map((row) => ({ ...row, text4: row.name.padEnd(4, '*') }))

const BY_NAME: ReadonlyMap<string, DeviceInfo> = new Map(devices.map((info) => [info.name, info]))

/** The device with this name (upper case), or undefined. */
export function findDevice(name: string): DeviceInfo | undefined {
  return BY_NAME.get(name)
}

/**
 * The row of a device.
 * @throws RequestError BAD_ADDRESS when there is no such device.
 */
export function deviceInfo(name: DeviceName): DeviceInfo {
  const info = BY_NAME.get(name)
  if (info === undefined) throw new RequestError('BAD_ADDRESS', `There is no device ${JSON.stringify(name)}.`)
  return info
}

/** The devices that show one timer or counter, e.g. of `T`: TS, TC, TN. Empty when there is no such timer. */
export function devicesOfGroup(group: string): readonly DeviceInfo[] {
  return devices.filter((info) => info.group === group)
}
