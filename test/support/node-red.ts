/**
 * A real Node-RED in a process of its own, with this package's built nodes in it as an installation would have them.
 *
 * The flow is deployed through the admin API, as the editor does. `probe/` runs inside and tells what happens there;
 * every output of every deployed node is wired to a probe as well, so a test reads `await red.next('my node')` without
 * adding anything to its flow.
 *
 * @example
 * const red = await startNodeRed()
 * await red.deploy([{ id: 'source', type: 'inject', wires: [['double']] },
 *                   { id: 'double', type: 'function', func: 'msg.payload *= 2; return msg', wires: [[]] }])
 * await red.receive('source', { payload: 21 })
 * expect((await red.next('double')).payload).toBe(42)
 * await red.stop()
 */
import { type ChildProcess, fork, spawnSync } from 'node:child_process'
import { once } from 'node:events'
import { mkdir, mkdtemp, rm, symlink, writeFile } from 'node:fs/promises'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { isDeepStrictEqual } from 'node:util'
import { decode, encode } from './probe/portable'
import { root } from './root'

/**
 * A node of a flow as flows.json has it. What has `wires` is a node on a tab: without `z` it is put on a tab made for
 * it, and without `x` and `y` it is given some, because Node-RED takes a node without a place for a config node.
 */
export interface FlowNode {
  readonly id: string
  readonly type: string
  readonly [property: string]: unknown
}

export interface Message {
  readonly _msgid: string
  readonly payload?: unknown
  readonly [property: string]: unknown
}

export interface Status {
  readonly fill?: string
  readonly shape?: string
  readonly text?: string
}

/** One call of `done()`; `error` is there when it was called with one. */
export interface Completion {
  readonly id: string
  readonly message: Message
  readonly error?: unknown
}

/** A warning or error in Node-RED's log, also one that no Catch node handled. */
export interface LogEntry {
  readonly level: 'warn' | 'error'
  readonly text: unknown
  readonly id?: string
  readonly type?: string
}

/** What keeps the process busy: Node's active resources by kind (`TCPSocketWrap`, `Timeout`, …), listeners, heap bytes. */
export interface Resources {
  readonly active: Readonly<Record<string, number>>
  readonly listeners: number
  readonly heap: number
}

export interface HttpAnswer {
  readonly status: number
  readonly text: string
  json(): unknown
}

export interface NodeRedOptions {
  /** Loads @flowfuse/node-red-dashboard too. Default false: it takes a second. */
  readonly dashboard?: boolean
  /** Language of the runtime (status texts, log). Default en-US. */
  readonly language?: string
  /** Merged over the settings below. */
  readonly settings?: Readonly<Record<string, unknown>>
  /** Another installation (the matrix): Node's executable, Node-RED's red.js and a user directory, which is kept. */
  readonly installed?: { readonly node: string; readonly script: string; readonly userDir: string }
}

export interface NodeRed {
  /** The editor, e.g. http://127.0.0.1:41231/ */
  readonly url: string
  /** The folder that was made for it and goes with it. */
  readonly userDir: string | undefined
  /** Replaces the flows, as the editor's Deploy button does, and resolves when they run. */
  deploy(flow: readonly FlowNode[], type?: 'full' | 'flows' | 'nodes'): Promise<void>
  /** Hands a message to a node's input. */
  receive(id: string, message: Readonly<Record<string, unknown>>): Promise<void>
  /** The next message that this node sent from this output and that `next` has not returned yet; waits for it. */
  next(id: string, port?: number): Promise<Message>
  /** The messages of this output that `next` has not returned yet. */
  pending(id: string, port?: number): Message[]
  /** The next call of `done()` by this node. */
  completed(id: string): Promise<Completion>
  /** Every call of `done()` since the last `forget`. */
  readonly completions: readonly Completion[]
  /** Resolves when this node's status matches: at once when it does already. */
  status(id: string, matches: Status | ((status: Status) => boolean)): Promise<Status>
  /** Every status of this node since the last `forget`, oldest first. */
  statuses(id: string): Status[]
  /** Warnings and errors in the log since the last `forget`. */
  readonly log: readonly LogEntry[]
  /** Forgets everything collected so far. */
  forget(): void
  /** A request to the admin API or to a page; `path` without the leading slash. */
  http(method: string, path: string, body?: unknown, headers?: Record<string, string>): Promise<HttpAnswer>
  /** After a garbage collection. */
  resources(): Promise<Resources>
  /** Stops the flows and the process, removes its files, and rejects if it did not end by itself. */
  stop(): Promise<void>
}

