/**
 * Run by `npm run test:matrix` for each Node-RED and Node.js: every example flow of the installed package, deployed
 * against its own simulated PLC, must send what expectations.json says.
 *
 * What they must send: see ../support/examples.ts.
 */
import { execFileSync } from 'node:child_process'
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { connectedTo, type Expectation, isOurs, take } from '../support/examples'
import { type FlowNode, type NodeRed, startNodeRed } from '../support/node-red'
import { startSimulator } from './simulator'

interface Runtime {
  readonly name: string
  readonly nodeVersion: string
  readonly nodeRedVersion: string
  readonly node: string
  readonly script: string
  readonly userDir: string
  readonly version: string
}

const list = process.env.MELSEC_JW_MATRIX
if (list === undefined) throw new Error('run this with: npm run test:matrix')
const runtimes = JSON.parse(readFileSync(list, 'utf8')) as readonly Runtime[]
const expectations = JSON.parse(readFileSync(join(__dirname, 'expectations.json'), 'utf8')) as Record<
  string,
  Expectation
>

/** The example flows of the installed package, not of the sources: what is not packed is not there. */
function examplesOf(userDir: string): Map<string, FlowNode[]> {
  const folder = join(userDir, 'node_modules', '@melsec-jw', 'plc', 'examples')
  const files = readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter((name) => name.endsWith('.json'))
  return new Map(
    files.map((name) => [name.replaceAll('\\', '/'), JSON.parse(readFileSync(join(folder, name), 'utf8'))]),
  )
}

describe.each(runtimes)('$name', (runtime) => {
  let red: NodeRed
  const examples = examplesOf(runtime.userDir)

  beforeAll(async () => {
    red = await startNodeRed({ installed: runtime })
  }, 120_000)

  afterAll(() => red.stop())

  test('is what runs here', async () => {
    expect((await red.http('GET', 'settings')).json()).toMatchObject({ version: runtime.nodeRedVersion })
    expect((await red.http('GET', 'diagnostics')).json()).toMatchObject({
      nodejs: { version: `v${runtime.nodeVersion}` },
    })
  })

  test('loads every node of the package', async () => {
    const { json } = await red.http('GET', 'nodes', undefined, { accept: 'application/json' })
    const sets = (json() as readonly { module: string; version: string; err?: unknown }[]).filter(
      (set) => set.module === '@melsec-jw/plc',
    )
    expect(sets.length).toBeGreaterThan(0)
    expect(sets.filter((set) => set.err !== undefined || set.version !== runtime.version)).toEqual([])
  })

  test('require and import give the same names', () => {
    const program = `
      const { default: whole, ...names } = await import('@melsec-jw/plc')
      const required = (await import('node:module')).createRequire(process.cwd() + '/')('@melsec-jw/plc')
      const loaded = Object.keys(names).filter((name) => !['module.exports', '__esModule'].includes(name))
      console.log(JSON.stringify([loaded.sort(), Object.keys(required).sort()]))`
    const output = execFileSync(runtime.node, ['--input-type=module', '-e', program], {
      cwd: runtime.userDir,
      encoding: 'utf8',
    })
    const [imported, required] = JSON.parse(output) as [string[], string[]]
    expect(imported.length).toBeGreaterThan(0)
    expect(imported).toEqual(required)
  })

  test('every example has expectations, and every node of ours in it is looked at', () => {
    expect([...examples.keys()].sort()).toEqual(Object.keys(expectations).sort())
    const missed = [...examples].flatMap(([file, flow]) => {
      const watched = new Set(expectations[file]?.steps.map((step) => step.from))
      const sending = flow.filter((node) => isOurs(node) && Array.isArray(node.wires) && node.wires.length > 0)
      return sending.filter((node) => !watched.has(node.id)).map((node) => `${file}: ${node.type} ${node.id}`)
    })
    expect(missed).toEqual([])
  })

  test.each([...examples])('example %s', async (file, flow) => {
    const expectation = expectations[file]
    if (expectation === undefined) throw new Error(`expectations.json says nothing about ${file}`)
    const plc = await startSimulator(runtime.node, runtime.userDir, expectation.simulate ?? [])
    try {
      red.forget()
      await red.deploy(connectedTo(flow, plc.port, expectation.connection))
      for (const step of expectation.steps) await take(red, step)
    } finally {
      await red.deploy([])
      await plc.stop()
    }
  })
})
