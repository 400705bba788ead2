import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { type Fault, faultKinds } from '../../src/simulator/simulator'
import { manualClock } from '../support/manual-clock'
import { settle } from '../transport/recorder'
import { done, type Protocol, readD, refused, until, withClient, word, writeD } from './wire'

const PROTOCOLS: readonly Protocol[] = ['tcp', 'udp']

/** Sizes of the chunks or datagrams, joined where TCP may have joined them. */
function sizes(chunks: readonly Buffer[]): number[] {
  return chunks.map(({ length }) => length)
}

describe.each(PROTOCOLS)('over %s', (protocol) => {
  test('silence: the request is not carried out and not answered', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'silence', times: 1 })
      transport.send(writeD(0, 1, 1))
      transport.send(readD(0, 2))
      expect(await bytes(17)).toEqual(word(0, 2))
    }))

  test('drop: the request is carried out and not answered', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'drop', times: 1 })
      transport.send(writeD(0, 1, 1))
      transport.send(readD(0, 2))
      expect(await bytes(17)).toEqual(word(1, 2))
    }))

  test('delay: carried out at once, answered so much later', () => {
    const clock = manualClock()
    return withClient(protocol, { clock }, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'delay', ms: 900 })
      const written = new Promise<void>((resolve) => plc.on('write', () => resolve()))
      transport.send(writeD(0, 1, 1))
      await written
      clock.advance(899)
      await settle()
      expect([plc.read('D0'), chunks]).toEqual([1, []])
      clock.advance(1)
      expect(await bytes(15)).toEqual(done(1))
    })
  })

  test('late: the answer comes when the next request does, before its answer', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.write('D1', 1)
      plc.write('D2', 2)
      plc.faults.add({ kind: 'late', times: 1 })
      transport.send(readD(1))
      transport.send(readD(2))
      expect(await bytes(26)).toEqual(Buffer.concat([word(1), word(2)]))
    }))

  test('late until the answer: two answers in the other order', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.write('D1', 1)
      plc.write('D2', 2)
      plc.faults.add({ kind: 'late', until: 'answer', times: 1 })
      transport.send(readD(1, 1))
      transport.send(readD(2, 2))
      expect(await bytes(34)).toEqual(Buffer.concat([word(2, 2), word(1, 1)]))
    }))

  test('duplicate: the answer comes twice, or more often', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'duplicate', times: 1 })
      plc.faults.add({ kind: 'duplicate', copies: 2, times: 1 })
      transport.send(readD(0))
      expect(await bytes(26)).toEqual(Buffer.concat([word(0), word(0)]))
      transport.send(readD(0))
      expect(await bytes(26 + 39)).toHaveLength(26 + 39)
    }))

  test('merge with a duplicate: one piece holds both', () =>
    withClient(protocol, {}, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'merge', times: 1 })
      plc.faults.add({ kind: 'duplicate', times: 1 })
      transport.send(readD(0, 7))
      expect(await bytes(34)).toEqual(Buffer.concat([word(0, 7), word(0, 7)]))
      expect(sizes(chunks)).toEqual([34])
    }))

  test('merge: two answers in one piece', () =>
    withClient(protocol, {}, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'merge', times: 2 })
      transport.send(readD(0, 1))
      await until(() => plc.statistics.answers >= 1)
      expect(chunks).toEqual([])
      transport.send(readD(0, 2))
      expect(await bytes(34)).toEqual(Buffer.concat([word(0, 1), word(0, 2)]))
      expect(sizes(chunks)).toEqual([34])
    }))

  test.each(Array.from({ length: 12 }, (_, i) => i + 1))('split after byte %i', (at) => {
    const clock = manualClock()
    return withClient(protocol, { clock }, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'split', at, pause: 3 })
      transport.send(readD(0))
      await bytes(at)
      clock.advance(3)
      expect(await bytes(13)).toEqual(word(0))
      expect(sizes(chunks)).toEqual([at, 13 - at])
    })
  })

  const damages: readonly (readonly [Fault, string])[] = [
    [{ kind: 'damaged', what: 'lost', at: 0 }, word(0).subarray(1).toString('hex')],
    [{ kind: 'damaged', what: 'lost', at: 99 }, word(0).subarray(0, 12).toString('hex')],
    [{ kind: 'damaged', what: 'doubled', at: 0 }, `d0${word(0).toString('hex')}`],
    [{ kind: 'damaged', what: 'doubled', at: 12 }, `${word(0).toString('hex')}00`],
    [{ kind: 'damaged', at: 11, mask: 0x81 }, word(0x81).toString('hex')],
  ]
  test.each(damages)('%o', (fault, expected) =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add(fault)
      transport.send(readD(0))
      expect((await bytes(expected.length / 2)).toString('hex')).toBe(expected)
    }),
  )

  test('noise: bytes of any value so much later, the same for the same seed', async () => {
    const heard: string[] = []
    for (const seed of [1, 1, 2]) {
      const clock = manualClock()
      await withClient(protocol, { clock }, async (plc, { transport, bytes }) => {
        plc.faults.add({ kind: 'noise', bytes: 4, ms: 50, seed })
        transport.send(readD(0))
        expect(await bytes(13)).toEqual(word(0))
        clock.advance(50)
        heard.push((await bytes(17)).subarray(13).toString('hex'))
      })
    }
    expect([heard[0] === heard[1], heard[0] === heard[2]]).toEqual([true, false])
  })

  test('dribble: byte by byte', () => {
    const clock = manualClock()
    return withClient(protocol, { clock }, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'dribble', pause: 1 })
      transport.send(readD(0))
      for (let at = 1; at <= 13; at++) {
        await bytes(at)
        clock.advance(1)
      }
      expect(sizes(chunks)).toEqual(new Array(13).fill(1))
      expect(Buffer.concat(chunks)).toEqual(word(0))
    })
  })

  test('cut: the rest never comes, the next answer does', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'cut', at: 5, times: 1 })
      transport.send(readD(0))
      expect(await bytes(5)).toEqual(word(0).subarray(0, 5))
      transport.send(readD(0))
      expect((await bytes(18)).subarray(5)).toEqual(word(0))
    }))

  test.each([
    ['before', (garbage: Buffer, answer: Buffer) => [garbage, answer]],
    ['after', (garbage: Buffer, answer: Buffer) => [answer, garbage]],
    ['instead', (garbage: Buffer) => [garbage]],
  ] as const)('garbage %s the answer', (place, expected) =>
    withClient(protocol, {}, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'garbage', bytes: 6, place })
      transport.send(readD(0))
      const parts = expected(Buffer.from('ff00a55aff00', 'hex'), word(0))
      const all = Buffer.concat(parts)
      expect(await bytes(all.length)).toEqual(all)
      expect(chunks).toHaveLength(protocol === 'udp' ? parts.length : 1)
    }),
  )

  test('wrong serial number, in 4E only', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'wrongSerial', add: 2, times: 1 })
      transport.send(readD(0))
      expect(await bytes(13)).toEqual(word(0))
      transport.send(readD(0, 0xffff))
      expect((await bytes(30)).subarray(13)).toEqual(word(0, 1))
    }))

  test('wrong route: network and station of the answer', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'wrongRoute', network: 3, station: 4 })
      transport.send(readD(0))
      expect(await bytes(13)).toEqual(Buffer.from('d0000304ff03000400 0000 0000'.replaceAll(' ', ''), 'hex'))
    }))

  test('end code for a command, so many times; the others are carried out', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      const fault = plc.faults.add({ kind: 'endCode', endCode: 0x4031, commands: ['writeWords'], times: 2 })
      const sent = [readD(0), writeD(0, 1), writeD(0, 1), writeD(0, 2), readD(0)]
      const no = refused(0x4031, undefined, '0114')
      const expected = Buffer.concat([word(0), no, no, done(), word(2)])
      for (const bytesOut of sent) transport.send(bytesOut)
      expect(await bytes(expected.length)).toEqual(expected)
      expect([fault.struck, plc.faults.active]).toEqual([2, []])
    }))

  test('short error information: what is left of it, with a length that says so', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'shortError', bytes: 4, times: 1 })
      plc.faults.add({ kind: 'shortError' })
      transport.send(readD(99999))
      expect(await bytes(15)).toEqual(Buffer.from('d00000ffff03000600314000ffff03', 'hex'))
      transport.send(readD(99999))
      expect((await bytes(26)).subarray(15)).toEqual(Buffer.from('d00000ffff030002003140', 'hex'))
    }))

  test('coalesce: of two requests that come together only the last is carried out and answered', () => {
    const clock = manualClock()
    return withClient(protocol, { clock }, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'coalesce', window: 10 })
      transport.send(writeD(0, 1, 1))
      transport.send(readD(0, 2))
      await until(() => plc.statistics.requests >= 2)
      clock.advance(10)
      expect(await bytes(17)).toEqual(word(0, 2))
      clock.advance(1000)
      await settle()
      expect([chunks.length, plc.statistics.discarded]).toEqual([1, 1])
    })
  })

  test('coalesce: a request alone is answered', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'coalesce' })
      for (const value of [1, 2]) {
        transport.send(writeD(0, value))
        await bytes(11 * value)
      }
      expect([plc.read('D0'), plc.statistics.discarded]).toEqual([2, 0])
    }))

  test('coalesce: while an answer is delayed, the next request takes its place', () => {
    const clock = manualClock()
    return withClient(protocol, { clock }, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'coalesce' })
      plc.faults.add({ kind: 'delay', ms: 100, times: 1 })
      transport.send(readD(0, 1))
      await until(() => plc.statistics.requests >= 1)
      clock.advance(50)
      transport.send(readD(0, 2))
      await until(() => plc.statistics.requests >= 2)
      clock.advance(200)
      expect(await bytes(17)).toEqual(word(0, 2))
    })
  })
})

