// What a program that is bundled carries: only what it uses. What must not be there is told by its texts, which no bundler
// changes, and not by bytes.
import { execFile } from 'node:child_process'
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { promisify } from 'node:util'
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { explainEndCode } from '../src/index'
import { bundle, bundlers } from './support/bundlers'
import { type PackedProject, packedProject } from './support/packed'

const MINUTES = 60_000
let packed: PackedProject

beforeAll(async () => {
  packed = await packedProject()
}, 2 * MINUTES)
afterAll(() => packed?.remove())

/** A text that is in each part of the package and nowhere else. */
const parts = {
  simulator: 'This simulator is closed',
  endCodeTexts: explainEndCode(0xc059, { family: 'slmp' })?.meaning ?? '',
  characterTables: 'Encoding not recognized',
  client: 'Connecting took longer than allowed',
  commands: 'Read (word units)',
  profiles: 'MELSEC iQ-R',
  jw: 'JW300 option unit manual',
  sockets: 'node:net',
}
type Part = keyof typeof parts

const programs: Readonly<Record<string, readonly [program: string, has: readonly Part[]]>> = {
  'nothing that is used': [
    `import '@melsec-jw/plc'; import '@melsec-jw/plc/codec'; import '@melsec-jw/plc/simulator'`,
    [],
  ],
  'parseItem of addresses': [
    `import { parseItem } from '@melsec-jw/plc/address'; console.log(parseItem('D100:REAL', { xyRadix: 16 }))`,
    [],
  ],
  'one class of errors': [
    `import { EndCodeError } from '@melsec-jw/plc'; console.log(new EndCodeError(0xc059, 'refused', { family: 'slmp' }).name)`,
    [],
  ],
  'the texts of end codes': [
    `import { explainEndCode } from '@melsec-jw/plc'; console.log(explainEndCode(0xc059, { family: 'slmp' }))`,
    ['endCodeTexts'],
  ],
  'a client': [
    `import { createMelsecClient } from '@melsec-jw/plc'; console.log(createMelsecClient({ host: '192.0.2.1', port: 5007 }).state)`,
    ['client', 'commands', 'profiles', 'sockets', 'endCodeTexts', 'characterTables'],
  ],
}

const [esbuild, webpack, vite] = ['esbuild, ESM, minified', 'webpack in production mode', 'vite in production mode']

test.each(['esbuild, CommonJS', 'webpack in production mode'])(
  'a program that requires the package runs, bundled by %s',
  async (name) => {
    const [text = '', extension = ''] = bundlers[name] ?? []
    const folder = join(packed.project, `required ${name}`.replace(/\W+/g, '-'))
    mkdirSync(folder)
    const entry = join(folder, 'program.cjs')
    writeFileSync(
      entry,
      `const { EndCodeError, explainEndCode } = require('@melsec-jw/plc')
const { parseItem } = require('@melsec-jw/plc/address')
console.log(EndCodeError.name.length > 0, explainEndCode(0xc059, { family: 'slmp' }).exact, parseItem('D7', { xyRadix: 16 }).address.number)`,
    )
    const outfile = join(folder, `bundle.${extension}`)
    await bundle(text, entry, outfile)
    const { stdout } = await promisify(execFile)(process.execPath, [outfile])
    expect(stdout.trim()).toBe('true true 7')
  },
  MINUTES,
)

describe.each([esbuild, webpack, vite])('bundled by %s', (name = '') => {
  const [text, extension] = bundlers[name] ?? ['', '']

  test.each(Object.entries(programs))(
    '%s',
    async (title, [program, has]) => {
      const folder = join(packed.project, `${name} ${title}`.replace(/\W+/g, '-'))
      mkdirSync(folder)
      const entry = join(packed.project, `${title.replace(/\W+/g, '-')}.mjs`)
      writeFileSync(entry, program)
      const outfile = join(folder, `bundle.${extension}`)
      await bundle(text, entry, outfile)
      const bytes = readFileSync(outfile, 'utf8')
      const found = (Object.keys(parts) as Part[]).filter((part) => bytes.includes(parts[part]))
      expect(found.sort()).toEqual([...has].sort())
    },
    MINUTES,
  )
})
