/** Writing many items: what resolves was written; results for each are asked for by name. */
import { afterAll, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, type MelsecClient, type PlcError, WriteError } from '../../src/index'
import { clientOptions, failureOf, kind } from './line'

let plc: PlcSimulator
let client: MelsecClient

beforeAll(async () => {
  plc = createPlcSimulator({
    bufferMemory: 16,
    profile: 'iq-r',
    labels: { 'Line1.Speed': { type: 'REAL' }, address: { type: 'INT' } },
  })
  await plc.listen()
  client = createMelsecClient(clientOptions(kind('tcp 4E binary iq-r'), plc))
})
beforeEach(() => {
  plc.faults.clear()
  for (const item of ['D0', 'D1', 'D2']) plc.write(item, 0)
})
afterAll(async () => {
  await client.close()
  await plc.close()
})

async function writeError(call: Promise<unknown>): Promise<WriteError> {
  const error: PlcError = await failureOf(call)
  if (!(error instanceof WriteError)) throw new Error(`no WriteError: ${error}`)
  return error
}

/** Every call that writes many and has no results: the map, the list, and the plan. */
const ways: Readonly<Record<string, (values: Readonly<Record<string, number>>, options?: object) => Promise<void>>> = {
  'write({...})': (values, options) => client.write(values, options),
  'write([...])': (values, options) => client.write(entriesOf(values), options),
  'writeValues({...})': (values, options) => client.writeValues(values, options),
  'writeValues([...])': (values, options) => client.writeValues(entriesOf(values), options),
  'planWrite([...]).run()': (values) => client.planWrite(entriesOf(values)).run(),
}
const entriesOf = (values: Readonly<Record<string, number>>) =>
  Object.entries(values).map(([item, value]) => ({ item, value }))

describe.each(Object.keys(ways))('%s', (name) => {
  const way = (values: Readonly<Record<string, number>>) => (ways[name] as NonNullable<(typeof ways)[string]>)(values)

  test('resolves when everything was written', async () => {
    expect(await way({ D0: 1, D1: 2 })).toBeUndefined()
    expect([plc.read('D0'), plc.read('D1')]).toEqual([1, 2])
  })

  test('throws with all results when one item is refused', async () => {
    const error = await writeError(way({ D0: 1, D99999: 2, D1: 3 }))
    expect(error).toMatchObject({
      name: 'WriteError',
      code: 'NOT_ALL_WRITTEN',
      outcome: 'unknown',
      cause: { code: 'END_CODE', outcome: 'refused' },
      results: [
        { item: 'D0', ok: true },
        { item: 'D99999', ok: false, error: { code: 'END_CODE' } },
        { item: 'D1', ok: true },
      ],
    })
    expect(error.message).toMatch(/^Of 3 items: 2 written, 1 not written\. D99999/)
    expect([plc.read('D0'), plc.read('D1')]).toEqual([1, 3])
  })

  test('has the outcome notSent when no item can be written', async () => {
    const error = await writeError(way({ D0: 70_000, Q5: 1 }))
    expect(error).toMatchObject({ outcome: 'notSent', cause: { code: 'BAD_VALUE' } })
    expect(plc.read('D0')).toBe(0)
  })

  test('has the outcome refused when the PLC refused all of it', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0x0055, commands: ['writeWords', 'writeRandomWords'] })
    const error = await writeError(way({ D0: 1, D1: 2, Q5: 1 }))
    expect(error).toMatchObject({ outcome: 'refused', cause: { code: 'END_CODE', endCode: 0x55 } })
  })
})

test('what nobody knows comes first, and what was left out because of it last', async () => {
  plc.faults.add({ kind: 'silence', commands: ['writeBits'], times: 1 })
  const error = await writeError(client.write({ D0: 1, M0: true, D1: 2 }, { timeout: 200 }))
  expect(error).toMatchObject({ outcome: 'unknown', cause: { code: 'TIMEOUT', outcome: 'unknown' } })
  expect(error.message).toMatch(/^Of 3 items: 1 written, 1 not written, 1 not known\. M0/)
})

test('a failure that is not about items is thrown as it is', async () => {
  const bare = createMelsecClient({ ...clientOptions(kind('tcp 4E binary iq-r'), plc), allowWrites: false })
  expect(await failureOf(bare.write({ D0: 1 }))).toMatchObject({ name: 'RequestError', code: 'NOT_PERMITTED' })
  await bare.close()
})

