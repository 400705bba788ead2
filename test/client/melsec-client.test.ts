/** Permissions, deadlines, signals, the queue, closing, events, and what programs without types pass. */
import { describe, expect, jest, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import {
  type CallOptions,
  type ClosedError,
  createMelsecClient,
  type MelsecClient,
  type MelsecClientOptions,
  PlcError,
  RequestError,
  type UnsolicitedFrame,
} from '../../src/index'
import { ownStation } from '../../src/melsec/frame/route'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { realClock } from '../../src/transport/clock'
import { brief, clientOptions, failureOf, kind, links, nextState, until, withLine } from './line'

const SHORT = 120

/** Every way to ask something of a PLC. */
const calls: Readonly<Record<string, (client: MelsecClient, options?: CallOptions) => Promise<unknown>>> = {
  connect: (client, options) => client.connect(options),
  read: (client, options) => client.read('D0', options),
  'read a list': async (client, options) => single(await client.read(['D0'], options)),
  'read an object': async (client, options) => single(Object.values(await client.read({ a: 'D0' }, options))),
  readValues: (client, options) => client.readValues(['D0'], options),
  write: (client, options) => client.write('D0', 1, options),
  writeEach: async (client, options) => single(Object.values(await client.writeEach({ D0: 1 }, options))),
  'writeEach of entries': async (client, options) =>
    single(await client.writeEach([{ item: 'D0', value: 1 }], options)),
  'write a bit of a word': (client, options) => client.write('D0.1', true, { ...options, readModifyWrite: true }),
  plan: async (client, options) => single(await client.plan(['D0']).run(options)),
  planWrite: async (client, options) => single(await client.planWrite([{ item: 'D0', value: 1 }]).runEach(options)),
  monitor: async (client, options) => single(await client.monitor(['D0']).read(options)),
  request: (client, options) => client.request(commands.readTypeName, {}, options),
  identify: (client, options) => client.identify(options),
  selfTest: (client, options) => client.selfTest('ABC', options),
  clearError: (client, options) => client.clearError(options),
  'control.run': (client, options) => client.control.run(options),
  'control.stop': (client, options) => client.control.stop(options),
  'control.pause': (client, options) => client.control.pause(options),
  'control.latchClear': (client, options) => client.control.latchClear(options),
}
const names = Object.keys(calls)
const call = (name: string, client: MelsecClient, options?: CallOptions) =>
  calls[name]?.(client, options) ?? Promise.reject(new Error(`no call ${name}`))

/** The value of the only result; throws its error. */
function single(results: readonly ({ ok: true } | { ok: false; error: PlcError })[]): true {
  const [result] = results
  if (result?.ok === false) throw result.error
  return true
}

describe('without permission nothing is sent', () => {
  const writing = ['write', 'writeEach', 'writeEach of entries', 'write a bit of a word', 'planWrite']
  const controlling = ['clearError', 'control.run', 'control.stop', 'control.pause', 'control.latchClear']

  test.each([...writing.map((name) => [name, 'allowWrites']), ...controlling.map((name) => [name, 'allowControl'])])(
    '%s needs %s',
    (name, option) =>
      withLine('tcp 4E binary iq-r', { client: { [option]: false } }, async ({ plc, client }) => {
        await client.connect()
        const { requests } = plc.statistics
        const error = await failureOf(call(name, client))
        expect(error).toBeInstanceOf(RequestError)
        expect([error.code, error.outcome]).toEqual(['NOT_PERMITTED', 'notSent'])
        expect(error.message).toContain(option)
        expect(plc.statistics.requests).toBe(requests)
      }),
  )

  test('nor by request()', () =>
    withLine('udp 4E binary iq-r', { client: { allowWrites: false, allowControl: false } }, async ({ plc, client }) => {
      await client.connect()
      const { requests } = plc.statistics
      const head = { device: 'D', number: 0 } as const
      const refused = [
        client.request(commands.writeWords, { head, values: [1] }),
        client.request(commands.writeBits, { head: { device: 'M', number: 0 }, values: [true] }),
        client.request(commands.writeRandomBits, { bits: [{ device: { device: 'M', number: 0 }, value: true }] }),
        client.request(commands.writeRandomWords, { words: [{ device: head, value: 1 }], doubleWords: [] }),
        client.request(commands.writeBlock, { wordBlocks: [{ head, values: [1] }], bitBlocks: [] }),
        client.request(commands.remoteRun, { mode: 1 }),
        client.request(commands.remoteStop, {}),
        client.request(commands.remotePause, { mode: 1 }),
        client.request(commands.remoteLatchClear, {}),
        client.request(commands.remoteReset, {}),
        client.request(commands.clearError, {}),
        client.control.reset(),
      ]
      for (const one of refused) expect((await failureOf(one)).code).toBe('NOT_PERMITTED')
      expect(plc.statistics.requests).toBe(requests)
      expect(plc.cpu.state).toBe('RUN')
    }))

  test('reading, identifying and self test need none', () =>
    withLine('tcp 3E binary iq-r', { client: { allowWrites: false, allowControl: false } }, async ({ client }) => {
      for (const name of ['read', 'plan', 'monitor', 'request', 'identify', 'selfTest']) await call(name, client)
    }))
})

describe.each(['tcp 4E binary iq-r', 'udp 3E binary iq-r'])('a signal over %s', (text) => {
  test.each(names)('that is aborted already ends %s before anything is sent', (name) =>
    withLine(text, {}, async ({ plc, client }) => {
      const reason = new Error('not needed any more')
      const error = await failureOf(call(name, client, { signal: AbortSignal.abort(reason) }))
      expect([error.code, error.outcome, (error as ClosedError).cause]).toEqual(['ABORTED', 'notSent', reason])
      expect(plc.statistics.requests).toBe(0)
    }),
  )

  test.each(names.filter((name) => name !== 'connect'))('that is aborted in flight ends %s at once', (name) =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'silence', commands: ['readWords', 'readRandom', 'writeWords'] })
      plc.faults.add({ kind: 'silence' })
      const { requests } = plc.statistics
      const controller = new AbortController()
      const failed = failureOf(call(name, client, { signal: controller.signal }))
      await until(() => plc.statistics.requests > requests)
      controller.abort()
      const error = await failed
      expect(error.code).toBe('ABORTED')
      // A bit of a word: only the reading before it was sent.
      expect(error.outcome).toBe(name === 'write a bit of a word' ? 'notSent' : 'unknown')
      plc.faults.clear()
      expect(await client.read('D0')).toBe(0)
    }),
  )
})

