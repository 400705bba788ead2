/** The 1C command set in the plainest of its frames: format 1 without sum check. */
import type { Framing, Head } from '../../src/link/link'

export type Head1c = { readonly station: number; readonly pc: number }
export const HEAD_1C: Head1c = { station: 0, pc: 0xff }

const [STX, ETX, ENQ, ACK, NAK] = ['\x02', '\x03', '\x05', '\x06', '\x15']
const two = (number: number) => number.toString(16).toUpperCase().padStart(2, '0')
const headText = ({ station, pc }: Head1c) => two(station) + two(pc)
const headOf = (bytes: Buffer): Head1c => ({
  station: Number.parseInt(bytes.toString('latin1', 1, 3), 16),
  pc: Number.parseInt(bytes.toString('latin1', 3, 5), 16),
})

export const framing1c: Framing<Head1c> = {
  name: '1C format 1',
  correlation: 'order',
  request: {
    write: (head, _serial, body) => Buffer.concat([Buffer.from(ENQ + headText(head), 'latin1'), body]),
    scan(bytes, bodyLength) {
      if (bytes.length < 5) return undefined
      const head = headOf(bytes)
      const length = bodyLength(head, bytes.subarray(5))
      if (length === undefined || bytes.length < 5 + length) return undefined
      return { used: 5 + length, frame: { head, serial: undefined, body: bytes.subarray(5, 5 + length) } }
    },
  },
  response: {
    write(head, _serial, endCode, body) {
      const text = headText(head)
      if (endCode !== 0) return Buffer.from(NAK + text + two(endCode), 'latin1')
      if (body.length === 0) return Buffer.from(ACK + text, 'latin1')
      return Buffer.concat([Buffer.from(STX + text, 'latin1'), body, Buffer.from(ETX, 'latin1')])
    },
    scan(bytes) {
      if (bytes.length < 5) return undefined
      const start = bytes.toString('latin1', 0, 1)
      const head = headOf(bytes)
      const end = start === STX ? bytes.indexOf(ETX, 5, 'latin1') : start === NAK ? 7 : 5
      if (end < 0 || bytes.length < end) return undefined
      const endCode = start === NAK ? Number.parseInt(bytes.toString('latin1', 5, 7), 16) : 0
      const body = start === STX ? bytes.subarray(5, end) : Buffer.alloc(0)
      return { used: start === STX ? end + 1 : end, frame: { head, serial: undefined, endCode, body } }
    },
  },
  mismatch: (asked: Head1c, answered: Head) =>
    asked.station === answered.station && asked.pc === answered.pc ? undefined : 'another station answered',
}
