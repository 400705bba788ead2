// Values of settings that are more than a number.
import { hex } from '../../basics/hex'
import { shown } from '../../basics/show'
import { badMessage, type ValueCodec } from '../../codec/codec'

/** One byte that stands for one of several names. */
export function choice<const V extends Readonly<Record<string, number>>>(values: V): ValueCodec<keyof V & string> {
  const names = Object.keys(values) as (keyof V & string)[]
  return {
    name: 'choice',
    takes: `one of ${names.map((name) => `${name} (${hex(values[name] ?? 0, 2)}H)`).join(', ')}`,
    ...(names[0] === undefined ? {} : { example: names[0] }),
    write(writer, name) {
      const value = Object.hasOwn(values, name) ? values[name] : undefined
      if (value === undefined) badMessage(`is ${shown(name)}, must be one of ${names.join(', ')}`)
      writer.uint(value, 1)
    },
    read(reader) {
      const value = reader.uint(1)
      const found = names.find((name) => values[name] === value)
      return found ?? reader.fail('BAD_FIELD', `${hex(value, 2)}H is none of ${names.join(', ')}`)
    },
    size: () => 1,
  }
}

/** Characters 20H to 7EH, filled up with 00H. What fills the rest is not printed; 00H is what an empty name holds. */
export function filledText(length: number): ValueCodec<string> {
  return {
    name: 'text',
    takes: `a text of the characters 20H to 7EH, at most ${length}`,
    example: 'NODE1',
    write(writer, text) {
      if (typeof text !== 'string') badMessage(`must be a text, is ${shown(text)}`)
      if (text.length > length) badMessage(`has ${text.length} characters, may have ${length}`)
      if (!isPrintable(text)) badMessage('may hold only the characters 20H to 7EH (ASCII)')
      writer.text(text)
      writer.bytes(new Uint8Array(length - text.length))
    },
    read(reader) {
      const text = reader.text(length).replace(/\0+$/, '')
      return isPrintable(text) ? text : reader.fail('BAD_FIELD', 'it holds other bytes than characters 20H to 7EH')
    },
    size: () => length,
  }
}

function isPrintable(text: string): boolean {
  return /^[\x20-\x7e]*$/.test(text)
}

const STEP = 100

/** One byte of tenths of a second, in ms as every time of this package. */
export const tenthsOfSecond: ValueCodec<number> = {
  name: 'time',
  takes: `ms, 0 to ${0xff * STEP} in steps of ${STEP}`,
  example: 0,
  write(writer, ms) {
    if (!Number.isInteger(ms) || ms < 0 || ms > 0xff * STEP || ms % STEP !== 0)
      badMessage(`is ${shown(ms)}, must be 0 to ${0xff * STEP} ms in steps of ${STEP}`)
    writer.uint(ms / STEP, 1)
  },
  read: (reader) => reader.uint(1) * STEP,
  size: () => 1,
}
