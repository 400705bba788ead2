/**
 * What the Node-RED library's validator scores (its rule numbers in the names), and what every node of ours owes its
 * user: a place in the palette, help and texts in four languages, an example flow.
 */
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { parse } from 'acorn'
import { type NodeRed, startNodeRed } from './support/node-red'
import { filesBelow, isNode, nodesOf, readText, type SyntaxNode } from './support/syntax'

interface Manifest {
  readonly name: string
  readonly license: string
  readonly repository: { readonly url: string }
  readonly bugs: { readonly url: string }
  readonly keywords: readonly string[]
  readonly engines: { readonly node: string }
  readonly dependencies: Readonly<Record<string, string>>
  readonly files: readonly string[]
  readonly exports: Readonly<Record<string, Readonly<Record<string, string>> | string>>
  readonly typesVersions: { readonly '*': Readonly<Record<string, readonly string[]>> }
  readonly 'node-red': { readonly version: string; readonly nodes: Readonly<Record<string, string>> }
}

const manifest = readJson('package.json') as Manifest
const nodeNames = Object.keys(manifest['node-red'].nodes)
const LANGUAGES = ['en-US', 'ja', 'zh-CN', 'zh-TW']

function readJson(path: string): unknown {
  return JSON.parse(readText(path))
}

/** Is `version` covered by a range of the form `>=1.2.3`? The only form that package.json uses. */
function covers(range: string, version: string): boolean {
  const [floor, wanted] = [range.replace(/^>=/, ''), version].map((text) => text.split('.').map(Number))
  if (!range.startsWith('>=') || !floor || !wanted) throw new Error(`cannot read the range ${range}`)
  const at = [0, 1, 2].find((index) => (floor[index] ?? 0) !== (wanted[index] ?? 0))
  return at === undefined || (wanted[at] ?? 0) > (floor[at] ?? 0)
}

describe('package.json', () => {
  test('P01, P03: names its licence, repository and place for bugs', () => {
    expect(manifest.license).toBe('MIT')
    expect(readText('LICENSE')).toContain('MIT License')
    expect(manifest.repository.url).toContain('github.com/melsec-jw/plc')
    expect(manifest.bugs.url).toContain('github.com/melsec-jw/plc')
  })

  test('P04, P05: has a scoped name and the keyword', () => {
    expect(manifest.name).toMatch(/^@[a-z\d][\w-.]+\/[a-z\d][\w-.]*$/)
    expect(manifest.keywords).toContain('node-red')
  })

  test('P06, P07: says that it runs in Node-RED 4.1 and 5 and on their Node.js', () => {
    expect(['4.1.0', '5.0.0'].map((version) => covers(manifest['node-red'].version, version))).toEqual([true, true])
    expect(['20.0.0', '22.9.0', '24.0.0'].map((version) => covers(manifest.engines.node, version))).toEqual([
      true,
      true,
      true,
    ])
    expect(covers('>=4.0.0', '3.1.9')).toBe(false)
  })

  test('D01: has at most six dependencies, each at one version', () => {
    expect(Object.keys(manifest.dependencies).length).toBeLessThanOrEqual(6)
    expect(Object.values(manifest.dependencies).filter((version) => !/^\d+\.\d+\.\d+$/.test(version))).toEqual([])
  })

  test('older TypeScript finds the types of every sub-path where `exports` has them', () => {
    const paths = Object.entries(manifest.exports).flatMap(([path, target]) =>
      typeof target === 'string' || path === '.' ? [] : [[path.slice('./'.length), [target.types]]],
    )
    expect(paths).toHaveLength(3)
    expect(manifest.typesVersions).toEqual({ '*': Object.fromEntries(paths) })
  })

  test('the validator reads every file of examples/ in the package as a flow, so only flows are packed', () => {
    expect(manifest.files.filter((pattern) => pattern.startsWith('examples'))).toEqual(['examples/**/*.json'])
    expect(filesBelow('examples', '.json').filter((path) => !Array.isArray(readJson(path)))).toEqual([])
  })
})

