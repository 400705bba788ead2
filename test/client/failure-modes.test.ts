/**
 * The ways in which drivers of the field fail, as far as they concern the connection, over real sockets of this
 * computer: each a scenario in which other drivers returned wrong values, lost writes, or never came back.
 * What takes minutes or hours is in connection*.test.ts, in memory and with a clock made of numbers.
 */
import { createSocket } from 'node:dgram'
import { afterEach, describe, expect, test } from '@jest/globals'
import { EndCodeError, PlcError, ProtocolError } from '../../src/errors'
import { Loopback } from './loopback'
import { type Asked, silent } from './scripted-plc'

const transports = ['tcp', 'udp'] as const
const frames = ['3E', '4E'] as const
/** For requests that are going to stay without an answer, ms. All others have seconds. */
const SHORT = { timeout: 60 }

const open: Loopback[] = []
async function loopback(...given: Parameters<typeof Loopback.start>): Promise<Loopback> {
  const started = await Loopback.start(...given)
  open.push(started)
  return started
}
afterEach(async () => {
  for (const started of open.splice(0)) await started.end()
})

/** The value or the code of the error. */
async function outcome(reading: Promise<{ readonly values: readonly number[] }>): Promise<number | string> {
  try {
    return (await reading).values[0] as number
  } catch (error) {
    if (error instanceof PlcError) return error.code
    throw error
  }
}

