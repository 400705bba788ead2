// Fault switches: which faults are on, for which requests, and how often still.
import { badOption } from '../basics/option-checks'
import { type CommandName, commands } from '../melsec/commands/commands'
import {
  absentFaults,
  type FaultAction,
  type FaultKind,
  type FaultParameter,
  type FaultSettings,
  faultKinds,
} from './fault-kinds'

/** A request (or, for `closeOnAccept`, a connection) that a fault may meet. */
export interface FaultSubject<Name extends string = CommandName> {
  /** Name of the command; undefined when it is none that is declared. */
  readonly command: Name | undefined
  /** Its subcommand; 0 where there is none. */
  readonly subcommand: number
  /** Number of the connection, counting from 1. */
  readonly connection: number
  /** The client, e.g. `127.0.0.1:50231`. */
  readonly remote: string
  /** Of a simulated line: the station. */
  readonly station?: number
}

/** Which requests a fault meets. */
export interface FaultAim<Name extends string = CommandName> {
  /** Only these commands. */
  readonly commands?: readonly Name[]
  /** So often, then it is over. Default: until it is removed. */
  readonly times?: number
  /** Only where this says true. */
  readonly when?: (subject: FaultSubject<Name>) => boolean
}

/**
 * A fault as it is switched on: plain data, except for `when`.
 * @example { kind: 'split', at: 9 }
 * @example { kind: 'endCode', endCode: 0x4031, commands: ['writeWords'], times: 1 }
 */
export type Fault<Name extends string = CommandName, Action extends AnyAction = FaultAction> = Action & FaultAim<Name>

/** A fault of any family. */
export interface AnyAction {
  /** What it is. */
  readonly kind: FaultKind
}

/** A fault that is on. */
export interface ActiveFault<Name extends string = CommandName, Action extends AnyAction = FaultAction> {
  /** As it was given. */
  readonly fault: Fault<Name, Action>
  /** How often it has struck. */
  readonly struck: number
  /** Switches it off. */
  remove(): void
}

/** What faults of a family of PLCs can be about. */
export interface FaultFamily {
  /** Names of its commands. */
  readonly commands: readonly string[]
  /** Kinds that it does not have. */
  readonly absent: readonly FaultKind[]
  /** The highest end code that its answers have room for. */
  readonly highestCode: number
}

const MELSEC: FaultFamily = { commands: Object.keys(commands), absent: absentFaults.melsec, highestCode: 0xffff }

interface Entry<Name extends string, Action extends AnyAction> {
  readonly fault: Fault<Name, Action>
  readonly settings: Readonly<Record<string, number | string>>
  struck: number
}

/** The fault switches of a simulated PLC. Several may be on; of one kind the first that fits strikes. */
export class Faults<Name extends string = CommandName, Action extends AnyAction = FaultAction> {
  readonly #family: FaultFamily
  #entries: readonly Entry<Name, Action>[] = []

  constructor(family: FaultFamily = MELSEC) {
    this.#family = family
  }

  /** Whether none is on. */
  get none(): boolean {
    return this.#entries.length === 0
  }

  get active(): readonly Fault<Name, Action>[] {
    return this.#entries.map(({ fault }) => fault)
  }

  /** @throws RequestError BAD_OPTION */
  add(fault: Fault<Name, Action>): ActiveFault<Name, Action> {
    const entry: Entry<Name, Action> = { fault, settings: settingsOf(fault, this.#family), struck: 0 }
    this.#entries = [...this.#entries, entry]
    return {
      fault,
      get struck() {
        return entry.struck
      },
      remove: () => this.#remove(entry),
    }
  }

  /** Switches everything off. */
  clear(): void {
    this.#entries = []
  }

  /** The settings of the first fault of the kind that fits; it has struck then. */
  take<K extends FaultKind>(kind: K, subject: FaultSubject<Name>): FaultSettings<K> | undefined {
    const entry = this.#find(kind, subject)
    if (entry === undefined) return undefined
    entry.struck++
    if (entry.struck === entry.fault.times) this.#remove(entry)
    // `settingsOf` made them from the row of this kind.
    return entry.settings as FaultSettings<K>
  }

  /** As `take`, without striking. */
  peek<K extends FaultKind>(kind: K, subject: FaultSubject<Name>): FaultSettings<K> | undefined {
    return this.#find(kind, subject)?.settings as FaultSettings<K> | undefined
  }

  #find(kind: FaultKind, subject: FaultSubject<Name>): Entry<Name, Action> | undefined {
    return this.#entries.find(({ fault }) => kindOf(fault) === kind && meets(fault, subject))
  }

  #remove(entry: Entry<Name, Action>): void {
    this.#entries = this.#entries.filter((other) => other !== entry)
  }
}

