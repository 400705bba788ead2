/** Labels in the read and write nodes, in a real Node-RED, against a simulated PLC. */
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { type CaughtError, catchNode, connectionTo, readNode, startPlc, writeNode } from './flow'

let red: NodeRed
let plc: PlcSimulator

const LABELS = {
  'Line1.Speed': { type: 'REAL' },
  'Line1.Ready': { type: 'BOOL' },
  'Line1.Values': { type: 'INT', dimensions: [5], value: [1, 2, 3] },
} as const

beforeAll(async () => {
  plc = await startPlc({ labels: LABELS })
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

beforeEach(() => {
  plc.labels.set('Line1.Speed', 12.5)
  plc.labels.set('Line1.Ready', false)
  plc.write('D100', 7)
})

afterEach(() => {
  plc.faults.clear()
  red.forget()
})

async function answer(id: string, message: Readonly<Record<string, unknown>> = {}): Promise<Message> {
  await red.receive(id, message)
  const sent = await red.next(id)
  expect(await red.completed(id)).not.toHaveProperty('error')
  return sent
}

async function caught(id: string, message: Readonly<Record<string, unknown>> = {}): Promise<CaughtError> {
  await red.receive(id, message)
  expect(await red.completed(id)).toHaveProperty('error')
  return ((await red.next('catch')) as Message & { error: CaughtError }).error
}

describe('reading', () => {
  const items = { speed: 'Line1.Speed', level: 'D100', first: 'label:Line1.Values[0]', three: 'Line1.Values[0]:INT[3]' }

  test('labels beside devices, again and again', async () => {
    await red.deploy([connectionTo(plc), readNode(items)])
    expect((await answer('read')).payload).toEqual({ speed: 12.5, level: 7, first: 1, three: [1, 2, 3] })
    plc.labels.set('Line1.Speed', 13)
    expect((await answer('read')).payload).toMatchObject({ speed: 13, level: 7 })
  })

  test('named by a message, with quality: one that is not there does not hide the others', async () => {
    const settings = { addressesType: 'msg', addresses: 'payload', quality: true }
    await red.deploy([connectionTo(plc), readNode([], settings)])
    const { payload } = await answer('read', { payload: ['Line1.Ready', 'Line1.Nothing', 'Q5'] })
    expect(payload).toMatchObject({
      'Line1.Ready': { value: false, quality: 'good' },
      'Line1.Nothing': { value: null, quality: 'bad', error: { code: 'END_CODE', endCode: 0x40c0 } },
      Q5: { value: null, quality: 'bad', error: { code: 'BAD_ADDRESS', outcome: 'notSent' } },
    })
  })

  test('a row with a type that the PLC does not say is an error', async () => {
    const rows = [{ name: 'speed', address: 'Line1.Speed', type: 'DINT' }]
    await red.deploy([connectionTo(plc), readNode([], { items: rows }), catchNode()])
    expect(await caught('read')).toMatchObject({
      code: 'BAD_TYPE',
      message: expect.stringContaining('REAL in the PLC'),
    })
  })

  test('the series of the connection decides', async () => {
    await red.deploy([connectionTo(plc, { profile: 'iq-f' }), readNode(['Line1.Speed']), catchNode()])
    const refused = await caught('read')
    expect(refused).toMatchObject({ code: 'BAD_ADDRESS', message: expect.stringContaining('iQ-R only') })
  })
})

describe('writing', () => {
  const writable = () => connectionTo(plc, { allowWrites: true })

  test('labels and devices by name, read back with the types of the PLC', async () => {
    await red.deploy([writable(), writeNode({ readBack: true })])
    const payload = { 'Line1.Speed': 71.3, 'Line1.Ready': true, D100: 9, 'Line1.Values[1]': [8, 9] }
    expect((await answer('write', { payload })).payload).toEqual(payload)
    expect(plc.labels.get('Line1.Speed')).toBe(Math.fround(71.3))
    expect([plc.labels.get('Line1.Ready'), plc.read('D100'), plc.labels.get('Line1.Values[2]')]).toEqual([true, 9, 9])
  })

  test('one value that does not fit, and nothing is written', async () => {
    await red.deploy([writable(), writeNode(), catchNode()])
    const { code, cause } = await caught('write', { payload: { D100: 5, 'Line1.Ready': 'on', 'Line1.Speed': 1 } })
    expect(code).toBe('BAD_VALUE')
    expect(cause).toMatchObject({
      outcome: 'notSent',
      items: [
        { name: 'D100', written: false, code: 'ABORTED' },
        { name: 'Line1.Ready', written: false, code: 'BAD_VALUE' },
        { name: 'Line1.Speed', written: false, code: 'ABORTED' },
      ],
    })
    expect([plc.read('D100'), plc.labels.get('Line1.Speed')]).toEqual([7, 12.5])
  })

  test('not without permission', async () => {
    await red.deploy([connectionTo(plc), writeNode(), catchNode()])
    expect(await caught('write', { payload: { 'Line1.Ready': true } })).toMatchObject({ code: 'NOT_PERMITTED' })
  })
})

test('in ASCII code the connection says the order of words', async () => {
  const ascii = await startPlc({ labels: { 'Line1.Speed': { type: 'REAL', value: 2.5 } }, code: 'ascii' })
  const settings = { code: 'ascii', asciiWordOrder: 'low-first' }
  await red.deploy([connectionTo(ascii, settings), readNode({ speed: 'Line1.Speed' })])
  expect((await answer('read')).payload).toEqual({ speed: 2.5 })
  await red.deploy([connectionTo(ascii, { code: 'ascii' }), readNode({ speed: 'Line1.Speed' }), catchNode()])
  expect(await caught('read')).toMatchObject({ code: 'BAD_OPTION', message: expect.stringContaining('asciiWordOrder') })
  await red.deploy([])
  await ascii.close()
})
