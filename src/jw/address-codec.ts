// How an address stands in the messages of a Sharp JW. Apart from address.ts, which programs in browsers take, too.
import type { Reader, ValueCodec, Writer } from '../codec/codec'
import { RequestError } from '../errors'
import { checkJwAddress, type JwAddress, type JwExtendedAddress, lastAddress } from './address'

const EXTENDED = 0xff

/** Basic: SEG ADRL ADRH. Extended: FF SEG ADRLL ADRLH ADRHL ADRHH. The first byte tells which. */
export const jwAddress: ValueCodec<JwAddress> = {
  name: 'address',
  takes: 'a byte such as "09012" or "F1:00001234"',
  example: { file: 0, address: 0o4000 },
  write(writer, value) {
    checkJwAddress(value)
    if (value.extended === true) {
      writer.uint(EXTENDED, 1)
      writeExtended(writer, value)
      return
    }
    writer.uint(value.file, 1)
    writer.uint(value.address, 2)
  },
  read(reader) {
    const first = reader.uint(1)
    if (first === EXTENDED) return readExtended(reader)
    return checked(reader, { file: first, address: reader.uint(2) })
  },
  size: (ascii, _form, value) => (value?.extended === true ? 6 : 3) * (ascii ? 2 : 1),
}

/** The extended form where nothing else may stand, without its marker FF: SEG ADRLL ADRLH ADRHL ADRHH. */
export const jwExtendedAddress: ValueCodec<JwExtendedAddress> = {
  name: 'extendedAddress',
  takes: 'a byte such as "09012" or "F1:00001234"',
  example: { file: 0, address: 0o4000, extended: true },
  write(writer, value) {
    if (value.extended !== true) {
      throw new RequestError('BAD_MESSAGE', 'only the extended form fits here: extended must be true')
    }
    checkJwAddress(value)
    writeExtended(writer, value)
  },
  read: readExtended,
  size: (ascii) => (ascii ? 10 : 5),
}

function writeExtended(writer: Writer, { file, address }: JwAddress): void {
  writer.uint(file, 1)
  writer.uint(address, 4)
}

function readExtended(reader: Reader): JwExtendedAddress {
  return checked(reader, { file: reader.uint(1), address: reader.uint(4), extended: true })
}

function checked<A extends JwAddress>(reader: Reader, address: A): A {
  const last = lastAddress(address)
  if (last === undefined || address.address > last) reader.fail('BAD_FIELD', 'an address that does not exist')
  return address
}