describe('a signal', () => {
  test('ends a call that waits in the queue, and the others go on', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'delay', ms: 30, times: 1 })
      const controller = new AbortController()
      const first = client.read('D0')
      const waiting = failureOf(client.read('D1', { signal: controller.signal }))
      const last = client.read('D2')
      controller.abort()
      expect(await waiting).toMatchObject({ code: 'ABORTED', outcome: 'notSent' })
      expect(await Promise.all([first, last])).toEqual([0, 0])
      expect(client.statistics).toMatchObject({ aborted: 1, answered: 2, queued: 0, inFlight: 0 })
    }))

  test('ends a plan of many requests: what was answered stays', () =>
    withLine('tcp 4E binary iq-r', { client: { gap: 0 } }, async ({ plc, client }) => {
      const items = ['D0[900]', 'D1000[900]', 'D2000[900]', 'D3000[900]']
      const controller = new AbortController()
      const stop = plc.on('request', ({ message }) => {
        if (message?.points === undefined) return
        stop()
        plc.faults.add({ kind: 'silence' })
        setImmediate(() => void until(() => plc.statistics.requests >= 3).then(() => controller.abort()))
      })
      const results = await client.read(items, { signal: controller.signal })
      expect(results[0]?.ok).toBe(true)
      expect(results.slice(1).map(brief)).toEqual(['ABORTED', 'ABORTED', 'ABORTED'])
    }))

  test('leaves no listener behind', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
      const controller = new AbortController()
      let listeners = 0
      const { signal } = controller
      const counted = Object.assign(Object.create(signal) as AbortSignal, {
        addEventListener: (...given: Parameters<AbortSignal['addEventListener']>) => {
          listeners++
          signal.addEventListener(...given)
        },
        removeEventListener: (...given: Parameters<AbortSignal['removeEventListener']>) => {
          listeners--
          signal.removeEventListener(...given)
        },
      })
      Object.defineProperty(counted, 'aborted', { get: () => signal.aborted })
      for (let i = 0; i < 20; i++) await client.read(['D0', 'M0'], { signal: counted })
      const monitors = [client.monitor(['D0']), client.monitor(['D1'])]
      await Promise.all(monitors.map((monitor) => monitor.read({ signal: counted })))
      expect(listeners).toBe(0)
    }))
})

