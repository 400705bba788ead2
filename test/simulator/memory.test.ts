import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { type DeviceName, deviceInfo, devices } from '../../src/melsec/device/device'
import { type Profile, profileIds } from '../../src/melsec/profiles/profile'
import { profiles, resolveProfile } from '../../src/melsec/profiles/profiles'
import { createPlcSimulator } from '../../src/simulator/server'
import { join, rawBody } from './support'

function pointsOf(profile: Profile, device: DeviceName): number {
  return profile.ranges.points[device] ?? 0
}

const known = profileIds.filter(
  (id) => profiles[id].frames.includes('3E') && Object.keys(profiles[id].ranges.points).length > 0,
)

describe.each(known)('ranges of %s', (id) => {
  const profile = profiles[id]
  const present = devices.filter(({ name }) => pointsOf(profile, name) > 0 && !profile.absentDevices.includes(name))

  test.each(present.filter(({ unit }) => unit === 'bit').map(({ name }) => name))('%s in bit units', (device) => {
    const { plc, asker } = join({ profile: id })
    const last = pointsOf(profile, device) - 1
    // Long timers have no bits that Read takes; there the program sees the range.
    if (deviceInfo(device).notIn?.includes('readBits') === true) {
      expect(plc.memory.bit(device, last)).toBe(false)
      expect(() => plc.memory.bit(device, last + 1)).toThrow(RequestError)
      return
    }
    const form =
      deviceInfo(device).longOnly === true ? (profile.forms.includes('long') ? 'long' : 'extendedLong') : 'short'
    const read = (number: number, points: number) =>
      asker.endCode(commands.readBits, { head: { device, number }, points }, { form })
    expect([read(last, 1), read(0, 2)]).toEqual([0, 0])
    expect([read(last, 2), read(last + 1, 1)]).toEqual(Array(2).fill(profile.refusals.deviceNumber))
  })

  test.each(present.filter(({ unit }) => unit === 'word').map(({ name }) => name))('%s in word units', (device) => {
    const { asker } = join({ profile: id })
    const last = pointsOf(profile, device) - 1
    const form = deviceInfo(device).longOnly === true ? 'long' : 'short'
    const write = (number: number, count: number) =>
      asker.endCode(commands.writeWords, { head: { device, number }, values: Array<number>(count).fill(1) }, { form })
    expect(write(last, 1)).toBe(0)
    expect([write(last, 2), write(last + 1, 1)]).toEqual(Array(2).fill(profile.refusals.deviceNumber))
  })

  test('a device the family does not have is refused by its own end code', () => {
    const { asker } = join({ profile: id })
    const absent = profile.absentDevices.filter((name) => deviceInfo(name).extensionOnly !== true)
    for (const device of absent) {
      const { longOnly, unit, notIn } = deviceInfo(device)
      if (notIn !== undefined || unit === 'doubleWord') continue
      const form = longOnly === true ? 'extendedLong' : 'short'
      const endCode = asker.endCode(commands.readWords, { head: { device, number: 0 }, points: 1 }, { form })
      // Q and L have no long form at all: the subcommand is refused first.
      const expected = profile.forms.includes(form) ? profile.refusals.deviceName : profile.refusals.command
      expect([device, endCode]).toEqual([device, expected])
    }
  })
})

