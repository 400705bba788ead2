// The demo plant: a mixing tank, and the program in the PLC that makes batches with it.
import { type PlantTagName, plantTag, plantVariantOf } from './plant-tags'
import { checkedInterval, type DemoPlant, type DemoPlantOptions, PlantValues, scanning } from './plant-values'
import type { PlcSimulator } from './server'
import { type Actuators, TANK_CAPACITY, Tank } from './tank'

export { demoPlantTags, type PlantTag, type PlantTagName, type PlantVariant, plantVariantOf } from './plant-tags'
export type { DemoPlant, DemoPlantOptions } from './plant-values'

/** What the plant needs of a simulated PLC: one that listens, or a station of a simulated line. */
export interface PlantHost extends Pick<PlcSimulator, 'profile' | 'clock' | 'cpu' | 'read' | 'write'> {
  /** Calls `listener` on the event; the returned function ends it. */
  on(event: 'state' | 'restart' | 'clear' | 'close', listener: () => void): () => void
}

const PHASE = { stopped: 0, filling: 1, heating: 2, mixing: 3, emptying: 4 } as const
type Phase = keyof typeof PHASE

const ALARM = { none: 0, setPoint: 1, full: 2, hot: 3 } as const
type Alarm = keyof typeof ALARM

const PRODUCTS = [
  { product: 'Apple juice', productJa: 'りんごジュース' },
  { product: 'Green tea', productJa: '緑茶' },
  { product: 'Oolong tea', productJa: '烏龍茶' },
] as const

/** l: above it the float switch says full. */
const FULL = 0.95 * TANK_CAPACITY
/** l: below it the tank counts as empty. */
const EMPTY = 1
/** °C */
const TOO_HOT = 95

/**
 * Starts the demo plant in a simulated PLC; `demoPlantTags` are its addresses.
 * The program stands still while the CPU is in STOP (outputs off) or PAUSE (outputs as they are); the tank lives on.
 * @throws RequestError BAD_OPTION
 * @example
 * const plc = createPlcSimulator({ tcp: { port: 5007 } })
 * await plc.listen()
 * const plant = startDemoPlant(plc)
 */
export function startDemoPlant(plc: PlantHost, options: DemoPlantOptions = {}): DemoPlant {
  const { autoStart = true } = options
  const interval = checkedInterval(options.interval ?? 200)
  const plant = new Plant(plc, autoStart)
  const cancel = scanning(plc.clock, interval, (elapsed) => plant.scan(elapsed))
  const ends = [
    plc.on('state', () => plant.stateChanged()),
    plc.on('restart', () => plant.initialize()),
    plc.on('clear', () => plant.initialize()),
    plc.on('close', () => stop()),
  ]
  function stop(): void {
    cancel()
    for (const end of ends) end()
  }
  return { stop }
}

class Plant {
  readonly #plc: PlantHost
  readonly #autoStart: boolean
  readonly #values: PlantValues<PlantTagName>
  readonly #tank = new Tank()
  #phase: Phase = 'stopped'
  /** Seconds. */
  #batchTime = 0
  #mixed = 0

  constructor(plc: PlantHost, autoStart: boolean) {
    this.#plc = plc
    this.#autoStart = autoStart
    this.#values = new PlantValues(plc, (name) => plantTag(plantVariantOf(plc.profile.id), name))
    this.initialize()
  }

  /** After power on, and after a clear: initial values. */
  initialize(): void {
    this.#phase = 'stopped'
    this.#batchTime = 0
    this.#mixed = 0
    this.#values.set('levelSetPoint', 800)
    this.#values.set('temperatureSetPoint', 40)
    this.#values.set('mixingTime', 10)
    this.#values.set('recipe', 1)
    this.#values.set('operator', 'Yamada 山田')
    this.#values.set('running', this.#autoStart)
    this.#showProduct()
    this.#showProcess()
  }

