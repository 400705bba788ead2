/** Failure modes of requests and data: end codes of every command, merged requests, addresses that mean another device. */
import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import {
  type CommandName,
  EndCodeError,
  type MelsecClient,
  type PlcError,
  type ReadValue,
  type RequestOf,
} from '../../src/index'
import { ample, brief, failureOf, links, nextState, withLine } from './line'

const head = { device: 'D', number: 0 } as const
const bit = { device: 'M', number: 0 } as const

/** A request of each command. */
const messages: { readonly [N in CommandName]?: RequestOf<(typeof commands)[N]> } = {
  readBits: { head: bit, points: 1 },
  readWords: { head, points: 1 },
  writeBits: { head: bit, values: [true] },
  writeWords: { head, values: [1] },
  readRandom: { words: [{ device: head }], doubleWords: [] },
  writeRandomBits: { bits: [{ device: bit, value: true }] },
  writeRandomWords: { words: [{ device: head, value: 1 }], doubleWords: [] },
  readBlock: { wordBlocks: [{ head, points: 1 }], bitBlocks: [] },
  writeBlock: { wordBlocks: [{ head, values: [1] }], bitBlocks: [] },
  entryMonitorDevice: { words: [{ device: head }], doubleWords: [] },
  executeMonitor: {},
  readTypeName: {},
  remoteRun: { mode: 1 },
  remoteStop: {},
  remotePause: { mode: 1 },
  remoteLatchClear: {},
  remoteReset: {},
  selfTest: { data: 'ABC' },
  clearError: {},
}
const names = Object.keys(messages) as CommandName[]

function ask(client: MelsecClient, name: CommandName): Promise<unknown> {
  const options = { context: { words: [{ device: head }], doubleWords: [] } }
  // The message belongs to the command: they have one name.
  return client.request(commands[name], messages[name] as RequestOf<typeof commands.readWords>, options)
}

describe.each(links)('6: every command over %s', (text) => {
  test('gives the end code it is refused with, and the connection lives', () =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.connect()
      for (const name of names) {
        for (const [endCode, bytes] of [
          [0xc059, undefined],
          [0x4031, 0],
          [0x7abc, 3],
        ] as const) {
          plc.faults.add({ kind: 'endCode', endCode, times: 1 })
          if (bytes !== undefined) plc.faults.add({ kind: 'shortError', bytes, times: 1 })
          const error = await failureOf(ask(client, name))
          expect(error).toBeInstanceOf(EndCodeError)
          const { title, effect } = commands[name]
          // Of a code nobody knows nobody knows either whether what changes the PLC was carried out.
          const outcome = endCode === 0x7abc && effect !== 'read' && effect !== 'diagnose' ? 'unknown' : 'refused'
          expect([name, error]).toEqual([
            name,
            expect.objectContaining({ endCode, outcome, command: title, commandName: name }),
          ])
        }
      }
      expect(client.statistics).toMatchObject({ connects: 1, timeouts: 0, protocolErrors: 0 })
      expect([plc.read('D0'), plc.read('M0'), plc.cpu.state]).toEqual([0, false, 'RUN'])
    }))

  test('is answered when it is not refused', () =>
    withLine(
      text,
      { plc: { resetAllowed: true, restartTime: 5 }, client: { timeout: 1000 } },
      async ({ plc, client }) => {
        // In the order of the declarations: reads, writes, monitor, then control up to the reset of the stopped CPU.
        const order: CommandName[] = [
          ...names.filter((name) => !name.startsWith('remote')),
          'remotePause',
          'remoteRun',
          'remoteStop',
          'remoteLatchClear',
        ]
        for (const name of order) {
          // Without a serial number each UDP request comes from a new port, where nothing is registered.
          if (name === 'executeMonitor' && text.startsWith('udp 3E')) continue
          await ask(client, name)
        }
        expect(plc.cpu.state).toBe('STOP')
        await ask(client, 'remoteReset')
      },
    ))
})

