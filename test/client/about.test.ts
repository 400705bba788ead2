// Errors name the row they are about: `v17 (D99999999): ...`.
import { afterEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, EndCodeError, nameResults, PlcError } from '../../src/index'

const ROWS = 30
const BAD = 'D99999999'
const names = Array.from({ length: ROWS }, (_, index) => `v${index}`)
const addresses = names.map((_, index) => (index === 17 ? BAD : `D${index * 3}`))
const items = Object.fromEntries(names.map((name, index) => [name, addresses[index] ?? '']))

const open: { close(): Promise<void> }[] = []

function connected() {
  const simulator = createPlcSimulator({ profile: 'iq-r' })
  const client = createMelsecClient({
    host: 'memory',
    port: 1,
    profile: 'iq-r',
    allowWrites: true,
    openTransport: simulator.connect(),
  })
  open.push(client, simulator)
  return client
}

afterEach(async () => {
  for (const one of open.splice(0)) await one.close()
})

function messageOf(result: { readonly ok: boolean; readonly error?: PlcError } | undefined): string {
  return result?.error?.message ?? ''
}

describe('what the PLC refuses', () => {
  test('read by names: the name and the address, and the others have values', async () => {
    const results = await connected().read(items)
    expect(messageOf(results.v17)).toMatch(/^v17 \(D99999999\): Read/)
    expect(Object.values(results).filter(({ ok }) => !ok)).toHaveLength(1)
  })

  test('read as plain values', async () => {
    await expect(connected().readValues(items)).rejects.toThrow(/^v17 \(D99999999\): /)
  })

  test('a list and one item: the address', async () => {
    const client = connected()
    const results = await client.read(addresses)
    expect(messageOf(results[17])).toMatch(/^D99999999: /)
    await expect(client.read(BAD)).rejects.toThrow(/^D99999999: /)
    await expect(client.write(BAD, 1)).rejects.toThrow(/^D99999999: /)
  })

  test('a monitor', async () => {
    const results = await connected().monitor(addresses).read()
    expect(messageOf(results[17])).toMatch(/^D99999999: /)
    expect(messageOf(nameResults(results, names)[17])).toMatch(/^v17 \(D99999999\): /)
  })

  test('written together: the one that a usual CPU does not have is named first, by its name', async () => {
    const client = connected()
    const plan = client.planWrite(
      addresses.map((item) => ({ item, value: 1 })),
      { allOrNothing: true },
    )
    const results = await plan.runEach()
    const refused = results.filter((result) => !result.ok && result.error.outcome === 'refused')
    expect(refused.length).toBeGreaterThan(1)
    expect(messageOf(refused[0])).toMatch(/^D99999999, D0, .* and \d+ more, written together/)
    const named = nameResults(results, names)
    expect(messageOf(named[17])).toMatch(/^v17 \(D99999999\), v0 \(D0\), /)
  })

  test('it is the same error but for its message', async () => {
    const [result] = nameResults(await connected().read([BAD]), ['level'])
    const error = result?.ok === false ? result.error : undefined
    expect(error).toBeInstanceOf(EndCodeError)
    expect(error).toBeInstanceOf(PlcError)
    expect(error).toBeInstanceOf(Error)
    expect(error).toMatchObject({ name: 'EndCodeError', code: 'END_CODE', outcome: 'refused' })
    expect(error?.stack).toContain('level (D99999999): ')
    expect(structuredClone(error)).toMatchObject({ message: error?.message })
  })
})

describe('what is refused before it is sent, and values that cannot be converted', () => {
  test.each([
    ['D100~D109', 'v (D100~D109): a range'],
    ['D100:FOO', "v (D100:FOO): 'FOO' is not a type"],
    ['FX0', 'v (FX0): '],
    ['LTN0:REAL', 'v (LTN0:REAL): '],
  ])('%s', async (v, start) => {
    const { v: result } = await connected().read({ v })
    expect(messageOf(result).slice(0, start.length)).toBe(start)
  })

  test('words that are no value of the type', async () => {
    const client = connected()
    await client.write('D0', 0x7abc)
    const { level } = await client.read({ level: 'D0:BCD16' })
    expect(messageOf(level)).toMatch(/^level \(D0:BCD16\): /)
  })

  test('values that do not fit', async () => {
    await expect(connected().write('D100:INT', 70000)).rejects.toThrow(/^D100:INT: /)
  })
})

test('what is about the connection names no item', async () => {
  const client = connected()
  await client.close()
  const { level } = await client.read({ level: 'D100' })
  expect(messageOf(level)).not.toMatch(/level|D100/)
})
