/** The read node in a real Node-RED, against a simulated PLC. */
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { type CaughtError, catchNode, connectionTo, readNode, startPlc } from './flow'

let red: NodeRed
let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc()
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

beforeEach(() => {
  plc.write('D100:REAL', 71.5)
  plc.write('D120:DINT', -7)
  plc.write('M10', true)
  plc.write('D130:STRING(20)', 'Green tea')
})

afterEach(() => {
  plc.faults.clear()
  red.forget()
})

const TANK = { level: 'D100:REAL', batches: 'D120:DINT', running: 'M10', product: 'D130:STRING(20)' }
/** Beyond the devices of the simulated CPU, so that the PLC refuses it. */
const REFUSED = 'D99999'

async function ask(message: Readonly<Record<string, unknown>> = {}): Promise<Message> {
  await red.receive('read', message)
  const answer = await red.next('read')
  expect(await red.completed('read')).not.toHaveProperty('error')
  return answer
}

async function caught(message: Readonly<Record<string, unknown>> = {}): Promise<Message & { error: CaughtError }> {
  await red.receive('read', message)
  expect(await red.completed('read')).toHaveProperty('error')
  return (await red.next('catch')) as Message & { error: CaughtError }
}

describe('the output', () => {
  test('is an object by name, in the message that was received', async () => {
    await red.deploy([connectionTo(plc), readNode(TANK)])
    const message = await ask({ _msgid: 'abc', topic: 'tank', payload: 'replaced', own: { kept: true } })
    expect(message).toEqual({
      _msgid: 'abc',
      topic: 'tank',
      own: { kept: true },
      payload: { level: 71.5, batches: -7, running: true, product: 'Green tea' },
    })
  })

  test('is one value, in the property that was chosen', async () => {
    await red.deploy([connectionTo(plc), readNode(['D100:REAL'], { output: 'value', property: 'tank.level' })])
    expect(await ask({ payload: 1 })).toMatchObject({ payload: 1, tank: { level: 71.5 } })
  })

  test('is an array in the order of the rows', async () => {
    await red.deploy([connectionTo(plc), readNode(TANK, { output: 'array' })])
    expect((await ask()).payload).toEqual([71.5, -7, true, 'Green tea'])
  })

  test('is one message per item, with topic and parts for a Join node', async () => {
    await red.deploy([
      connectionTo(plc),
      readNode(TANK, { output: 'messages', wires: [['join']] }),
      { id: 'join', type: 'join', mode: 'auto', wires: [[]] },
    ])
    await red.receive('read', { _msgid: 'abc', own: 1 })
    const first = await red.next('read')
    await red.completed('read')
    expect(first).toMatchObject({ _msgid: 'abc', own: 1, topic: 'level', payload: 71.5 })
    expect(first.parts).toMatchObject({ index: 0, count: 4, key: 'level' })
    expect((await red.next('join')).payload).toEqual({ level: 71.5, batches: -7, running: true, product: 'Green tea' })
  })

  test('of one value refuses several items', async () => {
    await red.deploy([connectionTo(plc), readNode(TANK, { output: 'value' }), catchNode()])
    expect((await caught()).error).toMatchObject({ code: 'NOT_CONFIGURED' })
  })

  test('has arrays for counts and ranges, and text for what a number of 64 bits cannot hold', async () => {
    plc.write('D200:LINT', 2n ** 62n + 1n)
    await red.deploy([connectionTo(plc), readNode({ bits: 'M10..M12', words: 'D120[2]', big: 'D200:LINT' })])
    expect((await ask()).payload).toEqual({ bits: [true, false, false], words: [-7, -1], big: '4611686018427387905' })
  })
})

