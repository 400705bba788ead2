/** The ways in which PLC drivers fail in the field, each through sockets: first those of the wire. */
import { describe, expect, test } from '@jest/globals'
import type { FaultKind, PlcSimulator } from '../../src/entry/simulator'
import { type CallOptions, createMelsecClient, EndCodeError, type ReadValue } from '../../src/index'
import { rawServer } from '../transport/recorder'
import { ample, brief, failureOf, type Line, links, nextState, until, withLine } from './line'

const SHORT = 150
const short = { client: { timeout: SHORT } } as const
/** Right values, by number of the device. */
const contentOf = (number: number) => 1000 + number

function fill(plc: PlcSimulator): void {
  for (let i = 0; i < 400; i++) plc.memory.setWord('D', i, contentOf(i))
}

/** Reads a device; a failure is allowed, a wrong value is not. */
async function tryRead({ client }: Pick<Line, 'client'>, number: number, options?: CallOptions): Promise<string> {
  const [result] = await client.read([`D${number}`], options)
  if (result?.ok !== true) return result?.error.code ?? 'nothing'
  expect([number, result.value]).toEqual([number, contentOf(number)])
  return 'read'
}

describe.each(links)('1: answers that belong to another request, over %s', (text) => {
  const kinds: readonly FaultKind[] = ['late', 'duplicate', 'wrongSerial', 'wrongRoute', 'garbage', 'merge', 'cut']
  test.each(kinds)('%s: the next reads are right or fail, and then all is well', (name) =>
    withLine(text, short, async (line) => {
      const { plc, client } = line
      fill(plc)
      await client.connect()
      for (let round = 0; round < 4; round++) {
        const fault = plc.faults.add(
          name === 'cut' ? { kind: 'cut', at: 9, times: 1 } : { kind: name as 'late', times: 1 },
        )
        for (const number of [100, 200, 300]) {
          await tryRead(line, number)
          await nextState(client, 'connected')
        }
        fault.remove()
        plc.faults.clear()
        // What is still on its way meets a request that it does not belong to.
        for (const number of [101, 201]) {
          await tryRead(line, number)
          await nextState(client, 'connected')
        }
        expect(await tryRead(line, 301, ample)).toBe('read')
      }
    }),
  )

  test('two answers that are late, before and after the answer they meet', () =>
    withLine(text, short, async (line) => {
      const { plc, client } = line
      fill(plc)
      await client.connect()
      for (const until of ['request', 'answer'] as const) {
        plc.faults.add({ kind: 'late', until, times: 2 })
        for (const number of [10, 20, 30, 40]) {
          await tryRead(line, number)
          await nextState(client, 'connected')
        }
        plc.faults.clear()
      }
      expect(await tryRead(line, 50, ample)).toBe('read')
    }))

  test('every answer comes three times, and those of other requests in between', () =>
    withLine(text, {}, async (line) => {
      const { plc, client } = line
      fill(plc)
      await client.connect()
      plc.faults.add({ kind: 'duplicate', copies: 2 })
      const outcomes: string[] = []
      for (let i = 0; i < 30; i++) {
        await nextState(client, 'connected')
        outcomes.push(await tryRead(line, i))
      }
      // Without a serial number a second answer on a stream is nobody's, and ends the connection.
      if (text.startsWith('tcp 3E')) expect(outcomes).toContain('read')
      else expect(new Set(outcomes)).toEqual(new Set(['read']))
    }))

  test('the answer of another station is not believed', () =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.connect()
      for (const fault of [{ kind: 'wrongRoute' }, { kind: 'wrongRoute', network: 0, station: 1 }] as const) {
        await nextState(client, 'connected')
        plc.faults.add({ ...fault, times: 1 })
        expect(await failureOf(client.read('D0'))).toMatchObject({ code: 'ECHO_MISMATCH', outcome: 'unknown' })
      }
    }))

  test('a write whose answer comes late is not taken as done, and its answer not for the next one', () =>
    withLine(text, short, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'late', commands: ['writeWords'], times: 1 })
      expect(await failureOf(client.write('D0', 1))).toMatchObject({ code: 'TIMEOUT', outcome: 'unknown' })
      await nextState(client, 'connected')
      // Refused: the late answer says "done".
      plc.faults.add({ kind: 'endCode', endCode: 0x4031, commands: ['writeWords'], times: 1 })
      const error = await failureOf(client.write('D1', 1))
      expect(['END_CODE', 'DISCONNECTED', 'UNEXPECTED_ANSWER']).toContain(error.code)
      expect(plc.read('D1')).toBe(0)
    }))
})

