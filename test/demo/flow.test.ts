/** demo/flow.json, which people import, against the sources it is made of. */
import { execFileSync, spawnSync } from 'node:child_process'
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'
import { describe, expect, test } from '@jest/globals'
import { root } from '../support/root'
import { readText } from '../support/syntax'

interface FlowNode {
  readonly id: string
  readonly type: string
  readonly z?: string
  readonly g?: string
  readonly wires?: readonly (readonly string[])[]
  readonly [property: string]: unknown
}

const flow = JSON.parse(readText('demo/flow.json')) as FlowNode[]

test('is what demo/flow/build.mjs makes of the demo plant', () => {
  spawnSync(process.execPath, [join(root, 'scripts', 'setup.mjs'), '--build'])
  const check = spawnSync(process.execPath, [join(root, 'demo', 'flow', 'build.mjs'), '--check'], { encoding: 'utf8' })
  expect(check.stderr).toBe('')
  expect(check.status).toBe(0)
})

test('every id is there once, and every wire, link, group and scope leads to one', () => {
  const ids = new Set(flow.map(({ id }) => id))
  expect(ids.size).toBe(flow.length)
  const referred = flow.flatMap((node) => [
    ...[node.z, node.g, node.connection, node.group, node.page, node.ui, node.theme].filter((id) => id),
    ...(node.wires ?? []).flat(),
    ...['links', 'scope', 'nodes'].flatMap((property) => {
      const value = node[property]
      return Array.isArray(value) ? value : []
    }),
  ])
  expect(referred.filter((id) => !ids.has(String(id)))).toEqual([])
})

test('every node that can fail because of a PLC is caught on its tab', () => {
  const caught = new Set(flow.flatMap((node) => (node.type === 'catch' ? (node.scope as string[]) : [])))
  const failing = flow.filter(({ type }) => /^melsec-jw-(read|write|control)$/.test(type)).map(({ id }) => id)
  expect(failing.length).toBe(12)
  expect(failing.filter((id) => !caught.has(id))).toEqual([])
})

describe('where Node-RED reads the flow', () => {
  /** Puts it there as a start of the demo does; whether a changed flow was kept. */
  function put(folder: string): boolean {
    const module = pathToFileURL(join(root, 'demo', 'flow-file.mjs')).href
    const script = `const { putFlow } = await import(${JSON.stringify(module)}); console.log(putFlow(process.argv[1]))`
    const printed = execFileSync(process.execPath, ['--input-type=module', '-e', script, folder], { encoding: 'utf8' })
    return JSON.parse(printed) as boolean
  }

  test('the demo flow is put, but not over one that the user has changed', () => {
    const folder = mkdtempSync(join(tmpdir(), 'melsec-jw-flow-'))
    const target = join(folder, 'flows.json')
    try {
      expect(put(folder)).toBe(false)
      expect(JSON.parse(readFileSync(target, 'utf8'))).toEqual(flow)
      expect(put(folder)).toBe(false)
      writeFileSync(target, '[]')
      expect(put(folder)).toBe(true)
      expect(readFileSync(target, 'utf8')).toBe('[]')
    } finally {
      rmSync(folder, { recursive: true })
    }
  })
})