test('many failures are counted, and the first are told', async () => {
  const values = Object.fromEntries(Array.from({ length: 6 }, (_, i) => [`D${i}`, 70_000]))
  const error = await writeError(client.write(values))
  expect(error.message).toMatch(/^Of 6 items: 6 not written\. D0.*D1.*D2.*And 3 more: see results\.$/)
  expect(error.results).toHaveLength(6)
})

test('writeEach gives a result for each, by name or in order', async () => {
  const byName = await client.writeEach({ D0: 1, D99999: 2 })
  expect(byName).toMatchObject({ D0: { ok: true }, D99999: { ok: false, error: { code: 'END_CODE' } } })
  const list = await client.writeEach([
    { item: 'D1', value: 4 },
    { item: 'D2', value: 70_000 },
  ])
  expect(list).toMatchObject([{ ok: true }, { ok: false, error: { code: 'BAD_VALUE' } }])
  expect(await client.planWrite([{ item: 'Q5', value: 1 }]).runEach()).toMatchObject([{ item: 'Q5', ok: false }])
})

test('labels: many that are not all written throw, writeEach has results', async () => {
  await client.labels.write({ 'Line1.Speed': 12.5 })
  const error = await writeError(client.labels.write({ 'Line1.Speed': 13.5, Missing: 1 }))
  expect(error.results).toMatchObject([
    { item: 'Line1.Speed', ok: true },
    { item: 'Missing', ok: false },
  ])
  expect(await client.labels.writeEach({ Missing: 1 })).toMatchObject({ Missing: { label: 'Missing', ok: false } })
})

describe('a tag named address', () => {
  test('is a name like any other, to every call for many', async () => {
    plc.write('D5', 55)
    expect(await client.readValues({ address: 'D5', type: 'D6' })).toEqual({ address: 55, type: 0 })
    expect(await client.readEach({ address: 'D5' })).toMatchObject({ address: { item: 'D5', ok: true, value: 55 } })
    await client.writeValues({ address: 7 })
    expect(plc.labels.get('address')).toBe(7)
    expect(await client.writeEach({ address: 8 })).toMatchObject({ address: { item: 'address', ok: true } })
  })

  test('makes read take one item, and a field that no item has is refused with the way out', async () => {
    plc.write('D5', 55)
    expect(await client.read({ address: 'D5' })).toBe(55)
    const mistaken = { address: 'D5', level: 'D6' } as unknown as string
    expect((await failureOf(client.read(mistaken))).message).toMatch(/no "level".*readEach\(\) or readValues\(\)/)
  })
})

describe('typed arrays are values of arrays', () => {
  test.each([
    ['D0[3]', Int16Array.of(1, -2, 3), [1, -2, 3]],
    ['D0:WORD[2]', Uint16Array.of(1, 65_535), [1, 65_535]],
    ['D0:WORD[2]', Uint8Array.of(1, 255), [1, 255]],
    ['D0:DINT[2]', Int32Array.of(-5, 1 << 30), [-5, 1 << 30]],
    ['D0:REAL[2]', Float32Array.of(1.5, -0.25), [1.5, -0.25]],
    ['D0:LREAL[2]', Float64Array.of(0.1, 1e300), [0.1, 1e300]],
    ['D0:LINT[2]', BigInt64Array.of(-1n, 2n ** 62n), [-1n, 2n ** 62n]],
  ] as const)('%s', async (item, values, expected) => {
    await client.write(item, values)
    expect(await client.read(item)).toEqual(expected)
    await client.writeValues({ [item]: values })
    await client.writeValues([{ item, value: values }])
  })

  test.each([
    ['D0[3]', Int16Array.of(1, 2)],
    ['D0', Int16Array.of(1)],
    ['D0[2]', Uint16Array.of(1, 65_535)],
    ['D0[2]', Float32Array.of(1.5, 2)],
    ['M0[2]', Uint8Array.of(0, 1)],
    ['D0[2]', new DataView(new ArrayBuffer(2)) as unknown as Int16Array],
  ] as const)('%s is checked as any other', async (item, values) => {
    expect(await failureOf(client.write(item, values))).toMatchObject({ code: 'BAD_VALUE', outcome: 'notSent' })
  })

  test('of buffer memory too', async () => {
    await client.memory.write(0, Uint16Array.of(1, 65_535))
    expect(await client.memory.read(0, 2)).toEqual([1, 65_535])
    expect(await failureOf(client.memory.write(0, Int16Array.of(-1)))).toMatchObject({ outcome: 'notSent' })
  })
})
