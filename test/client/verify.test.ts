/** Remote control that is read back: `verify`, through sockets. */
import { describe, expect, test } from '@jest/globals'
import { type Control, VerifyError } from '../../src/index'
import { failureOf, kinds, links, withLine } from './line'

const soon = { verify: true, timeout: 400 } as const
/** Kinds whose profile knows where the state is. */
const known = kinds.filter((text) => !text.endsWith('generic'))

describe.each(known)('over %s', (text) => {
  test('ends when the CPU is in the state', () =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.control.stop({ verify: true })
      expect(plc.cpu.state).toBe('STOP')
      await client.control.run({ verify: true })
      expect(plc.cpu.state).toBe('RUN')
      await client.control.pause({ verify: true })
      expect(plc.cpu.state).toBe('PAUSE')
      await client.control.run({ verify: true, force: true })
      expect(plc.cpu.state).toBe('RUN')
    }))

  test('RUN with the switch at STOP says so, after it was carried out once', () =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.connect()
      plc.cpu.switch = 'STOP'
      const runs: unknown[] = []
      plc.on('request', ({ command }) => command === 'remoteRun' && runs.push(command))
      const error = await failureOf(client.control.run(soon))
      expect(error).toBeInstanceOf(VerifyError)
      expect(error).toMatchObject({ code: 'NOT_VERIFIED', outcome: 'unknown', state: 'STOP' })
      expect(error.message).toContain('Remote Run was carried out, but the CPU is in STOP, not in RUN')
      expect(error.message).toContain('its RUN/STOP switch is at STOP')
      expect(runs).toHaveLength(1)
      expect(await client.read('SD203')).toBe(2)
      expect(client.statistics.connects).toBe(1)
    }))
})

test('waits for a CPU that takes its time, with a bounded number of reads', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    plc.cpu.switch = 'STOP'
    let reads = 0
    plc.on('request', ({ command }) => {
      if (command === 'readWords' && ++reads === 3) plc.cpu.switch = 'RUN'
    })
    await client.control.run({ verify: true })
    expect(plc.cpu.state).toBe('RUN')
    expect(reads).toBeLessThanOrEqual(4)
  }))

test('PAUSE with the switch at STOP completes and is told, too', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    plc.cpu.switch = 'STOP'
    expect(await failureOf(client.control.pause(soon))).toMatchObject({ code: 'NOT_VERIFIED', state: 'STOP' })
    await client.control.stop(soon)
  }))

test('another device that stops it again is named as a remote operation', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    await client.control.stop()
    plc.on('state', ({ state }) => {
      if (state === 'RUN') queueMicrotask(() => plc.cpu.stop('somebody else'))
    })
    const error = await failureOf(client.control.run({ verify: true, timeout: 300 }))
    expect(error).toMatchObject({ code: 'NOT_VERIFIED', state: 'STOP' })
    expect(error.message).toContain('a remote operation holds it')
  }))

test.each(links)('a refused command is not read back over %s', (text) =>
  withLine(text, { plc: { remoteOwner: 'connection' } }, async ({ plc, client, another, frame, transport }) => {
    if (transport === 'udp' && frame === '3E') return
    await client.control.stop({ verify: true })
    const other = another()
    await other.connect()
    let reads = 0
    plc.on('request', ({ command }) => {
      if (command === 'readWords') reads++
    })
    expect(await failureOf(other.control.run({ verify: true }))).toMatchObject({ code: 'END_CODE', outcome: 'refused' })
    expect(reads).toBe(0)
  }),
)

test('a state that cannot be read is told as such, with the reason', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    plc.faults.add({ kind: 'endCode', endCode: 0x4031, commands: ['readWords'] })
    const error = await failureOf(client.control.stop({ verify: true }))
    expect(error).toMatchObject({ code: 'NOT_VERIFIED', state: undefined, cause: { code: 'END_CODE' } })
    expect(error.message).toContain('Remote Stop was carried out, but')
    expect(plc.cpu.state).toBe('STOP')
  }))

describe('refused before anything is sent', () => {
  const calls: readonly ((control: Control) => Promise<void>)[] = [
    (control) => control.run({ verify: true }),
    (control) => control.stop({ verify: true }),
  ]
  test.each(['tcp 3E binary generic', 'tcp 1E binary fx3', 'udp 1E ascii iq-f', 'tcp 4E binary remote-head'])(
    'over %s, where the state is not known or not within reach',
    (text) =>
      withLine(text, {}, async ({ plc, client }) => {
        for (const call of calls) {
          const error = await failureOf(call(client.control))
          expect(error).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent', field: 'verify' })
          expect(error.message).toContain('Leave verify out')
        }
        expect(client.control.verifiable).toBe(false)
        expect(plc.statistics.requests).toBe(0)
        await client.control.stop()
        expect(plc.cpu.state).toBe('STOP')
        await client.control.run()
        expect(plc.cpu.state).toBe('RUN')
      }),
  )

  test('and what is neither true nor false', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      const verify = 'yes' as unknown as true
      for (const call of [
        client.control.run({ verify }),
        client.control.stop({ verify }),
        client.control.pause({ verify }),
      ])
        expect(await failureOf(call)).toMatchObject({ code: 'BAD_OPTION', field: 'verify' })
      expect(plc.statistics.requests).toBe(0)
    }))
})
