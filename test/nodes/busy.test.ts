/** Messages that come faster than the PLC answers: what a read node reads, skips and says. */
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type HeadlessBrowser, launchBrowser } from '../support/browser'
import { type FlowNode, type Message, type NodeRed, type Status, startNodeRed } from '../support/node-red'
import { close, edit, property } from './dialog'
import {
  type CaughtError,
  catchNode,
  connectionTo,
  controlNode,
  readNode,
  requestNode,
  startPlc,
  writeNode,
} from './flow'

/** What the PLC needs for an answer in the tests of overload, ms. */
const ANSWER = 40

let red: NodeRed
let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc({ bufferMemory: 1024 })
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

afterEach(() => {
  plc.faults.clear()
  red.forget()
})

/** Sends messages that write 1, 2, 3 and so on. */
function many(count: number): FlowNode {
  const func = `return [Array.from({ length: ${count} }, (_, i) => ({ payload: { D100: i + 1 } }))]`
  return { id: 'many', type: 'function', func, wires: [['write', 'read']] }
}

type Shown = Status & { readonly skipped?: number; readonly waiting?: number }

function timer(to: readonly string[], seconds: number, more: object = {}): FlowNode {
  return { id: 'timer', type: 'inject', repeat: String(seconds), props: [], wires: [to], ...more }
}

/** The first read is under way, and not over before the others have arrived. */
async function readingSlowly(ms = 500): Promise<void> {
  plc.faults.add({ kind: 'delay', ms, commands: ['readWords'] })
  await red.status('read', { fill: 'green' })
}

function completed(id: string): number {
  return red.completions.filter((completion) => completion.id === id).length
}

/** What read nodes and others complete in so many beats of a node. */
async function beats(id: string, count: number): Promise<void> {
  for (let beat = 0; beat < count; beat++) await red.completed(id)
}

/** The statuses of a node that tell of skipped messages. */
function skips(id: string): Shown[] {
  return (red.statuses(id) as Shown[]).filter(({ skipped }) => skipped !== undefined)
}

async function numbersRead(count: number): Promise<unknown[]> {
  const numbers: unknown[] = []
  for (let read = 0; read < count; read++) numbers.push((await red.next('read')).number)
  return numbers
}

