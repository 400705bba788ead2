// What Node.js loads, in a process of its own: large tables only when something asks for them.
import { execFile } from 'node:child_process'
import { promisify } from 'node:util'
import { beforeAll, describe, expect, test } from '@jest/globals'
import { build } from './cli/cli'
import { root } from './support/root'
import { readText } from './support/syntax'

const run = promisify(execFile)

beforeAll(build)

/** The files of this package and of others that a program has loaded, from the root. */
async function loadedBy(program: string): Promise<string[]> {
  const text = `(async () => { ${program} })().then(() => console.log(JSON.stringify(Object.keys(require.cache))))`
  const { stdout } = await run(process.execPath, ['-e', text], { cwd: root })
  return (JSON.parse(stdout) as string[]).map((path) => path.slice(root.length + 1).replaceAll('\\', '/'))
}

/** Texts of end codes, each in four languages, and the tables of character codes. Facts about end codes are small. */
function isLarge(path: string): boolean {
  if (path.includes('iconv-lite')) return true
  return path.startsWith('dist/src/melsec/end-codes/') && /\p{Script=Han}/u.test(readText(path))
}

const read = `const { createMelsecClient } = require('./dist/src/index.js')
const { createPlcSimulator } = require('./dist/src/entry/simulator.js')
const simulator = createPlcSimulator({ profile: 'iq-r' })
const plc = createMelsecClient({ profile: 'iq-r', openTransport: simulator.connect() })
await plc.read(['D100:REAL', 'M0', 'D200:STRING(10)']);`

const entries = ['index', 'entry/address', 'entry/codec', 'entry/simulator']

describe('no text of an end code and no table of characters is loaded', () => {
  test.each(entries)('by %s alone', async (entry) => {
    const loaded = await loadedBy(`require('./dist/src/${entry}.js')`)
    expect(loaded).toContain(`dist/src/${entry}.js`)
    expect(loaded.filter(isLarge)).toEqual([])
  })

  test('by a read', async () => {
    expect((await loadedBy(`${read} await plc.close()`)).filter(isLarge)).toEqual([])
  })
})

test('both are loaded when they are needed', async () => {
  const refused = await loadedBy(`${read} await plc.read('D99999').catch(() => {}); await plc.close()`)
  expect(refused.filter(isLarge)).toContain('dist/src/melsec/end-codes/slmp.js')
  const text = await loadedBy(`${read} await plc.read({ address: 'D200:STRING(4)', encoding: 'shift-jis' })`)
  expect(text.filter((path) => path.includes('iconv-lite'))).not.toEqual([])
})

test('addresses alone need none of what sends and receives', async () => {
  const loaded = await loadedBy(`require('./dist/src/entry/address.js')`)
  const rooms = new Set(loaded.map((path) => path.split('/').slice(2, -1).join('/')))
  expect([...rooms].sort()).toEqual([
    '',
    'basics',
    'client/item',
    'client/jw',
    'entry',
    'errors',
    'jw',
    'jw/operand',
    'melsec/device',
    'value',
  ])
})

// `sideEffects` in package.json says so, and bundlers believe it.
test('loading does nothing but define what is exported', async () => {
  const program = `const seen = () => JSON.stringify([Reflect.ownKeys(globalThis).map(String), process.eventNames().map(String), process.getActiveResourcesInfo()])
for (const known of [Object, Function, Array, String, Number, Map, Set, Promise, Error, Uint8Array, Buffer]) Object.freeze(known.prototype)
const before = seen()
for (const entry of ${JSON.stringify(entries)}) require('./dist/src/' + entry + '.js')
if (seen() !== before) throw new Error(before + ' became ' + seen())`
  await expect(loadedBy(program)).resolves.toContain('dist/src/index.js')
})
