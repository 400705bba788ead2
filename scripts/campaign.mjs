// npm run campaign: a client against a PLC made by hand, with some fifty kinds of faults between them; see test/campaign/.
//   npm run campaign -- --exchanges 100000 --seed 7 --kind "UDP 1E" --fault late
//   npm run campaign -- --list
// A violation names its seed, configuration and scene: the same seed plays the same scenes again, as far as sockets allow.
import { spawnSync } from 'node:child_process'
import { randomInt } from 'node:crypto'
import { join } from 'node:path'
import { parseArgs } from 'node:util'
import { main, root, SetupError } from './setup.mjs'

const { values } = parseArgs({
  options: {
    exchanges: { type: 'string', default: '1000000' },
    seed: { type: 'string', default: String(randomInt(1, 2 ** 31)) },
    kind: { type: 'string', default: '' },
    fault: { type: 'string', default: '' },
    list: { type: 'boolean', default: false },
  },
})

await main(() => {
  for (const name of ['exchanges', 'seed']) {
    if (!/^[1-9]\d{0,9}$/.test(values[name]))
      throw new SetupError(`--${name} is a whole number from 1, not ${values[name]}.`)
  }
  const { exchanges, seed, kind, fault, list } = values
  if (!list) console.log(`seed ${seed}, ${exchanges} exchanges`)
  const jest = join(root, 'node_modules', 'jest', 'bin', 'jest.js')
  const args = [jest, '-i', 'test/campaign', '-t', list ? '^lists' : '^holds']
  const env = {
    ...process.env,
    CAMPAIGN_EXCHANGES: exchanges,
    CAMPAIGN_SEED: seed,
    CAMPAIGN_KIND: kind,
    CAMPAIGN_FAULT: fault,
  }
  const { status } = spawnSync(process.execPath, args, { cwd: root, stdio: 'inherit', env })
  if (status !== 0 && !list) throw new SetupError(`The client did not keep its word: see above. The seed was ${seed}.`)
})
