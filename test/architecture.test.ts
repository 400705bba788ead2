/**
 * docs/architecture.md as a test: who may import whom, who may name sockets, timers and the clock, how long files get.
 * When a rule is in the way of a better plan, the rule is changed here and in docs/architecture.md together.
 */
import { existsSync } from 'node:fs'
import { join, posix } from 'node:path'
import { describe, expect, test } from '@jest/globals'
import { profileIds } from '../src/melsec/profiles/profile'
import { root } from './support/root'
import {
  filesBelow,
  type Import,
  importsOf,
  isNode,
  nodesOf,
  parseTypeScript,
  readText,
  type SyntaxNode,
  textOf,
} from './support/syntax'

/** Each room and the rooms it may import, besides itself. */
const ROOMS: Readonly<Record<string, readonly string[]>> = {
  errors: [],
  basics: ['errors'],
  codec: ['errors', 'basics'],
  link: ['errors', 'basics', 'codec'],
  melsec: ['errors', 'basics', 'codec', 'link'],
  jw: ['errors', 'basics', 'codec', 'link'],
  value: ['errors', 'basics'],
  tags: ['errors', 'basics', 'value'],
  transport: ['errors', 'basics'],
  'client/connection': ['errors', 'basics', 'codec', 'link', 'transport'],
  'client/item': ['errors', 'basics', 'codec', 'melsec', 'value', 'client/connection'],
  'client/watch': ['errors', 'basics', 'tags', 'transport', 'client/connection', 'client/item'],
  'client/plan': [
    'errors',
    'basics',
    'codec',
    'link',
    'melsec',
    'value',
    'client/connection',
    'client/item',
    'client/watch',
    'tags',
  ],
  'client/tags': [
    'errors',
    'basics',
    'tags',
    'value',
    'client/connection',
    'client/item',
    'client/plan',
    'client/watch',
  ],
  'client/label': [
    'errors',
    'basics',
    'codec',
    'link',
    'melsec',
    'value',
    'client/connection',
    'client/item',
    'client/plan',
  ],
  'client/file': ['errors', 'basics', 'melsec', 'client/connection'],
  'client/jw': [
    'errors',
    'basics',
    'codec',
    'link',
    'jw',
    'value',
    'transport',
    'client/connection',
    'client/item',
    'client/plan',
    'client/watch',
    'client/tags',
    'tags',
  ],
  'client/melsec': ['errors', 'basics', 'codec', 'link', 'melsec', 'value', 'tags', 'transport', 'client'],
  simulator: ['errors', 'basics', 'codec', 'link', 'melsec', 'jw', 'value', 'transport'],
  'end-code': ['errors', 'basics', 'link', 'melsec', 'jw'],
  index: ['errors', 'codec', 'link', 'melsec', 'jw', 'value', 'tags', 'transport', 'client', 'end-code'],
  entry: ['errors', 'codec', 'melsec', 'jw', 'value', 'client', 'simulator'],
  cli: ['index', 'entry', 'basics'],
  nodes: ['index', 'entry', 'basics'],
}

/** Modules that are not ours, and the rooms that may name them. Any other is refused. */
const OUTSIDE: readonly (readonly [RegExp, readonly string[]])[] = [
  [/^node:(net|dgram|dns)$/, ['transport']],
  [/^serialport$/, ['transport']],
  [/^iconv-lite$/, ['basics']],
  [/^commander$/, ['cli']],
  [/^node:buffer$/, Object.keys(ROOMS)],
  // Drives of the simulator that are folders of this computer.
  [/^node:(fs|path)$/, ['simulator', 'cli']],
  // The folder of the serial ports, where the system tells of none.
  [/^node:fs\/promises$/, ['transport', 'cli']],
  // Files of a PLC as streams: no input or output by itself.
  [/^node:stream$/, ['client', 'cli']],
  // Time and the network reach the command line through the library like everybody else.
  [/^node:(?!net$|dgram$|dns$|timers)/, ['cli']],
]

