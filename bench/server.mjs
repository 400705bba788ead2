// A stand-in for a PLC that costs next to nothing: answers 3E binary requests with prepared bytes.
// It runs in a process of its own, so that the client's processor time is the client's alone.
import { createServer } from 'node:net'

const HEAD = 9
const READ_TYPE_NAME = 0x0101
const WORD_UNITS = 0x0401
const RANDOM = 0x0403

function answer(data) {
  const frame = Buffer.alloc(HEAD + 2 + data.length)
  frame.set([0xd0, 0x00, 0x00, 0xff, 0xff, 0x03, 0x00])
  frame.writeUInt16LE(2 + data.length, 7)
  frame.set(data, HEAD + 2)
  return frame
}

const typeName = answer(Buffer.concat([Buffer.from('R04CPU          ', 'latin1'), Buffer.of(0x00, 0x48)]))
const words = new Map()
function wordsAnswer(count) {
  if (!words.has(count)) words.set(count, answer(Buffer.alloc(count * 2, 0x12)))
  return words.get(count)
}

function answerTo(request) {
  const command = request.readUInt16LE(11)
  if (command === READ_TYPE_NAME) return typeName
  if (command === RANDOM) return wordsAnswer(request[15] + 2 * request[16])
  if (command === WORD_UNITS) return wordsAnswer(request.readUInt16LE(request.length - 2))
  throw new Error(`no answer to ${command.toString(16)}`)
}

const server = createServer((socket) => {
  socket.setNoDelay(true)
  let rest = Buffer.alloc(0)
  socket.on('error', () => socket.destroy())
  socket.on('data', (chunk) => {
    rest = rest.length === 0 ? chunk : Buffer.concat([rest, chunk])
    while (rest.length >= HEAD && rest.length >= HEAD + rest.readUInt16LE(7)) {
      const size = HEAD + rest.readUInt16LE(7)
      socket.write(answerTo(rest.subarray(0, size)))
      rest = rest.subarray(size)
    }
  })
})
server.listen(0, '127.0.0.1', () => process.send({ port: server.address().port }))
