// The client over loopback TCP beside a bare socket that exchanges the same bytes, and its memory over many requests.
import { fork } from 'node:child_process'
import { once } from 'node:events'
import { createRequire } from 'node:module'
import { connect } from 'node:net'
import { compare, costPerCall, row, title } from './measure.mjs'

const require = createRequire(import.meta.url)
const { createMelsecClient } = require('../dist/src/index.js')

async function startServer() {
  const server = fork(new URL('./server.mjs', import.meta.url))
  const [{ port }] = await once(server, 'message')
  return { port, stop: () => server.kill() }
}

/** A socket that sends `request` and waits for as many bytes as the answer has. */
async function bareSocket(port, request, answerLength) {
  const socket = connect(port, '127.0.0.1')
  socket.setNoDelay(true)
  await once(socket, 'connect')
  let missing = 0
  let done = () => {}
  socket.on('data', (chunk) => {
    missing -= chunk.length
    if (missing === 0) done()
  })
  const exchange = () =>
    new Promise((resolve) => {
      missing = answerLength
      done = resolve
      socket.write(request)
    })
  return { exchange, close: () => socket.destroy() }
}

/** The bytes the client really sends for a call, and the length of what comes back. */
async function bytesOf(client, call) {
  const sent = []
  let received = 0
  const stop = client.on('trace', (entry) => {
    if (entry.direction === 'sent') sent.push(entry.bytes)
    else received += entry.bytes.length
  })
  await call()
  stop()
  return { request: Buffer.concat(sent), answerLength: received }
}

export async function benchClient() {
  const server = await startServer()
  const client = createMelsecClient({ host: '127.0.0.1', port: server.port, profile: 'iq-f' })
  await client.connect()
  try {
    const scattered = Array.from({ length: 100 }, (_, i) => `D${i * 150}`)
    const plan = client.plan(scattered)
    const block = client.plan(['D0:UINT[960]'])
    title('Loopback TCP, 3E binary, one request after another', 'CPU us/call', 'calls/s', 'CPU - bare', 'CPU ratio')
    await compareWithBare(server.port, client, 'read one word', () => client.read('D100'))
    await compareWithBare(server.port, client, 'read 960 words', () => block.run())
    await compareWithBare(server.port, client, 'prepared read of 100 scattered items', () => plan.run())
    await benchPlanning(client, scattered)
    await benchMemory(client)
  } finally {
    await client.close()
    server.stop()
  }
}

async function compareWithBare(port, client, name, call) {
  const { request, answerLength } = await bytesOf(client, call)
  const bare = await bareSocket(port, request, answerLength)
  const cost = await compare({ bare: bare.exchange, client: call })
  bare.close()
  row(`${name}: bare socket`, cost.bare.cpu.toFixed(1), Math.round(1e6 / cost.bare.wall), '', '')
  const more = (cost.client.cpu - cost.bare.cpu).toFixed(1)
  row(
    `${name}: client`,
    cost.client.cpu.toFixed(1),
    Math.round(1e6 / cost.client.wall),
    more,
    (cost.client.cpu / cost.bare.cpu).toFixed(2),
  )
}

async function benchPlanning(client, items) {
  title('Planning', 'CPU us')
  await costPerCall(() => client.plan(items), 200)
  const { cpu } = await costPerCall(() => client.plan(items), 500)
  row('plan of 100 scattered items, from text', cpu.toFixed(1))
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
