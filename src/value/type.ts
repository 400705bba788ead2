/**
 * The types a device value can have, as one table, and their spelling.
 *
 * Sources: MELSEC iQ-R Programming Manual (CPU Module Instructions), 1.2 "Data Specification Method": 16-bit, 32-bit,
 * 64-bit, real and character string data; SLMP Reference Manual, "Data types" of the label commands (time).
 */
import { RequestError } from '../errors'

/** What is known of a type. */
export interface TypeInfo {
  /**
   * How the value is kept: one bit, a whole number (JavaScript number), a 64-bit whole number (BigInt), a binary coded
   * decimal (number), a floating-point number, or text.
   */
  readonly kind: 'bit' | 'integer' | 'long' | 'bcd' | 'real' | 'text'
  /** Words one value takes; 0 where words do not say it (a bit) or the length decides (text). */
  readonly words: 0 | 1 | 2 | 4
  /** Smallest and largest value, for `integer`, `long` and `bcd`. */
  readonly min?: number | bigint
  /** See `min`. */
  readonly max?: number | bigint
  /** Data type as the label editor of GX Works3 shows it, where it has the type. Accepted by `parseType`. */
  readonly gxWorks?: string
  /** The same in Japanese, simplified and traditional Chinese. Accepted, too. */
  readonly translated?: readonly string[]
  /** Other spellings accepted: only those whose width and sign nobody can take for another. */
  readonly aliases?: readonly string[]
}

/**
 * Every type: words, range and spellings. Names are those of IEC 61131-3 and GX Works; BCD16 and BCD32 are the CPU's
 * binary coded decimals of 4 and 8 digits. TIME is signed milliseconds, T#-24d20h31m23s648ms to T#24d20h31m23s647ms.
 */
export const valueTypes = {
  BOOL: { kind: 'bit', words: 0, gxWorks: 'Bit', translated: ['ビット', '位', '位元'] },
  INT: {
    kind: 'integer',
    words: 1,
    min: -0x8000,
    max: 0x7fff,
    gxWorks: 'Word [Signed]',
    translated: ['ワード[符号付き]', '字[有符号]', '字[有符號]'],
    aliases: ['INT16'],
  },
  UINT: { kind: 'integer', words: 1, min: 0, max: 0xffff, aliases: ['UINT16'] },
  WORD: {
    kind: 'integer',
    words: 1,
    min: 0,
    max: 0xffff,
    gxWorks: 'Word [Unsigned]/Bit String [16-bit]',
    translated: ['ワード[符号なし]/ビット列[16ビット]', '字[无符号]/位列[16位]', '字[無符號]/位元列[16位元]'],
  },
  DINT: {
    kind: 'integer',
    words: 2,
    min: -0x80000000,
    max: 0x7fffffff,
    gxWorks: 'Double Word [Signed]',
    translated: ['ダブルワード[符号付き]', '双字[有符号]', '雙字[有符號]'],
    aliases: ['INT32'],
  },
  UDINT: { kind: 'integer', words: 2, min: 0, max: 0xffffffff, aliases: ['UINT32'] },
  DWORD: {
    kind: 'integer',
    words: 2,
    min: 0,
    max: 0xffffffff,
    gxWorks: 'Double Word [Unsigned]/Bit String [32-bit]',
    translated: ['ダブルワード[符号なし]/ビット列[32ビット]', '双字[无符号]/位列[32位]', '雙字[無符號]/位元列[32位元]'],
  },
  LINT: { kind: 'long', words: 4, min: -(2n ** 63n), max: 2n ** 63n - 1n, aliases: ['INT64'] },
  ULINT: { kind: 'long', words: 4, min: 0n, max: 2n ** 64n - 1n, aliases: ['UINT64'] },
  REAL: {
    kind: 'real',
    words: 2,
    gxWorks: 'FLOAT [Single Precision]',
    translated: ['単精度実数', '单精度实数', '單精度實數'],
    aliases: ['FLOAT', 'FLOAT32'],
  },
  LREAL: {
    kind: 'real',
    words: 4,
    gxWorks: 'FLOAT [Double Precision]',
    translated: ['倍精度実数', '双精度实数', '雙精度實數'],
    aliases: ['FLOAT64'],
  },
  BCD16: { kind: 'bcd', words: 1, min: 0, max: 9999 },
  BCD32: { kind: 'bcd', words: 2, min: 0, max: 99999999 },
  TIME: {
    kind: 'integer',
    words: 2,
    min: -0x80000000,
    max: 0x7fffffff,
    gxWorks: 'Time',
    translated: ['時間', '时间'],
  },
  STRING: {
    kind: 'text',
    words: 0,
    gxWorks: 'String',
    translated: ['文字列', '字符串', '字串'],
    aliases: ['STR'],
  },
  WSTRING: {
    kind: 'text',
    words: 0,
    gxWorks: 'String [Unicode]',
    translated: ['文字列[Unicode]', '字符串[Unicode]', '字串[Unicode]'],
  },
} as const satisfies Record<string, TypeInfo>

