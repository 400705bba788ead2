/** Labels through sockets and in memory, against the label table of the simulated PLC. */
import { afterEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator, type SimulatedLabels } from '../../src/entry/simulator'
import {
  createMelsecClient,
  EndCodeError,
  type MelsecClient,
  type MelsecOptions,
  type NetworkPlc,
  RequestError,
} from '../../src/index'

const labels: SimulatedLabels = {
  Start: { type: 'BOOL', value: true },
  'Line1.Speed': { type: 'REAL', value: 12.5 },
  'Line1.Count': { type: 'DINT', value: -100_000 },
  'Line1.Mask': { type: 'WORD', value: 0xabcd },
  'Line1.Wide': { type: 'DWORD', value: 0xdeadbeef },
  'Line1.Level': { type: 'INT', value: -2 },
  'Line1.Exact': { type: 'LREAL', value: -2.25 },
  'Line1.Left': { type: 'TIME', value: -90_061 },
  'Line1.Recipe': { type: 'STRING(5)', value: 'Apple' },
  'Line1.Product': { type: 'WSTRING(4)', value: '林檎' },
  'Line1.Bits': { type: 'BOOL', dimensions: [40] },
  'Line1.Values': { type: 'INT', dimensions: [3000] },
  Cube: { type: 'DINT', dimensions: [2, 3, 4] },
  Timer1: { type: 'TIMER' },
  LongTimer: { type: 'LONG TIMER' },
}

const open: { client: MelsecClient; plc: PlcSimulator }[] = []
afterEach(async () => {
  for (const { client, plc } of open.splice(0)) {
    await client.close()
    await plc.close()
  }
})

interface Joined {
  readonly client: MelsecClient
  readonly plc: PlcSimulator
  /** Commands the PLC carried out or refused. */
  readonly asked: string[]
}

async function joined(options: Partial<MelsecOptions & NetworkPlc> = {}): Promise<Joined> {
  const code = options.code ?? 'binary'
  const plc = createPlcSimulator({ profile: 'iq-r', code, labels, udp: false })
  await plc.listen()
  const asked: string[] = []
  plc.on('request', ({ command }) => void asked.push(String(command)))
  const client = createMelsecClient({
    host: '127.0.0.1',
    port: plc.tcp?.port ?? 0,
    profile: 'iq-r',
    allowWrites: true,
    ...options,
  })
  open.push({ client, plc })
  await client.connect()
  asked.length = 0
  return { client, plc, asked }
}

const values = {
  Start: true,
  'Line1.Speed': 12.5,
  'Line1.Count': -100_000,
  'Line1.Mask': 0xabcd,
  'Line1.Wide': 0xdeadbeef,
  'Line1.Level': -2,
  'Line1.Exact': -2.25,
  'Line1.Left': -90_061,
  'Line1.Recipe': 'Apple',
  'Line1.Product': '林檎',
  'Cube[1,2,3]': 0,
  'Timer1.S': false,
  'Timer1.N': 0,
  'LongTimer.N': 0,
}
const changed = {
  Start: false,
  'Line1.Speed': -0.5,
  'Line1.Count': 2147483647,
  'Line1.Mask': 1,
  'Line1.Wide': 4294967295,
  'Line1.Level': 32767,
  'Line1.Exact': 1e300,
  'Line1.Left': 2147483647,
  'Line1.Recipe': 'Tea',
  'Line1.Product': '緑茶',
  'Cube[1,2,3]': 7,
  'Timer1.S': true,
  'Timer1.N': 65535,
  'LongTimer.N': 4294967295,
}
const codes = ['binary', 'ascii'] as const

describe.each(codes)('in %s code over TCP', (code) => {
  const order = code === 'ascii' ? ({ asciiWordOrder: 'low-first' } as const) : {}

  test('every type is read and written, with few requests', async () => {
    const { client, plc, asked } = await joined({ code })
    const names = Object.keys(values)
    const read = await client.labels.read(names, order)
    expect(read.map((result) => (result.ok ? result.value : result.error))).toEqual(Object.values(values))
    expect(read.map((result) => (result.ok ? result.type : ''))).toEqual([
      'BOOL',
      'REAL',
      'DINT',
      'WORD',
      'DWORD',
      'INT',
      'LREAL',
      'TIME',
      'STRING(5)',
      'WSTRING(4)',
      'DINT',
      'BOOL',
      'WORD',
      'DWORD',
    ])
    expect(asked).toHaveLength(1)
    const written = await client.labels.writeEach(changed, order)
    expect(Object.values(written).filter(({ ok }) => !ok)).toEqual([])
    expect(asked).toHaveLength(3)
    expect(names.map((name) => plc.labels.get(name))).toEqual(Object.values(changed))
  })

  test('arrays of words and bits, longer than one answer', async () => {
    const { client, plc } = await joined({ code })
    const numbers = Array.from({ length: 3000 }, (_, i) => i - 1500)
    plc.labels.set('Line1.Values[0]', numbers)
    plc.labels.set('Line1.Bits[3]', [true, false, true])
    const [all, bits] = await client.labels.read([
      { label: 'Line1.Values[0]', count: 3000 },
      { label: 'Line1.Bits[2]', count: 20 },
    ])
    expect(all).toMatchObject({ ok: true, value: numbers, torn: true, type: 'INT' })
    expect(bits).toMatchObject({ ok: true, value: [false, true, false, true, ...new Array(16).fill(false)] })
    await client.labels.write({ 'Line1.Values[10]': [7, 8, 9], 'Line1.Bits[20]': [true, true, false] })
    expect([9, 10, 11, 12, 13].map((at) => plc.labels.get(`Line1.Values[${at}]`))).toEqual([-1491, 7, 8, 9, -1487])
    expect([19, 20, 21, 22].map((at) => plc.labels.get(`Line1.Bits[${at}]`))).toEqual([false, true, true, false])
  })

  test('more names than one request takes are divided', async () => {
    const { client, plc, asked } = await joined({ code })
    const numbers = Array.from({ length: 300 }, (_, i) => i)
    plc.labels.set('Line1.Values[0]', numbers)
    const results = await client.labels.read(numbers.map((at) => `Line1.Values[${at}]`))
    expect(results.map((result) => (result.ok ? result.value : result.error))).toEqual(numbers)
    expect(asked.length).toBeGreaterThan(2)
    expect(asked.length).toBeLessThan(12)
  })
})