const WAIT = 10_000
const START = 60_000
const SINK = 'probe-sink'
const TAB = 'probe-tab'

export async function startNodeRed(options: NodeRedOptions = {}): Promise<NodeRed> {
  const userDir = options.installed?.userDir ?? (await createUserDir())
  await writeFile(
    join(userDir, 'settings.js'),
    `module.exports = ${JSON.stringify(settings(userDir, options), null, 2)}\n`,
  )
  const script = options.installed?.script ?? join(root, 'node_modules', 'node-red', 'red.js')
  const child = fork(script, ['--userDir', userDir], {
    cwd: userDir,
    env: environment(),
    execPath: options.installed?.node ?? process.execPath,
    execArgv: ['--expose-gc'],
    stdio: ['ignore', 'pipe', 'pipe', 'ipc'],
  })
  const running = new RunningNodeRed(child, options.installed ? undefined : userDir)
  await running.started()
  return running
}

/** A user directory with this package in it; the link stands for an installation, so package.json counts as it is. */
async function createUserDir(): Promise<string> {
  // The nodes must be those of the sources; after `npm test` has set up this does nothing.
  const built = spawnSync(process.execPath, [join(root, 'scripts', 'setup.mjs'), '--unchecked'], { encoding: 'utf8' })
  if (built.status !== 0) throw new Error(`the build failed:\n${built.stdout}${built.stderr}`)
  const userDir = await mkdtemp(join(tmpdir(), 'melsec-jw-red-'))
  const link = join(userDir, 'node_modules', '@melsec-jw', 'plc')
  await mkdir(dirname(link), { recursive: true })
  await symlink(root, link, 'junction')
  const manifest = {
    name: 'node-red-project',
    version: '0.0.1',
    private: true,
    dependencies: { '@melsec-jw/plc': '*' },
  }
  await writeFile(join(userDir, 'package.json'), JSON.stringify(manifest))
  return userDir
}

function settings(userDir: string, options: NodeRedOptions): Record<string, unknown> {
  return {
    userDir,
    flowFile: 'flows.json',
    credentialSecret: 'for tests only',
    uiHost: '127.0.0.1',
    uiPort: 0,
    lang: options.language ?? 'en-US',
    nodesDir: [join(root, 'test', 'support', 'probe')],
    // Node-RED also finds packages beside itself, so the dashboard of the development dependencies has to be kept out.
    externalModules: {
      autoInstall: false,
      palette: {
        allowInstall: false,
        allowList: ['*'],
        denyList: options.dashboard === true ? [] : ['@flowfuse/node-red-dashboard'],
      },
      modules: { allowInstall: false },
    },
    editorTheme: { tours: false, projects: { enabled: false }, palette: { catalogues: [] } },
    telemetry: { enabled: false, updateNotification: false },
    logging: { console: { level: 'info', metrics: false, audit: false } },
    ...options.settings,
  }
}

/** Without what Jest, npm or a Node-RED around us put there. */
function environment(): NodeJS.ProcessEnv {
  const inherited = Object.entries(process.env).filter(
    ([name]) => !/^(NODE_RED_|NODE_OPTIONS$|NODE_ENV$|JEST_|npm_|PORT$)/.test(name),
  )
  return Object.fromEntries(inherited)
}

interface Sent {
  readonly id: string
  readonly port: number
  readonly message: Message
}

type ProbeEvent =
  | ({ readonly event: 'sent' } & Sent)
  | ({ readonly event: 'completed' } & Completion)
  | { readonly event: 'status'; readonly id: string; readonly status?: Status }
  | ({ readonly event: 'logged' } & LogEntry)
  | {
      readonly event: 'answer'
      readonly number: number
      readonly value?: unknown
      readonly error?: { message: string }
    }
  | { readonly event: 'refused'; readonly reason: unknown }
  | { readonly event: 'loaded' | 'started' | 'stopped' }