/** Name of a type. */
export type TypeName = keyof typeof valueTypes
type Kind = TypeInfo['kind']
/** The names of the types of one or several kinds. */
export type TypeNameOf<K extends Kind> = {
  [N in TypeName]: (typeof valueTypes)[N]['kind'] extends K ? N : never
}[TypeName]
/** Types whose words are a number. */
export type NumberName = TypeNameOf<'integer' | 'long' | 'bcd' | 'real'>
/** Types whose words are text. */
export type TextName = TypeNameOf<'text'>

/** A type as `parseType` gives it. */
export interface ValueType {
  /** Name of the type. */
  readonly name: TypeName
  /** STRING and WSTRING only, and there always: see {@link wordsOf}. */
  readonly length?: number
}

/** One value: boolean for BOOL, BigInt for LINT and ULINT, string for STRING and WSTRING, number for the others. */
export type PlcValue = boolean | number | bigint | string

/** What the values of each kind are in JavaScript: as they are read, and all that is taken when they are written. */
interface ValueOfKind {
  readonly bit: { readonly read: boolean; readonly written: boolean }
  readonly integer: { readonly read: number; readonly written: number | bigint }
  readonly long: { readonly read: bigint; readonly written: number | bigint }
  readonly bcd: { readonly read: number; readonly written: number | bigint }
  readonly real: { readonly read: number; readonly written: number }
  readonly text: { readonly read: string; readonly written: string }
}
/** What a value of each type is in JavaScript. */
export type TypeToValue = { readonly [N in TypeName]: ValueOfKind[(typeof valueTypes)[N]['kind']]['read'] }
/** What may be written as a value of each type. */
export type TypeToWritten = { readonly [N in TypeName]: ValueOfKind[(typeof valueTypes)[N]['kind']]['written'] }

/** The spellings of one row, as far as the compiler looks them up: see {@link spellingOf}. */
type SpellingsOf<R> =
  | (R extends { readonly aliases: readonly (infer A extends string)[] } ? A : never)
  | WholeOrHalf<R extends { readonly gxWorks: infer G extends string } ? G : never>
  | WholeOrHalf<R extends { readonly translated: readonly (infer T extends string)[] } ? T : never>
/** `Word [Unsigned]/Bit String [16-bit]`: the whole, or one of the two. */
type WholeOrHalf<T extends string> = T | (T extends `${infer A}/${infer B}` ? A | B : never)
/** Spaces do not tell two types apart; in the wrong places the parser refuses them. */
type Spelling<T extends string> = string extends T
  ? string
  : T extends `${infer A} ${infer B}`
    ? Spelling<`${A}${B}`>
    : Uppercase<T>
type Spelt = { [N in TypeName as Spelling<N | SpellingsOf<(typeof valueTypes)[N]>>]: N }

/** The name of the type that a text names, in any spelling; `never` when the compiler cannot tell. */
export type TypeNamed<T extends string> =
  Spelling<T> extends infer S
    ? S extends keyof Spelt
      ? Spelt[S]
      : S extends `${infer W}(${number})`
        ? W extends keyof Spelt
          ? Extract<Spelt[W], TextName>
          : never
        : never
    : never

