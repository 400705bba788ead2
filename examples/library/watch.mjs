// Watches devices of a PLC and prints what changes. Ctrl-C ends it.
//
//   melsec-jw simulate --plant                            a simulated PLC to try it on, in another terminal
//   node watch.mjs                                        127.0.0.1, port 5007
//   node watch.mjs 192.168.3.39 5010 D100:REAL M10 X1F    your PLC and items; or PLC_HOST, PLC_PORT and PLC_PROFILE
import { setTimeout as pause } from 'node:timers/promises'
import { createMelsecClient } from '@melsec-jw/plc'

const { PLC_HOST = '127.0.0.1', PLC_PORT = '5007', PLC_PROFILE = 'iq-r', INTERVAL = '500' } = process.env
const [host = PLC_HOST, port = PLC_PORT, ...given] = process.argv.slice(2)
const items =
  given.length > 0 ? given : ['M10', 'M20', 'Y20', 'Y21', 'D100:REAL', 'D102:REAL', 'D120:DINT', 'D130:STRING(20)']

const plc = createMelsecClient({ host, port: Number(port), profile: PLC_PROFILE })

const stop = new AbortController()
for (const signal of ['SIGINT', 'SIGTERM']) process.once(signal, () => stop.abort())

// `node watch.mjs | head` closes the pipe early: that is no failure.
process.stdout.on('error', (error) => {
  if (error.code !== 'EPIPE') throw error
  stop.abort()
})

const print = (text) => console.log(`${new Date().toISOString()}  ${text}`)

// The client reconnects by itself; this only tells about it.
plc.on('state', ({ name, error }) => {
  if (name === 'connected') print('connected')
  if (name === 'waiting') print(`no connection: ${error?.message}`)
})

// Prepared once, run again and again: the items become as few requests as possible.
const plan = plc.plan(items)
console.log(`${plan}\n`)

const last = new Map()
while (!stop.signal.aborted) {
  // Each item has a result of its own, also when there is no connection at the moment.
  for (const result of await plan.run({ signal: stop.signal })) {
    if (stop.signal.aborted) break
    const now = result.ok ? String(result.value) : `not read: ${result.error.code}`
    if (last.get(result.item) === now) continue
    last.set(result.item, now)
    print(`${result.item.padEnd(16)} ${now}`)
  }
  await pause(Number(INTERVAL), undefined, { signal: stop.signal }).catch(() => {})
}
await plc.close()
