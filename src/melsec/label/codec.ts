// What label commands carry and width alone cannot say: names in UTF-16, and data whose length is told in bits or bytes.
import { badMessage, type Reader, type ValueCodec, type Writer } from '../../codec/codec'

const WORD_BITS = 16

/** Bytes in binary code, twice as many characters in ASCII code. */
function onWire(bytes: number, ascii: boolean): number {
  return ascii ? 2 * bytes : bytes
}

/**
 * Name of a label: number of UTF-16 units, then the units, each as a word (SLMP reference manual 5.3 "Label name").
 * The number counts the name as it is spelt, so with `%1` in it (5.3 "Label name length").
 */
export const labelName: ValueCodec<string> = {
  name: 'label name',
  takes: 'the name of a label',
  example: 'Line1.Speed',
  variable: true,
  write(writer, value) {
    if (typeof value !== 'string' || value === '') badMessage('must be the name of a label')
    if (value.length > 0xffff) badMessage(`has ${value.length} characters, must have 1 to 65535`)
    writer.uint(value.length, 2)
    writer.words(Array.from({ length: value.length }, (_, i) => value.charCodeAt(i)))
  },
  read(reader) {
    const units = reader.uint(2)
    if (units === 0) reader.fail('BAD_FIELD', 'a label name has at least one character')
    return reader
      .words(units)
      .map((unit) => String.fromCharCode(unit))
      .join('')
  },
  size: (ascii, _form, value) => onWire(2 + 2 * known(value).length, ascii),
}

/**
 * Data of one label: its length in bytes, then the data in words (SLMP reference manual 5.3 "Read data length, write
 * data length": one bit takes 2 bytes too). The words are kept; the length follows from them.
 */
export const labelData: ValueCodec<readonly number[]> = {
  name: 'label data',
  takes: 'an array of words (0 to 65535)',
  example: [1234],
  variable: true,
  write(writer, value) {
    if (!Array.isArray(value)) badMessage('must be an array of words')
    if (value.length > 0x7fff) badMessage(`has ${value.length} words, must have at most 32767`)
    writer.uint(2 * value.length, 2)
    writer.words(value)
  },
  read(reader) {
    const bytes = reader.uint(2)
    if (bytes % 2 !== 0) reader.fail('BAD_FIELD', `the data of a label are words, not ${bytes} bytes`)
    return reader.words(bytes / 2)
  },
  size: (ascii, _form, value) => onWire(2 + 2 * known(value).length, ascii),
}

/** Unit of an array's length: 0 bits, 1 bytes (SLMP reference manual 5.3 "Read unit specification"). */
export type LabelUnit = 0 | 1

/** Data of an array label. */
export interface LabelArea {
  readonly unit: LabelUnit
  /** Bits or bytes, as the unit says. */
  readonly length: number
  /** The data, filled up to whole words. Assumed of bits: the first element is the lowest bit of the first word. */
  readonly words: readonly number[]
}

/** Words that hold so many bits or bytes. */
export function wordsOfArea({ unit, length }: Pick<LabelArea, 'unit' | 'length'>): number {
  return Math.ceil(unit === 0 ? length / WORD_BITS : length / 2)
}

function checkArea(value: LabelArea): void {
  if (typeof value !== 'object' || value === null) badMessage('must be an object with unit, length and words')
  const { unit, length, words } = value
  if (unit !== 0 && unit !== 1) badMessage(`unit is ${String(unit)}, must be 0 (bits) or 1 (bytes)`)
  if (!Number.isInteger(length) || length < 0 || length > 0xffff) {
    badMessage(`length is ${String(length)}, must be 0 to 65535`)
  }
  if (!Array.isArray(words)) badMessage('words must be an array')
  if (words.length !== wordsOfArea(value)) {
    badMessage(`has ${words.length} words, ${length} ${unit === 0 ? 'bits' : 'bytes'} take ${wordsOfArea(value)}`)
  }
}

/** `spare`: a fixed 00 stands between unit and length (only in requests). */
function areaCodec(name: string, spare: 0 | 1): ValueCodec<LabelArea> {
  return {
    name,
    takes: 'an object with unit (0 bits, 1 bytes), length and words',
    example: { unit: 1, length: 2, words: [1234] },
    variable: true,
    write(writer: Writer, value) {
      checkArea(value)
      writer.uint(value.unit, 1)
      if (spare === 1) writer.uint(0, 1)
      writer.uint(value.length, 2)
      writer.words(value.words)
    },
    read(reader: Reader) {
      const unit = reader.uint(1)
      if (unit !== 0 && unit !== 1) reader.fail('BAD_FIELD', `the unit is 0 or 1, found ${unit}`)
      if (spare === 1 && reader.uint(1) !== 0) reader.fail('BAD_FIELD', 'the field behind the unit is fixed to 0')
      const length = reader.uint(2)
      return { unit, length, words: reader.words(wordsOfArea({ unit, length })) }
    },
    size: (ascii, _form, value) => onWire(3 + spare + 2 * known(value).words.length, ascii),
  }
}

/** Array data in a response: unit, length, data. */
export const labelArea = areaCodec('array data', 0)
/** Array data in a request: unit, fixed 00, length, data. */
export const writtenLabelArea = areaCodec('written array data', 1)

/** The size of these is in the bytes themselves, or in the value. */
function known<T>(value: T | undefined): T {
  if (value === undefined) throw new TypeError('The size of label data is known only with the data')
  return value
}
