// What becomes of a message that arrives while the read before it is still under way. A read changes nothing, so beats of
// a timer may be left out when the PLC is slower; they are counted, and the status tells. Nothing else is left out unasked.
import type { NodeMessageInFlow } from 'node-red'
import { refusal } from './failure'
import type { StoredSettings } from './migration'
import { wordIn } from './stored'
import type { Texts } from './texts'

/** `skip`: it is not read. `queue`: read in its turn. `newest`: of those that wait only the newest is read. */
export const busyRules = ['skip', 'queue', 'newest'] as const
export type BusyRule = (typeof busyRules)[number]

/**
 * `auto`: of a timer's messages the newest, and all others. Were timed ones skipped, those nodes would be left out that
 * come last in each beat. `msg`: as `msg.busy` says, else `auto`.
 */
const choices = ['auto', ...busyRules, 'msg'] as const

/** Messages of one node that may be under way or wait: more would take the connection's queue from the other nodes. */
const MOST = 100

/** The rule for a message. @throws NodeFailure BAD_INPUT when the message asks for one that there is not */
export type BusyRuleOf = (message: NodeMessageInFlow) => BusyRule

/** @param isTimed whether a message is the beat of a timer */
export function busyRuleIn(
  settings: StoredSettings,
  isTimed: (message: NodeMessageInFlow) => boolean,
  texts: Texts,
): BusyRuleOf {
  const choice = wordIn(settings, 'busy', choices, texts)
  const usual: BusyRuleOf = (message) => (isTimed(message) ? 'newest' : 'queue')
  if (choice === 'auto') return usual
  if (choice !== 'msg') return () => choice
  return (message) => {
    const { busy } = message as NodeMessageInFlow & { readonly busy?: unknown }
    const asked = busyRules.find((rule) => rule === busy)
    if (asked === undefined && busy !== undefined) {
      const values = { given: String(busy), choices: busyRules.join(', ') }
      throw refusal('BAD_INPUT', texts('error.badBusy', values), { field: 'busy' })
    }
    return asked ?? usual(message)
  }
}

/** How a node keeps up with its messages. */
export interface Load {
  /** Not read since the node was started. */
  readonly skipped: number
  /** The PLC did not keep up since this was asked for last. */
  readonly behind: boolean
  readonly waiting: number
}

/** What a message comes to when it is its turn, and when it is not read at all. */
export interface Turn {
  /** Never rejects. */
  readonly read: () => Promise<void>
  readonly skip: () => void
}

/** The messages of one node: who is read now, who later, and who never. */
export class Busy {
  #underWay = 0
  #skipped = 0
  #behind = false
  /** Waits for everything before it; a newer one takes its place. */
  #newest: Turn | undefined

  constructor(
    private readonly texts: Texts,
    /** A PLC that is not there is not slow. */
    private readonly isConnected: () => boolean,
  ) {}

  /** Takes what has been said as told. */
  load(): Load {
    const behind = this.#behind
    this.#behind = false
    const waiting = Math.max(0, this.#underWay - 1) + (this.#newest === undefined ? 0 : 1)
    return { skipped: this.#skipped, behind, waiting }
  }

  /** @throws NodeFailure QUEUE_FULL */
  async enter(rule: BusyRule, turn: Turn): Promise<void> {
    if (this.#underWay === 0) return this.#read(turn)
    switch (rule) {
      case 'skip':
        return this.#skip(turn)
      case 'queue':
        // The connection lets the nodes take turns, and refuses what would wait too long.
        if (this.#underWay < MOST) return this.#read(turn)
        throw refusal('QUEUE_FULL', this.texts('error.messagesWaiting', { count: MOST }))
      case 'newest':
        if (this.#newest !== undefined) this.#skip(this.#newest)
        this.#newest = turn
        return
      default:
        return rule satisfies never
    }
  }

  /** Nobody waits for it any more. */
  close(): void {
    this.#newest?.skip()
    this.#newest = undefined
  }

  async #read(turn: Turn): Promise<void> {
    this.#underWay += 1
    await turn.read()
    this.#underWay -= 1
    const next = this.#newest
    if (this.#underWay > 0 || next === undefined) return
    this.#newest = undefined
    void this.#read(next)
  }

  #skip(turn: Turn): void {
    this.#skipped += 1
    if (this.isConnected()) this.#behind = true
    turn.skip()
  }
}
