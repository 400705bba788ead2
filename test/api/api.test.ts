/**
 * What the package exports, held against the report in the tree, so that a change of it is seen and meant: `npm run api` writes the
 * report anew. And what every exported name owes its user: its types have names, and each member says what it is.
 */
import { execFile } from 'node:child_process'
import { join } from 'node:path'
import { promisify } from 'node:util'
import { beforeAll, expect, test } from '@jest/globals'
import { build } from '../cli/cli'
import { root } from '../support/root'
import { readText } from '../support/syntax'

interface Found {
  readonly report: string
  readonly missing: readonly string[]
  readonly undocumented: readonly string[]
}

let found: Found

beforeAll(async () => {
  build()
  const { stdout } = await promisify(execFile)(process.execPath, [join(root, 'scripts', 'api.mjs'), '--print'], {
    maxBuffer: 1 << 24,
  })
  found = JSON.parse(stdout) as Found
}, 60_000)

test('what is exported is what the report says: `npm run api` writes it anew', () => {
  expect(found.report.split('\n')).toEqual(readText('test/api/report.txt').split('\n'))
})

test('every type that an exported signature names is exported', () => {
  expect(found.missing).toEqual([])
})

test('every exported name and every public member has a docstring', () => {
  expect(found.undocumented).toEqual([])
})
