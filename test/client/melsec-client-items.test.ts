/** Special devices, refused items among others, and requests at the limits, through sockets. */
import { describe, expect, test } from '@jest/globals'
import { EndCodeError, type Item, RequestError, type WriteResult } from '../../src/index'
import { brief, failureOf, type Line, withLine } from './line'

const briefWrite = (result: WriteResult) => (result.ok ? 'written' : result.error.code)

describe.each(['tcp 3E binary iq-f', 'udp 3E ascii iq-f'])('X and Y of %s', (text) => {
  test('are octal: Y10 is the ninth output', () =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.write('Y10', true)
      expect([plc.memory.bit('Y', 8), plc.memory.bit('Y', 16)]).toEqual([true, false])
      plc.memory.setBit('X', 8, true)
      expect(await client.read('X0[16]')).toEqual(Array.from({ length: 16 }, (_, i) => i === 8))
      expect(await client.read('X0..X17')).toHaveLength(16)
    }))

  test.each(['X8', 'Y9', 'X18', 'XA', 'K4X8'])('%s does not exist, and nothing is sent', (item) =>
    withLine(text, {}, async ({ plc, client }) => {
      const error = await failureOf(client.read(item))
      expect([error.code, error.outcome]).toEqual(['BAD_ADDRESS', 'notSent'])
      expect((await failureOf(client.write(item, true))).code).toBe('BAD_ADDRESS')
      expect(plc.statistics.requests).toBe(0)
    }),
  )

  test('are hexadecimal with xyRadix 16, as a project may show them', () =>
    withLine(text, { client: { xyRadix: 16 } }, async ({ plc, client }) => {
      await client.write('Y1F', true)
      expect(plc.memory.bit('Y', 31)).toBe(true)
      plc.memory.setBit('X', 16, true)
      expect(await client.read('X10')).toBe(true)
      expect(client.explain('X10[16]')).toMatchObject({ first: 'X10', last: 'X1F', radix: 16 })
    }))
})

describe.each([{ wRadix: 10 }, { profileOverrides: { wRadix: 10 } }] as const)('W with %j', (client) => {
  test('is decimal wherever an address is written or shown', () =>
    withLine('tcp 3E binary generic', { client }, async ({ plc, client: given }) => {
      await given.write('W902', 7)
      expect([plc.memory.word('W', 902), plc.memory.word('W', 0x902)]).toEqual([7, 0])
      expect(await given.read('W902')).toBe(7)
      expect(given.explain('W902[10]')).toMatchObject({ first: 'W902', last: 'W911', radix: 10 })
      expect(given.plan(['W902']).toString()).toContain('W902')
      expect(given.planWrite([{ item: 'W902', value: 1 }]).toString()).toContain('W902')
      expect(await given.requestByName('readWords', { head: 'W902', points: 1 })).toEqual({ values: [7] })
      expect(given.notation).toMatchObject({ wRadix: 10 })
      const monitor = given.monitor(['W902'])
      expect((await monitor.read()).map(brief)).toEqual([7])
      const texts: string[] = []
      given.on('trace', ({ text }) => texts.push(text))
      await given.read('W902')
      expect(texts[0]).toContain('W902')
    }))

  test('a hexadecimal number is refused, and nothing is sent', () =>
    withLine('tcp 3E binary generic', { client }, async ({ plc, client: given }) => {
      const error = await failureOf(given.read('W1F'))
      expect([error.code, error.outcome]).toEqual(['BAD_ADDRESS', 'notSent'])
      expect(error.message).toContain('wRadix')
      expect(plc.statistics.requests).toBe(0)
    }))
})

