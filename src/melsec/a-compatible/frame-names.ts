// The message of a request with the devices under the names that they have in a 1E or 1C frame.
import type { Message } from '../../codec/codec'
import { RequestError } from '../../errors'
import { checkAddress } from '../device/access'
import type { DeviceAddress } from '../device/device'
import { checkDevice, type DeviceRules, pointLimit } from './device-rules'
import { type DeviceWindow, toFrame, windowOf } from './windows'

/** Fields of a message that are lists of devices. */
const LISTS = ['bits', 'words'] as const

/**
 * What is no message at all is left to the encoder.
 * @throws RequestError for a device that the frame does not reach, and for more points than a request takes
 */
export function withFrameNames<N extends string>(
  rules: DeviceRules<N>,
  windows: readonly DeviceWindow[],
  command: N,
  message: Message,
): Message {
  const moved = (address: DeviceAddress, points: number, path: string): DeviceAddress => {
    checkPlain(rules, address, path)
    checkDevice(rules, windows, command, address, points, path)
    const window = windowOf(windows, address)
    return window === undefined ? address : toFrame(window, address)
  }
  if (isAddress(message.head)) {
    return { ...message, head: moved(message.head, pointsOf(message), 'head') }
  }
  const list = LISTS.find((name) => Array.isArray(message[name]))
  const elements = list === undefined ? undefined : message[list]
  if (list === undefined || !Array.isArray(elements)) return message
  const devices: unknown[] = elements
  checkCount(rules, command, list, devices)
  return {
    ...message,
    [list]: devices.map((element, i) =>
      isMessage(element) && isAddress(element.device)
        ? { ...element, device: moved(element.device, 1, `${list}.${i}.device`) }
        : element,
    ),
  }
}

function checkPlain<N extends string>({ frame, instead }: DeviceRules<N>, address: DeviceAddress, path: string): void {
  checkAddress(address)
  const { extension, extensionIndex, index, indirect } = address
  if (extension ?? extensionIndex ?? index ?? indirect) {
    const message = `A ${frame} frame takes no J, U, index register or @: use a ${instead} frame.`
    throw new RequestError('UNSUPPORTED', message, path)
  }
}

function checkCount<N extends string>(
  rules: DeviceRules<N>,
  command: N,
  list: string,
  devices: readonly unknown[],
): void {
  // Bit devices and word devices alike.
  const max = pointLimit(rules, command, 'M') ?? 0
  if (devices.length <= max) return
  throw new RequestError('LIMIT_EXCEEDED', `${devices.length} devices in one request, at most ${max}. Split it.`, list)
}

/** Points from the first device on, or of each device of a list. */
export function pointsOf({ head, points, values }: Message): number {
  if (!isAddress(head)) return 1
  return typeof points === 'number' ? points : (sizeOf(values) ?? 1)
}

/** The devices of a request. */
export function addressesOf(message: Message): readonly DeviceAddress[] {
  const holders = LISTS.flatMap((name): unknown[] => {
    const list = message[name]
    return Array.isArray(list) ? list : []
  })
  const devices = holders.map((element) => (isMessage(element) ? element.device : undefined))
  return [message.head, ...devices].filter(isAddress)
}

function isMessage(value: unknown): value is Message {
  return typeof value === 'object' && value !== null
}

export function isAddress(value: unknown): value is DeviceAddress {
  return isMessage(value) && typeof value.device === 'string'
}

export function sizeOf(value: unknown): number | undefined {
  return Array.isArray(value) || (ArrayBuffer.isView(value) && 'length' in value) ? Number(value.length) : undefined
}
