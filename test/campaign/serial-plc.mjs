// The other program of the serial campaign: the simulated line at its end of a pair of ports, with the faults of the simulator and
// a wire that damages characters by itself. It tells when what was carried out; the time is the same for all programs of a computer.
//   node serial-plc.mjs '{"path":"/dev/pts/7","baudRate":9600, ...}'
import { createRequire } from 'node:module'

const require = createRequire(import.meta.url)
const { createLineSimulator } = require('../../dist/src/entry/simulator.js')
const { SerialPort } = require('serialport')

const given = JSON.parse(process.argv[2])
const { path, baudRate, messageFormat, sumCheck, stations, cells, pace, echo, noise } = given

const now = () => Number(process.hrtime.bigint()) / 1e6
let state = given.seed >>> 0 || 1
function below(end) {
  state ^= state << 13
  state ^= state >>> 17
  state ^= state << 5
  state >>>= 0
  return end <= 1 ? 0 : state % end
}
const pick = (list) => list[below(list.length)]

const port = { path, baudRate, dataLength: 8, parity: 'none' }
const line = createLineSimulator({
  messageFormat,
  sumCheck,
  echo,
  ...(pace ? { pace: { baudRate, dataLength: 8, parity: 'none' } } : {}),
  ...(noise === undefined ? { serial: port } : { tcp: false }),
  stations: Object.fromEntries(stations.map((station) => [station, {}])),
})

const done = []
for (const [number, station] of line.stations) {
  for (let cell = 0; cell < cells; cell++) station.write(`D${cell}`, given.first + number * cells + cell)
  station.on('write', ({ command, message }) =>
    done.push({ at: now(), station: number, cells: cellsOf(command, message) }),
  )
}

/** What a write changed: numbers of D, and their values. */
function cellsOf(command, message) {
  if (command === 'writeWords') return message.values.map((value, i) => [message.head.number + i, value])
  if (command === 'writeBlock') {
    return message.wordBlocks.flatMap(({ head, values }) => values.map((value, i) => [head.number + i, value]))
  }
  if (command === 'writeRandomWords') {
    return [
      ...message.words.map(({ device, value }) => [device.number, value]),
      ...message.doubleWords.flatMap(({ device, value }) => [
        [device.number, value & 0xffff],
        [device.number + 1, value >>> 16],
      ]),
    ]
  }
  throw new Error(`a write by ${command}`)
}

// --- what goes wrong: one thing at most with each request

const struck = {}
let armed

const changes = () => ({ what: pick(['lost', 'doubled', 'changed']), at: below(70), mask: 1 + below(255) })
const { answerTime, betweenBytes } = noise ?? {}
const kinds = {
  silence: () => ({ kind: 'silence' }),
  drop: () => ({ kind: 'drop' }),
  slow: () => ({ kind: 'delay', ms: 1 + below(answerTime / 2) }),
  late: () => ({ kind: 'delay', ms: answerTime - 10 + below(3 * answerTime) }),
  held: () => ({ kind: 'late', until: pick(['request', 'answer']) }),
  duplicate: () => ({ kind: 'duplicate', copies: 1 + below(2) }),
  split: () => ({ kind: 'split', at: 1 + below(30), pause: 1 + below(3 * betweenBytes) }),
  dribble: () => ({ kind: 'dribble', size: 1 + below(9), pause: 1 }),
  cut: () => ({ kind: 'cut', at: 1 + below(40) }),
  garbage: () => ({ kind: 'garbage', bytes: 1 + below(8), place: pick(['before', 'after', 'instead']) }),
  damaged: () => ({ kind: 'damaged', ...changes() }),
  misheard: () => ({ kind: 'misheard', ...changes() }),
  wrongSum: () => ({ kind: 'wrongSum' }),
  noise: () => ({ kind: 'noise', bytes: 1 + below(4), ms: below(20), seed: below(2 ** 31) }),
  stranger: () => ({ kind: 'wrongRoute', station: pick(stations), network: 0 }),
  refusal: () => ({ kind: 'endCode', endCode: given.refusal }),
}
// On the wire between the two programs, whatever the simulator makes of it.
const wires = ['wire request', 'wire answer', 'wire both', 'wire initialise']

function arm() {
  if (armed?.fault !== undefined) {
    count(armed.name, armed.fault.struck)
    armed.fault.remove()
  }
  armed = undefined
  if (below(1000) >= noise.share * 1000) return
  const name = pick(noise.kinds)
  if (wires.includes(name)) {
    const places = { 'wire both': ['request', 'answer'], 'wire initialise': ['initialise', 'answer'] }[name] ?? [
      name.slice(5),
    ]
    armed = { name, places }
  } else armed = { name, fault: line.faults.add({ ...kinds[name](), times: 1 }) }
}

function count(name, times) {
  if (times > 0) struck[name] = (struck[name] ?? 0) + times
}

/** One character is another one, is lost, comes twice, or another one stands in front of it. */
function onWire(place, bytes) {
  if (armed?.places?.includes(place) !== true) return bytes
  armed.places = armed.places.filter((other) => other !== place)
  count(armed.name, 1)
  if (place === 'initialise') return Buffer.alloc(0)
  const at = below(bytes.length)
  const byte = bytes[at]
  const [before, behind] = [bytes.subarray(0, at), bytes.subarray(at + 1)]
  const middle = pick([[byte ^ (1 + below(255))], [], [byte, byte], [below(256), byte]])
  return Buffer.concat([before, Buffer.from(middle), behind])
}

// A PLC that is late because its computer was busy is no fault of the client: a PLC that has slept says and hears nothing for a
// moment, as one that is switched on.
const LONGEST_SLEEP = 30
const MOMENT = 25
let awake = now()
let dazedUntil = 0
let asleep = 0

function isDazed() {
  const time = now()
  if (time - awake > LONGEST_SLEEP) dazedUntil = time + MOMENT
  awake = time
  if (time >= dazedUntil) return false
  asleep += 1
  return true
}

/** What went over the wire, for the story of a violation. */
const story = []
const tell = (what, bytes = Buffer.alloc(0)) =>
  story.push([now(), `${what} ${JSON.stringify(bytes.toString('latin1'))}`])

function openNoisy() {
  setInterval(() => {
    if (now() - awake > LONGEST_SLEEP) dazedUntil = now() + MOMENT
    awake = now()
  }, 5)
  const simulated = line.connect()()
  const tty = new SerialPort({ path, baudRate, dataBits: 8, parity: 'none', stopBits: 1, lock: true, autoOpen: false })
  simulated.open({ opened() {}, closed() {}, received: (bytes) => sayToHost(tty, Buffer.from(bytes)) })
  tty.on('data', (bytes) => {
    if (isDazed()) {
      tell('slept through', bytes)
      return
    }
    const place = bytes.length > 4 ? 'request' : 'initialise'
    if (place === 'request') arm()
    const left = onWire(place, bytes)
    tell(`< ${armed?.name ?? ''}`, left)
    if (left.length > 0) simulated.send(left)
  })
  return new Promise((resolve, reject) => tty.open((error) => (error === null ? resolve() : reject(error))))
}

function sayToHost(tty, bytes) {
  if (isDazed()) {
    tell('overslept', bytes)
    return
  }
  const left = onWire('answer', bytes)
  tell('>', left)
  tty.write(left)
}

process.on('disconnect', () => process.exit())
process.on('message', (what) => {
  if (what === 'truth') process.send({ done, struck, asleep, requests: line.statistics.requests })
  if (what === 'story') process.send(story)
})
if (noise === undefined) await line.listen()
else await openNoisy()
process.send('open')
