// `--fault`: a fault of the simulated PLC as it is typed.
import { commands, type JwCommandName, jwCommands } from '../entry/codec'
import { type Fault, type FaultKind, faultKinds, type JwFaultAction } from '../entry/simulator'
import { RequestError } from '../index'
import { endCodeOf } from './end-code'

/**
 * `kind`, or `kind:name=value,...` with the parameters of the kind, `times` and `commands` (joined by +).
 * @throws RequestError BAD_OPTION when it is no such text; the simulator checks the rest.
 * @example faultOf('endCode:endCode=C056,commands=readWords+readBits,times=1')
 */
export function faultOf(text: string): Fault {
  // The names and values are the user's; the simulator checks them against the kind.
  return parsed(text, Object.keys(commands)) as Fault
}

/** The same of a simulated Sharp JW: its commands, and result codes. */
export function jwFaultOf(text: string): Fault<JwCommandName, JwFaultAction> {
  return parsed(text, Object.keys(jwCommands)) as Fault<JwCommandName, JwFaultAction>
}

function parsed(text: string, names: readonly string[]): { readonly kind: FaultKind } {
  const [, kind = '', settings = ''] = /^([^:]*)(?::(.*))?$/s.exec(text.trim()) ?? []
  if (!isKind(kind))
    bad(text, `there is no fault ${JSON.stringify(kind)}. Faults are ${Object.keys(faultKinds).join(', ')}.`)
  const entries = settings === '' ? [] : settings.split(',').map((setting) => settingOf(text, setting, names))
  return { kind, ...Object.fromEntries(entries) }
}

function isKind(kind: string): kind is FaultKind {
  return Object.hasOwn(faultKinds, kind)
}

function settingOf(text: string, setting: string, names: readonly string[]): readonly [string, unknown] {
  const [, name, value = ''] = /^\s*(\w+)\s*=\s*(.*?)\s*$/.exec(setting) ?? []
  if (name === undefined) bad(text, `${JSON.stringify(setting)} is no setting: write name=value, e.g. delay:ms=500.`)
  switch (name) {
    case 'commands':
      return [name, value.split('+').map((command) => commandOf(text, command, names))]
    case 'endCode':
      return [name, endCodeOf(value)]
    default:
      return [name, /^\d+$/.test(value) ? Number(value) : value]
  }
}

function commandOf(text: string, name: string, names: readonly string[]): string {
  if (names.includes(name)) return name
  return bad(text, `there is no command ${JSON.stringify(name)}. Commands are ${names.join(', ')}.`)
}

function bad(text: string, reason: string): never {
  throw new RequestError('BAD_OPTION', `${JSON.stringify(text)}: ${reason}`, 'fault')
}

/** The kinds of faults with their parameters, for the help. */
export function faultHelp(): string {
  const rows = Object.entries(faultKinds).map(([kind, { title, parameters }]) => {
    const names = Object.keys(parameters)
    return `  ${kind.padEnd(14)} ${title}${names.length === 0 ? '' : ` (${names.join(', ')})`}`
  })
  return `\nFaults (settings in brackets; also times=n and commands=readWords+readBits):\n${rows.join('\n')}`
}
