// npm run fuzz: random and damaged frames of every kind, a million of each, through every scanner and decoder.
//   npm run fuzz -- --frames 20000 --seed 7 --kind "4E ascii"
// A failure names its seed and place: the same seed makes the same frames again.
import { spawnSync } from 'node:child_process'
import { randomInt } from 'node:crypto'
import { join } from 'node:path'
import { parseArgs } from 'node:util'
import { main, root, SetupError } from './setup.mjs'

const { values } = parseArgs({
  options: {
    frames: { type: 'string', default: '500000' },
    seed: { type: 'string', default: String(randomInt(1, 2 ** 31)) },
    kind: { type: 'string', default: '' },
  },
})

await main(() => {
  for (const name of ['frames', 'seed']) {
    if (!/^[1-9]\d{0,9}$/.test(values[name]))
      throw new SetupError(`--${name} is a whole number from 1, not ${values[name]}.`)
  }
  console.log(`seed ${values.seed}, ${values.frames} frames of each kind in each direction`)
  const args = [join(root, 'node_modules', 'jest', 'bin', 'jest.js'), '-i', 'test/fuzz', '-t', `^${values.kind}`]
  const env = { ...process.env, FUZZ_FRAMES: values.frames, FUZZ_SEED: values.seed }
  const { status } = spawnSync(process.execPath, args, { cwd: root, stdio: 'inherit', env })
  if (status !== 0) throw new SetupError(`A frame was not read as it must be: see above. The seed was ${values.seed}.`)
})
