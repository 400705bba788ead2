/**
 * Texts put together at random, read by the parser and by the compiler: what a text gives when it is read always fits the
 * type that was inferred of it. A text that is refused gives nothing, so of it any type is true.
 */
import { execFile } from 'node:child_process'
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { promisify } from 'node:util'
import { afterAll, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type ItemParseOptions, tryParseItem } from '../../src/client/item/item'
import { type AnyItem, hasPrefix, labelInstead, parsedLabel } from '../../src/client/label/in-items'
import { devices } from '../../src/melsec/device/device'
import { profiles } from '../../src/melsec/profiles/profiles'
import { type TypeName, typeNames, valueTypes } from '../../src/value/value'
import { root } from '../support/root'

const TEXTS = 2000
const NUMBERS = [
  '0',
  '5',
  '10',
  '007',
  '16',
  '1F',
  'A',
  'FACE',
  'ED',
  '0x1',
  '1e2',
  '1.5',
  '-1',
  '1_0',
  '',
  'O',
  '99999999999',
]
const BEFORE = ['', '', '', '', 'K4', 'k8', 'K9', 'K04', '@', 'U3\\', 'U3E0\\', 'u3¥', 'J1\\', 'J1/', 'U3Z1\\', ' ']
const BEHIND = ['', '', '', '', '.F', '.0', '.f', '.G', '.15', 'Z1', 'LZ1', 'Z1.3', 'Z99', 'H', ' ']
const COUNTS = ['', '', '', '[4]', '[ 2 ]', '[0]', '[x]', '[]', '[4][2]', '[0x2]', '[1e1]', '[1,2]', ',3', ', 2', ',0']
const LABELS = [
  ...[
    'Line1.Speed',
    'Motor_1',
    'Values[2]',
    'Table[1,0,3]',
    'X.Speed',
    'Line1.F',
    '速度',
    'Größe',
    'ſM0',
    'K4_Motor',
    'R_1',
  ],
  ...[
    'XFACE',
    'WED',
    'BED',
    'SBED',
    'Dad',
    'Face',
    'Yada',
    'LZed',
    'GED',
    'CSA',
    'TN',
    'label:D100',
    'LABEL:M1',
    'label:X[2]',
    '\tlabel:X[2]',
    '\u3000LABEL:Speed[1]',
  ],
]

const labels = Object.values(valueTypes).flatMap((row) => [
  ...('gxWorks' in row ? [row.gxWorks] : []),
  ...('translated' in row ? row.translated : []),
  ...('aliases' in row ? row.aliases : []),
])
const spellings = [...typeNames, ...labels, ...labels.flatMap((label) => label.split('/')), 'FOO', 'F']
const names = devices.map(({ name }) => name)

const one = (texts: readonly string[]) => fc.constantFrom(...texts)
const joined = (...parts: readonly fc.Arbitrary<string>[]) => fc.tuple(...parts).map((texts) => texts.join(''))
/** Mostly nothing, or what is usual, because with all at once hardly a text is an item. */
const rarely = (usual: fc.Arbitrary<string>, texts: fc.Arbitrary<string>) =>
  fc.oneof({ arbitrary: usual, weight: 4 }, { arbitrary: texts, weight: 1 })
const nothing = fc.constant('')
const either = (texts: fc.Arbitrary<string>) =>
  rarely(
    texts,
    texts.map((text) => text.toLowerCase()),
  )

const number = rarely(one(['0', '5', '10']), one(NUMBERS))
const device = joined(rarely(nothing, one(BEFORE)), either(one(names)), number, rarely(nothing, one(BEHIND)))
const range = fc
  .tuple(
    one(['', '', 'K4']),
    one(names),
    one(['0', '10', 'A']),
    one(['..', ' .. ', '...']),
    one(['9', '15', '1F', '19.F']),
  )
  .map(([digits, name, first, dots, last]) => `${digits}${name}${first}${dots}${digits}${name}${last}`)
