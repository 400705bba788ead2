// The remote password of the simulated port (SLMP reference manual 5.7, FX5 communication manual 13.2 and 38.6).
import type { PasswordFacts } from '../melsec/profiles/profile'
import { PORT_LOCKED } from '../melsec/remote-password'
import type { Clock } from '../transport/clock'
import { Refusal } from './refusal'

export interface PortPasswordSettings {
  /** `undefined`: the port has no password and is never locked. */
  readonly password: string | undefined
  /** Wrong passwords in a row after which the port locks out. */
  readonly passwordAttempts: number
  /** ms for which no password is taken then, the right one neither. */
  readonly lockOutTime: number
  readonly clock: Clock
}

/** ms without traffic after which a UDP connection is locked again (FX5 communication manual 13.2). */
const UDP_IDLE = 10 * 60_000

/** What the connections of a port share: the password, and how often it was wrong. */
export class PortPassword {
  readonly #settings: PortPasswordSettings
  readonly #facts: PasswordFacts
  #failures = 0
  #lockedOutUntil = 0

  constructor(facts: PasswordFacts, settings: PortPasswordSettings) {
    this.#settings = settings
    this.#facts = facts
  }

  get #now(): number {
    return this.#settings.clock.now()
  }

  /** The lock of a new connection. It ends with the connection: whoever comes next finds it locked. */
  lockOf(kind: 'stream' | 'datagram'): PortLock {
    const { password, clock } = this.#settings
    return new PortLock({
      given: password !== undefined,
      idle: kind === 'datagram' ? UDP_IDLE : Number.POSITIVE_INFINITY,
      now: () => clock.now(),
      check: (text) => this.#check(text),
    })
  }

  /** @throws Refusal when it is wrong, or was wrong too often. */
  #check(text: string): void {
    const { wrong, last, lockedOut } = this.#facts
    if (this.#now < this.#lockedOutUntil) throw new Refusal(lockedOut, 'remote password: locked out')
    if (text === this.#settings.password) {
      this.#failures = 0
      return
    }
    this.#failures++
    if (this.#failures < this.#settings.passwordAttempts) {
      throw new Refusal(wrong, `remote password: wrong, ${this.#failures} in a row`)
    }
    this.#failures = 0
    this.#lockedOutUntil = this.#now + this.#settings.lockOutTime
    throw new Refusal(last, 'remote password: wrong too often, locked out now')
  }
}

interface LockParts {
  readonly given: boolean
  /** ms */
  readonly idle: number
  readonly now: () => number
  readonly check: (text: string) => void
}

/** Whether one connection may do anything. */
export class PortLock {
  readonly #parts: LockParts
  #unlocked = false
  #lastAt = 0

  constructor(parts: LockParts) {
    this.#parts = parts
  }

  /** A request has arrived. @throws Refusal when the port is locked; `free` requests never are. */
  enter(free: boolean): void {
    const { given, idle, now } = this.#parts
    if (!given) return
    const at = now()
    if (at - this.#lastAt >= idle) this.#unlocked = false
    this.#lastAt = at
    if (!this.#unlocked && !free) throw new Refusal(PORT_LOCKED, 'the port is locked by the remote password')
  }

  /** An unlocked port stays as it is, and the password is not looked at. */
  unlock(password: string): void {
    if (!this.#parts.given || this.#unlocked) return
    this.#parts.check(password)
    this.#unlocked = true
  }

  /** A locked port stays as it is. `password` is undefined where the port does not look at it. */
  lock(password: string | undefined): void {
    if (!this.#parts.given || !this.#unlocked) return
    if (password !== undefined) this.#parts.check(password)
    this.#unlocked = false
  }
}
