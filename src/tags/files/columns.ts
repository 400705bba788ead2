/** The columns of our own CSV files: what each is called, and how a tag stands in it. One declaration for reading and writing. */
import type { Tag } from '../table/tag'

/** The cells of a tag, by column: texts as they are, numbers and flags as such. */
export type TagCells = { [C in ColumnName]?: string | number | boolean }

interface Column {
  /** As it is written. Case, spaces, hyphens and underscores do not matter when it is read. */
  readonly header: string
  /** Other headers that mean nothing else. */
  readonly aliases?: readonly string[]
  readonly kind: 'text' | 'number' | 'flag'
}

/** Every column, in the order in which they are written. */
export const columns = {
  name: { header: 'Name', aliases: ['Tag Name', 'Tag'], kind: 'text' },
  address: { header: 'Address', aliases: ['Device', 'Item'], kind: 'text' },
  type: { header: 'Type', aliases: ['Data Type'], kind: 'text' },
  count: { header: 'Count', aliases: ['Array Length', 'Length'], kind: 'number' },
  description: { header: 'Description', aliases: ['Comment'], kind: 'text' },
  unit: { header: 'Unit', aliases: ['Units', 'Eng Units', 'Engineering Unit', 'Engineering Units'], kind: 'text' },
  scaling: { header: 'Scaling', aliases: ['Scaling Type'], kind: 'text' },
  rawLow: { header: 'Raw Low', kind: 'number' },
  rawHigh: { header: 'Raw High', kind: 'number' },
  engineeringLow: { header: 'Engineering Low', aliases: ['Scaled Low', 'Eng Low'], kind: 'number' },
  engineeringHigh: { header: 'Engineering High', aliases: ['Scaled High', 'Eng High'], kind: 'number' },
  clamp: { header: 'Clamp', kind: 'flag' },
  deadband: { header: 'Deadband', kind: 'text' },
  scanClass: { header: 'Scan Class', kind: 'text' },
  access: { header: 'Access', aliases: ['Client Access'], kind: 'text' },
  min: { header: 'Min', aliases: ['Minimum'], kind: 'number' },
  max: { header: 'Max', aliases: ['Maximum'], kind: 'number' },
  wordOrder: { header: 'Word Order', kind: 'text' },
  byteOrder: { header: 'Byte Order', kind: 'text' },
  encoding: { header: 'Encoding', kind: 'text' },
  trimSpaces: { header: 'Trim Spaces', kind: 'flag' },
} as const satisfies Readonly<Record<string, Column>>

/** A column of our CSV files. */
export type ColumnName = keyof typeof columns

/** Every column, in order. */
export const columnNames = Object.keys(columns) as ColumnName[]

/** What a column is. */
export function columnOf(name: ColumnName): Column {
  return columns[name]
}

function plainHeader(text: string): string {
  return text
    .normalize('NFKC')
    .toLowerCase()
    .replace(/[\s_-]/g, '')
}

const byHeader: ReadonlyMap<string, ColumnName> = new Map(
  columnNames.flatMap((name) => {
    const { header, aliases = [] } = columnOf(name)
    return [header, ...aliases].map((text): [string, ColumnName] => [plainHeader(text), name])
  }),
)

/** The column of a header; undefined for one that we do not know. */
export function columnNamed(header: string): ColumnName | undefined {
  return byHeader.get(plainHeader(header))
}

/** The cells of a tag; a percent sign marks the deadband that is one. */
export function cellsOfTag(tag: Tag): TagCells {
  const { scaling, deadband, format, access, ...fields } = tag
  const { name, address, type, count, description, unit, scanClass, min, max } = fields
  return {
    name,
    address,
    ...defined({ type, count, description, unit, scanClass, min, max }),
    ...(scaling === undefined
      ? {}
      : {
          scaling: scaling.kind,
          rawLow: scaling.raw[0],
          rawHigh: scaling.raw[1],
          engineeringLow: scaling.engineering[0],
          engineeringHigh: scaling.engineering[1],
          ...defined({ clamp: scaling.clamp }),
        }),
    ...(deadband === undefined ? {} : { deadband: `${deadband.value}${deadband.kind === 'percent' ? '%' : ''}` }),
    ...(access === undefined ? {} : { access: access === 'readWrite' ? 'RW' : 'R' }),
    ...defined({ ...format }),
  }
}

function defined<T extends object>(fields: T): { [K in keyof T]?: Exclude<T[K], undefined> } {
  const entries = Object.entries(fields).filter(([, value]) => value !== undefined)
  return Object.fromEntries(entries) as { [K in keyof T]?: Exclude<T[K], undefined> }
}

const ACCESSES: Readonly<Record<string, string>> = {
  r: 'read',
  ro: 'read',
  read: 'read',
  readonly: 'read',
  rw: 'readWrite',
  'r/w': 'readWrite',
  readwrite: 'readWrite',
  'read/write': 'readWrite',
}

const SCALINGS: Readonly<Record<string, string>> = { linear: 'linear', squareroot: 'squareRoot' }
/** Kepware and others write it where nothing is scaled. */
const NO_SCALING = /^none$/i

function known(words: Readonly<Record<string, string>>, text: string): string {
  const word = text.toLowerCase().replace(/[\s_-]/g, '')
  return Object.hasOwn(words, word) ? (words[word] ?? text) : text
}

/** The tag that the cells say; what is wrong in it is for `problemsOfTags` to find. */
export function rowOfCells(cells: TagCells, numberOf: (text: string) => number): Readonly<Record<string, unknown>> {
  const { name, address, type, count, description, unit, scanClass, access, min, max, deadband } = cells
  const { wordOrder, byteOrder, encoding, trimSpaces } = cells
  const scaling = scalingOf(cells)
  const format = defined({ wordOrder, byteOrder, encoding, trimSpaces })
  return defined({
    name,
    address,
    type,
    count,
    description,
    unit,
    scaling,
    deadband: deadband === undefined ? undefined : deadbandOf(String(deadband), numberOf),
    scanClass,
    access: access === undefined ? undefined : known(ACCESSES, String(access)),
    min,
    max,
    format: Object.keys(format).length === 0 ? undefined : format,
  })
}

function scalingOf({ scaling, rawLow, rawHigh, engineeringLow, engineeringHigh, clamp }: TagCells): unknown {
  const ends = [rawLow, rawHigh, engineeringLow, engineeringHigh]
  if (scaling === undefined && ends.every((end) => end === undefined) && clamp === undefined) return undefined
  // What is not scaled may have the limits of a form that nobody filled in.
  if (scaling !== undefined && NO_SCALING.test(String(scaling))) return undefined
  const kind = scaling === undefined ? 'linear' : known(SCALINGS, String(scaling))
  return { kind, raw: [rawLow, rawHigh], engineering: [engineeringLow, engineeringHigh], ...defined({ clamp }) }
}

function deadbandOf(text: string, numberOf: (text: string) => number): unknown {
  const [, value = '', percent] = /^(.*?)\s*([%％])?$/s.exec(text.trim()) ?? []
  return { kind: percent === undefined ? 'absolute' : 'percent', value: numberOf(value) }
}