describe('device memory', () => {
  test('bit devices in word units: 16 points a word from any head number', () => {
    const { plc, asker } = join()
    asker.ask(commands.writeWords, { head: { device: 'M', number: 5 }, values: [0x8001, 0x0002] })
    const on = Array.from({ length: 48 }, (_, number) => number).filter((number) => plc.memory.bit('M', number))
    expect(on).toEqual([5, 20, 22])
    expect(asker.ask(commands.readWords, { head: { device: 'M', number: 4 }, points: 2 })).toEqual({
      values: [0x0002, 0x0005],
    })
  })

  test('a word of bit devices that goes beyond the range is refused, and nothing is written', () => {
    const { plc, asker } = join({ profile: 'iq-f' })
    const head = { device: 'F', number: 113 } as const
    expect(asker.endCode(commands.writeWords, { head, values: [0xffff] })).toBe(0xc056)
    expect(plc.memory.bit('F', 113)).toBe(false)
  })

  test('LTN reads as four words: value low and high, b0 coil and b1 contact, 0', () => {
    const { plc, asker } = join()
    plc.memory.set('LTN3', 'DINT', 0x12345678)
    plc.memory.setBit('LTC', 3, true)
    plc.memory.setBit('LTS', 4, true)
    const head = { device: 'LTN', number: 3 } as const
    expect(asker.ask(commands.readWords, { head, points: 8 })).toEqual({
      values: [0x5678, 0x1234, 1, 0, 0, 0, 2, 0],
    })
  })

  test('LTN in other than whole timers is refused', () => {
    const { asker } = join()
    const body = rawBody(commands.readWords, 0x0002, 'long', { head: { device: 'LTN', number: 0 }, points: 3 })
    expect(asker.rawEndCode(body)).toBe(0xc051)
  })

  test('the last long timer can be read, one more cannot', () => {
    const { plc, asker } = join()
    const last = pointsOf(resolveProfile(plc.profile), 'LTN') - 1
    const endCode = (points: number) =>
      asker.endCode(commands.readWords, { head: { device: 'LTN', number: last }, points })
    expect([endCode(4), endCode(8)]).toEqual([0, 0x4031])
  })

  test('LCN: two words a counter in Read and Write, 32 bits in Read Random', () => {
    const { plc, asker } = join()
    const head = { device: 'LCN', number: 1 } as const
    expect(asker.ask(commands.writeWords, { head, values: [1, 2, 3, 4] })).toEqual({})
    expect([plc.memory.get('LCN1'), plc.memory.get('LCN2')]).toEqual([0x20001, 0x40003])
    expect(asker.ask(commands.readWords, { head, points: 4 })).toEqual({ values: [1, 2, 3, 4] })
    const random = { words: [], doubleWords: [{ device: head }] }
    expect(asker.ask(commands.readRandom, random)).toEqual({ words: [], doubleWords: [0x20001] })
  })

  test('LZ by Read Random and Write Random, on iQ-R and iQ-F', () => {
    for (const profile of ['iq-r', 'iq-f'] as const) {
      const { asker } = join({ profile })
      const device = { device: 'LZ', number: 1 } as const
      asker.ask(commands.writeRandomWords, { words: [], doubleWords: [{ device, value: 0xfffffffe }] })
      const read = asker.ask(commands.readRandom, { words: [], doubleWords: [{ device }] })
      expect(read).toEqual({ words: [], doubleWords: [0xfffffffe] })
    }
  })

  test('a double word of word devices is low word first, of bit devices 32 points', () => {
    const { plc, asker } = join()
    plc.memory.setWord('W', 0x1f, 1)
    plc.memory.setWord('W', 0x20, 2)
    plc.memory.setBit('B', 31, true)
    const doubleWords = [{ device: { device: 'W', number: 0x1f } }, { device: { device: 'B', number: 0 } }] as const
    expect(asker.ask(commands.readRandom, { words: [], doubleWords })).toEqual({
      words: [],
      doubleWords: [0x20001, 0x80000000],
    })
  })

  test('Write Random writes nothing when one device is not there', () => {
    const { plc, asker } = join()
    const words = [
      { device: { device: 'D', number: 0 }, value: 1 },
      { device: { device: 'D', number: 99999 }, value: 1 },
    ] as const
    expect(asker.endCode(commands.writeRandomWords, { words, doubleWords: [] })).toBe(0x4031)
    expect(plc.memory.word('D', 0)).toBe(0)
  })

  test('Write Block writes nothing when one block is not there', () => {
    const { plc, asker } = join()
    const wordBlocks = [
      { head: { device: 'D', number: 0 }, values: [1] },
      { head: { device: 'D', number: 18431 }, values: [1, 2] },
    ] as const
    expect(asker.endCode(commands.writeBlock, { wordBlocks, bitBlocks: [] })).toBe(0x4031)
    expect(plc.memory.word('D', 0)).toBe(0)
  })

  test('R is the first block of ZR; DX and DY are X and Y', () => {
    const { plc } = join()
    plc.memory.setWord('ZR', 7, 1)
    plc.memory.setBit('DY', 3, true)
    expect([plc.memory.word('R', 7), plc.memory.bit('Y', 3)]).toEqual([1, true])
  })

  test('SD203 tells the state, SM400 is on and SM401 off whatever clients write', () => {
    const { plc, asker } = join()
    const read = () => asker.ask(commands.readWords, { head: { device: 'SD', number: 203 }, points: 1 })?.values[0]
    expect(read()).toBe(0)
    asker.ask(commands.writeBits, { head: { device: 'SM', number: 400 }, values: [false, true] })
    asker.ask(commands.remoteStop, {})
    expect(read()).toBe(0x22)
    plc.cpu.switch = 'STOP'
    expect(read()).toBe(2)
    expect(asker.ask(commands.readBits, { head: { device: 'SM', number: 400 }, points: 2 })?.values).toEqual([
      true,
      false,
    ])
  })
})

