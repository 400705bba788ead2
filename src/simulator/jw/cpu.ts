// What a simulated JW does and lets others do: run state, blocks of its program, write mode.
import { oneOf } from '../../basics/option-checks'

/** 0 nothing, 1 data memory, 2 all memory may be written. */
export type JwWriteMode = 0 | 1 | 2

/** Why a simulated JW runs or stands still. */
export interface JwStateChange {
  /** What it does now. */
  readonly state: 'RUN' | 'STOP'
  /** Who stopped it: the unit that clients talk to (F8H), or another one, as a programming tool. */
  readonly stoppedBy: 'thisUnit' | 'otherUnit' | undefined
}

/** Run state, blocks and write mode as a program or a test sees them. */
export interface SimulatedJwCpu extends JwStateChange {
  /** What may be written; clients read it (E9H) and set it (F9H). @throws RequestError BAD_OPTION */
  writeMode: JwWriteMode
  /** Blocks of the program that are stopped, in the order of their numbers. */
  readonly stoppedBlocks: readonly number[]
  /** Stops it, as another unit does. Clients cannot start it again. */
  stop(): void
  /** Takes that stop back. Who is stopped by a client stays stopped. */
  run(): void
}

/** Codes of memory sizes in K words (JW300 option unit manual, COM=4DH). */
const SIZES = { 32: 0x03, 64: 0x07, 128: 0x08, 256: 0x09 } as const

interface JwCpuParts {
  readonly writeMode: JwWriteMode
  readonly memorySize: keyof typeof SIZES
}

export class JwCpu implements SimulatedJwCpu {
  readonly #initial: JwWriteMode
  readonly #changed: (change: JwStateChange) => void
  readonly blocks = new Set<number>()
  #mode: JwWriteMode
  /** Code of its size. */
  memorySize: number
  #byUnit = false
  #byOther = false

  constructor({ writeMode, memorySize }: JwCpuParts, changed: (change: JwStateChange) => void) {
    this.#initial = writeMode
    this.#mode = writeMode
    this.memorySize = SIZES[memorySize]
    this.#changed = changed
  }

  get running(): boolean {
    return this.runState === 0
  }

  /** As E8H says it: 0 runs, 1 stopped by this unit, 2 by another. */
  get runState(): 0 | 1 | 2 {
    return this.#byUnit ? 1 : this.#byOther ? 2 : 0
  }

  get state(): 'RUN' | 'STOP' {
    return this.running ? 'RUN' : 'STOP'
  }

  get stoppedBy(): JwStateChange['stoppedBy'] {
    return this.#byUnit ? 'thisUnit' : this.#byOther ? 'otherUnit' : undefined
  }

  get writeMode(): JwWriteMode {
    return this.#mode
  }

  set writeMode(mode: JwWriteMode) {
    this.#mode = oneOf('writeMode', mode, [0, 1, 2])
  }

  get stoppedBlocks(): readonly number[] {
    return [...this.blocks].sort((one, other) => one - other)
  }

  stop(): void {
    this.#set(this.#byUnit, true)
  }

  run(): void {
    this.#set(this.#byUnit, false)
  }

  /** F8H */
  stopByUnit(stop: boolean): void {
    this.#set(stop, this.#byOther)
  }

  /** What clients have set is as at the beginning. */
  powerOn(): void {
    this.#mode = this.#initial
    this.blocks.clear()
    this.#set(false, this.#byOther)
  }

  #set(byUnit: boolean, byOther: boolean): void {
    const before = this.runState
    this.#byUnit = byUnit
    this.#byOther = byOther
    if (this.runState !== before) this.#changed({ state: this.state, stoppedBy: this.stoppedBy })
  }
}
