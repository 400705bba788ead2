/**
 * What becomes of values of the PLC on their way through other nodes of a real Node-RED: 64-bit numbers, numbers that are
 * none, and bytes.
 */
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import { carried } from '../../nodes/carried-value'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type HeadlessBrowser, launchBrowser } from '../support/browser'
import { type FlowNode, type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { readText } from '../support/syntax'
import {
  type CaughtError,
  catchNode,
  connectionTo,
  ondemandNode,
  readNode,
  requestNode,
  startPlc,
  writeNode,
} from './flow'

const EXACT = 9007199254740991n
const BEYOND = -9007199254740993n
const ITEMS = { small: 'D100:LINT', large: 'D104:LINT', both: 'D100:LINT[2]', unsigned: 'D108:ULINT' }
const NUMBERS = { small: 9007199254740991, large: `${BEYOND}`, both: [9007199254740991, `${BEYOND}`], unsigned: 5 }

let red: NodeRed
let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc()
  red = await startNodeRed({ dashboard: true })
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

beforeEach(() => {
  plc.write('D100:LINT', EXACT)
  plc.write('D104:LINT', BEYOND)
  plc.write('D108:ULINT', 5n)
})

afterEach(() => red.forget())

async function sent(from: string, message: Readonly<Record<string, unknown>> = {}, to = from): Promise<Message> {
  await red.receive(from, message)
  return red.next(to)
}

const jsonNode = (id: string): FlowNode => ({
  id,
  type: 'json',
  property: 'payload',
  action: '',
  pretty: false,
  wires: [[]],
})

function changeNode(id: string, expression: string): FlowNode {
  const rule = { t: 'set', p: 'payload', pt: 'msg', to: expression, tot: 'jsonata' }
  return { id, type: 'change', rules: [rule], wires: [[]] }
}

describe('LINT and ULINT', () => {
  test.each([
    ['left out', {}, NUMBERS],
    ['number', { int64: 'number' }, NUMBERS],
    ['bigint', { int64: 'bigint' }, { small: EXACT, large: BEYOND, both: [EXACT, BEYOND], unsigned: 5n }],
    [
      'text',
      { int64: 'text' },
      { small: `${EXACT}`, large: `${BEYOND}`, both: [`${EXACT}`, `${BEYOND}`], unsigned: '5' },
    ],
  ])('%s', async (_, settings, payload) => {
    await red.deploy([connectionTo(plc), readNode(ITEMS, settings)])
    expect((await sent('read')).payload).toEqual(payload)
  })

  test('in every form of the output, also with quality', async () => {
    await red.deploy([connectionTo(plc), readNode(ITEMS, { output: 'array', quality: true })])
    expect((await sent('read')).payload).toMatchObject(Object.values(NUMBERS).map((value) => ({ value })))
    await red.deploy([connectionTo(plc), readNode({ large: 'D104:LINT' }, { output: 'value' })])
    expect((await sent('read')).payload).toBe(`${BEYOND}`)
    await red.deploy([connectionTo(plc), readNode({ small: 'D100:LINT' }, { output: 'messages' })])
    expect(await sent('read')).toMatchObject({ topic: 'small', payload: 9007199254740991 })
  })

  test('another word for the setting is refused', async () => {
    await red.deploy([connectionTo(plc), readNode(ITEMS, { int64: 'long' }), catchNode()])
    await red.receive('read', {})
    expect(await red.next('catch')).toMatchObject({ error: { code: 'NOT_CONFIGURED' } })
  })

  test('the message survives JSON, a json node and JSONata', async () => {
    await red.deploy([
      connectionTo(plc),
      readNode(ITEMS, { wires: [['json', 'change']] }),
      jsonNode('json'),
      changeNode('change', '{ "next": payload.unsigned + 1, "sum": $sum(payload.both[0]), "all": payload }'),
    ])
    const message = await sent('read')
    expect(JSON.parse(JSON.stringify(message)).payload).toEqual(NUMBERS)
    expect(JSON.parse(String((await red.next('json')).payload))).toEqual(NUMBERS)
    expect((await red.next('change')).payload).toEqual({ next: 6, sum: 9007199254740991, all: NUMBERS })
  })

  test('what was read can be written again, whatever the form', async () => {
    for (const int64 of ['number', 'bigint', 'text']) {
      await red.deploy([
        connectionTo(plc, { allowWrites: true }),
        readNode({ 'D120:LINT': 'D100:LINT', 'D124:LINT[2]': 'D100:LINT[2]' }, { int64, wires: [['write']] }),
        writeNode({ readBack: true }),
      ])
      plc.write('D120:LINT', 0n)
      await sent('read', {}, 'write')
      expect(['D120', 'D124', 'D128'].map((address) => plc.read(`${address}:LINT`))).toEqual([EXACT, EXACT, BEYOND])
    }
  })

  test.each(['1.5', ' 5', '5 ', '+5', '05', '0x10', '1e3', '', '9223372036854775808', '9'.repeat(30)])(
    'the text %j is not written to one',
    async (text) => {
      await red.deploy([connectionTo(plc, { allowWrites: true }), writeNode(), catchNode()])
      await red.receive('write', { payload: { 'D100:LINT': text } })
      expect(await red.next('catch')).toMatchObject({ error: { code: 'BAD_VALUE', cause: { outcome: 'notSent' } } })
      expect(plc.read('D100:LINT')).toBe(EXACT)
    },
  )

  test('what reading back tells is JSON, too', async () => {
    const ended = plc.on('write', () => plc.write('D100:LINT', BEYOND))
    await red.deploy([connectionTo(plc, { allowWrites: true }), writeNode({ readBack: true }), catchNode()])
    await red.receive('write', { payload: { 'D100:LINT': 5n } })
    const { error } = (await red.next('catch')) as Message & { error: CaughtError }
    ended()
    expect(JSON.parse(JSON.stringify(error.cause))).toMatchObject({ differences: [{ written: 5, read: `${BEYOND}` }] })
  })
})

test('commands of the manuals have no number of more than 32 bits', async () => {
  const message = '{"words":[{"device":"D100"}],"doubleWords":[{"device":"D100"}]}'
  await red.deploy([connectionTo(plc), requestNode({ command: 'readRandom', message, messageType: 'json' })])
  const { payload } = await sent('request', {})
  expect(JSON.parse(JSON.stringify(payload))).toEqual({ words: [0xffff], doubleWords: [0xffffffff] })
})

test('other values are carried as they are', () => {
  const values = [true, -0, Number.NaN, Number.POSITIVE_INFINITY, '5', [1, Number.NaN]]
  expect(values.map((value) => carried(value, 'number'))).toEqual(values)
})

describe('a REAL that is not a number, and infinity', () => {
  test('come as they are; JSON makes null of them, and JSONata refuses to', async () => {
    plc.write('D110:DWORD', 0x7fc00000)
    plc.write('D112:DWORD', 0xff800000)
    await red.deploy([
      connectionTo(plc),
      readNode({ none: 'D110:REAL', least: 'D112:REAL' }, { wires: [['json', 'same', 'more']] }),
      jsonNode('json'),
      changeNode('same', 'payload'),
      changeNode('more', 'payload.least + 1'),
      catchNode(),
    ])
    const { payload } = await sent('read')
    expect(payload).toEqual({ none: Number.NaN, least: Number.NEGATIVE_INFINITY })
    expect((await red.next('json')).payload).toBe('{"none":null,"least":null}')
    expect((await red.next('same')).payload).toEqual(payload)
    expect(((await red.next('catch')) as Message & { error: CaughtError }).error.source.id).toBe('more')
  })
})

test('a Buffer becomes an object of its bytes in JSON; a json node takes it for JSON text', async () => {
  await red.deploy([
    connectionTo(plc),
    ondemandNode({ output: 'buffer', wires: [['json']] }),
    jsonNode('json'),
    catchNode(),
  ])
  await red.status('ondemand', { fill: 'green' })
  plc.sendOnDemand([1, 2])
  const { payload } = await red.next('ondemand')
  expect(JSON.parse(JSON.stringify(payload))).toEqual({ type: 'Buffer', data: [1, 0, 2, 0] })
  expect(((await red.next('catch')) as Message & { error: CaughtError }).error.source.id).toBe('json')
})

describe('a dashboard', () => {
  let browser: HeadlessBrowser

  beforeAll(async () => {
    browser = await launchBrowser()
  }, 60_000)

  afterAll(() => browser.close())

  test('shows a LINT', async () => {
    // Settings of the demo's dashboard, as its editor stores them.
    const demo = JSON.parse(readText('demo/flow.json')) as FlowNode[]
    const [ui, theme, place, group] = ['ui-base', 'ui-theme', 'ui-page', 'ui-group'].map((type) =>
      demo.find((node) => node.type === type),
    )
    const page = [ui, theme, place, group].flatMap((node) => node ?? [])
    const text = (id: string): FlowNode => ({
      id,
      type: 'ui-text',
      group: group?.id,
      order: 1,
      width: '6',
      height: '1',
      label: id,
      format: '{{msg.payload}}',
      layout: 'row-spread',
      value: `payload.${id}`,
      valueType: 'msg',
      wires: [],
    })
    await red.deploy([
      ...page,
      connectionTo(plc),
      readNode(ITEMS, { wires: [['small', 'large']] }),
      text('small'),
      text('large'),
    ])
    const opened = await browser.openPage(`${red.url}dashboard${place?.path}`)
    const shown = (id: string, value: bigint) => opened.page.locator(`#nrdb-ui-widget-${id}`, { hasText: `${value}` })
    await opened.page.locator('#nrdb-ui-widget-small').waitFor()
    await sent('read')
    await shown('small', EXACT).waitFor()
    await shown('large', BEYOND).waitFor()
    await opened.close()
  }, 60_000)
})