describe.each(links)('2: requests that a PLC would merge, over %s', (text) => {
  test('at most one is under way, with many callers and across a new connection', () =>
    withLine(text, { plc: { latch: ['D'] }, client: { timeout: 1500 } }, async (line) => {
      const { plc, client } = line
      fill(plc)
      await client.connect()
      plc.faults.add({ kind: 'coalesce', window: 2 })
      const callers = Array.from({ length: 40 }, (_, i) => tryRead(line, i))
      const outcomes = await Promise.all(callers)
      expect(new Set(outcomes)).toEqual(new Set(['read']))
      plc.restart(0)
      await Promise.all(Array.from({ length: 20 }, (_, i) => tryRead(line, i)))
      await nextState(client, 'connected')
      const again = await Promise.all(Array.from({ length: 40 }, (_, i) => tryRead(line, i)))
      expect(new Set(again)).toEqual(new Set(['read']))
      expect(plc.statistics.discarded).toBe(0)
    }))
})

describe.each(['tcp 3E binary iq-r', 'tcp 4E binary iq-r', 'tcp 3E ascii iq-f', 'tcp 4E ascii iq-r'])(
  '3: answers in pieces, over %s',
  (text) => {
    const items = ['D1', 'D2:REAL', 'D4[3]']
    const asked = async (line: Line, options?: CallOptions) => (await line.client.read(items, options)).map(brief)

    async function prepare({ plc, client }: Line): Promise<readonly ReadValue[]> {
      plc.write('D1', -7)
      plc.write('D2:REAL', 1.5)
      plc.write('D4', 4)
      plc.write('D5', 5)
      plc.write('D6', 6)
      await client.connect()
      return [-7, 1.5, [4, 5, 6]]
    }

    test('cut at every byte', () =>
      withLine(text, {}, async (line) => {
        const expected = await prepare(line)
        const before = line.client.statistics.bytesReceived
        expect(await asked(line)).toEqual(expected)
        const length = line.client.statistics.bytesReceived - before
        let chunks = 0
        line.client.on('trace', ({ direction }) => {
          if (direction === 'received') chunks++
        })
        for (let at = 1; at < length; at++) {
          line.plc.faults.add({ kind: 'split', at, pause: 1, times: 1 })
          expect([at, await asked(line)]).toEqual([at, expected])
        }
        // Nearly all of them really came in two pieces.
        expect(chunks).toBeGreaterThan(1.8 * (length - 1))
        expect(line.client.statistics.connects).toBe(1)
      }))

    test('byte by byte, and all of several requests', () =>
      withLine(text, {}, async (line) => {
        const expected = await prepare(line)
        line.plc.faults.add({ kind: 'dribble', times: 3 })
        for (let i = 0; i < 3; i++) expect(await asked(line)).toEqual(expected)
        line.plc.faults.add({ kind: 'dribble', size: 1460, times: 1 })
        expect(await line.client.read('D0[900]')).toHaveLength(900)
      }))

    test('the end never comes, or the connection ends within an answer', () =>
      withLine(text, short, async (line) => {
        const expected = await prepare(line)
        for (const at of [1, 2, 8, 9, 11, 13, 15, 20]) {
          for (const fault of [
            { kind: 'cut', at, times: 1 },
            { kind: 'disconnect', at, how: 'close', times: 1 },
            { kind: 'disconnect', at, how: 'reset', times: 1 },
          ] as const) {
            await nextState(line.client, 'connected')
            line.plc.faults.add(fault)
            const values = await asked(line)
            // With serial numbers the connection lives on after a timeout: the next answer shows that it is out of step.
            for (const value of values) expect(['TIMEOUT', 'DISCONNECTED', 'BAD_FRAME']).toContain(value)
          }
          await nextState(line.client, 'connected')
          expect(await asked(line, ample)).toEqual(expected)
        }
      }))

    test.each(['before', 'after', 'instead'] as const)('rubbish %s an answer', (place) =>
      withLine(text, short, async (line) => {
        const expected = await prepare(line)
        for (const bytes of [1, 2, 9, 30]) {
          await nextState(line.client, 'connected')
          line.plc.faults.add({ kind: 'garbage', place, bytes, times: 1 })
          const values = await asked(line)
          if (values.some((value) => typeof value === 'string')) {
            expect(new Set(values).size).toBe(1)
            expect(['BAD_FRAME', 'TIMEOUT', 'DISCONNECTED', 'BAD_DIGIT']).toContain(values[0])
          } else expect(values).toEqual(expected)
        }
        await until(() => line.client.state.name === 'connected')
        line.plc.faults.clear()
        await tryAgain(line)
        expect(await asked(line, ample)).toEqual(expected)
      }),
    )
  },
)

