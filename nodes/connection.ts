// One PLC connection shared by the nodes that use it.
import type { Node } from 'node-red'
import { type ConnectionState, createMelsecClient, type MelsecClient, type MelsecClientOptions } from '../src/index'
import { detailsOf, NodeFailure, refusal } from './failure'
import type { Texts } from './texts'

/** A node that uses a connection and shows how it is. */
export interface ConnectionUser {
  stateChanged(state: ConnectionState): void
}

/** A close of Node-RED may last 15 s; a write under way gets this much of it, in ms. */
const GRACE = 5000

/**
 * The client of one connection node. It connects in the background as soon as a node uses it, and is closed when a
 * deploy leaves it without users or takes it away.
 */
export class PlcConnection {
  #client: MelsecClient | undefined
  #closed = false
  #complained: string | undefined
  readonly #users = new Set<ConnectionUser>()
  readonly #changes = new Set<Promise<unknown>>()

  private constructor(
    private readonly node: Node,
    private readonly texts: Texts,
    /** What the client is made of; undefined when the settings are wrong. */
    readonly options: MelsecClientOptions | undefined,
    /** Why there is no client; every node that uses the connection reports it. */
    readonly failure: NodeFailure | undefined,
  ) {}

  /**
   * Never throws: wrong settings become the `failure` of everybody who uses the connection.
   * @param optionsOf reads the settings
   */
  static of(node: Node, texts: Texts, optionsOf: () => MelsecClientOptions): PlcConnection {
    try {
      const options = optionsOf()
      const connection = new PlcConnection(node, texts, options, undefined)
      connection.#open(options)
      return connection
    } catch (error) {
      return new PlcConnection(node, texts, undefined, settingsFailure(error, texts))
    }
  }

  get closed(): boolean {
    return this.#closed
  }

  /** The client as it is, for the editor's test. */
  get current(): MelsecClient | undefined {
    return this.#client
  }

  /** @throws NodeFailure when the settings are wrong or the connection is closed. */
  get client(): MelsecClient {
    if (this.options === undefined) throw this.failure ?? refusal('NOT_CONFIGURED', this.texts('error.noConnection'))
    if (this.#closed) throw refusal('CLOSED', this.texts('error.closed'))
    return this.#client ?? this.#open(this.options)
  }

  /**
   * The client for something that changes the PLC.
   * @throws NodeFailure NOT_PERMITTED while the connection's owner has not allowed it; nothing is sent.
   */
  clientFor(effect: 'write' | 'control'): MelsecClient {
    const { client } = this
    const allowed = effect === 'write' ? this.options?.allowWrites : this.options?.allowControl
    if (allowed === true) return client
    throw refusal('NOT_PERMITTED', this.texts(effect === 'write' ? 'error.writesOff' : 'error.controlOff'))
  }

  /** Connects in the background and tells the user about it until it leaves. @returns what leaves. */
  join(user: ConnectionUser): () => void {
    const { client } = this
    this.#users.add(user)
    this.#keepUp(client)
    user.stateChanged(client.state)
    return () => {
      this.#users.delete(user)
    }
  }

  /** A write or control command is under way: closing waits for it. */
  track(change: Promise<unknown>): void {
    const settled = change.finally(() => this.#changes.delete(settled))
    this.#changes.add(settled)
  }

  /** After each deploy: nobody uses the connection any more, so the PLC gets its entry back. */
  releaseUnused(): void {
    if (this.#users.size > 0 || this.#client === undefined) return
    const client = this.#client
    this.#client = undefined
    this.#complained = undefined
    void client.close()
  }

  /** Resolves in good time whatever the PLC does. */
  async close(): Promise<void> {
    this.#closed = true
    await this.#changesSettled()
    await this.#client?.close()
    this.#client = undefined
  }

  async #changesSettled(): Promise<void> {
    if (this.#changes.size === 0) return
    const late = AbortSignal.timeout(GRACE)
    const waited = new Promise<void>((resolve) => late.addEventListener('abort', () => resolve(), { once: true }))
    await Promise.race([Promise.allSettled(this.#changes), waited])
  }

  #open(options: MelsecClientOptions): MelsecClient {
    const client = createMelsecClient(options)
    client.on('state', (state) => this.#stateChanged(client, state))
    this.#client = client
    return client
  }

  #keepUp(client: MelsecClient): void {
    if (client.state.name !== 'idle') return
    // How it ends is told by the state, to every user; the client goes on trying by itself.
    client.connect().catch(() => undefined)
  }

  #stateChanged(client: MelsecClient, state: ConnectionState): void {
    if (client !== this.#client) return
    this.#log(state)
    for (const user of [...this.#users]) user.stateChanged(state)
  }

  /** The log gets each new reason once, not every attempt of a night without the PLC. */
  #log(state: ConnectionState): void {
    if (state.name === 'connected') {
      this.#complained = undefined
      this.node.log(this.texts('log.connected', { peer: this.#peer() }))
    } else if (state.name === 'waiting' && state.error.code !== this.#complained) {
      this.#complained = state.error.code
      this.node.warn(detailsOf(state.error, this.texts).message)
    }
  }

  #peer(): string {
    return this.options === undefined ? '' : peerOf(this.options)
  }
}

/** Where the PLC is, for people. */
export function peerOf({ transport = 'tcp', host, port, line, route }: MelsecClientOptions): string {
  return line === undefined ? `${transport} ${host}:${port}` : `${line.description}, station ${route?.station ?? 0}`
}

/** Whatever the client has against the settings, it is they that are wrong. */
function settingsFailure(error: unknown, texts: Texts): NodeFailure {
  const details = detailsOf(error, texts)
  return new NodeFailure(details.code === 'UNEXPECTED' ? details : { ...details, code: 'NOT_CONFIGURED' })
}

/** The connection behind each running connection node. Another copy of this package has nodes of its own. */
const connections = new WeakMap<Node, PlcConnection>()

export function setConnection(node: Node, connection: PlcConnection): void {
  connections.set(node, connection)
}

/** @param node what `RED.nodes.getNode` gave, `null` included */
export function connectionOf(node: Node | null | undefined): PlcConnection | undefined {
  return node ? connections.get(node) : undefined
}
