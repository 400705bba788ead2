import type { ValueCodec } from '../../codec/codec'
import { RequestError } from '../../errors'
import { FORM_LONG } from './codec'

/**
 * Set (`true`) or reset (`false`) of Write Random in bit units: one byte in the short form, two in the long (iQ-R) form.
 * Erratum: the SLMP manual prints the long binary value as "0100H"; the bytes are 01 00.
 */
export const setReset: ValueCodec<boolean> = {
  name: 'set/reset',
  takes: 'true (set) or false (reset)',
  example: true,
  write(writer, value) {
    if (typeof value !== 'boolean') throw new RequestError('BAD_MESSAGE', `must be true or false, is ${String(value)}`)
    writer.uint(value ? 1 : 0, widthOf(writer.form))
  },
  read(reader) {
    const read = reader.uint(widthOf(reader.form))
    if (read > 1) reader.fail('BAD_FIELD', `set/reset is 1 or 0, found ${read}`)
    return read === 1
  },
  size: (ascii, form) => widthOf(form) * (ascii ? 2 : 1),
}

function widthOf(form: number): 1 | 2 {
  return (form & FORM_LONG) === 0 ? 1 : 2
}