describe('3: lengths that cannot be, over TCP', () => {
  const answers: readonly (readonly [what: string, frame: '3E' | '4E', hex: string])[] = [
    ['no byte behind the head', '3E', 'd00000ffff03000000'],
    ['half an end code', '3E', 'd00000ffff0300010000'],
    ['65535 bytes that do not come', '3E', 'd00000ffff0300ffff0000e903'],
    ['one byte too few', '3E', 'd00000ffff0300030000 00e9'],
    ['one byte too many', '3E', 'd00000ffff030005000000e90300'],
    ['the length of another answer', '3E', 'd00000ffff030006000000e9030000'],
    ['no byte behind the head', '4E', 'd400SSSS000000ffff03000000'],
    ['65535 bytes that do not come', '4E', 'd400SSSS000000ffff0300ffff0000e903'],
    ['one byte too many', '4E', 'd400SSSS000000ffff030005000000e90300'],
    ['the head alone', '4E', 'd400SSSS0000'],
    ['the subheader of a request', '4E', '5000SSSS000000ffff030004000000e903'],
    ['another frame', '4E', 'd00000ffff030004000000e903'],
  ]
  test.each(answers)('%s (%s)', async (_what, frame, hex) => {
    let requests = 0
    const plc = await rawServer((socket) => {
      socket.on('data', (request) => {
        const serial = request.subarray(2, 4).toString('hex')
        // The first request of a connection only asks who is there.
        requests++
        const head = frame === '3E' ? 'd00000ffff0300' : `d400${serial}000000ffff0300`
        const name = Buffer.from('R08CPU          ').toString('hex')
        const good = `${head}14000000${name}0148`
        socket.write(Buffer.from(requests === 1 ? good : hex.replaceAll(' ', '').replace('SSSS', serial), 'hex'))
      })
    })
    const client = createMelsecClient({ host: '127.0.0.1', port: plc.port, profile: 'iq-r', frame, timeout: SHORT })
    try {
      await client.connect(ample)
      const error = await failureOf(client.read('D0'))
      expect(['TIMEOUT', 'TRUNCATED', 'TRAILING', 'BAD_FRAME', 'DISCONNECTED']).toContain(error.code)
      expect(error.outcome).toBe('unknown')
    } finally {
      await client.close()
      await plc.close()
    }
  })
})

/** One request whose failure may still be caused by what came before. */
async function tryAgain({ client }: Line): Promise<void> {
  await client.read(['SM0'])
  await nextState(client, 'connected')
}

describe.each(['udp 3E binary iq-r', 'udp 4E ascii iq-r'])('3: datagrams in pieces, over %s', (text) => {
  test('half an answer is never a value', () =>
    withLine(text, short, async (line) => {
      const { plc, client } = line
      fill(plc)
      await client.connect()
      for (const fault of [
        { kind: 'split', at: 11, pause: 0 },
        { kind: 'dribble', size: 4, pause: 0 },
        { kind: 'cut', at: 12 },
        { kind: 'merge' },
        { kind: 'garbage', place: 'instead' },
        { kind: 'garbage', place: 'before' },
        { kind: 'garbage', place: 'after' },
      ] as const) {
        await nextState(client, 'connected')
        plc.faults.add({ ...fault, times: 1 })
        await tryRead(line, 7)
        plc.faults.clear()
        await nextState(client, 'connected')
        await tryRead(line, 8)
        await nextState(client, 'connected')
        expect([fault, await tryRead(line, 9, ample)]).toEqual([fault, 'read'])
      }
    }))
})

describe.each(links)('6: end codes, over %s', (text) => {
  test.each([0, 1, 4, 8])('are end codes, not timeouts, with only %i bytes of error information', (bytes) =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'shortError', bytes })
      for (const endCode of [0xc056, 0xc059, 0x4031, 0x0055, 0x1234, 0xffff, 1]) {
        plc.faults.add({ kind: 'endCode', endCode, times: 1 })
        const error = await failureOf(client.read('D0'))
        expect(error).toBeInstanceOf(EndCodeError)
        expect(error).toMatchObject({ code: 'END_CODE', outcome: 'refused', endCode })
        expect(error.message).toContain(endCode.toString(16).toUpperCase().padStart(4, '0'))
        plc.faults.add({ kind: 'endCode', endCode, times: 1 })
        // Of a write, a number that is in no table says nothing of what was done.
        const outcome = [0x1234, 0xffff, 1].includes(endCode) ? 'unknown' : 'refused'
        expect(await failureOf(client.write('D0', 1))).toMatchObject({ endCode, outcome })
      }
      expect(client.statistics).toMatchObject({ connects: 1, timeouts: 0, refused: 14 })
      expect(plc.read('D0')).toBe(0)
    }),
  )
})
