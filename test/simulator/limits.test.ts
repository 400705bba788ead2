import { describe, expect, test } from '@jest/globals'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { FORM_BITS } from '../../src/melsec/device/form'
import { type Limit, limitsOf, measureLimit } from '../../src/melsec/device/limit'
import { lackOf, profileIds } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { join, rawBody } from './support'

type Coded = readonly [command: CommandName, subcommandUnit: 0 | 1]
const LIMITED: readonly Coded[] = [
  ['readBits', 1],
  ['readWords', 0],
  ['writeBits', 1],
  ['writeWords', 0],
  ['readRandom', 0],
  ['writeRandomBits', 1],
  ['writeRandomWords', 0],
  ['entryMonitorDevice', 0],
  ['readBlock', 0],
  ['writeBlock', 0],
]

const D = { device: 'D', number: 0 } as const
const M = { device: 'M', number: 0 } as const

/** Where the command is lacking there are no limits of it either. */
function isEntry({ command }: { readonly command: CommandName }): boolean {
  return command === 'entryMonitorDevice'
}

/** `count` times the same. */
function times<T>(count: number, element: T): T[] {
  return new Array<T>(count).fill(element)
}

/** A message that measures so much in the limit's terms, or the next less where the weights allow no other. */
function messageFor({ command, sum, unit }: Limit, measured: number): Readonly<Record<string, unknown>> | undefined {
  const weightOf = (field: string) => sum[field] ?? 1
  switch (command) {
    case 'readBits':
      return { head: M, points: measured }
    case 'readWords':
      return { head: D, points: measured }
    case 'writeBits':
      return { head: M, values: times(measured, true) }
    case 'writeWords':
      return { head: D, values: times(measured, 1) }
    case 'readRandom':
    case 'entryMonitorDevice':
      return { words: times(measured, { device: D }), doubleWords: [] }
    case 'writeRandomBits':
      return { bits: times(measured, { device: M, value: true }) }
    case 'writeRandomWords':
      return { words: times(Math.floor(measured / weightOf('words')), { device: D, value: 1 }), doubleWords: [] }
    case 'readBlock':
      return unit === 'blocks'
        ? { wordBlocks: times(measured, { head: D, points: 1 }), bitBlocks: [] }
        : { wordBlocks: [{ head: D, points: measured }], bitBlocks: [] }
    case 'writeBlock': {
      if (unit === 'blocks') return { wordBlocks: times(measured, { head: D, values: [1] }), bitBlocks: [] }
      const points = measured - weightOf('wordBlocks')
      return { wordBlocks: [{ head: D, values: times(points, 1) }], bitBlocks: [] }
    }
    default:
      return undefined
  }
}

/** Whether another limit on other sums is broken first by this message; only the generic profile has such ones. */
function speaksLater(limit: Limit, limits: readonly Limit[]): boolean {
  const message = messageFor(limit, limit.max) ?? {}
  return limits.some((other) => measureLimit(other, message) > other.max)
}

/** How much more is one more. */
function stepOf({ command, sum }: Limit): number {
  return command === 'writeRandomWords' ? (sum.words ?? 1) : 1
}

describe.each(profileIds.filter((id) => profiles[id].frames.includes('3E')))('%s', (id) => {
  const profile = profiles[id]
  const cases = LIMITED.flatMap(([name, unit]) =>
    profile.forms.flatMap((form) =>
      profile.codes.flatMap((code) =>
        limitsOf(profile, name, form, code)
          .filter((limit) => !speaksLater(limit, limitsOf(profile, name, form, code)))
          .map((limit) => ({ name, unit, form, code, limit, kind: limit.unit })),
      ),
    ),
  )

  test.each(cases)(
    '$name $form $code $kind: the most is taken, one more gets the end code',
    ({ name, unit, ...row }) => {
      const { form, code, limit } = row
      const { asker } = join({ profile: id, code })
      const ask = (measured: number) => {
        const message = messageFor(limit, measured)
        if (message === undefined) throw new Error(`no message for ${name}`)
        return asker.rawEndCode(rawBody(commands[name], FORM_BITS[form] | unit, form, message, code))
      }
      if (profile.lacks.some((lack) => lack.command === name)) {
        expect(ask(limit.max)).toBe(0xc059)
        return
      }
      const largest = limit.max - (limit.max % stepOf(limit))
      expect(ask(largest)).toBe(0)
      expect(ask(largest + stepOf(limit))).toBe(limit.endCode)
    },
  )

  test('every command with limits has a row in every code', () => {
    const seen = new Set(cases.map(({ name, code }) => `${name} ${code}`))
    expect(seen.size).toBe(LIMITED.length * profile.codes.length - profile.lacks.filter(isEntry).length * 2)
  })

  test('none at all is refused', () => {
    const { asker } = join({ profile: id })
    const form = profile.form
    const refuse = (name: CommandName, hex: string) => {
      const [limit] = limitsOf(profile, name, form, 'binary')
      const endCode = lackOf(profile, name)?.endCode ?? limit?.endCode
      expect([name, asker.rawEndCode(Buffer.from(hex, 'hex'))]).toEqual([name, endCode])
    }
    const long = form === 'long'
    refuse('readWords', long ? '0104020000000000a8000000' : '01040000000000a80000')
    refuse('readBits', long ? '010403000000000090000000' : '01040100000000900000')
    refuse('writeWords', long ? '0114020000000000a8000000' : '01140000000000a80000')
    refuse('readRandom', long ? '030402000000' : '030400000000')
    refuse('writeRandomBits', long ? '0214030000' : '0214010000')
    refuse('readBlock', long ? '060402000000' : '060400000000')
  })
})

test('double words weigh more than words in Write Random: 14 of 960 on iQ-R, 14 of 1920 on iQ-F', () => {
  const doubleWords = (count: number) => ({ words: [], doubleWords: times(count, { device: D, value: 1 }) })
  const ask = (profile: 'iq-r' | 'iq-f', form: 'long' | 'short', count: number) =>
    join({ profile }).asker.rawEndCode(rawBody(commands.writeRandomWords, FORM_BITS[form], form, doubleWords(count)))
  expect([ask('iq-r', 'long', 68), ask('iq-r', 'long', 69)]).toEqual([0, 0xc054])
  expect([ask('iq-f', 'short', 137), ask('iq-f', 'short', 138)]).toEqual([0, 0xc054])
})
