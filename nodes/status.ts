// What a node shows below itself: how the connection is, or why the last message failed.
import type { Node, NodeStatus } from 'node-red'
import { endCodeDigits } from '../src/basics/end-code-digits'
import type { ConnectionState } from '../src/index'
import type { Load } from './busy'
import type { ConnectionUser } from './connection'
import type { NodeFailure } from './failure'
import { type FailureCode, shortText } from './failure-code'
import type { Texts } from './texts'

/** What a Status node gets: to people in the language of the runtime, to programs as code and state. */
export interface ShownStatus extends NodeStatus {
  /** Why the last message failed, or why there is no connection. */
  readonly code?: FailureCode
  /** The number the PLC sent. */
  readonly endCode?: number
  /** Of the connection, when this was shown. */
  readonly state?: ConnectionState['name']
  /** Messages that were not read since the node was started, because one before them was under way. */
  readonly skipped?: number
  /** Messages that are yet to be read. */
  readonly waiting?: number
}

function ofState(state: ConnectionState, texts: Texts): ShownStatus {
  switch (state.name) {
    case 'connecting':
      // A reconnect keeps showing why there is no connection, until there is one.
      return state.error === undefined
        ? { fill: 'yellow', shape: 'ring', text: texts('status.connecting') }
        : ofCode(state.error.code, texts)
    case 'connected':
      return { fill: 'green', shape: 'dot', text: texts('status.connected') }
    case 'waiting':
      return ofCode(state.error.code, texts)
    case 'idle':
    case 'closed':
      return {}
    default:
      return state satisfies never
  }
}

function ofCode(code: FailureCode, texts: Texts): ShownStatus {
  return { fill: 'red', shape: 'ring', text: shortText(code, texts), code }
}

/** So many skipped messages are no moment in which the PLC was slow. */
const MANY = 10

/** The status of one node; says each thing once. */
export class Display implements ConnectionUser {
  #state: ConnectionState | undefined
  #shown = '{}'
  #closed = false
  #warned = false

  constructor(
    private readonly node: Node,
    private readonly texts: Texts,
  ) {}

  stateChanged(state: ConnectionState): void {
    this.#state = state
    this.#show(ofState(state, this.texts))
  }

  /**
   * @param load how the node keeps up with its messages, where it may not
   * @param roundTrip of a request, in ms
   */
  succeeded(load?: Load, roundTrip?: () => number | undefined): void {
    if (load?.behind === true) {
      const { skipped } = load
      this.#show({ fill: 'yellow', shape: 'ring', text: this.texts('status.skipped', { count: skipped }), skipped })
      this.#warn(skipped, roundTrip?.())
    } else if (load !== undefined && load.waiting > 0) {
      const { waiting } = load
      this.#show({ fill: 'blue', shape: 'ring', text: this.texts('status.waiting', { count: waiting }), waiting })
    } else if (this.#state !== undefined) this.#show(ofState(this.#state, this.texts))
  }

  /** A file is under way. */
  transferring(what: 'reading' | 'writing', percent: number): void {
    this.#show({ fill: 'blue', shape: 'dot', text: this.texts(`status.${what}`, { percent }) })
  }

  /** Some items of several failed, and the rest was delivered. */
  partly(failed: number, all: number): void {
    this.#show({ fill: 'yellow', shape: 'dot', text: this.texts('status.partly', { failed, all }) })
  }

  /** Carried out, but whether it has its effect could not be looked at. */
  unverified(): void {
    this.#show({ fill: 'yellow', shape: 'dot', text: this.texts('status.notVerified') })
  }

  failed({ code, endCode, cause }: NodeFailure): void {
    if (code === 'OFFLINE' && this.#state !== undefined) this.#show(ofState(this.#state, this.texts))
    else if (endCode === undefined) this.#show(ofCode(code, this.texts))
    else {
      const text = this.texts('status.endCode', { code: endCodeDigits(endCode, cause.family) })
      this.#show({ ...ofCode(code, this.texts), text, endCode })
    }
  }

  /** A successor with the same id may be running already: it is its status now. */
  close(): void {
    this.#closed = true
  }

  /** Says once in full what a status has no room for. */
  #warn(skipped: number, roundTrip = 0): void {
    if (this.#warned || skipped < MANY) return
    this.#warned = true
    this.node.warn(this.texts('log.skipped', { count: skipped, ms: Math.max(1, Math.round(roundTrip)) }))
  }

  #show(shown: ShownStatus): void {
    // Without the state: attempts to connect that come and go say nothing new.
    const text = JSON.stringify(shown)
    if (this.#closed || text === this.#shown) return
    this.#shown = text
    const status: ShownStatus = this.#state === undefined ? shown : { ...shown, state: this.#state.name }
    this.node.status(status)
  }
}
