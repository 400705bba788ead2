/** Labels beside devices in read and write. */
import { afterEach, beforeEach, describe, expect, test } from '@jest/globals'
import { createMelsecClient, createPlcSimulator, type MelsecClient, type PlcSimulator } from '../../src/index'

let plc: PlcSimulator
let client: MelsecClient
let asked: string[]

beforeEach(async () => {
  plc = createPlcSimulator({
    profile: 'iq-r',
    labels: {
      'Line1.Speed': { type: 'REAL', value: 12.5 },
      'Line1.Values': { type: 'INT', dimensions: [5], value: [1, 2, 3, 4, 5] },
      'Line1.Ready': { type: 'BOOL' },
    },
  })
  client = createMelsecClient({
    host: 'in memory',
    port: 1,
    profile: 'iq-r',
    allowWrites: true,
    openTransport: plc.connect(),
    timeout: 300,
  })
  await client.connect()
  asked = []
  plc.on('request', ({ command }) => void asked.push(String(command)))
  plc.write('D100:REAL', -1)
})
afterEach(async () => {
  await client.close()
  await plc.close()
})

describe('read', () => {
  test('one label', async () => {
    await expect(client.read('label:Line1.Speed')).resolves.toBe(12.5)
    await expect(client.read({ address: 'LABEL: Line1.Values[1]', count: 3 })).resolves.toEqual([2, 3, 4])
    await expect(client.read('label:Line1.Nothing')).rejects.toMatchObject({ code: 'END_CODE' })
  })

  test('labels and devices in one call, in the order given', async () => {
    const items = ['D100:REAL', 'label:Line1.Speed', 'Q1', 'label:A.1', 'label:Line1.Ready', 'M0'] as const
    const results = await client.read(items)
    expect(results.map(({ item }) => item)).toEqual([...items])
    expect(results.map((result) => (result.ok ? result.value : result.error.code))).toEqual([
      -1,
      12.5,
      'BAD_ADDRESS',
      'BAD_ADDRESS',
      false,
      false,
    ])
    expect(results.every(({ timestamp }) => timestamp > 0)).toBe(true)
    await expect(client.readValues({ level: 'D100:REAL', speed: 'label:Line1.Speed' })).resolves.toEqual({
      level: -1,
      speed: 12.5,
    })
    const named = await client.read({ speed: 'label:Line1.Speed' })
    expect(named.speed).toMatchObject({ ok: true, value: 12.5, item: 'label:Line1.Speed' })
  })

  test('without the prefix a name is no label, and options of devices are refused', async () => {
    await expect(client.read('Line1.Speed')).rejects.toMatchObject({ code: 'BAD_ADDRESS' })
    const typed = client.read({ address: 'label:Line1.Speed', type: 'REAL' })
    await expect(typed).rejects.toMatchObject({ code: 'BAD_OPTION', field: 'type' })
    expect(asked).toEqual([])
  })
})

describe('write', () => {
  test('one label, and many with devices between them in the order given', async () => {
    await client.write('label:Line1.Speed', 3)
    expect(plc.labels.get('Line1.Speed')).toBe(3)
    asked.length = 0
    const results = await client.write({ 'label:Line1.Values[3]': [9, 8], 'D100:REAL': 2, 'label:Line1.Ready': true })
    expect(results).toEqual({
      'label:Line1.Values[3]': { item: 'label:Line1.Values[3]', ok: true },
      'D100:REAL': { item: 'D100:REAL', ok: true },
      'label:Line1.Ready': { item: 'label:Line1.Ready', ok: true },
    })
    expect(asked.filter((command) => command.startsWith('write'))).toEqual([
      'writeArrayLabels',
      'writeWords',
      'writeRandomLabels',
    ])
    expect([plc.labels.get('Line1.Values[4]'), plc.labels.get('Line1.Ready')]).toEqual([8, true])
  })

  test('nothing goes on behind an unknown outcome', async () => {
    plc.faults.add({ kind: 'silence', commands: ['writeWords'], times: 1 })
    const results = await client.write([
      { item: 'D100:REAL', value: 5 },
      { item: 'label:Line1.Ready', value: true },
    ])
    expect(results.map((result) => (result.ok ? 'ok' : result.error.outcome))).toEqual(['unknown', 'notSent'])
    expect(plc.labels.get('Line1.Ready')).toBe(false)
  })

  test('refused: counts, allOrNothing, and everything without allowWrites', async () => {
    const counted = client.write({ address: 'label:Line1.Values[0]', count: 2 }, [1, 2])
    await expect(counted).rejects.toMatchObject({ code: 'BAD_OPTION', field: 'count' })
    const all = client.write({ 'label:Line1.Ready': true }, { allOrNothing: true })
    await expect(all).rejects.toMatchObject({ field: 'allOrNothing' })
    expect(asked).toEqual([])
    const reader = createMelsecClient({ host: 'in memory', port: 1, profile: 'iq-r', openTransport: plc.connect() })
    await expect(reader.write('label:Line1.Ready', true)).rejects.toMatchObject({ code: 'NOT_PERMITTED' })
    await expect(reader.write({ 'label:Line1.Ready': true, M0: true })).rejects.toMatchObject({ code: 'NOT_PERMITTED' })
    await reader.close()
    expect(plc.labels.get('Line1.Ready')).toBe(false)
  })
})
