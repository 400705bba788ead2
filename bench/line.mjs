// The use of a serial line: characters against what the bit rate allows, with a PLC that takes no time to answer and paces its
// bytes; and how few characters the plans of the client need.
import { createRequire } from 'node:module'
import { isQuick, median, row, times, title } from './measure.mjs'

const require = createRequire(import.meta.url)
const { createMelsecClient } = require('../dist/src/index.js')
const { clientProtocolOf } = require('../dist/src/melsec/client-protocols.js')
const { commands } = require('../dist/src/melsec/commands/commands.js')
const { serialRoute } = require('../dist/src/melsec/frame/serial-frames.js')
const { serialFraming } = require('../dist/src/melsec/frame/serial-framing.js')
const { ownStation } = require('../dist/src/melsec/frame/route.js')
const { oneCProtocol } = require('../dist/src/melsec/one-c/protocol.js')
const { resolveProfile } = require('../dist/src/melsec/profiles/profiles.js')
const { MelsecProtocol } = require('../dist/src/melsec/protocol.js')
const { parseItem } = require('../dist/src/client/item/item.js')
const { planRead } = require('../dist/src/client/plan/read.js')

const PROFILE = 'fx5-serial'
const FRAMES = [
  { frame: '1C', format: 1 },
  { frame: '3C', format: 1 },
  { frame: '4C', format: 5 },
]
const nameOf = ({ frame, format }) => `${frame} format ${format}`

// --- the line

/** Start, eight data bits, stop. */
const BITS = 10
/** Nearer to its time than this a timer is not trusted. */
const ROUGH = 3

/** ms of characters that come together. */
const PIECE = 20

/** Calls back at a time that timers are too rough for. */
function at(time, then) {
  const left = time - performance.now()
  if (left > ROUGH) setTimeout(() => at(time, then), left - ROUGH)
  else if (left > 0) setImmediate(() => at(time, then))
  else then()
}

/** What a PLC answers to the bytes of one request: every word is the same. */
function plcOf({ frame, format }) {
  const framing = serialFraming({ frame, format })
  const head = serialRoute(frame)
  const options = { framing, head, asciiXy: 'octal' }
  const set =
    frame === '1C'
      ? oneCProtocol(options)
      : new MelsecProtocol({ ...options, profile: resolveProfile(PROFILE), code: framing.code })
  const bodyLength = (of, soFar) => (frame === '1C' ? set.requestLength(of, soFar) : set.requestLength(soFar))
  return (bytes) => {
    const request = framing.request.scan(bytes, bodyLength).frame
    const read = set.readRequest(request)
    const { points } = read.message
    const response = points === undefined ? {} : { values: new Array(points).fill(0x1234) }
    const body =
      frame === '1C' ? set.writeResponse(read.command, read.message, response) : set.writeResponse(read, response)
    return framing.response.write(request.head, 0, 0, body)
  }
}

/** A half-duplex line in memory: each byte takes its time, and the PLC none. */
class PacedLine {
  characters = 0
  #free = 0
  #handlers
  #closed = false

  constructor(answerTo, baudRate) {
    this.answerTo = answerTo
    this.byteTime = (BITS * 1000) / baudRate
  }

  kind = 'stream'
  renewable = false
  ready = true
  description = 'a paced line'

  open(handlers) {
    this.#handlers = handlers
    setImmediate(() => handlers.opened())
  }

