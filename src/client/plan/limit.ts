// How much one request carries, for the planner: the profile's limits and what the count fields can say.

import type { ClientProtocol } from '../../melsec/client-protocol'
import { type CommandName, commands } from '../../melsec/commands/commands'
import type { DeviceForm } from '../../melsec/device/device-form'
import { type Limit, limitsOf } from '../../melsec/device/limit'
import type { LimitedUnit } from '../../melsec/device/limit-rule'
import type { Profile } from '../../melsec/profiles/profile'

/** What of a protocol the planner looks at. */
export type PlanProtocol = Pick<ClientProtocol, 'profile' | 'code' | 'exchange' | 'answerBytes'>

/** Elements per field of a request, named as in `Limit.sum`, e.g. `{ words: 3, doubleWords: 2 }`. */
export type Load = Readonly<Record<string, number>>

/** The weighted sum of a load is at most `max`. */
export type Bound = Pick<Limit, 'sum' | 'max'>

const known = new WeakMap<Profile, Map<string, readonly Bound[]>>()

/** Everything that bounds one request: the profile's limits and the width of the count fields. Kept per profile. */
export function boundsOf(
  { profile, code }: PlanProtocol,
  command: CommandName,
  form: DeviceForm,
  of?: LimitedUnit,
): readonly Bound[] {
  const ofProfile = known.get(profile) ?? new Map<string, readonly Bound[]>()
  known.set(profile, ofProfile)
  const key = `${command} ${form} ${code} ${of ?? ''}`
  let bounds = ofProfile.get(key)
  if (bounds === undefined) {
    bounds = [...limitsOf(profile, command, form, code, of), ...widthsOf(command)]
    ofProfile.set(key, bounds)
  }
  return bounds
}

function widthsOf(command: CommandName): Bound[] {
  return Object.entries(commands[command].request).flatMap(([name, field]): Bound[] => {
    if (field.kind === 'count') return [{ sum: { [field.of]: 1 }, max: 2 ** (8 * field.width) - 1 }]
    return field.kind === 'u16' ? [{ sum: { [name]: 1 }, max: 0xffff }] : []
  })
}

function measured(bound: Bound, load: Load): number {
  let sum = 0
  for (const [path, weight] of Object.entries(bound.sum)) sum += weight * (load[path] ?? 0)
  return sum
}

export function fits(bounds: readonly Bound[], load: Load): boolean {
  return bounds.every((bound) => measured(bound, load) <= bound.max)
}

/** Requests that a load needs at least, however it is distributed. */
export function fewestFor(bounds: readonly Bound[], load: Load): number {
  return bounds.reduce((most, bound) => Math.max(most, Math.ceil(measured(bound, load) / bound.max)), 0)
}

export function added(a: Load, b: Load): Load {
  const sum: Record<string, number> = { ...a }
  for (const [path, count] of Object.entries(b)) sum[path] = (sum[path] ?? 0) + count
  return sum
}

/** The largest whole number for which `holds`, which holds for all smaller ones too; 0 when not even 1. */
export function largest(holds: (n: number) => boolean): number {
  let low = 0
  let high = 0x10000
  while (high - low > 1) {
    const middle = (low + high) >> 1
    if (holds(middle)) low = middle
    else high = middle
  }
  return low
}

/** Puts each parcel into the first request it fits into, the heaviest first. Every parcel must fit into an empty one. */
export function firstFit<T>(parcels: readonly T[], loadOf: (parcel: T) => Load, bounds: readonly Bound[]): T[][] {
  const bins: { readonly sums: number[]; readonly parcels: T[] }[] = []
  // Loads add up bound by bound, so that plain numbers do: plans have thousands of parcels.
  const weighed = parcels.map((parcel) => {
    const load = loadOf(parcel)
    return { parcel, sums: bounds.map((bound) => measured(bound, load)), weight: weightOf(load, bounds) }
  })
  for (const { parcel, sums } of weighed.sort((a, b) => b.weight - a.weight)) {
    const bin = bins.find((candidate) => bounds.every(({ max }, i) => at(candidate.sums, i) + at(sums, i) <= max))
    if (bin === undefined) bins.push({ sums, parcels: [parcel] })
    else {
      bin.parcels.push(parcel)
      sums.forEach((sum, i) => {
        bin.sums[i] = at(bin.sums, i) + sum
      })
    }
  }
  return bins.map((bin) => bin.parcels)
}

function at(numbers: readonly number[], index: number): number {
  return numbers[index] ?? 0
}

/** Share of a request a load takes. */
export function weightOf(load: Load, bounds: readonly Bound[]): number {
  return bounds.reduce((most, bound) => Math.max(most, measured(bound, load) / bound.max), 0)
}
