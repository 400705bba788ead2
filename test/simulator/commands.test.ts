import { describe, expect, test } from '@jest/globals'
import { writerOf } from '../../src/codec/codec'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { frameFacts, slmpFrameNames } from '../../src/melsec/frame/frames'
import { modelOf } from '../../src/melsec/model-code'
import { type FrameName, lackOf, type Profile, profileIds } from '../../src/melsec/profiles/profile'
import { profiles, resolveProfile } from '../../src/melsec/profiles/profiles'
import { passwordProblem } from '../../src/melsec/remote-password'
import type { SimulatedLabels } from '../../src/simulator/labels'
import { fileRefusals, fileScenarios } from './file-scenarios'
import { type Joined, join, type SlmpFrame } from './support'

const M100 = { device: 'M', number: 100 } as const
const D10 = { device: 'D', number: 10 } as const
const D20 = { device: 'D', number: 20 } as const

/** Its port reaches no module, so the simulated one has none. */
const hasNoModules = (profile: Profile) => !profile.extensions.includes('module')
const anyPassword = (profile: Profile) => (passwordProblem(profile, 'what') === undefined ? 'what' : 'whatever')

/** What each command must do, seen from the wire and from the program. */
const scenarios: { readonly [N in CommandName]: (joined: Joined) => void } = {
  readBits({ plc, asker }) {
    plc.memory.setBit('M', 100, true)
    plc.memory.setBit('M', 102, true)
    expect(asker.ask(commands.readBits, { head: M100, points: 3 })).toEqual({ values: [true, false, true] })
  },
  readWords({ plc, asker }) {
    plc.memory.setWord('D', 10, 0x1234)
    plc.memory.setWord('D', 11, 0xfedc)
    expect(asker.ask(commands.readWords, { head: D10, points: 3 })).toEqual({ values: [0x1234, 0xfedc, 0] })
  },
  writeBits({ plc, asker }) {
    plc.memory.setBit('M', 101, true)
    plc.memory.setBit('M', 103, true)
    expect(asker.ask(commands.writeBits, { head: M100, values: [true, false, true] })).toEqual({})
    expect([100, 101, 102, 103].map((number) => plc.memory.bit('M', number))).toEqual([true, false, true, true])
  },
  writeWords({ plc, asker }) {
    plc.memory.setWord('D', 12, 7)
    expect(asker.ask(commands.writeWords, { head: D10, values: [1, 0xffff] })).toEqual({})
    expect([10, 11, 12].map((number) => plc.memory.word('D', number))).toEqual([1, 0xffff, 7])
  },
  readRandom({ plc, asker }) {
    plc.memory.setWord('D', 10, 5)
    plc.memory.set('D20', 'DINT', -2)
    plc.memory.setBit('M', 100, true)
    const words = [{ device: D10 }, { device: M100 }]
    expect(asker.ask(commands.readRandom, { words, doubleWords: [{ device: D20 }] })).toEqual({
      words: [5, 1],
      doubleWords: [0xfffffffe],
    })
  },
  writeRandomBits({ plc, asker }) {
    plc.memory.setBit('Y', 16, true)
    const bits = [
      { device: M100, value: true },
      { device: { device: 'Y', number: 16 }, value: false },
    ] as const
    expect(asker.ask(commands.writeRandomBits, { bits })).toEqual({})
    expect([plc.memory.bit('M', 100), plc.memory.bit('Y', 16)]).toEqual([true, false])
  },
  writeRandomWords({ plc, asker }) {
    const words = [{ device: D10, value: 9 }]
    const doubleWords = [{ device: D20, value: 0x89abcdef }]
    expect(asker.ask(commands.writeRandomWords, { words, doubleWords })).toEqual({})
    expect([plc.memory.word('D', 10), plc.memory.get('D20', 'UDINT')]).toEqual([9, 0x89abcdef])
  },
  readBlock({ plc, asker }) {
    plc.memory.setWord('D', 11, 3)
    plc.memory.setBit('M', 117, true)
    const request = { wordBlocks: [{ head: D10, points: 2 }], bitBlocks: [{ head: M100, points: 2 }] }
    expect(asker.ask(commands.readBlock, request)).toEqual({ wordBlocks: [[0, 3]], bitBlocks: [[0, 2]] })
  },
  writeBlock({ plc, asker }) {
    const request = { wordBlocks: [{ head: D10, values: [4, 5] }], bitBlocks: [{ head: M100, values: [0x8001] }] }
    expect(asker.ask(commands.writeBlock, request)).toEqual({})
    expect([plc.memory.word('D', 11), plc.memory.word('M', 100)]).toEqual([5, 0x8001])
  },
  entryMonitorDevice({ asker }) {
    expect(asker.ask(commands.entryMonitorDevice, { words: [{ device: D10 }], doubleWords: [] })).toEqual({})
  },
  executeMonitor({ plc, asker }) {
    const context = { words: [{ device: D10 }], doubleWords: [{ device: D20 }] }
    asker.ask(commands.entryMonitorDevice, context)
    plc.memory.setWord('D', 10, 77)
    plc.memory.set('D20', 'DINT', 88)
    expect(asker.ask(commands.executeMonitor, {}, { context })).toEqual({ words: [77], doubleWords: [88] })
  },
  readTypeName({ plc, asker }) {
    const answer = asker.ask(commands.readTypeName, {})
    expect(answer?.model).toHaveLength(16)
    const model = modelOf(answer?.modelCode ?? 0)
    expect(model?.models).toContain(answer?.model.trimEnd())
    if (plc.profile.id !== 'generic') expect(model?.profile).toBe(plc.profile.cpu)
  },
  remoteRun({ plc, asker }) {
    asker.ask(commands.remoteStop, {})
    expect(asker.ask(commands.remoteRun, { mode: 1 })).toEqual({})
    expect(plc.cpu.state).toBe('RUN')
  },
  remoteStop({ plc, asker }) {
    expect(asker.ask(commands.remoteStop, {})).toEqual({})
    expect(plc.cpu.state).toBe('STOP')
  },
  remotePause({ plc, asker }) {
    expect(asker.ask(commands.remotePause, { mode: 1 })).toEqual({})
    expect(plc.cpu.state).toBe('PAUSE')
  },
  remoteLatchClear({ plc, asker }) {
    plc.memory.setBit('L', 0, true)
    asker.ask(commands.remoteStop, {})
    expect(asker.ask(commands.remoteLatchClear, {})).toEqual({})
    expect(plc.memory.bit('L', 0)).toBe(false)
  },
  remoteReset({ plc, clock, asker }) {
    asker.ask(commands.remoteStop, {})
    expect(asker.ask(commands.remoteReset, {})).toBeUndefined()
    expect([plc.cpu.state, asker.closed]).toEqual(['STOP', true])
    clock.advance(1000)
    expect(plc.cpu.state).toBe('RUN')
  },
  selfTest({ asker }) {
    expect(asker.ask(commands.selfTest, { data: '0123456789ABCDEF' })).toEqual({ data: '0123456789ABCDEF' })
  },
  clearError({ plc, asker }) {
    asker.endCode(commands.readWords, { head: { device: 'D', number: 999999 }, points: 1 })
    expect(plc.errors.led).toBe(true)
    expect(asker.ask(commands.clearError, {})).toEqual({})
    expect([plc.errors.led, plc.errors.entries]).toEqual([false, []])
  },
  readArrayLabels({ asker }) {
    const asked = {
      abbreviations: [{ name: 'Line' }],
      arrays: [
        { name: '%1.Bits[2]', unit: 0, length: 2 },
        { name: '%1.Table[1,0]', unit: 1, length: 4 },
      ],
    }
    expect(asker.ask(commands.readArrayLabels, asked)).toEqual({
      arrays: [
        { typeId: 1, area: { unit: 0, length: 2, words: [2] } },
        { typeId: 4, area: { unit: 1, length: 4, words: [0xffff, 4] } },
      ],
    })
  },
  writeArrayLabels({ plc, asker }) {
    const area = { unit: 1, length: 4, words: [7, 8] } as const
    const bits = { unit: 0, length: 3, words: [5] } as const
    const arrays = [
      { name: 'Line.Table[0,1]', area },
      { name: 'Line.Bits[0]', area: bits },
    ]
    expect(asker.ask(commands.writeArrayLabels, { abbreviations: [], arrays })).toEqual({})
    expect(['[0,0]', '[0,1]', '[1,0]'].map((at) => plc.labels.get(`Line.Table${at}`))).toEqual([1, 7, 8])
    expect([0, 1, 2, 3].map((at) => plc.labels.get(`Line.Bits[${at}]`))).toEqual([true, false, true, true])
  },
  readRandomLabels({ asker }) {
    const names = ['Line.Speed', 'Line.Table[1,1]', 'Line.Text', 'Start.N']
    const asked = { abbreviations: [], labels: names.map((name) => ({ name })) }
    expect(asker.ask(commands.readRandomLabels, asked)).toEqual({
      labels: [
        { typeId: 6, spare: 0, data: [0, 0x3fc0] },
        { typeId: 4, spare: 0, data: [4] },
        { typeId: 9, spare: 0, data: [0x4241, 0, 0] },
        { typeId: 3, spare: 0, data: [0, 0] },
      ],
    })
  },
  writeRandomLabels({ plc, asker }) {
    const labels = [
      { name: 'Line.Speed', data: [0, 0x4000] },
      { name: 'Start.S', data: [1] },
    ]
    expect(asker.ask(commands.writeRandomLabels, { abbreviations: [], labels })).toEqual({})
    expect([plc.labels.get('Line.Speed'), plc.labels.get('Start.S')]).toEqual([2, true])
  },
  unlock({ plc, asker }) {
    // A port without a password is never locked, and nobody looks at the one that is sent.
    expect(asker.ask(commands.unlock, { password: anyPassword(resolveProfile(plc.profile)) })).toEqual({})
  },
  lock({ plc, asker }) {
    expect(asker.ask(commands.lock, { password: anyPassword(resolveProfile(plc.profile)) })).toEqual({})
    expect(asker.endCode(commands.readWords, { head: D10, points: 1 })).toBe(0)
  },
  readMemory({ asker }) {
    asker.ask(commands.writeMemory, { address: 8, values: [1, 0xfedc] })
    expect(asker.ask(commands.readMemory, { address: 8, points: 3 })).toEqual({ values: [1, 0xfedc, 0] })
    expect(asker.endCode(commands.readMemory, { address: 15, points: 2 })).not.toBe(0)
  },
  writeMemory({ asker }) {
    expect(asker.ask(commands.writeMemory, { address: 14, values: [3, 4] })).toEqual({})
    expect(asker.endCode(commands.writeMemory, { address: 15, values: [3, 4] })).not.toBe(0)
    expect(asker.ask(commands.readMemory, { address: 14, points: 2 })).toEqual({ values: [3, 4] })
  },
  readExtendUnit({ plc, asker }) {
    if (hasNoModules(resolveProfile(plc.profile))) {
      expect(asker.endCode(commands.readExtendUnit, { address: 0x100a, byteCount: 4, moduleNumber: 3 })).not.toBe(0)
      return
    }
    const head = { device: 'G', number: 1, extension: { kind: 'module', unit: 3 } } as const
    asker.ask(commands.writeWords, { head, values: [0x1234, 0xfedc] })
    const asked = { address: 0x100a, byteCount: 4, moduleNumber: 3 }
    expect(asker.ask(commands.readExtendUnit, asked)).toEqual({ data: Buffer.of(0x34, 0x12, 0xdc, 0xfe) })
    for (const wrong of [{ moduleNumber: 4 }, { address: 0x1006 }, { address: 0x1026 }])
      expect(asker.endCode(commands.readExtendUnit, { ...asked, ...wrong })).not.toBe(0)
    // Half words, which no client of ours sends.
    for (const [address, byteCount] of [
      [0x1009, 4],
      [0x100a, 3],
    ] as const) {
      const writer = writerOf(asker.protocol.code, 0)
      writer.uint(commands.readExtendUnit.code, 2)
      writer.uint(0, 2)
      writer.uint(address, 4)
      writer.uint(byteCount, 2)
      writer.uint(3, 2)
      expect(asker.rawEndCode(writer.take())).toBe(0xc05c)
    }
  },
  writeExtendUnit({ plc, asker }) {
    const written = { address: 0x100a, moduleNumber: 3, data: Buffer.of(0x34, 0x12) }
    if (hasNoModules(resolveProfile(plc.profile))) {
      expect(asker.endCode(commands.writeExtendUnit, written)).not.toBe(0)
      return
    }
    expect(asker.ask(commands.writeExtendUnit, written)).toEqual({})
    const head = { device: 'G', number: 1, extension: { kind: 'module', unit: 3 } } as const
    expect(asker.ask(commands.readWords, { head, points: 2 })).toEqual({ values: [0x1234, 0] })
  },
  ...fileScenarios,
}

