/** What the write node takes: values that are almost right, and an address in the topic; in a real Node-RED. */
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import type { WritableValue } from '../../nodes/write-values'
import { fitting } from '../../nodes/written-value'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { type CaughtError, catchNode, connectionTo, readNode, startPlc, writeNode } from './flow'

const LABELS = {
  'Line1.Speed': { type: 'REAL' },
  'Line1.Ready': { type: 'BOOL' },
  'Line1.Values': { type: 'INT', dimensions: [3] },
  'Line1.Name': { type: 'STRING(8)' },
} as const

let red: NodeRed
let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc({ labels: LABELS })
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

beforeEach(() => {
  plc.write('D100', 7)
  plc.write('M300', false)
})

afterEach(() => red.forget())

const writable = () => connectionTo(plc, { allowWrites: true })

async function write(message: Readonly<Record<string, unknown>>): Promise<Message> {
  await red.receive('write', message)
  const answer = await red.next('write')
  expect(await red.completed('write')).not.toHaveProperty('error')
  return answer
}

async function refused(message: Readonly<Record<string, unknown>>): Promise<CaughtError> {
  const before = plc.statistics.requests
  await red.receive('write', message)
  expect(await red.completed('write')).toHaveProperty('error')
  const { error } = (await red.next('catch')) as Message & { error: CaughtError }
  expect(error.cause).toMatchObject({ outcome: 'notSent' })
  expect(plc.statistics.requests).toBe(before)
  return error
}

