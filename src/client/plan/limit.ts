// How much one request carries, for the planner: the profile's limits and what the count fields can say.

import type { ClientProtocol } from '../../melsec/client-protocol'
import { type CommandName, commands } from '../../melsec/commands/commands'
import type { DeviceForm } from '../../melsec/device/device-form'
import { type Limit, limitsOf } from '../../melsec/device/limit'
import type { LimitedUnit } from '../../melsec/device/limit-rule'
import type { Profile } from '../../melsec/profiles/profile'

/** What of a protocol the planner looks at. */
export type PlanProtocol = Pick<
  ClientProtocol,
  'profile' | 'code' | 'exchange' | 'check' | 'bodyBytes' | 'answerBytes' | 'lineCost'
>

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

/** What a load comes to in each of some bounds. Sums of loads are the loads' sums added. */
export type Sums = readonly number[]

export function sumsOf(bounds: readonly Bound[], load: Load): number[] {
  return bounds.map(({ sum }) => {
    let measured = 0
    for (const path in sum) measured += (sum[path] ?? 0) * (load[path] ?? 0)
    return measured
  })
}

/** Adds to the first of the two. */
export function addSums(sums: number[], more: Sums): void {
  for (let i = 0; i < sums.length; i++) sums[i] = at(sums, i) + at(more, i)
}

export function isWithin(bounds: readonly Bound[], sums: Sums): boolean {
  return bounds.every(({ max }, i) => at(sums, i) <= max)
}

export function fits(bounds: readonly Bound[], load: Load): boolean {
  return isWithin(bounds, sumsOf(bounds, load))
}

/** Requests that are needed at least, however they are filled. */
export function fewestFor(bounds: readonly Bound[], sums: Sums): number {
  return bounds.reduce((most, { max }, i) => Math.max(most, Math.ceil(at(sums, i) / max)), 0)
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
export function firstFit<T>(parcels: readonly T[], sumsOfParcel: (parcel: T) => Sums, bounds: readonly Bound[]): T[][] {
  const bins: { readonly sums: number[]; readonly parcels: T[] }[] = []
  const weighed = parcels.map((parcel) => {
    const sums = sumsOfParcel(parcel)
    return { parcel, sums, weight: weightOf(sums, bounds) }
  })
  for (const { parcel, sums } of weighed.sort((a, b) => b.weight - a.weight)) {
    const bin = bins.find((candidate) => bounds.every(({ max }, i) => at(candidate.sums, i) + at(sums, i) <= max))
    if (bin === undefined) bins.push({ sums: [...sums], parcels: [parcel] })
    else {
      bin.parcels.push(parcel)
      addSums(bin.sums, sums)
    }
  }
  return bins.map((bin) => bin.parcels)
}

function at(numbers: Sums, index: number): number {
  return numbers[index] ?? 0
}

/** Share of a request it takes. */
export function weightOf(sums: Sums, bounds: readonly Bound[]): number {
  return bounds.reduce((most, { max }, i) => Math.max(most, at(sums, i) / max), 0)
}
