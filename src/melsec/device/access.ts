/** Which addresses exist, and which command may use which address: the rules over the device table. */
import { RequestError, type RequestErrorCode } from '../../errors'
import {
  CPU_UNIT,
  type DeviceAddress,
  type DeviceCommand,
  type DeviceExtension,
  type DeviceInfo,
  findDevice,
  LAST_INDEX,
  LAST_NUMBER,
} from './device'

/** Why something cannot be sent: what is wrong and what to do. */
export interface AccessProblem {
  readonly code: RequestErrorCode
  readonly message: string
}

/** Last network and last module number an extension can name (SLMP p. 20; p. 210: three hexadecimal digits). */
const LAST_NETWORK = 239
const LAST_UNIT = 0xfff

/**
 * What is wrong with an address whatever the command and the wire form, or undefined.
 * @example addressProblem({ device: 'G', number: 0 })?.code   // 'BAD_ADDRESS': G needs a module
 */
export function addressProblem(address: DeviceAddress): AccessProblem | undefined {
  const info = findDevice(address.device)
  if (info === undefined) return bad(`There is no device ${JSON.stringify(address.device)}.`)
  if (!isWhole(address.number, 0, LAST_NUMBER)) {
    return outOfRange(`${info.name} number ${address.number} is not a whole number from 0 to ${LAST_NUMBER}.`)
  }
  // The usual address is a device and a number: nothing else to look at.
  if (address.extension === undefined && address.extensionIndex === undefined) {
    if (info.extensionOnly === true) return bad(whereToFind(info))
    if (address.index === undefined && address.indirect === undefined) return undefined
  }
  return extensionProblem(info, address) ?? modificationProblem(info, address)
}

/** @throws RequestError when `addressProblem` finds something. */
export function checkAddress(address: DeviceAddress): void {
  const problem = addressProblem(address)
  if (problem !== undefined) throw new RequestError(problem.code, problem.message)
}

function whereToFind(info: DeviceInfo): string {
  return info.name === 'G'
    ? 'G is the buffer memory of a module: write the module too, e.g. U3\\G100 for start I/O number 0030, or U3E0\\G100 for CPU No. 1.'
    : `${info.name} is in the buffer memory of a CPU: write the CPU too, e.g. U3E0\\${info.name}100 for CPU No. 1.`
}

function extensionProblem(info: DeviceInfo, address: DeviceAddress): AccessProblem | undefined {
  const { extension, extensionIndex } = address
  if (extension === undefined) {
    return extensionIndex === undefined ? undefined : bad('An extension index needs an extension: J or U.')
  }
  if (info.extensions?.includes(extension.kind) !== true) return bad(placeProblem(info, extension))
  if (extensionIndex !== undefined) {
    if (extension.kind === 'cpu') {
      // SLMP p. 215-218: the extension is the offset, yet the register shall hold 3E0H to 3E3H. Both cannot be true
      // of U3E0 + Z, and the wrong reading reads another unit's memory.
      return bad('The CPU of a CPU buffer memory cannot be indexed: the manual does not say how. Write U3E0 to U3E3.')
    }
    if (extensionIndex.register !== 'Z') return bad('Only Z can index a network or start I/O number, LZ cannot.')
    if (!isWhole(extensionIndex.number, 0, LAST_INDEX.Z)) return indexOutOfRange(extensionIndex)
  }
  return extensionRange(extension, extensionIndex !== undefined)
}

function placeProblem(info: DeviceInfo, extension: DeviceExtension): string {
  switch (extension.kind) {
    case 'link':
      return `${info.name} is not a link direct device: J takes X, Y, B, SB, W and SW.`
    case 'module':
      return info.name === 'HG'
        ? 'HG exists in CPUs only: U3E0\\HG0 to U3E3\\HG0.'
        : `${info.name} is not in a module: U takes G, e.g. U3\\G100.`
    case 'cpu':
      return `${info.name} is not in the buffer memory of a CPU: U3E0 to U3E3 take G and HG.`
    default:
      return unknownKind(extension)
  }
}

function unknownKind(extension: never): string {
  return `Unknown extension ${JSON.stringify(extension)}: link, module or cpu.`
}

function extensionRange(extension: DeviceExtension, indexed: boolean): AccessProblem | undefined {
  switch (extension.kind) {
    case 'link': {
      // With an index the network is only the offset, so 0 is a sensible one.
      const first = indexed ? 0 : 1
      if (isWhole(extension.network, first, LAST_NETWORK)) return undefined
      return outOfRange(`Network ${extension.network} does not exist: networks are 1 to ${LAST_NETWORK}.`)
    }
    case 'module':
      if (!isWhole(extension.unit, 0, LAST_UNIT)) {
        return outOfRange(
          `Module ${extension.unit} does not exist: U takes the upper three digits of the start I/O number.`,
        )
      }
      if (extension.unit >= CPU_UNIT && extension.unit <= CPU_UNIT + 3) {
        return bad('U3E0 to U3E3 are the CPUs, not modules: use an extension of kind cpu.')
      }
      return undefined
    case 'cpu':
      return isWhole(extension.cpu, 1, 4) ? undefined : outOfRange(`CPU ${extension.cpu} does not exist: 1 to 4.`)
    default:
      return bad(unknownKind(extension))
  }
}