describe('TCP only', () => {
  test.each([
    ['reset', 'DISCONNECTED'],
    ['close', undefined],
  ] as const)('disconnect within the answer by %s', (how, code) => {
    const clock = manualClock()
    return withClient('tcp', { clock }, async (plc, { transport, bytes, closed, chunks }) => {
      plc.faults.add({ kind: 'disconnect', at: 9, how })
      transport.send(writeD(0, 7))
      await bytes(9)
      clock.advance(100)
      expect((await closed)?.code).toBe(code)
      expect([Buffer.concat(chunks), plc.read('D0')]).toEqual([done().subarray(0, 9), 7])
    })
  })

  test('disconnect without a byte of the answer', () =>
    withClient('tcp', {}, async (plc, { transport, closed, chunks }) => {
      plc.faults.add({ kind: 'disconnect' })
      transport.send(readD(0))
      expect([(await closed)?.code, chunks]).toEqual(['DISCONNECTED', []])
    }))

  test('accepted and closed at once, so many times', () =>
    withClient('tcp', {}, async (plc, first, { client }) => {
      plc.faults.add({ kind: 'closeOnAccept', times: 2 })
      expect(await (await client('tcp')).closed).toBeUndefined()
      expect(await (await client('tcp')).closed).toBeUndefined()
      const last = await client('tcp')
      for (const { transport, bytes } of [first, last]) {
        transport.send(readD(0))
        expect(await bytes(13)).toEqual(word(0))
      }
      expect(plc.statistics.turnedAway).toBe(2)
    }))

  test('a delayed answer keeps those behind it waiting: the order stays', () =>
    withClient('tcp', {}, async (plc, { transport, bytes }) => {
      plc.faults.add({ kind: 'delay', ms: 5, times: 1 })
      for (const serial of [1, 2, 3]) transport.send(readD(0, serial))
      expect(await bytes(51)).toEqual(Buffer.concat([1, 2, 3].map((serial) => word(0, serial))))
    }))
})