/** Names that only some rooms may use. */
const NAMES: readonly (readonly [RegExp, readonly string[]])[] = [
  [/^(setTimeout|setInterval|setImmediate|performance|hrtime)$/, ['transport']],
  [/^Date\.now$/, ['transport']],
  [/^process$/, ['cli', 'client', 'transport']],
]

const LONGEST_FILE = 500

/** Tables, not code: each is one declaration that reads best in one piece. */
const DATA_TABLES: readonly string[] = []

interface SourceFile {
  readonly path: string
  readonly room: string
  readonly imports: readonly Import[]
  readonly names: readonly string[]
}

function readSource(path: string, text = readText(path)): SourceFile {
  const tree = parseTypeScript(text)
  return { path, room: roomOf(path), imports: importsOf(tree), names: namesOf([...nodesOf(tree)]) }
}

/** src/codec/cursor.ts is in codec, src/client/item/item.ts in client/item, src/errors.ts in errors, nodes/read.ts in nodes. */
function roomOf(path: string): string {
  const [top, next, folder] = path.split('/')
  if (top !== 'src' || next === undefined) return top ?? ''
  return next === 'client' ? `${next}/${folder}` : next.replace(/\.ts$/, '')
}

/** Whether the table lets a room in: by its own name, or by that of the room it is a part of. */
function isAmong(rooms: readonly string[], room: string): boolean {
  return rooms.includes(room) || rooms.includes(room.replace(/\/.*$/, ''))
}

function namesOf(nodes: ReturnType<typeof parseTypeScript>[]): string[] {
  return nodes.flatMap((node) => {
    if (node.type === 'Identifier') return [textOf(node) ?? '']
    if (node.type === 'MemberExpression') return [`${textOf(node.object) ?? ''}.${textOf(node.property) ?? ''}`]
    return []
  })
}

function resolved(from: string, specifier: string): string {
  const target = posix.join(posix.dirname(from), specifier)
  return existsSync(join(root, `${target}.ts`)) ? `${target}.ts` : `${target}/index.ts`
}

/** Rooms with doors: what others may import of them. */
const DOORS: Readonly<Record<string, readonly string[]>> = {
  codec: ['src/codec/codec.ts', 'src/codec/explanation.ts'],
  link: ['src/link/link.ts'],
}

/** Imports that go round the door of another room; the entries of the package name what is public, wherever it is. */
function roundTheDoor(file: SourceFile): string[] {
  if (['index', 'entry'].includes(file.room)) return []
  return file.imports.flatMap(({ specifier }) => {
    if (!specifier.startsWith('.')) return []
    const target = resolved(file.path, specifier)
    const room = roomOf(target)
    const doors = room === file.room ? undefined : DOORS[room]
    return doors === undefined || doors.includes(target) ? [] : [`${file.path} goes round ${doors.join(' and ')}`]
  })
}

/** The import rules this file breaks, as sentences. */
function brokenImports(file: SourceFile): string[] {
  const allowed = [file.room, ...(ROOMS[file.room] ?? [])]
  return file.imports.flatMap(({ specifier }) => {
    if (!specifier.startsWith('.')) {
      const rule = OUTSIDE.find(([names]) => names.test(specifier))
      const named =
        (rule !== undefined && isAmong(rule[1], file.room)) || (file.room === 'nodes' && specifier === 'node-red')
      return named ? [] : [`${file.path} may not import ${specifier}`]
    }
    if (/\.[jt]s$/.test(specifier)) return [`${file.path} imports ${specifier} with an extension`]
    const target = resolved(file.path, specifier)
    return isAmong(allowed, roomOf(target)) ? [] : [`${file.path} (${file.room}) may not import ${target}`]
  })
}

function brokenNames(file: SourceFile): string[] {
  return NAMES.flatMap(([pattern, rooms]) => {
    if (isAmong(rooms, file.room)) return []
    return [...new Set(file.names.filter((name) => pattern.test(name)))].map(
      (name) => `${file.path} may not use ${name}`,
    )
  })
}