/** The definition object of each registerType call in a node's html, found as the validator finds it. */
function definitionsOf(html: string): [type: string, definition: SyntaxNode][] {
  const scripts = [...html.matchAll(/<script.+?type=['"]text\/javascript['"].*?>([\S\s]*?)<\/script>/gi)]
  return scripts
    .flatMap(([, script]) => [...nodesOf(parse(script ?? '', { ecmaVersion: 'latest' }))])
    .filter((node) => node.type === 'CallExpression' && keyOf(node.callee, 'property') === 'registerType')
    .map((call) => {
      const [type, definition] = call.arguments as readonly [SyntaxNode, SyntaxNode]
      return [String(type.value), definition]
    })
}

function keyOf(node: unknown, field: string): string | undefined {
  const key = isNode(node) ? node[field] : undefined
  return isNode(key) ? String(key.name ?? key.value) : undefined
}

/** The entries of an object literal; a spread or computed key, which the validator cannot read, has the name undefined. */
function entriesOf(node: unknown): Map<string | undefined, SyntaxNode> {
  if (!isNode(node) || node.type !== 'ObjectExpression') return new Map()
  const entries = (node.properties as SyntaxNode[]).map((entry) => [keyOf(entry, 'key'), entry.value] as const)
  return new Map(entries.filter((entry): entry is [string | undefined, SyntaxNode] => isNode(entry[1])))
}

describe.each(nodeNames)('%s in the editor', (name) => {
  const definitions = () => definitionsOf(readText(`nodes/${name}.html`))

  test('registers its own type once, with everything inline that the validator reads', () => {
    expect(definitions().map(([type]) => type)).toEqual([name])
    const [, definition] = definitions()[0] ?? []
    const entries = entriesOf(definition)
    expect([...entries.keys()]).not.toContain(undefined)
    expect(entries.get('defaults')?.type).toBe('ObjectExpression')
    expect(entries.get('credentials')?.type ?? 'ObjectExpression').toBe('ObjectExpression')
    const palette = ['category', 'color', 'icon', 'inputs', 'outputs']
    const present = palette.filter((key) => entries.has(key))
    expect(present.filter((key) => entries.get(key)?.type !== 'Literal')).toEqual([])
    const isConfig = entries.get('category')?.value === 'config'
    expect(present.filter((key) => !isConfig || key !== 'color')).toEqual(isConfig ? ['category'] : palette)
  })

  test('keeps a version of its settings, so that a later version can migrate them', () => {
    const [, definition] = definitions()[0] ?? []
    expect([...entriesOf(entriesOf(definition).get('defaults')).keys()]).toContain('version')
  })

  test('does not use names for its settings that Node-RED needs', () => {
    const [, definition] = definitions()[0] ?? []
    const names = [...entriesOf(entriesOf(definition).get('defaults')).keys()]
    const reserved = /^(id|type|wires|inputs|outputs|.)$/
    expect(names.filter((setting) => setting === undefined || reserved.test(setting))).toEqual([])
  })
})

/** The texts of a catalogue by path, e.g. `melsec-jw-read.label.name`. */
function textsOf(catalogue: unknown, path: readonly string[] = []): Map<string, string> {
  if (typeof catalogue === 'string') return new Map([[path.join('.'), catalogue]])
  if (typeof catalogue !== 'object' || catalogue === null) throw new Error(`${path.join('.')} is no text`)
  return new Map(Object.entries(catalogue).flatMap(([key, value]) => [...textsOf(value, [...path, key])]))
}

/** Node-RED loads `locales/<language>/<node>.json` beside the node's script, and the help from the .html there. */
describe.each(nodeNames)('%s in four languages', (name) => {
  const texts = (language: string) => textsOf(readJson(`nodes/locales/${language}/${name}.json`))

  test.each(LANGUAGES)('%s: the same texts as in English, none empty, with the same places to fill', (language) => {
    const [english, translated] = [texts('en-US'), texts(language)]
    expect([...translated.keys()].sort()).toEqual([...english.keys()].sort())
    expect([...translated].filter(([, text]) => text.trim() === '')).toEqual([])
    const places = (text: string | undefined) => (text?.match(/__\w+?__/g) ?? []).sort()
    expect([...translated].filter(([key, text]) => `${places(text)}` !== `${places(english.get(key))}`)).toEqual([])
  })

  test.each(LANGUAGES)('%s: has help', (language) => {
    const help = readText(`nodes/locales/${language}/${name}.html`)
    expect(help).toMatch(new RegExp(`<script type="text/(html|markdown|x-red)" data-help-name="${name}">`))
    expect(help.length).toBeGreaterThan(200)
  })

  test('every text that the html asks for exists', () => {
    const html = readText(`nodes/${name}.html`)
    const marked = [...html.matchAll(/data-i18n="([^"]+)"/g)].flatMap(([, keys]) => (keys ?? '').split(';'))
    const called = [...html.matchAll(/\b_\(\s*(['"])(.+?)\1\s*[,)]/g)].map(([, , key]) => key ?? '')
    // `[placeholder]key` fills an attribute; `node-red:key` and `common.key` are the editor's own texts.
    const keys = [...marked, ...called].map((key) => key.replace(/^\[[\w-]+\]/, ''))
    const own = keys.filter((key) => !key.includes(':') && !key.startsWith('common.'))
    expect(own.filter((key) => !texts('en-US').has(key))).toEqual([])
  })
})

/** What the first argument of a call can be: whole keys, and the beginnings of those that are put together. */
function keysOf(node: unknown): readonly { readonly key: string; readonly whole: boolean }[] {
  if (!isNode(node)) return []
  if (node.type === 'Literal') return [{ key: String(node.value), whole: true }]
  if (node.type === 'ConditionalExpression') return [...keysOf(node.consequent), ...keysOf(node.alternate)]
  if (node.type === 'BinaryExpression') return keysOf(node.left).map(({ key }) => ({ key, whole: false }))
  if (node.type !== 'TemplateLiteral') return []
  const [first] = node.quasis as readonly { readonly value: { readonly raw: string } }[]
  return [{ key: first?.value.raw ?? '', whole: false }]
}

describe('the scripts that the dialogs share', () => {
  const paths = filesBelow('resources', '.js')
  const html = readText('nodes/melsec-jw-connection.html')

  test('are loaded by the connection, which every other node needs, and are packed', () => {
    const loaded = [...html.matchAll(/<script src="resources\/([^"]+)"><\/script>/g)].map(([, path]) => path)
    expect(loaded.sort()).toEqual(paths.map((path) => path.replace('resources/', `${manifest.name}/`)).sort())
    expect(manifest.files).toContain('resources')
  })

  test('ask for texts that exist', () => {
    const known = [...textsOf(readJson('nodes/locales/en-US/melsec-jw-connection.json')).keys()]
    const calls = paths
      .flatMap((path) => [...nodesOf(parse(readText(path), { ecmaVersion: 'latest' }))])
      .filter((node) => node.type === 'CallExpression')
      .filter(({ callee }) => ['text', '_'].includes(keyOf(callee, 'property') ?? ''))
    const asked = calls.flatMap((call) => keysOf((call.arguments as readonly unknown[])[0]))
    const keys = asked.filter(({ key }) => /^[a-z]+\./.test(key))
    expect(keys.length).toBeGreaterThan(20)
    const missing = keys.filter(
      ({ key, whole }) => !known.some((each) => (whole ? each === key : each.startsWith(key))),
    )
    expect(missing).toEqual([])
  })
})

test('N02: every node is in an example flow', () => {
  const used = filesBelow('examples', '.json').flatMap((path) => readJson(path) as { type: string }[])
  const types = new Set(used.map((node) => node.type))
  expect(nodeNames.filter((name) => !types.has(name))).toEqual([])
})

describe('in a user directory of Node-RED', () => {
  let red: NodeRed

  beforeAll(async () => {
    red = await startNodeRed()
  }, 60_000)

  afterAll(() => red.stop())

  test('N01: every node of package.json is loaded, under a type of our own', async () => {
    const { json } = await red.http('GET', 'nodes', undefined, { accept: 'application/json' })
    const sets = json() as readonly { module: string; name: string; types: readonly string[]; err?: unknown }[]
    const ours = sets.filter((set) => set.module === manifest.name)
    expect(ours.map((set) => set.err).filter((error) => error !== undefined)).toEqual([])
    expect(ours.flatMap((set) => set.types).sort()).toEqual([...nodeNames].sort())
    expect(nodeNames.filter((name) => !name.startsWith('melsec-jw-'))).toEqual([])
  })

  test('the scripts that the dialogs share are served', async () => {
    for (const path of filesBelow('resources', '.js')) {
      const { status, text } = await red.http('GET', path.replace('resources/', `resources/${manifest.name}/`))
      expect({ path, status, text }).toEqual({ path, status: 200, text: readText(path) })
    }
  })

  test('the import menu offers the example flows', async () => {
    const { json } = await red.http('GET', `library/examples/flows/${manifest.name}`)
    const offered = (json() as readonly (string | { fn: string })[]).map((entry) =>
      typeof entry === 'string' ? entry : entry.fn,
    )
    const flows = filesBelow('examples', '.json').map((path) => path.split('/')[1]?.replace(/\.json$/, ''))
    // `examples/library` holds programs, which the package does not carry; in the repository it is an empty menu.
    expect(offered.filter((name) => name !== 'library').sort()).toEqual([...new Set(flows)].sort())
  })
})
