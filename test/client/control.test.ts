/** Remote control, identification, self test and clear error through sockets, as the simulated CPU sees them. */
import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type EndCodeError, explainEndCode, type ProfileId } from '../../src/index'
import type { OpenTransport } from '../../src/transport/transport'
import { ample, failureOf, kinds, links, nextState, until, withLine } from './line'

const REMOTE = 0x408b
const NOT_IN_STOP = 0x4013

async function endCodeOf(call: Promise<unknown>): Promise<number> {
  const error = await failureOf(call)
  expect([error.code, error.outcome]).toEqual(['END_CODE', 'refused'])
  return (error as EndCodeError).endCode
}

function restarted(plc: PlcSimulator): Promise<void> {
  return new Promise((resolve) => {
    const stop = plc.on('restart', () => {
      stop()
      resolve()
    })
  })
}

describe.each(kinds)('over %s', (text) => {
  test('STOP, PAUSE and RUN change the state of the CPU, which SD203 shows', () =>
    withLine(text, {}, async ({ plc, client }) => {
      const changes: string[] = []
      plc.on('state', ({ state }) => changes.push(state))
      const state = async () => [plc.cpu.state, ((await client.read('SD203')) as number) & 0xf]
      await client.control.stop()
      expect(await state()).toEqual(['STOP', 2])
      await client.control.run()
      expect(await state()).toEqual(['RUN', 0])
      await client.control.pause()
      expect(await state()).toEqual(['PAUSE', 3])
      await client.control.run({ force: true })
      expect(await state()).toEqual(['RUN', 0])
      expect(changes).toEqual(['STOP', 'RUN', 'PAUSE', 'RUN'])
    }))

  test('it says who it is', () =>
    withLine(text, {}, async ({ client, profile }) => {
      const expected: Readonly<Partial<Record<ProfileId, unknown>>> = {
        'iq-r': { model: 'R08CPU', modelCode: 0x4801, profile: 'iq-r' },
        'iq-f': { modelCode: 0x4a21, profile: 'iq-f' },
        q: { model: 'Q03UDVCPU', modelCode: 0x0366, profile: 'q' },
        l: { model: 'L02CPU', modelCode: 0x0541, profile: 'l' },
        fx3: { modelCode: 0xf3 },
        generic: { modelCode: 0x4801, profile: 'iq-r' },
      }
      const identity = await client.identify()
      expect(identity).toMatchObject(expected[profile] as object)
      expect(identity.models).toContain(identity.model)
      expect(identity.model).toBe(identity.model.trim())
    }))

  test('self test returns what was sent, up to 960 characters', () =>
    withLine(text, {}, async ({ plc, client }) => {
      for (const data of [undefined, '0', 'ABCDEF0123456789', 'A5'.repeat(480)]) {
        const { roundTrip } = await client.selfTest(data)
        expect(roundTrip).toBeGreaterThan(0)
      }
      const { requests } = plc.statistics
      for (const data of ['', 'abc', 'XYZ', 'A'.repeat(961)]) {
        expect(await failureOf(client.selfTest(data))).toMatchObject({ code: 'BAD_MESSAGE', outcome: 'notSent' })
      }
      expect(plc.statistics.requests).toBe(requests)
    }))

  test('self test: what comes back otherwise breaks the protocol, and the connection is made anew', () =>
    withLine(text, {}, async ({ plc, another, transport }) => {
      const wrong = (bytes: Buffer) => Buffer.from(bytes.toString('latin1').replace('ABCD', 'ABCE'), 'latin1')
      const inner = plc.connect({ kind: transport === 'udp' ? 'datagram' : 'stream' })
      const openTransport: OpenTransport = () => {
        const carried = inner()
        return {
          kind: carried.kind,
          description: carried.description,
          open: (told) => carried.open({ ...told, received: (bytes) => told.received(wrong(bytes)) }),
          send: (bytes) => carried.send(bytes),
          renew: () => carried.renew(),
          renewable: carried.renewable,
          get ready() {
            return carried.ready
          },
          close: () => carried.close(),
        }
      }
      const damaged = another({ openTransport })
      await damaged.selfTest('0123')
      const error = await failureOf(damaged.selfTest('ABCD'))
      expect(error).toMatchObject({ name: 'ProtocolError', code: 'ECHO_MISMATCH', outcome: 'unknown' })
      await damaged.selfTest('0123')
      expect(damaged.statistics).toMatchObject({ protocolErrors: 1, disconnects: 1, connects: 2 })
    }))

  test('clear error turns the error LED off', () =>
    withLine(text, {}, async ({ plc, client }) => {
      await failureOf(client.read('D999999'))
      expect(plc.errors.led).toBe(true)
      await client.clearError()
      expect(plc.errors.led).toBe(false)
    }))

  test('latch clear needs STOP, and clears what is latched', () =>
    withLine(text, {}, async ({ plc, client }) => {
      plc.write('R5', 5)
      plc.write('D5', 6)
      expect(await endCodeOf(client.control.latchClear())).toBe(NOT_IN_STOP)
      expect(plc.read('R5')).toBe(5)
      await client.control.stop()
      await client.control.latchClear()
      expect([plc.read('R5'), plc.read('D5')]).toEqual([0, 0])
      plc.write('R5', 5)
      await client.control.latchClear({ value: 0 })
      expect(plc.read('R5')).toBe(0)
    }))
})

