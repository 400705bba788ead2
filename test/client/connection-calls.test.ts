// One call: its deadline, its place in the queue, its signal, and what is known of it when it ends.
import { describe, expect, test } from '@jest/globals'
import { Bench } from './bench'
import { type Asked, silent } from './scripted-plc'

const frames = ['3E', '4E'] as const
const kinds = ['stream', 'datagram'] as const
const everyLink = frames.flatMap((frame) => kinds.map((kind) => ({ frame, kind })))

describe.each(everyLink)('$frame by $kind', (link) => {
  describe('the answer', () => {
    test('an end code is a refusal and leaves the connection alone', async () => {
      const bench = await Bench.connected(link)
      bench.plc.script = (asked) => asked.peer.send(asked.refuse(0xc056))
      const read = bench.read(100)
      await bench.settle()
      expect(read.error).toMatchObject({ name: 'EndCodeError', endCode: 0xc056, outcome: 'refused' })
      expect(read.error?.message).toContain('Read (word units) was refused with end code C056')
      expect(bench.state).toBe('connected')
      expect(bench.connection.statistics).toMatchObject({ connects: 1, answered: 1, refused: 1, protocolErrors: 0 })
    })

    test('that does not fit the request is a ProtocolError and drops the connection', async () => {
      const bench = await Bench.connected(link)
      bench.plc.script = (asked) => asked.peer.send(answerWith(bench, asked, Buffer.of(1, 0, 2, 0)))
      const read = bench.read(100)
      await bench.settle()
      expect(read.error).toMatchObject({ name: 'ProtocolError', code: 'TRAILING', outcome: 'unknown' })
      expect([bench.state, bench.connection.state.error]).toEqual(['waiting', read.error])
      expect(bench.connection.statistics).toMatchObject({ answered: 1, protocolErrors: 1, disconnects: 1 })
      await bench.pass(50)
      expect(bench.state).toBe('connected')
    })

    test('rubbish is a ProtocolError and drops the connection', async () => {
      const bench = await Bench.connected(link)
      bench.plc.script = ({ peer }) => peer.send(Buffer.from('rubbish'))
      const write = bench.write(100, 1)
      await bench.settle()
      expect(write.error).toMatchObject({ name: 'ProtocolError', code: 'BAD_FRAME', outcome: 'unknown' })
      expect(bench.connection.statistics).toMatchObject({ answered: 0, protocolErrors: 1, disconnects: 1 })
      await bench.pass(10_000)
      expect(bench.plc.asked).toEqual(['writeWords 100'])
    })
  })

  describe('the deadline', () => {
    test('covers the queue: what is not sent in time is not sent at all', async () => {
      const bench = await Bench.connected(link)
      bench.plc.script = silent
      const slow = bench.read(1, { timeout: 900 })
      const [brief, patient] = [bench.write(2, 1, { timeout: 100 }), bench.read(3, { timeout: 5000 })]
      await bench.pass(100)
      expect([slow.told, brief.told, patient.told]).toEqual(['pending', 'TIMEOUT notSent', 'pending'])
      expect(brief.error?.message).toBe(
        'Write (word units) was not sent before its deadline: earlier requests took too long.',
      )
      bench.plc.script = (asked) => asked.reply()
      await bench.pass(900)
      expect([slow.told, patient.told]).toEqual(['TIMEOUT unknown', { values: [3] }])
      expect(bench.plc.asked).toEqual(['readWords 1', 'readWords 3'])
    })

    test('covers the answer: whether a write was carried out is not known then', async () => {
      const bench = await Bench.connected(link)
      bench.plc.script = (asked) => void asked.answer()
      const write = bench.write(100, 7)
      await bench.pass(999)
      expect(write.told).toBe('pending')
      await bench.pass(1)
      expect(write.told).toBe('TIMEOUT unknown')
      expect(write.error?.message).toMatch(
        /Write \(word units\): no answer from memory .* Most likely: the data code differs/,
      )
      expect(bench.plc.words[100]).toBe(7)
    })

    test('of the client holds where the call says nothing, and ends at the same moment however late it started', async () => {
      const bench = await Bench.connected({ ...link, timeout: 300 })
      bench.plc.script = silent
      const first = bench.read(1)
      await bench.pass(200)
      const second = bench.read(2)
      await bench.pass(100)
      expect([first.told, second.told]).toEqual(['TIMEOUT unknown', 'pending'])
      await bench.pass(200)
      expect(second.settled).toBe(1)
    })
  })

  describe('the signal', () => {
    test('aborted before: nothing is sent', async () => {
      const bench = await Bench.connected(link)
      const reason = new Error('enough')
      const read = bench.read(100, { signal: AbortSignal.abort(reason) })
      await bench.settle()
      expect([read.told, read.error?.cause, bench.plc.asked]).toEqual(['ABORTED notSent', reason, []])
    })

    test('aborted before: connect does not say that it is connected, connected or not', async () => {
      const reason = new Error('enough')
      const signal = AbortSignal.abort(reason)
      for (const bench of [await Bench.connected(link), new Bench(link)]) {
        const connecting = bench.follow(bench.connection.connect({ signal }))
        await bench.settle()
        expect([connecting.told, connecting.error?.cause]).toEqual(['ABORTED notSent', reason])
        expect(connecting.error?.message).toBe('Connecting was aborted.')
      }
    })

    test('aborted in the queue: it is taken out, the others go on', async () => {
      const bench = await Bench.connected(link)
      const abort = new AbortController()
      const reads = [bench.read(1), bench.write(2, 9, { signal: abort.signal }), bench.read(3)]
      abort.abort(new Error('enough'))
      await bench.settle()
      expect(reads.map(({ told }) => told)).toEqual([{ values: [1] }, 'ABORTED notSent', { values: [3] }])
      expect([bench.plc.asked, bench.connection.statistics.aborted]).toEqual([['readWords 1', 'readWords 3'], 1])
    })

    test('aborted in flight: whether it was carried out is not known', async () => {
      const bench = await Bench.connected(link)
      const late: (() => void)[] = []
      bench.plc.script = (asked) => late.push(asked.reply)
      const abort = new AbortController()
      const write = bench.write(100, 9, { signal: abort.signal })
      const read = bench.read(200, { timeout: 5000 })
      await bench.settle()
      abort.abort()
      expect(bench.connection.statistics).toMatchObject({
        aborted: 1,
        inFlight: link.frame === '4E' || link.kind === 'datagram' ? 1 : 0,
      })
      bench.plc.script = (asked) => asked.reply()
      late[0]?.()
      await bench.pass(1000)
      // The late answer is not taken for the read's.
      expect([write.told, read.told]).toEqual(['ABORTED unknown', { values: [200] }])
      expect(bench.connection.statistics).toMatchObject({ protocolErrors: 0, answered: 1 })
    })

    test('aborted while its answer is being taken: unknown, because it was sent', async () => {
      const abort = new AbortController()
      const bench = await Bench.connected({ ...link, onUnsolicited: () => abort.abort() })
      bench.plc.script = (asked) => {
        const news = bench.framing.request.write(asked.frame.head, 1, Buffer.from('news'))
        if (link.kind === 'stream') asked.peer.send(Buffer.concat([news, asked.answer()]))
        else asked.peer.send(news)
      }
      const write = bench.write(100, 9, { signal: abort.signal })
      await bench.settle()
      expect([write.told, write.settled]).toEqual(['ABORTED unknown', 1])
    })

    test('aborted afterwards: nothing happens, and nothing is left on the signal', async () => {
      const bench = await Bench.connected(link)
      const abort = new AbortController()
      const listeners = countListeners(abort.signal)
      const reads = Array.from({ length: 30 }, (_, i) => bench.read(i, { signal: abort.signal }))
      // More than ten on one signal are taken for a leak.
      expect(listeners.count).toBe(1)
      await bench.settle()
      expect(listeners.count).toBe(0)
      abort.abort()
      await bench.settle()
      expect(reads.map(({ told }) => told)).toEqual(reads.map((_, i) => ({ values: [i] })))
      expect(bench.connection.statistics).toMatchObject({ aborted: 0, answered: 30 })
    })
  })

  describe('the queue', () => {
    test('holds as many as it says and refuses the next one', async () => {
      const bench = await Bench.connected({ ...link, queueLimit: 2 })
      let answer = () => {}
      bench.plc.script = (asked) => {
        answer = asked.reply
      }
      const reads = [bench.read(0), bench.read(1), bench.read(2), bench.read(3)]
      await bench.settle()
      expect(reads.map(({ told }) => told)).toEqual(['pending', 'pending', 'pending', 'QUEUE_FULL notSent'])
      expect(reads[3]?.error?.message).toContain('2 requests are waiting already. Ask less often, or raise queueLimit.')
      // Reads that fill the queue keep no write out: there is as much room again.
      const writes = [bench.write(4, 1), bench.write(5, 1), bench.write(6, 1)]
      await bench.settle()
      expect(writes.map(({ told }) => told)).toEqual(['pending', 'pending', 'QUEUE_FULL notSent'])
      expect(bench.connection.statistics).toMatchObject({ queued: 4, inFlight: 1, requests: 5 })
      bench.plc.script = (asked) => asked.reply()
      answer()
      await bench.settle()
      // What changes the PLC goes ahead of what only asks.
      expect(bench.plc.asked).toEqual(['readWords 0', 'writeWords 4', 'writeWords 5', 'readWords 1', 'readWords 2'])
      const after = bench.read(7)
      await bench.settle()
      expect(after.told).toEqual({ values: [7] })
    })

    test('is bounded while connecting too', async () => {
      const bench = new Bench({ ...link, queueLimit: 3 })
      const reads = Array.from({ length: 5 }, (_, i) => bench.read(i))
      const writes = Array.from({ length: 4 }, (_, i) => bench.write(i, 1))
      await bench.settle()
      expect(writes.map(({ error }) => error?.code)).toEqual([undefined, undefined, undefined, 'QUEUE_FULL'])
      expect(reads.map(({ settled, error }) => [settled, error?.code])).toEqual([
        [1, undefined],
        [1, undefined],
        [1, undefined],
        [1, 'QUEUE_FULL'],
        [1, 'QUEUE_FULL'],
      ])
    })
  })
})

function answerWith({ framing }: Bench, { frame }: Asked, body: Buffer): Buffer {
  return framing.response.write(frame.head, frame.serial ?? 0, 0, body)
}

/** Counts the listeners that are on a signal at the moment. */
function countListeners(signal: AbortSignal): { count: number } {
  const counted = { count: 0 }
  const [add, remove] = [signal.addEventListener.bind(signal), signal.removeEventListener.bind(signal)]
  signal.addEventListener = (...args: Parameters<typeof add>) => {
    counted.count += 1
    add(...args)
  }
  signal.removeEventListener = (...args: Parameters<typeof remove>) => {
    counted.count -= 1
    remove(...args)
  }
  return counted
}
