// The package as a user gets it: packed, installed into an empty project, required, imported and compiled against.
import { execFile } from 'node:child_process'
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs'
import { createRequire } from 'node:module'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { promisify } from 'node:util'
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { fencesOf } from './docs/markdown'
import { root } from './support/root'

const run = promisify(execFile)
const MINUTES = 60_000
const folder = mkdtempSync(join(tmpdir(), 'melsec-jw-packed-'))
const project = join(folder, 'project')
const tsc = join(root, 'node_modules', 'typescript', 'bin', 'tsc')

async function npm(args: readonly string[], cwd: string): Promise<string> {
  const { stdout } = await run('npm', [...args, '--no-audit', '--no-fund', '--loglevel=error'], { cwd })
  return stdout
}

beforeAll(async () => {
  const packed = await npm(['pack', '--ignore-scripts', '--json', '--pack-destination', folder], root)
  const [{ filename }] = JSON.parse(packed) as [{ filename: string }]
  mkdirSync(project)
  writeFileSync(join(project, 'package.json'), JSON.stringify({ name: 'user', private: true }))
  await npm(['install', join(folder, filename)], project)
  // What every TypeScript project for Node.js has.
  mkdirSync(join(project, 'node_modules', '@types'), { recursive: true })
  for (const name of ['@types/node', 'undici-types']) {
    symlinkSync(join(root, 'node_modules', name), join(project, 'node_modules', name))
  }
}, 3 * MINUTES)

afterAll(() => rmSync(folder, { recursive: true, force: true }))

async function node(file: string, text: string): Promise<string> {
  writeFileSync(join(project, file), text)
  const { stdout } = await run(process.execPath, [file], { cwd: project })
  return stdout.trim()
}

const entries = [
  { entry: '@melsec-jw/plc', file: './dist/src/index.js' },
  ...['address', 'codec', 'simulator'].map((name) => ({
    entry: `@melsec-jw/plc/${name}`,
    file: `./dist/src/entry/${name}.js`,
  })),
].map(({ entry, file }) => ({
  entry,
  names: Object.keys(createRequire(join(root, 'package.json'))(file) as object).sort(),
}))

