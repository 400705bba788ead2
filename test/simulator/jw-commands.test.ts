import { describe, expect, test } from '@jest/globals'
import { jwCommands as commands, type JwCommandName, type JwCommands } from '../../src/jw/commands/commands'
import { type JwJoined, joinJw } from './jw-support'

const R09012 = { file: 0, address: 0o4012 } as const
const RELAY_04033 = { file: 0, address: 0o403 } as const
const extended = (address: number, file: 0 | 1 = 0) => ({ file, address, extended: true }) as const
const hello = Buffer.from('hello')

const parts = {
  timers: {
    TMR0000: { preset: 1234, flag: true },
    CNT0001: { direction: 'up', coding: 'binary', preset: 500 },
    MD0002: {},
  },
  specifiedBuffers: { 0: { file: 1, address: 0o20000, length: 256 } },
  ringBuffers: { 0: { file: 1, address: 0o40000, length: 8, direction: 'write' } },
  optionUnits: [{ rack: 0, unit: 2, kind: 'dl1' }],
} as const

/** What each command does, seen from the wire and from the program. */
const scenarios: { readonly [N in JwCommandName]: (joined: JwJoined) => void } = {
  readOptionParameters({ asker }) {
    const all = { rack: 0, unit: 2, address: 0o3776, length: 2 }
    expect(asker.ask(commands.readOptionParameters, all)).toEqual({ data: Buffer.of(0, 0) })
  },
  readSpecialIoParameters({ asker }) {
    asker.ask(commands.writeSpecialIoParameters, { rack: 1, unit: 3, address: 0x10, data: hello })
    const asked = { rack: 1, unit: 3, address: 0x11, length: 2 }
    expect(asker.ask(commands.readSpecialIoParameters, asked)?.data).toEqual(Buffer.from('el'))
  },
  writeOptionParameters({ plc, asker }) {
    const write = (address: number, data: Buffer) =>
      asker.code(commands.writeOptionParameters, { rack: 0, unit: 2, address, data })
    expect(write(0o100, Buffer.alloc(16, 4))).toBe(0)
    expect(write(0o3777, Buffer.of(1))).toBe(0)
    expect(plc.optionUnit(0, 2)).toMatchObject({ started: true, error: undefined })
    expect(plc.optionUnit(0, 2).parameters[0o3776]).toBe(64)
    expect(write(0o100, Buffer.of(5))).toBe(0x07)
    expect(write(0o3777, Buffer.of(0))).toBe(0)
    expect(write(0o100, Buffer.of(64))).toBe(0)
    expect(write(0o3777, Buffer.of(1))).toBe(0)
    expect(plc.optionUnit(0, 2)).toMatchObject({ started: false, error: 0x70 })
    expect(plc.optionUnit(0, 3)).toMatchObject({ started: false, error: undefined, problems: [] })
  },
  writeSpecialIoParameters({ asker }) {
    const write = { rack: 0, unit: 3, address: 0, data: Buffer.of(0xaa, 0x55) }
    expect(asker.code(commands.writeSpecialIoParameters, write)).toBe(0)
    const read = { rack: 0, unit: 3, address: 0, length: 3 }
    expect(asker.ask(commands.readSpecialIoParameters, read)?.data).toEqual(Buffer.of(0xaa, 0x55, 0))
  },
  monitorRelay({ plc, asker }) {
    plc.write('004033', true)
    expect(asker.ask(commands.monitorRelay, { address: RELAY_04033, bit: 3 })?.value).toBe(1)
    expect(asker.ask(commands.monitorRelay, { address: extended(0o403), bit: 2 })?.value).toBe(0)
  },
  monitorRelays({ plc, asker }) {
    plc.write('004033', true)
    plc.write('F1:00200000.7', true)
    const items = [
      { address: extended(0o403), bit: 3 },
      { address: extended(0o403), bit: 4 },
      { address: extended(0o200000, 1), bit: 7 },
    ]
    expect(asker.ask(commands.monitorRelays, { items })?.values).toEqual([1, 0, 1])
  },
  monitorTimersCounters({ plc, asker }) {
    plc.write('CNT0001', 300)
    expect(asker.ask(commands.monitorTimersCounters, { number: 0, points: 4 })).toMatchObject({
      words: [0x9234, 300, 0, 0],
      attributes: Buffer.of(0x08, 0x0f, 0x01, 0x00),
    })
    expect(asker.code(commands.monitorTimersCounters, { number: 0xffff, points: 2 })).toBe(0x08)
  },
  readDataMemory({ plc, asker }) {
    plc.write('09012:UDINT', 0x12345678)
    const data = Buffer.of(0x78, 0x56, 0x34, 0x12)
    expect(asker.ask(commands.readDataMemory, { head: R09012, length: 4 })?.data).toEqual(data)
    expect(asker.ask(commands.readDataMemory, { head: extended(0o4012), length: 4 })?.data).toEqual(data)
  },
  monitorRegisters({ plc, asker }) {
    plc.write('09012', 5)
    plc.write('F1:37777777', 7)
    const items = [{ address: extended(0o4012) }, { address: extended(0o37777777, 1) }]
    expect(asker.ask(commands.monitorRegisters, { items })?.values).toEqual([5, 7])
  },
  setRelay({ plc, asker }) {
    plc.write('KO0403', 0b0100_0001)
    expect(asker.code(commands.setRelay, { address: RELAY_04033, bit: 3, value: 1 })).toBe(0)
    expect(asker.code(commands.setRelay, { address: RELAY_04033, bit: 6, value: 0 })).toBe(0)
    expect(plc.read('KO0403')).toBe(0b0000_1001)
  },
  setRelays({ plc, asker }) {
    const items = [
      { address: extended(0o403), bit: 0, value: 1 },
      { address: extended(0o404), bit: 7, value: 1 },
    ]
    expect(asker.ask(commands.setRelays, { items })).toBeDefined()
    expect([plc.read('004030'), plc.read('004047'), plc.read('004031')]).toEqual([true, true, false])
  },
  setTimerCounter({ plc, asker }) {
    const set = (number: number, value: number) => asker.code(commands.setTimerCounter, { number, value })
    expect([set(0, 1), plc.read('TMR0000'), plc.read('TMR0000:WORD')]).toEqual([0, 0, 0x8000])
    expect([set(0, 0), plc.read('TMR0000')]).toEqual([0, 1234])
    expect([set(1, 1), plc.read('CNT0001')]).toEqual([0, 500])
    expect([set(2, 1), set(3, 1)]).toEqual([0x04, 0x02])
    plc.cpu.stop()
    expect(set(0, 1)).toBe(0x13)
  },
  writeDataMemory({ plc, asker }) {
    expect(asker.code(commands.writeDataMemory, { head: R09012, data: hello })).toBe(0)
    expect(plc.read('09012:STRING(6)')).toBe('hello')
    const over = { head: extended(0o177776, 1), data: Buffer.of(1, 2, 3, 4) }
    expect(asker.code(commands.writeDataMemory, over)).toBe(0)
    expect([plc.read('F1:00177777'), plc.read('F2:000000')]).toEqual([2, 3])
  },
  fillDataMemory({ plc, asker }) {
    expect(asker.code(commands.fillDataMemory, { head: R09012, length: 3, value: 9 })).toBe(0)
    expect(['09011', '09012', '09014', '09015'].map((item) => plc.read(item))).toEqual([0, 9, 9, 0])
  },
  writeRegisters({ plc, asker }) {
    const items = [
      { address: extended(0o4012), value: 1 },
      { address: extended(0o200001, 1), value: 2 },
    ]
    expect(asker.ask(commands.writeRegisters, { items })).toBeDefined()
    expect([plc.read('09012'), plc.read('F2:000001')]).toEqual([1, 2])
  },
  readSpecifiedBuffer({ plc, asker }) {
    plc.write('F1:00020003', 4)
    expect(asker.ask(commands.readSpecifiedBuffer, { buffer: 0, offset: 3, length: 1 })?.data).toEqual(Buffer.of(4))
    expect(asker.code(commands.readSpecifiedBuffer, { buffer: 1, offset: 0, length: 1 })).toBe(0x48)
    expect(asker.code(commands.readSpecifiedBuffer, { buffer: 0, offset: 256, length: 1 })).toBe(0x4c)
  },
  readRingBuffer({ plc, asker }) {
    plc.ringBuffers.put(0, hello)
    const take = (length: number, functions = 1) =>
      asker.ask(commands.readRingBuffer, { buffer: 0, function: functions, length })
    expect(take(2)).toMatchObject({ pointer: 0, more: 1, data: Buffer.from('he') })
    // Confirmed type: again and again until it is acknowledged.
    expect(take(2, 0x81)).toMatchObject({ pointer: 2, more: 1, data: Buffer.from('ll') })
    expect(take(2, 0x81)).toMatchObject({ pointer: 2, more: 1, data: Buffer.from('ll') })
    expect(take(2, 0x83)).toMatchObject({ pointer: 4, more: 0, data: Buffer.from('o') })
    expect(take(2, 0x82)).toMatchObject({ pointer: 5, more: 0, data: Buffer.alloc(0) })
    // Around its end.
    plc.ringBuffers.put(0, hello)
    expect(take(1024)).toMatchObject({ pointer: 5, more: 0, data: hello })
    expect(asker.code(commands.readRingBuffer, { buffer: 1, function: 1, length: 1 })).toBe(0x40)
  },
  writeSpecifiedBuffer({ plc, asker }) {
    expect(asker.code(commands.writeSpecifiedBuffer, { buffer: 0, offset: 251, data: hello })).toBe(0)
    expect(plc.read('F1:00020373:STRING(5)')).toBe('hello')
    expect(asker.code(commands.writeSpecifiedBuffer, { buffer: 0, offset: 252, data: hello })).toBe(0x4c)
  },
  writeRingBuffer({ plc, asker }) {
    const put = (data: Buffer, functions = 1) =>
      asker.ask(commands.writeRingBuffer, { buffer: 0, function: functions, data })
    expect(put(hello)).toMatchObject({ pointer: 0, written: 5, free: 2 })
    expect(() => put(hello)).toThrow('43H')
    expect(() => put(Buffer.alloc(8))).toThrow('44H')
    expect(plc.ringBuffers.take(0, 4)).toEqual(Buffer.from('hell'))
    // Confirmed type: the pointer moves with the acknowledgement.
    expect(put(Buffer.from('ab'), 0x81)).toMatchObject({ pointer: 5, written: 2, free: 4 })
    expect(put(Buffer.from('cd'), 0x81)).toMatchObject({ pointer: 5, written: 2, free: 4 })
    expect(plc.ringBuffers.waiting(0)).toBe(1)
    expect(put(Buffer.alloc(0), 0x82)).toMatchObject({ pointer: 7, written: 0, free: 4 })
    expect(plc.ringBuffers.take(0, 9)).toEqual(Buffer.from('ocd'))
  },
  readSpecifiedBufferInformation({ asker }) {
    const place = { definition: 2, file: 1, address: 0o20000, length: 256 }
    expect(asker.ask(commands.readSpecifiedBufferInformation, { buffer: 0 })).toMatchObject(place)
    const none = { definition: 0, file: 0, address: 0, length: 0 }
    expect(asker.ask(commands.readSpecifiedBufferInformation, { buffer: 1 })).toMatchObject(none)
  },
  readRingBufferInformation({ plc, asker }) {
    plc.ringBuffers.put(0, hello)
    plc.ringBuffers.take(0, 3)
    const expected = {
      definition: 2,
      file: 1,
      address: 0o40000,
      writePointer: 5,
      readPointer: 3,
      direction: 0x81,
      length: 8,
    }
    expect(asker.ask(commands.readRingBufferInformation, { buffer: 0 })).toMatchObject(expected)
  },
  writeSpecifiedBufferInformation({ asker }) {
    const define = (buffer: number, address: number, length: number) =>
      asker.ask(commands.writeSpecifiedBufferInformation, { buffer, definition: 2, file: 2, address, length })
    expect(define(3, 0, 16)).toEqual({})
    expect(asker.code(commands.writeSpecifiedBuffer, { buffer: 3, offset: 0, data: hello })).toBe(0)
    define(4, 0xffff, 2)
    expect(asker.ask(commands.readSpecifiedBufferInformation, { buffer: 4 })?.definition).toBe(0x82)
    expect(asker.code(commands.readSpecifiedBuffer, { buffer: 4, offset: 0, length: 1 })).toBe(0x49)
  },
  writeRingBufferInformation({ asker }) {
    const ring = { definition: 1, file: 2, address: 0, direction: 0x80, length: 16 }
    const define = (buffer: number, pointers: { writePointer: number; readPointer: number }, length = 16) =>
      asker.code(commands.writeRingBufferInformation, { buffer, ...ring, ...pointers, length })
    const take = (buffer: number) => asker.code(commands.readRingBuffer, { buffer, function: 1, length: 4 })
    expect([define(3, { writePointer: 4, readPointer: 0 }), take(3)]).toEqual([0, 0])
    expect([define(4, { writePointer: 16, readPointer: 0 }), take(4)]).toEqual([0, 0x42])
    expect([define(5, { writePointer: 0, readPointer: 0 }, 0), take(5)]).toEqual([0, 0x41])
  },
  readSystemMemory({ plc, asker }) {
    plc.write('#0201', 3)
    const read = { segment: 8, address: 0o201, length: 2 }
    expect(asker.ask(commands.readSystemMemory, read)?.data).toEqual(Buffer.of(3, 0))
  },
  readMemorySize({ asker }) {
    expect(asker.ask(commands.readMemorySize, {})).toEqual({ size: 7 })
  },
  writeSystemMemory({ plc, asker }) {
    const write = { segment: 8, address: 0o201, data: Buffer.of(1, 1) }
    expect(asker.code(commands.writeSystemMemory, write)).toBe(0x06)
    asker.ask(commands.setRunState, { state: 1 })
    expect(asker.code(commands.writeSystemMemory, write)).toBe(0)
    expect(asker.code(commands.writeSystemMemory, { ...write, segment: 9, data: Buffer.of(9) })).toBe(0)
    expect([plc.read('#0201'), plc.read('#0202')]).toEqual([1, 1])
  },
  setMemorySize({ asker }) {
    // The JW300 has no such command.
    expect(asker.hex('47 00 5D 03')).toBe('45005D01')
    const older = joinJw({ model: 'jw30h' })
    expect(older.asker.code(commands.setMemorySize, { size: 8 })).toBe(0x06)
    older.plc.cpu.stop()
    expect(older.asker.code(commands.setMemorySize, { size: 8 })).toBe(0)
    expect(older.asker.ask(commands.readMemorySize, {})).toEqual({ size: 8 })
  },
  loopback({ asker }) {
    expect(asker.hex('47 00 80 48 45 4C 4C 4F')).toBe('4500800048454C4C4F')
  },
  readDate({ asker }) {
    asker.ask(commands.setDate, { year: 4, month: 8, day: 18, dayOfWeek: 3 })
    expect(asker.ask(commands.readDate, {})).toEqual({ year: 4, month: 8, day: 18, dayOfWeek: 3 })
  },
  readTime({ asker, clock }) {
    asker.ask(commands.setTime, { hour: 23, minute: 59, second: 58, control: 2 })
    clock.advance(1999)
    expect(asker.ask(commands.readTime, {})).toEqual({ hour: 23, minute: 59, second: 59 })
    clock.advance(1)
    expect(asker.ask(commands.readTime, {})).toEqual({ hour: 0, minute: 0, second: 0 })
  },
  setDate({ asker, clock }) {
    asker.ask(commands.setTime, { hour: 23, minute: 59, second: 59, control: 0 })
    expect(asker.code(commands.setDate, { year: 24, month: 2, day: 28, dayOfWeek: 5 })).toBe(0)
    clock.advance(1000)
    // The day of the week goes on from what was set.
    expect(asker.ask(commands.readDate, {})).toEqual({ year: 24, month: 2, day: 29, dayOfWeek: 6 })
    expect(asker.code(commands.setDate, { year: 23, month: 2, day: 29, dayOfWeek: 0 })).toBe(0x01)
  },
  setTime({ asker, clock }) {
    expect(asker.code(commands.setTime, { hour: 13, minute: 30, second: 0, control: 1 })).toBe(0)
    clock.advance(5000)
    const stopped = { hour: 13, minute: 30, second: 0 }
    expect(asker.ask(commands.readTime, {})).toEqual(stopped)
    asker.ask(commands.setTime, { ...stopped, control: 2 })
    clock.advance(5000)
    expect(asker.ask(commands.readTime, {})).toEqual({ ...stopped, second: 5 })
  },
  correctTime({ asker }) {
    const corrected = (second: number) => {
      asker.ask(commands.setTime, { hour: 8, minute: 0, second, control: 0 })
      asker.ask(commands.correctTime, { control: 8 })
      return asker.ask(commands.readTime, {})
    }
    expect(corrected(29)).toEqual({ hour: 8, minute: 0, second: 0 })
    expect(corrected(30)).toEqual({ hour: 8, minute: 1, second: 0 })
  },
  readBlockState({ plc, asker }) {
    asker.ask(commands.setBlockState, { block: 0x1ff, state: 1 })
    expect(asker.ask(commands.readBlockState, { block: 0x1ff })?.state).toBe(1)
    expect(asker.ask(commands.readBlockState, { block: 0 })?.state).toBe(0)
    expect(plc.cpu.stoppedBlocks).toEqual([0x1ff])
  },
  readRunState({ plc, asker }) {
    const state = () => asker.ask(commands.readRunState, {})?.state
    expect([state(), plc.cpu.state]).toEqual([0, 'RUN'])
    plc.cpu.stop()
    expect([state(), plc.cpu.stoppedBy]).toEqual([2, 'otherUnit'])
    asker.ask(commands.setRunState, { state: 1 })
    expect([state(), plc.cpu.stoppedBy]).toEqual([1, 'thisUnit'])
  },
  readWriteMode({ plc, asker }) {
    plc.cpu.writeMode = 1
    expect(asker.ask(commands.readWriteMode, {})).toEqual({ mode: 1 })
  },
  setBlockState({ plc, asker }) {
    asker.ask(commands.setBlockState, { block: 5, state: 1 })
    asker.ask(commands.setBlockState, { block: 3, state: 1 })
    expect(plc.cpu.stoppedBlocks).toEqual([3, 5])
    expect(asker.code(commands.setBlockState, { block: 5, state: 0 })).toBe(0)
    expect(plc.cpu.stoppedBlocks).toEqual([3])
  },
  setRunState({ plc, asker }) {
    const changes: string[] = []
    plc.on('state', ({ state, stoppedBy }) => changes.push(`${state} ${stoppedBy ?? ''}`.trim()))
    plc.cpu.stop()
    asker.ask(commands.setRunState, { state: 1 })
    // It takes back its own stop only.
    asker.ask(commands.setRunState, { state: 0 })
    plc.cpu.run()
    expect(changes).toEqual(['STOP otherUnit', 'STOP thisUnit', 'STOP otherUnit', 'RUN'])
  },
  setWriteMode({ plc, asker }) {
    expect(asker.code(commands.setWriteMode, { mode: 0 })).toBe(0)
    expect(plc.cpu.writeMode).toBe(0)
    expect(asker.code(commands.fillDataMemory, { head: R09012, length: 1, value: 1 })).toBe(0x10)
    expect(plc.read('09012')).toBe(0)
  },
  setSecretFunction({ plc, asker }) {
    const set = (what: number) => asker.code(commands.setSecretFunction, { function: what })
    const pass = (what: number, password: string) => asker.code(commands.secretPassword, { function: what, password })
    expect([set(1), set(0x0f)]).toEqual([0x30, 0x30])
    expect([pass(1, 'Ab12'), pass(2, 'Ab12'), set(1)]).toEqual([0, 0, 0])
    expect(plc.secret).toEqual({ enabled: true, hasPassword: true })
    expect([set(0x0f), pass(0, 'Ab12'), set(0x0f)]).toEqual([0x31, 0, 0])
    expect(plc.secret).toEqual({ enabled: false, hasPassword: false })
  },
  secretPassword({ plc, asker }) {
    const pass = (what: number, password: string) => asker.code(commands.secretPassword, { function: what, password })
    expect([pass(0, 'Ab12'), pass(2, 'Ab12'), pass(1, 'Ab12'), pass(2, 'AB12')]).toEqual([0x30, 0x30, 0, 0x33])
    expect(plc.secret.hasPassword).toBe(false)
    const guarded = joinJw({ password: 'Ab12' }).asker
    const release = (password: string) => guarded.code(commands.secretPassword, { function: 0, password })
    expect(guarded.code(commands.secretPassword, { function: 1, password: 'Cd34' })).toBe(0x31)
    expect([release('ab12'), release('Ab12')]).toEqual([0x33, 0])
    // Not a letter or digit.
    expect(guarded.hex('47 00 FC 00 41 62 31 21')).toBe('4500FC32')
  },
  readSecretState({ asker }) {
    expect(asker.ask(commands.readSecretState, {})).toEqual({ state: 0 })
    expect(joinJw({ password: 'Ab12' }).asker.ask(commands.readSecretState, {})).toEqual({ state: 1 })
  },
}

