// npm run test:matrix: the packed package in the Node-RED and Node.js versions that it promises to run in.
// Everything comes from npm: the packages node-<platform>-<arch> carry Node.js itself. What is installed stays in
// .matrix/ for the next run; the user directories are made anew each time, outside this folder, so that nothing the
// package forgot to declare is found in our own node_modules.
//
//   npm run test:matrix                 all of them
//   npm run test:matrix -- 5            only those whose name contains "5"
import { spawnSync } from 'node:child_process'
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { main, npm, root, SetupError, setup } from './setup.mjs'

const RUNTIMES = [
  { node: '20.20.2', nodeRed: '4.1.15' },
  { node: '22.23.3', nodeRed: '5.0.7' },
  { node: '24.21.0', nodeRed: '5.0.7' },
]

const work = join(root, '.matrix')

/** The name of the package that carries Node.js for this machine. */
function nodePackage() {
  const platform = process.platform === 'win32' ? 'win' : process.platform
  const prefix = platform === 'darwin' && process.arch === 'arm64' ? 'node-bin' : 'node'
  return `${prefix}-${platform}-${process.arch}`
}

/** Installs packages into a folder of .matrix/ unless they are there already, and returns its node_modules. */
function installed(folder, dependencies) {
  const path = join(work, folder)
  const stamp = join(path, '.installed')
  if (!existsSync(stamp)) {
    console.log(`matrix: installing ${folder}`)
    rmSync(path, { recursive: true, force: true })
    mkdirSync(path, { recursive: true })
    writeFileSync(join(path, 'package.json'), JSON.stringify({ private: true, dependencies }))
    npm(`Installing ${folder}`, ['install', '--no-audit', '--no-fund', '--no-package-lock', '--loglevel=error'], {
      cwd: path,
    })
    writeFileSync(stamp, '')
  }
  return join(path, 'node_modules')
}

function nodeExecutable(version) {
  const modules = installed(`node-${version}`, { 'node-runtime': `npm:${nodePackage()}@${version}` })
  const executable = join(modules, 'node-runtime', 'bin', process.platform === 'win32' ? 'node.exe' : 'node')
  const { stdout } = spawnSync(executable, ['--version'], { encoding: 'utf8' })
  if (stdout?.trim() !== `v${version}`) throw new SetupError(`${executable} is not Node.js ${version}.`)
  return executable
}

/** Packs the package as it would be published. */
function pack() {
  const folder = join(work, 'package')
  rmSync(folder, { recursive: true, force: true })
  mkdirSync(folder, { recursive: true })
  npm('npm pack', ['pack', '--ignore-scripts', '--loglevel=error', '--pack-destination', folder])
  return join(folder, readdirSync(folder)[0])
}

/** A fresh user directory of Node-RED with the packed package in it, as the palette manager would install it. */
function userDirectory(parent, name, tarball) {
  const path = join(parent, name)
  mkdirSync(path)
  writeFileSync(
    join(path, 'package.json'),
    JSON.stringify({ name: 'node-red-project', private: true, version: '0.0.1' }),
  )
  const started = performance.now()
  npm('Installing the package', ['install', '--no-audit', '--no-fund', '--omit=dev', '--loglevel=error', tarball], {
    cwd: path,
  })
  console.log(`matrix: ${name}: package installed in ${((performance.now() - started) / 1000).toFixed(1)} s`)
  return path
}

await main(async () => {
  await setup()
  const wanted = process.argv[2] ?? ''
  const named = RUNTIMES.map((runtime) => ({
    ...runtime,
    name: `Node-RED ${runtime.nodeRed} on Node.js ${runtime.node}`,
  }))
  const chosen = named.filter(({ name }) => name.includes(wanted))
  if (chosen.length === 0) throw new SetupError(`no runtime is called "${wanted}": ${named.map(({ name }) => name)}`)
  const tarball = pack()
  const users = mkdtempSync(join(tmpdir(), 'melsec-jw-matrix-'))
  try {
    const runtimes = chosen.map(({ name, node, nodeRed }) => ({
      name,
      nodeVersion: node,
      nodeRedVersion: nodeRed,
      node: nodeExecutable(node),
      script: join(installed(`node-red-${nodeRed}`, { 'node-red': nodeRed }), 'node-red', 'red.js'),
      userDir: userDirectory(users, `${nodeRed}-${node}`, tarball),
      version: JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')).version,
    }))
    const list = join(work, 'runtimes.json')
    writeFileSync(list, JSON.stringify(runtimes, null, 2))
    const jest = join(root, 'node_modules', 'jest', 'bin', 'jest.js')
    const config = join(root, 'test', 'matrix', 'jest.config.cjs')
    const { status } = spawnSync(process.execPath, [jest, '--config', config], {
      cwd: root,
      stdio: 'inherit',
      env: { ...process.env, MELSEC_JW_MATRIX: list },
    })
    if (status !== 0) throw new SetupError('npm run test:matrix failed; see the output above.')
  } finally {
    rmSync(users, { recursive: true, force: true, maxRetries: 3 })
  }
})
