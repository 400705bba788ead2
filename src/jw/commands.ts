import { declare, field } from '../codec/codec'
import { jwAddress } from './address'

const { bytes, countOf, echo, u16, value } = field
const manual = 'JW300 option unit manual, JW-255CM commands'

/** Commands of the JW-255CM. The code is the COM byte of the frame. */
export const jwCommands = declare({
  readDataMemory: {
    title: 'Read data memory',
    code: 0x24,
    effect: 'read',
    manual,
    request: { head: value(jwAddress, 'first byte'), length: u16({ min: 1, max: 1024, doc: 'bytes' }) },
    response: { head: echo('head'), length: echo('length'), data: bytes('length') },
  },
  writeDataMemory: {
    title: 'Write data memory',
    code: 0x34,
    effect: 'write',
    manual,
    request: {
      head: value(jwAddress, 'first byte'),
      length: countOf('data', 2, { min: 1, max: 1024 }),
      data: bytes('length'),
    },
    response: { head: echo('head'), length: echo('length') },
  },
})

export type JwCommands = typeof jwCommands