describe('while a read is under way', () => {
  test('skip: what arrives is not read, is done all the same, and the status counts it', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100'], { busy: 'skip' }), catchNode()])
    await readingSlowly()
    for (const number of [1, 2, 3, 4]) await red.receive('read', { number })
    expect(await numbersRead(1)).toEqual([1])
    for (let message = 0; message < 4; message++) expect(await red.completed('read')).not.toHaveProperty('error')
    expect(await red.status('read', { fill: 'yellow' })).toMatchObject({
      shape: 'ring',
      text: 'skipped 3',
      skipped: 3,
      state: 'connected',
    })
    await red.receive('read', { number: 5 })
    expect(await numbersRead(1)).toEqual([5])
    // It keeps up again.
    await red.status('read', { fill: 'green', text: 'connected' })
    expect([red.pending('read'), red.pending('catch')]).toEqual([[], []])
  })

  test('queue: every message is read in turn, and the status says how many wait', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100'], { busy: 'queue' })])
    await readingSlowly(400)
    for (const number of [1, 2, 3, 4]) await red.receive('read', { number })
    expect(await numbersRead(4)).toEqual([1, 2, 3, 4])
    await red.status('read', { fill: 'green' })
    const waited = red.statuses('read').filter(({ fill }) => fill === 'blue') as Shown[]
    expect(waited.map(({ text, waiting }) => [text, waiting])).toEqual([
      ['3 waiting', 3],
      ['2 waiting', 2],
      ['1 waiting', 1],
    ])
  })

  test('queue: one message too many is refused, and the others are read', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100'], { busy: 'queue' }), catchNode()])
    await readingSlowly(1000)
    for (let number = 0; number <= 100; number++) await red.receive('read', { number })
    const { error, number } = (await red.next('catch')) as Message & { error: CaughtError }
    expect(number).toBe(100)
    expect(error).toMatchObject({ code: 'QUEUE_FULL', cause: { outcome: 'notSent' } })
    expect(error.message).toContain('100 messages')
    plc.faults.clear()
    expect(await numbersRead(100)).toEqual(Array.from({ length: 100 }, (_, each) => each))
  })

  test('newest: of those that wait only the last is read, and the others are done and counted', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100'], { busy: 'newest' }), catchNode()])
    await readingSlowly()
    for (const number of [1, 2, 3, 4]) await red.receive('read', { number })
    expect(await numbersRead(2)).toEqual([1, 4])
    for (let message = 0; message < 4; message++) expect(await red.completed('read')).not.toHaveProperty('error')
    expect(red.statuses('read')).toContainEqual(expect.objectContaining({ fill: 'yellow', skipped: 2 }))
    expect([red.pending('read'), red.pending('catch')]).toEqual([[], []])
  })

  test('newest: one that waits at a deploy is done', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100'], { busy: 'newest' }), catchNode()])
    await readingSlowly(2000)
    await red.receive('read', {})
    await red.receive('read', {})
    await red.deploy([])
    await beats('read', 2)
    expect(red.completions.every(({ error }) => error === undefined)).toBe(true)
  })

  test('msg.busy chooses, and anything else in it is refused', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100'], { busy: 'msg' }), catchNode()])
    await readingSlowly()
    await red.receive('read', { number: 1 })
    await red.receive('read', { number: 2, busy: 'skip' })
    await red.receive('read', { number: 3 })
    await red.receive('read', { number: 4, busy: 'newest' })
    expect(await numbersRead(3)).toEqual([1, 3, 4])
    await red.receive('read', { busy: true })
    const { error } = (await red.next('catch')) as Message & { error: CaughtError }
    expect(error).toMatchObject({ code: 'BAD_INPUT', cause: { field: 'busy', outcome: 'notSent' } })
    expect(error.message).toContain('skip, queue, newest')
  })

  test('what fails is told as that, however much was skipped', async () => {
    await red.deploy([connectionTo(plc, { timeout: '600' }), readNode(['D100'], { busy: 'skip' }), catchNode()])
    await red.status('read', { fill: 'green' })
    plc.faults.add({ kind: 'silence' })
    for (let message = 0; message < 5; message++) await red.receive('read', {})
    await red.status('read', { fill: 'red' })
    expect(skips('read')).toEqual([])
    await red.next('catch')
    expect(red.pending('catch')).toEqual([])
  })
})

describe('automatic', () => {
  const passing = [
    { id: 'junction', type: 'junction', wires: [['out']] },
    { id: 'out', type: 'link out', mode: 'link', links: ['in'], wires: [] },
    { id: 'in', type: 'link in', links: ['out'], wires: [['read']] },
  ]

  test.each([
    ['straight', ['read'], []],
    ['by way of a junction and link nodes', ['junction'], passing],
  ])(
    'of what an Inject node with an interval sends %s only the newest waits, and all other messages are read',
    async (_how, to, nodes) => {
      // A flow that knows nothing of the setting.
      await red.deploy([connectionTo(plc), readNode(['D100']), timer(to, 0.05), ...nodes, catchNode()])
      await readingSlowly(500)
      await red.next('read')
      await red.receive('read', { number: 1 })
      await red.receive('read', { number: 2 })
      const read: unknown[] = []
      while (!read.includes(2)) read.push((await red.next('read')).number)
      expect(read.filter((number) => number !== undefined)).toEqual([1, 2])
      expect(read.length).toBeLessThan(6)
      const { skipped } = (await red.status('read', { fill: 'yellow' })) as Shown
      expect(skipped).toBeGreaterThan(5)
      expect(red.pending('catch')).toEqual([])
      await red.deploy([])
    },
  )

  test.each([
    ['an Inject node without an interval', timer(['read'], 0.05, { repeat: '', once: true, onceDelay: 0.1 }), 1],
    ['a Function node behind a timer', timer(['split'], 30, { once: true, onceDelay: 0.1 }), 5],
  ])('messages of %s are all read', async (_what, source, count) => {
    const split = {
      id: 'split',
      type: 'function',
      func: 'return [[1, 2, 3, 4, 5].map((n) => ({ n }))]',
      wires: [['read']],
    }
    plc.faults.add({ kind: 'delay', ms: 50, commands: ['readWords'] })
    await red.deploy([connectionTo(plc), readNode(['D100']), source, split])
    for (let read = 0; read < count; read++) await red.next('read')
    expect(skips('read')).toEqual([])
    await red.deploy([])
  })

  test('an Inject node with an interval and one without that share a link are not told apart: nothing is skipped', async () => {
    const press = { id: 'press', type: 'inject', repeat: '', props: [], wires: [['junction']] }
    await red.deploy([connectionTo(plc), readNode(['D100']), timer(['junction'], 0.1), press, ...passing])
    await readingSlowly(150)
    await beats('timer', 6)
    await red.next('read')
    await red.status('read', ({ fill }) => fill === 'blue')
    expect(skips('read')).toEqual([])
    await red.deploy([])
  })
})

