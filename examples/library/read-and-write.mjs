// Reads and writes a PLC, the short way and the careful way.
//
//   melsec-jw simulate --plant                            a simulated PLC to try it on, in another terminal
//   node read-and-write.mjs                               127.0.0.1, port 5007
//   node read-and-write.mjs 192.168.3.39 5010             your PLC; or PLC_HOST, PLC_PORT and PLC_PROFILE
//
// It writes D110 (the batch size of the simulated plant) and puts the old value back. Look at what D110 is in your PLC
// before you run it there.
import { createMelsecClient, PlcError } from '@melsec-jw/plc'

const { PLC_HOST = '127.0.0.1', PLC_PORT = '5007', PLC_PROFILE = 'iq-r' } = process.env
const [host = PLC_HOST, port = PLC_PORT] = process.argv.slice(2)

const plc = createMelsecClient({
  host,
  port: Number(port),
  // The family decides how X and Y are numbered, what one request may hold, and what is refused before it is sent.
  profile: PLC_PROFILE,
  // Without this the client refuses to write.
  allowWrites: true,
})

try {
  // Not needed, but it says at once, and with causes, why a PLC does not answer.
  await plc.connect()

  // One item. The type stands behind the address; without it D100 is an INT and M10 a BOOL.
  const level = await plc.read('D100:REAL')
  console.log(`level        ${level.toFixed(1)} l`)

  // Several by name, in as few requests as possible. The first that fails throws.
  const tank = await plc.readValues({
    temperature: 'D102:REAL',
    batches: 'D120:DINT',
    running: 'M10',
    product: 'D130:STRING(20)',
    setPoints: 'D110:REAL[2]',
  })
  console.log('tank        ', tank)

  // Several, each with a result of its own: one bad item does not hide the others.
  const results = await plc.read({ alarm: 'M20', nonsense: 'D99999999' })
  for (const [name, result] of Object.entries(results)) {
    console.log(`${name.padEnd(12)} ${result.ok ? result.value : `not read: ${result.error.code}`}`)
  }

  // Write, and look whether it is there. A write is never repeated by the client.
  const before = await plc.read('D110:REAL')
  await plc.write('D110:REAL', 650)
  console.log(`D110         was ${before}, is ${await plc.read('D110:REAL')}`)

  // Several at once; an address that is a text can hold its type, as everywhere.
  await plc.write({ 'D110:REAL': before, 'D150:WSTRING(16)': 'Operator 1' })
  console.log(`D110         is ${await plc.read('D110:REAL')} again`)
} catch (error) {
  // Everything that can go wrong with a PLC is a PlcError. `outcome` says whether the PLC may have carried it out.
  if (!(error instanceof PlcError)) throw error
  console.error(`${error.code} (${error.outcome}): ${error.message}`)
  process.exitCode = 1
} finally {
  await plc.close()
}
