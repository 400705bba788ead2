// System memory, memory size and loopback.
import { field } from '../../codec/codec'
import { type JwDeclaration, section } from './command'

const { bytes, countOf, echo, rest, u16, u8 } = field

/** The system memory ends at 2177 octal. */
const END = 0x480
const MOST = 0x400
const segment = u8({ oneOf: [0x08, 0x09], doc: 'segment of the system memory: no file number' })
const address = u16({ max: END - 1, doc: 'first byte' })
const again = { segment: echo('segment'), address: echo('address'), length: echo('length') }

export const systemCommands = {
  /** System memory. 47 00 44 | 08 81 00 02 00: #201 and #202. */
  readSystemMemory: {
    title: 'Read system memory',
    code: 0x44,
    effect: 'read',
    manual: section('44'),
    confidence: 'printed',
    open: 'What segment 9 is.',
    extent: { first: 'address', size: 'length', end: END },
    request: { segment, address, length: u16({ min: 1, max: MOST, doc: 'bytes' }) },
    response: { ...again, data: bytes('length') },
  },

  /** Size of the program memory. 47 00 4D. */
  readMemorySize: {
    title: 'Read memory size',
    code: 0x4d,
    effect: 'read',
    manual: section('4D'),
    confidence: 'printed',
    request: {},
    // Other models have other numbers.
    response: { size: u8({ doc: 'JW300: 3 32 K words, 7 64 K, 8 128 K, 9 256 K' }) },
  },

  /** Writes system memory, which holds settings of the CPU. 47 00 54 | 08 81 00 02 00 01 01: #201 and #202. */
  writeSystemMemory: {
    title: 'Write system memory',
    code: 0x54,
    effect: 'configure',
    manual: section('54'),
    confidence: 'printed',
    extent: { first: 'address', size: 'data', end: END },
    request: { segment, address, length: countOf('data', 2, { min: 1, max: MOST }), data: bytes('length') },
    response: again,
  },

  /** Size of the program memory; a JW300 cannot be told. 47 00 5D | 03. */
  setMemorySize: {
    title: 'Set memory size',
    code: 0x5d,
    effect: 'configure',
    manual: section('5D'),
    confidence: 'derived',
    models: ['jw30h'],
    request: { size: u8({ oneOf: [0x03, 0x07, 0x08, 0x09], doc: '3 32 K words, 7 64 K, 8 128 K, 9 256 K' }) },
    response: {},
  },

  /** Sends 1 to 1024 bytes, which come back. 47 00 80 | 48 45 4C 4C 4F. */
  loopback: {
    title: 'Loopback',
    code: 0x80,
    effect: 'diagnose',
    manual: section('80'),
    confidence: 'derived',
    models: ['jw300'],
    request: { data: rest({ min: 1, max: 1024 }, 'any bytes') },
    response: { data: echo('data') },
  },
} as const satisfies Readonly<Record<string, JwDeclaration>>
