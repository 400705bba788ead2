/** Failure modes of connections: power cycles, taken entries, lost writes, and a PLC that says nothing. */
import { describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type FaultKind } from '../../src/entry/simulator'
import {
  type ConnectionState,
  createMelsecClient,
  type MelsecClient,
  type PlcError,
  TimeoutError,
} from '../../src/index'
import { manualClock } from '../support/manual-clock'
import { ample, brief, clientOptions, failureOf, kind, links, nextState, until, withLine } from './line'

const SHORT = 150
const short = { client: { timeout: SHORT } } as const
const bothTransports = ['tcp 4E binary iq-r', 'udp 4E binary iq-r', 'tcp 3E ascii iq-f', 'udp 3E binary iq-r']

describe.each(links)('4: the PLC goes and comes back, over %s', (text) => {
  test('a power cycle: calls fail, nothing hangs, and the client comes back by itself', () =>
    withLine(text, { plc: { latch: ['D'] }, client: { timeout: 200 } }, async ({ plc, client, transport }) => {
      plc.write('D0', 7)
      expect(await client.read('D0', ample)).toBe(7)
      for (let cycle = 0; cycle < 3; cycle++) {
        const up = new Promise<void>((resolve) => {
          const stop = plc.on('restart', () => {
            stop()
            resolve()
          })
        })
        plc.restart(30)
        const during = await Promise.allSettled([client.read('D0'), client.read('D0'), client.write('D1', cycle)])
        for (const one of during) if (one.status === 'fulfilled' && one.value !== undefined) expect(one.value).toBe(7)
        await up
        if (transport === 'tcp') await nextState(client, 'connected')
        const values = await Promise.all([client.read(['D0']), client.read(['D0'])])
        await nextState(client, 'connected')
        expect(['TIMEOUT', 'OFFLINE', 'DISCONNECTED', 7]).toContain(brief(values[0][0] as never))
        expect(await client.read('D0', ample)).toBe(7)
      }
    }))

  test('another program on the same port after hours: the client finds it', async () => {
    const line = kind(text)
    const first = createPlcSimulator({ profile: 'iq-r' })
    await first.listen()
    const port = first[line.transport]?.port ?? 0
    const client = createMelsecClient(clientOptions(line, first, { timeout: SHORT, connectTimeout: SHORT }))
    expect(await client.read('D0', ample)).toBe(0)
    await first.close()
    const states: ConnectionState[] = []
    client.on('state', (state) => states.push(state))
    for (let i = 0; i < 10 && client.state.name === 'connected'; i++) await client.read(['D0'])
    await until(() => states.filter(({ name }) => name === 'connecting').length >= 3)
    expect(await failureOf(client.read('D0'))).toMatchObject({ outcome: 'notSent' })
    const second = createPlcSimulator({ profile: 'iq-r', [line.transport]: { port } })
    await second.listen()
    second.write('D0', 8)
    await nextState(client, 'connected')
    expect(await client.read('D0', ample)).toBe(8)
    await client.close()
    await second.close()
  })

  test('a cable that is pulled: two unanswered requests, then the connection is made anew', () =>
    withLine(text, short, async ({ plc, client }) => {
      await client.connect()
      const fault = plc.faults.add({ kind: 'silence' })
      const errors: PlcError[] = []
      for (let i = 0; i < 6 && client.state.name !== 'waiting'; i++) errors.push(await failureOf(client.read('D0')))
      for (const error of errors) expect(['TIMEOUT', 'OFFLINE', 'SILENT', 'DISCONNECTED']).toContain(error.code)
      await until(() => client.statistics.connects >= 2)
      fault.remove()
      await nextState(client, 'connected')
      expect(await client.read('D0', ample)).toBe(0)
    }))

  test('a reset in the middle of an answer', () =>
    withLine(text, short, async ({ plc, client, transport }) => {
      for (const at of [0, 1, 5, 9, 12]) {
        await client.read(['D0'])
        await nextState(client, 'connected')
        plc.faults.add({ kind: 'disconnect', at, how: 'reset', times: 1, commands: ['readWords'] })
        const [result] = await client.read(['D0'])
        expect(result?.ok).toBe(false)
        if (transport === 'tcp') expect(result?.ok === false && result.error.outcome).toBe('unknown')
      }
      await nextState(client, 'connected')
      expect(await client.read('D0', ample)).toBe(0)
    }))
})