/**
 * What a value is in JavaScript, from the type's text in any spelling: `ValueOf<'real'>` and `ValueOf<'FLOAT [Single
 * Precision]'>` are number, `ValueOf<'STRING(20)'>` is string; for a text unknown to the compiler any {@link PlcValue}.
 */
export type ValueOf<T extends string> = [TypeNamed<T>] extends [never] ? PlcValue : TypeToValue[TypeNamed<T>]

/** Longest string the CPU handles, without the closing NUL (iQ-R Programming Manual, 1.2 "Character string data"). */
export const maxTextLength = 16383

/** Words that other packages use for a type and that are too ambiguous to accept: what to write instead. */
const hints: { readonly [name: string]: string } = {
  DOUBLE: 'LREAL is the 64-bit floating-point number, DINT and DWORD are double words',
  LONG: 'DINT has 32 bits, LINT has 64',
  ULONG: 'UDINT has 32 bits, ULINT has 64',
  LWORD: 'ULINT is the unsigned 64-bit number',
  SHORT: 'INT is the signed 16-bit number',
  USHORT: 'UINT is the unsigned 16-bit number',
  BOOLEAN: 'BOOL is the bit',
  BCD: 'BCD16 has 4 digits, BCD32 has 8',
  LBCD: 'BCD32 has 8 digits',
  BYTE: 'devices have words; UINT is the unsigned one',
  SINT: 'devices have words; INT is the signed one',
  USINT: 'devices have words; UINT is the unsigned one',
  CHAR: 'STRING(1) is one character',
  F: 'REAL is the 32-bit floating-point number',
  S: 'INT is the signed 16-bit number',
  U: 'UINT is the unsigned 16-bit number',
  L: 'DINT is the signed 32-bit number',
  D: 'UDINT is the unsigned 32-bit number, DINT the signed one',
}

function isTypeName(name: string): name is TypeName {
  return Object.hasOwn(valueTypes, name)
}

/** All names, in the table's order, e.g. for a selection list. */
export const typeNames: readonly TypeName[] = Object.keys(valueTypes).filter(isTypeName)

function rowOf(name: TypeName): TypeInfo {
  return valueTypes[name]
}

function isTextName(name: TypeName): name is TextName {
  return rowOf(name).kind === 'text'
}

const spellings: ReadonlyMap<string, TypeName> = new Map(
  typeNames.flatMap((name) => {
    const { gxWorks, translated = [], aliases = [] } = rowOf(name)
    const labels = [...(gxWorks === undefined ? [] : [gxWorks]), ...translated]
    // `Word [Unsigned]/Bit String [16-bit]`: the whole, or one of the two.
    const texts = [name, ...aliases, ...labels, ...labels.flatMap((label) => label.split('/'))]
    return texts.map((text): [string, TypeName] => [spellingOf(text), name])
  }),
)

/** A text as it is looked up: full-width characters and spaces around brackets, as input methods leave them, say nothing. */
function spellingOf(text: string): string {
  const plain = text.normalize('NFKC').trim().replace(/\s+/g, ' ')
  return plain.replace(/ ?([[\]/]) ?/g, '$1').toUpperCase()
}

function badType(message: string): RequestError {
  return new RequestError('BAD_TYPE', message)
}

function listOfTypes(): string {
  return typeNames.map((name) => (isTextName(name) ? `${name}(n)` : name)).join(' ')
}

/**
 * The type a text names. Case and spaces around do not matter; `FLOAT`, `STR(n)`, `INT16`… and GX Works' label texts
 * (`Word [Signed]`, `ワード[符号付き]`, `字[有符号]`) are accepted. STRING and WSTRING need a length from 1 to 16383.
 *
 * @throws RequestError BAD_TYPE, naming the types there are
 * @example parseType('string(20)') // { name: 'STRING', length: 20 }
 */
export function parseType(text: string): ValueType {
  const known = parsed.get(text)
  if (known !== undefined) return { ...known }
  const type = parsedType(text)
  if (parsed.size >= MOST_PARSED) parsed.clear()
  parsed.set(text, type)
  return { ...type }
}