describe.each(transports.flatMap((transport) => frames.map((frame) => ({ transport, frame }))))(
  '$transport $frame',
  ({ transport, frame }) => {
    const numbered = frame === '4E'

    describe('1: answers that come late, twice, or from elsewhere', () => {
      test('a late answer is never the value of the next read', async () => {
        const { plc, read } = await loopback(transport, frame)
        const late: Asked[] = []
        plc.script = (asked) => {
          if (asked.device === 200) {
            late.push(asked)
            return
          }
          // The late one arrives in front of the right one, as long as its way is still open.
          for (const one of late.splice(0)) one.reply()
          asked.reply()
        }
        expect(await outcome(read(100))).toBe(100)
        expect(await outcome(read(200, SHORT))).toBe('TIMEOUT')
        expect(await outcome(read(300))).toBe(300)
        expect(await outcome(read(400))).toBe(400)
      })

      test('two late answers are not either', async () => {
        const started = await loopback(transport, frame)
        const { plc, read } = started
        const late: Asked[] = []
        plc.script = (asked) => {
          if (late.length < 2) {
            late.push(asked)
            return
          }
          for (const one of late) one.reply()
          asked.reply()
        }
        expect(await outcome(read(200, SHORT))).toBe('TIMEOUT')
        expect(await outcome(read(201, SHORT))).toMatch(/TIMEOUT|OFFLINE/)
        for (const number of [300, 400]) {
          await started.reached('connected')
          expect([number, 'TIMEOUT']).toContain(await outcome(read(number, SHORT)))
        }
        await started.reached('connected')
        expect(await outcome(read(500))).toBe(500)
      })

      test('answers that come twice never shift those after them', async () => {
        const { plc, read } = await loopback(transport, frame)
        plc.script = (asked) => {
          asked.reply()
          asked.reply()
        }
        const found = await Promise.all(Array.from({ length: 20 }, (_, i) => outcome(read(i))))
        const right = found.filter((value, i) => value === i)
        if (numbered || transport === 'udp') expect(right).toHaveLength(20)
        // On a stream without numbers the second answer ends the connection: errors then, but no wrong value.
        else expect(found.filter((value, i) => typeof value === 'number' && value !== i)).toEqual([])
      })

      test('an answer of another station is refused', async () => {
        const { plc, read, framing } = await loopback(transport, frame)
        plc.script = ({ frame: { head, serial }, peer }) => {
          const other = { ...head, route: { ...head.route, station: 3 } }
          peer.send(framing.response.write(other, serial ?? 0, 0, Buffer.of(1, 0)))
        }
        expect(await outcome(read(100))).toBe('ECHO_MISMATCH')
      })
    })

    describe('2: requests that arrive together', () => {
      test('never happen: one at a time, with any number of callers and over a reconnection', async () => {
        const started = await loopback(transport, frame)
        const { plc, read } = started
        let unanswered = 0
        let most = 0
        let count = 0
        plc.script = (asked) => {
          unanswered += 1
          most = Math.max(most, unanswered)
          if (++count === 10 && transport === 'tcp') {
            unanswered = 0
            asked.peer.reset()
            return
          }
          setImmediate(() => {
            unanswered -= 1
            asked.reply()
          })
        }
        const ask = (from: number) => Promise.all(Array.from({ length: 30 }, (_, i) => outcome(read(from + i))))
        await ask(0)
        await started.reached('connected')
        expect(await ask(100)).toEqual(Array.from({ length: 30 }, (_, i) => 100 + i))
        expect(most).toBe(1)
      })
    })

    describe('4: a PLC that goes away', () => {
      test('and comes back is found again without anybody doing anything', async () => {
        const started = await loopback(transport, frame)
        expect(await outcome(started.read(100))).toBe(100)
        await started.powerOff()
        // Over UDP only a request finds out; over TCP the connection is reset.
        if (transport === 'udp') await outcome(started.read(101))
        await started.reached('waiting')
        expect(await outcome(started.read(102))).toMatch(/OFFLINE|TIMEOUT|DISCONNECTED/)
        await started.powerOn()
        await started.reached('connected')
        expect(await outcome(started.read(103))).toBe(103)
      })

      test('without a word (a pulled cable) is found out by its silence, and found again', async () => {
        const started = await loopback(transport, frame)
        const { plc, read } = started
        plc.script = silent
        plc.probe = (asked) => {
          plc.script = ({ reply }) => reply()
          asked.reply()
        }
        const lost = [await outcome(read(1, SHORT)), await outcome(read(2, SHORT))]
        expect(lost).toContain('TIMEOUT')
        await started.reached('connected')
        expect(await outcome(read(100))).toBe(100)
        expect(started.connection.statistics).toMatchObject({ connects: 2, disconnects: 1 })
      })

      test('in the middle of an answer leaves an error, and the next read is right', async () => {
        const started = await loopback(transport, frame)
        const { plc, read } = started
        plc.script = (asked) => {
          plc.script = ({ reply }) => reply()
          asked.peer.send(asked.answer().subarray(0, 12))
          asked.peer.close()
        }
        expect(await outcome(read(100))).toBe(transport === 'udp' ? 'TRUNCATED' : 'DISCONNECTED')
        await started.reached('connected')
        expect(await outcome(read(200))).toBe(200)
      })
    })

    describe('5: the entries of the PLC', () => {
      test('are given back: 50 connections after each other leave none open', async () => {
        const started = await loopback(transport, frame)
        started.connection.close()
        if (transport === 'tcp') await started.closedByClient()
        let most = 0
        started.plc.onConnection = () => {
          most = Math.max(most, started.plc.open)
        }
        for (let i = 0; i < 50; i++) {
          const next = started.another()
          await next.connection.connect()
          next.connection.close()
          if (transport === 'tcp') await started.closedByClient()
        }
        expect(started.plc.probes).toBe(51)
        if (transport === 'tcp') expect([most, started.plc.open]).toEqual([1, 0])
      })
    })

    describe('6: end codes', () => {
      test.each([0xc050, 0xc051, 0xc056, 0xc059, 0xc05b, 0xc05c, 0xc061, 0x4031, 0x0055, 0xffff])(
        '%i reaches the caller as itself, at once',
        async (endCode) => {
          const { plc, connection, ask } = await loopback(transport, frame)
          plc.script = (asked) => asked.peer.send(asked.refuse(endCode))
          const reading = connection.request(ask.read(100, 5))
          await expect(reading).rejects.toThrow(EndCodeError)
          await expect(reading).rejects.toMatchObject({ endCode, outcome: 'refused' })
          expect(connection.statistics).toMatchObject({ timeouts: 0, refused: 1, disconnects: 0 })
        },
      )

      test('an answer that is shorter than its own head says is an error, not a value', async () => {
        const { plc, connection, ask } = await loopback(transport, frame)
        plc.script = (asked) => {
          const answer = asked.answer()
          // The data length says that not even the end code is there.
          answer.writeUInt16LE(1, answer.length - 2 - 2 - 2)
          asked.peer.send(answer.subarray(0, -3))
        }
        await expect(connection.request(ask.read(100))).rejects.toThrow(ProtocolError)
      })
    })

    describe('7: nothing is lost without a word', () => {
      test('every one of 400 calls to a silent PLC ends once, and the queue is bounded', async () => {
        const { plc, connection, ask } = await loopback(transport, frame)
        plc.script = silent
        let most = 0
        const calls = Array.from({ length: 400 }, (_, i) => {
          const call = connection.request(ask.read(i), SHORT)
          most = Math.max(most, connection.statistics.queued)
          return call.then(
            () => 'answered',
            (error: PlcError) => `${error.code} ${error.outcome}`,
          )
        })
        const ends = await Promise.all(calls)
        expect(most).toBe(256)
        expect(ends.filter((end) => end === 'QUEUE_FULL notSent')).toHaveLength(400 - 256 - 1)
        // How many of them were sent before their own deadlines depends on the computer.
        expect(ends.filter((end) => /^(TIMEOUT|OFFLINE) notSent$|^TIMEOUT unknown$/.test(end))).toHaveLength(257)
        expect(ends[0]).toBe('TIMEOUT unknown')
      })

      test('a write whose outcome is unknown is carried out once', async () => {
        const started = await loopback(transport, frame)
        const { plc, connection, ask, read } = started
        let writes = 0
        plc.script = (asked) => {
          if (asked.name === 'readWords') {
            asked.reply()
            return
          }
          writes += 1
          asked.answer()
          if (transport === 'tcp') asked.peer.reset()
        }
        await expect(connection.request(ask.write(100, 7), SHORT)).rejects.toMatchObject({ outcome: 'unknown' })
        await started.reached('connected')
        expect([await outcome(read(100)), writes]).toEqual([7, 1])
      })
    })
  },
)