describe.each(links)('two clients over %s', (text) => {
  test('who stopped the CPU lets it run; another one only by force', () =>
    withLine(text, { plc: { remoteOwner: 'connection' } }, async ({ plc, client, another, frame, transport }) => {
      // Without serial numbers each UDP request comes from another port: by connection everybody is another device.
      if (transport === 'udp' && frame === '3E') return
      const other = another()
      await client.control.stop()
      expect(await endCodeOf(other.control.run())).toBe(REMOTE)
      expect(await endCodeOf(other.control.pause())).toBe(REMOTE)
      expect(await endCodeOf(other.control.latchClear())).toBe(REMOTE)
      expect(plc.cpu.state).toBe('STOP')
      // A second STOP does not take the first one's right away.
      await other.control.stop()
      await client.control.run()
      expect(plc.cpu.state).toBe('RUN')
      await client.control.pause()
      await other.control.run({ force: true })
      expect([plc.cpu.state, plc.cpu.hold]).toEqual(['RUN', undefined])
      await client.control.stop()
      await other.control.pause({ force: true })
      expect(plc.cpu.state).toBe('PAUSE')
    }))

  test('of one computer are one device to the PLC', () =>
    withLine(text, {}, async ({ plc, client, another }) => {
      await client.control.stop()
      await another().control.run()
      expect(plc.cpu.state).toBe('RUN')
    }))
})

describe.each(links)('reset over %s', (text) => {
  const allowed = { plc: { resetAllowed: true, restartTime: 20 }, client: { timeout: 400 } } as const

  test('is refused unless the parameter permits it and the CPU is in STOP', () =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.control.stop()
      expect(await endCodeOf(client.control.reset())).toBe(REMOTE)
      expect(plc.cpu.state).toBe('STOP')
    }))

  test('is refused while the CPU is in RUN', () =>
    withLine(text, allowed, async ({ plc, client }) => {
      const { requests } = plc.statistics
      expect(await endCodeOf(client.control.reset())).toBe(NOT_IN_STOP)
      expect(plc.cpu.state).toBe('RUN')
      expect(plc.statistics.requests).toBeGreaterThan(requests)
    }))

  test('succeeds by silence, is sent once, and the client comes back by itself', () =>
    withLine(text, allowed, async ({ plc, client }) => {
      plc.write('D0', 5)
      plc.write('R0', 6)
      await client.control.stop()
      const resets: unknown[] = []
      plc.on('request', ({ command }) => {
        if (command === 'remoteReset') resets.push(command)
      })
      const up = restarted(plc)
      await client.control.reset()
      await up
      await nextState(client, 'connected')
      expect([plc.cpu.state, plc.cpu.hold]).toEqual(['RUN', undefined])
      expect(resets).toHaveLength(1)
      expect(await client.readValues(['D0', 'R0'], ample)).toEqual([0, 6])
    }))

  test('a reset that was not received is not taken for a success when the PLC cannot be reached at all', () =>
    withLine(text, { ...allowed, client: { timeout: 300, connectTimeout: 300 } }, async ({ plc, client }) => {
      await plc.close()
      const error = await failureOf(client.control.reset())
      expect(error.outcome).not.toBe('refused')
      expect(['CONNECT_FAILED', 'OFFLINE', 'TIMEOUT', 'SILENT', 'DISCONNECTED']).toContain(error.code)
    }))
})