describe('the deadline of a call', () => {
  test.each(names.filter((name) => name !== 'connect'))('%s ends at it when nothing is answered', (name) =>
    withLine('udp 4E binary iq-r', {}, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'silence' })
      const start = realClock.now()
      const error = await failureOf(call(name, client, { timeout: SHORT }))
      expect(error.code).toBe('TIMEOUT')
      expect(error.outcome).toBe(name === 'write a bit of a word' ? 'notSent' : 'unknown')
      expect(realClock.now() - start).toBeGreaterThanOrEqual(SHORT)
    }),
  )

  test.each(['tcp 4E binary iq-r', 'udp 3E binary iq-r'])(
    'is one for all requests of a plan over %s: each is answered in time, all together are not',
    (text) =>
      withLine(text, { client: { gap: 0, timeout: 300 } }, async ({ plc, client }) => {
        await client.connect()
        plc.faults.add({ kind: 'delay', ms: 60 })
        const items = Array.from({ length: 15 }, (_, i) => `D${i * 1000}[900]`)
        const start = realClock.now()
        const results = await client.read(items)
        const elapsed = realClock.now() - start
        // What could not be answered by then is not even sent, so that nothing expires in flight.
        expect(elapsed).toBeGreaterThanOrEqual(180)
        expect(elapsed).toBeLessThan(15 * 60)
        expect(results[0]?.ok).toBe(true)
        const failed = results.flatMap((result) => (result.ok ? [] : [result.error]))
        expect(new Set(failed.map(({ code, outcome }) => `${code} ${outcome}`))).toEqual(
          new Set(['OVERLOADED notSent']),
        )
        expect(client.statistics).toMatchObject({ timeouts: 0, disconnects: 0 })
      }),
  )

  test('is one for all requests of a write: after it nothing more is sent', () =>
    withLine('tcp 4E binary iq-r', { client: { timeout: 300 } }, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'delay', ms: 80 })
      const entries = Array.from({ length: 10 }, (_, i) => ({
        item: `D${i * 1000}[900]`,
        value: Array(900).fill(i + 1),
      }))
      const results = await client.writeEach(entries)
      const written = results.filter(({ ok }) => ok).length
      expect(written).toBeGreaterThan(0)
      expect(written).toBeLessThan(10)
      const [unknown, ...others] = results.flatMap((result) => (result.ok ? [] : [result.error]))
      expect(unknown).toMatchObject({ code: 'TIMEOUT' })
      for (const error of others) expect(error).toMatchObject({ code: 'ABORTED', outcome: 'notSent' })
      const values = entries.map(({ item }) => plc.read(item.slice(0, item.indexOf('['))))
      const changed = values.filter((value) => value !== 0).length
      expect(changed - written).toBe(unknown?.outcome === 'unknown' ? 1 : 0)
    }))

  test('is a timeout also when it has passed between two requests', async () => {
    // A clock that jumps over the deadline as soon as the first request of the plan was answered.
    let late = 0
    const clock = { ...realClock, now: () => realClock.now() + late }
    await withLine('tcp 4E binary iq-r', { client: { clock } }, async ({ plc, client }) => {
      await client.connect()
      const stop = plc.on('write', () => {
        stop()
        late = 10_000
      })
      const results = await client.writeEach([
        { item: 'D0', value: 1 },
        { item: 'M0', value: true },
      ])
      // The first was answered late or counts as timed out; the second must not look like a mistake of the program.
      const [, second] = results
      expect(second?.ok === false && ['TIMEOUT', 'ABORTED'].includes(second.error.code)).toBe(true)
      expect(second?.ok === false && second.error.outcome).toBe('notSent')
      expect(plc.read('M0')).toBe(false)
    })
  })

  test('holds for the waiting behind another monitor', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      const [slow, quick] = [client.monitor(['D0']), client.monitor(['D1'])]
      await slow.read()
      plc.faults.add({ kind: 'silence', commands: ['executeMonitor', 'entryMonitorDevice'] })
      const first = slow.read({ timeout: 600 })
      const start = realClock.now()
      const [result] = await quick.read({ timeout: 100 })
      expect(realClock.now() - start).toBeLessThan(500)
      expect(result?.ok === false && [result.error.code, result.error.outcome]).toEqual(['TIMEOUT', 'notSent'])
      const controller = new AbortController()
      const aborted = quick.read({ signal: controller.signal })
      controller.abort()
      expect((await aborted).map(brief)).toEqual(['ABORTED'])
      expect((await first).map(brief)).toEqual(['TIMEOUT'])
      plc.faults.clear()
      plc.memory.setWord('D', 1, 7)
      expect((await quick.read()).map(brief)).toEqual([7])
    }))
})

