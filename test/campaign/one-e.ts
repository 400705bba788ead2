/**
 * Requests and answers of the 1E frame, by hand from the FX5 communication manual (SLMP, 1E frames: subheader is the
 * command, no length, device codes of two characters) and the FX3U-ENET-ADP manual 7.6.3 (type name).
 */
import { type Code, NotUnderstood, Reader, Writer } from './bytes'
import { type Access, type Asked, NOTHING, type Request } from './request'
import { bitsOf } from './slmp'

/** Device codes are two characters; one letter is filled up with a space. */
const DEVICES: Readonly<Record<string, 'D' | 'M'>> = { 'D ': 'D', 'M ': 'M' }

/** Bytes in front of the data of a command: command, PC number, monitoring timer. */
const HEAD = 4
/** Number, device code, points, 00. */
const DEVICE = 4 + 2 + 1 + 1

/** Bytes of the whole request at the front, or `undefined` when not even that can be seen yet. */
export function oneELength(code: Code, bytes: Buffer): number | undefined {
  const unit = code === 'ascii' ? 2 : 1
  const at = (place: number): number | undefined =>
    bytes.length < (place + 1) * unit ? undefined : new Reader(bytes.subarray(place * unit), code).number(1)
  const command = at(0)
  if (command === undefined) return undefined
  if ([0x13, 0x14, 0x15].includes(command)) return HEAD * unit
  if (command === 0x16) {
    const count = at(HEAD)
    return count === undefined ? undefined : (HEAD + 1 + count) * unit
  }
  if (command === 0x04 || command === 0x05) {
    const points = at(HEAD)
    return points === undefined ? undefined : (HEAD + 2 + points * (command === 0x04 ? 7 : 8)) * unit
  }
  const points = at(HEAD + 6)
  if (points === undefined) return undefined
  const front = (HEAD + DEVICE) * unit
  if (command === 0x02) return front + (code === 'ascii' ? points : Math.ceil(points / 2))
  return command === 0x03 ? front + 2 * points * unit : front
}

export function readOneE(code: Code, bytes: Buffer): Request {
  const reader = new Reader(bytes, code)
  const command = reader.number(1)
  if (reader.number(1) !== 0xff) throw new NotUnderstood('the PC number is not FF')
  reader.number(2) // monitoring timer
  const asked = askedBy(command, reader)
  if (reader.left > 0) throw new NotUnderstood(`${reader.left} bytes behind the request`)
  return { frame: '1E', code, command, subcommand: 0, serial: 0, route: NOTHING, ...asked }
}

function askedBy(command: number, reader: Reader): Asked {
  const none = { accesses: [], values: [], echo: NOTHING }
  switch (command) {
    case 0x15:
      return { ...none, kind: 'typeName' }
    case 0x16:
      return { ...none, kind: 'selfTest', echo: reader.rest() }
    case 0x00:
    case 0x01:
      return { ...none, kind: 'read', accesses: [accessOf(reader, command === 0x00 ? 'bit' : 'word')] }
    case 0x02:
    case 0x03: {
      const access = accessOf(reader, command === 0x02 ? 'bit' : 'word')
      const { points } = access
      const values = command === 0x02 ? bitsOf(reader, points) : Array.from({ length: points }, () => reader.number(2))
      return { ...none, kind: 'write', accesses: [access], values: [values] }
    }
    case 0x04:
    case 0x05:
      return { ...none, kind: 'write', ...testOf(reader, command === 0x04 ? 'bit' : 'word') }
    default:
      throw new NotUnderstood(`command ${command.toString(16)}`)
  }
}

/** ASCII: device code, then number; binary: number, then device code, its low byte first. */
function deviceOf(reader: Reader): Pick<Access, 'device' | 'head'> {
  const ascii = reader.code === 'ascii'
  const before = ascii ? 0 : reader.number(4)
  const code = reader.number(2)
  const head = ascii ? reader.number(4) : before
  const device = DEVICES[String.fromCharCode(code >> 8, code & 255)]
  if (device === undefined) throw new NotUnderstood(`device code ${code.toString(16)}`)
  return { device, head }
}

function accessOf(reader: Reader, unit: 'bit' | 'word'): Access {
  const place = deviceOf(reader)
  const points = reader.number(1) || 256
  if (reader.number(1) !== 0) throw new NotUnderstood('00 is wanted behind the points')
  return { ...place, unit, points }
}

/** Test: points before the devices, a value behind each. */
function testOf(reader: Reader, unit: 'bit' | 'word'): Pick<Asked, 'accesses' | 'values'> {
  const count = reader.number(1)
  if (reader.number(1) !== 0) throw new NotUnderstood('00 is wanted behind the points')
  const both = Array.from({ length: count }, () => {
    const access: Access = { ...deviceOf(reader), unit, points: 1 }
    return [access, [reader.number(unit === 'bit' ? 1 : 2)]] as const
  })
  return { accesses: both.map(([access]) => access), values: both.map(([, values]) => values) }
}

/** Normal: the command with its highest bit set, 00, data; abnormal: another end code, and behind 5BH why. */
export function writeOneE({ code }: Request, command: number, endCode: number, data: Buffer): Buffer {
  return new Writer(code)
    .number(command | 0x80, 1)
    .number(endCode, 1)
    .raw(data)
    .done()
}
