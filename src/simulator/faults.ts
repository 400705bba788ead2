// Fault switches: which faults are on, for which requests, and how often still.
import { badOption } from '../basics/option-checks'
import { type CommandName, commands } from '../melsec/commands/commands'
import { type FaultAction, type FaultKind, type FaultParameter, type FaultSettings, faultKinds } from './fault-kinds'

/** A request (or, for `closeOnAccept`, a connection) that a fault may meet. */
export interface FaultSubject {
  /** Name of the command; undefined when it is none that is declared. */
  readonly command: CommandName | undefined
  /** Its subcommand. */
  readonly subcommand: number
  /** Number of the connection, counting from 1. */
  readonly connection: number
  /** The client, e.g. `127.0.0.1:50231`. */
  readonly remote: string
  /** Of a simulated line: the station. */
  readonly station?: number
}

/** Which requests a fault meets. */
export interface FaultAim {
  /** Only these commands. */
  readonly commands?: readonly CommandName[]
  /** So often, then it is over. Default: until it is removed. */
  readonly times?: number
  /** Only where this says true. */
  readonly when?: (subject: FaultSubject) => boolean
}

/**
 * A fault as it is switched on: plain data, except for `when`.
 * @example { kind: 'split', at: 9 }
 * @example { kind: 'endCode', endCode: 0x4031, commands: ['writeWords'], times: 1 }
 */
export type Fault = FaultAction & FaultAim

/** A fault that is on. */
export interface ActiveFault {
  /** As it was given. */
  readonly fault: Fault
  /** How often it has struck. */
  readonly struck: number
  /** Switches it off. */
  remove(): void
}

interface Entry {
  readonly fault: Fault
  readonly settings: Readonly<Record<string, number | string>>
  struck: number
}

/** The fault switches of a simulated PLC. Several may be on; of one kind the first that fits strikes. */
export class Faults {
  #entries: readonly Entry[] = []

  /** Whether none is on. */
  get none(): boolean {
    return this.#entries.length === 0
  }

  get active(): readonly Fault[] {
    return this.#entries.map(({ fault }) => fault)
  }

  /** @throws RequestError BAD_OPTION */
  add(fault: Fault): ActiveFault {
    const entry: Entry = { fault, settings: settingsOf(fault), struck: 0 }
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
  take<K extends FaultKind>(kind: K, subject: FaultSubject): FaultSettings<K> | undefined {
    const entry = this.#find(kind, subject)
    if (entry === undefined) return undefined
    entry.struck++
    if (entry.struck === entry.fault.times) this.#remove(entry)
    // `settingsOf` made them from the row of this kind.
    return entry.settings as FaultSettings<K>
  }

  /** As `take`, without striking. */
  peek<K extends FaultKind>(kind: K, subject: FaultSubject): FaultSettings<K> | undefined {
    return this.#find(kind, subject)?.settings as FaultSettings<K> | undefined
  }

  #find(kind: FaultKind, subject: FaultSubject): Entry | undefined {
    return this.#entries.find(({ fault }) => fault.kind === kind && meets(fault, subject))
  }

  #remove(entry: Entry): void {
    this.#entries = this.#entries.filter((other) => other !== entry)
  }
}

function meets({ commands: only, when }: Fault, subject: FaultSubject): boolean {
  if (only !== undefined && (subject.command === undefined || !only.includes(subject.command))) return false
  return when === undefined || when(subject)
}

const AIM: readonly string[] = ['kind', 'commands', 'times', 'when'] satisfies readonly (keyof Fault)[]

/** Checks a fault and fills in the defaults. */
function settingsOf(fault: Fault): Readonly<Record<string, number | string>> {
  if (!Object.hasOwn(faultKinds, fault.kind)) {
    badOption('kind', `There is no fault ${JSON.stringify(fault.kind)}: choose ${Object.keys(faultKinds).join(', ')}.`)
  }
  const parameters: Readonly<Record<string, FaultParameter>> = faultKinds[fault.kind].parameters
  for (const name of Object.keys(fault)) {
    if (AIM.includes(name) || Object.hasOwn(parameters, name)) continue
    badOption(name, `Fault ${fault.kind} has no ${name}: it has ${[...Object.keys(parameters), ...AIM].join(', ')}.`)
  }
  checkAim(fault)
  const given = new Map<string, unknown>(Object.entries(fault))
  const settings = Object.entries(parameters).map(([name, parameter]) => [
    name,
    setting(`${fault.kind}.${name}`, parameter, given.get(name)),
  ])
  return Object.fromEntries(settings)
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
  if (typeof value === 'number' && Number.isInteger(value) && value >= min && value <= max) return value
  return badOption(field, `Fault ${field} (${parameter.title}) is a whole number from ${min}, not ${String(value)}.`)
}

function checkAim({ commands: only, times, when }: Fault): void {
  for (const name of only ?? []) {
    if (!Object.hasOwn(commands, name)) badOption('commands', `There is no command ${String(name)}.`)
  }
  if (times !== undefined && !(Number.isInteger(times) && times > 0)) {
    badOption('times', `A fault strikes a whole number of times from 1, not ${String(times)}.`)
  }
  if (when !== undefined && typeof when !== 'function') badOption('when', 'A fault takes a function for when.')
}
