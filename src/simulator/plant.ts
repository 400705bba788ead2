// The demo plant: a mixing tank, and the program in the PLC that makes batches with it.
import { RequestError } from '../errors'
import type { PlcValue } from '../value/value'
import { type PlantTag, type PlantTagName, plantTag, plantVariantOf } from './plant-tags'
import type { PlcSimulator } from './server'
import { type Actuators, TANK_CAPACITY, Tank } from './tank'

export { demoPlantTags, type PlantTag, type PlantTagName, type PlantVariant, plantVariantOf } from './plant-tags'

/** How the mixing tank of the demo runs. */
export interface DemoPlantOptions {
  /** ms between two scans of the program. Default 200. */
  readonly interval?: number
  /** Whether automatic operation is on from the beginning. Default true. */
  readonly autoStart?: boolean
}

/** What the plant needs of a simulated PLC: one that listens, or a station of a simulated line. */
export interface PlantHost extends Pick<PlcSimulator, 'profile' | 'clock' | 'cpu' | 'read' | 'write'> {
  /** Calls `listener` on the event; the returned function ends it. */
  on(event: 'state' | 'restart' | 'clear' | 'close', listener: () => void): () => void
}

/** The mixing tank of the demo, while it runs. */
export interface DemoPlant {
  /** Ends it; the devices keep their values. Also done by `close()` of the PLC. */
  stop(): void
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
  const { interval = 200, autoStart = true } = options
  if (!(Number.isFinite(interval) && interval >= 1)) {
    throw new RequestError('BAD_OPTION', `interval is 1 ms or more, not ${String(interval)}.`, 'interval')
  }
  const { clock } = plc
  const plant = new Plant(plc, autoStart)
  let last = clock.now()
  let cancel = () => {}
  const scan = () => {
    const now = clock.now()
    plant.scan((now - last) / 1000)
    last = now
    cancel = clock.timer(interval, scan, { unref: true })
  }
  cancel = clock.timer(interval, scan, { unref: true })
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

/** A program that stood still for long, as on a sleeping computer, must not do it all in one step. */
const LONGEST_STEP = 1

class Plant {
  readonly #plc: PlantHost
  readonly #autoStart: boolean
  readonly #tags = new Map<PlantTagName, PlantTag>()
  readonly #tank = new Tank()
  #phase: Phase = 'stopped'
  /** Seconds. */
  #batchTime = 0
  #mixed = 0

  constructor(plc: PlantHost, autoStart: boolean) {
    this.#plc = plc
    this.#autoStart = autoStart
    this.initialize()
  }

  /** After power on, and after a clear: initial values. */
  initialize(): void {
    this.#phase = 'stopped'
    this.#batchTime = 0
    this.#mixed = 0
    this.#set('levelSetPoint', 800)
    this.#set('temperatureSetPoint', 40)
    this.#set('mixingTime', 10)
    this.#set('recipe', 1)
    this.#set('operator', 'Yamada 山田')
    this.#set('running', this.#autoStart)
    this.#showProduct()
    this.#showProcess()
  }