function modificationProblem(info: DeviceInfo, address: DeviceAddress): AccessProblem | undefined {
  const { index, indirect } = address
  if (index !== undefined) {
    const last = LAST_INDEX[index.register]
    if (last === undefined) return bad('A device is indexed by Z or LZ.')
    if (!isWhole(index.number, 0, last)) return indexOutOfRange(index)
  }
  if (indirect !== undefined && info.unit !== 'word') {
    return bad(`@ works on word devices only, and ${info.name} is not one.`)
  }
  return undefined
}

function indexOutOfRange(index: { readonly register: 'Z' | 'LZ'; readonly number: number }): AccessProblem {
  const { register } = index
  return outOfRange(`${register}${index.number} does not exist: ${register}0 to ${register}${LAST_INDEX[register]}.`)
}

/** How a command is about to use an address. */
export interface DeviceUse {
  readonly command: DeviceCommand
  /** The list of the command the address stands in. */
  readonly list?: 'words' | 'doubleWords' | 'wordBlocks' | 'bitBlocks'
  readonly points?: number
}

/** Commands that take an index or `@` (SLMP appendix 1). */
const MODIFIED_IN: readonly DeviceCommand[] = [
  'readRandom',
  'writeRandomBits',
  'writeRandomWords',
  'entryMonitorDevice',
]
const BIT_UNITS: readonly DeviceCommand[] = ['readBits', 'writeBits', 'writeRandomBits']

/**
 * Why the SLMP manual does not let this command address this device, or undefined when it does.
 * Limits of points and what one PLC family lacks are the profile's.
 * @example accessProblem({ device: 'LTN', number: 0 }, { command: 'readWords', points: 3 })?.message
 */
export function accessProblem(address: DeviceAddress, use: DeviceUse): AccessProblem | undefined {
  const info = findDevice(address.device)
  if (info === undefined) return bad(`There is no device ${JSON.stringify(address.device)}.`)
  const message = commandProblem(info, use) ?? listProblem(info, use) ?? modifiedProblem(address, use)
  return message === undefined ? undefined : { code: 'UNSUPPORTED', message }
}

function commandProblem(info: DeviceInfo, { command, points }: DeviceUse): string | undefined {
  if (info.notIn?.includes(command) === true) {
    const instead =
      info.group !== undefined && info.part !== 'current value' && info.longOnly === true && command === 'readWords'
        ? ` Read ${info.group}N: its third word holds coil (b0) and contact (b1).`
        : ''
    return `${info.name} (${info.title}) cannot be addressed by ${command}.${instead}`
  }
  if (BIT_UNITS.includes(command) && info.unit !== 'bit') {
    return `${info.name} (${info.title}) is not a bit device, so ${command} cannot address it: use word units.`
  }
  if (points !== undefined && info.wholeDevices?.includes(command) === true && info.wordsPerDevice !== undefined) {
    if (points % info.wordsPerDevice !== 0) {
      return `${command} of ${info.name} takes ${info.wordsPerDevice} words per device: ${points} points is not a multiple of it.`
    }
  }
  return undefined
}

function listProblem(info: DeviceInfo, { list }: DeviceUse): string | undefined {
  if (list === 'wordBlocks' && info.bitBlocksOnly === true) {
    return `${info.name} (${info.title}) belongs into a bit block, not a word block.`
  }
  if (list === 'words' && info.unit === 'doubleWord') {
    return `${info.name} (${info.title}) has 32 bits: put it among the double words.`
  }
  return undefined
}

function modifiedProblem(address: DeviceAddress, { command }: DeviceUse): string | undefined {
  const { index, extensionIndex, indirect } = address
  if (index === undefined && extensionIndex === undefined && indirect === undefined) return undefined
  if (MODIFIED_IN.includes(command)) return undefined
  return `${command} takes no index register and no @: only random read, random write and monitor do.`
}

function isWhole(value: number, first: number, last: number): boolean {
  return Number.isInteger(value) && value >= first && value <= last
}

function bad(message: string): AccessProblem {
  return { code: 'BAD_ADDRESS', message }
}

function outOfRange(message: string): AccessProblem {
  return { code: 'OUT_OF_RANGE', message }
}
