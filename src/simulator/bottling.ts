// The bottling line of the demo, and the program in the Sharp JW that runs it.
import { Bottles } from './bottles'
import { type BottlingTagName, bottlingTag } from './bottling-tags'
import type { JwSimulator } from './jw/server'
import { checkedInterval, type DemoPlant, type DemoPlantOptions, PlantValues, scanning } from './plant-values'

export { type BottlingTagName, demoBottlingTags } from './bottling-tags'

/** What the bottling line needs of a simulated Sharp JW. */
export interface BottlingHost extends Pick<JwSimulator, 'clock' | 'cpu' | 'read' | 'write'> {
  /** Calls `listener` on the event; the returned function ends it. */
  on(event: 'state' | 'restart' | 'close', listener: () => void): () => void
}

const PHASE = { stopped: 0, conveying: 1, filling: 2, settling: 3 } as const
type Phase = keyof typeof PHASE

const ALARMS = ['recipeAlarm', 'rejectAlarm', 'supplyAlarm'] as const
type Alarm = (typeof ALARMS)[number]
const RECIPE = ['bottleSize', 'tolerance', 'conveyorSpeed', 'settlingTime'] as const

/** Rejected bottles in a row that are an alarm. */
const MOST_REJECTED = 3
/** %: the supply pump goes on below the first, off above the second; below the last it is an alarm. */
const SUPPLY = { low: 40, high: 95, empty: 1 } as const
/** What fits eight digits, and a double word. */
const MOST = { bcd: 100_000_000, count: 0x1_0000_0000 } as const

/**
 * Starts the bottling line in a simulated Sharp JW; `demoBottlingTags` are its operands.
 * The program stands still while the PLC is stopped, with its outputs off.
 * @throws RequestError BAD_OPTION
 * @example
 * const plc = createJwSimulator({ tcp: { port: 5008 }, writeMode: 1 })
 * await plc.listen()
 * const plant = startDemoBottling(plc)
 */
export function startDemoBottling(plc: BottlingHost, options: DemoPlantOptions = {}): DemoPlant {
  const { autoStart = true } = options
  const interval = checkedInterval(options.interval ?? 200)
  const line = new BottlingLine(plc, autoStart)
  const cancel = scanning(plc.clock, interval, (seconds) => line.scan(seconds))
  const ends = [
    plc.on('state', () => line.stateChanged()),
    plc.on('restart', () => line.initialize()),
    plc.on('close', () => stop()),
  ]
  function stop(): void {
    cancel()
    for (const end of ends) end()
  }
  return { stop }
}

class BottlingLine {
  readonly #plc: BottlingHost
  readonly #autoStart: boolean
  readonly #values: PlantValues<BottlingTagName>
  readonly #process = new Bottles()
  #phase: Phase = 'stopped'
  /** Seconds. */
  #settled = 0
  #rejectedInARow = 0

  constructor(plc: BottlingHost, autoStart: boolean) {
    this.#plc = plc
    this.#autoStart = autoStart
    this.#values = new PlantValues(plc, bottlingTag)
    this.#values.set('bottleSize', 500)
    this.#values.set('tolerance', 15)
    this.#values.set('conveyorSpeed', 250)
    this.#values.set('settlingTime', 400)
    this.#values.set('product', 'Barley tea')
    this.#values.set('productJa', '麦茶')
    this.initialize()
  }

  /** After power on. Registers keep their values. */
  initialize(): void {
    this.#phase = 'stopped'
    this.#rejectedInARow = 0
    this.#actuate({})
    for (const alarm of ALARMS) this.#values.set(alarm, false)
    this.#values.set('alarm', false)
    this.#values.set('running', this.#autoStart)
    this.#show()
  }

