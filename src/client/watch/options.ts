// Options of a watch as programs without types pass them.
import { badOption, checkNames, isPlainObject, type OptionNames, oneOf, wholeNumber } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import type { Deadband } from '../../tags/table/tag'
import { reachOf } from './deadband'
import type { WatchOptions } from './watch'

const NAMES: OptionNames<WatchOptions> = {
  every: true,
  onChange: true,
  deadband: true,
  tell: true,
  heartbeat: true,
  staleAfter: true,
  demoteAfter: true,
  probeEvery: true,
  signal: true,
}

const LONGEST = 24 * 60 * 60 * 1000

/** Of an item that fails. */
const DEMOTE_AFTER = 3
const PROBE_EVERY = 30_000
const SHORTEST_STALE = 1000

/** With everything that was left out. */
export interface WatchSettings {
  readonly every: number
  readonly onChange: ((update: never) => unknown) | undefined
  /** How far the value of an item may move before it counts as changed. */
  readonly reachOf: (name: string | number) => number
  readonly tellsScans: boolean
  readonly heartbeat: number
  readonly staleAfter: number
  readonly demoteAfter: number
  readonly probeEvery: number
  readonly signal: AbortSignal | undefined
}

/**
 * @param names of the items, or their places
 * @throws RequestError BAD_OPTION
 */
export function settleWatch(given: object, names: readonly (string | number)[]): WatchSettings {
  checkNames('', given, NAMES)
  const options: Partial<WatchOptions> = given
  const { every, onChange, signal, heartbeat, tell = 'changes' } = options
  if (every === undefined) badOption('every', 'every is missing: the ms between two scans, e.g. { every: 100 }.')
  wholeNumber('every', every, 1, LONGEST)
  if (onChange !== undefined && typeof onChange !== 'function') {
    badOption('onChange', `onChange is ${shown(onChange)}; it must be a function.`)
  }
  if (signal !== undefined && typeof signal?.addEventListener !== 'function') {
    badOption('signal', 'signal is no AbortSignal: use the signal of an AbortController.')
  }
  const { staleAfter = Math.max(SHORTEST_STALE, 3 * every), demoteAfter, probeEvery } = options
  return {
    every,
    onChange,
    signal,
    reachOf: reachesOf(options.deadband, names),
    tellsScans: oneOf('tell', tell, ['changes', 'scans']) === 'scans',
    heartbeat: heartbeat === undefined ? Number.POSITIVE_INFINITY : wholeNumber('heartbeat', heartbeat, 1, LONGEST),
    staleAfter: wholeNumber('staleAfter', staleAfter, 1, 3 * LONGEST),
    demoteAfter: wholeNumber('demoteAfter', demoteAfter ?? DEMOTE_AFTER, 1),
    probeEvery: wholeNumber('probeEvery', probeEvery ?? PROBE_EVERY, 1, LONGEST),
  }
}

/** One for all, or by name. A name may be `kind`: what stands there is no text then. */
function reachesOf(given: unknown, names: readonly (string | number)[]): WatchSettings['reachOf'] {
  if (given === undefined) return () => 0
  if (!isPlainObject(given))
    badOption('deadband', `deadband is ${shown(given)}; it must be an object, e.g. { kind: 'absolute', value: 0.5 }.`)
  if (isOne(given)) {
    const reach = reachOf('deadband', given)
    return () => reach
  }
  const byName = new Map<string, number>()
  for (const [name, deadband] of Object.entries(given as Readonly<Record<string, Deadband | undefined>>)) {
    if (!names.some((known) => String(known) === name)) badOption(`deadband.${name}`, `No item is named ${name}.`)
    if (deadband !== undefined) byName.set(name, reachOf(`deadband.${name}`, deadband))
  }
  return (name) => byName.get(String(name)) ?? 0
}

function isOne(given: object): given is Deadband {
  return ['kind', 'value'].some((name) => name in given && !isPlainObject(given[name as never]))
}