describe('addresses from the message', () => {
  const dynamic = (more: object = {}) => readNode([], { addressesType: 'msg', addresses: 'payload', ...more })

  test.each([
    ['an address', 'D100:REAL', { 'D100:REAL': 71.5 }],
    ['a list', ['D100:REAL', 'M10'], { 'D100:REAL': 71.5, M10: true }],
    ['an object by name', { level: 'D100:REAL', on: { address: 'M10' } }, { level: 71.5, on: true }],
    ['an item with its type', { address: 'D100', type: 'REAL' }, { D100: 71.5 }],
  ])('%s', async (_what, payload, values) => {
    await red.deploy([connectionTo(plc), dynamic()])
    expect((await ask({ payload })).payload).toEqual(values)
  })

  test('other addresses in the next message are read, and not those of the message before', async () => {
    await red.deploy([connectionTo(plc), dynamic()])
    expect((await ask({ payload: { tank: 'D100:REAL' } })).payload).toEqual({ tank: 71.5 })
    expect((await ask({ payload: { tank: 'D120:DINT' } })).payload).toEqual({ tank: -7 })
    expect((await ask({ payload: { tank: 'M10' } })).payload).toEqual({ tank: true })
    expect((await ask({ payload: { tank: 'D100:REAL' } })).payload).toEqual({ tank: 71.5 })
  })

  test.each([
    ['nothing', undefined],
    ['a number', 100],
    ['an empty list', []],
    ['a list with a hole', ['D100', null]],
  ])('%s is refused', async (_what, payload) => {
    await red.deploy([connectionTo(plc), dynamic(), catchNode()])
    expect((await caught({ payload })).error).toMatchObject({ code: 'BAD_INPUT', cause: { outcome: 'notSent' } })
    expect(red.pending('read')).toEqual([])
  })

  test('JSONata, environment and context', async () => {
    const tab = { id: 'tab', type: 'tab', label: 'Tank', env: [{ name: 'ADDRESS', value: 'D100:REAL', type: 'str' }] }
    const onTab = (node: object) => ({ ...(node as ReturnType<typeof readNode>), z: 'tab' })
    await red.deploy([
      tab,
      connectionTo(plc),
      onTab(dynamic({ addressesType: 'jsonata', addresses: '["D100:REAL", "M" & payload]' })),
    ])
    expect((await ask({ payload: 10 })).payload).toEqual({ 'D100:REAL': 71.5, M10: true })
    await red.deploy([tab, connectionTo(plc), onTab(dynamic({ addressesType: 'env', addresses: 'ADDRESS' }))])
    expect((await ask()).payload).toEqual({ 'D100:REAL': 71.5 })
    await red.deploy([
      tab,
      connectionTo(plc),
      { id: 'set', type: 'function', z: 'tab', func: 'flow.set("list", ["M10"]); return msg', wires: [['read']] },
      onTab(dynamic({ addressesType: 'flow', addresses: 'list' })),
    ])
    await red.receive('set', {})
    expect((await red.next('read')).payload).toEqual({ M10: true })
    await red.completed('read')
  })
})

describe('quality', () => {
  test('and timestamp come with each value', async () => {
    const before = Date.now()
    await red.deploy([connectionTo(plc), readNode(TANK, { quality: true })])
    const { payload, errors } = await ask()
    expect(payload).toMatchObject({ level: { value: 71.5, quality: 'good' }, running: { value: true } })
    const { timestamp } = (payload as Record<string, { timestamp: number }>).level ?? { timestamp: 0 }
    expect(timestamp).toBeGreaterThanOrEqual(before)
    expect(timestamp).toBeLessThanOrEqual(Date.now())
    expect(errors).toEqual([])
  })

  test('is bad for what the PLC refused, and good for the rest', async () => {
    await red.deploy([
      connectionTo(plc),
      readNode({ level: 'D100:REAL', beyond: REFUSED }, { quality: true }),
      catchNode(),
    ])
    const { payload, errors } = await ask()
    expect(payload).toMatchObject({
      level: { value: 71.5, quality: 'good' },
      beyond: { value: null, quality: 'bad', error: { outcome: expect.any(String) } },
    })
    expect(errors).toMatchObject([{ name: 'beyond', item: REFUSED }])
    expect(red.pending('catch')).toEqual([])
    await red.status('read', { fill: 'yellow', text: '1 of 2 failed' })
  })

  test('is bad for everything while the PLC is silent, and the message is sent all the same', async () => {
    await red.deploy([connectionTo(plc, { timeout: '1000' }), readNode(TANK, { quality: true })])
    await ask()
    plc.faults.add({ kind: 'silence' })
    const { payload } = await ask()
    expect(Object.values(payload as object)).toHaveLength(4)
    for (const value of Object.values(payload as object)) expect(value).toMatchObject({ value: null, quality: 'bad' })
  })

  test('is bad for everything for want of a connection: the status says in red why, and is green again by itself', async () => {
    const other = await startPlc()
    await red.deploy([connectionTo(other), readNode(TANK, { quality: true })])
    await ask()
    await red.status('read', { fill: 'green' })
    other.restart(1500)
    const { state } = (await red.status('read', { fill: 'red' })) as { state?: string }
    expect(['waiting', 'connecting']).toContain(state)
    const { payload } = await ask()
    for (const value of Object.values(payload as object)) expect(value).toMatchObject({ quality: 'bad' })
    const shown = red.statuses('read')
    expect(shown.at(-1)).toMatchObject({ fill: 'red', code: expect.stringMatching(/CONNECT_FAILED|DISCONNECTED/) })
    expect(shown.slice(shown.findIndex(({ fill }) => fill === 'red')).every(({ fill }) => fill === 'red')).toBe(true)
    expect(await red.status('read', { fill: 'green' })).toEqual({
      fill: 'green',
      shape: 'dot',
      text: 'connected',
      state: 'connected',
    })
    const again = (await ask()).payload
    for (const value of Object.values(again as object)) expect(value).toMatchObject({ quality: 'good' })
    await red.deploy([])
    await other.close()
  })
})

