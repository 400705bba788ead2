/** The on-demand node in a real Node-RED, against a simulated PLC that sends. */
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import type { PlcSimulator } from '../../src/entry/simulator'
import { until } from '../client/line'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { type CaughtError, catchNode, connectionTo, ondemandNode, readNode, startPlc } from './flow'

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

afterEach(() => red.forget())

const CONNECTED = { fill: 'green', shape: 'dot' } as const
const ROUTE = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0 }

/** Deploys, waits for the connection, sends, and gives the message. */
async function told(data: Parameters<PlcSimulator['sendOnDemand']>[0], settings = {}): Promise<Message> {
  await red.deploy([connectionTo(plc), ondemandNode(settings), catchNode()])
  await red.status('ondemand', CONNECTED)
  expect(plc.sendOnDemand(data)).toBe(1)
  return red.next('ondemand')
}

describe('the message', () => {
  test('has the words, the route and the time', async () => {
    const before = Date.now()
    const message = await told([1, 2, 65535])
    expect(message).toEqual({
      _msgid: expect.any(String),
      payload: [1, 2, 65535],
      route: ROUTE,
      timestamp: expect.any(Number),
    })
    expect(Number(message.timestamp)).toBeGreaterThanOrEqual(before)
  })

  test('has a topic when the node has one', async () => {
    expect(await told([5], { topic: 'batch done' })).toMatchObject({ topic: 'batch done', payload: [5] })
  })

  test('has a Buffer, also of an odd number of bytes', async () => {
    expect((await told(Buffer.from([1, 2, 3]), { output: 'buffer' })).payload).toEqual(Buffer.from([1, 2, 3]))
  })

  test('has a text', async () => {
    expect((await told(Buffer.from('Batch 7\0?'), { output: 'text' })).payload).toBe('Batch 7')
    expect(plc.sendOnDemand([])).toBe(1)
    expect((await red.next('ondemand')).payload).toBe('')
  })

  test('has a text in the character code of the connection', async () => {
    await red.deploy([connectionTo(plc, { encoding: 'shift-jis' }), ondemandNode({ output: 'text' })])
    await red.status('ondemand', CONNECTED)
    plc.sendOnDemand(Buffer.from([0x83, 0x65, 0x83, 0x58, 0x83, 0x67]))
    expect((await red.next('ondemand')).payload).toBe('テスト')
  })

  test('is each node’s own: what a flow changes in it, another one does not see', async () => {
    const change = { rules: [{ t: 'set', p: 'payload[0]', pt: 'msg', to: 'changed', tot: 'str' }] }
    await red.deploy([
      connectionTo(plc),
      ondemandNode({ wires: [['change']] }),
      { id: 'change', type: 'change', ...change, wires: [[]] },
      { ...ondemandNode({ topic: 'second' }), id: 'other' },
    ])
    await red.status('other', CONNECTED)
    plc.sendOnDemand([7])
    expect((await red.next('change')).payload).toEqual(['changed'])
    expect((await red.next('other')).payload).toEqual([7])
  })

  test('comes once for each frame, in order, to every node, beside reading', async () => {
    await red.deploy([
      connectionTo(plc),
      ondemandNode(),
      { ...ondemandNode({ output: 'buffer' }), id: 'other' },
      readNode(['D0'], { output: 'value' }),
    ])
    await red.status('ondemand', CONNECTED)
    plc.write('D0', 4)
    await red.receive('read', {})
    for (let i = 0; i < 20; i++) plc.sendOnDemand([i])
    const words: unknown[] = []
    for (let i = 0; i < 20; i++) words.push((await red.next('ondemand')).payload)
    expect(words).toEqual(Array.from({ length: 20 }, (_, i) => [i]))
    expect((await red.next('read')).payload).toBe(4)
    for (let i = 0; i < 20; i++) await red.next('other')
    expect([red.pending('ondemand'), red.pending('other')]).toEqual([[], []])
  })
})

describe('the connection', () => {
  test('is kept and made again, although nobody asks anything', async () => {
    await told([1])
    plc.restart(1)
    await red.status('ondemand', { fill: 'red' })
    await red.status('ondemand', CONNECTED)
    await until(() => plc.sendOnDemand([2]) === 1)
    expect((await red.next('ondemand')).payload).toEqual([2])
  })

  test('is given up with the node: what comes later is nobody’s', async () => {
    await told([1])
    await red.deploy([connectionTo(plc), { id: 'tab-keeper', type: 'comment', wires: [] }])
    await until(() => plc.connections.length === 0)
    expect(plc.sendOnDemand([2])).toBe(0)
  })

  test('that a deploy of the node leaves alone tells each frame once', async () => {
    await red.deploy([connectionTo(plc), ondemandNode(), readNode(['D0'])])
    await red.status('ondemand', CONNECTED)
    await red.deploy([connectionTo(plc), ondemandNode({ topic: 'new' }), readNode(['D0'])], 'nodes')
    await red.status('ondemand', CONNECTED)
    expect(plc.sendOnDemand([3])).toBe(1)
    expect(await red.next('ondemand')).toMatchObject({ topic: 'new', payload: [3] })
    expect(red.pending('ondemand')).toEqual([])
  })
})

describe('what cannot be read', () => {
  test.each([
    ['words', Buffer.from([1, 2, 3]), /3 bytes, which are no whole words/],
    ['text', Buffer.from([0xff, 0xfe]), /no ASCII text/],
  ])('as %s is an error with its bytes, and the next one is told', async (output, data, message) => {
    await red.deploy([connectionTo(plc), ondemandNode({ output, topic: 'news' }), catchNode()])
    await red.status('ondemand', CONNECTED)
    plc.sendOnDemand(data)
    const caught = (await red.next('catch')) as Message & { error: CaughtError }
    expect(caught).toMatchObject({ topic: 'news', payload: data, route: ROUTE, timestamp: expect.any(Number) })
    expect(caught.error).toMatchObject({ code: 'BAD_FIELD', source: { id: 'ondemand' } })
    expect(caught.error.message).toMatch(message)
    await red.status('ondemand', { fill: 'red' })
    expect(red.pending('ondemand')).toEqual([])
    plc.sendOnDemand(Buffer.from('AB'))
    expect((await red.next('ondemand')).payload).toEqual(output === 'text' ? 'AB' : [0x4241])
    await red.status('ondemand', CONNECTED)
  })
})

describe('settings that cannot work are said at once', () => {
  test.each([
    ['over UDP without a local port', { transport: 'udp' }, {}, 'bad settings'],
    ['an output that there is not', {}, { output: 'json' }, 'bad settings'],
    ['no connection', {}, { connection: 'nowhere' }, 'bad settings'],
  ])('%s', async (_what, connection, settings, text) => {
    await red.deploy([connectionTo(plc, connection), ondemandNode(settings), catchNode()])
    const key = 'bad settings'
    await red.status('ondemand', (status) => status.fill === 'red' && [text, key].includes(status.text ?? ''))
    expect(red.log.filter(({ level, id }) => level === 'error' && id === 'ondemand')).toHaveLength(1)
  })

  test('the 1E frame', async () => {
    const iqF = await startPlc({ profile: 'iq-f' })
    try {
      await red.deploy([connectionTo(iqF, { frame: '1E' }), ondemandNode(), catchNode()])
      await red.status('ondemand', { fill: 'red' })
      expect(red.log.map(({ text }) => String(text)).join()).toContain('1E frame has no On-demand')
    } finally {
      await red.deploy([])
      await iqF.close()
    }
  })
})