test.each(['tcp', 'udp'] as const)('4: a PLC that is off for an hour is tried seldom, over %s', async (transport) => {
  const plc = createPlcSimulator({ profile: 'iq-r' })
  await plc.listen()
  const line = kind(`${transport} 4E binary iq-r`)
  const clock = manualClock()
  const reconnect = { first: 500, longest: 30_000 }
  const client = createMelsecClient(clientOptions(line, plc, { clock, reconnect, timeout: 3000, random: () => 0.5 }))
  await client.connect()
  await plc.close()
  const failed = failureOf(client.read('D0'))
  for (let second = 0; second < 3600; second += 5) {
    clock.advance(5000)
    // The sockets' own answers (refused) take a turn of the event loop or two.
    if (client.state.name === 'connecting') await until(() => client.state.name !== 'connecting' || clock.pending > 0)
    await new Promise<void>((resolve) => setImmediate(resolve))
  }
  expect(['TIMEOUT', 'DISCONNECTED', 'CONNECT_FAILED', 'OFFLINE']).toContain((await failed).code)
  // An hour in pauses of 22 to 30 s.
  expect(client.statistics.connects).toBeGreaterThan(20)
  expect(client.statistics.connects).toBeLessThan(200)
  // Calls meanwhile fail at once and leave nothing behind.
  const many = await Promise.allSettled(Array.from({ length: 1000 }, () => client.read('D0')))
  expect(many.filter(({ status }) => status === 'fulfilled')).toEqual([])
  expect(client.statistics).toMatchObject({ queued: 0, inFlight: 0 })
  expect(clock.pending).toBeLessThan(3)
  await client.close()
  expect(clock.pending).toBe(0)
})

describe('5: entries of the PLC', () => {
  test.each(['tcp 3E binary iq-r', 'tcp 3E ascii iq-f'])(
    'all taken, over %s: it is said, and later there is one',
    (text) =>
      withLine(text, { plc: { maxConnections: 1 } }, async ({ plc, client, another }) => {
        await client.connect()
        const second = another()
        const error = await failureOf(second.connect())
        expect(error).toMatchObject({ code: 'ENTRY_BUSY', outcome: 'notSent' })
        expect(error.message).toContain('entries')
        expect(await failureOf(second.read('D0'))).toMatchObject({ outcome: 'notSent' })
        expect(second.state.error?.code).toBe('ENTRY_BUSY')
        // The first is not disturbed by the knocking of the second.
        expect(await client.read('D0', ample)).toBe(0)
        await client.close()
        await nextState(second, 'connected')
        expect(await second.read('D0')).toBe(0)
        expect(plc.connections).toHaveLength(1)
      }),
  )

  test.each(['close', 'reset'] as const)('accepted, then ended at once by %s', (how) =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      plc.faults.add({ kind: 'closeOnAccept', how, times: 3 })
      const error = await failureOf(client.read('D0'))
      expect(error.outcome).toBe('notSent')
      expect(['ENTRY_BUSY', 'DISCONNECTED', 'OFFLINE']).toContain(error.code)
      await nextState(client, 'connected')
      expect(await client.read('D0', ample)).toBe(0)
      expect(plc.statistics.turnedAway).toBe(3)
    }),
  )

  test.each(['tcp 4E binary iq-r', 'udp 4E binary iq-r', 'udp 3E binary iq-r'])(
    '50 clients one after the other leave none taken, over %s',
    (text) =>
      withLine(text, { plc: { maxConnections: 2 } }, async ({ plc, client, another }) => {
        await client.close()
        for (let i = 0; i < 50; i++) {
          const next = another()
          expect(await next.read('D0')).toBe(0)
          await next.close()
          if (text.startsWith('tcp')) await until(() => plc.connections.length === 0)
        }
        expect(plc.statistics.turnedAway).toBe(0)
      }),
  )
})