describe('the packed package in an empty project', () => {
  test('has entries for clients, addresses, bytes and simulated PLCs', () => {
    const some = ['createMelsecClient', 'parseItem', 'commands', 'createPlcSimulator']
    expect(entries.map(({ names }) => some.filter((name) => names.includes(name)))).toEqual(some.map((name) => [name]))
  })

  test.each(entries)('gives the names of $entry to require', async ({ entry, names }) => {
    const text = `console.log(JSON.stringify(Object.keys(require('${entry}')).sort()))`
    expect(JSON.parse(await node('required.cjs', text))).toEqual(names)
  })

  test.each(entries)('gives the same names of $entry to import', async ({ entry, names }) => {
    const text = `import { ${names.join(', ')} } from '${entry}'
console.log(JSON.stringify(Object.entries({ ${names.join(', ')} }).filter(([, value]) => value !== undefined).map(([name]) => name)))`
    expect(JSON.parse(await node('imported.mjs', text))).toEqual(names)
  })

  test('reads a simulated PLC in a program of the user', async () => {
    const text = `import { createMelsecClient } from '@melsec-jw/plc'
import { createPlcSimulator } from '@melsec-jw/plc/simulator'
const plc = createPlcSimulator({ profile: 'iq-r' })
await plc.listen()
const client = createMelsecClient({ host: '127.0.0.1', port: plc.tcp.port, profile: 'iq-r', allowWrites: true })
await client.write('D100:REAL', 71.5)
console.log(await client.read('D100:REAL'))
await client.close()
await plc.close()`
    expect(await node('program.mjs', text)).toBe('71.5')
  })

  test('has the sources that its declarations lead to: an editor opens them', () => {
    const installed = join(project, 'node_modules', '@melsec-jw', 'plc')
    const maps = readdirSync(join(installed, 'dist'), { recursive: true, encoding: 'utf8' })
      .filter((name) => name.endsWith('.d.ts.map'))
      .map((name) => join(installed, 'dist', name))
    expect(maps.length).toBeGreaterThan(100)
    const missing = maps.filter((map) => {
      const { sources } = JSON.parse(readFileSync(map, 'utf8')) as { sources: string[] }
      return !sources.every((source) => existsSync(join(dirname(map), source)))
    })
    expect(missing).toEqual([])
  })

  test('has the scripts that the dialogs of its nodes share', () => {
    const packed = readdirSync(join(project, 'node_modules', '@melsec-jw', 'plc', 'resources')).sort()
    expect(packed).toEqual(readdirSync(join(root, 'resources')).sort())
  })

  test('has its command line', async () => {
    const { stdout } = await run(join(project, 'node_modules', '.bin', 'melsec-jw'), ['--help'], { cwd: project })
    expect(stdout).toContain('simulate')
  })

  test('is there once, whether it is required or imported', async () => {
    const text = `import { createRequire } from 'node:module'
import { RequestError } from '@melsec-jw/plc'
import { RequestError as ofAddresses } from '@melsec-jw/plc/address'
const required = createRequire(import.meta.url)('@melsec-jw/plc')
console.log(required.RequestError === RequestError, ofAddresses === RequestError)`
    expect(await node('once.mjs', text)).toBe('true true')
  })

  const program = `import { createMelsecClient, type ReadResult } from '@melsec-jw/plc'
import { type ParsedItem, parseItem } from '@melsec-jw/plc/address'
import { explainFrame } from '@melsec-jw/plc/codec'
import { createPlcSimulator } from '@melsec-jw/plc/simulator'
export const item: ParsedItem = parseItem('D100', { xyRadix: 16 })
export const explained: object = explainFrame(Buffer.alloc(0))
createPlcSimulator({ profile: 'iq-r' })
// @ts-expect-error an item is a text
parseItem(5, { xyRadix: 16 })
const plc = createMelsecClient({ host: '192.0.2.1', port: 5007 })
export async function level(): Promise<number> {
  const results: ReadResult[] = await plc.read(['D100', 'M0'])
  const { temperature } = await plc.readValues({ temperature: 'D102:REAL' })
  return results.length + temperature + (await plc.read('D100:REAL'))
}
// @ts-expect-error a number is not a host
createMelsecClient({ host: 5, port: 5007 })
`
  test(
    'has types of addresses that need none of Node.js',
    async () => {
      writeFileSync(
        join(project, 'browser.ts'),
        `import { formatItem, parseItem } from '@melsec-jw/plc/address'
document.title = formatItem(parseItem('D100', { xyRadix: 16 }), { xyRadix: 16 })
// @ts-expect-error nothing of Node.js is known here
Buffer.alloc(1)
`,
      )
      const options = [
        '--noEmit',
        '--strict',
        '--target',
        'es2022',
        '--module',
        'esnext',
        '--moduleResolution',
        'bundler',
      ]
      const args = [tsc, ...options, '--lib', 'es2022,dom', '--types', '', 'browser.ts']
      await expect(run(process.execPath, args, { cwd: project })).resolves.toMatchObject({ stdout: '' })
    },
    MINUTES,
  )

  test.each([
    ['node16', 'node16', 'program.mts'],
    ['node16', 'node16', 'program.cts'],
    ['bundler', 'esnext', 'program.ts'],
  ])(
    'has types that resolve under %s (%s, %s)',
    async (moduleResolution, module, file) => {
      writeFileSync(join(project, file), program)
      const options = ['--noEmit', '--strict', '--target', 'es2022', '--module', module]
      const args = [tsc, ...options, '--moduleResolution', moduleResolution, file]
      await expect(run(process.execPath, args, { cwd: project })).resolves.toMatchObject({ stdout: '' })
    },
    MINUTES,
  )

  const typed = fencesOf('docs/client.md').filter(({ info }) => info.includes('typed'))
  test.each(typed)(
    'compiles the program of $page:$line',
    async ({ line, text }) => {
      const file = `documentation-${line}.mts`
      writeFileSync(join(project, file), text)
      const args = [tsc, '--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', file]
      await expect(run(process.execPath, args, { cwd: project })).resolves.toMatchObject({ stdout: '' })
    },
    MINUTES,
  )
})