  /** In STOP all outputs are off. */
  stateChanged(): void {
    if (this.#plc.cpu.state === 'STOP') this.#actuate({})
  }

  scan(seconds: number): void {
    this.#tank.run(seconds, this.#actuators())
    this.#values.set('lowLevel', this.#tank.level > EMPTY)
    this.#values.set('highLevel', this.#tank.level >= FULL)
    if (this.#plc.cpu.state !== 'RUN') return
    this.#buttons()
    this.#watch()
    if (this.#values.is('running')) this.#run(seconds)
    else this.#actuate({})
    this.#values.set('scans', (this.#values.number('scans') + 1) >>> 0)
    this.#showProcess()
  }

  #buttons(): void {
    if (this.#values.pressed('acknowledge')) this.#raise('none')
    if (this.#values.pressed('start') && !this.#values.is('alarm')) this.#values.set('running', true)
    // The last word is the stop button's.
    if (this.#values.pressed('stop')) this.#values.set('running', false)
  }

  #watch(): void {
    if (!this.#values.is('running')) return
    if (
      !this.#values.within('levelSetPoint') ||
      !this.#values.within('temperatureSetPoint') ||
      !this.#values.within('mixingTime')
    ) {
      this.#raise('setPoint')
    } else if (this.#values.is('inlet') && this.#tank.level >= FULL) this.#raise('full')
    else if (this.#values.is('heater') && this.#tank.temperature >= TOO_HOT) this.#raise('hot')
  }

  /** An alarm ends automatic operation until it is acknowledged and started again. */
  #raise(alarm: Alarm): void {
    this.#values.set('alarmCode', ALARM[alarm])
    this.#values.set('alarm', alarm !== 'none')
    if (alarm !== 'none') this.#values.set('running', false)
  }

  #run(seconds: number): void {
    if (!this.#values.is('running')) return
    if (this.#phase === 'stopped') this.#beginBatch()
    this.#batchTime += seconds
    const { level, temperature } = this.#tank
    if (this.#phase === 'filling' && level >= this.#values.number('levelSetPoint')) this.#phase = 'heating'
    if (this.#phase === 'heating' && temperature >= this.#values.number('temperatureSetPoint')) this.#phase = 'mixing'
    if (this.#phase === 'mixing') {
      this.#mixed += seconds
      if (this.#mixed >= this.#values.number('mixingTime')) this.#phase = 'emptying'
    }
    if (this.#phase === 'emptying' && level <= EMPTY) this.#endBatch()
    this.#actuate({
      inlet: this.#phase === 'filling',
      outlet: this.#phase === 'emptying',
      // A two-point controller: it also keeps the temperature while mixing.
      heater:
        (this.#phase === 'heating' || this.#phase === 'mixing') &&
        temperature < this.#values.number('temperatureSetPoint'),
      agitator: this.#phase === 'heating' || this.#phase === 'mixing',
    })
  }

  #beginBatch(): void {
    this.#phase = 'filling'
    this.#batchTime = 0
    this.#mixed = 0
    this.#showProduct()
  }

  #endBatch(): void {
    this.#values.set('batches', (this.#values.number('batches') + 1) | 0)
    this.#values.set('recipe', (this.#recipe() % PRODUCTS.length) + 1)
    this.#beginBatch()
  }

  #recipe(): number {
    return this.#values.within('recipe') ? this.#values.number('recipe') : 1
  }

  #showProduct(): void {
    const product = PRODUCTS[this.#recipe() - 1] ?? PRODUCTS[0]
    this.#values.set('product', product.product)
    this.#values.set('productJa', product.productJa)
  }

  #showProcess(): void {
    this.#values.set('level', this.#tank.level)
    this.#values.set('temperature', this.#tank.temperature)
    this.#values.set('phase', PHASE[this.#values.is('running') ? this.#phase : 'stopped'])
    this.#values.set('batchTime', Math.min(Math.round(this.#batchTime * 1000), 0x7fffffff))
  }

  #actuators(): Actuators {
    return {
      inlet: this.#values.is('inlet'),
      outlet: this.#values.is('outlet'),
      heater: this.#values.is('heater'),
      agitator: this.#values.is('agitator'),
    }
  }

  #actuate({ inlet = false, outlet = false, heater = false, agitator = false }: Partial<Actuators>): void {
    this.#values.set('inlet', inlet)
    this.#values.set('outlet', outlet)
    this.#values.set('heater', heater)
    this.#values.set('agitator', agitator)
  }
}
