// RUN, STOP and PAUSE of the simulated CPU: its switch, and who holds it by remote control
// (SLMP reference manual 5.6).
import { RequestError } from '../errors'
import type { Profile } from '../melsec/profiles/profile'
import { Refusal, requestErrors } from './refusal'

/** What the CPU does. */
export type CpuState = 'RUN' | 'STOP' | 'PAUSE'
/** Positions of the switch on the module. */
export type SwitchPosition = 'RUN' | 'STOP'

/** A remote STOP or PAUSE and the external device that did it. */
export interface Hold {
  /** What it holds the CPU in. */
  readonly state: 'STOP' | 'PAUSE'
  /** The external device, e.g. the address of a computer. */
  readonly owner: string
}

/** The CPU does something else than before. */
export interface StateChange {
  /** What it does now. */
  readonly state: CpuState
  /** What it did before. */
  readonly previous: CpuState
  /** By its switch, by remote control, or because it starts again. */
  readonly reason: 'switch' | 'remote' | 'restart'
}

/** What a clear mode of Remote Run does before the CPU runs. */
const CLEARED = { 0: undefined, 1: 'unlatched', 2: 'all' } as const

interface CpuParts {
  readonly profile: Profile
  /** GX Works: CPU parameter "Remote Reset". */
  readonly resetAllowed: boolean
  readonly changed: (change: StateChange) => void
  readonly clear: (scope: 'unlatched' | 'all') => void
}

export class Cpu {
  readonly #parts: CpuParts
  #switch: SwitchPosition = 'RUN'
  #hold: Hold | undefined
  #up = true

  constructor(parts: CpuParts) {
    this.#parts = parts
  }

  get state(): CpuState {
    return this.#switch === 'STOP' || !this.#up ? 'STOP' : (this.#hold?.state ?? 'RUN')
  }

  /** The switch on the module. */
  get switch(): SwitchPosition {
    return this.#switch
  }

  set switch(position: SwitchPosition) {
    if (position !== 'RUN' && position !== 'STOP') {
      throw new RequestError('BAD_OPTION', `The switch goes to RUN or STOP, not to ${String(position)}.`, 'switch')
    }
    this.#change('switch', () => {
      this.#switch = position
    })
  }

  /** The remote STOP or PAUSE in force, also while the switch is at STOP. */
  get hold(): Hold | undefined {
    return this.#hold
  }

  /** Content of SD203: lower digit 0 RUN, 2 STOP, 3 PAUSE; next digit why: 0 switch, 2 remote operation. */
  get statusWord(): number {
    const { state } = this
    if (state === 'RUN') return 0
    const cause = this.#hold !== undefined && this.#switch === 'RUN' ? 0x20 : 0
    return cause | (state === 'STOP' ? 2 : 3)
  }

  /** Completes normally with the switch at STOP, but the CPU stays in STOP. */
  run(owner: string, force: boolean, clearMode: number): void {
    const known = this.#parts.profile.remote.clearModes.find((mode) => mode === clearMode)
    if (known === undefined) {
      throw new Refusal(requestErrors.content, `Remote Run: clear mode ${clearMode} does not exist on this family`)
    }
    if (!force) this.#checkOwner(owner, 'Remote Run')
    // Clearing is part of starting operation from STOP; a CPU that runs or pauses keeps its devices.
    const clear = this.#switch === 'RUN' && this.state === 'STOP' ? CLEARED[known] : undefined
    if (clear !== undefined) this.#parts.clear(clear)
    this.#change('remote', () => {
      this.#hold = undefined
    })
  }

  /** Always completes. Who stopped it first keeps it: a second STOP must not give the way to RUN to somebody else. */
  stop(owner: string): void {
    const keeper = this.#hold?.state === 'STOP' ? this.#hold.owner : owner
    this.#change('remote', () => {
      this.#hold = { state: 'STOP', owner: keeper }
    })
  }

  /** Completes normally with the switch at STOP, but changes nothing then. */
  pause(owner: string, force: boolean): void {
    if (!force) this.#checkOwner(owner, 'Remote Pause')
    if (this.#switch === 'STOP') return
    this.#change('remote', () => {
      this.#hold = { state: 'PAUSE', owner }
    })
  }

  latchClear(owner: string): void {
    this.#checkStopped('Remote Latch Clear')
    this.#checkOwner(owner, 'Remote Latch Clear')
    this.#parts.clear('all')
  }

  /** @throws Refusal when the CPU may not be reset now. */
  checkReset(): void {
    if (!this.#parts.resetAllowed) {
      throw new Refusal(this.#parts.profile.refusals.remote, 'Remote Reset is not permitted by the CPU parameter')
    }
    this.#checkStopped('Remote Reset')
  }

  /** Power off, or the start of a reset. */
  down(): void {
    this.#change('restart', () => {
      this.#up = false
    })
  }

  /** Starts again: remote operations are forgotten, the switch decides. */
  up(): void {
    this.#change('restart', () => {
      this.#up = true
      this.#hold = undefined
    })
  }

  #checkStopped(what: string): void {
    if (this.state === 'STOP') return
    throw new Refusal(this.#parts.profile.refusals.notInStop, `${what}: the CPU is in ${this.state}, not in STOP`)
  }

  #checkOwner(owner: string, what: string): void {
    if (this.#hold === undefined || this.#hold.owner === owner) return
    const { state, owner: holder } = this.#hold
    throw new Refusal(
      this.#parts.profile.refusals.remote,
      `${what}: another device (${holder}) has put it into ${state}`,
    )
  }

  #change(reason: StateChange['reason'], apply: () => void): void {
    const previous = this.state
    apply()
    const { state } = this
    if (state !== previous) this.#parts.changed({ state, previous, reason })
  }
}
