import { declare, field } from '../../codec/codec'

const { bytes, countOf, u16, u32, words } = field

const buffer = { address: u32({ doc: 'buffer memory address, words' }) } as const
const points = { min: 1, max: 480 } as const
// The manual gives 2H to 780H, words x 2; every start address of the table is even, so an odd one lies within a word.
const bounds = { min: 2, max: 1920, multipleOf: 2 } as const
const byteAddress = u32({ multipleOf: 2, doc: 'bytes: buffer memory address x 2 + start address of the module type' })
const moduleNumber = u16({ doc: 'start I/O number / 16 + the number of the module type on slot 0' })
const memory = 'SLMP reference manual 5.4'
const extendUnit = 'SLMP reference manual 5.5'

/** Buffer memory: of the connected module itself, and of MELSEC-Q modules on its base. */
export const memoryCommands = declare({
  readMemory: {
    title: 'Memory Read',
    code: 0x0613,
    unit: 'none',
    effect: 'read',
    manual: memory,
    to: 'connected',
    request: { ...buffer, points: u16({ ...points, doc: 'words' }) },
    response: { values: words('points') },
  },
  writeMemory: {
    title: 'Memory Write',
    code: 0x1613,
    unit: 'none',
    effect: 'write',
    manual: memory,
    to: 'connected',
    request: { ...buffer, points: countOf('values', 2, points), values: words('points') },
    response: {},
  },
  // The data are bytes, low byte first, in ASCII code too: unlike words, whose digits come high byte first there.
  readExtendUnit: {
    title: 'Extend Unit Read',
    code: 0x0601,
    unit: 'none',
    effect: 'read',
    manual: extendUnit,
    request: { address: byteAddress, byteCount: u16({ ...bounds, doc: 'bytes: words x 2' }), moduleNumber },
    response: { data: bytes('byteCount', 'words, low byte first') },
  },
  writeExtendUnit: {
    title: 'Extend Unit Write',
    code: 0x1601,
    unit: 'none',
    effect: 'write',
    manual: extendUnit,
    request: {
      address: byteAddress,
      byteCount: countOf('data', 2, bounds),
      moduleNumber,
      data: bytes('byteCount', 'words, low byte first'),
    },
    response: {},
  },
})
