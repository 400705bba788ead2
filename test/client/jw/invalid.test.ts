/** What programs without types pass: a typed error before anything is sent, and nothing else is ever thrown. */
import { expect, test } from '@jest/globals'
import { createJwClient } from '../../../src/client/jw/jw-client'
import { JW_OPTION_NAMES } from '../../../src/client/jw/options'
import { type PlcError as Failure, PlcError } from '../../../src/errors'
import { inMemory } from './small-jw'

const values: readonly unknown[] = [
  undefined,
  null,
  '',
  'x',
  -1,
  0.5,
  Number.NaN,
  2 ** 40,
  true,
  [],
  [1],
  {},
  { address: 5 },
  Object.create(null),
  Object.assign(Object.create(null), { a: '09000' }),
  () => {},
  Symbol('s'),
  10n,
  new Date(Number.NaN),
]

function loose(call: unknown): (...args: readonly unknown[]) => unknown {
  return call as (...args: readonly unknown[]) => unknown
}

async function strangeness(run: () => unknown): Promise<unknown> {
  try {
    const result = await run()
    for (const one of Array.isArray(result) ? result : []) {
      if (one?.ok === false && !(one.error instanceof PlcError)) return one.error
    }
    return undefined
  } catch (error) {
    return error instanceof PlcError ? undefined : error
  }
}

test.each(Object.keys(JW_OPTION_NAMES).filter((name) => !['clock'].includes(name)))('option %s', async (name) => {
  for (const value of values) {
    expect(
      await strangeness(() => loose(createJwClient)({ host: '127.0.0.1', port: 1, [name]: value })),
    ).toBeUndefined()
  }
})

test('options that are none, and calls', async () => {
  const { client } = inMemory({ timeout: 200 })
  const calls: readonly ((value: unknown) => unknown)[] = [
    (x) => loose(createJwClient)(x),
    (x) => loose(client.read.bind(client))(x),
    (x) => loose(client.readEach.bind(client))(x),
    (x) => loose(client.readValues.bind(client))([x]),
    (x) => loose(client.read.bind(client))('09000', x),
    (x) => loose(client.write.bind(client))(x),
    (x) => loose(client.write.bind(client))('09000', x),
    (x) => loose(client.write.bind(client))('004033', x),
    (x) => loose(client.write.bind(client))('09000', 1, x),
    (x) => loose(client.writeEach.bind(client))([x]),
    (x) => loose(client.writeEach.bind(client))([{ item: x, value: 1 }]),
    (x) => loose(client.plan.bind(client))(x),
    (x) => loose(client.planWrite.bind(client))(x),
    (x) => loose(client.explain.bind(client))(x),
    (x) => loose(client.request.bind(client))(x, {}),
    (x) => loose(client.requestByName.bind(client))(x),
    (x) => loose(client.requestByName.bind(client))('readDataMemory', x),
    (x) => loose(client.selfTest.bind(client))(x),
    (x) => loose(client.info.bind(client))(x),
    (x) => loose(client.control.stop)(x),
    (x) => loose(client.control.blockState)(x),
    (x) => loose(client.control.setWriteMode)(x),
    (x) => loose(client.clock.set)(x),
    (x) => loose(client.clock.adjust)(x),
    (x) => loose(client.buffers.specified.read)(x, 0, 1),
    (x) => loose(client.buffers.specified.write)(0, 0, x),
    (x) => loose(client.buffers.ring.read)(0, x),
    (x) => loose(client.buffers.ring.write)(0, x),
    (x) => loose(client.buffers.ring.read)(0, 1, x),
    (x) => loose(client.buffers.specified.define)(0, x),
    (x) => loose(client.parameters.optionUnit)(x),
    (x) => client.parameters.optionUnit({ rack: 0, unit: 0 }).write(x as never),
    (x) => client.parameters.optionUnit({ rack: 0, unit: 0 }).read(x as never, 1),
    (x) => client.parameters.optionUnit({ rack: 0, unit: 0 }).read(0, x as never),
    (x) => loose(client.secret.release)(x),
    (x) => loose(client.secret.register)('a1B2', x),
    (x) => loose(client.on.bind(client))(x, () => {}),
  ]
  const strange: string[] = []
  for (const [at, call] of calls.entries()) {
    for (const [which, value] of values.entries()) {
      const found = await strangeness(() => call(value))
      if (found !== undefined)
        strange.push(`call ${at} with value ${which}: ${String((found as Failure).stack ?? found)}`)
    }
  }
  expect(strange).toEqual([])
  await client.close()
})
