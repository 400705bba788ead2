// Bytes of a device address, for the tests of this folder.
import fc from 'fast-check'
import { AsciiReader, AsciiWriter } from '../../src/codec/ascii'
import { BinaryReader, BinaryWriter } from '../../src/codec/binary'
import type { ValueCodec } from '../../src/codec/cursor'
import { addressProblem } from '../../src/melsec/device/access'
import { type DeviceAddress, devices } from '../../src/melsec/device/device'

/** Binary as hexadecimal text, ASCII as it is. */
export function write<T>(codec: ValueCodec<T>, value: T, ascii: boolean, form: number): string {
  const writer = ascii ? new AsciiWriter() : new BinaryWriter()
  writer.form = form
  codec.write(writer, value)
  const bytes = writer.take()
  return ascii ? bytes.toString('latin1') : bytes.toString('hex')
}

export function readBytes<T>(codec: ValueCodec<T>, bytes: Buffer, ascii: boolean, form: number): T {
  const reader = ascii ? new AsciiReader(bytes, form) : new BinaryReader(bytes, form)
  const value = codec.read(reader)
  reader.end()
  return value
}

export function read<T>(codec: ValueCodec<T>, text: string, ascii: boolean, form: number): T {
  return readBytes(codec, Buffer.from(text, ascii ? 'latin1' : 'hex'), ascii, form)
}

const index = fc.oneof(
  fc.record({ register: fc.constant('Z' as const), number: fc.integer({ min: 0, max: 24 }) }),
  fc.record({ register: fc.constant('LZ' as const), number: fc.integer({ min: 0, max: 12 }) }),
)
const extension: fc.Arbitrary<NonNullable<DeviceAddress['extension']>> = fc.oneof(
  fc.record({ kind: fc.constant('link' as const), network: fc.integer({ min: 1, max: 239 }) }),
  fc.record({ kind: fc.constant('module' as const), unit: fc.integer({ min: 0, max: 0xfff }) }),
  fc.record({
    kind: fc.constant('cpu' as const),
    cpu: fc.constantFrom(1 as const, 2 as const, 3 as const, 4 as const),
  }),
)
const numbers = fc.oneof(
  fc.integer({ min: 0, max: 70_000 }),
  fc.integer({ min: 0, max: 0xffffffff }),
  fc.constantFrom(0, 262143, 262144, 999999, 1000000, 0xffffff, 0x1000000, 99999999, 100000000, 0xffffffff),
)

/** Every address that exists, whatever a form can say. */
export const anyAddress: fc.Arbitrary<DeviceAddress> = fc
  .record(
    {
      device: fc.constantFrom(...devices.map((info) => info.name)),
      number: numbers,
      extension,
      extensionIndex: fc.record({ register: fc.constant('Z' as const), number: fc.integer({ min: 0, max: 24 }) }),
      index,
      indirect: fc.constant(true as const),
    },
    { requiredKeys: ['device', 'number'] },
  )
  .filter((address) => addressProblem(address) === undefined)
