// The packed package in bundles, as Electron programs and web HMIs are made: a bundler renames classes, and errors must be
// told apart all the same.
import { execFile } from 'node:child_process'
import { mkdirSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { promisify } from 'node:util'
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { bundle, bundlers } from './support/bundlers'
import { type PackedProject, packedProject } from './support/packed'

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
import { createPlcSimulator } from '@melsec-jw/plc/simulator'
const { createMelsecClient, plcErrorFrom, PlcError, bytesOfText, textOfBytes } = all
const made = {
  RequestError: new all.RequestError('BAD_VALUE', 'm', 'f'),
  EndCodeError: new all.EndCodeError(0xc056, 'm', { family: 'slmp' }),
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
assert(all.explainEndCode(0xc056, { family: 'slmp', language: 'ja' }).meaning.length > 0)
assert.equal(textOfBytes(bytesOfText('山田', 'shift-jis'), 'shift-jis'), '山田')
await client.close()
await inside.close()
await plc.close()
console.log('fine')
`

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
      await bundle(text, entry, outfile)
      const { stdout } = await run(process.execPath, [outfile], { cwd: folder })
      expect(stdout.trim()).toBe('fine')
    },
    MINUTES,
  )
})

function wrapped(text: string): string {
  const [, imports = '', body = ''] = /^((?:import [^\n]*\n)*)(.*)$/s.exec(text) ?? []
  return `${imports}async function main() {\n${body}}\nmain().catch((error) => { console.error(error); process.exitCode = 1 })\n`
}