  send(bytes) {
    // The line takes the request from now on; what making the answer takes is not the client's.
    const now = performance.now()
    // What brings the PLC to a known state is answered by nothing.
    const answer = bytes.length > 4 ? this.answerTo(Buffer.from(bytes)) : Buffer.alloc(0)
    this.characters += bytes.length + answer.length
    const begin = Math.max(now, this.#free) + bytes.length * this.byteTime
    this.#free = begin + answer.length * this.byteTime
    if (answer.length > 0) this.#deliver(answer, begin)
  }

  /** Piece by piece, because a line on which nothing comes counts as silent; the last one at its time. */
  #deliver(answer, begin) {
    const size = Math.min(answer.length, Math.ceil(PIECE / this.byteTime))
    const time = begin + size * this.byteTime
    const then = () => {
      if (this.#closed) return
      this.#handlers.received(answer.subarray(0, size))
      if (size < answer.length) this.#deliver(answer.subarray(size), time)
    }
    if (size === answer.length) at(time, then)
    else setTimeout(then, time - performance.now())
  }

  close() {
    this.#closed = true
  }
}

/** ms of calls before anything is measured, as of a program that has run for a while. */
const WARM = 700

/** Share of the bit rate that calls one after another use: the median. */
async function useOf(kind, baudRate, ask, calls) {
  const line = new PacedLine(plcOf(kind), baudRate)
  const client = createMelsecClient({
    openTransport: () => line,
    serial: { baudRate, dataLength: 8, parity: 'none', path: 'in memory' },
    profile: PROFILE,
    frame: kind.frame,
    messageFormat: kind.format,
    probe: 'none',
    allowWrites: true,
  })
  try {
    await client.connect()
    const warm = performance.now() + (baudRate < FAST || isQuick ? 0 : WARM)
    do await ask(client)
    while (performance.now() < warm)
    const before = line.characters
    const shares = []
    for (let i = 0; i < calls; i++) {
      const [sofar, start] = [line.characters, performance.now()]
      await ask(client)
      shares.push(((line.characters - sofar) * line.byteTime) / (performance.now() - start))
    }
    return { characters: (line.characters - before) / calls, share: median(shares) }
  } finally {
    await client.close()
  }
}

const FULL = 'D0:UINT[960]'
const SHORT = 'D100'
const FAST = 115_200
/** `calls`: at 9600 bit/s. */
const CALLS = {
  '960 words': { ask: (client) => client.read(FULL), calls: 2 },
  'one word': { ask: (client) => client.read(SHORT), calls: 40 },
  'one word written': { ask: (client) => client.write(SHORT, 1), calls: 20 },
}

async function benchUse() {
  title('Use of a serial line, one call after another', 'characters', '% at 9600', '% at 115200')
  for (const [name, { ask, calls }] of Object.entries(CALLS)) {
    for (const kind of FRAMES) {
      const fast = await useOf(kind, FAST, ask, times(4 * calls))
      const slow = isQuick ? undefined : await useOf(kind, 9600, ask, times(calls))
      const percent = (use) => (use === undefined ? '-' : (100 * use.share).toFixed(1))
      row(`${name}, ${nameOf(kind)}`, fast.characters, percent(slow), percent(fast))
    }
  }
}

// --- the plans

const GAP = 64
const VALUES = 100

/** Random numbers that are the same in every run. */
function numbersFrom(seed) {
  let state = seed
  return (below) => {
    state = (Math.imul(state, 1_103_515_245) + 12_345) >>> 0
    return (state >>> 8) % below
  }
}

/** Words of D, sorted. */
const LISTS = {
  'far apart': () => Array.from({ length: VALUES }, (_, i) => 79 * i),
  'anywhere in D0 to D1999': () => scattered(2000),
  'anywhere in D0 to D499': () => scattered(500),
  'in twenty groups of five': () => Array.from({ length: VALUES }, (_, i) => 150 * Math.floor(i / 5) + (i % 5)),
}

function scattered(below) {
  const random = numbersFrom(7)
  const found = new Set()
  while (found.size < VALUES) found.add(random(below))
  return [...found].sort((a, b) => a - b)
}

function protocolOf({ frame, format }) {
  return clientProtocolOf({
    frame,
    code: serialFraming({ frame, format }).code,
    profile: resolveProfile(PROFILE),
    route: ownStation,
    timer: 0,
    serial: { format, head: serialRoute(frame), messageWait: 0 },
  })
}

function planned(numbers, protocol) {
  const items = numbers.map((number) => parseItem(`D${number}`, { xyRadix: 8 }))
  return charactersOf(planRead(items, protocol, { gap: GAP }).describe().requests)
}

function charactersOf(requests) {
  const characters = requests.reduce((sum, { requestBytes, responseBytes }) => sum + requestBytes + responseBytes, 0)
  return { characters, requests: requests.length }
}

/** Prices of what a plan can consist of, as the frames have them. */
function pricesOf(protocol) {
  const price = (name, message) => protocol.bodyBytes(commands[name], message, 'short') + protocol.lineCost.read
  const device = { device: 'D', number: 0 }
  const read = (points) => price('readWords', { head: device, points })
  const random = (words, pairs) => {
    const list = (count) => new Array(count).fill({ device })
    return price('readRandom', { words: list(words), doubleWords: list(pairs) })
  }
  const block = (count) => {
    const wordBlocks = new Array(count).fill({ head: device, points: 1 })
    return price('readBlock', { wordBlocks, bitBlocks: [] })
  }
  const has = (name) => protocol.profile.lacks.every(({ command }) => command !== name)
  const none = Number.POSITIVE_INFINITY
  return {
    word: read(2) - read(1),
    read: read(1),
    random: has('readRandom')
      ? { request: random(0, 0), word: random(1, 0) - random(0, 0), half: (random(0, 1) - random(0, 0)) / 2 }
      : { request: none, word: none, half: none },
    block: has('readBlock') ? { request: block(0), word: block(1) - block(0) } : { request: none, word: none },
  }
}

/**
 * Whatever the plan is, each word is an entry of Read Random, or half of one beside another, or stands in a block or a Read,
 * where it is the first or costs what lies between it and the one before it; and where there is a Read Random or a Read Block,
 * there is one at least.
 */
function leastFor(numbers, protocol) {
  const { word, read, random, block } = pricesOf(protocol)
  const total = (withRandom, withBlock) =>
    numbers.reduce(
      (sum, number, i) => {
        const before = number - (numbers[i - 1] ?? Number.NEGATIVE_INFINITY)
        const isBeside = before === 1 || numbers[i + 1] === number + 1
        const ways = [word * before, read]
        if (withRandom) ways.push(isBeside ? random.half : random.word)
        if (withBlock) ways.push(block.word)
        return sum + Math.min(...ways)
      },
      (withRandom ? random.request : 0) + (withBlock ? block.request : 0),
    )
  return Math.ceil(Math.min(total(false, false), total(true, false), total(false, true), total(true, true)))
}

function benchPlans() {
  title(
    `Characters for ${VALUES} words, 9600 bit/s: 1 ms each`,
    'plan',
    'requests',
    'lower bound',
    'one by one',
    'fewest requests',
  )
  for (const [name, listOf] of Object.entries(LISTS)) {
    const numbers = listOf()
    for (const kind of FRAMES) {
      const protocol = protocolOf(kind)
      const { characters, requests } = planned(numbers, protocol)
      const naive = numbers.reduce((sum, number) => sum + planned([number], protocol).characters, 0)
      const fewest = planned(numbers, { ...withoutCost(protocol) }).characters
      row(`${name}, ${nameOf(kind)}`, characters, requests, leastFor(numbers, protocol), naive, fewest)
    }
  }
}

/** As a network is planned for. */
function withoutCost(protocol) {
  return {
    profile: protocol.profile,
    code: protocol.code,
    exchange: (...given) => protocol.exchange(...given),
    check: (...given) => protocol.check(...given),
    bodyBytes: (...given) => protocol.bodyBytes(...given),
    answerBytes: (...given) => protocol.answerBytes(...given),
  }
}

export async function benchLine() {
  benchPlans()
  await benchUse()
}
