// npm run bench: prints, asserts nothing. Alternatives are measured in turn within one run; compare figures of one run.
import { cpus } from 'node:os'
import v8 from 'node:v8'
import { runInNewContext } from 'node:vm'
import { benchClient } from './client.mjs'
import { benchCodec } from './codec.mjs'
import { benchLine } from './line.mjs'
import { benchPlanning } from './planning.mjs'

v8.setFlagsFromString('--expose_gc')
globalThis.gc = runInNewContext('gc')

console.log(`Node.js ${process.version}, ${cpus().length} x ${cpus()[0]?.model ?? 'unknown processor'}`)
// All of them, or those that are named: node bench/main.mjs planning. With --quick everything is done once.
const benches = { client: benchClient, planning: benchPlanning, codec: benchCodec, line: benchLine }
const asked = process.argv.slice(2).filter((name) => name in benches)
for (const [name, bench] of Object.entries(benches)) if (asked.length === 0 || asked.includes(name)) await bench()
