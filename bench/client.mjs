// The client over loopback beside a bare socket that exchanges the same bytes, and its memory over many requests.
import { fork } from 'node:child_process'
import { createSocket } from 'node:dgram'
import { once } from 'node:events'
import { createRequire } from 'node:module'
import { connect } from 'node:net'
import { compare, costPerCall, row, times, title } from './measure.mjs'

const require = createRequire(import.meta.url)
const { createMelsecClient } = require('../dist/src/index.js')

const HOST = '127.0.0.1'

async function startServer() {
  const server = fork(new URL('./server.mjs', import.meta.url))
  const [ports] = await once(server, 'message')
  return { ports, stop: () => server.kill() }
}

/** Sends requests and waits for as many bytes as each answer has; looks at none of them. */
class Bare {
  #chunks = []
  #missing = 0
  #done = () => {}
  #send

  constructor(send) {
    this.#send = send
  }

  received(chunk) {
    this.#chunks.push(chunk)
    this.#missing -= chunk.length
    if (this.#missing === 0) this.#done(this.#chunks)
  }

  /** @returns the chunks of the answer */
  exchange({ request, answerLength }) {
    return new Promise((resolve) => {
      this.#chunks = []
      this.#missing = answerLength
      this.#done = resolve
      this.#send(request)
    })
  }

  /** One after another, as the client does. */
  async #each(exchanges) {
    const answers = []
    for (const one of exchanges) answers.push(await this.exchange(one))
    return answers
  }

  /** What does all of them: of a single one with nothing around it. */
  all(exchanges) {
    const [only] = exchanges
    return exchanges.length === 1 ? () => this.exchange(only) : () => this.#each(exchanges)
  }
}

const END_CODE_AT = 9
const DATA_AT = 11

/**
 * The least that a program by hand must do with the answer: look at the end code, and make numbers of the words. Bytes by
 * their index: methods such as `readUInt16LE` cost twice as much.
 */
const byHand = {
  binary: (answer) => numbersIn(answer, 0, 1),
  ascii: (answer) => numbersIn(Buffer.from(answer.latin1Slice(), 'hex'), 1, 0),
}

function numbersIn(bytes, low, high) {
  if (bytes[END_CODE_AT] !== 0 || bytes[END_CODE_AT + 1] !== 0) throw new Error('refused')
  const numbers = new Array((bytes.length - DATA_AT) >> 1)
  for (let i = 0, at = DATA_AT; i < numbers.length; i++, at += 2) numbers[i] = bytes[at + low] | (bytes[at + high] << 8)
  return numbers
}

async function bareTcp(port, exchanges) {
  const socket = connect(port, HOST)
  socket.setNoDelay(true)
  await once(socket, 'connect')
  const bare = new Bare((request) => socket.write(request))
  socket.on('data', (chunk) => bare.received(chunk))
  return { exchange: bare.all(exchanges), close: () => socket.destroy() }
}

async function bareUdp(port, exchanges) {
  const socket = createSocket('udp4')
  socket.connect(port, HOST)
  await once(socket, 'connect')
  const bare = new Bare((request) => socket.send(request))
  socket.on('message', (chunk) => bare.received(chunk))
  return { exchange: bare.all(exchanges), close: () => socket.close() }
}

/** The requests the client really sends for a call, and the length of what comes back to each. */
async function exchangesOf(client, call) {
  const exchanges = []
  const stop = client.on('trace', ({ direction, bytes }) => {
    if (direction === 'sent') exchanges.push({ request: bytes, answerLength: 0 })
    else exchanges.at(-1).answerLength += bytes.length
  })
  await call()
  stop()
  return exchanges
}

const COLUMNS = ['CPU us/call', 'calls/s', 'of bare', 'CPU ratio']

