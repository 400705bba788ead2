// What the programs of the demo have in common: values by the names of their tags, and scans in time.
import { RequestError } from '../errors'
import type { Clock } from '../transport/clock'
import type { PlcValue, ValueFormat } from '../value/value'
import type { PlantTag } from './plant-tags'

/** How a plant of the demo runs. */
export interface DemoPlantOptions {
  /** ms between two scans of the program. Default 200. */
  readonly interval?: number
  /** Whether automatic operation is on from the beginning. Default true. */
  readonly autoStart?: boolean
}

/** A plant of the demo, while it runs. */
export interface DemoPlant {
  /** Ends it; the devices keep their values. Also done by `close()` of the PLC. */
  stop(): void
}

/** Memory of a simulated PLC, by address and type. */
interface Memory {
  read(item: string): PlcValue
  write(item: string, value: PlcValue, format?: ValueFormat): void
}

export class PlantValues<Name extends string> {
  readonly #memory: Memory
  readonly #tagOf: (name: Name) => PlantTag<Name>
  readonly #tags = new Map<Name, PlantTag<Name>>()

  constructor(memory: Memory, tagOf: (name: Name) => PlantTag<Name>) {
    this.#memory = memory
    this.#tagOf = tagOf
  }

  is(name: Name): boolean {
    return this.#memory.read(this.#tag(name).address) === true
  }

  number(name: Name): number {
    return Number(this.#memory.read(this.#tag(name).address))
  }

  set(name: Name, value: PlcValue): void {
    const { address, encoding } = this.#tag(name)
    this.#memory.write(address, value, encoding === undefined ? {} : { encoding })
  }

  /** Whether a value is one that the program accepts. */
  within(name: Name): boolean {
    const { min = Number.NEGATIVE_INFINITY, max = Number.POSITIVE_INFINITY } = this.#tag(name)
    const value = this.number(name)
    return value >= min && value <= max
  }

  /** A button is a bit that people set and the program resets. */
  pressed(name: Name): boolean {
    const pressed = this.is(name)
    if (pressed) this.set(name, false)
    return pressed
  }

  #tag(name: Name): PlantTag<Name> {
    const known = this.#tags.get(name) ?? this.#tagOf(name)
    this.#tags.set(name, known)
    return known
  }
}

/** @throws RequestError BAD_OPTION */
export function checkedInterval(interval: number): number {
  if (Number.isFinite(interval) && interval >= 1) return interval
  throw new RequestError('BAD_OPTION', `interval is 1 ms or more, not ${String(interval)}.`, 'interval')
}

/** Scans again and again, with the seconds since the scan before; the returned function ends it. */
export function scanning(clock: Clock, interval: number, run: (elapsed: number) => void): () => void {
  let last = clock.now()
  let cancel = () => {}
  const scan = () => {
    const now = clock.now()
    run(Math.min((now - last) / 1000, LONGEST_STEP))
    last = now
    cancel = clock.timer(interval, scan, { unref: true })
  }
  cancel = clock.timer(interval, scan, { unref: true })
  return () => cancel()
}

/** A program that stood still for long, as on a sleeping computer, must not do it all in one step. */
const LONGEST_STEP = 1
