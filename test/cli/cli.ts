/** The command line as users start it: the built program in a process of its own. */
import { type ChildProcess, spawn, spawnSync } from 'node:child_process'
import { once } from 'node:events'
import { join } from 'node:path'
import { root } from '../support/root'

const MAIN = join(root, 'dist', 'src', 'cli', 'main.js')
/** Longer than any command here may take. */
const LATE = 15_000

/** The program must be that of the sources; after `npm test` has set up this does nothing. */
export function build(): void {
  const built = spawnSync(process.execPath, [join(root, 'scripts', 'setup.mjs'), '--unchecked'], { encoding: 'utf8' })
  if (built.status !== 0) throw new Error(`the build failed:\n${built.stdout}${built.stderr}`)
}

export interface Ended {
  readonly code: number | null
  readonly out: string
  readonly err: string
}

/** Without the settings of whoever runs the tests. */
function environment(variables: Readonly<Record<string, string>>): NodeJS.ProcessEnv {
  const { MELSEC_JW_PLC: _, PLC_HOST: _host, PLC_PORT: _port, PLC_PROFILE: _profile, ...rest } = process.env
  return { ...rest, NO_COLOR: '1', ...variables }
}

/** A program that runs for a while, with all that it has printed. */
export class Running {
  #out = ''
  #err = ''
  readonly #child: ChildProcess
  readonly #gone: Promise<unknown>
  #heard: () => void = () => {}

  /** @param input `null`: the standard input stays open, see `type` */
  constructor(args: readonly string[], variables: Readonly<Record<string, string>> = {}, input: string | null = '') {
    this.#child = spawn(process.execPath, args, { cwd: root, env: environment(variables), stdio: 'pipe' })
    this.#child.stdout?.on('data', (chunk: Buffer) => {
      this.#out += chunk.toString()
      this.#heard()
    })
    this.#child.stderr?.on('data', (chunk: Buffer) => {
      this.#err += chunk.toString()
      this.#heard()
    })
    this.#gone = once(this.#child, 'close')
    void this.#gone.then(() => this.#heard())
    if (input !== null) this.#child.stdin?.end(input)
  }

  /** A line on the standard input. */
  type(line: string): void {
    this.#child.stdin?.write(`${line}\n`)
  }

  /** Resolves when the program has printed this. */
  async says(pattern: RegExp): Promise<RegExpExecArray> {
    const deadline = Date.now() + LATE
    for (;;) {
      const found = pattern.exec(this.#out) ?? pattern.exec(this.#err)
      if (found !== null) return found
      if (this.#child.exitCode !== null) throw new Error(`ended without ${pattern}:\n${this.#out}${this.#err}`)
      await this.#more(deadline - Date.now(), pattern)
    }
  }

  async #more(ms: number, pattern: RegExp): Promise<void> {
    let timer: NodeJS.Timeout | undefined
    const late = new Promise<never>((_, reject) => {
      const fail = () => reject(new Error(`did not say ${pattern}:\n${this.#out}${this.#err}`))
      timer = setTimeout(fail, Math.max(0, ms))
    })
    const heard = new Promise<void>((resolve) => {
      this.#heard = resolve
    })
    try {
      await Promise.race([heard, late])
    } finally {
      clearTimeout(timer)
    }
  }

  async ended(): Promise<Ended> {
    const timer = setTimeout(() => this.#child.kill('SIGKILL'), LATE)
    await this.#gone
    clearTimeout(timer)
    return { code: this.#child.exitCode, out: this.#out, err: this.#err }
  }

  /** As `| head` does when it has seen enough. */
  closeOutput(): void {
    this.#child.stdout?.destroy()
  }

  /** As Ctrl-C does. */
  interrupt(): Promise<Ended> {
    this.#child.kill('SIGINT')
    return this.ended()
  }
}

/** Starts `melsec-jw` with these arguments. */
export function start(...args: readonly string[]): Running {
  return new Running([MAIN, ...args])
}

/** As `start`, with environment variables. */
export function startWith(env: Readonly<Record<string, string>>, ...args: readonly string[]): Running {
  return new Running([MAIN, ...args], env)
}

/** As `start`, with a standard input to type on. */
export function startTyping(...args: readonly string[]): Running {
  return new Running([MAIN, ...args], {}, null)
}

/** Runs `melsec-jw` to its end. */
export function run(...args: readonly string[]): Promise<Ended> {
  return start(...args).ended()
}

/** Runs `melsec-jw` with environment variables and a standard input. */
export function runWith(
  given: { readonly env?: Readonly<Record<string, string>>; readonly input?: string },
  ...args: readonly string[]
): Promise<Ended> {
  return new Running([MAIN, ...args], given.env, given.input).ended()
}

/** Starts an example program. */
export function example(name: string, ...args: readonly string[]): Running {
  return new Running([join(root, 'examples', 'library', name), ...args])
}
