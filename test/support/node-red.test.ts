import { existsSync } from 'node:fs'
import { afterAll, beforeAll, beforeEach, expect, test } from '@jest/globals'
import { type NodeRed, startNodeRed } from './node-red'
import { decode, encode } from './probe/portable'

let red: NodeRed

beforeAll(async () => {
  red = await startNodeRed()
}, 60_000)

afterAll(() => red.stop())

beforeEach(() => red.forget())

const functionNode = (id: string, func: string, wires: string[][] = [[]]) => ({
  id,
  type: 'function',
  func,
  outputs: wires.length,
  wires,
})

test('a message goes through a deployed flow and is seen at every output', async () => {
  await red.deploy([
    { id: 'source', type: 'inject', props: [{ p: 'payload' }], payload: '21', payloadType: 'num', wires: [['split']] },
    functionNode('split', 'return [msg, { payload: msg.payload * 2 }]', [[], []]),
  ])
  expect((await red.http('POST', 'inject/source')).status).toBe(200)
  expect((await red.next('source')).payload).toBe(21)
  expect((await red.next('split', 1)).payload).toBe(42)
  expect(await red.next('split', 0)).toMatchObject({ payload: 21 })
  expect(red.pending('split')).toEqual([])
})

test('values that JSON has no word for arrive whole', async () => {
  await red.deploy([functionNode('values', 'return msg')])
  const payload = { big: 2n ** 63n, bytes: Buffer.from([1, 2]), nan: Number.NaN, none: undefined, nested: [[-0]] }
  await red.receive('values', { payload })
  expect((await red.next('values')).payload).toEqual(payload)
})

test('errors keep their fields, and circles and functions are named', () => {
  class PlantError extends Error {
    readonly code = 'END_CODE'
    get outcome(): string {
      return 'refused'
    }
  }
  const circle: { self?: unknown } = {}
  circle.self = circle
  const carried = decode(JSON.parse(JSON.stringify(encode({ error: new PlantError('no'), circle, run: test }))))
  expect(carried).toEqual({
    error: { name: 'Error', message: 'no', code: 'END_CODE', outcome: 'refused' },
    circle: { self: '[circular]' },
    run: '[function test]',
  })
})

test('status, done, caught errors and the log are seen', async () => {
  await red.deploy([
    functionNode('works', 'node.status({ fill: "green", shape: "dot", text: "good" }); return msg'),
    functionNode('fails', 'throw new Error("tank empty")'),
    { id: 'catch', type: 'catch', scope: ['fails'], uncaught: false, wires: [[]] },
    functionNode('lonely', 'node.warn("nobody listens"); return null'),
  ])
  await red.receive('works', { payload: 1 })
  expect(await red.status('works', { text: 'good' })).toEqual({ fill: 'green', shape: 'dot', text: 'good' })
  expect(await red.completed('works')).not.toHaveProperty('error')
  await red.receive('fails', { payload: 2 })
  expect((await red.next('catch')).error).toMatchObject({ message: 'Error: tank empty', source: { id: 'fails' } })
  await red.receive('lonely', {})
  expect((await red.completed('lonely')).id).toBe('lonely')
  expect(red.log).toContainEqual(expect.objectContaining({ level: 'warn', id: 'lonely', text: 'nobody listens' }))
})

test('redeploying replaces the flow', async () => {
  for (const factor of [2, 3]) {
    await red.deploy([functionNode('times', `msg.payload *= ${factor}; return msg`)], 'nodes')
    await red.receive('times', { payload: 10 })
    expect((await red.next('times')).payload).toBe(10 * factor)
  }
  await expect(red.receive('values', {})).rejects.toThrow('no running node values')
})

test('a flow with an unknown node type is refused aloud', async () => {
  await expect(red.deploy([{ id: 'odd', type: 'no-such-node', wires: [[]] }])).rejects.toThrow('no-such-node')
  await red.deploy([functionNode('fine', 'return msg')])
})

test('resources are counted', async () => {
  const { active, listeners, heap } = await red.resources()
  expect(active.TCPServerWrap).toBe(1)
  expect(listeners).toBeGreaterThan(5)
  expect(heap).toBeGreaterThan(1_000_000)
})

test('the dashboard of the development dependencies is not loaded unless asked for', async () => {
  const { text } = await red.http('GET', 'nodes', undefined, { accept: 'application/json' })
  expect(text).toContain('"inject"')
  expect(text).not.toContain('dashboard')
})

test('nothing is left when it is stopped', async () => {
  const second = await startNodeRed()
  const folder = second.userDir ?? ''
  expect(existsSync(folder)).toBe(true)
  await second.stop()
  await expect(fetch(second.url)).rejects.toThrow()
  // Its own folder: others belong to tests that run at the same time.
  expect(existsSync(folder)).toBe(false)
}, 60_000)
