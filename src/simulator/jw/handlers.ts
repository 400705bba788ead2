// What a simulated JW does with each command: the declarations say which there are, and what an answer has.
import type { JwCommandName } from '../../jw/commands/commands'
import { Refusal } from '../refusal'
import type { JwWriteMode } from './cpu'
import type { JwHandler, JwParts } from './handler'
import { result } from './result'

export const jwHandlers: { readonly [N in JwCommandName]: JwHandler<N> } = {
  // --- parameters
  readOptionParameters: ({ rack, unit, address, length }, { optionUnits }) => ({
    data: optionUnits.read(rack, unit, address, length),
  }),
  readSpecialIoParameters: ({ rack, unit, address, length }, { specialIo }) => ({
    data: specialIo.read(rack, unit, address, length),
  }),
  writeOptionParameters({ rack, unit, address, data }, { optionUnits }) {
    optionUnits.write(rack, unit, address, data)
    return {}
  },
  writeSpecialIoParameters({ rack, unit, address, data }, { specialIo }) {
    specialIo.write(rack, unit, address, data)
    return {}
  },

  // --- data memory
  monitorRelay: ({ address, bit }, { files }) => ({ value: files.bit(address, bit) }),
  monitorRelays: ({ items }, { files }) => ({ values: items.map(({ address, bit }) => files.bit(address, bit)) }),
  monitorTimersCounters: ({ number, points }, { timers }) => timers.monitor(number, points),
  readDataMemory: ({ head, length }, { files }) => ({ data: files.read(head, length) }),
  monitorRegisters: ({ items }, { files }) => ({ values: items.map(({ address }) => files.byte(address)) }),
  setRelay({ address, bit, value }, { files }) {
    files.setBit(address, bit, value === 1)
    return {}
  },
  setRelays({ items }, { files }) {
    for (const { address } of items) files.check(address, 1)
    for (const { address, bit, value } of items) files.setBit(address, bit, value === 1)
    return {}
  },
  setTimerCounter({ number, value }, { timers, cpu }) {
    if (!cpu.running) throw new Refusal(result.timerWhileStopped, 'the PLC is stopped')
    timers.set(number, value === 1)
    return {}
  },
  writeDataMemory({ head, data }, { files }) {
    files.write(head, data)
    return {}
  },
  fillDataMemory({ head, length, value }, { files }) {
    files.write(head, new Uint8Array(length).fill(value))
    return {}
  },
  writeRegisters({ items }, { files }) {
    for (const { address } of items) files.check(address, 1)
    for (const { address, value } of items) files.write(address, Uint8Array.of(value))
    return {}
  },

  // --- buffers
  readSpecifiedBuffer: ({ buffer, offset, length }, { specifiedBuffers }) => ({
    data: specifiedBuffers.read(buffer, offset, length),
  }),
  readRingBuffer({ buffer, function: functions, length }, { ringBuffers }) {
    const { pointer, data, more } = ringBuffers.take(buffer, length, functions)
    return { pointer, data, more: more ? 1 : 0 }
  },
  writeSpecifiedBuffer({ buffer, offset, data }, { specifiedBuffers }) {
    specifiedBuffers.write(buffer, offset, data)
    return {}
  },
  writeRingBuffer: ({ buffer, function: functions, data }, { ringBuffers }) => ringBuffers.put(buffer, data, functions),
  readSpecifiedBufferInformation: ({ buffer }, { specifiedBuffers }) => ({
    ...unknownPlace,
    ...specifiedBuffers.information(buffer),
  }),
  readRingBufferInformation: ({ buffer }, { ringBuffers }) => ({ ...unknownPlace, ...ringBuffers.information(buffer) }),
  writeSpecifiedBufferInformation({ buffer, ...definition }, { specifiedBuffers }) {
    specifiedBuffers.define(buffer, definition)
    return {}
  },
  writeRingBufferInformation({ buffer, ...definition }, { ringBuffers }) {
    ringBuffers.define(buffer, definition)
    return {}
  },

  // --- system
  readSystemMemory: ({ segment, address, length }, { systemMemory }) => ({
    data: Buffer.from(system(systemMemory, segment, address, length)),
  }),
  readMemorySize: (_, { cpu }) => ({ size: cpu.memorySize }),
  writeSystemMemory({ segment, address, data }, { systemMemory }) {
    system(systemMemory, segment, address, data.length).set(data)
    return {}
  },
  setMemorySize({ size }, { cpu }) {
    cpu.memorySize = size
    return {}
  },
  loopback: () => ({}),

  // --- clock
  readDate: (_, { clock }) => clock.date,
  readTime: (_, { clock }) => clock.time,
  setDate(date, { clock }) {
    if (!clock.setDate(date)) throw new Refusal(result.format, 'there is no such day')
    return {}
  },
  setTime({ control, ...time }, { clock }) {
    clock.setTime(time, control)
    return {}
  },
  correctTime({ control }, { clock }) {
    clock.correct(control)
    return {}
  },

  // --- control
  readBlockState: ({ block }, { cpu }) => ({ state: cpu.blocks.has(block) ? 1 : 0 }),
  readRunState: (_, { cpu }) => ({ state: cpu.runState }),
  readWriteMode: (_, { cpu }) => ({ mode: cpu.writeMode }),
  setBlockState({ block, state: stop }, { cpu }) {
    if (stop === 1) cpu.blocks.add(block)
    else cpu.blocks.delete(block)
    return {}
  },
  setRunState({ state: stop }, { cpu }) {
    cpu.stopByUnit(stop === 1)
    return {}
  },
  setWriteMode({ mode }, { cpu }) {
    cpu.writeMode = writeModes[mode] ?? cpu.writeMode
    return {}
  },

  // --- secret function
  setSecretFunction({ function: what }, { secret }) {
    if (what === ERASE) secret.erase()
    else secret.enable()
    return {}
  },
  secretPassword({ function: what, password }, { secret }) {
    const act = [secret.release, secret.propose, secret.register][what]
    act?.call(secret, password)
    return {}
  },
  readSecretState: (_, { secret }) => ({ state: secret.enabled ? 1 : 0 }),
}