describe('X and Y of a PLC nobody knows', () => {
  test.each(['X8', 'X10', 'Y1F', 'X0..X17', 'K4Y10', 'X17[2]'])('%s may be two things, and is refused', (item) =>
    withLine('tcp 3E binary generic', {}, async ({ plc, client }) => {
      const error = await failureOf(client.read(item))
      expect([error.code, error.outcome]).toEqual(['BAD_ADDRESS', 'notSent'])
      expect(error.message).toContain('xyRadix')
      expect((await failureOf(client.write(item, true))).message).toBe(error.message)
      expect(() => client.explain(item)).toThrow(RequestError)
      expect(plc.statistics.requests).toBe(0)
    }),
  )

  test.each<[Item, unknown]>([
    ['X7', true],
    ['X0..X7', [true, true, true, true, true, true, true, true]],
    ['X0[10]', [true, true, true, true, true, true, true, true, true, true]],
    ['K4X0', -1],
    [{ address: 'X5', count: 2 }, [true, true]],
  ])('%j is the same in both notations', (item, value) =>
    withLine('tcp 3E binary generic', {}, async ({ plc, client }) => {
      for (let i = 0; i < 16; i++) plc.memory.setBit('X', i, true)
      expect(await client.read(item)).toEqual(value)
    }),
  )

  test.each([
    [8, 15],
    [16, 23],
  ] as const)('X17 is clear with xyRadix %i', (xyRadix, number) =>
    withLine('tcp 3E binary generic', { client: { xyRadix } }, async ({ plc, client }) => {
      plc.memory.setBit('X', number, true)
      expect(await client.read('X17')).toBe(true)
    }),
  )
})

describe('digits in ASCII code', () => {
  test('X and Y of an iQ-F are refused until asciiXy says how the port is set', () =>
    withLine('tcp 3E ascii iq-f', { client: { asciiXy: undefined } as object }, async ({ plc, client }) => {
      const results = await client.read(['X0', 'D0', 'Y17'])
      expect(results.map(brief)).toEqual(['BAD_OPTION', 0, 'BAD_OPTION'])
      expect((await failureOf(client.write('Y0', true))).message).toContain('asciiXy')
      expect(plc.statistics.refusals).toBe(0)
    }))

  test.each(['octal', 'hexadecimal'] as const)('a port with %s digits gets them so', (asciiXy) =>
    withLine('tcp 3E ascii iq-f', { plc: { asciiXy }, client: { asciiXy } }, async ({ plc, client }) => {
      await client.write('Y17', true)
      expect(plc.memory.bit('Y', 15)).toBe(true)
      expect(await client.read('Y17')).toBe(true)
    }),
  )

  test('ZR is refused until asciiZr says how the port reads it', () =>
    withLine('tcp 4E ascii iq-r', { client: { asciiZr: undefined } as object }, async ({ client }) => {
      const error = await failureOf(client.read('ZR10'))
      expect([error.code, error.outcome]).toEqual(['BAD_OPTION', 'notSent'])
      expect(error.message).toContain('asciiZr')
    }))

  test.each(['decimal', 'hexadecimal'] as const)('a port with %s digits of ZR gets them so', (asciiZr) =>
    withLine('tcp 4E ascii iq-r', { plc: { asciiZr }, client: { asciiZr } }, async ({ plc, client }) => {
      await client.write('ZR40000', 5)
      expect(plc.memory.word('ZR', 40000)).toBe(5)
      expect(await client.read('ZR40000')).toBe(5)
    }),
  )
})

