// The process of the bottling line: a conveyor with bottles, a filling valve and a supply tank. Physics only; the program that
// runs it is bottling.ts.

/** What the actuators of the bottling line do. */
export interface BottlingActuators {
  readonly supplyPump: boolean
  readonly conveyor: boolean
  readonly fillValve: boolean
}

/** mm from one bottle to the next. */
const PITCH = 300
/** ml/s at a full supply tank; a low one gives less. */
const FLOW = 400
/** ml */
const SUPPLY = 100_000
/** ml/s */
const PUMP = 2000
/** Every so many bottles one foams: so much of its flow is no content. */
const FOAMING = { every: 17, loss: 0.12 } as const

export class Bottles {
  /** mm to the next bottle; 0: it is under the filler. */
  #away = PITCH
  #content = 0
  #supply = 0.8 * SUPPLY
  #count = 0

  /** Whether a bottle is under the filler. */
  get present(): boolean {
    return this.#away <= 0
  }

  /** ml in the bottle under the filler. */
  get content(): number {
    return this.#content
  }

  /** %, 0 to 100 */
  get supply(): number {
    return (100 * this.#supply) / SUPPLY
  }

  /** What a flow meter measures of `ml` that go into this bottle: foam counts, too. */
  get measured(): number {
    return this.#content / (1 - this.#loss)
  }

  /** Lets `seconds` pass. `speed` of the conveyor in mm/s. */
  run(seconds: number, { supplyPump, conveyor, fillValve }: BottlingActuators, speed: number): void {
    if (supplyPump) this.#supply = Math.min(SUPPLY, this.#supply + PUMP * seconds)
    if (fillValve) {
      const given = Math.min(this.#supply, FLOW * (0.5 + 0.5 * (this.#supply / SUPPLY)) * seconds)
      this.#supply -= given
      // Without a bottle it runs to waste.
      if (this.present) this.#content += given * (1 - this.#loss)
    }
    if (conveyor) this.#move(speed * seconds)
  }

  get #loss(): number {
    return this.#count % FOAMING.every === FOAMING.every - 1 ? FOAMING.loss : 0
  }

  #move(distance: number): void {
    if (this.present) {
      this.#away = PITCH
      this.#content = 0
      this.#count++
    }
    // The sensor stops it: no bottle passes the filler within one step.
    this.#away = Math.max(0, this.#away - distance)
  }
}
