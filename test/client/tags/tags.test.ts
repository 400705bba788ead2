/** Tables of tags on clients of both families and their simulated PLCs, by one list of expectations. */
import { describe, expect, test } from '@jest/globals'
import { createJwSimulator, createPlcSimulator } from '../../../src/entry/simulator'
import {
  createJwClient,
  createMelsecClient,
  defineTags,
  type PlcClient,
  type TagDefinitions,
  tagTable,
  type WriteError,
} from '../../../src/index'
import { free } from '../jw/small-jw'
import { clientOptions, failureOf, kind, until } from '../line'

/** What a test does with a PLC: where its items are, and what is in it. */
interface Bench {
  readonly plc: PlcClient
  readonly at: (name: keyof typeof MELSEC) => string
  /** The three numbers of the array, each alone. */
  readonly elements: readonly string[]
  readonly inPlc: (address: string) => unknown
  readonly set: (address: string, value: number | boolean | string) => void
  readonly requests: () => number
}

const MELSEC = { level: 'D100', pump: 'M10', flow: 'D110:INT', array: 'D120:INT[3]', text: 'D130:STRING(4)' }
const JW = { level: '09012:INT', pump: '04033', flow: '09020:INT', array: '09030:INT[3]', text: '09040:STRING(4)' }

async function onMelsec(run: (bench: Bench) => Promise<void>, allowWrites = true): Promise<void> {
  const simulated = createPlcSimulator({ profile: 'iq-r' })
  await simulated.listen()
  const plc = createMelsecClient(clientOptions(kind('tcp 3E binary iq-r'), simulated, { allowWrites }))
  try {
    await run({
      plc,
      at: (name) => MELSEC[name],
      elements: ['D120:INT', 'D121:INT', 'D122:INT'],
      inPlc: (address) => simulated.read(address),
      set: (address, value) => simulated.write(address, value),
      requests: () => simulated.statistics.requests,
    })
  } finally {
    await plc.close()
    await simulated.close()
  }
}

async function onJw(run: (bench: Bench) => Promise<void>, allowWrites = true): Promise<void> {
  const simulated = createJwSimulator({ writeMode: 2 })
  await simulated.listen()
  const port = simulated.tcp?.port ?? 0
  const plc = createJwClient({ host: '127.0.0.1', port, ...free, allowWrites })
  try {
    await run({
      plc,
      at: (name) => JW[name],
      elements: ['09030:INT', '09032:INT', '09034:INT'],
      inPlc: (address) => simulated.read(address),
      set: (address, value) => simulated.write(address, value),
      requests: () => simulated.statistics.requests,
    })
  } finally {
    await plc.close()
    await simulated.close()
  }
}

const scaling = { kind: 'linear', raw: [0, 4000], engineering: [0, 10] } as const

function plant({ at }: Bench) {
  return defineTags({
    level: {
      address: at('level'),
      scaling,
      access: 'readWrite',
      min: 0,
      max: 9,
      deadband: { kind: 'absolute', value: 1 },
    },
    pump: { address: at('pump'), access: 'readWrite', scanClass: 'fast' },
    flow: { address: at('flow'), scaling: { ...scaling, clamp: true } },
    array: { address: at('array'), scaling, access: 'readWrite' },
    text: at('text'),
  })
}

