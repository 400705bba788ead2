/** What programs without types pass, to every public method: a typed error, never a crash, never an unhandled rejection. */
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, type MelsecClient, PlcError } from '../../src/index'
import { clientOptions, kind } from './line'

let plc: PlcSimulator
let client: MelsecClient

beforeAll(async () => {
  plc = createPlcSimulator({ profile: 'iq-r', resetAllowed: false })
  await plc.listen()
  client = createMelsecClient(clientOptions(kind('tcp 4E binary iq-r'), plc))
})

afterAll(async () => {
  await client.close()
  await plc.close()
  // What is rejected and not handled fails the tests by itself.
  await new Promise<void>((resolve) => setImmediate(resolve))
})

const HUGE = 'D'.repeat(1_000_000)

/** Names for the titles of the tests. */
const values: readonly (readonly [title: string, value: unknown])[] = [
  ['undefined', undefined],
  ['null', null],
  ['NaN', Number.NaN],
  ['-1', -1],
  ['Infinity', Number.POSITIVE_INFINITY],
  ['true', true],
  ['5n', 5n],
  ['empty text', ''],
  ['blank text', ' \n'],
  ['huge text', HUGE],
  ['a huge number of digits', `D${'9'.repeat(5000)}`],
  ['text that is a prototype name', '__proto__'],
  ['{}', {}],
  ['[]', []],
  ['a hole', new Array(1)],
  ['[undefined]', [undefined]],
  ['[null]', [null]],
  ['[[]]', [[]]],
  ['[NaN]', [Number.NaN]],
  ['[{}]', [{}]],
  ['[huge]', [HUGE, 'D0']],
  ['{ address: undefined }', { address: undefined }],
  ['{ address: 5 }', { address: 5 }],
  ['{ address: D0, count: NaN }', { address: 'D0', count: Number.NaN }],
  ['{ address: D0, type: 5 }', { address: 'D0', type: 5 }],
  ['{ address: D0, type: null }', { address: 'D0', type: null }],
  ['{ address: D0, wordOrder: 5 }', { address: 'D0', wordOrder: 5 }],
  ['{ address: D0, encoding: x }', { address: 'D0:STRING(2)', encoding: 'x' }],
  ['{ address: D0, trimSpaces: 5 }', { address: 'D0:STRING(2)', trimSpaces: 5 }],
  ['{ a: null }', { a: null }],
  ['{ D0: undefined }', { D0: undefined }],
  ['{ D0: {} }', { D0: {} }],
  ['{ item: D0 }', [{ item: 'D0' }]],
  ['{ item: null }', [{ item: null, value: 1 }]],
  ['{ timeout: NaN }', { timeout: Number.NaN }],
  ['{ timeout: text }', { timeout: '100' }],
  ['{ timeout: 0 }', { timeout: 0 }],
  ['{ timeout: 1e300 }', { timeout: 1e300 }],
  ['{ signal: {} }', { signal: {} }],
  ['{ force: yes }', { force: 'yes' }],
  ['{ clear: all of it }', { clear: 'all of it' }],
  ['{ value: 7 }', { value: 7 }],
  ['{ allOrNothing: yes }', { allOrNothing: 'yes' }],
  ['a function', () => {}],
  ['a symbol', Symbol('x')],
  ['a Map', new Map([['D0', 1]])],
  ['a Date', new Date(0)],
  ['an object without prototype', Object.assign(Object.create(null), { a: 'D0' })],
  ['Object.prototype', Object.prototype],
  ['new Proxy', new Proxy({}, {})],
]

type Loose = (...given: unknown[]) => unknown
const loose = (method: unknown): Loose => method as Loose