describe('when some items fail', () => {
  const mixed = { level: 'D100:REAL', beyond: REFUSED, running: 'M10' }

  test('the message begins with the name and the address of the row', async () => {
    await red.deploy([connectionTo(plc), readNode(mixed), catchNode()])
    expect((await caught()).error.message).toMatch(/^PlcError: beyond \(D99999\): /)
    await red.deploy([connectionTo(plc), readNode({ level: 'D100~D109' }), catchNode()])
    expect((await caught()).error.message).toMatch(/^PlcError: level \(D100~D109\): a range/)
  })

  test('nothing is sent, and Catch gets code, outcome, end code and every item', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0xc056 })
    await red.deploy([connectionTo(plc), readNode(['D100']), catchNode()])
    const { error, ...message } = await caught({ _msgid: 'abc', payload: 'mine' })
    expect(message).toMatchObject({ _msgid: 'abc', payload: 'mine' })
    expect(error).toMatchObject({
      code: 'END_CODE',
      source: { id: 'read' },
      cause: { outcome: 'refused', endCode: 0xc056, errors: [{ name: 'D100', endCode: 0xc056 }] },
    })
    expect(error.cause.meaning).toEqual(expect.any(String))
    expect(error.cause.remedy).toEqual(expect.any(String))
    await red.status('read', { fill: 'red', shape: 'ring', text: 'end code C056' })
    expect(red.pending('read')).toEqual([])
    expect(red.completions.filter(({ id }) => id === 'read')).toHaveLength(1)
  })

  test('an error says which, although others could be read', async () => {
    await red.deploy([connectionTo(plc), readNode(mixed), catchNode()])
    const { error } = await caught()
    expect(error.cause.errors).toMatchObject([{ name: 'beyond' }])
    expect(red.pending('read')).toEqual([])
  })

  test.each([
    ['object', { level: 71.5, running: true }],
    ['array', [71.5, null, true]],
  ])('the rest is sent as %s when that was chosen', async (output, payload) => {
    await red.deploy([connectionTo(plc), readNode(mixed, { output, partial: 'send' }), catchNode()])
    const message = await ask()
    expect(message.payload).toEqual(payload)
    expect(message.errors).toMatchObject([{ name: 'beyond', item: REFUSED, outcome: expect.any(String) }])
    expect(red.completions.filter(({ id }) => id === 'read')).toHaveLength(1)
  })

  test('a message is not sent with nothing in it', async () => {
    await red.deploy([connectionTo(plc), readNode([REFUSED], { partial: 'send' }), catchNode()])
    await caught()
    expect(red.pending('read')).toEqual([])
  })

  test('a bad address is an error of its row only', async () => {
    await red.deploy([connectionTo(plc), readNode({ level: 'D100:REAL', odd: 'Q5' }, { partial: 'send' })])
    const message = await ask()
    expect(message.payload).toEqual({ level: 71.5 })
    expect(message.errors).toMatchObject([{ name: 'odd', code: 'BAD_ADDRESS', outcome: 'notSent' }])
  })
})

test('every message of a burst is answered, each done once', async () => {
  plc.faults.add({ kind: 'delay', ms: 2 })
  await red.deploy([connectionTo(plc), readNode(TANK)])
  await red.status('read', { fill: 'green' })
  const numbers = Array.from({ length: 100 }, (_, number) => number)
  for (const number of numbers) await red.receive('read', { number })
  for (const number of numbers) expect(await red.next('read')).toMatchObject({ number, payload: { level: 71.5 } })
  for (const _ of numbers) expect(await red.completed('read')).not.toHaveProperty('error')
  expect(red.completions.filter(({ id }) => id === 'read')).toHaveLength(numbers.length)
})

test('fixed rows are planned once: four items are one request each time', async () => {
  await red.deploy([connectionTo(plc), readNode(['D100:REAL', 'D102', 'D103', 'D110'])])
  await ask()
  const before = plc.statistics.requests
  for (let round = 0; round < 5; round++) await ask()
  expect(plc.statistics.requests - before).toBe(5)
})
