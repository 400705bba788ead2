// What lines do to characters on their way.
import type { FaultSettings } from './fault-kinds'

/** A character that is lost, doubled or changed. */
export type Damage = FaultSettings<'damaged'>

/** The bytes with the damage; the last character is meant where there are not so many. */
export function damaged(bytes: Buffer, { what, at, mask }: Damage): Buffer {
  if (bytes.length === 0) return bytes
  const place = Math.min(at, bytes.length - 1)
  if (what === 'lost') return Buffer.concat([bytes.subarray(0, place), bytes.subarray(place + 1)])
  if (what === 'doubled') return Buffer.concat([bytes.subarray(0, place + 1), bytes.subarray(place)])
  const changed = Buffer.from(bytes)
  changed[place] = (bytes[place] ?? 0) ^ mask
  return changed
}

/** Bytes of any value, the same for the same seed. */
export function noiseOf({ bytes, seed }: FaultSettings<'noise'>): Buffer {
  const noise = Buffer.alloc(bytes)
  let state = seed
  for (let i = 0; i < bytes; i++) {
    // Numerical Recipes' linear congruential generator: its high bits are as good as noise.
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0
    noise[i] = state >>> 24
  }
  return noise
}
