// Option units and special I/O of a simulated JW300, whose CU keeps their parameters (COM 02, 03, 12, 13).
import { badOption, checkNames, oneOf, wholeNumber } from '../../basics/option-checks'
import { dl1Parameters } from '../../jw/parameters/dl1'
import { dl9Areas, dl9Parameters } from '../../jw/parameters/dl9'
import { flNetParameters } from '../../jw/parameters/fl-net'
import { checkCodeOf, type ParameterBlock, parameterArea, startSwitch } from '../../jw/parameters/parameter-area'
import type { ParameterProblem } from '../../jw/parameters/parameter-map'
import { serialInterfaceProblems } from '../../jw/parameters/serial-interface-unit'
import { Refusal } from '../refusal'
import { result } from './result'

/** Kinds of option units whose parameters the simulated JW checks. */
export type JwUnitKind = 'dl1' | 'dl9' | 'fl-net' | 'jw-22su' | 'other'

/** An option unit of a simulated JW. */
export interface SimulatedOptionUnit {
  /** Rack, 0 to 7. */
  readonly rack: number
  /** Unit in the rack, 0 to 7. */
  readonly unit: number
  /** What its parameters must hold. Default `other`: anything. */
  readonly kind?: JwUnitKind
  /** DL9: the unit number switch, 0 to 5. Default 0. */
  readonly unitNumber?: number
  /** Its parameters from 0000 on. With them it has been started, so that its start switch (3777) is 1. */
  readonly parameters?: Uint8Array
}

/** An option unit as a program or a test sees it. */
export interface OptionUnitState {
  /** A copy of all 2048 parameters: 0000 to 3777 (octal). */
  readonly parameters: Buffer
  /** Its start switch is 1, and it has no error. */
  readonly started: boolean
  /** The error that the manual prints for such parameters, e.g. 70H; undefined: none, or none is printed. */
  readonly error: number | undefined
  /** What is wrong with its parameters since they were taken over, and what is odd. */
  readonly problems: readonly ParameterProblem[]
}

const UNIT_NAMES = { rack: true, unit: true, kind: true, unitNumber: true, parameters: true } as const
const LAST = 7

interface UnitRule {
  /** Of parameters that break a rule (JW300 option unit manual); where none is printed there is none. */
  readonly error?: number
  problems(blocks: readonly ParameterBlock[], unitNumber: number): readonly ParameterProblem[]
}

const rules: Readonly<Record<JwUnitKind, UnitRule>> = {
  dl1: { error: 0x70, problems: (blocks) => dl1Parameters.read(blocks).problems },
  dl9: { error: 0x70, problems: (blocks, unitNumber) => dl9Parameters.read(blocks, { unitNumber }).problems },
  'fl-net': { problems: (blocks) => flNetParameters.read(blocks).problems },
  'jw-22su': { error: 0x3c, problems: serialInterfaceProblems },
  other: { problems: () => [] },
}

/** Parameters by rack and unit; what nobody has written is 0. */
class Parameters {
  readonly #size: number
  readonly #written = new Map<number, Buffer>()

  constructor(size: number) {
    this.#size = size
  }

  of(rack: number, unit: number): Buffer {
    const key = rack * (LAST + 1) + unit
    const bytes = this.#written.get(key) ?? Buffer.alloc(this.#size)
    this.#written.set(key, bytes)
    return bytes
  }

  /** @throws Refusal behind the last one */
  read(rack: number, unit: number, address: number, length: number): Buffer {
    this.check(address, length)
    return Buffer.from(this.of(rack, unit).subarray(address, address + length))
  }

  /** @throws Refusal */
  check(address: number, length: number): void {
    if (address + length > this.#size) throw new Refusal(result.capacity, 'there are no such parameters')
  }
}

export class SpecialIo {
  readonly #parameters = new Parameters(0x80)

  read(rack: number, unit: number, address: number, length: number): Buffer {
    return this.#parameters.read(rack, unit, address, length)
  }

  write(rack: number, unit: number, address: number, data: Uint8Array): void {
    this.#parameters.check(address, data.length)
    this.#parameters.of(rack, unit).set(data, address)
  }
}

export class OptionUnits {
  readonly #refusal: number
  readonly #parameters = new Parameters(parameterArea.last + 1)
  readonly #units = new Map<string, SimulatedOptionUnit>()
  readonly #problems = new Map<string, readonly ParameterProblem[]>()