describe('values that are almost right', () => {
  test.each([{ M300: 1 }, { D100: '5' }, { M300: 'true' }, { 'D110:REAL': '1.5' }, { 'D100[2]': [1, '2'] }])(
    '%j is refused without the tick',
    async (payload) => {
      await red.deploy([writable(), writeNode(), catchNode()])
      await red.status('write', { fill: 'green' })
      const { code, message, cause } = await refused({ payload })
      expect(code).toBe('BAD_VALUE')
      expect(message).toMatch(/[^.]\. .*tick "Accept numbers as text/)
      expect(cause).toMatchObject({ items: [{ written: false }] })
      expect([plc.read('D100'), plc.read('M300')]).toEqual([7, false])
    },
  )

  test.each([{ D100: 'five' }, { D100: 70000 }, { M300: 2 }])('no tick is named for %j', async (payload) => {
    await red.deploy([writable(), writeNode(), catchNode()])
    await red.status('write', { fill: 'green' })
    expect((await refused({ payload })).message).not.toContain('tick')
  })

  test('are written with it, and read back as what they are', async () => {
    await red.deploy([writable(), writeNode({ convert: true, readBack: true })])
    const payload = { M300: 1, D100: '-5', 'D110:REAL': '1.5e1', 'M301[3]': ['true', 0, '1'], 'D120:STRING(4)': '12' }
    expect((await write({ payload })).payload).toEqual(payload)
    expect([plc.read('M300'), plc.read('D100'), plc.read('D110:REAL')]).toEqual([true, -5, 15])
    expect(['M301', 'M302', 'M303'].map((bit) => plc.read(bit))).toEqual([true, false, true])
    expect(plc.read('D120:STRING(4)')).toBe('12')
  })

  test('also from the rows', async () => {
    const row = { name: '', address: 'M300', type: '', value: 'payload', valueType: 'msg' }
    await red.deploy([writable(), writeNode({ valuesType: 'rows', items: [row], convert: true })])
    await write({ payload: '1' })
    expect(plc.read('M300')).toBe(true)
  })

  test.each([
    { D100: ' 5' },
    { D100: '0x10' },
    { D100: '1e3' },
    { D100: '5.0' },
    { D100: '' },
    { D100: null },
    { D100: true },
    { D100: '40000' },
    { 'D110:REAL': '1,5' },
    { 'D110:REAL': '1e39' },
    { 'D110:REAL': 'NaN' },
    { M300: 2 },
    { M300: 'TRUE' },
    { M300: 'on' },
    { M300: '' },
    { 'D120:STRING(4)': 12 },
    { M300: 1, D100: 'five' },
  ])('%j is refused with it, too: nothing is written', async (payload) => {
    await red.deploy([writable(), writeNode({ convert: true }), catchNode()])
    await red.status('write', { fill: 'green' })
    expect(await refused({ payload })).toMatchObject({ code: 'BAD_VALUE' })
    expect([plc.read('D100'), plc.read('M300')]).toEqual([7, false])
  })

  test('for labels, whose types the PLC says', async () => {
    const payload = { 'Line1.Ready': 1, 'Line1.Speed': '2.5', 'Line1.Values[0]': ['1', 2, '3'], 'Line1.Name': '1' }
    await red.deploy([writable(), writeNode({ convert: true })])
    await write({ payload: { ...payload, D100: '9' } })
    expect([plc.labels.get('Line1.Ready'), plc.labels.get('Line1.Speed')]).toEqual([true, 2.5])
    expect([plc.labels.get('Line1.Values[2]'), plc.labels.get('Line1.Name'), plc.read('D100')]).toEqual([3, '1', 9])
  })
})

test.each<[WritableValue, string, WritableValue]>([
  ['9007199254740993', 'LINT', 9007199254740993n],
  ['-0', 'INT', -0],
  ['123', 'BCD16', 123],
  ['-1', 'TIME', -1],
  ['0.1', 'LREAL', 0.1],
  ['1e400', 'LREAL', '1e400'],
  [1, 'INT', 1],
  ['5', '', '5'],
])('%j for %s is %p', (value, type, fits) => {
  expect(fitting(value, type, true)).toEqual(fits)
})

describe('the address in the topic', () => {
  const byTopic = (more = {}) => writeNode({ valuesType: 'topic', ...more })

  test('and the value in the payload; the message is passed on', async () => {
    await red.deploy([writable(), byTopic()])
    expect(await write({ topic: 'D110:REAL', payload: 71.5 })).toMatchObject({ topic: 'D110:REAL', payload: 71.5 })
    await write({ topic: 'D100[2]', payload: [1, 2] })
    expect([plc.read('D110:REAL'), plc.read('D100'), plc.read('D101')]).toEqual([71.5, 1, 2])
  })

  test('is the name of a row first, then an address', async () => {
    const items = [{ name: 'D100', address: 'D130', type: 'REAL' }]
    await red.deploy([writable(), byTopic({ items })])
    await write({ topic: 'D100', payload: 1.5 })
    expect([plc.read('D130:REAL'), plc.read('D100')]).toEqual([1.5, 7])
  })

  test('takes the messages of a read node', async () => {
    await red.deploy([
      writable(),
      readNode({ D140: 'D100', M310: 'SM400' }, { output: 'messages', wires: [['write']] }),
      byTopic(),
    ])
    plc.write('SM400', true)
    await red.receive('read', {})
    await red.completed('write')
    await red.completed('write')
    expect([plc.read('D140'), plc.read('M310')]).toEqual([7, true])
  })

  test.each([
    ['no topic', { payload: 1 }, 'BAD_INPUT'],
    ['an empty topic', { topic: ' ', payload: 1 }, 'BAD_INPUT'],
    ['a number', { topic: 100, payload: 1 }, 'BAD_INPUT'],
    ['a topic that is no address', { topic: 'plant/line1/speed', payload: 1 }, 'BAD_ADDRESS'],
    ['several addresses', { topic: 'D100,D101', payload: 1 }, 'BAD_ADDRESS'],
    ['no payload', { topic: 'D100' }, 'BAD_VALUE'],
    ['values by name', { topic: 'D100', payload: { D101: 1 } }, 'BAD_VALUE'],
    ['a value that does not fit', { topic: 'D100', payload: '5' }, 'BAD_VALUE'],
  ])('%s: nothing is written', async (_, message, code) => {
    await red.deploy([writable(), byTopic(), catchNode()])
    await red.status('write', { fill: 'green' })
    expect(await refused(message)).toMatchObject({ code })
    expect(plc.read('D100')).toBe(7)
  })

  test('means nothing without the setting, which the error names', async () => {
    await red.deploy([writable(), writeNode(), catchNode()])
    await red.status('write', { fill: 'green' })
    const { code, message } = await refused({ topic: 'D100', payload: 5 })
    expect(code).toBe('BAD_INPUT')
    expect(message).toContain('msg.topic')
  })

  test('and almost right values go together', async () => {
    await red.deploy([writable(), byTopic({ convert: true })])
    await write({ topic: 'M300', payload: '1' })
    expect(plc.read('M300')).toBe(true)
  })
})

describe('typed arrays, as a function node makes them', () => {
  const made = (values: string, more = {}) => [
    writable(),
    { id: 'make', type: 'function', z: 'tab', func: `msg.payload = ${values}; return msg`, wires: [['write']] },
    writeNode(more),
    catchNode(),
  ]

  test.each([
    ['{ "D150[3]": Int16Array.of(-1, 2, 3) }', ['D150:INT', 'D151:INT', 'D152:INT'], [-1, 2, 3]],
    ['{ "D150:UINT[2]": Uint16Array.of(65535, 2) }', ['D150:UINT', 'D151:UINT'], [65535, 2]],
    ['{ "D150:WORD[2]": Uint8Array.of(255, 2) }', ['D150:WORD', 'D151:WORD'], [255, 2]],
    ['{ "D150:DINT[2]": Int32Array.of(-70000, 2) }', ['D150:DINT', 'D152:DINT'], [-70000, 2]],
    ['{ "D150:REAL[2]": Float32Array.of(1.5, -0.25) }', ['D150:REAL', 'D152:REAL'], [1.5, -0.25]],
    ['{ "D150:LREAL[2]": Float64Array.of(0.1, 2) }', ['D150:LREAL', 'D154:LREAL'], [0.1, 2]],
    [
      '{ "D150:LINT[2]": BigInt64Array.of(-1n, 9007199254740993n) }',
      ['D150:LINT', 'D154:LINT'],
      [-1n, 9007199254740993n],
    ],
  ])('%s', async (values, addresses, expected) => {
    await red.deploy(made(values, { readBack: true }))
    await red.status('write', { fill: 'green' })
    await red.receive('make', {})
    expect(await red.completed('write')).not.toHaveProperty('error')
    expect(addresses.map((address) => plc.read(address))).toEqual(expected)
  })

  test('by the address in the topic', async () => {
    await red.deploy(made('Int16Array.of(4, 5)', { valuesType: 'topic' }))
    await red.status('write', { fill: 'green' })
    await red.receive('make', { topic: 'D150[2]' })
    expect(await red.completed('write')).not.toHaveProperty('error')
    expect([plc.read('D150'), plc.read('D151')]).toEqual([4, 5])
  })

  test.each([
    ['{ "D150[2]": Int16Array.of(1, 2, 3) }', 'BAD_VALUE'],
    ['{ "D150[2]": Int32Array.of(1, 70000) }', 'BAD_VALUE'],
    ['{ "D150": Int16Array.of(1) }', 'BAD_VALUE'],
    ['{ "D150[2]": Buffer.from([1, 2]) }', 'BAD_VALUE'],
    ['{ "D150[2]": new DataView(new ArrayBuffer(2)) }', 'BAD_VALUE'],
    ['Int16Array.of(1, 2)', 'BAD_INPUT'],
  ])('%s does not fit: nothing is written', async (values, code) => {
    await red.deploy(made(values))
    await red.status('write', { fill: 'green' })
    const before = plc.statistics.requests
    await red.receive('make', {})
    expect(await red.completed('write')).toHaveProperty('error')
    const { error } = (await red.next('catch')) as Message & { error: CaughtError }
    expect([error.code, error.cause?.outcome, plc.statistics.requests]).toEqual([code, 'notSent', before])
  })
})
