// Encode and decode of each bulk kind, and of whole requests and answers, in both codes.
import { createRequire } from 'node:module'
import { nanosPerCall, row, title } from './measure.mjs'

const require = createRequire(import.meta.url)
const { decode, encode, field, readerOf, writerOf } = require('../dist/src/codec/codec.js')
const { commands } = require('../dist/src/melsec/commands/commands.js')
const { slmpFraming } = require('../dist/src/melsec/frame/slmp-frame.js')
const { MelsecProtocol } = require('../dist/src/melsec/protocol.js')
const { resolveProfile } = require('../dist/src/melsec/profiles/profiles.js')
const { ownStation } = require('../dist/src/melsec/frame/route.js')

const WORDS = 960
const kinds = {
  words: { shape: { values: field.words(WORDS) }, values: Array.from({ length: WORDS }, (_, i) => (i * 77) & 0xffff) },
  doubleWords: {
    shape: { values: field.doubleWords(480) },
    values: Array.from({ length: 480 }, (_, i) => (i * 70_001) >>> 0),
  },
  bits: { shape: { values: field.bits(3584) }, values: Array.from({ length: 3584 }, (_, i) => i % 3 === 0) },
  bytes: { shape: { values: field.bytes(1920) }, values: Uint8Array.from({ length: 1920 }, (_, i) => i) },
  text: { shape: { values: field.text(960) }, values: 'ABCDEF0123'.repeat(96) },
}

export function benchCodec() {
  title('Bulk kinds, microseconds per message', 'encode', 'decode')
  for (const code of ['binary', 'ascii']) {
    for (const [kind, { shape, values }] of Object.entries(kinds)) {
      const message = { values }
      const writer = writerOf(code)
      encode(shape, message, writer)
      const bytes = writer.take()
      const write = nanosPerCall(() => {
        encode(shape, message, writer)
        writer.take()
      })
      const read = nanosPerCall(() => decode(shape, readerOf(code, bytes)))
      row(`${kind} x ${values.length}, ${code}`, (write / 1000).toFixed(2), (read / 1000).toFixed(2))
    }
  }
  benchRequests()
}

function benchRequests() {
  title('Requests and answers, microseconds', 'encode request', 'decode answer')
  const profile = resolveProfile('iq-r')
  for (const code of ['binary', 'ascii']) {
    const protocol = new MelsecProtocol({
      framing: slmpFraming('4E', code),
      head: { ...ownStation, timer: 0 },
      profile,
      code,
    })
    for (const points of [1, WORDS]) {
      const message = { head: { device: 'D', number: 100 }, points }
      const exchange = protocol.exchange(commands.readWords, message)
      const request = nanosPerCall(() => protocol.exchange(commands.readWords, message).write(1))
      const frame = answerFrame(protocol, code, points)
      const answer = nanosPerCall(() => exchange.decode(protocol.framing.response.scan(frame, () => undefined).frame))
      row(`Read (word units), ${points} point(s), 4E ${code}`, (request / 1000).toFixed(2), (answer / 1000).toFixed(2))
    }
  }
}

function answerFrame(protocol, code, points) {
  const writer = writerOf(code)
  writer.words(new Array(points).fill(0x1234))
  return protocol.framing.response.write({ ...ownStation, timer: 0 }, 1, 0, writer.take())
}