describe.each(['tcp 4E binary iq-r', 'udp 3E ascii iq-r'])('%s', (text) => {
  test('contacts and coils of long timers come with their current value', () =>
    withLine(text, {}, async ({ plc, client }) => {
      plc.write('LTN3', 70_000)
      plc.memory.setBit('LTS', 3, true)
      plc.memory.setBit('LTC', 4, true)
      plc.memory.setBit('LSTS', 2, true)
      plc.write('LCN7:UDINT', 0xffffffff)
      plc.memory.setBit('LCC', 7, true)
      const values = await client.readValues([
        'LTN3',
        'LTS3',
        'LTC3',
        'LTS4',
        'LTC4',
        'LTS0[5]',
        'LSTS2',
        'LSTC2',
        'LCN7:UDINT',
        'LCC7',
        'LCS7',
        'LTN2..LTN4',
      ])
      expect(values).toEqual([
        70_000,
        true,
        false,
        false,
        true,
        [false, false, false, true, false],
        true,
        false,
        0xffffffff,
        true,
        false,
        [0, 70_000, 0],
      ])
    }))

  test('memory behind J, U and the CPUs', () =>
    withLine(
      text,
      {
        plc: {
          extensions: {
            modules: [{ unit: 3, points: 256 }],
            networks: [{ network: 1, points: { W: 64, B: 64, X: 32 } }],
            cpus: [{ cpu: 1, points: { G: 64, HG: 64 } }],
          },
        },
      },
      async ({ plc, client }) => {
        const entries = [
          { item: 'U3\\G100:REAL', value: 1.5 },
          { item: 'u3/g102[2]', value: [7, 8] },
          { item: 'J1\\W10', value: 9 },
          { item: 'J1\\B1F', value: true },
          { item: 'U3E0\\G5:DINT', value: -70_000 },
          { item: 'U3E0\\HG6', value: 6 },
        ]
        const results = await client.writeEach(entries)
        expect(results.map(briefWrite)).toEqual(entries.map(() => 'written'))
        expect(plc.read('U3\\G100:REAL')).toBe(1.5)
        expect([plc.read('U3\\G102'), plc.read('U3\\G103')]).toEqual([7, 8])
        expect(plc.read('J1\\W10')).toBe(9)
        expect(plc.read('J1\\B1F')).toBe(true)
        expect(plc.read('U3E0\\G5:DINT')).toBe(-70_000)
        expect(plc.read('U3E0\\HG6')).toBe(6)
        plc.write('J1\\X1F', true)
        const read = await client.read([...entries.map(({ item }) => item), 'J1\\X1F', 'D0', 'U4\\G0', 'J2\\W0'])
        expect(read.map(brief)).toEqual([...entries.map(({ value }) => value), true, 0, 'END_CODE', 'END_CODE'])
      },
    ))

  test('index registers are added by the PLC', () =>
    withLine(text, {}, async ({ plc, client }) => {
      plc.memory.setWord('Z', 2, 5)
      plc.memory.setWord('D', 105, 42)
      expect(await client.readValues(['D100Z2', 'D105', 'D0'])).toEqual([42, 42, 0])
      await client.write('D200Z2', 43)
      expect(plc.memory.word('D', 205)).toBe(43)
    }))
})

describe.each(['tcp 4E binary iq-r', 'tcp 3E ascii iq-f', 'udp 3E binary q', 'udp 4E binary iq-r'])(
  'one bad item among many on %s',
  (text) => {
    const outOfRange = (line: Line) => (line.profile === 'iq-f' ? 0xc056 : 0x4031)

    test('does not take the others down when they are read', () =>
      withLine(text, {}, async (line) => {
        const { plc, client } = line
        const items = Array.from({ length: 60 }, (_, i) => `D${i * 40}`)
        items.forEach((_, i) => {
          plc.memory.setWord('D', i * 40, 1000 + i)
        })
        const bad = ['D99999', 'D100:REAAL', 'Q1', 'T5', 'M999999']
        const results = await client.read([...items.slice(0, 30), ...bad, ...items.slice(30)])
        expect(results.slice(0, 30).map(brief)).toEqual(items.slice(0, 30).map((_, i) => 1000 + i))
        expect(results.slice(35).map(brief)).toEqual(items.slice(30).map((_, i) => 1030 + i))
        expect(results.slice(30, 35).map(brief)).toEqual([
          'END_CODE',
          'BAD_TYPE',
          'BAD_ADDRESS',
          'BAD_ADDRESS',
          'END_CODE',
        ])
        const [refused] = results.slice(30)
        expect(refused?.item).toBe('D99999')
        expect(refused?.ok === false && refused.error instanceof EndCodeError && refused.error.endCode).toBe(
          outOfRange(line),
        )
        expect((await failureOf(client.readValues(['D0', 'D99999']))).code).toBe('END_CODE')
        expect((await failureOf(client.read('D99999'))).outcome).toBe('refused')
      }))

    test('does not take the others down when they are written', () =>
      withLine(text, {}, async (line) => {
        const { plc, client } = line
        const results = await client.writeEach({
          D0: 1,
          D1: 40_000,
          'D2:REAL': 1.5,
          D99999: 3,
          'D10:STRING(2)': 'abc',
          Q1: 5,
          M3: true,
          'D20[2]': [1],
        })
        expect(Object.keys(results)).toEqual(['D0', 'D1', 'D2:REAL', 'D99999', 'D10:STRING(2)', 'Q1', 'M3', 'D20[2]'])
        expect(Object.values(results).map(briefWrite)).toEqual([
          'written',
          'BAD_VALUE',
          'written',
          'END_CODE',
          'BAD_VALUE',
          'BAD_ADDRESS',
          'written',
          'BAD_VALUE',
        ])
        expect(Object.values(results).map((result) => result.item)).toEqual(Object.keys(results))
        expect([plc.read('D0'), plc.read('D2:REAL'), plc.read('M3')]).toEqual([1, 1.5, true])
        expect([plc.read('D1'), plc.read('D10'), plc.read('D20'), plc.read('D21')]).toEqual([0, 0, 0, 0])
      }))

    test('takes them down with allOrNothing: nothing is sent', () =>
      withLine(text, {}, async ({ plc, client }) => {
        const { requests } = plc.statistics
        const results = await client.writeEach({ D0: 1, D1: 40_000, D2: 2 }, { allOrNothing: true })
        expect(Object.values(results).map(briefWrite)).toEqual(['ABORTED', 'BAD_VALUE', 'ABORTED'])
        expect(plc.statistics.requests).toBe(requests)
        expect(plc.read('D0')).toBe(0)
      }))
  },
)

