/** Plans that read() keeps: each belongs to its whole list, and they do not fill the memory. */
import { afterEach, beforeEach, expect, jest, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, type MelsecClient } from '../../src/index'
import { MelsecProtocol } from '../../src/melsec/protocol'

let plc: PlcSimulator
let client: MelsecClient
beforeEach(() => {
  plc = createPlcSimulator({ profile: 'iq-r' })
  for (let i = 0; i < 1000; i++) plc.memory.setWord('D', i, i)
  client = createMelsecClient({ host: 'memory', port: 1, profile: 'iq-r', openTransport: plc.connect() })
})
afterEach(async () => {
  await client.close()
  await plc.close()
})

test('lists that begin, or end, alike are not taken for one another', async () => {
  expect(await client.readValues(['D1', 'D2'])).toEqual([1, 2])
  expect(await client.readValues(['D1', 'D3'])).toEqual([1, 3])
  expect(await client.readValues(['D1'])).toEqual([1])
  expect(await client.readValues(['D4', 'D3'])).toEqual([4, 3])
  expect(await client.readValues(['D1', 'D2'])).toEqual([1, 2])
  expect(await client.readValues([{ address: 'D1', count: 2 }, 'D2'])).toEqual([[1, 2], 2])
  expect(await client.readValues([{ address: 'D1', count: 3 }, 'D2'])).toEqual([[1, 2, 3], 2])
})

test('a list that is read again is not planned again, until so many others have come that its plan is forgotten', async () => {
  const planned = jest.spyOn(MelsecProtocol.prototype, 'exchange')
  try {
    const requestsMade = async () => {
      planned.mockClear()
      expect(await client.read('D0')).toBe(0)
      return planned.mock.calls.length
    }
    await client.connect()
    expect(await requestsMade()).toBeGreaterThan(0)
    expect(await requestsMade()).toBe(0)
    for (let number = 1; number < 600; number++) await client.read(`D${number}`)
    expect(await requestsMade()).toBeGreaterThan(0)
  } finally {
    planned.mockRestore()
  }
})

test('a plan of items by name gives results by name, and errors call them so', async () => {
  const plan = client.plan({ level: 'D7', wrong: 'D1:NONE', address: 'D9' })
  const { level, wrong, address } = await plan.run()
  expect([level, address]).toMatchObject([
    { item: 'D7', ok: true, value: 7 },
    { item: 'D9', ok: true, value: 9 },
  ])
  expect(wrong.ok ? '' : wrong.error.message).toMatch(/^wrong \(D1:NONE\)/)
  expect(String(plan)).toBe(String(client.plan(['D7', 'D1:NONE', 'D9'])))
})