describe.each(['tcp 4E binary iq-r', 'udp 3E ascii iq-r', 'tcp 3E ascii q', 'udp 3E binary iq-f'])(
  '8: merged requests over %s',
  (text) => {
    test('a hole that the PLC refuses does not take the items around it down', () =>
      withLine(text, { plc: { profileOverrides: { ranges: { D: 200, M: 64 } } } }, async ({ plc, client }) => {
        for (let i = 0; i < 200; i++) plc.memory.setWord('D', i, i)
        plc.write('M63', true)
        // Merged with its neighbours, D198 would reach beyond the last register; M48 to M63 is the last word of M.
        const items = [
          'D150',
          'D196',
          'D199',
          'D198:DINT',
          'D199:DINT',
          'D200',
          'D230',
          'M63',
          'M64',
          'M60[4]',
          'M60[8]',
        ]
        const expected = [
          150,
          196,
          199,
          198 + 199 * 65_536,
          'END_CODE',
          'END_CODE',
          'END_CODE',
          true,
          'END_CODE',
          [false, false, false, true],
          'END_CODE',
        ]
        for (let run = 0; run < 3; run++) expect((await client.read(items)).map(brief)).toEqual(expected)
        const plan = client.plan(items)
        for (let run = 0; run < 3; run++) expect((await plan.run()).map(brief)).toEqual(expected)
        expect(plan.describe().notes.join('\n')).toContain('D200')
      }))

    test('bits across word boundaries, words and double words mixed, texts and LREAL between them', () =>
      withLine(text, {}, async ({ plc, client }) => {
        const items: string[] = []
        const expected: ReadValue[] = []
        const add = (item: string, value: ReadValue) => {
          items.push(item)
          expected.push(value)
        }
        for (let i = 0; i < 78; i++) {
          const on = (i * 7) % 3 === 0
          plc.memory.setBit('M', 9 + i, on)
          add(`M${9 + i}`, on)
        }
        for (let i = 0; i < 30; i++) {
          plc.write(`D${i * 97}`, i)
          plc.write(`D${i * 97 + 1}:DINT`, -i * 100_000)
          plc.write(`D${i * 97 + 3}:LREAL`, i / 3)
          plc.write(`D${i * 97 + 7}:STRING(5)`, `t${i}`)
          add(`D${i * 97}`, i)
          add(`D${i * 97 + 1}:DINT`, i === 0 ? 0 : -i * 100_000)
          add(`D${i * 97 + 3}:LREAL`, i / 3)
          add(`D${i * 97 + 7}:STRING(5)`, `t${i}`)
          add(`D${i * 97}.0`, i % 2 === 1)
        }
        const shuffled = items.map((item, i) => ({ item, value: expected[i], key: (i * 7919) % 1009 }))
        shuffled.sort((a, b) => a.key - b.key)
        const results = await client.read(shuffled.map(({ item }) => item))
        expect(results.map(brief)).toEqual(shuffled.map(({ value }) => value))
      }))

    test('mixed plans under faults: each value is right or has an error', () =>
      withLine(text, { client: { timeout: 150, gap: 4 } }, async ({ plc, client }) => {
        const items = Array.from({ length: 120 }, (_, i) =>
          i % 3 === 0 ? `D${i * 20}:DINT` : i % 3 === 1 ? `M${i * 9}` : `W${(i * 4).toString(16)}`,
        )
        const expected = items.map((item, i) => {
          const value = item.startsWith('M') ? i % 2 === 0 : 100 + i
          plc.write(item, value)
          return value
        })
        await client.connect()
        const plan = client.plan(items)
        const faults = [
          { kind: 'drop' },
          { kind: 'late' },
          { kind: 'duplicate' },
          { kind: 'cut', at: 15 },
          { kind: 'endCode', endCode: 0xc051 },
          { kind: 'endCode', endCode: 0x4031 },
          { kind: 'endCode', endCode: 0xcf00 },
          { kind: 'garbage' },
          { kind: 'wrongRoute' },
        ] as const
        for (const fault of faults) {
          plc.faults.add({ ...fault, times: 1 })
          const results = await plan.run()
          for (const [i, result] of results.entries()) {
            if (result.ok) expect([fault, result.item, result.value]).toEqual([fault, items[i], expected[i]])
          }
          plc.faults.clear()
          await nextState(client, 'connected')
          await client.read(['SM0'])
          await nextState(client, 'connected')
        }
        expect((await plan.run(ample)).map(brief)).toEqual(expected)
      }))
  },
)