describe.each([
  'tcp 4E binary iq-r',
  'tcp 3E ascii iq-f',
  'udp 3E ascii q',
  'udp 4E binary l',
  'tcp 3E binary generic',
])('at the limits of %s', (text) => {
  test.each([479, 480, 481, 959, 960, 961, 1920, 1921, 3000])(
    'an array of %i words is whole and says when it is torn',
    (count) =>
      withLine(text, {}, async ({ plc, client }) => {
        for (let i = 0; i < count; i++) plc.memory.setWord('D', 1000 + i, i + 1)
        const [result] = await client.read([`D1000[${count}]`])
        expect(result).toMatchObject({ ok: true, value: Array.from({ length: count }, (_, i) => i + 1) })
        const { requests } = client.plan([`D1000[${count}]`]).describe()
        expect(result?.ok === true && result.torn === true).toBe(requests.length > 1)
        expect(client.explain(`D1000[${count}]`).requests).toBe(requests.length)
      }),
  )

  test.each([1791, 1792, 1793, 3583, 3584, 3585, 4000])('an array of %i bits is whole, in both directions', (count) =>
    withLine(text, {}, async ({ plc, client }) => {
      const value = Array.from({ length: count }, (_, i) => i % 3 === 0)
      await client.write(`M3[${count}]`, value)
      expect(value.map((_, i) => plc.memory.bit('M', 3 + i))).toEqual(value)
      expect([plc.memory.bit('M', 2), plc.memory.bit('M', 3 + count)]).toEqual([false, false])
      expect(await client.read(`M3[${count}]`)).toEqual(value)
    }),
  )

  test('2000 DINT are written and none is cut in two', () =>
    withLine(text, {}, async ({ plc, client }) => {
      const value = Array.from({ length: 2000 }, (_, i) => (i - 1000) * 65_537)
      await client.write('D1:DINT[2000]', value)
      const at = (i: number) => plc.memory.word('D', 1 + 2 * i) | (plc.memory.word('D', 2 + 2 * i) << 16) | 0
      expect(value.map((_, i) => at(i))).toEqual(value)
      const { requests } = client.planWrite([{ item: 'D1:DINT[2000]', value }]).describe()
      expect(requests.map(({ points }) => points % 2)).toEqual(requests.map(() => 0))
    }))

  test('500 scattered items, far more than a random read takes, come in order', () =>
    withLine(text, { client: { gap: 0 } }, async ({ plc, client }) => {
      const numbers = Array.from({ length: 500 }, (_, i) => (i * 7919) % 7001)
      for (const number of numbers) plc.memory.setWord('D', number, number)
      const { requests } = plc.statistics
      expect((await client.read(numbers.map((number) => `D${number}`))).map(brief)).toEqual(numbers)
      expect(plc.statistics.requests - requests).toBeLessThan(20)
      expect(plc.statistics.refusals).toBe(0)
    }))

  test('a text that is longer than one request is refused, not cut', () =>
    withLine(text, {}, async ({ client }) => {
      const error = await failureOf(client.read('D0:STRING(2000)'))
      expect([error.code, error.outcome]).toEqual(['LIMIT_EXCEEDED', 'notSent'])
      expect((await failureOf(client.write('D0:STRING(2000)', 'a'))).code).toBe('LIMIT_EXCEEDED')
    }))
})