describe.each([
  ['MELSEC', onMelsec],
  ['Sharp JW', onJw],
] as const)('%s', (_family, on) => {
  test('all tags are read, some, or one, in their units', () =>
    on(async (bench) => {
      bench.set(bench.at('level'), 1234)
      bench.set(bench.at('pump'), true)
      bench.set(bench.at('text'), 'abcd')
      const tags = bench.plc.tags(plant(bench))
      expect(await tags.read()).toEqual({ level: 3.085, pump: true, flow: 0, array: [0, 0, 0], text: 'abcd' })
      expect(await tags.read(['pump', 'level'])).toEqual({ pump: true, level: 3.085 })
      expect(await tags.read('level')).toBe(3.085)
    }))

  test('a value beyond its clamped scaling is the limit, and said to be', () =>
    on(async (bench) => {
      bench.set(bench.at('flow'), 5000)
      const { flow } = await bench.plc.tags(plant(bench)).readEach(['flow'])
      expect(flow).toMatchObject({ ok: true, item: 'flow', value: 10, clamped: true })
    }))

  test('a value that its scaling has none for fails alone', () =>
    on(async (bench) => {
      const table = defineTags({
        flow: { address: bench.at('flow'), scaling: { kind: 'squareRoot', raw: [0, 100], engineering: [0, 10] } },
        pump: bench.at('pump'),
      })
      bench.set(bench.at('flow'), -1)
      const tags = bench.plc.tags(table)
      const { flow, pump } = await tags.readEach()
      expect(pump).toMatchObject({ ok: true, value: false })
      expect(flow).toMatchObject({ ok: false, error: { code: 'BAD_FIELD' } })
      expect((await failureOf(tags.read('flow'))).message).toMatch(/^flow \(.*: -1 in the PLC is beyond 0/)
    }))

  test('values are written scaled backwards', () =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench))
      await tags.write({ level: 3.085, pump: true, array: [1, 2, 3] })
      const { at, elements, inPlc } = bench
      expect([inPlc(at('level')), inPlc(at('pump'))]).toEqual([1234, true])
      expect(elements.map(inPlc)).toEqual([400, 800, 1200])
      await tags.write('array', new Float64Array([0, 10, 5]))
      expect(elements.map(inPlc)).toEqual([0, 4000, 2000])
    }))

  test('when one tag is refused nothing is sent, and each says what became of it', () =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench))
      const before = bench.requests()
      const failure = (await failureOf(tags.write({ pump: true, level: 9.5 }))) as WriteError
      expect(failure).toMatchObject({ code: 'NOT_ALL_WRITTEN', outcome: 'notSent' })
      expect(failure.message).toMatch(/level \(.*\): 9.5 is above its maximum of 9/)
      expect(failure.results).toMatchObject([
        { item: 'pump', ok: false, error: { code: 'ABORTED', outcome: 'notSent' } },
        { item: 'level', ok: false, error: { code: 'OUT_OF_RANGE' } },
      ])
      expect(bench.requests()).toBe(before)
      expect(bench.inPlc(bench.at('pump'))).toBe(false)
    }))

  test('what its type does not take keeps the others from being sent, too', () =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench))
      const failure = await failureOf(tags.write({ level: 1, pump: 'on' }))
      expect(failure).toMatchObject({ code: 'NOT_ALL_WRITTEN', outcome: 'notSent' })
      expect(bench.inPlc(bench.at('level'))).toBe(0)
    }))

  test('asked for each tag, what is not refused is written', () =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench))
      const results = await tags.writeEach({ level: -1, pump: true })
      expect(results).toMatchObject({
        level: { item: 'level', ok: false, error: { code: 'OUT_OF_RANGE' } },
        pump: { item: 'pump', ok: true },
      })
      expect(bench.inPlc(bench.at('pump'))).toBe(true)
    }))

  test('a tag that is only read is not written, whatever the client permits', () =>
    on(async (bench) => {
      const rows = [{ name: 'flow', address: bench.at('flow') }]
      const failure = await failureOf(bench.plc.tags(tagTable(rows)).write('flow', 1))
      expect(failure).toMatchObject({ code: 'NOT_PERMITTED', outcome: 'notSent' })
      expect(bench.inPlc(bench.at('flow'))).toBe(0)
    }))

  test('a client that may not write does not write tags either', () =>
    on(async (bench) => {
      const failure = await failureOf(bench.plc.tags(plant(bench)).write('pump', true))
      expect(failure).toMatchObject({ code: 'NOT_PERMITTED', outcome: 'notSent' })
      expect(bench.inPlc(bench.at('pump'))).toBe(false)
    }, false))

  test('tags are watched in their units, by their deadbands', () =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench))
      const seen: unknown[] = []
      for await (const { values, changed } of tags.watch(['level', 'pump'], { every: 5 })) {
        seen.push([...changed, values.level.value, values.pump.value])
        // 1 is not more than the deadband of 1, so the pump comes alone.
        if (seen.length === 1) bench.set(bench.at('level'), 400)
        if (seen.length === 1) bench.set(bench.at('pump'), true)
        if (seen.length === 2) bench.set(bench.at('level'), 404)
        if (seen.length === 3) break
      }
      expect(seen).toEqual([
        ['level', 'pump', 0, false],
        ['pump', 1, true],
        ['level', 1.01, true],
      ])
    }))

  test('a watched value that is clamped is uncertain, and one without a value is bad', () =>
    on(async (bench) => {
      const table = defineTags({
        flow: { address: bench.at('flow'), scaling: { ...scaling, clamp: true } },
        root: { address: bench.at('level'), scaling: { ...scaling, kind: 'squareRoot' } },
      })
      bench.set(bench.at('flow'), 5000)
      bench.set(bench.at('level'), -4000)
      await using watch = bench.plc.tags(table).watch({ every: 5, onChange: () => {} })
      await until(() => watch.values.flow.quality !== 'bad')
      expect(watch.values.flow).toMatchObject({
        quality: 'uncertain',
        value: 10,
        reason: expect.stringMatching(/limit/),
      })
      expect(watch.values.root).toMatchObject({ quality: 'bad', error: { code: 'BAD_FIELD' } })
      bench.set(bench.at('level'), 1000)
      await until(() => watch.values.root.quality === 'good')
      expect(watch.values.root.value).toBe(5)
    }))

  test('a scan class says which tags are watched and how often', () =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench), { scanClasses: { fast: 5 } })
      await using watch = tags.watch({ scanClass: 'fast', tell: 'scans' })
      const { value } = await watch.next()
      expect(Object.keys(value?.values ?? {})).toEqual(['pump'])
    }))

  test.each([
    [{ scanClass: 'slow' }, /Nothing says how fast 'slow' is/],
    [{ scanClass: 'slow', every: 100 }, /No tag has the scan class 'slow'/],
    [{}, /every is missing/],
    [{ every: 5, deadband: { kind: 'absolute', value: 1 } }, /A tag has its deadband in the table/],
    [{ every: 5, evry: 5 }, /evry/],
  ])('watching with %j is refused', (options, message) =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench))
      expect(() => tags.watch(options as never)).toThrow(message)
    }),
  )

  test('what is no option is refused, and nothing is written', () =>
    on(async (bench) => {
      const tags = bench.plc.tags(plant(bench))
      expect(() => tags.watch(['pump'], undefined as never)).toThrow(/Options of a watch are an object/)
      expect(() => bench.plc.tags(plant(bench), { scanClasses: 5 as never })).toThrow(/scanClasses are ms/)
      for (const options of [5, { timeuot: 5 }, { allOrNothing: 'no' }]) {
        const failure = await failureOf(tags.write({ pump: true }, options as never))
        expect(failure).toMatchObject({ outcome: 'notSent' })
      }
      expect(bench.inPlc(bench.at('pump'))).toBe(false)
    }))

  test('a name that the table does not have is refused, with the one that may be meant', () =>
    on(async (bench) => {
      const tags = bench.plc.tags<TagDefinitions>(plant(bench))
      const message = /There is no tag 'Level'. It has 'level'/
      expect((await failureOf(tags.read('Level'))).message).toMatch(message)
      expect((await failureOf(tags.write({ Level: 1 }))).message).toMatch(message)
      expect(() => tags.watch(['Level'], { every: 5 })).toThrow(message)
    }))

  test('a table with addresses that the PLC does not have is refused, each row with its reason', () =>
    on(async (bench) => {
      const table = defineTags({ good: bench.at('pump'), bad: 'QQ1', odd: { address: bench.at('pump'), max: 1 } })
      expect(() => bench.plc.tags(table)).toThrow(/Row 2 \(bad\): .*\nRow 3 \(odd\): BOOL is no number/)
    }))
})

test.each([
  [{ level: 'D100' }, /takes a table that defineTags\(\) or tagTable\(\) has made/],
  [undefined, /takes a table/],
  [{ tags: [] }, /takes a table/],
])('%j is no table', async (given, message) => {
  const plc = createMelsecClient({ host: '127.0.0.1', port: 1, profile: 'iq-r' })
  expect(() => plc.tags(given as never)).toThrow(message)
  await plc.close()
})

test('names that are whole numbers are refused where their order would be lost', async () => {
  const plc = createMelsecClient({ host: '127.0.0.1', port: 1, profile: 'iq-r', allowWrites: true })
  const tags = plc.tags(
    tagTable([
      { name: '1', address: 'D1', access: 'readWrite' },
      { name: 'a', address: 'D2', access: 'readWrite' },
    ]),
  )
  expect(await failureOf(tags.write({ a: 1, '1': 2 }))).toMatchObject({ code: 'BAD_OPTION' })
  await plc.close()
})
