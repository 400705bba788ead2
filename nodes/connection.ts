// One PLC connection shared by the nodes that use it.
import type { Node } from 'node-red'
import type { ConnectionState, MelsecClient } from '../src/index'
import { detailsOf, NodeFailure, refusal } from './failure'
import {
  type AnyPlc,
  clientOf,
  type FamilyOptions,
  forFamily,
  type NodeClient,
  type NodeEffect,
  permissions,
} from './family'
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
  #plc: AnyPlc | undefined
  #closed = false
  #complained: string | undefined
  readonly #users = new Set<ConnectionUser>()
  readonly #changes = new Set<Promise<unknown>>()

  private constructor(
    private readonly node: Node,
    private readonly texts: Texts,
    /** What the client is made of; undefined when the settings are wrong. */
    readonly given: FamilyOptions | undefined,
    /** Why there is no client; every node that uses the connection reports it. */
    readonly failure: NodeFailure | undefined,
  ) {}

  /**
   * Never throws: wrong settings become the `failure` of everybody who uses the connection.
   * @param optionsOf reads the settings
   */
  static of(node: Node, texts: Texts, optionsOf: () => FamilyOptions): PlcConnection {
    try {
      const given = optionsOf()
      const connection = new PlcConnection(node, texts, given, undefined)
      connection.#open(given)
      return connection
    } catch (error) {
      return new PlcConnection(node, texts, undefined, settingsFailure(error, texts))
    }
  }

  get closed(): boolean {
    return this.#closed
  }

  /** What the client was made of, whichever family its PLC is of. */
  get options(): FamilyOptions['options'] | undefined {
    return this.given?.options
  }

  /** The client as it is, for status and test. */
  get current(): NodeClient | undefined {
    return this.#plc?.client
  }

  /** The PLC while it is connected, for the editor's test. */
  get connected(): AnyPlc | undefined {
    return this.#plc?.client.state.name === 'connected' ? this.#plc : undefined
  }

  /** @throws NodeFailure when the settings are wrong or the connection is closed. */
  get plc(): AnyPlc {
    if (this.given === undefined) throw this.failure ?? refusal('NOT_CONFIGURED', this.texts('error.noConnection'))
    if (this.#closed) throw refusal('CLOSED', this.texts('error.closed'))
    return this.#plc ?? this.#open(this.given)
  }

  /** What every client can do. @throws NodeFailure as `plc` does */
  get client(): NodeClient {
    return this.plc.client
  }

  /**
   * The client of a MELSEC PLC, for what no other family has.
   * @param what it is, a key of `feature` in the catalogue
   * @throws NodeFailure UNSUPPORTED when the PLC is of another family; nothing is sent.
   */
  melsec(what: 'onDemand' | 'files' | 'memory'): MelsecClient {
    return forFamily(this.plc, {
      melsec: (client) => client,
      jw: () => {
        throw refusal('UNSUPPORTED', this.texts('error.notOfJw', { what: this.texts(`feature.${what}`) }))
      },
    })
  }

  /**
   * The PLC for something that may change it.
   * @throws NodeFailure NOT_PERMITTED while the connection's owner has not allowed it; nothing is sent.
   */
  plcFor(effect: NodeEffect): AnyPlc {
    const { plc } = this
    const permission = permissions[effect]
    const given: Partial<Record<string, unknown>> = { ...this.options }
    if (permission === undefined || given[permission.option] === true) return plc
    throw refusal('NOT_PERMITTED', this.texts(permission.refusal))
  }

  /** As `plcFor`. */
  clientFor(effect: NodeEffect): NodeClient {
    return this.plcFor(effect).client
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
    if (this.#users.size > 0 || this.#plc === undefined) return
    const { client } = this.#plc
    this.#plc = undefined
    this.#complained = undefined
    void client.close()
  }

  /** Resolves in good time whatever the PLC does. */
  async close(): Promise<void> {
    this.#closed = true
    await this.#changesSettled()
    await this.#plc?.client.close()
    this.#plc = undefined
  }

  async #changesSettled(): Promise<void> {
    if (this.#changes.size === 0) return
    const late = AbortSignal.timeout(GRACE)
    const waited = new Promise<void>((resolve) => late.addEventListener('abort', () => resolve(), { once: true }))
    await Promise.race([Promise.allSettled(this.#changes), waited])
  }

  #open(given: FamilyOptions): AnyPlc {
    const plc = clientOf(given)
    const { client }: { client: NodeClient } = plc
    client.on('state', (state) => this.#stateChanged(client, state))
    this.#plc = plc
    return plc
  }

  #keepUp(client: NodeClient): void {
    if (client.state.name !== 'idle') return
    // How it ends is told by the state, to every user; the client goes on trying by itself.
    client.connect().catch(() => undefined)
  }

  #stateChanged(client: NodeClient, state: ConnectionState): void {
    if (client !== this.#plc?.client) return
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
export function peerOf(options: FamilyOptions['options']): string {
  const { transport = 'tcp', host, port } = options
  if (!('line' in options) || options.line === undefined) return `${transport} ${host}:${port}`
  return `${options.line.description}, station ${options.route?.station ?? 0}`
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