describe('memory behind an extension', () => {
  const extensions = {
    modules: [{ unit: 3, points: 16 }],
    networks: [{ network: 1, points: { W: 32, B: 64 } }],
    cpus: [{ cpu: 1, points: { G: 8, HG: 8 } }],
  } as const

  test('buffer memory, link direct devices and CPU buffers are separate from the own devices', () => {
    const { plc, asker } = join({ extensions })
    const heads = [
      { device: 'G', number: 5, extension: { kind: 'module', unit: 3 } },
      { device: 'W', number: 5, extension: { kind: 'link', network: 1 } },
      { device: 'G', number: 5, extension: { kind: 'cpu', cpu: 1 } },
      { device: 'HG', number: 5, extension: { kind: 'cpu', cpu: 1 } },
      { device: 'W', number: 5 },
    ] as const
    for (const [i, head] of heads.entries()) asker.ask(commands.writeWords, { head, values: [i + 1] })
    expect(heads.map((head) => asker.ask(commands.readWords, { head, points: 1 })?.values[0])).toEqual([1, 2, 3, 4, 5])
    expect(plc.memory.get('U3\\G5')).toBe(1)
    expect(plc.memory.get('J1\\W5')).toBe(2)
  })

  test.each([
    ['a module that is not there', 'iq-r', { kind: 'module', unit: 4 }, 0x4043],
    ['a network that is not there', 'iq-r', { kind: 'link', network: 2 }, 0x4043],
    ['link direct on iQ-F', 'iq-f', { kind: 'link', network: 1 }, 0xc060],
  ] as const)('%s is refused', (_, profile, extension, endCode) => {
    const { asker } = join({ profile, extensions })
    const device = extension.kind === 'link' ? 'W' : 'G'
    expect(asker.endCode(commands.readWords, { head: { device, number: 0, extension }, points: 1 })).toBe(endCode)
  })

  test('beyond the buffer memory is refused', () => {
    const { asker } = join({ extensions })
    const head = { device: 'G', number: 15, extension: { kind: 'module', unit: 3 } } as const
    expect(asker.endCode(commands.readWords, { head, points: 2 })).toBe(0x4041)
  })

  test('index registers are added: Z signed, LZ, and to the module number', () => {
    const { plc, asker } = join({ extensions })
    plc.memory.setWord('Z', 2, 0xffff)
    plc.memory.set('LZ1', 'DINT', 10)
    plc.memory.setWord('D', 99, 1)
    plc.memory.setWord('D', 110, 2)
    plc.memory.set('U3\\G7', 'INT', 3)
    const words = [
      { device: { device: 'D', number: 100, index: { register: 'Z', number: 2 } } },
      { device: { device: 'D', number: 100, index: { register: 'LZ', number: 1 } } },
      {
        device: {
          device: 'G',
          number: 7,
          extension: { kind: 'module', unit: 4 },
          extensionIndex: { register: 'Z', number: 2 },
        },
      },
    ] as const
    expect(asker.ask(commands.readRandom, { words, doubleWords: [] })?.words).toEqual([1, 2, 3])
    const below = [{ device: { device: 'D', number: 0, index: { register: 'Z', number: 2 } } }] as const
    expect(asker.endCode(commands.readRandom, { words: below, doubleWords: [] })).toBe(0x4031)
  })
})