describe('the queue', () => {
  test.each(links)('refuses what is too much over %s, at once, and answers the rest', (text) =>
    withLine(text, { client: { queueLimit: 10 } }, async ({ plc, client }) => {
      await client.connect()
      for (let i = 0; i < 30; i++) plc.memory.setWord('D', i, i)
      const outcomes = await Promise.allSettled(Array.from({ length: 30 }, (_, i) => client.read(`D${i}`)))
      const values = outcomes.flatMap((one) => (one.status === 'fulfilled' ? [one.value] : []))
      const errors = outcomes.flatMap((one) => (one.status === 'rejected' ? [one.reason as PlcError] : []))
      // One in flight and ten that wait.
      expect(values).toEqual(Array.from({ length: 11 }, (_, i) => i))
      expect(errors).toHaveLength(19)
      for (const error of errors) expect(error).toMatchObject({ code: 'QUEUE_FULL', outcome: 'notSent' })
      expect(client.statistics.queued).toBe(0)
    }),
  )
})

describe('close()', () => {
  test.each(links)('settles everything under way over %s, and nothing works after it', (text) =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'silence' })
      const sent = failureOf(client.write('D0', 1))
      const waiting = failureOf(client.write('D1', 1))
      const monitor = client.monitor(['D0'])
      const monitored = monitor.read()
      const { requests } = plc.statistics
      await until(() => plc.statistics.requests > requests)
      await client.close()
      expect(await sent).toMatchObject({ code: 'CLOSED', outcome: 'unknown' })
      expect(await waiting).toMatchObject({ code: 'CLOSED', outcome: 'notSent' })
      expect((await monitored).map(brief)).toEqual(['CLOSED'])
      expect(client.state.name).toBe('closed')
      for (const name of names) {
        const error = await failureOf(call(name, client))
        expect([name, error.code, error.outcome]).toEqual([name, 'CLOSED', 'notSent'])
      }
      expect((await monitor.read()).map(brief)).toEqual(['CLOSED'])
      await client.close()
      expect(client.statistics).toMatchObject({ queued: 0, inFlight: 0 })
    }),
  )

  test('before anything was asked, and while connecting', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ client, another }) => {
      await client.close()
      expect(await failureOf(client.read('D0'))).toMatchObject({ code: 'CLOSED', outcome: 'notSent' })
      const connecting = another()
      const [read, connected] = [failureOf(connecting.read('D0')), failureOf(connecting.connect())]
      await connecting.close()
      expect(await read).toMatchObject({ code: 'CLOSED', outcome: 'notSent' })
      expect(await connected).toMatchObject({ code: 'CLOSED', outcome: 'notSent' })
    }))
})

