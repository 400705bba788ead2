// What the simulated PLC answers: one handler per declared command, so that a command without an answer does not
// compile.
import type { MessageInput, MessageOf } from '../codec/codec'
import type { CommandName, Commands } from '../melsec/commands/commands'
import type { DeviceAddress } from '../melsec/device'
import type { Profile } from '../melsec/profile'
import type { ExtendUnits, OwnBuffer } from './buffer-memory'
import type { Cpu } from './cpu'
import type { ErrorLog } from './error-log'
import { fileHandlers } from './file-handlers'
import type { Files } from './files'
import type { LabelTable } from './labels'
import type { AccessUnit, DeviceMemory } from './memory'
import type { PortLock } from './port-lock'
import { Refusal } from './refusal'

type RandomDevices = MessageOf<Commands['entryMonitorDevice']['request']>

/** Who asks, and what the PLC remembers of them. */
export interface Caller {
  /** External device, as remote control tells them apart. */
  readonly owner: string
  /** Entry Monitor Device of this connection. */
  monitored: RandomDevices | undefined
  /** Remote password of this connection. */
  readonly lock: PortLock
}

/** What a handler works on. */
export interface Call {
  readonly profile: Profile
  readonly memory: DeviceMemory
  readonly cpu: Cpu
  readonly errors: ErrorLog
  readonly buffer: OwnBuffer
  readonly extendUnits: ExtendUnits
  readonly labels: LabelTable
  readonly files: Files
  /** Model name, padded to 16 characters, and model code. */
  readonly model: { readonly model: string; readonly modelCode: number }
  readonly caller: Caller
  /** Starts the PLC again; everybody is disconnected. */
  readonly restart: () => void
}

/** The response data to a request. Throws `Refusal` for an end code. */
export type Handler<N extends CommandName> = (
  message: MessageOf<Commands[N]['request']>,
  call: Call,
  subcommand: number,
) => MessageInput<Commands[N]['response']>

const FORCED = 3

export const handlers: { readonly [N in CommandName]: Handler<N> } = {
  readBits: ({ head, points }, { memory }) => ({ values: memory.readBits(head, points) }),
  readWords: ({ head, points }, { memory }) => ({ values: memory.readWords(head, points) }),
  writeBits({ head, values }, { memory }) {
    memory.writeBits(head, values)
    return {}
  },
  writeWords({ head, values }, { memory }) {
    memory.writeWords(head, values)
    return {}
  },
  readRandom: (devices, { memory }) => readRandom(memory, devices),
  writeRandomBits({ bits }, { memory }) {
    for (const { device } of bits) memory.place(device, 'bit', 1)
    for (const { device, value } of bits) memory.writeBits(device, [value])
    return {}
  },
  writeRandomWords({ words, doubleWords }, { memory }) {
    checkAll(memory, words, 'word')
    checkAll(memory, doubleWords, 'doubleWord')
    for (const { device, value } of words) memory.writeWords(device, [value])
    for (const { device, value } of doubleWords) memory.writeDoubleWord(device, value)
    return {}
  },
  entryMonitorDevice(devices, { memory, caller }) {
    checkAll(memory, devices.words, 'word')
    checkAll(memory, devices.doubleWords, 'doubleWord')
    caller.monitored = devices
    return {}
  },
  executeMonitor(_, { memory, caller, profile }) {
    if (caller.monitored === undefined) {
      throw new Refusal(profile.refusals.monitorNotRegistered, 'Execute Monitor without Entry Monitor Device')
    }
    return readRandom(memory, caller.monitored)
  },
  readBlock: ({ wordBlocks, bitBlocks }, { memory }) => ({
    wordBlocks: wordBlocks.map(({ head, points }) => memory.readWords(head, points)),
    bitBlocks: bitBlocks.map(({ head, points }) => memory.readWords(head, points)),
  }),
  writeBlock({ wordBlocks, bitBlocks }, { memory }) {
    const blocks = [...wordBlocks, ...bitBlocks]
    for (const { head, values } of blocks) memory.place(head, 'word', values.length)
    for (const { head, values } of blocks) memory.writeWords(head, values)
    return {}
  },
  readTypeName: (_, { model }) => model,
  remoteRun({ mode, clearMode }, { cpu, caller }) {
    cpu.run(caller.owner, mode === FORCED, clearMode)
    return {}
  },
  remoteStop(_, { cpu, caller }) {
    cpu.stop(caller.owner)
    return {}
  },
  remotePause({ mode }, { cpu, caller }) {
    cpu.pause(caller.owner, mode === FORCED)
    return {}
  },
  remoteLatchClear(_, { cpu, caller }) {
    cpu.latchClear(caller.owner)
    return {}
  },
  remoteReset(_, { cpu, restart }) {
    cpu.checkReset()
    restart()
    return {}
  },
  selfTest: ({ data }) => ({ data }),
  clearError(_, { errors }) {
    errors.clear()
    return {}
  },
  readArrayLabels: ({ abbreviations, arrays }, { labels }) => ({
    arrays: arrays.map(({ name, unit, length }) => labels.readArray(name, abbreviations, { unit, length })),
  }),
  writeArrayLabels({ abbreviations, arrays }, { labels }) {
    const writes = arrays.map(({ name, area }) => labels.arrayWriter(name, abbreviations, area))
    for (const write of writes) write()
    return {}
  },
  readRandomLabels: (request, { labels }) => ({
    labels: request.labels.map(({ name }) => labels.read(name, request.abbreviations)),
  }),
  writeRandomLabels(request, { labels }) {
    const writes = request.labels.map(({ name, data }) => labels.writer(name, request.abbreviations, data))
    for (const write of writes) write()
    return {}
  },
  unlock({ password }, { caller }) {
    caller.lock.unlock(password)
    return {}
  },
  lock({ password }, { caller, profile }) {
    // FX5 communication manual 38.6: length and password are not used by Lock.
    caller.lock.lock(profile.id === 'iq-f' ? undefined : password)
    return {}
  },
  readMemory: ({ address, points }, { buffer }) => ({ values: buffer.read(address, points) }),
  writeMemory({ address, values }, { buffer }) {
    buffer.write(address, values)
    return {}
  },
  readExtendUnit: ({ address, byteCount, moduleNumber }, { memory, extendUnits }) => ({
    data: extendUnits.read(memory, moduleNumber, address, byteCount),
  }),
  writeExtendUnit({ address, moduleNumber, data }, { memory, extendUnits }) {
    extendUnits.write(memory, moduleNumber, address, data)
    return {}
  },
  ...fileHandlers,
}

function readRandom(memory: DeviceMemory, { words, doubleWords }: RandomDevices) {
  return {
    words: words.map(({ device }) => memory.readWords(device, 1)[0] ?? 0),
    doubleWords: doubleWords.map(({ device }) => memory.readDoubleWord(device)),
  }
}

/** Nothing is written when one of the devices is not there. */
function checkAll(memory: DeviceMemory, items: readonly { device: DeviceAddress }[], unit: AccessUnit): void {
  for (const { device } of items) memory.place(device, unit, 1)
}