test.each(Object.entries(scenarios))('%s', (_name, scenario) => scenario(joinJw(parts)))

describe('a request is refused', () => {
  const writing: readonly (readonly [keyof JwCommands, 1 | 2, (joined: JwJoined) => number | undefined])[] = [
    ['setRelay', 1, ({ asker }) => asker.code(commands.setRelay, { address: R09012, bit: 0, value: 1 })],
    [
      'setRelays',
      1,
      ({ asker }) => asker.code(commands.setRelays, { items: [{ address: extended(0), bit: 0, value: 1 }] }),
    ],
    ['setTimerCounter', 1, ({ asker }) => asker.code(commands.setTimerCounter, { number: 0, value: 1 })],
    ['writeDataMemory', 1, ({ asker }) => asker.code(commands.writeDataMemory, { head: R09012, data: hello })],
    ['fillDataMemory', 1, ({ asker }) => asker.code(commands.fillDataMemory, { head: R09012, length: 1, value: 1 })],
    [
      'writeRegisters',
      1,
      ({ asker }) => asker.code(commands.writeRegisters, { items: [{ address: extended(0), value: 1 }] }),
    ],
    [
      'writeSpecifiedBuffer',
      1,
      ({ asker }) => asker.code(commands.writeSpecifiedBuffer, { buffer: 0, offset: 0, data: hello }),
    ],
    [
      'writeRingBuffer',
      1,
      ({ asker }) => asker.code(commands.writeRingBuffer, { buffer: 0, function: 1, data: hello }),
    ],
    ['setDate', 1, ({ asker }) => asker.code(commands.setDate, { year: 4, month: 8, day: 18, dayOfWeek: 3 })],
    ['setTime', 1, ({ asker }) => asker.code(commands.setTime, { hour: 1, minute: 1, second: 1 })],
    ['correctTime', 1, ({ asker }) => asker.code(commands.correctTime, { control: 8 })],
    [
      'writeOptionParameters',
      2,
      ({ asker }) => asker.code(commands.writeOptionParameters, { rack: 0, unit: 0, address: 0, data: hello }),
    ],
    [
      'writeSpecialIoParameters',
      2,
      ({ asker }) => asker.code(commands.writeSpecialIoParameters, { rack: 0, unit: 0, address: 0, data: hello }),
    ],
    [
      'writeSystemMemory',
      2,
      ({ asker }) => asker.code(commands.writeSystemMemory, { segment: 8, address: 0, data: hello }),
    ],
    [
      'writeSpecifiedBufferInformation',
      2,
      ({ asker }) =>
        asker.code(commands.writeSpecifiedBufferInformation, {
          buffer: 1,
          definition: 2,
          file: 1,
          address: 0,
          length: 1,
        }),
    ],
    [
      'writeRingBufferInformation',
      2,
      ({ asker }) =>
        asker.code(commands.writeRingBufferInformation, {
          buffer: 1,
          definition: 2,
          file: 1,
          address: 0,
          writePointer: 0,
          readPointer: 0,
          direction: 0x80,
          length: 8,
        }),
    ],
  ]

  test.each(writing)('%s below write mode %i', (_name, mode, act) => {
    const below = joinJw({ ...parts, writeMode: mode === 1 ? 0 : 1 })
    expect(act(below)).toBe(0x10)
    const joined = joinJw({ ...parts, writeMode: mode })
    if (_name === 'writeSystemMemory') joined.plc.cpu.stop()
    expect(act(joined)).toBe(0)
  })

  test('of whatever else has the effect of a write or a configuration, the secret function and 29H alone need no mode', () => {
    const names = writing.map(([name]) => name)
    const others = Object.values(commands).filter(
      ({ effect, name }) => ['write', 'configure'].includes(effect) && !names.includes(name),
    )
    expect(others.map(({ name }) => name).sort()).toEqual([
      'readRingBuffer',
      'secretPassword',
      'setMemorySize',
      'setSecretFunction',
    ])
  })

  test('behind the end of a file, and where there is no file; then nothing is written', () => {
    const { plc, asker } = joinJw({ files: { 0: 0x1000, 1: 0x10000, 3: 0x8000 } })
    const write = (head: Parameters<typeof asker.ask<JwCommands['writeDataMemory']>>[1]['head']) =>
      asker.code(commands.writeDataMemory, { head, data: Buffer.of(1, 2) })
    expect(write({ file: 0, address: 0xffe })).toBe(0)
    expect(write({ file: 0, address: 0xfff })).toBe(0x08)
    expect(write({ file: 2, address: 0 })).toBe(0x08)
    // The pages of the file registers follow one another as far as there are any.
    expect(write(extended(0xffff, 1))).toBe(0x08)
    expect(plc.read('F1:00177777')).toBe(0)
    const items = [
      { address: extended(0, 1), value: 7 },
      { address: extended(0x10000, 1), value: 7 },
    ]
    expect(asker.code(commands.writeRegisters, { items })).toBe(0x08)
    expect(plc.read('F1:00000000')).toBe(0)
  })

  test.each([
    ['the program of an older model', '47 00 04 00 00 00', '45000401'],
    ['an unknown command', '47 00 FF', '4500FF01'],
    ['a length of 0', '47 00 24 00 00 08 00 00', '45002401'],
    ['more than 1024 bytes', '47 00 24 00 00 08 01 04', '45002401'],
    ['bit 8 of a byte', '47 00 20 00 03 01 08', '45002001'],
    ['a file 81H', '47 00 24 81 00 00 01 00', '45002401'],
    ['bytes behind the end of a file', '47 00 24 00 FF FF 02 00', '45002408'],
    ['system memory behind its end', '47 00 44 08 7F 04 02 00', '45004408'],
  ])('%s', (_what, request, answer) => {
    expect(joinJw().asker.hex(request)).toBe(answer)
  })

  test('what a JW30H does not have, with 01H', () => {
    const { asker } = joinJw({ model: 'jw30h' })
    for (const { code, name } of Object.values(commands).filter(
      (command) => 'models' in command && !command.models.some((model) => model === 'jw30h'),
    )) {
      const request = {
        readOptionParameters: '00 00 00 00 01 00',
        readSpecialIoParameters: '00 00 00 00 01 00',
        writeOptionParameters: '00 00 00 00 01 00 00',
        writeSpecialIoParameters: '00 00 00 00 01 00 00',
        monitorRelays: '01 FF 00 00 00 00 00 00',
        monitorRegisters: '01 FF 00 00 00 00 00',
        setRelays: '01 FF 00 00 00 00 00 00 01',
        writeRegisters: '01 FF 00 00 00 00 00 01',
        loopback: '00',
      }[name as string]
      const com = code.toString(16).padStart(2, '0').toUpperCase()
      expect(asker.hex(`47 00 ${com} ${request}`)).toBe(`4500${com}01`)
    }
    expect(asker.hex('47 00 24 FF 00 00 08 00 00 01 00')).toBe('45002401')
    expect(asker.hex('47 00 24 09 00 00 01 00')).toBe('45002408')
  })

  test('a clock command of a model without a clock, with 34H', () => {
    const { asker } = joinJw({ hasClock: false })
    expect([asker.hex('47 00 A2'), asker.hex('47 00 A3'), asker.hex('47 00 B4 08')]).toEqual([
      '4500A234',
      '4500A334',
      '4500B434',
    ])
  })

  test('a write of parameters while the start switch is 1, with the code of the option', () => {
    const parameters = Buffer.alloc(0o1000, 0)
    const { plc, asker } = joinJw({ startSwitchRefusal: 0x10, optionUnits: [{ rack: 0, unit: 2, parameters }] })
    expect(plc.optionUnit(0, 2)).toMatchObject({ started: true })
    const write = (address: number, data: Buffer) =>
      asker.code(commands.writeOptionParameters, { rack: 0, unit: 2, address, data })
    expect([
      write(0, hello),
      write(0o3776, Buffer.of(0, 0)),
      write(0o3777, Buffer.of(1)),
      write(0o3777, Buffer.of(0x81)),
    ]).toEqual([0x10, 0x10, 0x10, 0x10])
    expect([write(0o3777, Buffer.of(0)), write(0, hello)]).toEqual([0, 0])
    expect(plc.optionUnit(0, 2).started).toBe(false)
  })
})