  /** @param refusal result code of a write while the start switch is 1. @throws RequestError BAD_OPTION */
  constructor(units: readonly SimulatedOptionUnit[], refusal: number) {
    this.#refusal = refusal
    if (!Array.isArray(units)) badOption('optionUnits', 'optionUnits is a list of units.')
    for (const [i, unit] of units.entries()) this.#add(unit, `optionUnits.${i}`)
  }

  /** @throws Refusal */
  read(rack: number, unit: number, address: number, length: number): Buffer {
    return this.#parameters.read(rack, unit, address, length)
  }

  /**
   * While the start switch is 1, only the switch itself is written. When it becomes 1 the unit takes its parameters over.
   * @throws Refusal
   */
  write(rack: number, unit: number, address: number, data: Uint8Array): void {
    this.#parameters.check(address, data.length)
    const bytes = this.#parameters.of(rack, unit)
    const at = parameterArea.startSwitch
    const before = bytes[at]
    const after = data[at - address] ?? before
    if (after !== startSwitch.stop && after !== startSwitch.start) {
      throw new Refusal(this.#refusal, `the start switch is 0 or 1, not ${after}`)
    }
    if (before !== startSwitch.stop && (address !== at || after !== startSwitch.stop)) {
      throw new Refusal(this.#refusal, 'parameters are written while the start switch (3777) is 0')
    }
    bytes.set(data, address)
    if (before === startSwitch.stop && after === startSwitch.start) this.#start(rack, unit)
    if (after === startSwitch.stop) this.#problems.delete(keyOf(rack, unit))
  }

  /** @throws RequestError BAD_OPTION */
  stateOf(rack: number, unit: number): OptionUnitState {
    checkPlace({ rack, unit }, '')
    const parameters = Buffer.from(this.#parameters.of(rack, unit))
    const problems = this.#problems.get(keyOf(rack, unit)) ?? []
    const isWrong = problems.some(({ severity }) => severity === 'error')
    const { error } = rules[this.#units.get(keyOf(rack, unit))?.kind ?? 'other']
    const isOn = parameters[parameterArea.startSwitch] === startSwitch.start
    return { parameters, started: isOn && !isWrong, error: isWrong ? error : undefined, problems }
  }

  #add(given: SimulatedOptionUnit, field: string): void {
    checkNames(`${field}.`, given, UNIT_NAMES)
    const { rack, unit, kind = 'other', unitNumber = 0, parameters } = given
    checkPlace(given, `${field}.`)
    oneOf(`${field}.kind`, kind, ['dl1', 'dl9', 'fl-net', 'jw-22su', 'other'])
    wholeNumber(`${field}.unitNumber`, unitNumber, 0, kind === 'dl9' ? dl9Areas.length - 1 : LAST)
    const key = keyOf(rack, unit)
    if (this.#units.has(key)) badOption(field, `${field}: there is a unit in rack ${rack}, unit ${unit} already.`)
    this.#units.set(key, { rack, unit, kind, unitNumber })
    if (parameters === undefined) return
    if (!(parameters instanceof Uint8Array) || parameters.length > parameterArea.checkCode) {
      badOption(
        `${field}.parameters`,
        `${field}.parameters are at most ${parameterArea.checkCode} bytes, from 0000 on.`,
      )
    }
    const bytes = this.#parameters.of(rack, unit)
    bytes.set(parameters)
    bytes[parameterArea.startSwitch] = startSwitch.start
    this.#start(rack, unit)
  }

  #start(rack: number, unit: number): void {
    const bytes = this.#parameters.of(rack, unit)
    bytes[parameterArea.checkCode] = checkCodeOf(bytes)
    const { kind = 'other', unitNumber = 0 } = this.#units.get(keyOf(rack, unit)) ?? {}
    const block = { address: 0, bytes: bytes.subarray(0, parameterArea.checkCode) }
    this.#problems.set(keyOf(rack, unit), rules[kind].problems([block], unitNumber))
  }
}

function keyOf(rack: number, unit: number): string {
  return `${rack}.${unit}`
}

function checkPlace({ rack, unit }: Pick<SimulatedOptionUnit, 'rack' | 'unit'>, prefix: string): void {
  wholeNumber(`${prefix}rack`, rack, 0, LAST)
  wholeNumber(`${prefix}unit`, unit, 0, LAST)
}