  /** In STOP all outputs are off. */
  stateChanged(): void {
    if (this.#plc.cpu.state === 'STOP') this.#actuate({})
  }

  scan(elapsed: number): void {
    const seconds = Math.min(elapsed, LONGEST_STEP)
    this.#tank.run(seconds, this.#actuators())
    this.#set('lowLevel', this.#tank.level > EMPTY)
    this.#set('highLevel', this.#tank.level >= FULL)
    if (this.#plc.cpu.state !== 'RUN') return
    this.#buttons()
    this.#watch()
    if (this.#is('running')) this.#run(seconds)
    else this.#actuate({})
    this.#set('scans', (this.#number('scans') + 1) >>> 0)
    this.#showProcess()
  }

  /** A button is a bit that people set and the program resets. */
  #buttons(): void {
    if (this.#pressed('acknowledge')) this.#raise('none')
    if (this.#pressed('start') && !this.#is('alarm')) this.#set('running', true)
    // The last word is the stop button's.
    if (this.#pressed('stop')) this.#set('running', false)
  }

  #pressed(button: 'start' | 'stop' | 'acknowledge'): boolean {
    const pressed = this.#is(button)
    if (pressed) this.#set(button, false)
    return pressed
  }

  #watch(): void {
    if (!this.#is('running')) return
    if (!this.#within('levelSetPoint') || !this.#within('temperatureSetPoint') || !this.#within('mixingTime')) {
      this.#raise('setPoint')
    } else if (this.#is('inlet') && this.#tank.level >= FULL) this.#raise('full')
    else if (this.#is('heater') && this.#tank.temperature >= TOO_HOT) this.#raise('hot')
  }

  /** An alarm ends automatic operation until it is acknowledged and started again. */
  #raise(alarm: Alarm): void {
    this.#set('alarmCode', ALARM[alarm])
    this.#set('alarm', alarm !== 'none')
    if (alarm !== 'none') this.#set('running', false)
  }

  #run(seconds: number): void {
    if (!this.#is('running')) return
    if (this.#phase === 'stopped') this.#beginBatch()
    this.#batchTime += seconds
    const { level, temperature } = this.#tank
    if (this.#phase === 'filling' && level >= this.#number('levelSetPoint')) this.#phase = 'heating'
    if (this.#phase === 'heating' && temperature >= this.#number('temperatureSetPoint')) this.#phase = 'mixing'
    if (this.#phase === 'mixing') {
      this.#mixed += seconds
      if (this.#mixed >= this.#number('mixingTime')) this.#phase = 'emptying'
    }
    if (this.#phase === 'emptying' && level <= EMPTY) this.#endBatch()
    this.#actuate({
      inlet: this.#phase === 'filling',
      outlet: this.#phase === 'emptying',
      // A two-point controller: it also keeps the temperature while mixing.
      heater:
        (this.#phase === 'heating' || this.#phase === 'mixing') && temperature < this.#number('temperatureSetPoint'),
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
    this.#set('batches', (this.#number('batches') + 1) | 0)
    this.#set('recipe', (this.#recipe() % PRODUCTS.length) + 1)
    this.#beginBatch()
  }

  #recipe(): number {
    return this.#within('recipe') ? this.#number('recipe') : 1
  }

  #showProduct(): void {
    const product = PRODUCTS[this.#recipe() - 1] ?? PRODUCTS[0]
    this.#set('product', product.product)
    this.#set('productJa', product.productJa)
  }

  #showProcess(): void {
    this.#set('level', this.#tank.level)
    this.#set('temperature', this.#tank.temperature)
    this.#set('phase', PHASE[this.#is('running') ? this.#phase : 'stopped'])
    this.#set('batchTime', Math.min(Math.round(this.#batchTime * 1000), 0x7fffffff))
  }

  #actuators(): Actuators {
    return {
      inlet: this.#is('inlet'),
      outlet: this.#is('outlet'),
      heater: this.#is('heater'),
      agitator: this.#is('agitator'),
    }
  }

  #actuate({ inlet = false, outlet = false, heater = false, agitator = false }: Partial<Actuators>): void {
    this.#set('inlet', inlet)
    this.#set('outlet', outlet)
    this.#set('heater', heater)
    this.#set('agitator', agitator)
  }

  #within(name: PlantTagName): boolean {
    const { min = Number.NEGATIVE_INFINITY, max = Number.POSITIVE_INFINITY } = this.#tag(name)
    const value = this.#number(name)
    return value >= min && value <= max
  }

  #is(name: PlantTagName): boolean {
    return this.#plc.read(this.#tag(name).address) === true
  }

  #number(name: PlantTagName): number {
    return Number(this.#plc.read(this.#tag(name).address))
  }

  #set(name: PlantTagName, value: PlcValue): void {
    const { address, encoding } = this.#tag(name)
    this.#plc.write(address, value, encoding === undefined ? {} : { encoding })
  }

  #tag(name: PlantTagName): PlantTag {
    const known = this.#tags.get(name) ?? plantTag(plantVariantOf(this.#plc.profile.id), name)
    this.#tags.set(name, known)
    return known
  }
}