describe('3: TCP in pieces', () => {
  const pieces: readonly [string, (answer: Buffer) => Buffer[]][] = [
    ['single bytes', (answer) => [...answer].map((byte) => Buffer.of(byte))],
    ['9, 1451 and the rest', (answer) => [answer.subarray(0, 9), answer.subarray(9, 1460), answer.subarray(1460)]],
    ['the size of a segment', (answer) => [answer.subarray(0, 1460), answer.subarray(1460)]],
  ]
  /** Each piece on its own, as far as the system lets it. */
  async function sendInPieces({ peer }: Asked, chunks: readonly Buffer[]): Promise<void> {
    for (const chunk of chunks) {
      if (chunk.length > 0) peer.send(chunk)
      await new Promise<void>((resolve) => setImmediate(resolve))
    }
  }

  describe.each(frames)('%s', (frame) => {
    test.each(pieces)('960 words in %s are 960 right words', async (_what, cut) => {
      const { plc, connection, ask } = await loopback('tcp', frame)
      plc.script = (asked) => void sendInPieces(asked, cut(asked.answer()))
      const { values } = await connection.request(ask.read(1000, 960))
      expect(values).toEqual(Array.from({ length: 960 }, (_, i) => 1000 + i))
    })

    test('an answer cut at every place is the same value', async () => {
      const { plc, connection, ask } = await loopback('tcp', frame)
      let cut = 0
      let length = 1
      plc.script = (asked) => {
        const answer = asked.answer()
        length = answer.length
        void sendInPieces(asked, [answer.subarray(0, cut), answer.subarray(cut)])
      }
      for (; cut < length; cut++) {
        const { values } = await connection.request(ask.read(123, 2))
        expect([cut, values]).toEqual([cut, [123, 124]])
      }
    })

    test('a length that cannot be ends the connection', async () => {
      const { plc, connection, ask } = await loopback('tcp', frame)
      plc.script = (asked) => {
        const answer = asked.answer()
        answer.writeUInt16LE(0, answer.length - 2 - 2 - 2)
        asked.peer.send(answer)
      }
      await expect(connection.request(ask.read(1))).rejects.toMatchObject({ code: 'BAD_FRAME' })
    })
  })
})

