// npm run bench: prints, asserts nothing. Alternatives are measured in turn within one run; compare figures of one run.
import { cpus } from 'node:os'
import v8 from 'node:v8'
import { runInNewContext } from 'node:vm'
import { benchClient } from './client.mjs'
import { benchCodec } from './codec.mjs'

v8.setFlagsFromString('--expose_gc')
globalThis.gc = runInNewContext('gc')

console.log(`Node.js ${process.version}, ${cpus().length} x ${cpus()[0]?.model ?? 'unknown processor'}`)
benchCodec()
await benchClient()
