/** A request that belongs to one connection is sent on none but that: what the PLC remembered of it is gone. */
import { describe, expect, test } from '@jest/globals'
import { Bench } from './bench'
import { replying } from './scripted-plc'

describe.each(['3E', '4E'] as const)('%s', (frame) => {
  test('one that waits for its turn is given up with the connection, and not kept for the next', async () => {
    const bench = await Bench.connected({ frame })
    bench.plc.script = ({ peer }) => {
      bench.plc.script = replying
      peer.reset()
    }
    const onlyOn = bench.connection.generation
    const [inFlight, bound, free] = [bench.read(1), bench.read(2, { onlyOn }), bench.read(3)]
    await bench.settle()
    expect([inFlight.told, bound.told, free.told]).toEqual(['DISCONNECTED unknown', 'DISCONNECTED notSent', 'pending'])
    expect(bench.state).not.toBe('connected')
    await bench.pass(60_000)
    // What belongs to no connection waits for the next one.
    expect(free.told).toEqual({ values: [3] })
    expect(bench.plc.asked).toEqual(['readWords 1', 'readWords 3'])
  })

  test('one of an earlier connection is not sent on this one, nor kept while there is none', async () => {
    const bench = await Bench.connected({ frame })
    const onlyOn = bench.connection.generation
    bench.plc.peers[0]?.reset()
    await bench.settle()
    expect(bench.state).not.toBe('connected')
    const early = bench.read(1, { onlyOn })
    await bench.pass(60_000)
    expect(bench.state).toBe('connected')
    const late = bench.read(2, { onlyOn })
    const own = bench.read(3, { onlyOn: bench.connection.generation })
    await bench.settle()
    expect([early.told, late.told]).toEqual(['DISCONNECTED notSent', 'DISCONNECTED notSent'])
    expect(own.told).toEqual({ values: [3] })
    expect(bench.plc.asked).toEqual(['readWords 3'])
  })
})