/** The bare socket does less than any program that uses what it reads; the row below it does what the simplest one must. */
async function compareWithBare({ exchange, close }, name, { code, ...how }, alternatives) {
  const read = ([first, ...rest]) => byHand[code](rest.length === 0 ? first : Buffer.concat([first, ...rest]))
  const numbers = async () => {
    const answer = await exchange()
    return Array.isArray(answer[0]) ? answer.flatMap(read) : read(answer)
  }
  const cost = await compare({ 'bare socket': exchange, 'bare, numbers read by hand': numbers, ...alternatives }, how)
  close()
  for (const [what, { cpu, wall, cpuRatio, speedRatio }] of Object.entries(cost)) {
    const ratios = what === 'bare socket' ? [] : [speedRatio.toFixed(2), cpuRatio.toFixed(2)]
    row(`${name}: ${what}`, cpu.toFixed(1), Math.round(1e6 / wall), ...ratios)
  }
}

async function benchTcp(port, code, { withBlocks }) {
  const client = createMelsecClient({ host: HOST, port, code, profile: 'iq-r', frame: '3E' })
  await client.connect()
  try {
    title(`Loopback TCP, 3E ${code}, one request after another`, ...COLUMNS)
    const calls = { 'one word': () => client.read('D100'), '960 words': () => client.read('D0:UINT[960]') }
    if (withBlocks) {
      const plan = client.plan(SCATTERED)
      calls['prepared, 100 scattered items'] = () => plan.run()
    }
    for (const [name, call] of Object.entries(calls)) {
      const bare = await bareTcp(port, await exchangesOf(client, call))
      await compareWithBare(bare, name, { code }, { client: call })
    }
    if (withBlocks) await benchMemory(client)
  } finally {
    await client.close()
  }
}

const SCATTERED = Array.from({ length: 100 }, (_, i) => `D${i * 150}`)

/** Without a serial number an answer is told from earlier ones by its port, or, where that is fixed, by a self test. */
async function benchUdp(port, what, how) {
  const options = { host: HOST, port, profile: 'iq-r', transport: 'udp' }
  const localPort = await freePort()
  const clients = {
    '3E, ports of its own': createMelsecClient({ ...options, frame: '3E' }),
    '3E, fixed port and self tests': createMelsecClient({ ...options, frame: '3E', localPort }),
  }
  try {
    for (const client of Object.values(clients)) await client.connect()
    title(`Loopback UDP, 3E binary, one word, ${what}`, ...COLUMNS)
    const [first] = Object.values(clients)
    const bare = await bareUdp(port, await exchangesOf(first, () => first.read('D100')))
    const alternatives = Object.entries(clients).map(([name, client]) => [name, () => client.read('D100')])
    await compareWithBare(bare, 'one word', { code: 'binary', ...how }, Object.fromEntries(alternatives))
  } finally {
    for (const client of Object.values(clients)) await client.close()
  }
}

async function freePort() {
  const socket = createSocket('udp4')
  socket.bind(0, HOST)
  await once(socket, 'listening')
  const { port } = socket.address()
  socket.close()
  await once(socket, 'close')
  return port
}

export async function benchClient() {
  const server = await startServer()
  try {
    await benchTcp(server.ports.tcp, 'binary', { withBlocks: true })
    await benchTcp(server.ports.tcp, 'ascii', { withBlocks: false })
    await benchUdp(server.ports.udp, 'answered at once')
    await benchUdp(server.ports.slow, 'answered after 2 ms', { rounds: times(9), calls: 60 })
  } finally {
    server.stop()
  }
}

async function benchMemory(client) {
  title('Memory, 100,000 single reads', 'MB before', 'MB after', 'growth kB')
  await costPerCall(() => client.read('D100'), 20_000)
  const before = usedHeap()
  await costPerCall(() => client.read('D100'), 100_000)
  const after = usedHeap()
  row(
    'heap after a full collection',
    (before / 1e6).toFixed(2),
    (after / 1e6).toFixed(2),
    ((after - before) / 1000).toFixed(1),
  )
}

function usedHeap() {
  for (let i = 0; i < 3; i++) globalThis.gc?.()
  return process.memoryUsage().heapUsed
}