describe('RUN', () => {
  test('clears devices as it is told', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      const devices = () => [plc.read('D0'), plc.read('R0')]
      const set = async () => {
        await client.control.stop()
        plc.write('D0', 1)
        plc.write('R0', 2)
      }
      await set()
      await client.control.run({ clear: 'keep' })
      expect(devices()).toEqual([1, 2])
      await set()
      await client.control.run({ clear: 'exceptLatched' })
      expect(devices()).toEqual([0, 2])
      await set()
      await client.control.run({ clear: 'all' })
      expect(devices()).toEqual([0, 0])
    }))

  test('does not clear where the family cannot, and nothing is sent', () =>
    withLine('tcp 3E binary iq-f', {}, async ({ plc, client }) => {
      await client.control.stop()
      const { requests } = plc.statistics
      for (const clear of ['exceptLatched', 'all'] as const) {
        expect(await failureOf(client.control.run({ clear }))).toMatchObject({
          code: 'UNSUPPORTED',
          outcome: 'notSent',
        })
      }
      expect(await failureOf(client.control.run({ clear: 'some' as 'all' }))).toMatchObject({ code: 'BAD_OPTION' })
      expect(await failureOf(client.control.run({ force: 1 as unknown as true }))).toMatchObject({ code: 'BAD_OPTION' })
      expect(plc.statistics.requests).toBe(requests)
      expect(plc.cpu.state).toBe('STOP')
    }))

  test('completes with the switch at STOP, but the CPU stays in STOP', () =>
    withLine('udp 4E binary iq-r', {}, async ({ plc, client }) => {
      plc.cpu.switch = 'STOP'
      await client.control.run()
      expect(plc.cpu.state).toBe('STOP')
    }))

  test.each(links)('with an unknown outcome is never repeated over %s', (text) =>
    withLine(text, { client: { timeout: 200 } }, async ({ plc, client }) => {
      await client.connect()
      let stops = 0
      plc.on('request', ({ command }) => {
        if (command === 'remoteStop') stops++
      })
      plc.faults.add({ kind: 'drop', commands: ['remoteStop'], times: 1 })
      expect(await failureOf(client.control.stop())).toMatchObject({ code: 'TIMEOUT', outcome: 'unknown' })
      await nextState(client, 'connected')
      await client.read('D0', ample)
      await until(() => plc.cpu.state === 'STOP')
      expect(stops).toBe(1)
    }),
  )
})

test('identify of a CPU that refuses to say it is an end code, and the connection lives', () =>
  withLine('tcp 3E binary q', {}, async ({ plc, client }) => {
    plc.faults.add({ kind: 'endCode', endCode: 0xc059, commands: ['readTypeName'] })
    expect(await endCodeOf(client.identify())).toBe(0xc059)
    expect(await client.read('D0')).toBe(0)
    expect(client.statistics.connects).toBe(1)
  }))

test('a refusal tells what it means, the likely cause for this command, and what to do', () =>
  withLine('tcp 3E binary q', {}, async ({ plc, client }) => {
    plc.faults.add({ kind: 'endCode', endCode: 0xc059, commands: ['readTypeName'] })
    const error = (await failureOf(client.identify())) as EndCodeError
    const {
      meaning = '',
      cause = '',
      remedy = '',
    } = explainEndCode(0xc059, { family: 'slmp', command: 'readTypeName' }) ?? {}
    expect(cause).toContain('E71')
    expect(error).toMatchObject({ meaning: `${meaning} ${cause}`, remedy })
    expect(error.message).toContain(`${meaning} ${cause} ${remedy}`)
  }))

test('a refusal with a code that nobody knows passes the number on, without a text', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    plc.faults.add({ kind: 'endCode', endCode: 0x9999, commands: ['readTypeName'] })
    const error = (await failureOf(client.identify())) as EndCodeError
    expect(error).toMatchObject({ endCode: 0x9999, meaning: undefined, remedy: undefined })
    expect(error.message).toContain('end code 9999: No text is known for this code.')
  }))

test('a model that nobody knows is given as it is', () =>
  withLine('tcp 4E binary iq-r', { plc: { model: { name: 'X99CPU', code: 0x7777 } } }, async ({ client }) => {
    expect(await client.identify()).toEqual({ model: 'X99CPU', modelCode: 0x7777, models: [] })
  }))

describe('an inverter that is said to number W in decimal', () => {
  const inverter = { model: { name: 'FR-E800-E', code: 0x054f } }

  test('is warned of where the client writes W in hexadecimal', () =>
    withLine('tcp 3E binary generic', { plc: inverter }, async ({ client }) => {
      const { model, warning } = await client.identify()
      expect(model).toBe('FR-E800-E')
      expect(warning).toMatchObject({ code: 'W_RADIX', message: expect.stringContaining('Set wRadix to 10') })
    }))

  test.each([{ wRadix: 10 }, { profileOverrides: { wRadix: 10 } }] as const)('and not with %j', (how) =>
    withLine('tcp 3E binary generic', { plc: inverter, client: how }, async ({ client }) => {
      expect(await client.identify()).toEqual({ model: 'FR-E800-E', modelCode: 0x054f, models: [] })
    }),
  )
})

test('commands of control by request() do the same', () =>
  withLine('tcp 4E ascii iq-r', {}, async ({ plc, client }) => {
    await client.request(commands.remoteStop, {})
    expect(plc.cpu.state).toBe('STOP')
    await client.request(commands.remoteRun, { mode: 3, clearMode: 0 })
    expect(plc.cpu.state).toBe('RUN')
    expect(await failureOf(client.request(commands.remoteRun, { mode: 2 }))).toMatchObject({ code: 'BAD_MESSAGE' })
  }))
