// The clock. Its numbers are decimal digits: 59 is 59H.
import { field } from '../../codec/codec'
import { type JwDeclaration, section } from './command'

const { u8 } = field

const CONTROL = {
  oneOf: [0, 1, 2, 3, 8, 9, 10, 11],
  doc: '0000A0RS: S stop the clock, R reset below a second, A 30 s correction',
} as const
/** What a clock says is passed on as it is: one that was never set says what it likes. */
const said = u8({ bcd: true })

export const clockCommands = {
  /** 47 00 A2 -> 45 00 A2 00 | 04 08 18 03: Wednesday, 18 August 2004. */
  readDate: {
    title: 'Read date',
    code: 0xa2,
    effect: 'read',
    manual: section('A2'),
    confidence: 'printed',
    request: {},
    response: { year: said, month: said, day: said, dayOfWeek: u8({ bcd: true, doc: '0 Sunday to 6 Saturday' }) },
  },

  /** 47 00 A3 -> 45 00 A3 00 | 13 30 00: 13:30:00. */
  readTime: {
    title: 'Read time',
    code: 0xa3,
    effect: 'read',
    manual: section('A3'),
    confidence: 'printed',
    request: {},
    response: { hour: said, minute: said, second: said },
  },

  /** 47 00 B2 | 04 08 18 03: Wednesday, 18 August 2004. */
  setDate: {
    title: 'Set date',
    code: 0xb2,
    effect: 'control',
    manual: section('B2'),
    confidence: 'printed',
    request: {
      year: u8({ bcd: true, doc: 'of the century' }),
      month: u8({ bcd: true, min: 1, max: 12 }),
      day: u8({ bcd: true, min: 1, max: 31 }),
      dayOfWeek: u8({ bcd: true, max: 6, doc: '0 Sunday to 6 Saturday' }),
    },
    response: {},
  },

  /** 47 00 B3 | 13 30 00 00: 13:30:00. */
  setTime: {
    title: 'Set time',
    code: 0xb3,
    effect: 'control',
    manual: section('B3'),
    confidence: 'printed',
    request: {
      hour: u8({ bcd: true, max: 23 }),
      minute: u8({ bcd: true, max: 59 }),
      second: u8({ bcd: true, max: 59 }),
      control: u8({ ...CONTROL, default: 0 }),
    },
    response: {},
  },

  /** 47 00 B4 | 08: to the nearer whole minute. */
  correctTime: {
    title: 'Correct time',
    code: 0xb4,
    effect: 'control',
    manual: section('B4'),
    confidence: 'derived',
    request: { control: u8(CONTROL) },
    response: {},
  },
} as const satisfies Readonly<Record<string, JwDeclaration>>