describe('reading', () => {
  test('an unknown label does not hide the others', async () => {
    const { client, asked } = await joined()
    const names = ['Start', 'Line1.Nothing', 'Line1.Speed', 'Line1.Values[3000]', 'AAA.3', 'Line1.Level']
    const results = await client.labels.read(names)
    expect(results.map((result) => (result.ok ? result.value : result.error.code))).toEqual([
      true,
      'END_CODE',
      12.5,
      'END_CODE',
      'BAD_ADDRESS',
      -2,
    ])
    expect(asked.length).toBeLessThan(10)
    await expect(client.labels.read('Line1.Nothing')).rejects.toThrow(EndCodeError)
    await expect(client.labels.read('Line1.Speed')).resolves.toBe(12.5)
  })

  test('what cannot be asked is refused before anything is sent', async () => {
    const { client, asked } = await joined()
    await expect(client.labels.read({ label: 'Line1.Values', count: 3 })).rejects.toThrow('name the first element')
    await expect(client.labels.read({ label: 'Line1.Values[0]', count: 0 })).rejects.toThrow('0 elements')
    await expect(client.labels.read('Line1.Values[Index]')).rejects.toThrow(RequestError)
    expect(asked).toEqual([])
  })

  test('an array of several dimensions is not cut', async () => {
    const { client } = await joined()
    const read = client.labels.read({ label: 'Cube[0,0,0]', count: 1000 })
    await expect(read).rejects.toMatchObject({ code: 'LIMIT_EXCEEDED' })
    await expect(client.labels.read({ label: 'Cube[0,2,0]', count: 5 })).resolves.toEqual([0, 0, 0, 0, 0])
  })

  test('in ASCII code the order of the words of a value must be said', async () => {
    const { client } = await joined({ code: 'ascii' })
    await expect(client.labels.read('Line1.Speed')).rejects.toMatchObject({ field: 'asciiWordOrder' })
    await expect(client.labels.read('Line1.Level')).resolves.toBe(-2)
    await expect(client.labels.write('Line1.Speed', 1)).rejects.toMatchObject({ field: 'asciiWordOrder' })
  })

  test('a family without labels says so, and nothing is sent', async () => {
    const client = createMelsecClient({ host: '127.0.0.1', port: 1, profile: 'iq-f' })
    await expect(client.labels.read('Start')).rejects.toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
    await client.close()
  })
})

describe('writing', () => {
  test('needs allowWrites, before the types are read', async () => {
    const { client, asked } = await joined({ allowWrites: false })
    await expect(client.labels.write('Start', false)).rejects.toMatchObject({ code: 'NOT_PERMITTED' })
    await expect(client.labels.write({ Start: false })).rejects.toMatchObject({ code: 'NOT_PERMITTED' })
    expect(asked).toEqual([])
  })

  test('what does not fit the type of the label is refused, the rest is written', async () => {
    const { client, plc } = await joined()
    const results = await client.labels.writeEach({
      Start: 1,
      'Line1.Level': 40_000,
      'Line1.Recipe': 'too long',
      'Line1.Product': '12345',
      'Line1.Nothing': 1,
      'Line1.Bits[39]': [true, true],
      'Line1.Count': 5,
    })
    const codes = Object.values(results).map((result) => (result.ok ? 'ok' : result.error.code))
    expect(codes.slice(0, 5)).toEqual(['BAD_VALUE', 'BAD_VALUE', 'BAD_VALUE', 'BAD_VALUE', 'END_CODE'])
    expect(codes.slice(5)).toEqual(['END_CODE', 'ok'])
    expect([plc.labels.get('Start'), plc.labels.get('Line1.Count'), plc.labels.get('Line1.Level')]).toEqual([
      true,
      5,
      -2,
    ])
  })

  test('the order is kept between labels and arrays, and nothing goes on behind an unknown outcome', async () => {
    const { client, plc, asked } = await joined({ timeout: 300 })
    await client.labels.write({ Start: false, 'Line1.Values[0]': [1, 2], 'Line1.Level': 3 })
    expect(asked).toEqual(['readRandomLabels', 'writeRandomLabels', 'writeArrayLabels', 'writeRandomLabels'])
    plc.faults.add({ kind: 'silence', commands: ['writeArrayLabels'], times: 1 })
    const results = await client.labels.writeEach({ Start: true, 'Line1.Values[0]': [5], 'Line1.Level': 9 })
    const outcomes = Object.values(results).map((result) => (result.ok ? 'ok' : result.error.outcome))
    expect(outcomes).toEqual(['ok', 'unknown', 'notSent'])
    expect(plc.labels.get('Line1.Level')).toBe(3)
  })

  test('an array that is longer than one request is refused', async () => {
    const { client } = await joined()
    const write = client.labels.write('Line1.Values[0]', new Array(1000).fill(1))
    await expect(write).rejects.toMatchObject({ code: 'LIMIT_EXCEEDED', outcome: 'notSent' })
  })
})