describe.each(links)('7: writes whose outcome is not known, over %s', (text) => {
  const faults: readonly FaultKind[] = [
    'silence',
    'drop',
    'late',
    'cut',
    'disconnect',
    'garbage',
    'wrongRoute',
    'wrongSerial',
    'duplicate',
    'merge',
  ]
  test.each(faults)('%s: each is applied at most once, and what is reported as done is done', (name) =>
    withLine(text, { client: { timeout: 100 } }, async ({ plc, client }) => {
      const applied = new Map<number, number>()
      plc.on('write', ({ message }) => {
        const [value] = (message?.values ?? []) as number[]
        applied.set(value ?? -1, (applied.get(value ?? -1) ?? 0) + 1)
      })
      const outcomes = new Map<number, string>()
      for (let value = 1; value <= 12; value++) {
        await nextState(client, value === 1 ? 'idle' : 'connected')
        const fault = {
          ...(name === 'cut' ? { kind: 'cut', at: 5 } : { kind: name }),
          times: 1,
          commands: ['writeWords'],
        }
        if (value % 3 === 0) plc.faults.add(fault as { kind: 'silence' })
        const outcome = await client.write('D0', value).then(
          () => 'done',
          (error: PlcError) => error.outcome,
        )
        outcomes.set(value, outcome)
        plc.faults.clear()
      }
      for (const [value, outcome] of outcomes) {
        const times = applied.get(value) ?? 0
        expect([value, outcome, times]).toEqual([
          value,
          outcome,
          outcome === 'done' ? 1 : outcome === 'unknown' ? Math.min(1, times) : 0,
        ])
      }
      // A fault costs the write it meets, and at most the next one.
      expect([...outcomes.values()].filter((outcome) => outcome === 'done').length).toBeGreaterThanOrEqual(4)
    }),
  )

  test('a list of writes: after the one that is not known nothing more is sent', () =>
    withLine(text, { client: { timeout: 100 } }, async ({ plc, client }) => {
      await client.connect()
      let writes = 0
      plc.on('request', ({ effect }) => {
        if (effect === 'write') writes++
      })
      plc.faults.add({ kind: 'drop', commands: ['writeWords', 'writeRandomWords'], times: 1 })
      const results = await client.writeEach([
        { item: 'D0[900]', value: Array(900).fill(1) },
        { item: 'D1000[900]', value: Array(900).fill(2) },
        { item: 'M0', value: true },
      ])
      const errors = results.map((result) => (result.ok ? 'done' : [result.error.code, result.error.outcome]))
      expect(errors).toEqual([
        ['TIMEOUT', 'unknown'],
        ['ABORTED', 'notSent'],
        ['ABORTED', 'notSent'],
      ])
      expect(writes).toBe(1)
      expect([plc.read('D0'), plc.read('D1000'), plc.read('M0')]).toEqual([1, 0, false])
    }))

  test('a bit of a word: the word is not written when it could not be read', () =>
    withLine(text, { client: { timeout: 100 } }, async ({ plc, client }) => {
      await client.connect()
      plc.memory.setWord('D', 0, 0xff00)
      plc.faults.add({ kind: 'drop', commands: ['readWords', 'readRandom'], times: 1 })
      const error = await failureOf(client.write('D0.1', true, { readModifyWrite: true }))
      expect(error.outcome).toBe('notSent')
      expect(plc.memory.word('D', 0)).toBe(0xff00)
    }))
})

