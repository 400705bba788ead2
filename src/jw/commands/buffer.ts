// Specified buffers and ring buffers: areas of the memory that a program of the PLC shares with a partner.
import { field } from '../../codec/codec'
import { type JwDeclaration, section } from './command'

const { bytes, countOf, echo, fixed, u16, u8 } = field

const specified = u8({ max: 0x1f, doc: 'specified buffer (DB)' })
const ring = u8({ max: 0x0f, doc: 'ring buffer (RB)' })
const tag = fixed(0x01, 1, 'data structure (TAG)')
const definition = u8({
  oneOf: [0x00, 0x01, 0x02, 0x81, 0x82],
  doc: '0 not defined (the rest is 0), 1 direct, 2 indirect; 81H and 82H the same, but wrong (DINF)',
})
const DIRECTIONS = [0x80, 0x81] as const
const directionDoc = '80H read, 81H write (DIR)'
const file = u8({ doc: 'file of the buffer (BSEG)' })
const address = u16({ doc: 'first byte of the buffer (BADR)' })
const size = u16({ doc: 'bytes of the buffer (LB)' })
/** Where the definition itself is kept. */
const information = {
  informationFile: u8({ doc: 'file of the definition (ISEG)' }),
  informationAddress: u16({ doc: 'first byte of the definition (IADR)' }),
}
const pointers = { writePointer: u16({ doc: 'WP' }), readPointer: u16({ doc: 'RP' }) }

export const bufferCommands = {
  /** 1 to 1024 bytes of a specified buffer. 47 00 28 | 1F 01 10 00 03 00: bytes 16 to 18 of buffer 1FH. */
  readSpecifiedBuffer: {
    title: 'Read specified buffer',
    code: 0x28,
    effect: 'read',
    manual: section('28'),
    confidence: 'derived',
    request: { buffer: specified, tag, offset: u16({ doc: 'IP' }), length: u16({ min: 1, max: 1024 }) },
    response: {
      buffer: echo('buffer'),
      tag,
      offset: echo('offset'),
      length: echo('length'),
      data: bytes('length'),
    },
  },

  /**
   * Takes up to 1024 bytes out of a ring buffer. It moves the read pointer, so that it counts as a write: what was read and
   * lost on the way does not come again. 47 00 29 | 0F 01 01 00 04: up to 1024 bytes of buffer 0FH.
   */
  readRingBuffer: {
    title: 'Read ring buffer',
    code: 0x29,
    effect: 'write',
    manual: section('29'),
    confidence: 'assumed',
    open: 'The bits of the function switch, which only 39H explains. LR is printed from 1 on although LC may be 0: 0 is taken.',
    request: {
      buffer: ring,
      function: u8({ doc: 'function switch (FUN)' }),
      tag,
      length: u16({ max: 1024, doc: 'bytes wanted (LC)' }),
    },
    response: {
      buffer: echo('buffer'),
      tag,
      pointer: u16({ doc: 'read pointer of the data (RP)' }),
      count: countOf('data', 2, { max: 1024, atMost: 'length', doc: 'bytes read (LR)' }),
      more: u8({ max: 1, doc: '1: there are more that nobody has read' }),
      data: bytes('count'),
    },
  },

  /** Writes 1 to 1024 bytes of a specified buffer. 47 00 38 | 00 01 00 00 02 00 68 69. */
  writeSpecifiedBuffer: {
    title: 'Write specified buffer',
    code: 0x38,
    effect: 'write',
    manual: section('38'),
    confidence: 'derived',
    request: {
      buffer: specified,
      tag,
      offset: u16({ doc: 'IP' }),
      length: countOf('data', 2, { min: 1, max: 1024 }),
      data: bytes('length'),
    },
    response: { buffer: echo('buffer'), tag, offset: echo('offset'), length: echo('length') },
  },

  /** Puts up to 1024 bytes into a ring buffer; it moves the write pointer. 47 00 39 | 00 01 01 02 00 68 69. */
  writeRingBuffer: {
    title: 'Write ring buffer',
    code: 0x39,
    effect: 'write',
    manual: section('39'),
    confidence: 'derived',
    request: {
      buffer: ring,
      function: u8({
        oneOf: [0x00, 0x01, 0x02, 0x03, 0x80, 0x81, 0x82, 0x83],
        doc: 'bit 0 write, bit 1 the last answer has arrived, bit 7 of the confirmed type (FUN)',
      }),
      tag,
      length: countOf('data', 2, { max: 0x400, doc: 'bytes to be written (LC)' }),
      data: bytes('length'),
    },
    response: {
      buffer: echo('buffer'),
      tag,
      pointer: u16({ doc: 'write pointer before (WP)' }),
      written: u16({ max: 1024, doc: 'bytes written (LR)' }),
      free: u16({ doc: 'bytes that are free now (LE)' }),
    },
  },

  /** Where a specified buffer is. 47 00 68 | 01. */
  readSpecifiedBufferInformation: {
    title: 'Read specified buffer information',
    code: 0x68,
    effect: 'read',
    manual: section('68'),
    confidence: 'derived',
    open: 'The table of the answer ends with a cell without a name, which its text does not count: it is not expected.',
    request: { buffer: specified },
    response: { buffer: echo('buffer'), tag, definition, ...information, file, address, length: size },
  },

  /** Where a ring buffer is, and its pointers. 47 00 69 | 00. */
  readRingBufferInformation: {
    title: 'Read ring buffer information',
    code: 0x69,
    effect: 'read',
    manual: section('69'),
    confidence: 'derived',
    request: { buffer: ring },
    response: {
      buffer: echo('buffer'),
      tag,
      definition,
      ...information,
      file,
      address,
      ...pointers,
      direction: u8({ oneOf: [0, ...DIRECTIONS], doc: directionDoc }),
      length: size,
    },
  },

  /** Defines a specified buffer. 47 00 78 | 01 01 02 01 00 20 00 04: 1024 bytes of file 1 from 020000 octal on. */
  writeSpecifiedBufferInformation: {
    title: 'Write specified buffer information',
    code: 0x78,
    effect: 'configure',
    manual: section('78'),
    confidence: 'derived',
    request: {
      buffer: specified,
      tag,
      definition: u8({ oneOf: [0x02], doc: '2 indirect' }),
      file,
      address,
      length: size,
    },
    response: { buffer: echo('buffer') },
  },

  /** Defines a ring buffer. 47 00 79 | 00 01 01 01 00 30 00 00 00 00 81 00 04. */
  writeRingBufferInformation: {
    title: 'Write ring buffer information',
    code: 0x79,
    effect: 'configure',
    manual: section('79'),
    confidence: 'derived',
    request: {
      buffer: ring,
      tag,
      definition: u8({ oneOf: [0x01, 0x02], doc: '1 direct, 2 indirect' }),
      file,
      address,
      ...pointers,
      direction: u8({ oneOf: DIRECTIONS, doc: directionDoc }),
      length: size,
    },
    response: { buffer: echo('buffer') },
  },
} as const satisfies Readonly<Record<string, JwDeclaration>>
