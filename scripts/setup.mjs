// Makes the working copy ready: node_modules as package-lock.json says, dist as the sources say.
// Plain Node and no dependencies, because it runs before any are installed. Does nothing when nothing is stale.
//
//   node scripts/setup.mjs             install what is missing, build what is stale
//   node scripts/setup.mjs --build     build only (never touches node_modules)
//   node scripts/setup.mjs --unchecked build only, type errors or not: for tests of a tree that is being worked on
import { spawnSync } from 'node:child_process'
import { createHash } from 'node:crypto'
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs'
import { dirname, extname, join, relative, sep } from 'node:path'
import { fileURLToPath, pathToFileURL } from 'node:url'
import { buildModules } from './modules.mjs'

export const root = dirname(dirname(fileURLToPath(import.meta.url)))

const LOWEST_NODE = 20
const installStamp = join(root, 'node_modules', '.lock-hash')
const dist = join(root, 'dist')
const buildStamp = join(dist, '.build-hash')

/** A failure whose message is all the user needs; no stack is shown. */
export class SetupError extends Error {}

function readOrEmpty(file) {
  return existsSync(file) ? readFileSync(file, 'utf8').trim() : ''
}

/** Runs a command with its output shown; throws SetupError when it fails. */
function run(what, command, args, options = {}) {
  const result = spawnSync(command, args, { cwd: root, stdio: 'inherit', ...options })
  if (result.error) throw new SetupError(`${what} could not be started: ${result.error.message}`)
  if (result.status !== 0) {
    throw new SetupError(`${what} failed (${result.signal ?? `exit code ${result.status}`}); see the output above.`)
  }
}

/** Runs npm without a shell where possible: on Windows npm is a .cmd file, which only a shell starts. */
export function npm(what, args, options = {}) {
  const script = process.env.npm_execpath
  // npm_execpath also names yarn and pnpm, which know nothing of our lock file.
  if (script && /npm-cli\.c?js$/.test(script)) return run(what, process.execPath, [script, ...args], options)
  return run(what, 'npm', args, { shell: process.platform === 'win32', ...options })
}

/** What node_modules must have been installed from: the lock file, for this platform (some packages are binaries). */
function wantedInstall() {
  const hash = createHash('sha256').update(readFileSync(join(root, 'package-lock.json')))
  return `${hash.digest('hex')} ${process.platform}-${process.arch}`
}

export function install() {
  const wanted = wantedInstall()
  if (readOrEmpty(installStamp) === wanted) return
  const reason = existsSync(join(root, 'node_modules')) ? 'do not match package-lock.json' : 'are missing'
  console.log(`setup: the installed packages ${reason}; running npm ci (about a minute)`)
  // Gone before npm starts: an interrupted install must not look like a finished one.
  rmSync(installStamp, { force: true })
  npm('npm ci', ['ci', '--include=dev', '--no-audit', '--no-fund'])
  writeFileSync(installStamp, `${wanted}\n`)
}

/** Every file below a folder, sorted, as paths from the project's root with forward slashes. */
export function filesBelow(folder) {
  const full = join(root, folder)
  if (!existsSync(full)) return []
  return readdirSync(full, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) =>
      relative(root, join(entry.parentPath ?? entry.path, entry.name))
        .split(sep)
        .join('/'),
    )
    .sort()
}

/** What is copied beside the compiled nodes: Node-RED looks for the .html, locales/ and icons/ next to the .js. */
function assets() {
  return filesBelow('nodes').filter(
    (file) => extname(file) === '.html' || file.startsWith('nodes/locales/') || file.startsWith('nodes/icons/'),
  )
}

/** One hash over names and contents: times are unreliable after a checkout, and a removed source must count too. */
function wantedBuild() {
  const hash = createHash('sha256')
  const sources = [
    ...filesBelow('src'),
    ...filesBelow('nodes'),
    'tsconfig.json',
    'package-lock.json',
    'scripts/setup.mjs',
    'scripts/modules.mjs',
  ]
  for (const file of sources)
    hash
      .update(`${file}\0`)
      .update(readFileSync(join(root, file)))
      .update('\0')
  return hash.digest('hex')
}

/**
 * Compiles into a fresh folder and swaps it in: a failed or interrupted build leaves the old dist alone, and nothing
 * that no source makes any more stays behind. The folder lies beside dist, so that relative paths come out the same.
 */
export async function build({ unchecked = false } = {}) {
  const wanted = wantedBuild()
  if (readOrEmpty(buildStamp) === wanted) return
  console.log('setup: building dist')
  const fresh = join(root, `.dist-${process.pid}`)
  const old = `${fresh}-old`
  try {
    rmSync(fresh, { recursive: true, force: true })
    const tsc = join(root, 'node_modules', 'typescript', 'bin', 'tsc')
    const compile = [tsc, '-p', 'tsconfig.json', '--outDir', fresh]
    if (unchecked) spawnSync(process.execPath, [...compile, '--noEmitOnError', 'false'], { cwd: root })
    else run('The build (tsc)', process.execPath, compile)
    for (const file of assets()) {
      mkdirSync(dirname(join(fresh, file)), { recursive: true })
      cpSync(join(root, file), join(fresh, file))
    }
    const modules = filesBelow('src').filter((file) => !file.startsWith('src/cli/'))
    await buildModules(modules, { root, outdir: join(fresh, 'esm'), readFile: (path) => readFileSync(path, 'utf8') })
    // Without the stamp the next set-up builds again, and then checks.
    if (!unchecked) writeFileSync(join(fresh, '.build-hash'), `${wanted}\n`)
    swapIn(fresh, old)
  } finally {
    rmSync(fresh, { recursive: true, force: true })
    rmSync(old, { recursive: true, force: true })
  }
}

/** Two test workers may build at once: then one finds the other's dist in its place, and replaces that. */
function swapIn(fresh, old) {
  mkdirSync(old, { recursive: true })
  for (let attempt = 1; ; attempt += 1) {
    try {
      moveIfThere(dist, join(old, String(attempt)))
      renameSync(fresh, dist)
      return
    } catch (error) {
      if (['ENOTEMPTY', 'EEXIST'].includes(error.code) && attempt < 10) continue
      throw new SetupError(`dist could not be replaced (${error.code}): stop the programs that use it and try again.`)
    }
  }
}

function moveIfThere(from, to) {
  try {
    renameSync(from, to)
  } catch (error) {
    if (error.code !== 'ENOENT') throw error
  }
}

export async function setup({ buildOnly = false, unchecked = false } = {}) {
  const major = Number(process.versions.node.split('.')[0])
  if (major < LOWEST_NODE) {
    throw new SetupError(`Node.js ${process.versions.node} is too old: this project needs ${LOWEST_NODE} or newer.`)
  }
  if (!buildOnly && !unchecked) install()
  await build({ unchecked })
}

/** Runs a script's main function: a SetupError becomes one clear line and exit code 1. */
export async function main(body) {
  try {
    await body()
  } catch (error) {
    console.error(error instanceof SetupError ? `\n${error.message}` : error)
    process.exitCode = 1
  }
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const asked = new Set(process.argv.slice(2))
  await main(() => setup({ buildOnly: asked.has('--build'), unchecked: asked.has('--unchecked') }))
}
