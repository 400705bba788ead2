import type { CommandName } from '../melsec/commands/commands'
import type { DeviceAddress } from '../melsec/device/device'
import { fileHandlers } from './file-handlers'
import type { Handler, RandomDevices } from './handler'
import type { AccessUnit, DeviceMemory } from './memory'
import { Refusal } from './refusal'

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
    caller.lock.lock(profile.password.lockChecks ? password : undefined)
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
