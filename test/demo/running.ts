/** The demo's processes as a user starts them, and what a test needs to know about them. */
import { type ChildProcess, execFile, type ForkOptions, fork, spawn } from 'node:child_process'
import { once } from 'node:events'
import { mkdtemp, readdir, readFile, rm } from 'node:fs/promises'
import { connect } from 'node:net'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { promisify } from 'node:util'
import type { Page } from 'playwright-core'
import { root } from '../support/root'

const START = 120_000
const END = 20_000

/** `npm start`, with its files in a folder of its own. */
export interface RunningDemo {
  readonly pid: number
  readonly dashboard: string
  readonly editor: string
  /** Ports of the simulated PLCs. */
  readonly iqr: number
  readonly fx5: number
  readonly jw: number
  /** All that was printed so far. */
  readonly output: () => string
  /** Sends a signal, waits for the end, and tells the exit code. */
  end(signal: NodeJS.Signals): Promise<number | null>
  /** Waits for the end. */
  ended(): Promise<number | null>
  /** Ends it if it still runs, and removes its files. */
  cleanUp(): Promise<void>
}

export async function startDemo(): Promise<RunningDemo> {
  const folder = await temporaryFolder()
  const child = spawn(process.execPath, [join(root, 'scripts', 'start.mjs'), folder], {
    cwd: root,
    env: environment(),
    stdio: ['ignore', 'pipe', 'pipe'],
  })
  const gone = once(child, 'exit') as Promise<[number | null]>
  const output = collected(child)
  const ended = async (): Promise<number | null> => (await within(END, 'the demo to end', gone, output))[0]
  const cleanUp = async (): Promise<void> => {
    if (child.exitCode === null && child.signalCode === null) {
      child.kill('SIGTERM')
      await ended().catch(() => child.kill('SIGKILL'))
    }
    await rm(folder, { recursive: true, force: true, maxRetries: 5 })
  }
  try {
    await within(START, 'the demo to run', printed(child, output, /Ctrl-C ends it/), output)
  } catch (error) {
    await cleanUp()
    throw error
  }
  const found = (pattern: RegExp): string => pattern.exec(output())?.[1] ?? ''
  return {
    pid: child.pid ?? 0,
    dashboard: found(/Dashboard: +(\S+)/),
    editor: found(/Editor: +(\S+)/),
    iqr: Number(found(/iQ-R: +127\.0\.0\.1:(\d+) \(TCP and UDP\)/)),
    fx5: Number(found(/FX5U: +127\.0\.0\.1:(\d+) \(TCP and UDP\)/)),
    jw: Number(found(/JW300: +127\.0\.0\.1:(\d+) \(TCP and UDP\)/)),
    output,
    end: (signal) => {
      child.kill(signal)
      return ended()
    },
    ended,
    cleanUp,
  }
}

/** Node-RED with the demo flow alone, for PLCs of the test. */
export interface RunningNodeRed {
  readonly dashboard: string
  stop(): Promise<void>
}

export async function startDemoNodeRed(ports: Readonly<Record<'iqr' | 'fx5' | 'jw', number>>): Promise<RunningNodeRed> {
  const folder = await temporaryFolder()
  const variables = {
    MELSEC_JW_DEMO_IQR_PORT: String(ports.iqr),
    MELSEC_JW_DEMO_FX5_PORT: String(ports.fx5),
    MELSEC_JW_DEMO_JW_PORT: String(ports.jw),
  }
  const options: ForkOptions = {
    cwd: root,
    env: { ...environment(), ...variables },
    stdio: ['ignore', 'pipe', 'pipe', 'ipc'],
    execArgv: [],
  }
  const child = fork(join(root, 'demo', 'node-red.mjs'), [folder], options)
  const gone = once(child, 'exit')
  const output = collected(child)
  const ready = new Promise<{ dashboard: string }>((resolve, reject) => {
    child.on('message', (message) => resolve((message as { ready: { dashboard: string } }).ready))
    child.once('exit', () => reject(new Error(`Node-RED has ended:\n${output()}`)))
  })
  const stop = async (): Promise<void> => {
    if (child.connected) child.send('end')
    await within(END, 'Node-RED to end', gone, output).catch(() => child.kill('SIGKILL'))
    await rm(folder, { recursive: true, force: true, maxRetries: 5 })
  }
  try {
    const { dashboard } = await within(START, 'Node-RED to run', ready, output)
    return { dashboard, stop }
  } catch (error) {
    await stop()
    throw error
  }
}