const ERASE = 0x0f
const writeModes: readonly JwWriteMode[] = [0, 1, 2]
/** Where the definition of a buffer is kept is not simulated. */
const unknownPlace = { informationFile: 0, informationAddress: 0 } as const

function system(memory: JwParts['systemMemory'], segment: number, address: number, length: number): Buffer {
  const bytes = memory[segment]
  if (bytes !== undefined && address + length <= bytes.length) return bytes.subarray(address, address + length)
  throw new Refusal(result.capacity, 'the system memory ends before')
}

/** What must be so before a command is carried out. */
export interface Condition {
  /** Write mode that it needs at least. */
  readonly mode?: JwWriteMode
  /** The PLC must be stopped. */
  readonly stopped?: true
  /** It needs a clock. */
  readonly clock?: true
}

const data = { mode: 1 } as const
const all = { mode: 2 } as const
const clock = { clock: true } as const
const setsClock = { clock: true, mode: 1 } as const
const ofCpu = { mode: 2, stopped: true } as const

/** The rest needs nothing. Which mode a command needs is printed for 54H, B2H and B3H, and follows for the others. */
export const conditions: { readonly [N in JwCommandName]?: Condition } = {
  setRelay: data,
  setRelays: data,
  setTimerCounter: data,
  writeDataMemory: data,
  fillDataMemory: data,
  writeRegisters: data,
  writeSpecifiedBuffer: data,
  writeRingBuffer: data,
  writeSpecifiedBufferInformation: all,
  writeRingBufferInformation: all,
  writeOptionParameters: all,
  writeSpecialIoParameters: all,
  writeSystemMemory: ofCpu,
  setMemorySize: ofCpu,
  readDate: clock,
  readTime: clock,
  setDate: setsClock,
  setTime: setsClock,
  correctTime: setsClock,
}
