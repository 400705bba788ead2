import { declare, field } from '../../codec/codec'
import { deviceAddress } from '../device/codec'
import { setReset } from '../device/set-reset'

const { bits, countOf, doubleWords, each, list, u16, u32, value, words } = field
const device = (doc?: string) => value(deviceAddress, doc)
const manual = 'SLMP reference manual 5.2'

// Access points and block counts are one byte (two characters). The SLMP text refers to the two-byte "number of device
// points" instead; its examples and the FX5 communication manual (38.2) have one byte.
const randomDevices = {
  wordPoints: countOf('words', 1),
  doubleWordPoints: countOf('doubleWords', 1),
  words: list('wordPoints', { device: device() }, 'read as one word each'),
  doubleWords: list('doubleWordPoints', { device: device() }, 'read as two words each'),
} as const
const randomValues = { words: words('words'), doubleWords: doubleWords('doubleWords') } as const

const block = {
  head: device('first device'),
  points: u16({ min: 1, doc: 'words; of bit devices 16 points each' }),
} as const
const writtenBlock = {
  head: device('first device'),
  points: countOf('values', 2, { min: 1 }),
  values: words('points'),
} as const

/** Device access: SLMP reference manual 5.2. */
export const deviceCommands = declare({
  readBits: {
    title: 'Read (bit units)',
    code: 0x0401,
    unit: 'bit',
    effect: 'read',
    manual,
    request: { head: device('first device'), points: u16({ min: 1, doc: 'bits' }) },
    response: { values: bits('points') },
  },
  readWords: {
    title: 'Read (word units)',
    code: 0x0401,
    unit: 'word',
    effect: 'read',
    manual,
    request: { head: device('first device'), points: u16({ min: 1, doc: 'words; of bit devices 16 points each' }) },
    response: { values: words('points') },
  },
  writeBits: {
    title: 'Write (bit units)',
    code: 0x1401,
    unit: 'bit',
    effect: 'write',
    manual,
    request: { head: device('first device'), points: countOf('values', 2, { min: 1 }), values: bits('points') },
    response: {},
  },
  writeWords: {
    title: 'Write (word units)',
    code: 0x1401,
    unit: 'word',
    effect: 'write',
    manual,
    request: { head: device('first device'), points: countOf('values', 2, { min: 1 }), values: words('points') },
    response: {},
  },
  readRandom: {
    title: 'Read Random',
    code: 0x0403,
    unit: 'word',
    effect: 'read',
    manual,
    request: randomDevices,
    response: randomValues,
  },
  writeRandomBits: {
    title: 'Write Random (bit units)',
    code: 0x1402,
    unit: 'bit',
    effect: 'write',
    manual,
    request: {
      bitPoints: countOf('bits', 1, { min: 1 }),
      bits: list('bitPoints', { device: device(), value: value(setReset) }),
    },
    response: {},
  },
  writeRandomWords: {
    title: 'Write Random (word units)',
    code: 0x1402,
    unit: 'word',
    effect: 'write',
    manual,
    request: {
      wordPoints: countOf('words', 1),
      doubleWordPoints: countOf('doubleWords', 1),
      words: list('wordPoints', { device: device(), value: u16() }),
      doubleWords: list('doubleWordPoints', { device: device(), value: u32() }),
    },
    response: {},
  },
  readBlock: {
    title: 'Read Block',
    code: 0x0406,
    unit: 'word',
    effect: 'read',
    manual,
    request: {
      wordBlockCount: countOf('wordBlocks', 1),
      bitBlockCount: countOf('bitBlocks', 1),
      wordBlocks: list('wordBlockCount', block),
      bitBlocks: list('bitBlockCount', block),
    },
    response: { wordBlocks: each('wordBlocks', words('points')), bitBlocks: each('bitBlocks', words('points')) },
  },
  writeBlock: {
    title: 'Write Block',
    code: 0x1406,
    unit: 'word',
    effect: 'write',
    manual,
    request: {
      wordBlockCount: countOf('wordBlocks', 1),
      bitBlockCount: countOf('bitBlocks', 1),
      wordBlocks: list('wordBlockCount', writtenBlock),
      bitBlocks: list('bitBlockCount', writtenBlock),
    },
    response: {},
  },
  entryMonitorDevice: {
    title: 'Entry Monitor Device',
    code: 0x0801,
    unit: 'word',
    effect: 'read',
    manual,
    controlCpuOnly: true,
    request: randomDevices,
    response: {},
  },
  executeMonitor: {
    title: 'Execute Monitor',
    code: 0x0802,
    unit: 'none',
    effect: 'read',
    manual,
    controlCpuOnly: true,
    context: 'entryMonitorDevice',
    request: {},
    response: randomValues,
  },
})