class RunningNodeRed implements NodeRed {
  url = ''
  readonly completions: Completion[] = []
  readonly log: LogEntry[] = []
  #sent: Sent[] = []
  #unreadCompletions: Completion[] = []
  #statuses: { id: string; status: Status }[] = []
  #starts = 0
  #refusal: unknown
  #loaded = false
  #output = ''
  #exit: string | undefined
  readonly #answers = new Map<number, { value?: unknown; error?: { message: string } }>()
  #requests = 0
  readonly #waiting = new Set<() => void>()

  constructor(
    private readonly child: ChildProcess,
    /** Removed at the end. */
    readonly userDir: string | undefined,
  ) {
    const collect = (chunk: Buffer): void => {
      this.#output = (this.#output + chunk.toString()).slice(-20_000)
      this.#changed()
    }
    child.stdout?.on('data', collect)
    child.stderr?.on('data', collect)
    child.on('message', (raw) => this.#hear(decode(raw) as ProbeEvent))
    child.on('exit', (code, signal) => {
      this.#exit = signal ?? `exit code ${code}`
      this.#changed()
    })
  }

  async started(): Promise<void> {
    try {
      this.url = await this.#until('Node-RED to listen', START, () => {
        // The (empty) flows start by themselves first: their start must not be taken for that of the first deploy.
        const ready = this.#loaded && this.#starts > 0
        return ready ? /(http:\/\/127\.0\.0\.1:\d+\/\S*)/.exec(this.#output)?.[1] : undefined
      })
    } catch (error) {
      this.child.kill('SIGKILL')
      await this.#removeFiles()
      throw error
    }
  }

  async deploy(flow: readonly FlowNode[], type: 'full' | 'flows' | 'nodes' = 'full'): Promise<void> {
    const starts = this.#starts
    this.#refusal = undefined
    const answer = await this.http('POST', 'flows', withProbes(flow), { 'Node-RED-Deployment-Type': type })
    if (answer.status !== 204) throw new Error(`deploying failed with ${answer.status}: ${answer.text}`)
    await this.#until(
      'the flows to start',
      WAIT,
      () => this.#starts > starts || this.#refusal !== undefined || undefined,
    )
    if (this.#refusal !== undefined) throw new Error(`the flows do not start: ${JSON.stringify(this.#refusal)}`)
  }

  async receive(id: string, message: Readonly<Record<string, unknown>>): Promise<void> {
    await this.#ask('receive', { id, message })
  }

