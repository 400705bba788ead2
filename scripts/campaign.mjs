// npm run campaign: a client against a PLC made by hand, with some fifty kinds of faults between them; see test/campaign/.
//   npm run campaign -- --exchanges 100000 --seed 7 --kind "UDP 1E" --fault late
//   npm run campaign -- --list
// With --serial: clients on real pairs of serial ports against a simulated line in another program; so many calls on each kind of line.
//   npm run campaign -- --serial --exchanges 2000 --seed 7 --kind "3C format 4" --fault wire
// A violation names its seed, configuration and scene: the same seed plays the same scenes again, as far as sockets allow.
import { spawnSync } from 'node:child_process'
import { randomInt } from 'node:crypto'
import { join } from 'node:path'
import { parseArgs } from 'node:util'
import { main, root, SetupError } from './setup.mjs'

const { values } = parseArgs({
  options: {
    exchanges: { type: 'string' },
    seed: { type: 'string', default: String(randomInt(1, 2 ** 31)) },
    kind: { type: 'string', default: '' },
    fault: { type: 'string', default: '' },
    serial: { type: 'boolean', default: false },
    list: { type: 'boolean', default: false },
  },
})

await main(() => {
  const { seed, kind, fault, list, serial } = values
  const { exchanges = serial ? '10000' : '1000000' } = values
  for (const [name, value] of Object.entries({ exchanges, seed })) {
    if (!/^[1-9]\d{0,9}$/.test(value)) throw new SetupError(`--${name} is a whole number from 1, not ${value}.`)
  }
  if (!list) console.log(`seed ${seed}, ${exchanges} exchanges${serial ? ' on each kind of serial line' : ''}`)
  const jest = join(root, 'node_modules', 'jest', 'bin', 'jest.js')
  const [path, test] = serial
    ? ['test/campaign/serial.test.ts', list ? '^lists serial' : '^no wrong value']
    : ['test/campaign/campaign.test.ts', list ? '^lists' : '^holds']
  const args = [jest, '-i', path, '-t', test]
  const env = {
    ...process.env,
    CAMPAIGN_EXCHANGES: exchanges,
    CAMPAIGN_SEED: seed,
    CAMPAIGN_KIND: kind,
    CAMPAIGN_FAULT: fault,
    ...(serial ? { CAMPAIGN_SERIAL: '1' } : {}),
  }
  const { status } = spawnSync(process.execPath, args, { cwd: root, stdio: 'inherit', env })
  if (status !== 0 && !list) throw new SetupError(`The client did not keep its word: see above. The seed was ${seed}.`)
})
