// The packed package in bundles, as Electron programs and web HMIs are made: a bundler renames classes, and errors must be
// told apart all the same.
import { execFile } from 'node:child_process'
import { mkdirSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { promisify } from 'node:util'
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { type PackedProject, packedProject } from './support/packed'
import { root } from './support/root'

const run = promisify(execFile)
const MINUTES = 60_000
let packed: PackedProject

beforeAll(async () => {
  packed = await packedProject()
  writeFileSync(join(packed.project, 'program.mjs'), program)
}, 2 * MINUTES)
afterAll(() => packed?.remove())

/** Asserts by itself; what it prints is `fine`. */
const program = `import assert from 'node:assert'
import * as all from '@melsec-jw/plc'
const { createMelsecClient, createPlcSimulator, plcErrorFrom, PlcError, bytesOfText, textOfBytes } = all
const made = {
  RequestError: new all.RequestError('BAD_VALUE', 'm', 'f'),
  EndCodeError: new all.EndCodeError(0xc056, 'm'),
  ProtocolError: new all.ProtocolError('BAD_FRAME', 'm'),
  TimeoutError: new all.TimeoutError('m', 'unknown'),
  ConnectionError: new all.ConnectionError('OFFLINE', 'm'),
  ClosedError: new all.ClosedError('CLOSED', 'm'),
  VerifyError: new all.VerifyError('m', 'STOP'),
  UnfinishedError: new all.UnfinishedError('m', new Error('c')),
  WriteError: new all.WriteError('m', 'unknown', [], new all.ClosedError('CLOSED', 'm')),
}
for (const [name, error] of Object.entries(made)) {
  assert.equal(error.name, name)
  assert(error instanceof PlcError && error instanceof Error)
  for (const other of Object.keys(made)) assert.equal(error instanceof all[other], other === name, name + ' as ' + other)
  const again = plcErrorFrom(JSON.parse(JSON.stringify(error)))
  assert(again instanceof all[name] && again.code === error.code && again.outcome === error.outcome)
}
const plc = createPlcSimulator({ profile: 'iq-r' })
await plc.listen()
const client = createMelsecClient({ host: '127.0.0.1', port: plc.tcp.port, profile: 'iq-r', allowWrites: true })
const inside = createMelsecClient({ profile: 'iq-r', openTransport: plc.connect(), allowWrites: true })
for (const one of [client, inside]) {
  await one.write('D100:REAL', 71.5)
  assert.equal(await one.read('D100:REAL'), 71.5)
  await assert.rejects(one.read('D99999'), (error) => error instanceof all.EndCodeError && error.endCode === 0x4031)
  await assert.rejects(one.read('D0:NONE'), (error) => error instanceof all.RequestError)
  const results = await one.writeEach({ D0: 5, D99999: 6 })
  assert.deepEqual([results.D0.ok, results.D99999.ok, results.D99999.error.outcome], [true, false, 'refused'])
  await assert.rejects(one.write({ D0: 5, D99999: 6 }), (error) => error instanceof all.WriteError && error.results[0].ok)
  assert.equal(one.state.name, 'connected')
}
// What is loaded only when it is asked for: texts of end codes, character codes.
assert(all.explainEndCode(0xc056, { language: 'ja' }).meaning.length > 0)
assert.equal(textOfBytes(bytesOfText('山田', 'shift-jis'), 'shift-jis'), '山田')
await client.close()
await inside.close()
await plc.close()
console.log('fine')
`

const withEsbuild = (format: string, minify: boolean) => `
import { build } from 'esbuild'
await build({ entryPoints: [entry], outfile, bundle: true, platform: 'node', target: 'node20', format: '${format}', minify: ${minify}${
  format === 'esm'
    ? `, banner: { js: "import { createRequire as makeRequire } from 'node:module'; const require = makeRequire(import.meta.url);" }`
    : ''
}, logLevel: 'error' })`

const bundlers: Readonly<Record<string, readonly [text: string, extension: string]>> = {
  'esbuild, ESM': [withEsbuild('esm', false), 'mjs'],
  'esbuild, ESM, minified': [withEsbuild('esm', true), 'mjs'],
  'esbuild, CommonJS': [withEsbuild('cjs', false), 'cjs'],
  'esbuild, CommonJS, minified': [withEsbuild('cjs', true), 'cjs'],
  'webpack in production mode': [
    `
import webpack from 'webpack'
import { basename, dirname } from 'node:path'
const stats = await new Promise((resolve, reject) => webpack({
  mode: 'production', target: 'node20', entry, experiments: { topLevelAwait: true },
  output: { path: dirname(outfile), filename: basename(outfile) },
}, (error, stats) => error ? reject(error) : resolve(stats)))
if (stats.hasErrors()) throw new Error(stats.toString())`,
    'cjs',
  ],
  'vite in production mode': [
    `
import { build } from 'vite'
import { basename, dirname } from 'node:path'
await build({
  configFile: false, mode: 'production', logLevel: 'error', root: dirname(entry), ssr: { noExternal: true, target: 'node' },
  build: { ssr: entry, target: 'node20', minify: true, outDir: dirname(outfile), emptyOutDir: false,
    rollupOptions: { output: { format: 'es', entryFileNames: basename(outfile) } } },
})`,
    'mjs',
  ],
}

describe('the errors in a bundle', () => {
  test.each(Object.entries(bundlers))(
    '%s',
    async (name, [text, extension]) => {
      const id = name.replace(/\W+/g, '-')
      const folder = join(packed.project, id)
      mkdirSync(folder)
      const outfile = join(folder, `bundle.${extension}`)
      // CommonJS has no await at the top: the program becomes a function there.
      const entry = join(packed.project, extension === 'cjs' ? 'program-cjs.mjs' : 'program.mjs')
      if (extension === 'cjs') writeFileSync(entry, wrapped(program))
      const script = join(folder, 'build.mjs')
      const constants = `const entry = ${JSON.stringify(entry)}; const outfile = ${JSON.stringify(outfile)}`
      writeFileSync(script, resolved(`${text.trimStart()}\n`).replace(/^((?:import [^\n]*\n)*)/, `$1${constants}\n`))
      await run(process.execPath, [script], { cwd: packed.project })
      const { stdout } = await run(process.execPath, [outfile], { cwd: folder })
      expect(stdout.trim()).toBe('fine')
    },
    MINUTES,
  )
})

/** The bundlers are those of this project. */
function resolved(text: string): string {
  return text.replace(/from '(esbuild|webpack|vite)'/, (_, name: string) => `from ${JSON.stringify(modules[name])}`)
}

const modules: Readonly<Record<string, string>> = {
  esbuild: join(root, 'node_modules/esbuild/lib/main.js'),
  webpack: join(root, 'node_modules/webpack/lib/index.js'),
  vite: join(root, 'node_modules/vite/dist/node/index.js'),
}

function wrapped(text: string): string {
  const [, imports = '', body = ''] = /^((?:import [^\n]*\n)*)(.*)$/s.exec(text) ?? []
  return `${imports}async function main() {\n${body}}\nmain().catch((error) => { console.error(error); process.exitCode = 1 })\n`
}
