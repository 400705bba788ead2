/** The trace of a client: frames as they went through real sockets, in words. */
import { describe, expect, jest, test } from '@jest/globals'
import type { TraceEntry } from '../../src/index'
import { ample, failureOf, kinds, nextState, withLine } from './line'

function collect(client: { on(event: 'trace', listener: (entry: TraceEntry) => void): () => void }) {
  const entries: TraceEntry[] = []
  const stop = client.on('trace', (entry) => entries.push(entry))
  return { entries, stop }
}

describe.each(kinds)('over %s', (text) => {
  test('request and answer are explained, with their values', () =>
    withLine(text, {}, async ({ plc, client }) => {
      plc.write('D100', 1234)
      await client.connect()
      const { entries, stop } = collect(client)
      await client.read('D100')
      expect(entries.map(({ direction }) => direction)).toEqual(['sent', 'received'])
      const [sent, received] = entries
      expect(sent?.text).toContain('Read (word units)')
      expect(sent?.text).toContain('D100')
      expect(received?.text).toContain('1234')
      expect(sent?.frames).toHaveLength(1)
      expect(received?.frames).toHaveLength(1)
      for (const { time } of entries) expect(Math.abs(Date.now() - time)).toBeLessThan(60_000)
      await client.write('D100', 77)
      expect(entries.at(-2)?.text).toContain('77')
      stop()
      const count = entries.length
      await client.read('D100')
      expect(entries).toHaveLength(count)
    }))

  test('the bytes are those of the statistics, from the first on', () =>
    withLine(text, {}, async ({ client }) => {
      const { entries } = collect(client)
      await client.readValues(['D0', 'M0'])
      await failureOf(client.read('D999999'))
      const bytes = (direction: string) =>
        entries.filter((entry) => entry.direction === direction).reduce((sum, entry) => sum + entry.bytes.length, 0)
      expect([bytes('sent'), bytes('received')]).toEqual([client.statistics.bytesSent, client.statistics.bytesReceived])
      expect(entries.at(-1)?.text).toMatch(/4031|C056/)
    }))
})

describe('X and Y', () => {
  test.each([
    ['tcp 3E binary iq-f', {}, {}],
    ['tcp 3E ascii iq-f', { asciiXy: 'octal' }, { asciiXy: 'octal' }],
    ['tcp 3E ascii iq-f', { asciiXy: 'hexadecimal' }, { asciiXy: 'hexadecimal' }],
  ] as const)('of an iQ-F are shown in octal, as they are written (%s, %j)', (text, plc, client) =>
    withLine(text, { plc, client }, async (line) => {
      await line.client.connect()
      const { entries } = collect(line.client)
      await line.client.write('Y17', true)
      expect(line.plc.memory.bit('Y', 15)).toBe(true)
      expect(entries[0]?.text).toContain('Y17')
    }),
  )

  test('with xyRadix 16 are shown in hexadecimal', () =>
    withLine('tcp 3E binary iq-f', { client: { xyRadix: 16 } }, async ({ client }) => {
      await client.connect()
      const { entries } = collect(client)
      await client.write('Y1F', true)
      expect(entries[0]?.text).toContain('Y1F')
    }))

  test.each(['decimal', 'hexadecimal'] as const)('and ZR in ASCII code with %s digits', (asciiZr) =>
    withLine('tcp 4E ascii iq-r', { plc: { asciiZr }, client: { asciiZr } }, async ({ client }) => {
      await client.connect()
      const { entries } = collect(client)
      await client.read('ZR4096')
      expect(entries[0]?.text).toContain('ZR4096')
    }),
  )
})

test('a monitor is explained with its registration', () =>
  withLine('tcp 4E binary iq-r', { plc: { latch: ['D'] } }, async ({ plc, client }) => {
    plc.write('D7', 4321)
    await client.connect()
    const monitor = client.monitor(['D7'])
    await monitor.read()
    const { entries } = collect(client)
    await monitor.read()
    expect(entries.map(({ direction }) => direction)).toEqual(['sent', 'received'])
    expect(entries[0]?.text).toContain('Execute Monitor')
    const watched = collect(client)
    plc.restart(0)
    await nextState(client, 'waiting')
    await nextState(client, 'connected')
    await monitor.read()
    expect(watched.entries.map((entry) => entry.text).join('\n')).toContain('Entry Monitor Device')
    expect(watched.entries.at(-1)?.text).toContain('4321')
  }))

test('an answer in pieces is explained where it ends, and not across a lost connection', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    plc.write('D0', 1234)
    await client.connect()
    const { entries } = collect(client)
    plc.faults.add({ kind: 'split', at: 9, times: 1 })
    await client.read('D0')
    expect(entries.map(({ direction }) => direction)).toEqual(['sent', 'received', 'received'])
    expect(entries[1]?.text).toContain('later chunk')
    expect(entries[2]?.text).toContain('1234')
    plc.faults.add({ kind: 'disconnect', at: 9, times: 1, how: 'close' })
    await failureOf(client.read('D0'))
    await nextState(client, 'connected')
    entries.length = 0
    plc.write('D0', 77)
    await client.read('D0')
    const received = entries.filter(({ direction }) => direction === 'received')
    expect(received.at(-1)?.frames).toHaveLength(1)
    expect(received.at(-1)?.text).toContain('77')
  }))

test('over UDP a piece of a datagram is not put before the next one', () =>
  withLine('udp 4E binary iq-r', { client: { timeout: 150 } }, async ({ plc, client }) => {
    plc.write('D0', 1234)
    await client.connect()
    const { entries } = collect(client)
    plc.faults.add({ kind: 'cut', at: 9, times: 1 })
    await failureOf(client.read('D0'))
    await nextState(client, 'connected')
    await client.read('D0', ample)
    expect(entries.at(-1)?.frames).toHaveLength(1)
    expect(entries.at(-1)?.text).toContain('1234')
  }))

test('a listener that throws does not disturb the connection or the other listeners', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
    const warned = jest.spyOn(process, 'emitWarning').mockReturnValue()
    const stop = client.on('trace', () => {
      throw new Error('a mistake')
    })
    const { entries } = collect(client)
    expect(await client.read('D0')).toBe(0)
    expect(entries.length).toBeGreaterThanOrEqual(4)
    expect(warned).toHaveBeenCalledWith(expect.stringContaining('a mistake'), expect.anything())
    warned.mockRestore()
    stop()
  }))
