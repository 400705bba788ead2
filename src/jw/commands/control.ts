// RUN and STOP of the PLC and of blocks of its program, and what may be written.
import { field } from '../../codec/codec'
import { type JwDeclaration, section } from './command'

const { echo, u16, u8 } = field

const block = u16({ max: 0x1ff })
const state = u8({ max: 1, doc: '0 run, 1 stop' })
const mode = u8({ max: 2, doc: '0 nothing, 1 data memory, 2 all memory may be written' })

export const controlCommands = {
  /** 47 00 E4 | FF 01 -> 45 00 E4 00 | FF 01 01: block 1FFH is stopped. */
  readBlockState: {
    title: 'Read block state',
    code: 0xe4,
    effect: 'read',
    manual: section('E4'),
    confidence: 'derived',
    request: { block },
    response: { block: echo('block'), state },
  },

  /** 47 00 E8 -> 45 00 E8 00 | 00: it runs. */
  readRunState: {
    title: 'Read run state',
    code: 0xe8,
    effect: 'read',
    manual: section('E8'),
    confidence: 'derived',
    request: {},
    response: { state: u8({ max: 2, doc: '0 runs, 1 stopped by this unit, 2 stopped by another unit' }) },
  },

  /** 47 00 E9 -> 45 00 E9 00 | 02: all memory may be written. */
  readWriteMode: {
    title: 'Read write mode',
    code: 0xe9,
    effect: 'read',
    manual: section('E9'),
    confidence: 'printed',
    request: {},
    response: { mode },
  },

  /** 47 00 F4 | 00 00 01: stops block 0. */
  setBlockState: {
    title: 'Stop/run block',
    code: 0xf4,
    effect: 'control',
    manual: section('F4'),
    confidence: 'derived',
    request: { block, state },
    response: { block: echo('block'), state: echo('state') },
  },

  /** 47 00 F8 | 01: stops the PLC. */
  setRunState: {
    title: 'Stop/run PLC',
    code: 0xf8,
    effect: 'control',
    manual: section('F8'),
    confidence: 'derived',
    request: { state },
    response: {},
  },

  /** 47 00 F9 | 01: data memory may be written. */
  setWriteMode: {
    title: 'Set write mode',
    code: 0xf9,
    effect: 'control',
    manual: section('F9'),
    confidence: 'derived',
    request: { mode },
    response: {},
  },
} as const satisfies Readonly<Record<string, JwDeclaration>>
