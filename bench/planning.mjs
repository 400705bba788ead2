// Plans of 100 items from text: texts that were never seen before, the same list again, and the first plan of a process.
import { execFileSync } from 'node:child_process'
import { createRequire } from 'node:module'
import { fileURLToPath } from 'node:url'
import { median, row, times, title } from './measure.mjs'

const require = createRequire(import.meta.url)
const ITEMS = 100
const ROUNDS = times(15)
const PLANS = times(40)
const PROCESSES = times(7)

/** Scattered words, as a table of a SCADA system has them. */
const scattered = (from) => Array.from({ length: ITEMS }, (_, i) => `D${from + i * 150}`)

const KINDS = [
  (n) => `D${n}`,
  (n) => `D${n}:REAL`,
  (n) => `M${n}`,
  (n) => `X${n.toString(16).toUpperCase()}`,
  (n) => `D${n}.${(n % 16).toString(16).toUpperCase()}`,
  (n) => `W${(n % 4096).toString(16).toUpperCase()}:DINT`,
  (n) => `D${n}:STRING(20)`,
  (n) => `K4M${n}`,
  (n) => `R${n}:INT[10]`,
  (n) => `TN${n % 512}`,
]

/** What a line has: words, numbers, bits, texts, arrays. */
const mixed = (from) => Array.from({ length: ITEMS }, (_, i) => KINDS[i % KINDS.length](from + i * 37))

const lists = { 'scattered words': scattered, 'mixed items': mixed }

function clientOf() {
  const { createMelsecClient } = require('../dist/src/index.js')
  return createMelsecClient({ host: '127.0.0.1', port: 1, profile: 'iq-r' })
}

const millisecondsOf = (work) => {
  const start = process.hrtime.bigint()
  work()
  return Number(process.hrtime.bigint() - start) / 1e6
}

/** Median milliseconds per plan; `listOf` is called for each plan, outside the time that is measured. */
function warm(client, listOf) {
  let next = 0
  const round = () => {
    const given = Array.from({ length: PLANS }, () => listOf(next++))
    return millisecondsOf(() => {
      for (const items of given) client.plan(items)
    })
  }
  for (let i = 0; i < 5; i++) round()
  return median(Array.from({ length: ROUNDS }, round)) / PLANS
}

/** What the first plan of a fresh process takes; loading the package is not counted. */
function cold(name) {
  const run = () => Number(execFileSync(process.execPath, [fileURLToPath(import.meta.url), name], { encoding: 'utf8' }))
  return median(Array.from({ length: PROCESSES }, run))
}

export function benchPlanning() {
  title('Planning of 100 items from text, milliseconds', 'new texts', 'same list', 'fresh process')
  for (const [name, listOf] of Object.entries(lists)) {
    const client = clientOf()
    const fresh = warm(client, (n) => listOf(n % 2000))
    const same = warm(client, () => listOf(0))
    row(name, fresh.toFixed(3), same.toFixed(3), cold(name).toFixed(1))
  }
}

const asked = process.argv[2]
if (asked !== undefined && asked in lists) {
  const client = clientOf()
  console.log(millisecondsOf(() => client.plan(lists[asked](0))))
}
