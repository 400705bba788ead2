// Parameters of option units and of special I/O, as the CPU of a JW300 keeps them. Addresses are printed in octal.
import { field } from '../../codec/codec'
import { type JwDeclaration, section } from './command'

const { bytes, countOf, echo, u16, u8 } = field

const unit = { rack: u8({ max: 7 }), unit: u8({ max: 7 }) }
/** 0000 to 3777 octal. */
const option = { end: 0x800, most: 1024 } as const
/** 000 to 177 octal. */
const specialIo = { end: 0x80, most: 128 } as const

const reading = <const M extends number>({ end, most }: { end: number; most: M }) => ({
  extent: { first: 'address', size: 'length', end },
  request: {
    ...unit,
    address: u16({ max: end - 1, doc: 'first parameter' }),
    length: u16({ min: 1, max: most, doc: 'bytes' }),
  },
  response: {
    rack: echo('rack'),
    unit: echo('unit'),
    address: echo('address'),
    length: echo('length'),
    data: bytes('length'),
  },
})

const writing = ({ end, most }: { end: number; most: number }) => ({
  extent: { first: 'address', size: 'data', end },
  request: {
    ...unit,
    address: u16({ max: end - 1, doc: 'first parameter' }),
    length: countOf('data', 2, { min: 1, max: most }),
    data: bytes('length'),
  },
  response: { rack: echo('rack'), unit: echo('unit'), address: echo('address'), length: echo('length') },
})

export const parameterCommands = {
  /** Parameters of an option unit. 47 00 02 | 00 07 FF 07 01 00: the start switch 3777 of unit 7. */
  readOptionParameters: {
    title: 'Read option unit parameters',
    code: 0x02,
    effect: 'read',
    manual: section('02'),
    confidence: 'derived',
    models: ['jw300'],
    ...reading(option),
  },

  /** Parameters of a special I/O unit. 47 00 03 | 00 03 10 00 02 00. */
  readSpecialIoParameters: {
    title: 'Read special I/O parameters',
    code: 0x03,
    effect: 'read',
    manual: section('03'),
    confidence: 'derived',
    models: ['jw300'],
    ...reading(specialIo),
  },

  /**
   * Writes parameters of an option unit, which takes them while its start switch (3777) is 0.
   * 47 00 12 | 00 02 FF 07 01 00 00: the start switch of unit 2 to 0.
   */
  writeOptionParameters: {
    title: 'Write option unit parameters',
    code: 0x12,
    effect: 'configure',
    manual: section('12'),
    confidence: 'derived',
    open: 'The result code while the start switch is 1: 07H or 10H are likely.',
    models: ['jw300'],
    ...writing(option),
  },

  /** Writes parameters of a special I/O unit. 47 00 13 | 00 03 00 00 02 00 AA 55. */
  writeSpecialIoParameters: {
    title: 'Write special I/O parameters',
    code: 0x13,
    effect: 'configure',
    manual: section('13'),
    confidence: 'derived',
    models: ['jw300'],
    ...writing(specialIo),
  },
} as const satisfies Readonly<Record<string, JwDeclaration>>
