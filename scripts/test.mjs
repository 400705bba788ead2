// npm test: set up, then format and lint, types, tests. Stops at the first that fails.
//   npm test -- test/value         the same, with jest limited to these paths (arguments go to jest only)
import { spawnSync } from 'node:child_process'
import { join } from 'node:path'
import { main, root, SetupError, setup } from './setup.mjs'

const colours = process.stdout.isTTY ? [] : ['--colors=off']

const bin = (...path) => join(root, 'node_modules', ...path)

const steps = [
  ['Format and lint', [bin('@biomejs', 'biome', 'bin', 'biome'), 'ci', ...colours, '--error-on-warnings']],
  ['Type check', [bin('typescript', 'bin', 'tsc'), '-p', 'tsconfig.test.json']],
  ['Tests', [bin('jest', 'bin', 'jest.js'), ...process.argv.slice(2)]],
]

await main(async () => {
  await setup()
  for (const [name, args] of steps) {
    const started = performance.now()
    console.log(`\n== ${name}`)
    const { status, signal, error } = spawnSync(process.execPath, args, { cwd: root, stdio: 'inherit' })
    if (status !== 0) {
      const reason = error?.message ?? signal ?? `exit code ${status}`
      throw new SetupError(`npm test stopped: ${name.toLowerCase()} failed (${reason}).`)
    }
    console.log(`== ${name}: passed in ${((performance.now() - started) / 1000).toFixed(1)} s`)
  }
})
