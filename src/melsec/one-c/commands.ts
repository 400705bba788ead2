// The commands of the 1C frame (FX5 communication manual 44): a set of its own, in ASCII code only. The devices are those of
// 1E, but neither the limits nor the order of the fields.
import { declare, field } from '../../codec/codec'
import { longDevice, shortDevice } from './device'
import { onOff } from './on-off'

const { bits, countOf, echo, list, text, u8, u16, value, words } = field

const manual = 'FX5 communication manual 44.4'
const remote = 'FX5 communication manual 44.5'
const bitPoints = u8({ min: 1, max: 256, zeroMeans: 256, doc: 'bits' })
const wordPoints = u8({ min: 1, doc: 'words: 1 to 64, of bit devices 1 to 32' })
const writtenWords = countOf('values', 1, { min: 1 })
const randomWords = countOf('words', 1, { min: 1 })
const head = { short: value(shortDevice, 'first device'), long: value(longDevice, 'first device') } as const
const printable = { charset: 'printable' } as const

/**
 * Commands of the 1C frame by the manual's names. The code is the two characters of the name, which stand in front of the
 * data of a request together with the message wait (front.ts). What one request carries depends on the device too (rules.ts).
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export const oneCCommands = declare({
  BR: {
    title: 'Batch read (bit units)',
    code: 0x4252,
    effect: 'read',
    manual,
    request: { head: head.short, points: bitPoints },
    response: { values: bits('points') },
  },
  WR: {
    title: 'Batch read (word units)',
    code: 0x5752,
    effect: 'read',
    manual,
    request: { head: head.short, points: wordPoints },
    response: { values: words('points') },
  },
  QR: {
    title: 'Batch read (word units)',
    code: 0x5152,
    effect: 'read',
    manual,
    request: { head: head.long, points: wordPoints },
    response: { values: words('points') },
  },
  BW: {
    title: 'Batch write (bit units)',
    code: 0x4257,
    effect: 'write',
    manual,
    request: { head: head.short, points: countOf('values', 1, { min: 1 }), values: bits('points') },
    response: {},
  },
  WW: {
    title: 'Batch write (word units)',
    code: 0x5757,
    effect: 'write',
    manual,
    request: { head: head.short, points: writtenWords, values: words('points') },
    response: {},
  },
  QW: {
    title: 'Batch write (word units)',
    code: 0x5157,
    effect: 'write',
    manual,
    request: { head: head.long, points: writtenWords, values: words('points') },
    response: {},
  },
  BT: {
    title: 'Test (random write, bit units)',
    code: 0x4254,
    effect: 'write',
    manual,
    request: {
      points: countOf('bits', 1, { min: 1 }),
      bits: list('points', { device: value(shortDevice), value: value(onOff) }),
    },
    response: {},
  },
  WT: {
    title: 'Test (random write, word units)',
    code: 0x5754,
    effect: 'write',
    manual,
    request: { points: randomWords, words: list('points', { device: value(shortDevice), value: u16() }) },
    response: {},
  },
  QT: {
    title: 'Test (random write, word units)',
    code: 0x5154,
    effect: 'write',
    manual,
    request: { points: randomWords, words: list('points', { device: value(longDevice), value: u16() }) },
    response: {},
  },
  RR: { title: 'Remote RUN', code: 0x5252, effect: 'control', manual: remote, request: {}, response: {} },
  RS: { title: 'Remote STOP', code: 0x5253, effect: 'control', manual: remote, request: {}, response: {} },
  PC: {
    title: 'Read CPU model',
    code: 0x5043,
    effect: 'read',
    manual: remote,
    request: {},
    response: { typeCode: u8() },
  },
  GW: {
    title: 'Global signal ON/OFF',
    code: 0x4757,
    effect: 'control',
    manual: 'FX5 communication manual 44.6',
    request: { on: value(onOff, 'the global signal of the channel (serial-channels.ts)') },
    response: {},
  },
  TT: {
    title: 'Loopback test',
    code: 0x5454,
    effect: 'diagnose',
    manual: 'FX5 communication manual 44.7',
    request: { length: countOf('data', 1, { min: 1, max: 254 }), data: text('length', printable) },
    response: { length: echo('length'), data: text('length', printable) },
  },
})

/** The declared commands of the 1C frame by their names. */
export type OneCCommands = typeof oneCCommands
/** Name of a command of the 1C frame, e.g. `WR`. */
export type OneCCommandName = keyof OneCCommands

/** Whether 1C has a command of this name. */
export function isOneC(name: string): name is OneCCommandName {
  return Object.hasOwn(oneCCommands, name)
}