/** Types by their texts: a list of items says the same few again and again. A program must not fill the memory. */
const parsed = new Map<string, ValueType>()
const MOST_PARSED = 200

function parsedType(text: string): ValueType {
  if (typeof text !== 'string') throw badType(`a type is a text such as REAL, not ${typeof text}`)
  const [, word = '', digits] = /^([^()]*)(?:\(\s*(\d+)\s*\))?$/.exec(text.normalize('NFKC').trim()) ?? []
  const spelling = spellingOf(word)
  const name = spellings.get(spelling)
  if (name === undefined) throw unknownType(text, spelling)
  if (digits === undefined && !isTextName(name)) return { name }
  const type = digits === undefined ? { name } : { name, length: Number(digits) }
  checkType(type)
  return type
}

function unknownType(text: string, spelling: string): RequestError {
  const bracketed = /^(W?STR(?:ING)?)\s*\[\s*(\d+)\s*\]$/.exec(spelling)
  // IEC 61131-3 writes STRING[20], but a count of elements stands in brackets here: guessing would read other words.
  const hint = bracketed
    ? `the length goes in parentheses: ${bracketed[1]}(${bracketed[2]})`
    : Object.hasOwn(hints, spelling)
      ? hints[spelling]
      : undefined
  return badType(`'${text}' is not a type${hint === undefined ? '' : `: ${hint}`}. Types: ${listOfTypes()}`)
}

/**
 * Text of a type: exact inverse of `parseType`, in the table's spelling.
 * @example formatType({ name: 'STRING', length: 20 }) // 'STRING(20)'
 */
export function formatType(type: ValueType): string {
  checkType(type)
  return type.length === undefined ? type.name : `${type.name}(${type.length})`
}

/** Refuses a type that no text names: an unknown name, text without a length, a number with one. */
export function checkType(type: ValueType): void {
  const { name, length } = type
  if (!isTypeName(name)) throw badType(`'${String(name)}' is not a type. Types: ${listOfTypes()}`)
  if (!isTextName(name)) {
    if (length !== undefined) throw badType(`${name} has no length: ${name}(${length}) is not a type, write ${name}`)
    return
  }
  if (length === undefined) throw badType(`${name} needs a length: write ${name}(20) for up to 20 characters`)
  if (!Number.isInteger(length) || length < 1 || length > maxTextLength)
    throw badType(`${name}(${length}): the length goes from 1 to ${maxTextLength}`)
}

/** A type of text. */
export type TextType = ValueType & { readonly name: TextName }

/** Whether the words of a type are text. */
export function isText(type: ValueType): type is TextType {
  return isTextName(type.name)
}

/**
 * The name of a type whose words are a number.
 * @throws RequestError BAD_TYPE for BOOL, which is a bit
 */
export function numberName({ name }: ValueType): NumberName {
  if (name === 'BOOL') throw badType('BOOL is one bit, not words: use a bit device or the bit of a word, as in D100.F')
  if (isTextName(name)) throw badType(`${name} is text, not a number`)
  return name
}

/**
 * Words one value of the type takes, whatever its format.
 *
 * STRING(n) takes n single-byte characters, as in GX Works: a Shift-JIS kanji counts 2, a UTF-8 character 1 to 4; that
 * is n / 2 words, rounded up. WSTRING(n) takes n UTF-16 units, n words; a character outside the basic plane counts 2.
 * Exactly these words are read and written. The closing NUL that GX Works reserves behind a full string is not among
 * them: a label STRING(20) takes 11 words there, so an *array* of it is STRING(21)[…] here, which takes 11 words too.
 *
 * @throws RequestError BAD_TYPE for BOOL, which is a bit: a device of bits or the bit of a word gives it
 * @example wordsOf(parseType('STRING(5)')) // 3
 */
export function wordsOf(type: ValueType): number {
  checkType(type)
  const { name, length = 0 } = type
  if (name === 'STRING') return Math.ceil(length / 2)
  if (name === 'WSTRING') return length
  return valueTypes[numberName(type)].words
}