/** The method with the value in each of its places. */
const methods: Readonly<Record<string, (value: unknown) => unknown>> = {
  'connect(x)': (x) => loose(client.connect).call(client, x),
  'read(x)': (x) => loose(client.read).call(client, x),
  'read(D0, x)': (x) => loose(client.read).call(client, 'D0', x),
  'read([D0], x)': (x) => loose(client.read).call(client, ['D0'], x),
  'read([x, D0])': (x) => loose(client.read).call(client, [x, 'D0']),
  'read({ a: x })': (x) => loose(client.read).call(client, { a: x }),
  'readValues(x)': (x) => loose(client.readValues).call(client, x),
  'readValues([D0], x)': (x) => loose(client.readValues).call(client, ['D0'], x),
  'plan(x)': (x) => loose(client.plan).call(client, x),
  'plan([D0]).run(x)': (x) => loose(client.plan(['D0']).run)(x),
  'explain(x)': (x) => loose(client.explain).call(client, x),
  'write(x, 1)': (x) => loose(client.write).call(client, x, 1),
  'write(D0, x)': (x) => loose(client.write).call(client, 'D0', x),
  'write(D0:REAL, x)': (x) => loose(client.write).call(client, 'D0:REAL', x),
  'write(D0:STRING(4), x)': (x) => loose(client.write).call(client, 'D0:STRING(4)', x),
  'write(D0:LINT, x)': (x) => loose(client.write).call(client, 'D0:LINT', x),
  'write(D0[3], x)': (x) => loose(client.write).call(client, 'D0[3]', x),
  'write(M0, x)': (x) => loose(client.write).call(client, 'M0', x),
  'write(M0[2], x)': (x) => loose(client.write).call(client, 'M0[2]', x),
  'write(K4M0, x)': (x) => loose(client.write).call(client, 'K4M0', x),
  'write(D0, 1, x)': (x) => loose(client.write).call(client, 'D0', 1, x),
  'write({ D0: 1 }, x)': (x) => loose(client.write).call(client, { D0: 1 }, x),
  'write([x])': (x) => loose(client.write).call(client, [x]),
  'write([{ item: x, value: 1 }])': (x) => loose(client.write).call(client, [{ item: x, value: 1 }]),
  'writeValues(x)': (x) => loose(client.writeValues).call(client, x),
  'writeValues({ D0: x })': (x) => loose(client.writeValues).call(client, { D0: x }),
  'writeEach(x)': (x) => loose(client.writeEach).call(client, x),
  'writeEach([x])': (x) => loose(client.writeEach).call(client, [x]),
  'writeEach({ D0: 1 }, x)': (x) => loose(client.writeEach).call(client, { D0: 1 }, x),
  'readEach(x)': (x) => loose(client.readEach).call(client, x),
  'readEach([D0], x)': (x) => loose(client.readEach).call(client, ['D0'], x),
  'planWrite(x)': (x) => loose(client.planWrite).call(client, x),
  'planWrite([], x)': (x) => loose(client.planWrite).call(client, [], x),
  'planWrite([D0]).run(x)': (x) => loose(client.planWrite([{ item: 'D0', value: 1 }]).run)(x),
  'planWrite([D0]).runEach(x)': (x) => loose(client.planWrite([{ item: 'D0', value: 1 }]).runEach)(x),
  'monitor(x)': (x) => loose(client.monitor).call(client, x),
  'monitor([x]).read()': (x) => (loose(client.monitor).call(client, [x]) as { read: Loose }).read(),
  'monitor([D0]).read(x)': (x) => loose(client.monitor(['D0']).read).call(client.monitor(['D0']), x),
  'request(x)': (x) => loose(client.request).call(client, x, {}),
  'request(readWords, x)': (x) => loose(client.request).call(client, commands.readWords, x),
  'request(readWords, { head: x })': (x) =>
    loose(client.request).call(client, commands.readWords, { head: x, points: 1 }),
  'request(readWords, { points: x })': (x) =>
    loose(client.request).call(client, commands.readWords, { head: { device: 'D', number: 0 }, points: x }),
  'request(writeWords, { values: x })': (x) =>
    loose(client.request).call(client, commands.writeWords, { head: { device: 'D', number: 0 }, values: x }),
  'request(readRandom, { words: x })': (x) =>
    loose(client.request).call(client, commands.readRandom, { words: x, doubleWords: [] }),
  'request(executeMonitor, {}, { context: x })': (x) =>
    loose(client.request).call(client, commands.executeMonitor, {}, { context: x }),
  'request(readTypeName, {}, x)': (x) => loose(client.request).call(client, commands.readTypeName, {}, x),
  'request(readWords, m, { form: x })': (x) =>
    loose(client.request).call(
      client,
      commands.readWords,
      { head: { device: 'D', number: 0 }, points: 1 },
      { form: x },
    ),
  'control.run(x)': (x) => loose(client.control.run)(x),
  'control.stop(x)': (x) => loose(client.control.stop)(x),
  'control.pause(x)': (x) => loose(client.control.pause)(x),
  'control.latchClear(x)': (x) => loose(client.control.latchClear)(x),
  'control.reset(x)': (x) => loose(client.control.reset)(x),
  'identify(x)': (x) => loose(client.identify).call(client, x),
  'selfTest(x)': (x) => loose(client.selfTest).call(client, x),
  'selfTest(ABC, x)': (x) => loose(client.selfTest).call(client, 'ABC', x),
  'clearError(x)': (x) => loose(client.clearError).call(client, x),
  'on(x, f)': (x) => loose(client.on).call(client, x, () => {}),
  'on(state, x)': (x) => loose(client.on).call(client, 'state', x),
  'createMelsecClient(x)': (x) => loose(createMelsecClient)(x),
  'new with option host': (x) => loose(createMelsecClient)({ host: x, port: 1 }),
}