/** The processes that a process has started and that still run, with their command lines. Linux and macOS. */
export async function childrenOf(pid: number): Promise<{ pid: number; command: string }[]> {
  const all = process.platform === 'linux' ? await listedByProc() : await listedByPs()
  return all.filter(({ parent }) => parent === pid)
}

interface Listed {
  readonly pid: number
  readonly parent: number
  readonly command: string
}

async function listedByPs(): Promise<Listed[]> {
  const { stdout } = await promisify(execFile)('ps', ['-A', '-o', 'pid=,ppid=,args='])
  return stdout.split('\n').flatMap((line) => {
    const [, pid, parent, command] = /^ *(\d+) +(\d+) +(.*)$/.exec(line) ?? []
    return command === undefined ? [] : [{ pid: Number(pid), parent: Number(parent), command }]
  })
}

/** Small containers have no ps. */
async function listedByProc(): Promise<Listed[]> {
  const pids = (await readdir('/proc')).filter((name) => /^\d+$/.test(name))
  const listed = pids.map(async (pid): Promise<Listed[]> => {
    try {
      const stat = await readFile(`/proc/${pid}/stat`, 'utf8')
      const command = await readFile(`/proc/${pid}/cmdline`, 'utf8')
      // The name in brackets may hold anything; the state and the parent's id follow it.
      const [, parent] = stat.slice(stat.lastIndexOf(')') + 2).split(' ')
      return [{ pid: Number(pid), parent: Number(parent), command: command.replaceAll('\0', ' ') }]
    } catch {
      // It has ended meanwhile.
      return []
    }
  })
  return (await Promise.all(listed)).flat()
}

export function isRunning(pid: number): boolean {
  try {
    process.kill(pid, 0)
    return true
  } catch {
    return false
  }
}

/** Whether anything accepts TCP connections on a port of this computer. */
export async function isListening(port: number): Promise<boolean> {
  const socket = connect({ host: '127.0.0.1', port })
  const answered = await Promise.race([
    once(socket, 'connect').then(
      () => true,
      () => false,
    ),
    once(socket, 'close').then(() => false),
  ])
  socket.destroy()
  return answered
}

/** Asks again and again until the answer is right; the error tells the last answer. */
export async function eventually<T>(
  what: string,
  ask: () => T | Promise<T>,
  right: (answer: T) => boolean,
  ms = 15_000,
): Promise<T> {
  const end = Date.now() + ms
  for (;;) {
    const answer = await ask()
    if (right(answer)) return answer
    if (Date.now() > end) throw new Error(`waited ${ms} ms for ${what}; the last answer was ${JSON.stringify(answer)}`)
    await new Promise((resolve) => setTimeout(resolve, 100))
  }
}

/** A widget of a dashboard page by the id of its node. */
export function widget(page: Page, id: string) {
  return page.locator(`#nrdb-ui-widget-${id}`)
}

function temporaryFolder(): Promise<string> {
  return mkdtemp(join(tmpdir(), 'melsec-jw-demo-'))
}

/** Without what Jest or npm put there. */
function environment(): NodeJS.ProcessEnv {
  const inherited = Object.entries(process.env).filter(
    ([name]) => !/^(NODE_RED_|NODE_OPTIONS$|NODE_ENV$|JEST_|npm_|MELSEC_JW_DEMO_)/.test(name),
  )
  return Object.fromEntries(inherited)
}

function collected(child: ChildProcess): () => string {
  let output = ''
  const collect = (chunk: Buffer): void => {
    output += chunk.toString()
  }
  child.stdout?.on('data', collect)
  child.stderr?.on('data', collect)
  return () => output
}

function printed(child: ChildProcess, output: () => string, pattern: RegExp): Promise<void> {
  return new Promise((resolve, reject) => {
    const look = (): void => {
      if (pattern.test(output())) resolve()
    }
    child.stdout?.on('data', look)
    child.once('exit', (code) => reject(new Error(`the demo has ended with exit code ${code}:\n${output()}`)))
    look()
  })
}

async function within<T>(ms: number, what: string, promise: Promise<T>, output: () => string): Promise<T> {
  let timer: NodeJS.Timeout | undefined
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error(`waited ${ms} ms for ${what}:\n${output()}`)), ms)
  })
  try {
    return await Promise.race([promise, late])
  } finally {
    clearTimeout(timer)
  }
}