const spaced = (text: string) => [
  text,
  text.replaceAll(' ', ''),
  text.replaceAll('[', ' [ '),
  `${text}(4)`,
  `${text}( 4 )`,
]
const type = joined(one([':', ':', ': ', ' :']), either(one(spellings.flatMap(spaced))))
const tail = fc.oneof(one(COUNTS), joined(type, one(COUNTS)), rarely(nothing, joined(one(COUNTS), type)))
const text = joined(fc.oneof(device, device, range, one(LABELS)), tail)

/** How clients may number X, Y and W. */
const NOTATIONS: readonly ItemParseOptions[] = [{ xyRadix: 16 }, { xyRadix: 8 }, { xyRadix: 16, wRadix: 10 }]

/** What a client of an iQ-R takes the text for. */
function itemOf(given: string, notation: ItemParseOptions): AnyItem {
  if (hasPrefix(given)) return parsedLabel(given)
  const parsed = tryParseItem(given, notation)
  return 'error' in parsed ? labelInstead(given, parsed.error, { profile: profiles['iq-r'] }) : parsed
}

/** The type of what is read, written as TypeScript; `undefined`: nothing is. */
function valueRead(item: AnyItem): string | undefined {
  if ('error' in item) return undefined
  const { type, count } = 'label' in item ? item.label : item
  const value = type === undefined ? 'PlcValue' : javaScriptOf(type.name)
  return count === undefined ? value : `${value}[]`
}

function javaScriptOf(name: TypeName): string {
  const { kind } = valueTypes[name]
  return { bit: 'boolean', integer: 'number', bcd: 'number', real: 'number', long: 'bigint', text: 'string' }[kind]
}

const folder = mkdtempSync(join(tmpdir(), 'melsec-jw-types-'))
afterAll(() => rmSync(folder, { recursive: true, force: true }))

/** Lines of the program that do not compile. */
async function faultsOf(lines: readonly string[]): Promise<readonly string[]> {
  const file = join(folder, 'program.ts')
  writeFileSync(file, lines.join('\n'))
  const tsc = join(root, 'node_modules', 'typescript', 'bin', 'tsc')
  const options = ['--noEmit', '--strict', '--skipLibCheck', '--target', 'es2022', '--module', 'nodenext']
  const types = ['--types', 'node', '--typeRoots', join(root, 'node_modules', '@types')]
  const run = promisify(execFile)(process.execPath, [tsc, ...options, ...types, file], { cwd: folder })
  const printed = await run.then(
    () => '',
    (error: { readonly stdout: string }) => error.stdout,
  )
  return printed.split('\n').flatMap((line) => {
    const [, at] = /program\.ts\((\d+),/.exec(line) ?? []
    return at === undefined ? (line === '' || line.startsWith(' ') ? [] : [line]) : [lines[Number(at) - 1] ?? line]
  })
}

test('what the compiler infers of a text is never another type than what is read', async () => {
  const checks = fc.sample(text, TEXTS).flatMap((given) =>
    NOTATIONS.flatMap((notation) => {
      const value = valueRead(itemOf(given, notation))
      return value === undefined ? [] : [`true satisfies Fits<${value}, ${JSON.stringify(given)}>`]
    }),
  )
  const values = join(root, 'src', 'client', 'item', 'item-value')
  const head = [
    `import type { ItemValue } from ${JSON.stringify(values)}`,
    'type PlcValue = boolean | number | bigint | string',
    'type Fits<V, I> = [V] extends [ItemValue<I>] ? true : [V, ItemValue<I>]',
  ]
  // The other way round they do not fit, so the program is looked at.
  const wrong = 'true satisfies Fits<string, "D100">'
  expect(await faultsOf([...head, ...new Set(checks), wrong])).toEqual([wrong])
  expect(new Set(checks).size).toBeGreaterThan(TEXTS / 20)
}, 60_000)