describe('3: datagrams in pieces', () => {
  test.each(frames)('%s: a cut answer is an error at every place, and never a value', async (frame) => {
    const started = await loopback('udp', frame)
    const { plc, read } = started
    for (const cut of [1, 2, 9, 11, 12]) {
      await started.reached('connected')
      plc.script = (asked) => asked.peer.send(asked.answer().subarray(0, cut))
      expect([cut, await outcome(read(100))]).toEqual([cut, 'TRUNCATED'])
    }
  })
})

test('1: by UDP, datagrams of somebody else are not listened to', async () => {
  const { plc, read } = await loopback('udp', '3E')
  const stranger = createSocket('udp4')
  plc.script = (asked) => {
    const port = Number(asked.peer.remote.split(':').at(-1))
    const forged = asked.answer()
    forged.writeUInt16LE(9999, forged.length - 2)
    stranger.send(forged, port, '127.0.0.1', () => asked.reply())
  }
  try {
    expect(await outcome(read(100))).toBe(100)
  } finally {
    await new Promise<void>((resolve) => stranger.close(resolve))
  }
})

test('2: 4E by UDP may pipeline, up to what was asked for', async () => {
  const { plc, read } = await loopback('udp', '4E', { inFlight: 4 })
  const waiting: Asked[] = []
  let most = 0
  plc.script = (asked) => {
    waiting.push(asked)
    most = Math.max(most, waiting.length)
    // Answered in the reverse order, whenever four have come together.
    if (waiting.length === 4) for (const one of waiting.splice(0).reverse()) one.reply()
  }
  const found = await Promise.all(Array.from({ length: 40 }, (_, i) => outcome(read(i))))
  expect(found).toEqual(Array.from({ length: 40 }, (_, i) => i))
  expect(most).toBe(4)
})

describe('5: all entries are taken', () => {
  test('accepted and closed at once is told as what it is, and the entry is taken when it is free', async () => {
    const started = await Loopback.start('tcp', '4E', { connect: false })
    open.push(started)
    started.plc.onConnection = (peer) => peer.close()
    await expect(started.connection.connect()).rejects.toMatchObject({ code: 'ENTRY_BUSY', outcome: 'notSent' })
    await expect(started.read(1)).rejects.toMatchObject({ code: 'OFFLINE', cause: { code: 'ENTRY_BUSY' } })
    started.plc.onConnection = () => {}
    await started.reached('connected')
    expect(await outcome(started.read(1))).toBe(1)
  })
})

describe.each(transports)('10: %s, silence and lying connects', (transport) => {
  test.each([
    ['another data code', { plcCode: 'ascii' }],
    ['another frame', { plcFrame: '4E' }],
  ] as const)('%s is answered by silence: connect fails, with the causes', async (_what, given) => {
    const started = await Loopback.start(transport, '3E', { ...given, connect: false, timeout: 100 })
    open.push(started)
    await expect(started.connection.connect()).rejects.toMatchObject({
      code: 'SILENT',
      causes: expect.arrayContaining([
        expect.stringContaining('ASCII code and this connection to binary'),
        expect.stringContaining('does not know the 3E frame'),
      ]),
    })
  })

  test('nothing listens: connect fails, at once', async () => {
    const started = await Loopback.start(transport, '3E', { connect: false })
    open.push(started)
    await started.powerOff()
    await expect(started.connection.connect()).rejects.toMatchObject({ code: 'CONNECT_FAILED' })
  })

  test('the program survives: nothing is thrown outside of the promises', async () => {
    const uncaught: unknown[] = []
    const note = (error: unknown) => uncaught.push(error)
    process.on('uncaughtException', note).on('unhandledRejection', note)
    try {
      const started = await loopback(transport, '3E')
      for (const bytes of ['', 'x', 'HTTP/1.1 400', '\xd0\x00', '\xd0\x00\x00\xff\xff\x03\x00\xff\xff']) {
        await started.reached('connected')
        started.plc.script = ({ peer }) => {
          if (bytes !== '') peer.send(Buffer.from(bytes, 'latin1'))
          peer.close()
        }
        await outcome(started.read(1, SHORT))
      }
      started.connection.close()
      await new Promise<void>((resolve) => setImmediate(resolve))
      expect(uncaught).toEqual([])
    } finally {
      process.off('uncaughtException', note).off('unhandledRejection', note)
    }
  })
})