describe("the program's side", () => {
  const { memory } = createPlcSimulator({ profile: 'iq-f' })

  test.each([
    ['D0', 'INT', -5],
    ['D0', 'UINT', 65535],
    ['D0', 'REAL', 1.5],
    ['D0', 'LREAL', Math.PI],
    ['D0', 'LINT', -(2n ** 62n)],
    ['D0', 'BCD16', 1234],
    ['D0', 'TIME', 90_000],
    ['D0', 'STRING(10)', 'FX5U'],
    ['D0', 'WSTRING(4)', '烏龍茶'],
    ['M0', 'BOOL', true],
    ['D0.F', 'BOOL', true],
    ['M5', 'INT', -2],
    ['K2M5', 'INT', 0xff],
    ['K8M5', 'DINT', -1],
    ['X17', 'BOOL', true],
    ['LCN0', 'DINT', -1],
    ['LCN0', 'LREAL', 0.1],
  ] as const)('%s as %s comes back as it was set', (address, type, value) => {
    memory.clear()
    memory.set(address, type, value)
    expect(memory.get(address, type)).toBe(value)
    expect(memory.read(`${address}:${type}`)).toBe(value)
  })

  test('X and Y are octal on iQ-F', () => {
    memory.set('Y17', 'BOOL', true)
    expect(memory.bit('Y', 15)).toBe(true)
    expect(() => memory.get('Y18')).toThrow(RequestError)
  })

  test('types when none is given: BOOL of bits, INT of words, DINT of double words', () => {
    memory.clear()
    memory.setWord('D', 1, 0xffff)
    memory.set('LCN3', 'DINT', -1)
    expect([memory.get('M0'), memory.get('D1'), memory.get('D1.0'), memory.get('K4M0'), memory.get('LCN3')]).toEqual([
      false,
      -1,
      true,
      0,
      -1,
    ])
  })

  test('writing one bit or digit leaves the others alone', () => {
    memory.clear()
    memory.setWord('D', 2, 0b1010)
    memory.write('D2.1', false)
    memory.write('D2.0', true)
    memory.setBit('M', 8, true)
    memory.write('K2M0', 0x55)
    expect([memory.word('D', 2), memory.word('M', 0)]).toEqual([0b1001, 0x155])
  })

  test.each([
    ['beyond the range', () => memory.get('D8000')],
    ['half beyond the range', () => memory.set('D7999', 'REAL', 1)],
    ['a device the family lacks', () => memory.get('ZR0')],
    ['a word as BOOL', () => memory.get('D0', 'BOOL')],
    ['a bit of a word as INT', () => memory.get('D0.1', 'INT')],
    ['a double-word device as INT', () => memory.get('LCN0', 'INT')],
    ['digits in another size', () => memory.get('K8M0', 'INT')],
    ['a value too large for the digits', () => memory.set('K1M0', 'INT', 16)],
    ['a number as BOOL', () => memory.set('M0', 'BOOL', 1)],
    ['a value too large', () => memory.setWord('D', 0, 65536)],
    ['a bit of a word device', () => memory.setBit('D', 0, true)],
    ['no address', () => memory.get('Q1')],
  ])('%s is refused', (_, run) => {
    expect(run).toThrow(RequestError)
  })

  test('a refused value changes nothing', () => {
    memory.clear()
    expect(() => memory.set('D7998', 'LREAL', 1)).toThrow(RequestError)
    expect(() => memory.set('LCN63', 'LREAL', 1)).toThrow(RequestError)
    expect([memory.word('D', 7998), memory.word('D', 7999), memory.get('LCN63')]).toEqual([0, 0, 0])
  })
})