describe('UDP only', () => {
  test('a late answer goes to the port that asked, when the next request comes from another', () =>
    withClient('udp', {}, async (plc, first, { client }) => {
      plc.write('D1', 1)
      plc.faults.add({ kind: 'late', times: 1 })
      first.transport.send(readD(1))
      await until(() => plc.statistics.requests >= 1)
      const second = await client('udp')
      second.transport.send(readD(2))
      expect([await first.bytes(13), await second.bytes(13)]).toEqual([word(1), word(0)])
    }))
})

describe('switches', () => {
  test('several work together: a delayed, duplicated answer in two pieces', () => {
    const clock = manualClock()
    return withClient('tcp', { clock }, async (plc, { transport, bytes, chunks }) => {
      plc.faults.add({ kind: 'delay', ms: 20 })
      plc.faults.add({ kind: 'duplicate' })
      plc.faults.add({ kind: 'split', at: 4, pause: 10 })
      plc.faults.add({ kind: 'wrongSerial' })
      transport.send(readD(0, 1))
      await until(() => plc.statistics.answers >= 1)
      clock.advance(20)
      expect(await bytes(4)).toEqual(word(0, 2).subarray(0, 4))
      clock.advance(20)
      expect(await bytes(34)).toEqual(Buffer.concat([word(0, 2), word(0, 2)]))
      expect(chunks[0]).toHaveLength(4)
    })
  })

  test('strike only the commands and requests they are for', () =>
    withClient('tcp', {}, async (plc, { transport, bytes }) => {
      const remotes = new Set<string>()
      plc.faults.add({
        kind: 'endCode',
        endCode: 1,
        when: ({ command, connection, remote }) => {
          remotes.add(`${connection} ${remote}`)
          return command === 'readWords'
        },
      })
      for (const bytesOut of [readD(0), writeD(0, 1)]) transport.send(bytesOut)
      expect(await bytes(31)).toEqual(Buffer.concat([refused(1), done()]))
      expect([...remotes]).toEqual([`1 ${plc.connections[0]?.remote}`])
    }))

  test('can be taken off one by one or all at once', () =>
    withClient('tcp', {}, async (plc, { transport, bytes }) => {
      const silence = plc.faults.add({ kind: 'silence' })
      plc.faults.add({ kind: 'endCode', endCode: 2 })
      plc.faults.add({ kind: 'duplicate' })
      expect(plc.faults.active.map(({ kind }) => kind)).toEqual(['silence', 'endCode', 'duplicate'])
      silence.remove()
      transport.send(readD(0))
      await bytes(40)
      plc.faults.clear()
      transport.send(readD(0))
      expect((await bytes(53)).subarray(40)).toEqual(word(0))
    }))

  test('the same switches give the same bytes every time', async () => {
    const runs: string[] = []
    for (let run = 0; run < 3; run++) {
      await withClient('tcp', {}, async (plc, { transport, bytes }) => {
        plc.faults.add({ kind: 'garbage', bytes: 5, times: 1 })
        plc.faults.add({ kind: 'wrongSerial', times: 2 })
        for (const serial of [1, 2, 3]) transport.send(readD(0, serial))
        runs.push((await bytes(56)).toString('hex'))
      })
    }
    expect(new Set(runs).size).toBe(1)
  })

  const wrong: readonly (readonly [string, unknown])[] = [
    ['kind', { kind: 'weather' }],
    ['delay.ms', { kind: 'delay' }],
    ['delay.ms', { kind: 'delay', ms: -1 }],
    ['split.at', { kind: 'split', at: 0 }],
    ['endCode.endCode', { kind: 'endCode', endCode: 0 }],
    ['endCode.endCode', { kind: 'endCode', endCode: 65536 }],
    ['garbage.place', { kind: 'garbage', place: 'middle' }],
    ['damaged.what', { kind: 'damaged', what: 'stolen' }],
    ['damaged.mask', { kind: 'damaged', mask: 256 }],
    ['noise.bytes', { kind: 'noise', bytes: 0 }],
    ['speed', { kind: 'dribble', speed: 1 }],
    ['times', { kind: 'drop', times: 0 }],
    ['commands', { kind: 'drop', commands: ['readEverything'] }],
    ['when', { kind: 'drop', when: 'always' }],
  ]
  test.each(wrong)('%s is refused', (field, fault) =>
    withClient('tcp', {}, async (plc) => {
      // What a JavaScript program or a file could give.
      const add = () => plc.faults.add(fault as Fault)
      expect(add).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field }))
      expect(add).toThrow(RequestError)
      expect(plc.faults.active).toEqual([])
    }),
  )

  test('every kind has a title and parameters with titles', () => {
    for (const { title, parameters } of Object.values(faultKinds)) {
      expect(title).not.toBe('')
      for (const parameter of Object.values(parameters)) expect(parameter).toHaveProperty('title')
    }
  })
})
