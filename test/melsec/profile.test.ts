import { describe, expect, test } from '@jest/globals'
import { explainEndCode } from '../../src/end-code/explain'
import { type EndCodeFamily, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { devices, findDevice } from '../../src/melsec/device/device'
import { limitsOf, pointFields } from '../../src/melsec/device/limit'
import { modelOf } from '../../src/melsec/model-code'
import { fileCommandNames } from '../../src/melsec/profiles/files'
import { labelCommandNames } from '../../src/melsec/profiles/no-labels'
import {
  doubtOf,
  exclusionOf,
  inFlightBound,
  lackOf,
  type Profile,
  type ProfileId,
  profileIds,
} from '../../src/melsec/profiles/profile'
import { profiles, resolveProfile } from '../../src/melsec/profiles/profiles'

const all = Object.values(profiles)
const commandNames = Object.keys(commands)
const deviceNames: readonly string[] = devices.map(({ name }) => name)

function caught(run: () => unknown): RequestError {
  try {
    run()
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('nothing was thrown')
}

/** Whose numbers its end codes are. */
function familyOf({ frames }: Profile): EndCodeFamily {
  if (frames.every((frame) => frame === '1C')) return '1C'
  return frames.every((frame) => frame === '1E') ? '1E' : 'slmp'
}

/** Everything inside a value, itself included. */
function* parts(value: unknown): Generator<unknown> {
  yield value
  if (typeof value === 'object' && value !== null) for (const inner of Object.values(value)) yield* parts(inner)
}

describe('every profile', () => {
  test.each(all)('$id is plain data: no functions, every text filled in', (profile) => {
    for (const part of parts(profile)) {
      expect(typeof part).not.toBe('function')
      expect(part).not.toBe('')
      expect(part).not.toBeUndefined()
    }
    expect(structuredClone(profile)).toEqual(profile)
  })

  test.each(all)('$id names only commands and devices that exist', (profile) => {
    const commandsNamed = [
      ...profile.lacks.map(({ command }) => command),
      ...profile.doubtful.map(({ command }) => command),
      ...profile.exclusions.flatMap((exclusion) => exclusion.commands),
      ...profile.limits.flatMap((rule) => rule.commands),
      ...Object.keys(profile.subcommands),
    ]
    for (const name of commandsNamed) expect(commandNames).toContain(name)
    const devicesNamed = [
      ...profile.absentDevices,
      ...profile.shortDevices,
      ...profile.exclusions.flatMap((exclusion) => exclusion.devices),
      ...Object.keys(profile.ranges.points),
    ]
    for (const name of devicesNamed) expect(deviceNames).toContain(name)
  })

  test.each(all)('$id: defaults are among what it has', (profile) => {
    expect(profile.frames).toContain(profile.frame)
    expect(profile.codes).toContain(profile.code)
    expect(profile.code).toBe(profile.serial === undefined ? 'binary' : 'ascii')
    expect(profile.forms).toContain(profile.form)
    expect(profile.transports).toEqual(profile.serial === undefined ? ['tcp', 'udp'] : ['serial', 'tcp'])
    expect(profile.id).toBe(profileIds.find((id) => profiles[id] === profile))
  })

  test.each(all)('$id: every figure says where it comes from', (profile) => {
    const sourced = [
      ...profile.lacks,
      ...profile.doubtful,
      ...profile.exclusions,
      ...profile.limits,
      profile.ranges,
      profile.refusals,
      profile.password,
      profile.inFlight,
      profile.connections,
      profile.reach,
      profile.lastIndex,
      profile.monitoringTimer,
      profile.remote,
      ...Object.values(profile.subcommands),
      ...(profile.aCompatible === undefined ? [] : [profile.aCompatible]),
    ]
    for (const { source } of sourced) expect(source.length).toBeGreaterThan(3)
    expect(Object.keys(profile.sources).sort()).toEqual([
      'absentDevices',
      'asciiXy',
      'extensions',
      'forms',
      'frames',
      'wRadix',
      'xyRadix',
    ])
  })

  test.each(all)(
    '$id: every command with points has limits in each of its forms and both codes, unless it lacks the command',
    (profile) => {
      for (const name of Object.keys(pointFields) as (keyof typeof pointFields)[]) {
        for (const form of profile.forms) {
          for (const code of profile.codes) {
            if (lackOf(profile, name) !== undefined) continue
            expect([name, form, code, limitsOf(profile, name, form, code).length]).not.toEqual([name, form, code, 0])
          }
        }
      }
    },
  )

  test.each(all)('$id: every refusal has an end code with a text', (profile) => {
    const endCodes = [
      ...Object.values({ ...profile.refusals, ...profile.password }).filter((value) => typeof value === 'number'),
      ...[...profile.lacks, ...profile.doubtful, ...profile.exclusions, ...profile.limits].map(
        ({ endCode }) => endCode,
      ),
    ]
    for (const endCode of endCodes) {
      // Of remote passwords 1E knows nothing.
      const family = endCode > 0xff ? 'slmp' : familyOf(profile)
      const found = explainEndCode(endCode, { family })
      expect([endCode.toString(16), found?.exact]).toEqual([endCode.toString(16), true])
    }
  })

  test.each(all)(
    '$id: a request that is too large is refused with a code that is known to be about that',
    (profile) => {
      // One code stands for all that is wrong with a password.
      const limits = profile.limits.filter(
        ({ commands: names }) => !names.includes('unlock') && !names.includes('lock'),
      )
      const about = limits.map(({ endCode }) => [
        endCode.toString(16),
        explainEndCode(endCode, { family: familyOf(profile) })?.about,
      ])
      expect(about.filter(([, told]) => told !== 'size' && told !== 'item')).toEqual([])
    },
  )

  test.each(all)('$id: an absent device has no range; the ranges of one timer or counter are equal', (profile) => {
    const { points } = profile.ranges
    for (const name of profile.absentDevices) expect(points).not.toHaveProperty(name)
    for (const [name, count] of Object.entries(points)) {
      expect(count).toBeGreaterThan(0)
      const group = findDevice(name)?.group
      if (group === undefined) continue
      const present = devices.filter((info) => info.group === group && !profile.absentDevices.includes(info.name))
      for (const other of present) expect(points[other.name]).toBe(count)
    }
  })

  test.each(all)('$id: every device is addressable in one of its forms', (profile) => {
    for (const { name, longOnly } of devices) {
      if (profile.absentDevices.includes(name)) continue
      const needsLong = longOnly === true && !profile.shortDevices.includes(name)
      if (needsLong)
        expect([name, profile.forms.some((form) => form === 'long' || form === 'extendedLong')]).toEqual([name, true])
    }
  })

  test.each(all)(
    '$id: facts of 1E and 1C where it has one of the frames; its usual model is in the list of models, or has a name',
    (profile) => {
      expect(profile.aCompatible !== undefined).toBe(profile.frames.includes('1E') || profile.frames.includes('1C'))
      const { code, name } = profile.model
      expect(modelOf(code) === undefined).toBe(name !== undefined)
    },
  )

  test.each(all)('$id: a simulated PLC has X, M, D and T, whatever is known of the ranges', ({ ranges }) => {
    const points = { ...ranges.simulated, ...ranges.points }
    for (const name of ['X', 'M', 'D', 'TN'] as const) expect(points[name]).toBeGreaterThan(0)
    expect(ranges.simulated === undefined).toBe(Object.keys(ranges.points).length > 0)
  })

  test.each(all)('$id: the monitoring timer default can be sent: a multiple of 250 ms', (profile) => {
    const { default: ms, zeroOnly } = profile.monitoringTimer
    expect(ms % 250).toBe(0)
    if (zeroOnly) expect(ms).toBe(0)
  })
})

describe('what the families are like', () => {
  test.each([
    ['iq-r', 16, '4E', ['4E', '3E', 'ext'], 'long', ['short', 'long', 'extendedShort', 'extendedLong']],
    ['iq-f', 8, '3E', ['3E', '1E'], 'short', ['short', 'extendedShort', 'extendedLong']],
    ['fx5-enet', 8, '3E', ['3E', '1E'], 'short', ['short', 'extendedShort', 'extendedLong']],
    ['q', 16, '3E', ['3E', '4E'], 'short', ['short', 'extendedShort']],
    ['q-built-in', 16, '3E', ['3E', '4E'], 'short', ['short', 'extendedShort']],
    ['q-e71', 16, '3E', ['3E', '4E'], 'short', ['short', 'extendedShort']],
    ['remote-head', 16, '4E', ['4E', '3E'], 'long', ['short', 'long', 'extendedShort', 'extendedLong']],
    ['nz2gf-etb', 16, '3E', ['3E', '4E'], 'short', ['short', 'extendedShort']],
    ['l', 16, '3E', ['3E', '4E'], 'short', ['short', 'extendedShort']],
    ['fx3', 8, '1E', ['1E'], 'short', ['short', 'long']],
    ['generic', 16, '3E', ['4E', '3E', 'ext'], 'short', ['short', 'long', 'extendedShort', 'extendedLong']],
  ] as const)('%s: X and Y in radix %i, frame %s of %j, %s of %j', (id, xyRadix, frame, frames, form, forms) => {
    expect(profiles[id]).toMatchObject({ xyRadix, frame, frames, form, forms })
  })

  test('iQ-F lacks the monitor, and says what to use instead', () => {
    for (const command of ['entryMonitorDevice', 'executeMonitor'] as const) {
      expect(lackOf(profiles['iq-f'], command)).toMatchObject({
        endCode: 0xc059,
        instead: expect.stringContaining('readRandom'),
      })
      expect(lackOf(profiles['iq-r'], command)).toBeUndefined()
    }
  })

  test('Q and L: block access and type name are doubtful, not lacking: Ethernet modules have them', () => {
    for (const id of ['q', 'l'] as const) {
      for (const command of ['readBlock', 'writeBlock', 'readTypeName'] as const) {
        expect(lackOf(profiles[id], command)).toBeUndefined()
        expect(doubtOf(profiles[id], command)?.endCode).toBe(0xc059)
      }
    }
    expect(doubtOf(profiles['iq-r'], 'readBlock')).toBeUndefined()
  })

  test.each([
    ['readWords', 'LCN', true],
    ['writeWords', 'LZ', true],
    ['readBlock', 'LZ', true],
    ['readRandom', 'LCN', false],
    ['readRandom', 'TS', true],
    ['readRandom', 'LCC', true],
    ['readRandom', 'TN', false],
    ['readBits', 'TS', false],
    ['writeRandomBits', 'CS', true],
    ['writeRandomWords', 'STC', true],
    ['writeRandomBits', 'LCS', false],
    ['writeBits', 'CS', false],
  ] as const)('iQ-F: %s of %s is excluded: %s', (command, device, excluded) => {
    expect(exclusionOf(profiles['iq-f'], command, device) !== undefined).toBe(excluded)
  })

  test('iQ-R: step relays are read-only', () => {
    expect(exclusionOf(profiles['iq-r'], 'writeBits', 'S')?.endCode).toBe(0x4030)
    expect(exclusionOf(profiles['iq-r'], 'readBits', 'S')).toBeUndefined()
  })

  test.each([
    ['iq-r', 'udp', '4E', 1, 33],
    ['iq-r', 'udp', '4E', 4, 9],
    ['iq-r', 'udp', '4E', 5, 7],
    ['iq-r', 'tcp', '4E', 1, 1],
    ['iq-r', 'udp', '3E', 1, 1],
    ['iq-r', 'udp', 'ext', 1, 1],
    ['q', 'udp', '4E', 1, 58],
    ['q', 'udp', '4E', 10, 6],
    ['iq-f', 'udp', '3E', 1, 1],
    ['q-e71', 'udp', '4E', 4, 15],
    ['q-built-in', 'udp', '4E', 1, 577],
    ['q-built-in', 'udp', '4E', 7, 83],
    ['q-built-in', 'tcp', '4E', 1, 1],
    ['l', 'udp', '4E', 3, 20],
    ['nz2gf-etb', 'udp', '4E', 1, 51],
    ['nz2gf-etb', 'udp', '4E', 8, 7],
    ['fx5-enet', 'udp', '3E', 1, 1],
    ['generic', 'udp', '4E', 1, 1],
  ] as const)(
    '%s over %s with %s and %i connections: at most %i requests in flight',
    (id, transport, frame, connections, bound) => {
      expect(inFlightBound(profiles[id], transport, frame, connections)).toBe(bound)
    },
  )

  test('the bound needs at least one connection', () => {
    for (const connections of [0, -1, 1.5, Number.NaN]) {
      expect(caught(() => inFlightBound(profiles['iq-r'], 'udp', '4E', connections)).code).toBe('BAD_OPTION')
    }
  })

  test('iQ-F takes no monitoring timer but 0, Remote RUN without clearing, and Clear Error with subcommand 0000', () => {
    expect(profiles['iq-f'].monitoringTimer).toMatchObject({ default: 0, zeroOnly: true })
    expect(profiles['iq-f'].remote.clearModes).toEqual([0])
    expect(profiles['iq-f'].subcommands.clearError?.value).toBe(0)
  })

  test('FX5 Ethernet module: what its table and appendix print otherwise than those of the CPU module', () => {
    const module = profiles['fx5-enet']
    const lacks = (id: ProfileId) => profiles[id].lacks.map(({ command }) => command)
    const more = lacks('fx5-enet').filter((name) => !lacks('iq-f').includes(name))
    expect(more.sort()).toEqual(['clearError', 'lock', 'unlock'])
    expect(lacks('iq-f').filter((name) => !lacks('fx5-enet').includes(name))).toEqual([])
    expect([module.lastIndex.Z, module.lastIndex.LZ]).toEqual([24, 12])
    expect([profiles['iq-f'].lastIndex.Z, profiles['iq-f'].lastIndex.LZ]).toEqual([23, 11])
    expect(module.monitoringTimer).toMatchObject({ zeroOnly: false, recommended: { from: 250, to: 10_000 } })
    expect([module.connections.most, profiles['iq-f'].connections.most]).toEqual([32, 8])
    expect(module.refusals).toMatchObject({ length: 0xc057, deviceName: 0xc05b, deviceNumber: 0xc056 })
    expect(exclusionOf(module, 'readRandom', 'LCS')).toBeDefined()
  })

  test('Q by its ports: built-in ones lack what was measured, Ethernet modules have it', () => {
    for (const command of ['readBlock', 'writeBlock', 'readTypeName'] as const) {
      expect(lackOf(profiles['q-built-in'], command)?.endCode).toBe(0xc059)
      expect([lackOf(profiles['q-e71'], command), doubtOf(profiles['q-e71'], command)]).toEqual([undefined, undefined])
    }
    for (const command of ['remoteRun', 'selfTest', 'readMemory'] as const) {
      expect([lackOf(profiles['q-built-in'], command), doubtOf(profiles['q-e71'], command)]).toEqual([
        undefined,
        undefined,
      ])
      expect(doubtOf(profiles['q-built-in'], command)).toBeDefined()
    }
    for (const command of ['unlock', 'lock', 'entryMonitorDevice', 'executeMonitor'] as const) {
      expect(doubtOf(profiles['q-built-in'], command)).toBeUndefined()
    }
    expect(profiles['q-built-in'].extensions).toEqual(['link'])
  })

  test('head module and Ethernet adapter: nothing is lacking that the damaged table leaves open', () => {
    expect(profiles['remote-head'].lacks).toEqual([])
    for (const command of ['readRandomLabels', 'remotePause', 'remoteLatchClear', 'unlock'] as const) {
      expect(doubtOf(profiles['remote-head'], command)?.source).toContain('damaged')
    }
    const adapter = profiles['nz2gf-etb']
    expect(adapter.lacks.map(({ command }) => command).sort()).toEqual(
      [...labelCommandNames, ...fileCommandNames].sort(),
    )
    for (const command of ['remotePause', 'remoteLatchClear', 'writeExtendUnit', 'lock'] as const) {
      expect(doubtOf(adapter, command)?.source).toContain('damaged')
    }
    expect([doubtOf(adapter, 'clearError'), lackOf(adapter, 'clearError')]).toEqual([undefined, undefined])
  })

  test.each(all)('$id: its buffer is the lowest of its ports, and its CPU has a profile of itself', (profile) => {
    const { ports, udpBuffer } = profile.inFlight
    if (ports.length > 0) expect(udpBuffer).toBe(Math.min(...ports.map(({ buffer }) => buffer)))
    expect(profiles[profile.cpu].cpu).toBe(profile.cpu)
    expect(profile.reach.ownModuleIo[0]).toBe(0x3ff)
  })

  test('device ranges as the CPUs answer them', () => {
    expect(profiles['iq-f'].ranges.points).toMatchObject({ X: 1024, D: 8000, STN: 16, LCN: 64, Z: 20, LZ: 2, R: 32768 })
    expect(profiles['iq-r'].ranges.points).toMatchObject({ X: 12288, M: 12288, D: 18432, Z: 20, LZ: 2 })
    expect(profiles.q.ranges.points).toMatchObject({ X: 8192, D: 12288, Z: 20, ZR: 393216 })
    expect(profiles.l.ranges.points).toMatchObject({ D: 12288, ZR: 131072 })
  })
})

describe('resolveProfile', () => {
  test('gives the profile of an id, or the one given', () => {
    for (const id of profileIds) expect(resolveProfile(id)).toBe(profiles[id])
    expect(resolveProfile(profiles.q)).toBe(profiles.q)
  })

  test('an unknown id is refused with the list of ids, also one that every object has', () => {
    for (const id of ['iq-x', 'IQ-R', 'toString', '']) {
      const error = caught(() => resolveProfile(id as ProfileId))
      expect(error).toMatchObject({ code: 'BAD_OPTION', field: 'profile' })
      expect(error.message).toContain(profileIds.join(', '))
    }
  })

  test('overrides are merged field by field and leave the profile as it was', () => {
    const before = structuredClone(profiles['iq-f'])
    const profile = resolveProfile('iq-f', {
      xyRadix: 16,
      wRadix: 10,
      ranges: { D: 16000, ZR: 100 },
      subcommands: { clearError: 1 },
      inFlight: { udpBuffer: 8 },
      lacks: { executeMonitor: false, readBlock: 'firmware 1.0' },
    })
    expect([profile.xyRadix, profile.wRadix]).toEqual([16, 10])
    expect(profile.ranges.points).toMatchObject({ D: 16000, ZR: 100, M: 7680 })
    expect(profile.subcommands.clearError).toEqual({ value: 1, source: 'set by the user' })
    expect(profile.inFlight).toMatchObject({ tcp: 1, udpBuffer: 8 })
    expect(lackOf(profile, 'executeMonitor')).toBeUndefined()
    expect(lackOf(profile, 'entryMonitorDevice')).toBeDefined()
    expect(lackOf(profile, 'readBlock')).toMatchObject({
      reason: 'firmware 1.0',
      endCode: 0xc059,
      source: 'set by the user',
    })
    expect(profile.frame).toBe('3E')
    expect(profiles['iq-f']).toEqual(before)
  })

  test('a doubtful command becomes lacking or certain', () => {
    const builtIn = resolveProfile('q', { lacks: { readBlock: true, writeBlock: true, readTypeName: true } })
    expect(lackOf(builtIn, 'readBlock')).toMatchObject({
      reason: 'Built-in Ethernet ports do not have it.',
      endCode: 0xc059,
    })
    expect(doubtOf(builtIn, 'readBlock')).toBeUndefined()
    const module = resolveProfile('q', { lacks: { readBlock: false } })
    expect(doubtOf(module, 'readBlock')).toBeUndefined()
    expect(doubtOf(module, 'writeBlock')).toBeDefined()
  })

  test('a frame the family has may be chosen, another is refused', () => {
    expect(resolveProfile('iq-r', { frame: '3E' }).frame).toBe('3E')
    const error = caught(() => resolveProfile('iq-f', { frame: '4E' }))
    expect(error).toMatchObject({ code: 'BAD_OPTION', field: 'profile.frame' })
    expect(error.message).toBe('MELSEC iQ-F has no 4E frame. Use 3E or 1E.')
  })

  test.each<[string, Parameters<typeof resolveProfile>[1]]>([
    ['profile.xyRadix', { xyRadix: 10 as 8 }],
    ['profile.wRadix', { wRadix: 8 as 10 }],
    ['profile.limits.remoteStop', { limits: { remoteStop: 1 } }],
    ['profile.limits.readBlock', { limits: { readBlock: 100 } }],
    ['profile.limits.readWords.blocks', { limits: { readWords: { blocks: 1 } } }],
    ['profile.limits.readWords.points', { limits: { readWords: 0 } }],
    ['profile.limits.readWords.points', { limits: { readWords: 1.5 } }],
    ['profile.ranges.D', { ranges: { D: -1 } }],
    ['profile.ranges.Q', { ranges: JSON.parse('{"Q": 1}') }],
    ['profile.lacks.fly', { lacks: JSON.parse('{"fly": true}') }],
    ['profile.subcommands.clearError', { subcommands: { clearError: 0x10000 } }],
    ['profile.subcommands.fly', { subcommands: JSON.parse('{"fly": 1}') }],
    ['profile.limits.fly', { limits: JSON.parse('{"fly": 1}') }],
    ['profile.colour', JSON.parse('{"colour": 1}')],
    ['profile.inFlight.tcp', { inFlight: { tcp: 0 } }],
    ['profile.inFlight.udpBuffer', { inFlight: { udpBuffer: Number.NaN } }],
  ])('%s that cannot be is refused', (field, overrides) => {
    expect(caught(() => resolveProfile('iq-r', overrides))).toMatchObject({
      code: 'BAD_OPTION',
      outcome: 'notSent',
      field,
    })
  })

  test('the reason of several limits names the units to choose from', () => {
    const error = caught(() => resolveProfile('iq-r', { limits: { readBlock: 100 } }))
    expect(error.message).toContain('{ points: 100, blocks: 100 }')
  })

  test('an override of an override keeps both', () => {
    const once: Profile = resolveProfile('q', { limits: { readWords: 480 } })
    const twice = resolveProfile(once, { limits: { writeWords: 240 } })
    expect(limitsOf(twice, 'readWords', 'short', 'binary')[0]?.max).toBe(480)
    expect(limitsOf(twice, 'writeWords', 'short', 'binary')[0]?.max).toBe(240)
    expect(limitsOf(once, 'writeWords', 'short', 'binary')[0]?.max).toBe(960)
  })
})
