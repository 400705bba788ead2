// The process of the demo plant: a tank with an inlet, an outlet, a heater and an agitator. Physics only; the program
// that runs it is plant.ts.

/** What the actuators do. */
export interface Actuators {
  readonly inlet: boolean
  readonly outlet: boolean
  readonly heater: boolean
  readonly agitator: boolean
}

/** l */
export const TANK_CAPACITY = 1000
/** °C */
const AMBIENT = 20
/** l/s; the demo runs faster than a real plant, so that a batch takes about a minute. */
const INLET_FLOW = 40
const OUTLET_FLOW = 50
/** °C of the water that comes in */
const INLET_TEMPERATURE = 15
/** K l/s that the heater gives: 2 K/s at 800 l. */
const HEATER = 1600
/** Share of the difference to the surroundings that is lost per second; more when the agitator runs. */
const LOSS = 0.0015
const LOSS_STIRRED = 0.002
/** An empty heater would burn out: it is interlocked below this, in l. */
const HEATER_COVERED = 50
const BOILING = 100

export class Tank {
  #level = 0
  #temperature = AMBIENT

  /** l, 0 to the capacity: what would be more runs over. */
  get level(): number {
    return this.#level
  }

  /** °C, between the inlet's and boiling. */
  get temperature(): number {
    return this.#temperature
  }

  /** Lets `seconds` pass. */
  run(seconds: number, { inlet, outlet, heater, agitator }: Actuators): void {
    if (inlet) this.#fill(INLET_FLOW * seconds)
    if (outlet) this.#level = Math.max(0, this.#level - OUTLET_FLOW * seconds)
    if (heater && this.#level > HEATER_COVERED) this.#temperature += (HEATER / this.#level) * seconds
    const loss = Math.min(1, (agitator ? LOSS_STIRRED : LOSS) * seconds)
    this.#temperature += (AMBIENT - this.#temperature) * loss
    this.#temperature = Math.min(BOILING, this.#temperature)
  }

  /** What comes in mixes with what is there. */
  #fill(volume: number): void {
    const total = this.#level + volume
    if (total > 0) {
      this.#temperature = (this.#temperature * this.#level + INLET_TEMPERATURE * volume) / total
    }
    this.#level = Math.min(TANK_CAPACITY, total)
  }
}