test.each(['tcp 4E binary iq-r', 'udp 3E binary iq-r'])(
  '7: 5000 reads of a silent PLC are all settled, most of them at once, over %s',
  (text) =>
    withLine(text, { client: { timeout: 200 } }, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'silence' })
      const codes = new Map<string, number>()
      const count = (code: string) => codes.set(code, (codes.get(code) ?? 0) + 1)
      const reads = Array.from({ length: 5000 }, () =>
        client.read('D0').then(
          () => count('read'),
          (error: PlcError) => count(error.code),
        ),
      )
      expect(client.statistics.queued).toBeLessThanOrEqual(256)
      await Promise.all(reads)
      expect(codes.get('QUEUE_FULL')).toBe(5000 - 257)
      expect(codes.get('read')).toBeUndefined()
      expect(client.statistics).toMatchObject({ queued: 0, inFlight: 0 })
    }),
)

describe('10: silence, and its most likely cause', () => {
  const silences: readonly (readonly [what: string, text: string, plc: object, client: object, cause: RegExp])[] = [
    [
      'the client speaks ASCII, the port binary',
      'tcp 4E ascii iq-r',
      { code: 'binary' },
      {},
      /set to binary code and this connection to ASCII code/,
    ],
    [
      'the client speaks binary, the port ASCII',
      'tcp 3E binary iq-r',
      { code: 'ascii' },
      {},
      /set to ASCII code and this connection to binary/,
    ],
    [
      'over UDP',
      'udp 4E ascii iq-r',
      { code: 'binary' },
      {},
      /^UDP: the PLC sends its answer to the peer that is registered/,
    ],
    [
      'a route to a station that is not there',
      'tcp 4E binary iq-r',
      { otherStations: 'silence' },
      { route: { network: 1, station: 2 } },
      /^Network 1, station 2 does not answer/,
    ],
  ]
  test.each(silences)('%s', (_what, text, plc, options, cause) =>
    withLine(text, { plc, client: { timeout: SHORT, ...options } }, async ({ client }) => {
      const error = await failureOf(client.connect())
      expect(['SILENT', 'TIMEOUT']).toContain(error.code)
      expect((error as TimeoutError).causes[0]).toMatch(cause)
      expect(error.message).toMatch(cause.source.startsWith('^') ? new RegExp(cause.source.slice(1)) : cause)
      const next = await failureOf(client.read('D0'))
      expect((next as TimeoutError).causes[0] ?? next.message).toMatch(cause)
      expect(client.state.error?.message).toContain('does not answer')
    }),
  )

  test('another frame is among the causes', () =>
    withLine('tcp 4E binary iq-r', { plc: { frames: ['3E'] }, client: { timeout: SHORT } }, async ({ client }) => {
      const error = (await failureOf(client.connect())) as TimeoutError
      expect(error.causes.join('\n')).toContain('does not know the 4E frame: try 3E')
    }))

  test.each(bothTransports)('a PLC that has answered before is not said to be set wrongly, over %s', (text) =>
    withLine(text, short, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'silence' })
      const error = (await failureOf(client.read('D0'))) as TimeoutError
      expect(error).toBeInstanceOf(TimeoutError)
      expect(error.causes[0]).toContain('off, restarting, or its cable')
      expect(error.causes.join(' ')).not.toContain('ASCII')
    }),
  )

  test('nothing listens: refused, with what to check', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      await plc.close()
      const error = await failureOf(client.read('D0'))
      expect(error.outcome).toBe('notSent')
      expect(error.message).toMatch(/port number differs/)
    }))
})

test('5: clients of one PLC do not disturb one another', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ client, another }) => {
    const others: MelsecClient[] = Array.from({ length: 5 }, () => another())
    await Promise.all(others.map((other) => other.connect()))
    await others[0]?.close()
    expect(await Promise.all(others.slice(1).map((other) => other.read('D0')))).toEqual([0, 0, 0, 0])
    expect(client.state.name).toBe('idle')
  }))