describe('9: addresses that mean another device without any error', () => {
  const wide = { plc: { profileOverrides: { ranges: { B: 0x18000, W: 0x18000, X: 0x3000, Y: 0x3000 } } } } as const

  test.each(['tcp 4E binary iq-r', 'udp 4E ascii iq-r'])('hexadecimal and decimal numbers over %s', (text) =>
    withLine(text, wide, async ({ plc, client }) => {
      const rows = [
        ['B10', 'B', 0x10],
        ['BFF', 'B', 0xff],
        ['B10000', 'B', 0x10000],
        ['B17FFF', 'B', 0x17fff],
        ['XFFF', 'X', 0xfff],
        ['Y2FFF', 'Y', 0x2fff],
        ['SB100', 'SB', 0x100],
        ['M10', 'M', 10],
        ['L100', 'L', 100],
        ['SM1010', 'SM', 1010],
      ] as const
      for (const [item, device, number] of rows) {
        await client.write(item, true)
        expect([item, plc.memory.bit(device, number)]).toEqual([item, true])
        expect(await client.read(item)).toBe(true)
        plc.memory.setBit(device, number, false)
        expect(await client.read(item)).toBe(false)
      }
      const words = [
        ['W10', 'W', 0x10],
        ['WABC', 'W', 0xabc],
        ['W17FFF', 'W', 0x17fff],
        ['SW1F', 'SW', 0x1f],
        ['ZR32767', 'ZR', 32767],
        ['ZR32768', 'ZR', 32768],
        ['ZR65535', 'ZR', 65535],
        ['R32767', 'R', 32767],
        ['D010', 'D', 10],
        ['d18431', 'D', 18431],
      ] as const
      for (const [i, [item, device, number]] of words.entries()) {
        await client.write(item, i + 1)
        expect([item, plc.memory.word(device, number)]).toEqual([item, i + 1])
        expect(await client.read(item)).toBe(i + 1)
      }
    }),
  )

  test('what no number of the family can be is refused, not masked', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      const { requests } = plc.statistics
      const results = await client.read([
        'D-1',
        'D1.5:INT',
        'D4294967296',
        'D1FF',
        'M1F',
        'WXYZ1',
        'X1G',
        'B',
        'D 1',
        'D1e3',
        'Z',
        '10',
      ])
      for (const result of results) expect(['BAD_ADDRESS', 'OUT_OF_RANGE', 'BAD_TYPE']).toContain(brief(result))
      expect(plc.statistics.requests).toBe(requests)
    }))

  test('a value that does not fit is refused, not cut', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      await client.connect()
      const { requests } = plc.statistics
      const bad: readonly (readonly [string, unknown])[] = [
        ['D0', 32_768],
        ['D0', -32_769],
        ['D0', 1.5],
        ['D0', Number.NaN],
        ['D0', Number.POSITIVE_INFINITY],
        ['D0', '5'],
        ['D0', true],
        ['D0', null],
        ['D0', 40_000n],
        ['D0:UINT', -1],
        ['D0:UINT', 65_536],
        ['D0:DINT', 2 ** 31],
        ['D0:UDINT', -1],
        ['D0:REAL', Number.NaN],
        ['D0:REAL', 1e39],
        ['D0:REAL', Number.NEGATIVE_INFINITY],
        ['D0:LREAL', Number.NaN],
        ['D0:LINT', 2n ** 63n],
        ['D0:LINT', 1.5],
        ['D0:LINT', 2 ** 60],
        ['D0:ULINT', -1n],
        ['D0:BCD16', 10_000],
        ['D0:BCD32', -1],
        ['D0:STRING(2)', 'abc'],
        ['D0:STRING(4)', 'é'],
        ['D0:STRING(4)', 5],
        ['D0:WSTRING(1)', '山田'],
        ['M0', 1],
        ['M0', 'true'],
        ['M0[2]', [true]],
        ['M0[2]', true],
        ['D0[2]', [1, 2, 3]],
        ['K1M0', 16],
        ['K4M0', 70_000],
        ['D0.0', 1],
        ['D0[2]', new Array(2)],
        ['D0[2]', { 0: 1, 1: 2, length: 2 }],
      ]
      for (const [item, value] of bad) {
        const error: PlcError = await failureOf(client.write(item, value as ReadValue, { readModifyWrite: true }))
        expect([item, value, error.code, error.outcome]).toEqual([item, value, 'BAD_VALUE', 'notSent'])
        expect(error.message).toContain(item.split(':')[0])
      }
      expect(plc.statistics.requests).toBe(requests)
    }))

  test('a content that is no value of the type is an error of that item, and the connection lives', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      plc.memory.setWord('D', 0, 0xabcd)
      plc.memory.setWord('D', 10, 0x80ff)
      plc.memory.setWord('D', 20, 5)
      const results = await client.read([
        'D0:BCD16',
        { address: 'D10:STRING(2)', encoding: 'utf8' },
        { address: 'D10:STRING(2)', encoding: 'ascii' },
        'D20',
      ])
      expect(results.map(brief)).toEqual(['BAD_FIELD', 'BAD_FIELD', 'BAD_FIELD', 5])
      expect(client.statistics).toMatchObject({ connects: 1, protocolErrors: 0 })
    }))
})