  next(id: string, port = 0): Promise<Message> {
    return this.#until(`a message from output ${port} of ${id}`, WAIT, () => {
      const at = this.#sent.findIndex((sent) => sent.id === id && sent.port === port)
      return at < 0 ? undefined : this.#sent.splice(at, 1)[0]?.message
    })
  }

  pending(id: string, port = 0): Message[] {
    return this.#sent.filter((sent) => sent.id === id && sent.port === port).map((sent) => sent.message)
  }

  completed(id: string): Promise<Completion> {
    return this.#until(`done() of ${id}`, WAIT, () => {
      const at = this.#unreadCompletions.findIndex((completion) => completion.id === id)
      return at < 0 ? undefined : this.#unreadCompletions.splice(at, 1)[0]
    })
  }

  status(id: string, matches: Status | ((status: Status) => boolean)): Promise<Status> {
    const fits = typeof matches === 'function' ? matches : (status: Status) => carries(status, matches)
    return this.#until(`the status of ${id} to be ${JSON.stringify(matches) ?? 'as asked'}`, WAIT, () => {
      const latest = this.statuses(id).at(-1)
      return latest && fits(latest) ? latest : undefined
    })
  }

  statuses(id: string): Status[] {
    return this.#statuses.filter((entry) => entry.id === id).map((entry) => entry.status)
  }

  forget(): void {
    this.#sent = []
    this.#unreadCompletions = []
    this.#statuses = []
    this.completions.length = 0
    this.log.length = 0
  }

  async http(method: string, path: string, body?: unknown, headers: Record<string, string> = {}): Promise<HttpAnswer> {
    const init: RequestInit = { method, headers: { 'content-type': 'application/json', ...headers } }
    if (body !== undefined) init.body = JSON.stringify(body)
    const response = await fetch(new URL(path, this.url), init)
    const text = await response.text()
    return { status: response.status, text, json: () => JSON.parse(text) }
  }

  async resources(): Promise<Resources> {
    return (await this.#ask('resources', {})) as Resources
  }

  async stop(): Promise<void> {
    if (this.#exit === undefined) {
      const gone = once(this.child, 'exit')
      // red.js answers this message as it answers SIGTERM, on Windows too.
      this.child.send('shutdown')
      const overdue = setTimeout(() => this.child.kill('SIGKILL'), WAIT)
      await gone
      clearTimeout(overdue)
    }
    await this.#removeFiles()
    if (this.#exit !== 'exit code 0') throw new Error(`Node-RED ended with ${this.#exit}${this.#tail()}`)
  }

  async #removeFiles(): Promise<void> {
    if (this.userDir) await rm(this.userDir, { recursive: true, force: true, maxRetries: 3 })
  }

  async #ask(action: string, argument: unknown): Promise<unknown> {
    const number = ++this.#requests
    this.child.send({ action, number, argument: encode(argument) })
    const answer = await this.#until(`the answer to ${action}`, WAIT, () => this.#answers.get(number))
    this.#answers.delete(number)
    if (answer.error) throw new Error(answer.error.message)
    return answer.value
  }

  #hear(event: ProbeEvent): void {
    switch (event.event) {
      case 'sent':
        this.#sent.push(event)
        break
      case 'completed':
        this.completions.push(event)
        this.#unreadCompletions.push(event)
        break
      case 'status':
        this.#statuses.push({ id: event.id, status: event.status ?? {} })
        break
      case 'logged':
        this.log.push(event)
        break
      case 'answer':
        this.#answers.set(event.number, event)
        break
      case 'refused':
        this.#refusal = event.reason
        break
      case 'loaded':
        this.#loaded = true
        break
      case 'started':
        this.#starts += 1
        break
      case 'stopped':
        break
      default:
        event satisfies never
    }
    this.#changed()
  }

  #changed(): void {
    for (const look of [...this.#waiting]) look()
  }

  /** Looks now and whenever something was heard, until there is a value; the error says what was heard instead. */
  #until<T>(what: string, within: number, value: () => T | undefined): Promise<T> {
    return new Promise((resolve, reject) => {
      const end = (): void => {
        this.#waiting.delete(look)
        clearTimeout(timer)
      }
      const look = (): void => {
        const found = value()
        if (found !== undefined) {
          end()
          resolve(found)
        } else if (this.#exit !== undefined) {
          end()
          reject(new Error(`waiting for ${what}, but Node-RED ended with ${this.#exit}${this.#tail()}`))
        }
      }
      const timer = setTimeout(() => {
        end()
        reject(new Error(`waited ${within} ms for ${what}${this.#heard()}${this.#tail()}`))
      }, within)
      this.#waiting.add(look)
      look()
    })
  }

  #heard(): string {
    const sent = this.#sent.map((entry) => `\n  sent by ${entry.id}, output ${entry.port}`)
    const statuses = this.#statuses.map((entry) => `\n  status of ${entry.id}: ${JSON.stringify(entry.status)}`)
    return `\nheard so far:${[...sent, ...statuses].slice(-20).join('') || ' nothing'}`
  }

  #tail(): string {
    return `\nlast output of Node-RED:\n${this.#output.split('\n').slice(-25).join('\n')}`
  }
}

function carries(status: Status, wanted: Status): boolean {
  return Object.entries(wanted).every(([name, value]) => isDeepStrictEqual(status[name as keyof Status], value))
}

/** Adds a probe to every tab and wires every output to it, after the flow's own wires (so that those come first). */
function withProbes(flow: readonly FlowNode[]): FlowNode[] {
  const placed = flow.map((node) => (Array.isArray(node.wires) ? { x: 100, y: 100, z: TAB, ...node } : node))
  const tabs = new Set(placed.filter((node) => Array.isArray(node.wires)).map((node) => String(node.z)))
  const sinks = [...tabs].map((tab) => ({ id: `${SINK}-${tab}`, type: SINK, x: 500, y: 100, z: tab, wires: [] }))
  const own = tabs.has(TAB) && !placed.some((node) => node.id === TAB) ? [{ id: TAB, type: 'tab', label: 'Test' }] : []
  return [...own, ...placed.map(withProbeWires), ...sinks]
}

function withProbeWires(node: FlowNode): FlowNode {
  if (!Array.isArray(node.wires)) return node
  const wires = node.wires.map((port: readonly string[]) => [...port, `${SINK}-${String(node.z)}`])
  return { ...node, wires }
}
