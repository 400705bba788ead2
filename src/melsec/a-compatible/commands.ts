// The A-compatible set: commands of the 1E frame (FX5 communication manual 39). Another set of declarations with its
// own codes, order and device codes, not options on the SLMP set.
import { declare, field } from '../../codec/codec'
import { setReset } from '../device/set-reset'
import { aCompatibleDevice } from './device'

const { bits, countOf, fixed, list, text, u8, u16, value, words } = field

const manual = 'FX5 communication manual 39.2'
const remote = 'FX5 communication manual 39.3'
const head = value(aCompatibleDevice, 'first device')
const reserved = fixed(0, 1)
const loopbackData = {
  count: countOf('data', 1, { min: 1, max: 254 }),
  data: text('count', { charset: 'hexDigits', digits: true }),
} as const

/**
 * Commands of the 1E frame. The code is the frame's subheader. What one request carries depends on the device too:
 * see a-compatible-rules.ts. Points are one byte: 256 is written as 00.
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export const aCompatibleCommands = declare({
  readBits: {
    title: 'Batch read (bit units)',
    code: 0x00,
    effect: 'read',
    manual,
    request: { head, points: u8({ min: 1, max: 256, zeroMeans: 256, doc: 'bits' }), reserved },
    response: { values: bits('points') },
  },
  readWords: {
    title: 'Batch read (word units)',
    code: 0x01,
    effect: 'read',
    manual,
    request: {
      head,
      points: u8({ min: 1, max: 256, zeroMeans: 256, doc: 'words: 1 to 64, of bit devices 1 to 32' }),
      reserved,
    },
    response: { values: words('points') },
  },
  writeBits: {
    title: 'Batch write (bit units)',
    code: 0x02,
    effect: 'write',
    manual,
    request: {
      head,
      points: countOf('values', 1, { min: 1, max: 256, zeroMeans: 256 }),
      reserved,
      values: bits('points'),
    },
    response: {},
  },
  writeWords: {
    title: 'Batch write (word units)',
    code: 0x03,
    effect: 'write',
    manual,
    request: {
      head,
      points: countOf('values', 1, { min: 1, max: 256, zeroMeans: 256 }),
      reserved,
      values: words('points'),
    },
    response: {},
  },
  writeRandomBits: {
    title: 'Test (random write, bit units)',
    code: 0x04,
    effect: 'write',
    manual,
    request: {
      points: countOf('bits', 1, { min: 1 }),
      reserved,
      bits: list('points', { device: value(aCompatibleDevice), value: value(setReset) }),
    },
    response: {},
  },
  writeRandomWords: {
    title: 'Test (random write, word units)',
    code: 0x05,
    effect: 'write',
    manual,
    request: {
      points: countOf('words', 1, { min: 1 }),
      reserved,
      words: list('points', { device: value(aCompatibleDevice), value: u16() }),
    },
    response: {},
  },
  remoteRun: { title: 'Remote RUN', code: 0x13, effect: 'control', manual: remote, request: {}, response: {} },
  remoteStop: { title: 'Remote STOP', code: 0x14, effect: 'control', manual: remote, request: {}, response: {} },
  readPcType: {
    title: 'Read PC type name',
    code: 0x15,
    effect: 'read',
    manual: 'FX5 communication manual 39.4',
    request: {},
    response: { typeCode: u8() },
  },
  loopback: {
    title: 'Loopback test',
    code: 0x16,
    effect: 'diagnose',
    manual: 'FX5 communication manual 39.5',
    request: loopbackData,
    response: loopbackData,
  },
})

/**
 * The declared commands of the 1E frame by their names.
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export type ACompatibleCommands = typeof aCompatibleCommands
/** Name of a command of the 1E frame, e.g. `loopback`. */
export type ACompatibleCommandName = keyof ACompatibleCommands

/** Whether 1E has a command of this name. */
export function isACompatible(name: string): name is ACompatibleCommandName {
  return Object.hasOwn(aCompatibleCommands, name)
}
