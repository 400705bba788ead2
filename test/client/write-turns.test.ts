/** A bit of a word is read, changed and written back: no other write of the same client may come between. */
import { expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import { failureOf, withLine } from './line'

const rmw = { readModifyWrite: true }

/** Slow enough that what is asked for at the same time would overtake. */
const slow = { kind: 'delay', ms: 10 } as const

test.each(['tcp 3E binary iq-r', 'udp 4E binary iq-r'])(
  'bits of one word, written at the same time, are all there: %s',
  (text) =>
    withLine(text, {}, async ({ plc, client }) => {
      await client.connect()
      plc.faults.add(slow)
      await Promise.all([0, 3, 4, 9, 15].map((bit) => client.write(`D100.${bit.toString(16)}`, true, rmw)))
      expect(plc.read('D100:WORD')).toBe(0b1000_0010_0001_1001)
    }),
)

test('a whole word that is written meanwhile is not undone, whichever way it is written', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    await client.connect()
    plc.faults.add(slow)
    const word = { device: 'D', number: 103 } as const
    await Promise.all([
      client.write('D101.0', true, rmw),
      client.write('D101', 500),
      client.write('D102', 600),
      client.write('D102.0', true, rmw),
      client.write('D103.0', true, rmw),
      client.request(commands.writeWords, { head: word, values: [700] }),
      client.write('D104.0', true, rmw),
      client.requestByName('writeWords', { head: 'D104', values: [800] }),
    ])
    // In the order of the calls.
    expect([101, 102, 103, 104].map((number) => plc.read(`D${number}`))).toEqual([500, 601, 700, 800])
  }))

test('reading does not wait for it, and one that fails lets the next one go on', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    await client.connect()
    plc.faults.add({ kind: 'silence', times: 1, commands: ['readWords'] } as never)
    const order: string[] = []
    const lost = client.write('D1.0', true, { ...rmw, timeout: 300 }).catch((error: Error) => order.push(error.name))
    const written = client.write('D1', 7).then(() => order.push('written'))
    await Promise.all([lost, written])
    expect(order.at(-1)).toBe('written')
    expect(plc.read('D1')).toBe(7)
  }))

test('who gives up waiting sends nothing, and holds nobody up', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    await client.connect()
    plc.faults.add({ kind: 'delay', ms: 150 })
    const first = client.write('D1.0', true, rmw)
    const error = await failureOf(client.write('D1.1', true, { ...rmw, timeout: 20 }))
    expect(error.outcome).toBe('notSent')
    await Promise.all([first, client.write('D1.2', true, rmw)])
    expect(plc.read('D1')).toBe(0b101)
  }))

test('what waited for the connection goes before what is written when it is told', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
    let second: Promise<void> | undefined
    client.on('state', ({ name }) => {
      if (name === 'connected') second = client.write('D0', 2)
    })
    await client.write('D0', 1)
    await second
    expect(plc.read('D0')).toBe(2)
  }))

test('a connection that a listener closes as it is told leaves nothing unsettled', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
    client.on('state', ({ name }) => {
      if (name === 'connected') void client.close()
    })
    expect((await failureOf(client.write('D0', 1))).code).toBe('CLOSED')
  }))

test('options of many values in the place of those of one are refused', () =>
  withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
    const write = client.write.bind(client) as (...given: unknown[]) => Promise<void>
    await expect(write({ D0: 1 }, undefined, { allOrNothing: true })).rejects.toMatchObject({ code: 'BAD_OPTION' })
  }))

test('a label behind a device that was not written is not written either: the order is kept', () =>
  withLine('tcp 4E binary iq-r', { plc: { labels: { Ready: { type: 'INT' } } } }, async ({ plc, client }) => {
    await client.connect()
    plc.faults.add({ kind: 'delay', ms: 250, times: 1, when: () => client.statistics.inFlight === 1 })
    const slow = client.read('D900').catch(() => {})
    const results = await client.writeEach(
      [
        { item: 'D100', value: 42 },
        { item: 'label:Ready', value: 1 },
      ],
      { timeout: 100 },
    )
    await slow
    expect(results.map((result) => !result.ok && result.error.outcome)).toEqual(['notSent', 'notSent'])
    expect([plc.read('D100'), await client.read('label:Ready')]).toEqual([0, 0])
  }))