test('seven read nodes every 200 ms, a write every second, a PLC that needs 40 ms: nothing fails, and each gets its share', async () => {
  const ids = Array.from({ length: 7 }, (_, number) => `read ${number}`)
  plc.faults.add({ kind: 'delay', ms: ANSWER })
  const connects = plc.statistics.connections
  await red.deploy([
    connectionTo(plc, { timeout: '3000', allowWrites: true }),
    ...ids.map((id) => readNode(['D100'], { id })),
    ...ids.map((id) => timer([id], 0.2, { id: `timer of ${id}` })),
    writeNode({ valuesType: 'json', values: '{ "D9000": 5 }' }),
    timer(['write'], 1),
    catchNode(),
  ])
  await beats('write', 8)
  const shares = ids.map((id) => red.pending(id).length)
  const last = ids.map((id) => skips(id).at(-1))
  const done = ids.map(completed)
  const sent = ids.map((id) => red.pending(id).length)
  await red.deploy([])
  // 25 answers a second but for the writes, however busy this machine is.
  expect(shares.reduce((sum, share) => sum + share, 0)).toBeGreaterThan(100)
  expect(Math.max(...shares) - Math.min(...shares)).toBeLessThanOrEqual(3)
  expect(red.completions.filter(({ error }) => error !== undefined)).toEqual([])
  expect(red.pending('catch')).toEqual([])
  expect(plc.statistics.connections - connects).toBe(1)
  // Each node says once in full why.
  expect(red.log.map(({ id, text }) => [id, text]).sort()).toEqual(
    ids.map((id) => [id, expect.stringMatching(/^\d+ messages were not read.+ \(about \d+ ms for each request\)/)]),
  )
  for (const [index, status] of last.entries()) {
    expect(status).toMatchObject({ fill: 'yellow', text: `skipped ${status?.skipped}` })
    const skipped = (done[index] ?? 0) - (sent[index] ?? 0)
    expect(skipped).toBeGreaterThan(0)
    // Told with each answer, so those since the last answer may not be in it yet.
    expect(skipped - (status?.skipped ?? 0)).toBeGreaterThanOrEqual(0)
    expect(skipped - (status?.skipped ?? 0)).toBeLessThanOrEqual(3)
  }
}, 40_000)