/** Which files each file needs to be understood: types count as much as values. */
function needsOf(files: readonly SourceFile[]): Map<string, string[]> {
  return new Map(
    files.map(({ path, imports }) => {
      const needed = imports.filter(({ specifier }) => specifier.startsWith('.'))
      return [path, needed.map(({ specifier }) => resolved(path, specifier))]
    }),
  )
}

/**
 * Files that need each other: none of them can be read, or moved, without the others; of values, whichever is loaded first
 * sees the other half empty.
 */
function circles(loads: ReadonlyMap<string, readonly string[]>): string[] {
  const done = new Set<string>()
  const found: string[] = []
  const visit = (path: string, above: readonly string[]): void => {
    const at = above.indexOf(path)
    if (at >= 0) found.push([...above.slice(at), path].join(' -> '))
    if (at >= 0 || done.has(path)) return
    for (const target of loads.get(path) ?? []) visit(target, [...above, path])
    done.add(path)
  }
  for (const path of loads.keys()) visit(path, [])
  return found
}

/** What a profile's id stands for is a fact, and facts of a family stand in its profile: nobody else asks who it is. */
const ids: ReadonlySet<string> = new Set(profileIds)
const COMPARED = new RegExp(`[=!]==?\\s*['"\`](${profileIds.join('|')})['"\`]|case ['"](${profileIds.join('|')})['"]`)

/** Where a family is told by its id instead of by its profile: comparisons, and tables with a row for each. */
function familiesById(path: string, tree: SyntaxNode): string[] {
  if (path.startsWith('src/melsec/profiles/')) return []
  return [...nodesOf(tree)].flatMap((node) => {
    const compared = node.type === 'BinaryExpression' && /^[=!]==?$/.test(String(node.operator))
    const literals = compared ? [node.left, node.right] : node.type === 'SwitchCase' ? [node.test] : []
    const id = literals.map(textOf).find((text) => text !== undefined && ids.has(text))
    if (id !== undefined) return [`${path} asks whether it is ${id}`]
    const key = node.type === 'TsTypeReference' && textOf(node.typeName) === 'Record' ? firstParameter(node) : undefined
    return key === 'ProfileId' ? [`${path} has a row for each profile`] : []
  })
}

function firstParameter({ typeParams }: SyntaxNode): string | undefined {
  const [first] = isNode(typeParams) && Array.isArray(typeParams.params) ? typeParams.params : []
  return isNode(first) ? textOf(first.typeName) : undefined
}

/** What only tests use, on purpose: the ground that carries more, and a table that they hold against the manuals. */
const FOR_TESTS: readonly string[] = [
  'serialFraming',
  'serialRoute',
  'endCodeTables',
  'protocolOver1c',
  'serialTransport',
  'lineTime',
  'computerLinkFrame',
  'checkCodeOf',
  'advanceJw',
]

/** Values that a file exports and nobody uses, the file itself included: dead, or kept for tests alone. */
function unusedExports(files: readonly { readonly path: string; readonly tree: SyntaxNode }[]): string[] {
  const uses = new Map<string, number>()
  const exported: { readonly path: string; readonly name: string }[] = []
  for (const { path, tree } of files) {
    for (const node of nodesOf(tree)) {
      if (node.type === 'Identifier') count(uses, textOf(node) ?? '')
      if (node.type === 'ExportDeclaration')
        for (const name of namesDeclared(node.declaration)) exported.push({ path, name })
    }
  }
  return exported.flatMap(({ path, name }) => ((uses.get(name) ?? 0) > 1 ? [] : [`${path} exports ${name} for nobody`]))
}

function count(uses: Map<string, number>, name: string): void {
  uses.set(name, (uses.get(name) ?? 0) + 1)
}

/** Of functions, classes and constants; types cost nothing. */
function namesDeclared(declaration: unknown): string[] {
  if (!isNode(declaration)) return []
  const { type, identifier, declarations } = declaration
  if (type === 'FunctionDeclaration' || type === 'ClassDeclaration') return [textOf(identifier) ?? '']
  if (type !== 'VariableDeclaration' || !Array.isArray(declarations)) return []
  return declarations.flatMap((one: unknown) => (isNode(one) ? [textOf(one.id) ?? ''] : []))
}

