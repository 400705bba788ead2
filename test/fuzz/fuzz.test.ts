/**
 * Random and damaged frames of every kind, in both directions. `npm run fuzz` takes a million of each kind and another
 * seed; here there are few and always the same, so that the tests stay quick and never fail by chance.
 */
import { describe, expect, test } from '@jest/globals'
import type { JwDeclaration, JwModel } from '../../src/jw/commands/command'
import { jwCommands } from '../../src/jw/commands/commands'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { commands } from '../../src/melsec/commands/commands'
import { oneCCommands } from '../../src/melsec/one-c/commands'
import { frameKinds } from './frame-kinds'
import { Random } from './random'
import { type FuzzResult, fuzz, type Tally } from './run'

const { FUZZ_FRAMES, FUZZ_SEED } = process.env
const options = { seed: Number(FUZZ_SEED ?? 1), frames: Number(FUZZ_FRAMES ?? 5000), every: 200 }
/** ms of processor time for a frame of 64 KB, explained, with a garbage collection in between. */
const LONGEST = 2000
const MOST_GROWN = 32 * 2 ** 20

describe.each(frameKinds)('$name', (kind) => {
  test('gives values or ProtocolErrors, in bounded memory and time', () => {
    const found = fuzz(kind, options)
    if (FUZZ_FRAMES !== undefined) process.stdout.write(report(found))
    for (const tally of [found.requests, found.answers]) {
      expect(tally.longest).toBeLessThan(LONGEST)
      // The damage is of use only when it comes as far as the decoders, and is found there.
      expect(tally.values).toBeGreaterThan(options.frames / 20)
      expect(tally.protocolErrors).toBeGreaterThan(options.frames / 20)
    }
    expect(found.grown).toBeLessThan(MOST_GROWN)
    expect(namesOf(kind.name)).toEqual([...found.commands].sort())
  }, 3_600_000)
})

/** Every command of the set, so that none is left out because no message of it could be made. */
function namesOf(kind: string): string[] {
  if (kind.startsWith('JW')) return jwNames(kind.includes('JW30H') ? 'jw30h' : 'jw300')
  return Object.keys(SETS[kind.slice(0, 2)] ?? commands).sort()
}

/** Each model has some that the other lacks. */
function jwNames(model: JwModel): string[] {
  const all: readonly (JwDeclaration & { readonly name: string })[] = Object.values(jwCommands)
  return all
    .filter(({ models }) => models?.includes(model) !== false)
    .map(({ name }) => name)
    .sort()
}

/** By what the name of the kind begins with, where it is not the SLMP set. */
const SETS: Readonly<Record<string, object>> = { '1E': aCompatibleCommands, '1C': oneCCommands }

function report({ kind, grown, requests, answers }: FuzzResult): string {
  const of = (
    side: string,
    { frames, values, endCodes, protocolErrors, incomplete, longest, longestAt, ms, buffered }: Tally,
  ) =>
    `${kind} ${side}: ${frames} frames, ${Math.round(frames / (ms / 1000))}/s; ${values} values, ${endCodes} end codes, ` +
    `${protocolErrors} ProtocolErrors, ${incomplete} incomplete; longest ${longest.toFixed(1)} ms (frame ${longestAt}), most kept ${buffered} bytes\n`
  return `${of('requests', requests)}${of('answers', answers)}${kind}: heap ${(grown / 2 ** 20).toFixed(2)} MB more\n`
}

test('the same seed and place give the same numbers, another seed others', () => {
  const random = new Random()
  const from = (seed: number, place: number) => {
    random.restart(seed, place)
    return Array.from({ length: 8 }, () => random.next())
  }
  expect(from(1, 5)).toEqual(from(1, 5))
  expect(new Set([from(1, 5), from(1, 6), from(2, 5), from(0, 0)].map(String)).size).toBe(4)
})
