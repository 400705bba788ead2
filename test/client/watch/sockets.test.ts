/** Watches of both families through real sockets. */
import { describe, expect, test } from '@jest/globals'
import { createPlcSimulator } from '../../../src/entry/simulator'
import { createMelsecClient, type WatchGap } from '../../../src/index'
import { onSockets, SmallJw } from '../jw/small-jw'
import { clientOptions, kind, until, withLine } from '../line'

const ITEMS = { level: 'D100:REAL', running: 'M10', text: 'D200:STRING(4)' } as const

describe.each(['tcp 3E binary iq-r', 'udp 4E ascii iq-r', 'tcp 3E binary iq-f'])('%s', (text) => {
  test('values come typed by their names, and what changes in the PLC is told', () =>
    withLine(text, {}, async ({ plc, client }) => {
      plc.write('D100:REAL', 1.5)
      plc.write('D200:STRING(4)', 'abcd')
      let changes = 0
      for await (const { values, changed } of client.watch(ITEMS, { every: 10 })) {
        const { level, running } = values
        if (changes === 0) {
          expect(changed).toEqual(['level', 'running', 'text'])
          expect([level.value, running.value, values.text.value]).toEqual([1.5, false, 'abcd'])
          plc.write('D100:REAL', 2.5)
        }
        if (changes === 1) {
          expect([changed, level.quality === 'good' && level.value.toFixed(1)]).toEqual([['level'], '2.5'])
          plc.write('M10', true)
        }
        if (changes === 2) {
          expect([changed, running.value]).toEqual([['running'], true])
          break
        }
        changes += 1
      }
      const { requests } = plc.statistics
      await client.read('D0')
      expect(plc.statistics.requests).toBe(requests + 1)
    }))

  test('an item that the PLC refuses does not disturb the others, and costs no requests after a while', () =>
    withLine(text, {}, async ({ client }) => {
      let demoted: readonly string[] = []
      const onChange = (update: { demoted: readonly string[] }) => {
        demoted = update.demoted
      }
      const watch = client.watch({ level: 'D100:REAL', missing: 'D999999' }, { every: 10, demoteAfter: 2, onChange })
      await until(() => demoted.includes('missing') || watch.values.missing.error?.code === 'BAD_ADDRESS')
      expect(watch.values).toMatchObject({ level: { quality: 'good' }, missing: { quality: 'bad' } })
      await watch.close()
    }))

  test('after a reconnect the values are read at once, and the gap is told', () =>
    withLine(text, { client: { timeout: 200 } }, async ({ plc, client }) => {
      plc.write('D100:REAL', 1)
      let gap: WatchGap | undefined
      const onChange = (update: { gap?: WatchGap }) => {
        gap ??= update.gap
      }
      const watch = client.watch(ITEMS, { every: 10, onChange })
      await until(() => watch.values.level.quality === 'good')
      const silent = plc.faults.add({ kind: 'silence' })
      await until(() => watch.values.level.quality === 'bad')
      expect(watch.values.level.value).toBe(1)
      plc.write('D100:REAL', 2)
      silent.remove()
      await until(() => watch.values.level.quality === 'good')
      expect(watch.values.level.value).toBe(2)
      expect(gap?.scans).toBeGreaterThan(0)
      expect(Number(gap?.to)).toBeGreaterThan(Number(gap?.from))
    }))
})

test('a PLC that was switched off is watched again when it is back, also what is read once an hour', async () => {
  const first = createPlcSimulator({ profile: 'iq-r' })
  await first.listen()
  first.write('D100:REAL', 1)
  const client = createMelsecClient(clientOptions(kind('tcp 3E binary iq-r'), first))
  let gap: WatchGap | undefined
  const onChange = (update: { gap?: WatchGap }) => {
    gap ??= update.gap
  }
  const watch = client.watch(ITEMS, { every: 3_600_000, onChange })
  await until(() => watch.values.level.quality === 'good')
  const port = first.tcp?.port ?? 0
  await first.close()
  await until(() => watch.values.level.quality === 'bad')
  expect([watch.values.level.value, watch.values.level.stale]).toEqual([1, true])
  const second = createPlcSimulator({ profile: 'iq-r', tcp: { port } })
  second.write('D100:REAL', 2)
  await second.listen()
  await until(() => watch.values.level.quality === 'good')
  expect(watch.values.level.value).toBe(2)
  expect(gap).toMatchObject({ scans: 1 })
  await client.close()
  await second.close()
})

test('scans come to their turn beside writes without end, and the writes beside them', () =>
  withLine('tcp 3E binary iq-r', {}, async ({ plc, client }) => {
    plc.faults.add({ kind: 'delay', ms: 1 })
    const watch = client.watch({ level: 'D100' }, { every: 20, tell: 'scans', onChange: () => {} })
    let written = 0
    let goesOn = true
    const writer = async (device: number) => {
      for (let i = 0; goesOn; i++) {
        await client.write(`D${device}`, i % 100)
        written += 1
      }
    }
    const writers = Array.from({ length: 20 }, (_, i) => writer(1000 + i))
    await until(() => watch.statistics.scans > 10 && written > 100)
    goesOn = false
    await Promise.all(writers)
    expect(watch.values.level.quality).toBe('good')
  }))

test('clients that are made and closed with their watches leave no connection and no request behind', () =>
  withLine('tcp 3E binary iq-r', {}, async ({ plc, another }) => {
    for (let i = 0; i < 30; i++) {
      const client = another()
      const watch = client.watch(ITEMS, { every: 10 })
      if (i % 3 > 0) await watch.next()
      if (i % 3 === 1) await watch.close()
      await client.close()
      expect(watch.isClosed).toBe(true)
    }
    await until(() => plc.connections.length === 0)
    const { requests } = plc.statistics
    await new Promise((resolve) => setImmediate(resolve))
    expect(plc.statistics.requests).toBe(requests)
  }))

test('a Sharp JW is watched by the same code', () =>
  onSockets('tcp', { allowWrites: true }, new SmallJw(), async (client) => {
    await client.write('09012:INT', 5)
    const seen: (number | undefined)[] = []
    for await (const { values } of client.watch({ level: '09012:INT', running: '04033' }, { every: 10 })) {
      seen.push(values.level.value)
      if (seen.length === 2) break
      await client.write('09012:INT', -6)
    }
    expect(seen).toEqual([5, -6])
  }))