describe('events', () => {
  test('of the state come in order until they are ended, also when a listener throws', async () => {
    const warned = jest.spyOn(process, 'emitWarning').mockReturnValue()
    await withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      const states: string[] = []
      client.on('state', () => {
        throw new Error('a mistake of the program')
      })
      const listener = ({ name }: { name: string }) => states.push(name)
      const stop = client.on('state', listener)
      const stopSecond = client.on('state', listener)
      stopSecond()
      await client.read('D0')
      plc.restart(0)
      await nextState(client, 'waiting')
      await nextState(client, 'connected')
      expect(states.filter((name, i) => name !== states[i - 1])).toEqual([
        'connecting',
        'connected',
        'waiting',
        'connecting',
        'connected',
      ])
      stop()
      stop()
      states.length = 0
      await client.close()
      expect(states).toEqual([])
    })
    expect(warned).toHaveBeenCalledWith(expect.stringContaining('a mistake of the program'), expect.anything())
    warned.mockRestore()
  })

  test.each(['3E', '4E', 'ext'] as const)(
    'of a %s frame that the PLC sends unasked: told, and no answer to anything',
    (frame) =>
      withLine('tcp 4E binary iq-r', {}, async ({ plc, another }) => {
        plc.write('D0', 5)
        const open = plc.connect()
        let inject: (bytes: Buffer) => void = () => {}
        const client = another({
          frame,
          openTransport: () => {
            const transport = open()
            return {
              kind: transport.kind,
              description: transport.description,
              open: (handlers) => {
                inject = (bytes) => handlers.received(bytes)
                transport.open(handlers)
              },
              send: (bytes) => transport.send(bytes),
              renew: () => transport.renew(),
              renewable: transport.renewable,
              get ready() {
                return transport.ready
              },
              close: () => transport.close(),
            }
          },
        })
        await client.connect()
        const told: UnsolicitedFrame[] = []
        const stop = client.on('unsolicited', (unsolicited) => told.push(unsolicited))
        const body = Buffer.from(frame === 'ext' ? '012100000000000000000102' : '012100000102', 'hex')
        const onDemand = slmpFraming(frame, 'binary').request.write({ ...ownStation, timer: 0 }, 0, body)
        const reading = client.read('D0')
        inject(onDemand)
        expect(await reading).toBe(5)
        inject(Buffer.concat([onDemand, onDemand]))
        const route = expect.objectContaining(ownStation)
        expect(told).toEqual(Array(3).fill({ route, body, timestamp: expect.any(Number) }))
        stop()
        inject(onDemand)
        expect(told).toHaveLength(3)
        expect(client.statistics).toMatchObject({ connects: 1, protocolErrors: 0, stale: 0 })
      }),
  )

  test('a listener may end itself and close the client', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
      const seen: string[] = []
      const stop = client.on('state', ({ name }) => {
        seen.push(name)
        if (name !== 'connected') return
        stop()
        void client.close()
      })
      expect((await failureOf(client.read('D0'))).code).toBe('CLOSED')
      expect(seen.at(-1)).toBe('connected')
      expect(client.state.name).toBe('closed')
    }))

  test.each([['error'], ['toString'], [undefined], [null], [5]])('there is no event %s', (event) =>
    withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
      expect(() => client.on(event as 'state', () => {})).toThrow(RequestError)
      expect(() => client.on('state', event as unknown as () => void)).toThrow(RequestError)
    }),
  )
})

test('a list of texts is not taken for another one that looks alike when it is joined', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    for (const i of [0, 1, 2]) plc.memory.setWord('D', i, 10 + i)
    const first = await client.read(['D0\nD1', 'D2'])
    expect(first.map(brief)).toEqual(['BAD_ADDRESS', 12])
    const second = await client.read(['D0', 'D1\nD2'])
    expect(second.map(brief)).toEqual([10, 'BAD_ADDRESS'])
  }))

test('a client keeps its options and its profile, and refuses what it does not know', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    const options = clientOptions(kind('tcp 4E binary iq-r'), plc)
    expect(client.options).toMatchObject({ host: '127.0.0.1', port: options.port })
    expect(client.profile.id).toBe('iq-r')
    const misspelt: Record<string, unknown>[] = [
      { allowWrite: true },
      { reconnect: { frist: 1 } },
      { reconnect: 5 },
      { asciiXy: 'oct' },
      { asciiZr: 'hex' },
      { profile: 5 },
      { profile: {} },
      { route: 5 },
      { format: { encoding: 'latin1' } },
      { profileOverrides: { d: 1 } },
    ]
    for (const given of misspelt) {
      const make = () => createMelsecClient({ ...options, ...given } as MelsecClientOptions)
      expect(make).toThrow(expect.objectContaining({ code: 'BAD_OPTION' }))
    }
    for (const given of [undefined, null, 5, 'host', []]) {
      expect(() => createMelsecClient(given as unknown as MelsecClientOptions)).toThrow(PlcError)
    }
  }))
