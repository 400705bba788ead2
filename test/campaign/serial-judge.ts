/**
 * Holds what calls said against what stations did: every word that is ever written is another number, so a value says by itself
 * which write it comes from. Times are those of the computer, the same for both programs.
 */

/** What a station did. */
export interface Carried {
  readonly at: number
  readonly station: number
  /** Numbers of D, and their values. */
  readonly cells: readonly (readonly [number, number])[]
}

/** What a call asked for and said. */
export interface Told {
  readonly name: string
  readonly station: number
  readonly from: number
  readonly to: number
  readonly kind: 'read' | 'write'
  /** Of D. */
  readonly numbers: readonly number[]
  /** Written, or read. */
  readonly values: readonly unknown[]
  readonly outcome: 'done' | 'refused' | 'notSent' | 'unknown' | 'no PlcError'
  readonly error: unknown
}

export const serialViolations = [
  'wrong value',
  'stale value',
  'carried out twice',
  'carried out though told as notSent',
  'carried out though told as refused',
  'done but not carried out',
  'a write that nobody made',
  'no PlcError',
  'lost without noise',
] as const
export interface SerialViolation {
  readonly kind: (typeof serialViolations)[number]
  readonly detail: string
  readonly from: number
  readonly to: number
}

export interface Facts {
  /** What a cell holds at first. */
  readonly initial: (station: number, number: number) => number
  readonly carried: readonly Carried[]
  readonly told: readonly Told[]
  /** Nothing was to go wrong. */
  readonly isQuiet: boolean
}

interface Held {
  readonly value: number
  readonly since: number
}

export function judge(facts: Facts): SerialViolation[] {
  const found: SerialViolation[] = []
  const reportAt =
    (from: number, to: number): Report =>
    (kind, detail) =>
      void found.push({ kind, detail, from, to })
  const past = pastOf(facts)
  const times = carriedOut(facts, reportAt)
  for (const call of facts.told) {
    const report = reportAt(call.from, call.to)
    const error = call.error === undefined ? '' : ` (${String(call.error)})`
    const name = `${call.name}, ${call.from.toFixed(1)} to ${call.to.toFixed(1)}, told as ${call.outcome}${error}`
    if (call.outcome === 'no PlcError') report('no PlcError', name)
    if (facts.isQuiet && call.outcome !== 'done') report('lost without noise', name)
    if (call.kind === 'write') judgeWrite(call, name, times, report)
    else if (call.outcome === 'done') judgeRead(call, name, past, report)
  }
  return found
}

type Report = (kind: SerialViolation['kind'], detail: string) => void

function pastOf({ carried, told, initial }: Facts): (station: number, number: number) => readonly Held[] {
  const past = new Map<string, Held[]>()
  const of = (station: number, number: number): Held[] => {
    const key = `${station} ${number}`
    const known = past.get(key) ?? [{ value: initial(station, number), since: Number.NEGATIVE_INFINITY }]
    past.set(key, known)
    return known
  }
  for (const { at, station, cells } of carried) {
    for (const [number, value] of cells) of(station, number).push({ value, since: at })
  }
  for (const { station, numbers } of told) for (const number of numbers) of(station, number)
  return of
}

/** @returns when the write of a value was carried out */
function carriedOut(
  { carried, told }: Facts,
  reportAt: (from: number, to: number) => Report,
): ReadonlyMap<number, readonly number[]> {
  const times = new Map<number, number[]>()
  const asked = new Map<number, string>()
  for (const { kind, station, numbers, values } of told) {
    if (kind === 'write')
      for (const [i, value] of values.entries()) asked.set(Number(value), `${station} ${numbers[i]}`)
  }
  for (const { at, station, cells } of carried) {
    const report = reportAt(at, at)
    for (const [number, value] of cells) {
      const before = times.get(value) ?? []
      times.set(value, [...before, at])
      const name = `${value} to D${number} of station ${station} at ${at.toFixed(1)}`
      if (asked.get(value) !== `${station} ${number}`) report('a write that nobody made', name)
      if (before.length > 0) report('carried out twice', name)
    }
  }
  return times
}

function judgeWrite(call: Told, name: string, times: ReadonlyMap<number, readonly number[]>, report: Report): void {
  for (const value of call.values) {
    const [first] = times.get(Number(value)) ?? []
    if (call.outcome === 'done' && (first === undefined || first < call.from || first > call.to)) {
      report('done but not carried out', `${name}: ${value} was carried out at ${first}`)
    }
    if (first === undefined) continue
    if (call.outcome === 'notSent') report('carried out though told as notSent', `${name}: ${value}`)
    if (call.outcome === 'refused') report('carried out though told as refused', `${name}: ${value}`)
  }
}

function judgeRead(
  { station, numbers, values, from, to }: Told,
  name: string,
  past: (station: number, number: number) => readonly Held[],
  report: Report,
): void {
  if (values.length !== numbers.length) report('wrong value', `${name}: ${values.length} values`)
  for (const [i, number] of numbers.entries()) {
    const held = past(station, number)
    const value = values[i]
    const isHeld = held.some(
      (one, at) => one.value === value && one.since <= to && (held[at + 1]?.since ?? Number.POSITIVE_INFINITY) >= from,
    )
    if (isHeld) continue
    const was = held.some((one) => one.value === value)
    report(was ? 'stale value' : 'wrong value', `${name}: D${number} gave ${String(value)}`)
  }
}