for (const name of [
  'port',
  'transport',
  'localAddress',
  'localPort',
  'profile',
  'profileOverrides',
  'frame',
  'code',
  'asciiXy',
  'asciiZr',
  'xyRadix',
  'wRadix',
  'route',
  'monitoringTimer',
  'timeout',
  'connectTimeout',
  'inFlight',
  'queueLimit',
  'allowWrites',
  'allowControl',
  'gap',
  'format',
  'reconnect',
  'settleGap',
  'openTransport',
  'random',
]) {
  Object.assign(methods, {
    [`new with option ${name}`]: (x: unknown) => loose(createMelsecClient)({ host: '127.0.0.1', port: 1, [name]: x }),
  })
}

/** What a call came to. Errors in results are looked at too. */
async function outcomeOf(run: () => unknown): Promise<unknown> {
  try {
    return await run()
  } catch (error) {
    return { thrown: error }
  }
}

function errorsIn(outcome: unknown): unknown[] {
  if (typeof outcome !== 'object' || outcome === null) return []
  if ('thrown' in outcome) return [outcome.thrown]
  if ('error' in outcome && 'ok' in outcome) return [outcome.error]
  return Array.isArray(outcome) || Object.getPrototypeOf(outcome) === Object.prototype
    ? Object.values(outcome).flatMap(errorsIn)
    : []
}

describe.each(Object.keys(methods))('%s', (name) => {
  test('gives a typed error or a result', async () => {
    const strange: string[] = []
    for (const [title, value] of values) {
      const outcome = await outcomeOf(() => methods[name]?.(value))
      for (const error of errorsIn(outcome)) {
        if (!(error instanceof PlcError)) strange.push(`${title}: ${String(error)}`)
        // Texts of options are short, and some are shown whole.
        else if (error.message.length > 5000 && !name.startsWith('new'))
          strange.push(`${title}: ${error.message.length} characters`)
      }
    }
    expect(strange).toEqual([])
  })
})

test('what is no list and no item is never taken for an empty one', async () => {
  for (const nothing of [undefined, null, 5, true, 5n, new Map(), new Date(0), () => {}, Symbol('x')]) {
    expect(await outcomeOf(() => loose(client.read).call(client, nothing))).toHaveProperty('thrown')
    expect(await outcomeOf(() => loose(client.readValues).call(client, nothing))).toHaveProperty('thrown')
    expect(await outcomeOf(() => loose(client.write).call(client, nothing, 1))).toHaveProperty('thrown')
    expect(await outcomeOf(() => loose(client.plan).call(client, nothing))).toHaveProperty('thrown')
    expect(await outcomeOf(() => loose(client.monitor).call(client, nothing))).toHaveProperty('thrown')
  }
  expect(await client.read([])).toEqual([])
  expect(await client.read({})).toEqual({})
  expect(await client.writeEach({})).toEqual({})
  expect(await client.writeEach([])).toEqual([])
  await client.write({})
  expect(await client.readValues([])).toEqual([])
  expect(await client.monitor([]).read()).toEqual([])
})

test('an object with an address that is no text is an item, and a wrong one', async () => {
  const wrong = { code: 'BAD_ADDRESS', outcome: 'notSent', field: 'address' }
  for (const address of [5, true, null, undefined, 5n, Symbol('x'), () => {}]) {
    expect(await outcomeOf(() => loose(client.read).call(client, { address, type: 'INT' }))).toMatchObject({
      thrown: wrong,
    })
    expect(await client.read(['D0', { address } as unknown as string])).toMatchObject([
      { ok: true },
      { ok: false, error: wrong },
    ])
  }
  // A name like any other, as long as it names an item.
  expect(await client.read({ address: { address: 'D0' }, other: 'D1' })).toMatchObject({
    address: { ok: true },
    other: { ok: true },
  })
})

test('an option of a call that is none is not taken for the usual one', async () => {
  const { requests } = plc.statistics
  for (const options of [
    { timeout: '100' },
    { timeout: Number.NaN },
    { timeout: 0 },
    { signal: {} },
    null,
    5,
    'fast',
  ]) {
    const given = options as unknown as undefined
    for (const run of [
      () => client.connect(given),
      () => client.read('D0', given),
      () => client.read(['D0'], given),
      () => client.write('D0', 1, given),
      () => client.monitor(['D0']).read(given),
      () => client.identify(given),
      () => client.selfTest('AB', given),
      () => client.control.stop(given),
      () => client.control.run(given),
      () => client.request(commands.readTypeName, {}, given),
    ]) {
      expect(await outcomeOf(run)).toMatchObject({ thrown: { code: 'BAD_OPTION', outcome: 'notSent' } })
    }
  }
  expect(plc.statistics.requests).toBe(requests)
})

test('after all of it the client reads and writes', async () => {
  await client.write('D100', 5)
  expect(await client.read('D100')).toBe(5)
  expect(client.state.name).toBe('connected')
})