describe('what changes the PLC is never skipped, and done in the order of the messages', () => {
  /** Two messages, of which the first takes longer to be found out: as from a context store on a disk. */
  const two = (to: string): FlowNode => ({
    id: 'two',
    type: 'function',
    func: `const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms))
      return [[{ ms: 200, value: 1, command: 'stop' }, { ms: 0, value: 2, command: 'run' }]
        .map(({ ms, ...values }, number) => ({ ...values, number, wait: () => sleep(ms).then(() => true) }))]`,
    wires: [[to]],
  })
  const late = (answer: string) => `(wait(); ${answer})`
  const memory = { mode: 'memory', access: 'write', address: '100', addressType: 'num' }

  test.each([
    ['write', writeNode({ valuesType: 'jsonata', values: late('{ "D100": value }') })],
    [
      'request',
      requestNode({
        command: 'writeWords',
        messageType: 'jsonata',
        message: late('{ "head": "D100", "values": [value] }'),
      }),
    ],
    ['request', requestNode({ ...memory, valuesType: 'jsonata', values: late('value') })],
    ['control', controlNode({ commandType: 'jsonata', command: late('command') })],
  ])('%s: also when the first message takes longer to be found out', async (id, node) => {
    await red.deploy([connectionTo(plc, { allowWrites: true, allowControl: true }), two(id), node, catchNode()])
    await red.receive('two', {})
    await beats(id, 2)
    expect(red.pending('catch')).toEqual([])
    expect(red.completions.filter((each) => each.id === id).map(({ message }) => message.number)).toEqual([0, 1])
    expect(plc.cpu.state).toBe('RUN')
  })

  test('write: also when the type of a label is asked for first', async () => {
    const other = await startPlc({ labels: { 'Line1.Speed': { type: 'REAL' } } })
    await red.deploy([connectionTo(other, { allowWrites: true }), writeNode({ convert: true }), catchNode()])
    await red.status('write', { fill: 'green' })
    other.faults.add({ kind: 'delay', ms: 100 })
    await red.receive('write', { payload: { 'Line1.Speed': '5', D100: 1 } })
    await red.receive('write', { payload: { D100: 2 } })
    await beats('write', 2)
    expect(other.read('D100')).toBe(2)
    expect(red.pending('catch')).toEqual([])
    await red.deploy([])
    await other.close()
  })

  test('write: what is read back is not what the next message wrote', async () => {
    const node = writeNode({ readBack: true })
    await red.deploy([connectionTo(plc, { allowWrites: true }), { ...many(10), wires: [['write']] }, node, catchNode()])
    await red.receive('many', {})
    for (let number = 1; number <= 10; number++) expect((await red.next('write')).payload).toEqual({ D100: number })
    expect(red.pending('catch')).toEqual([])
  })

  test('write: a hundred at once to a slow PLC, beside reads', async () => {
    plc.faults.add({ kind: 'delay', ms: 10 })
    await red.deploy([
      connectionTo(plc, { allowWrites: true }),
      many(100),
      writeNode(),
      readNode(['D100'], { busy: 'newest' }),
      catchNode(),
    ])
    await red.receive('many', {})
    for (let number = 1; number <= 100; number++) expect((await red.next('write')).payload).toEqual({ D100: number })
    expect(plc.read('D100')).toBe(100)
    expect(red.pending('catch')).toEqual([])
  })
})

describe('in the editor', () => {
  let browser: HeadlessBrowser

  beforeAll(async () => {
    browser = await launchBrowser()
  }, 60_000)

  afterAll(() => browser.close())

  test('a node from before there was a choice is automatic, and each choice is explained', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100'], { x: 200, y: 100 })])
    const { page, problems } = await browser.openEditor(red.url)
    await edit(page, 'read')
    const choice = page.locator('#node-input-busy')
    expect(await choice.inputValue()).toBe('auto')
    const notes: string[] = []
    for (const rule of ['auto', 'skip', 'queue', 'newest', 'msg']) {
      await choice.selectOption(rule)
      notes.push(...(await page.locator('.melsec-jw-busy:visible').allTextContents()))
    }
    expect(notes).toHaveLength(5)
    expect(new Set(notes).size).toBe(5)
    await choice.selectOption('newest')
    await close(page, 'ok')
    expect(await property(page, 'read', 'busy')).toBe('newest')
    expect(problems).toEqual([])
  }, 60_000)
})
