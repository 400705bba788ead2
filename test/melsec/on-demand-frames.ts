/** On-demand frames, written by hand from the layout of a request frame (SLMP reference manual 4.1) and section 5.11. */
import type { DataCode } from '../../src/codec/codec'

export interface OnDemandFrame {
  readonly frame: '3E' | '4E'
  readonly code: DataCode
  readonly bytes: Buffer
}

/** The words 0001 and 1234 from the connected station; the data in ASCII code as assumed. 4E: serial number 5678. */
export const onDemandFrames: readonly OnDemandFrame[] = [
  { frame: '3E', code: 'binary', bytes: hex('5000 00 ff ff03 00 0a00 0000 0121 0000 0100 3412') },
  { frame: '4E', code: 'binary', bytes: hex('5400 7856 0000 00 ff ff03 00 0a00 0000 0121 0000 0100 3412') },
  { frame: '3E', code: 'ascii', bytes: text('5000 00 FF 03FF 00 0014 0000 2101 0000 0001 1234') },
  { frame: '4E', code: 'ascii', bytes: text('5400 5678 0000 00 FF 03FF 00 0014 0000 2101 0000 0001 1234') },
]

export const ON_DEMAND_WORDS: readonly number[] = [0x0001, 0x1234]
export const ON_DEMAND_DATA = Buffer.from([0x01, 0x00, 0x34, 0x12])

export function hex(digits: string): Buffer {
  return Buffer.from(digits.replaceAll(' ', ''), 'hex')
}

export function text(characters: string): Buffer {
  return Buffer.from(characters.replaceAll(' ', ''), 'latin1')
}
