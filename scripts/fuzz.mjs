// npm run fuzz: random and damaged frames of every kind, a million of each, through every scanner and decoder; and the
// property tests with other examples than those of npm test.
//   npm run fuzz -- --frames 20000 --seed 7 --kind "4E ascii"
// A failure names its seed and place: the same seed makes the same frames again.
import { spawnSync } from 'node:child_process'
import { randomInt } from 'node:crypto'
import { readdirSync, readFileSync } from 'node:fs'
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
  const { frames, seed, kind } = values
  run(['test/fuzz', '-t', `^${kind}`], { FUZZ_FRAMES: frames, FUZZ_SEED: seed }, 'A frame was not read as it must be')
  // Of one kind of frame alone nobody asks for the others.
  if (kind !== '') return
  console.log(`property tests with seed ${seed}`)
  run(propertyTests(), { FAST_CHECK_SEED: seed }, 'A property does not hold')
})

function run(args, variables, failure) {
  const jest = join(root, 'node_modules', 'jest', 'bin', 'jest.js')
  const env = { ...process.env, ...variables }
  const { status } = spawnSync(process.execPath, [jest, '-i', ...args], { cwd: root, stdio: 'inherit', env })
  if (status !== 0) throw new SetupError(`${failure}: see above. The seed was ${values.seed}.`)
}

/** Tests that draw examples, by themselves or by what they import. */
function propertyTests() {
  const tests = readdirSync(join(root, 'test'), { recursive: true }).filter((path) => path.endsWith('.test.ts'))
  const draws = (path) => /from '(fast-check|.*arbitrary.*)'/.test(readFileSync(join(root, 'test', path), 'utf8'))
  return tests.filter(draws).map((path) => join('test', path))
}
