/** What tests of tags share: a family of PLCs that reads addresses, and files by hand. */
import fc from 'fast-check'
import { formatItem, parseItem } from '../../src/client/item/item'
import type { ReadTagItem } from '../../src/tags/table/check'
import type { Tag } from '../../src/tags/table/tag'
import { parseType } from '../../src/value/type'

const iqR = { xyRadix: 16 } as const

/** As a client of an iQ-R would hand it in. */
export const readItem: ReadTagItem = (item) => {
  if (/^label:/.test(item.address)) {
    return {
      ...(item.type === undefined ? {} : { type: parseType(item.type) }),
      ...(item.count === undefined ? {} : { count: item.count }),
    }
  }
  const { address, bit, digits, type, count } = parseItem(item, iqR)
  const place = { address, ...(bit === undefined ? {} : { bit }), ...(digits === undefined ? {} : { digits }) }
  const device = formatItem({ ...place, type }, iqR).replace(/:.*$/, '')
  return { device, type, ...(count === undefined ? {} : { count }) }
}

/** Lines as GX Works writes them: every cell quoted, tabs between them. */
export function gxText(...rows: readonly (readonly string[])[]): string {
  return rows.map((row) => row.map((cell) => `"${cell.replaceAll('"', '""')}"`).join('\t')).join('\r\n')
}

/** With the byte order mark, low byte first, as GX Works3 writes it. */
export function utf16(text: string): Buffer {
  return Buffer.from(`\ufeff${text}`, 'utf16le')
}

const text = fc.oneof(
  fc.string({ minLength: 1, maxLength: 12 }),
  fc.string({ unit: 'grapheme', minLength: 1, maxLength: 12 }),
  fc.constantFrom(
    "'",
    "'=1+1",
    '=cmd',
    '+1',
    '-1',
    '@D0',
    '＝１',
    'a"b',
    'a;b,c\td',
    'a\r\nb',
    ' a ',
    '1,5',
    '温度　計',
    "''-",
  ),
)
const finite = fc.double({ noNaN: true, noDefaultInfinity: true }).map((number) => number + 0)
const pair = fc.tuple(finite, finite).filter(([a, b]) => a !== b)
const scaling = fc.record(
  { kind: fc.constantFrom('linear', 'squareRoot'), raw: pair, engineering: pair, clamp: fc.boolean() },
  { requiredKeys: ['kind', 'raw', 'engineering'] },
)
const deadband = fc.record({ kind: fc.constant('absolute' as const), value: finite.map(Math.abs) })
const format = fc
  .record(
    {
      wordOrder: fc.constantFrom('low-first', 'high-first'),
      byteOrder: fc.constantFrom('low-first', 'high-first'),
      encoding: fc.constantFrom('ascii', 'shift-jis', 'utf16'),
      trimSpaces: fc.boolean(),
    },
    { requiredKeys: [] },
  )
  .filter((given) => Object.keys(given).length > 0)

/** Any row that says something that can be: numbers, so that every field may be there. */
const fields = fc.record(
  {
    address: fc.nat({ max: 9000 }).map((number) => `D${number}`),
    type: fc.constantFrom('INT', 'UINT', 'DINT', 'REAL', 'LREAL', 'BCD16', 'LINT'),
    count: fc.integer({ min: 1, max: 20 }),
    description: text,
    unit: text,
    scaling: scaling.filter(({ clamp }) => clamp !== true),
    deadband,
    scanClass: text,
    access: fc.constantFrom('read', 'readWrite'),
    min: finite.map((number) => 0 - Math.abs(number)),
    max: finite.map(Math.abs),
    format,
  },
  { requiredKeys: ['address'] },
)
const name = fc.string({ minLength: 1, maxLength: 4 }).filter((given) => given === given.trim() && given !== '')

/** Any table, of rows that are good. */
export const anyTable: fc.Arbitrary<Tag[]> = fc
  .uniqueArray(fc.tuple(name, fields), { selector: ([given]) => given.normalize('NFKC').toLowerCase(), maxLength: 6 })
  .map((rows) => rows.map(([given, row]) => ({ name: given, ...row }) as Tag))
  .filter((rows) => !JSON.stringify(rows).match(/\{[\p{L}_][\p{L}\p{M}\p{Nd}_]*\}/u))