const sources = [...filesBelow('src', '.ts'), ...filesBelow('nodes', '.ts')].map((path) => readSource(path))

describe('the sources', () => {
  test('are in a room that the table knows', () => {
    expect(sources.length).toBeGreaterThan(0)
    expect(sources.filter((file) => !(file.room in ROOMS)).map((file) => file.path)).toEqual([])
  })

  test('import only what their room may', () => {
    expect(sources.flatMap(brokenImports)).toEqual([])
  })

  test('of the client ask an error what an end code is about, not the tables of a family', () => {
    const asking = sources.filter(
      ({ room, imports }) =>
        room.startsWith('client/') && imports.some(({ specifier }) => /\/end-codes\//.test(specifier)),
    )
    expect(asking.map(({ path }) => path)).toEqual([])
  })

  test('come into codec and link by their doors', () => {
    expect(sources.flatMap(roundTheDoor)).toEqual([])
  })

  test('export no value that nobody uses', () => {
    const unused = unusedExports(sources.map(({ path }) => ({ path, tree: parseTypeScript(readText(path)) })))
    expect(unused.filter((found) => !FOR_TESTS.some((name) => found.includes(` ${name} `)))).toEqual([])
  })

  test('leave timers, the clock and the process to src/transport and the command line', () => {
    expect(sources.flatMap(brokenNames)).toEqual([])
  })

  test('do not import each other in circles', () => {
    expect(circles(needsOf(sources))).toEqual([])
  })

  test('tell families of PLCs by the fields of their profiles, not by their ids', () => {
    const found = sources.flatMap(({ path }) => familiesById(path, parseTypeScript(readText(path))))
    const dialogs = [...filesBelow('nodes', '.html'), ...filesBelow('resources', '.js')]
    expect([...found, ...dialogs.filter((path) => COMPARED.test(readText(path)))]).toEqual([])
  })

  test('are short enough to be of one subject', () => {
    const long = [
      ...sources.map((file) => file.path),
      ...filesBelow('nodes', '.html'),
      ...filesBelow('resources', '.js'),
    ]
      .map((path) => ({ path, lines: readText(path).split('\n').length }))
      .filter(({ path, lines }) => lines > LONGEST_FILE && !DATA_TABLES.includes(path))
    expect(long).toEqual([])
  })
})

describe('the rules themselves catch', () => {
  const imports = (text: string, path = 'src/codec/made-up.ts'): string[] => brokenImports(readSource(path, text))

  test.each([
    ['an import', `import { parseAddress } from '../melsec/address'`],
    ['an import of types', `import type { Route } from '../melsec/route'`],
    ['an inline type import', `import { type Route } from '../melsec/route'`],
    ['a re-export', `export * from '../melsec/route'`],
    ['a named re-export', `export { route } from '../melsec/route'`],
    ['a dynamic import', `export const load = () => import('../melsec/route')`],
    ['a require', `const { route } = require('../melsec/route')`],
    ['an import assignment', `import route = require('../melsec/route')`],
    ['a type query', `export type Route = import('../melsec/route').Route`],
    ['a socket', `import net from 'node:net'`],
    ['a file', `import { readFileSync } from 'node:fs'`],
    ['a package', `import iconv from 'iconv-lite'`],
    ['a computed name', `export const load = (name: string) => import(name)`],
  ])('%s', (_what, text) => {
    expect(imports(text)).toHaveLength(1)
  })

  test('an extension', () => {
    expect(imports(`import { uint } from './field.js'`)).toEqual([expect.stringContaining('with an extension')])
  })

  test('a neighbour that may not be known', () => {
    expect(imports(`import { jw } from '../jw/jw'`, 'src/melsec/made-up.ts')).toHaveLength(1)
    expect(imports(`import { client } from '../client/client'`, 'src/simulator/made-up.ts')).toHaveLength(1)
    expect(imports(`import { link } from '../link/session'`, 'src/transport/made-up.ts')).toHaveLength(1)
    expect(imports(`import { codec } from '../src/codec/field'`, 'nodes/made-up.ts')).toHaveLength(1)
    expect(imports(`import { plc } from '../src/index'`, 'nodes/made-up.ts')).toEqual([])
  })

  test('timers, the clock and the process', () => {
    const text = `setTimeout(run, 1); globalThis.setInterval(run, 1); Date.now(); performance.now(); process.exit()`
    expect(brokenNames(readSource('src/melsec/made-up.ts', text))).toHaveLength(5)
    expect(brokenNames(readSource('src/cli/made-up.ts', text))).toHaveLength(4)
    expect(brokenNames(readSource('src/transport/made-up.ts', text))).toEqual([])
    expect(brokenNames(readSource('src/client/plan/made-up.ts', '/* setTimeout */ const text = "Date.now"'))).toEqual(
      [],
    )
  })

  test('a value that nobody uses', () => {
    const of = (...texts: string[]) =>
      unusedExports(texts.map((text, i) => ({ path: `src/codec/made-up-${i}.ts`, tree: parseTypeScript(text) })))
    expect(of('export function dead(): void {}')).toHaveLength(1)
    expect(of('export class Dead {}', 'export const dead = 1, alive = 2; alive')).toHaveLength(2)
    expect(of('export function alive(): void {}', `import { alive } from './made-up-0'; alive()`)).toEqual([])
    expect(of('export const own = 1; export const other = own')).toHaveLength(1)
    expect(of('export interface Shape { readonly a: number }')).toEqual([])
  })

  test('a way round a door', () => {
    const found = (text: string, path = 'src/melsec/made-up.ts') => roundTheDoor(readSource(path, text))
    expect(found(`import { u16 } from '../codec/field'`)).toHaveLength(1)
    expect(found(`import { encode } from '../codec/codec'`)).toEqual([])
    expect(found(`import { u16 } from './field'`, 'src/codec/made-up.ts')).toEqual([])
  })

  test('a family told by its id', () => {
    const found = (text: string, path = 'src/client/melsec/made-up.ts') => familiesById(path, parseTypeScript(text))
    expect(found(`export const isOld = (profile: Profile) => profile.id === 'fx3'`)).toHaveLength(1)
    expect(found(`export const isNew = ({ cpu }: Profile) => 'iq-f' !== cpu`)).toHaveLength(1)
    expect(found(`export function f(id: string) { switch (id) { case 'generic': return 1 } }`)).toHaveLength(1)
    expect(found(`const codes: Readonly<Record<ProfileId, number>> = { q: 1 }`)).toHaveLength(1)
    expect(found(`const profiles: Record<ProfileId, Profile> = {}`, 'src/melsec/profiles/made-up.ts')).toEqual([])
    expect(found(`export const isUnknown = (profile?: Profile) => profile === undefined`)).toEqual([])
    expect(COMPARED.test(`connection.profile === 'fx3'`)).toBe(true)
    expect(COMPARED.test(`connection.frame === '1E'`)).toBe(false)
  })

  test('a circle, also one of types only', () => {
    expect(
      circles(
        new Map([
          ['a', ['b']],
          ['b', ['c']],
          ['c', ['a']],
          ['d', ['a']],
        ]),
      ),
    ).toEqual(['a -> b -> c -> a'])
    expect(
      circles(
        new Map([
          ['a', ['b', 'c']],
          ['b', ['c']],
          ['c', []],
        ]),
      ),
    ).toEqual([])
    const needs = (text: string) => [...needsOf([readSource('src/codec/made-up.ts', text)]).values()]
    expect(needs(`import { PlcError } from '../errors'`)).toEqual([['src/errors.ts']])
    expect(needs(`import type { PlcError } from '../errors'`)).toEqual([['src/errors.ts']])
  })
})