const labels: SimulatedLabels = {
  'Line.Speed': { type: 'REAL', value: 1.5 },
  'Line.Text': { type: 'STRING(4)', value: 'AB' },
  'Line.Bits': { type: 'BOOL', dimensions: [4], value: [false, false, false, true] },
  'Line.Table': { type: 'INT', dimensions: [2, 2], value: [1, 2, -1, 4] },
  Start: { type: 'LONG TIMER' },
}

const names = Object.keys(commands).filter((name): name is CommandName => name in commands)

interface Variant {
  readonly profile: Profile
  readonly frame: SlmpFrame
  readonly code: 'binary' | 'ascii'
}
function isSlmp(frame: FrameName): frame is SlmpFrame {
  return slmpFrameNames.some((name) => name === frame)
}

const variants: Variant[] = profileIds.flatMap((id) =>
  // 1E has commands of its own (a-compatible.test.ts), and serial frames are on lines.
  profiles[id].frames
    .filter(isSlmp)
    .flatMap((frame) => frameFacts[frame].codes.map((code) => ({ profile: profiles[id], frame, code }))),
)

describe.each(variants)('$profile.id $frame $code', ({ profile, frame, code }) => {
  const joined = () =>
    join(
      {
        profile,
        code,
        resetAllowed: true,
        bufferMemory: 16,
        extensions: { modules: [{ unit: 3, points: 16, model: 'Q62DA' }] },
        labels,
      },
      { frame },
    )
  const lacking = names.filter((name) => lackOf(profile, name) !== undefined)

  test.each(names.filter((name) => !lacking.includes(name)))('%s', (name) => {
    scenarios[name](joined())
  })

  if (lacking.length > 0) {
    test.each(lacking)('%s is refused: this family lacks it', (name) => {
      const { asker } = joined()
      const context = { words: [{ device: D10 }], doubleWords: [] }
      const ask: Readonly<Partial<Record<CommandName, () => number | undefined>>> = {
        entryMonitorDevice: () => asker.endCode(commands.entryMonitorDevice, context),
        executeMonitor: () => asker.endCode(commands.executeMonitor, {}, { context }),
        readArrayLabels: () =>
          asker.endCode(commands.readArrayLabels, { abbreviations: [], arrays: [{ name: 'A', unit: 1, length: 2 }] }),
        writeArrayLabels: () =>
          asker.endCode(commands.writeArrayLabels, {
            abbreviations: [],
            arrays: [{ name: 'A', area: { unit: 1, length: 2, words: [0] } }],
          }),
        readRandomLabels: () =>
          asker.endCode(commands.readRandomLabels, { abbreviations: [], labels: [{ name: 'A' }] }),
        writeRandomLabels: () =>
          asker.endCode(commands.writeRandomLabels, { abbreviations: [], labels: [{ name: 'A', data: [0] }] }),
        readMemory: () => asker.endCode(commands.readMemory, { address: 0, points: 1 }),
        writeMemory: () => asker.endCode(commands.writeMemory, { address: 0, values: [0] }),
        readExtendUnit: () => asker.endCode(commands.readExtendUnit, { address: 0, byteCount: 2, moduleNumber: 0 }),
        ...fileRefusals(asker),
        writeExtendUnit: () =>
          asker.endCode(commands.writeExtendUnit, { address: 0, moduleNumber: 0, data: Buffer.of(0, 0) }),
        readTypeName: () => asker.endCode(commands.readTypeName, {}),
        readBlock: () => asker.endCode(commands.readBlock, { wordBlocks: [{ head: D10, points: 1 }], bitBlocks: [] }),
        writeBlock: () =>
          asker.endCode(commands.writeBlock, { wordBlocks: [{ head: D10, values: [1] }], bitBlocks: [] }),
        clearError: () => asker.endCode(commands.clearError, {}),
        unlock: () => asker.endCode(commands.unlock, { password: anyPassword(profile) }),
        lock: () => asker.endCode(commands.lock, { password: anyPassword(profile) }),
      }
      const endCode = ask[name]?.()
      expect(endCode).toBe(lackOf(profile, name)?.endCode)
    })
  }
})

describe('both frames on one connection', () => {
  test('each request is answered in its own frame', () => {
    const { plc } = join()
    const chunks: string[] = []
    const transport = plc.connect({ delivery: 'synchronous' })()
    transport.open({ opened: () => {}, received: (bytes) => void chunks.push(bytes.toString('hex')), closed: () => {} })
    plc.memory.setWord('D', 0, 0x1234)
    const body = '0c00100001040000000000a80100'
    const ask3e = Buffer.from(`500000ffff0300${body}`, 'hex')
    const ask4e = Buffer.from(`54003412000000ffff0300${body}`, 'hex')
    for (const bytes of [ask3e, ask4e, ask4e, ask3e]) transport.send(bytes)
    const answer3e = 'd00000ffff0300040000003412'
    const answer4e = 'd4003412000000ffff0300040000003412'
    expect(chunks).toEqual([answer3e, answer4e, answer4e, answer3e])
  })
})