  /** While it is stopped all outputs are off. */
  stateChanged(): void {
    if (this.#plc.cpu.state === 'STOP') this.#actuate({})
  }

  scan(seconds: number): void {
    const { supplyPump, conveyor, fillValve } = this.#outputs()
    this.#process.run(seconds, { supplyPump, conveyor, fillValve }, this.#values.number('conveyorSpeed'))
    this.#values.set('bottlePresent', this.#process.present)
    if (this.#plc.cpu.state !== 'RUN') return
    this.#buttons()
    this.#watch()
    if (this.#values.is('running')) this.#run(seconds)
    else this.#stand()
    this.#count('scans')
    this.#show()
  }

  #buttons(): void {
    if (this.#values.pressed('acknowledge')) this.#acknowledge()
    if (this.#values.pressed('start') && !this.#values.is('alarm')) this.#values.set('running', true)
    // The last word is the stop button's.
    if (this.#values.pressed('stop')) this.#values.set('running', false)
  }

  #acknowledge(): void {
    for (const alarm of ALARMS) this.#values.set(alarm, false)
    this.#values.set('alarm', false)
    this.#rejectedInARow = 0
  }

  #watch(): void {
    if (!this.#values.is('running')) return
    if (!RECIPE.every((name) => this.#values.within(name))) this.#raise('recipeAlarm')
    if (this.#rejectedInARow >= MOST_REJECTED) this.#raise('rejectAlarm')
    if (this.#process.supply < SUPPLY.empty) this.#raise('supplyAlarm')
  }

  /** An alarm ends automatic operation until it is acknowledged and started again. */
  #raise(alarm: Alarm): void {
    this.#values.set(alarm, true)
    this.#values.set('alarm', true)
    this.#values.set('running', false)
  }

  #stand(): void {
    this.#phase = 'stopped'
    this.#actuate({})
  }

  #run(seconds: number): void {
    const { present, measured } = this.#process
    if (this.#phase === 'stopped') this.#phase = present ? 'filling' : 'conveying'
    if (this.#phase === 'settling') {
      this.#settled += seconds
      if (this.#settled * 1000 >= this.#values.number('settlingTime')) this.#release()
    } else if (this.#phase === 'conveying' && present) {
      this.#values.set('rejecter', false)
      this.#phase = 'filling'
    }
    // Behind what was asked: the meter counts foam as content, the scales behind it do not.
    if (this.#phase === 'filling' && measured >= this.#values.number('bottleSize')) {
      this.#phase = 'settling'
      this.#settled = 0
    }
    this.#actuate({
      supplyPump: this.#pumps(),
      conveyor: this.#phase === 'conveying',
      fillValve: this.#phase === 'filling',
      rejecter: this.#values.is('rejecter'),
    })
  }

  /** A two-point controller. */
  #pumps(): boolean {
    const { supply } = this.#process
    return this.#values.is('supplyPump') ? supply < SUPPLY.high : supply < SUPPLY.low
  }

  /** Weighs the bottle and lets it go. */
  #release(): void {
    const content = Math.round(this.#process.content)
    // A scan is long in the demo, so that the valve closes late: too much is no fault here.
    const isGood = content >= this.#values.number('bottleSize') - this.#values.number('tolerance')
    this.#values.set('lastFill', Math.min(content, 0xffff))
    this.#count('bottles')
    this.#count(isGood ? 'good' : 'rejected')
    this.#rejectedInARow = isGood ? 0 : this.#rejectedInARow + 1
    this.#values.set('shiftCount', this.#values.number('good') % MOST.bcd)
    this.#values.set('rejecter', !isGood)
    this.#phase = 'conveying'
  }

  #count(name: 'bottles' | 'good' | 'rejected' | 'scans'): void {
    this.#values.set(name, (this.#values.number(name) + 1) % MOST.count)
  }

  #show(): void {
    this.#values.set('fillLevel', Math.min(Math.round(this.#process.content), 0xffff))
    this.#values.set('supply', this.#process.supply)
    this.#values.set('phase', PHASE[this.#phase])
  }

  #outputs() {
    return {
      supplyPump: this.#values.is('supplyPump'),
      conveyor: this.#values.is('conveyor'),
      fillValve: this.#values.is('fillValve'),
    }
  }

  #actuate({ supplyPump = false, conveyor = false, fillValve = false, rejecter = false }): void {
    this.#values.set('supplyPump', supplyPump)
    this.#values.set('conveyor', conveyor)
    this.#values.set('fillValve', fillValve)
    this.#values.set('rejecter', rejecter)
  }
}