/** Compared with any kind. */
function kindOf({ kind }: { readonly kind: FaultKind }): FaultKind {
  return kind
}

function meets<Name extends string>({ commands: only, when }: FaultAim<Name>, subject: FaultSubject<Name>): boolean {
  if (only !== undefined && (subject.command === undefined || !only.includes(subject.command))) return false
  return when === undefined || when(subject)
}

const AIM: readonly string[] = ['kind', 'commands', 'times', 'when'] satisfies readonly (keyof Fault)[]

/** A fault as it was given, whatever its family. */
interface GivenFault extends Pick<FaultAim<string>, 'commands' | 'times'> {
  readonly kind: FaultKind
  readonly when?: unknown
}

/** Checks a fault and fills in the defaults. */
function settingsOf(fault: GivenFault, family: FaultFamily): Readonly<Record<string, number | string>> {
  const { kind } = fault
  if (!Object.hasOwn(faultKinds, kind) || family.absent.includes(kind)) {
    const kinds = Object.keys(faultKinds).filter((name) => !family.absent.some((other) => other === name))
    badOption('kind', `There is no fault ${JSON.stringify(kind)}: choose ${kinds.join(', ')}.`)
  }
  const parameters: Readonly<Record<string, FaultParameter>> = faultKinds[kind].parameters
  for (const name of Object.keys(fault)) {
    if (AIM.includes(name) || Object.hasOwn(parameters, name)) continue
    badOption(name, `Fault ${kind} has no ${name}: it has ${[...Object.keys(parameters), ...AIM].join(', ')}.`)
  }
  checkAim(fault, family)
  const given = new Map<string, unknown>(Object.entries(fault))
  const settings = Object.entries(parameters).map(([name, parameter]) => [
    name,
    setting(`${kind}.${name}`, within(name, parameter, family), given.get(name)),
  ])
  return Object.fromEntries(settings)
}

function within(name: string, parameter: FaultParameter, { highestCode }: FaultFamily): FaultParameter {
  return name === 'endCode' && 'min' in parameter ? { ...parameter, max: highestCode } : parameter
}

function setting(field: string, parameter: FaultParameter, given: unknown): number | string {
  const value = given ?? parameter.default
  if ('oneOf' in parameter) {
    if (typeof value === 'string' && parameter.oneOf.includes(value)) return value
    return badOption(
      field,
      `Fault ${field} (${parameter.title}) is ${parameter.oneOf.join(' or ')}, not ${String(value)}.`,
    )
  }
  const { min, max = Number.MAX_SAFE_INTEGER } = parameter
  const end = max === Number.MAX_SAFE_INTEGER ? '' : ` to ${max}`
  if (typeof value === 'number' && Number.isInteger(value) && value >= min && value <= max) return value
  return badOption(
    field,
    `Fault ${field} (${parameter.title}) is a whole number from ${min}${end}, not ${String(value)}.`,
  )
}

function checkAim({ commands: only, times, when }: GivenFault, { commands: names }: FaultFamily): void {
  for (const name of only ?? []) {
    if (!names.includes(name)) badOption('commands', `There is no command ${String(name)}.`)
  }
  if (times !== undefined && !(Number.isInteger(times) && times > 0)) {
    badOption('times', `A fault strikes a whole number of times from 1, not ${String(times)}.`)
  }
  if (when !== undefined && typeof when !== 'function') badOption('when', 'A fault takes a function for when.')
}
