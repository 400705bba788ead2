// A PLC that answers 3E frames with as little work as possible, over TCP and UDP, in binary and ASCII code: in a process
// of its own, so that the client's processor time is the client's alone.
import { createSocket } from 'node:dgram'
import { createServer } from 'node:net'

/** What differs between the codes: the bytes of a number, where they stand, and how they are read. */
const binary = {
  head: 9,
  start: Buffer.from('d00000ffff0300', 'hex'),
  at: { length: 7, command: 11, points: (frame) => frame.length - 2, lists: 15, data: 15 },
  read: (frame, at) => frame.readUInt16LE(at),
  count: (frame, at) => frame[at],
  number: (value) => Buffer.of(value & 0xff, value >> 8),
  next: 1,
  bytesPerWord: 2,
}
const ascii = {
  head: 18,
  start: Buffer.from('D00000FF03FF00'),
  at: { length: 14, command: 22, points: (frame) => frame.length - 4, lists: 30, data: 30 },
  read: (frame, at) => Number.parseInt(frame.latin1Slice(at, at + 4), 16),
  count: (frame, at) => Number.parseInt(frame.latin1Slice(at, at + 2), 16),
  number: (value) => Buffer.from(value.toString(16).toUpperCase().padStart(4, '0')),
  next: 2,
  bytesPerWord: 4,
}
const codeOf = (frame) => (frame[0] === 0x35 ? ascii : binary)

const READ_TYPE_NAME = 0x0101
const WORD_UNITS = 0x0401
const RANDOM = 0x0403
const SELF_TEST = 0x0619

function answer(code, data) {
  const end = code.number(0)
  return Buffer.concat([code.start, code.number(end.length + data.length), end, data])
}

const known = new Map()
function wordsAnswer(code, count) {
  const key = `${code.head} ${count}`
  if (!known.has(key))
    known.set(key, answer(code, Buffer.alloc(count * code.bytesPerWord, code === ascii ? 0x31 : 0x12)))
  return known.get(key)
}

function answerTo(request) {
  const code = codeOf(request)
  const command = code.read(request, code.at.command)
  if (command === READ_TYPE_NAME) {
    return answer(code, Buffer.concat([Buffer.from('R04CPU          ', 'latin1'), code.number(0x4800)]))
  }
  if (command === SELF_TEST) return answer(code, request.subarray(code.at.data))
  if (command === RANDOM) {
    const { lists } = code.at
    return wordsAnswer(code, code.count(request, lists) + 2 * code.count(request, lists + code.next))
  }
  if (command === WORD_UNITS) return wordsAnswer(code, code.read(request, code.at.points(request)))
  throw new Error(`no answer to ${command.toString(16)}`)
}

const tcp = createServer((socket) => {
  socket.setNoDelay(true)
  let rest = Buffer.alloc(0)
  socket.on('error', () => socket.destroy())
  socket.on('data', (chunk) => {
    rest = rest.length === 0 ? chunk : Buffer.concat([rest, chunk])
    for (;;) {
      const { head, at, read } = codeOf(rest)
      if (rest.length < head || rest.length < head + read(rest, at.length)) return
      const size = head + read(rest, at.length)
      socket.write(answerTo(rest.subarray(0, size)))
      rest = rest.subarray(size)
    }
  })
})

const udp = createSocket('udp4')
udp.on('message', (request, { port, address }) => udp.send(answerTo(request), port, address))

/** A PLC whose answers take a scan. */
const SCAN = 2
const slow = createSocket('udp4')
slow.on('message', (request, { port, address }) => {
  setTimeout(() => slow.send(answerTo(request), port, address), SCAN)
})

tcp.listen(0, '127.0.0.1', () => {
  udp.bind(0, '127.0.0.1', () => {
    slow.bind(0, '127.0.0.1', () => {
      process.send({ tcp: tcp.address().port, udp: udp.address().port, slow: slow.address().port })
    })
  })
})
