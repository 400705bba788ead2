/** Data types as the label editors of GX Works write them: with arrays, and with what is no type of a value. */
import { RequestError } from '../../errors'
import { formatType, parseType, type ValueType, valueTypes } from '../../value/type'

/** The type of a label. */
export interface GxType {
  /** As GX Works declares it; see `storedType` for arrays of texts. */
  readonly type: ValueType
  /** Elements of an array, of all its dimensions. */
  readonly count?: number
  /** The index of the first element, for each dimension: `0`, `1,0`. */
  readonly first?: string
}

const DIMENSIONS = String.raw`-?\d+\.\.-?\d+(?:,-?\d+\.\.-?\d+)*`
/** `Word [Signed](0..4)`, `INT[0..4]`. */
const ARRAY = new RegExp(String.raw`^(.*?)\s*[([](${DIMENSIONS})[)\]]$`)
/** `ARRAY [0..4] OF INT`. */
const ARRAY_OF = new RegExp(String.raw`^ARRAY\s*[([](${DIMENSIONS})[)\]]\s*OF\s+(.*)$`, 'i')
/** What the value of a timer or counter is depends on which of its three devices is meant. */
const TIMER = /timer|counter|タイマ|カウンタ|定时器|計時器|定時器|计数器|計數器/i

/**
 * @throws RequestError BAD_TYPE saying why it is none
 * @example gxTypeOf('Word [Signed](0..4)')   // { type: { name: 'INT' }, count: 5, first: '0' }
 */
export function gxTypeOf(text: string): GxType {
  const plain = text.normalize('NFKC').trim()
  const compact = plain.replace(/\s*(\.\.|,)\s*/g, '$1')
  const [, ofDimensions, ofBase] = ARRAY_OF.exec(compact) ?? []
  const [, base = ofBase ?? plain, dimensions = ofDimensions] = ARRAY.exec(compact) ?? []
  if (TIMER.test(base)) {
    throw new RequestError(
      'BAD_TYPE',
      `${text} is three devices, contact, coil and current value: make a tag of each that is needed.`,
    )
  }
  const type = baseType(base)
  if (type === undefined) {
    throw new RequestError(
      'BAD_TYPE',
      `${text} is no type of a value: of a structure or function block make tags of its members.`,
    )
  }
  return dimensions === undefined ? { type } : { type, ...extentOf(dimensions, text) }
}

function baseType(text: string): ValueType | undefined {
  // GX Works2 writes round brackets; editions name the other half of a word or bit string in different ways.
  const readings = [text, text.replace(/\(([^()\d]+)\)$/, '[$1]'), text.split('/')[0] ?? text]
  let refused: RequestError | undefined
  for (const reading of readings) {
    try {
      return parseType(reading)
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      refused ??= error
    }
  }
  // A text without a length is a text all the same.
  if (refused !== undefined && /needs a length|the length goes/.test(refused.message)) throw refused
  return undefined
}

function extentOf(dimensions: string, text: string): { readonly count: number; readonly first: string } {
  const ends = dimensions.split(',').map((dimension) => dimension.split('..').map(Number))
  const sizes = ends.map(([low = 0, high = 0]) => high - low + 1)
  if (sizes.some((size) => size < 1)) throw new RequestError('BAD_TYPE', `${text}: an array ends before it begins.`)
  return { count: sizes.reduce((product, size) => product * size, 1), first: ends.map(([low]) => low).join(',') }
}

/**
 * The type that takes the words which GX Works gives each element: behind a text it keeps a NUL, so in an array the distance is one of a
 * text that is longer.
 */
export function storedType({ type, count }: GxType): string {
  const { name, length } = type
  if (count === undefined || length === undefined) return formatType(type)
  if (name === 'WSTRING') return formatType({ name, length: length + 1 })
  return formatType({ name, length: length % 2 === 0 ? length + 1 : length })
}

/** A type as the label editor of GX Works3 shows it, in English; undefined where it has none that takes the same words. */
export function gxNameOf(type: ValueType, count: number | undefined): string | undefined {
  const row = valueTypes[type.name]
  const name = 'gxWorks' in row ? row.gxWorks : SAME_RANGE[type.name]
  if (name === undefined) return undefined
  const array = count === undefined ? '' : `(0..${count - 1})`
  if (type.length === undefined) return `${name}${array}`
  const declared = [type.length, type.length - 1].find((length) => {
    const back =
      length < 1 ? undefined : storedType({ type: { ...type, length }, ...(count === undefined ? {} : { count }) })
    return back === formatType(type)
  })
  return declared === undefined ? undefined : `${name}(${declared})${array}`
}

const SAME_RANGE: Readonly<Partial<Record<ValueType['name'], string>>> = {
  UINT: valueTypes.WORD.gxWorks,
  UDINT: valueTypes.DWORD.gxWorks,
}
