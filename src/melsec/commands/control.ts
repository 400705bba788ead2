import { declare, field } from '../../codec/codec'

const { countOf, fixed, text, u16, u8 } = field

const mode = u16({ oneOf: [1, 3], doc: '1 normal; 3 forced: also when another device stopped or paused the CPU' })
const manual = 'SLMP reference manual 5.6'

/** Remote control, self test and clear error: SLMP reference manual 5.6, 5.9, 5.10. */
export const controlCommands = declare({
  remoteRun: {
    title: 'Remote Run',
    code: 0x1001,
    unit: 'none',
    effect: 'control',
    manual,
    request: {
      mode,
      clearMode: u8({ max: 2, default: 0, doc: '0 keep devices; 1 clear all but the latch range; 2 clear all' }),
      reserved: fixed(0, 1),
    },
    response: {},
  },
  remoteStop: {
    title: 'Remote Stop',
    code: 0x1002,
    unit: 'none',
    effect: 'control',
    manual,
    request: { fixed: fixed(1, 2) },
    response: {},
  },
  remotePause: {
    title: 'Remote Pause',
    code: 0x1003,
    unit: 'none',
    effect: 'control',
    manual,
    request: { mode },
    response: {},
  },
  remoteLatchClear: {
    title: 'Remote Latch Clear',
    code: 0x1005,
    unit: 'none',
    effect: 'control',
    manual,
    // Erratum: the SLMP manual fixes this field to 0001, the FX5 communication manual (38.5) prints 0000.
    request: { fixed: u16({ max: 1, default: 1, doc: '1; 0 as printed in the FX5 manual' }) },
    response: {},
  },
  remoteReset: {
    title: 'Remote Reset',
    code: 0x1006,
    unit: 'none',
    effect: 'control',
    manual,
    answered: 'no',
    request: { fixed: fixed(1, 2) },
    response: {},
  },
  readTypeName: {
    title: 'Read Type Name',
    code: 0x0101,
    unit: 'none',
    effect: 'read',
    manual,
    request: {},
    response: { model: text(16, { doc: 'padded with spaces' }), modelCode: u16() },
  },
  selfTest: {
    title: 'Self Test',
    code: 0x0619,
    unit: 'none',
    effect: 'diagnose',
    manual: 'SLMP reference manual 5.9',
    to: 'connected',
    request: { count: countOf('data', 2, { min: 1, max: 960 }), data: text('count', { charset: 'hexDigits' }) },
    response: { count: countOf('data', 2, { min: 1, max: 960 }), data: text('count', { charset: 'hexDigits' }) },
  },
  clearError: {
    // Subcommand 0000; the FX5 manual's command list prints 0001, its section on the command 0000: see Profile.subcommands.
    title: 'Clear Error',
    code: 0x1617,
    unit: 'none',
    effect: 'control',
    manual: 'SLMP reference manual 5.10',
    to: 'connected',
    request: {},
    response: {},
  },
})
