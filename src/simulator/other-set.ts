// Requests of frames with a command set of their own (1E, 1C) in the terms of the handlers. Their messages have the same shape:
// what differs is how their devices are called, and what is refused how.
import type { Message } from '../codec/codec'
import { type DeviceProblem, type DeviceRules, deviceProblem, pointLimit } from '../melsec/a-compatible/device-rules'
import type { SaidName } from '../melsec/a-compatible/names'
import { fromFrame, fx5Windows } from '../melsec/a-compatible/windows'
import type { DeviceAddress } from '../melsec/device/device'
import type { DeviceExclusion } from '../melsec/profiles/profile'
import { Refusal } from './refusal'

/** A request as the handlers take it. */
export interface Translated {
  readonly name: SaidName
  readonly message: Message
  /** The data of the answer. */
  readonly respond: (response: Message) => Buffer
}

/** What a set says about devices, and with which codes it refuses. `N`: the names of its commands. */
export interface OtherSet<N extends string> {
  readonly rules: DeviceRules<N>
  readonly endCodes: Readonly<Record<DeviceProblem['kind'], number>>
  readonly exclusions: readonly DeviceExclusion[]
}

/**
 * The message of `name`, which says what `said` of the SLMP set says.
 * @throws Refusal for devices and points that the set does not take
 */
export function translated<N extends string>(set: OtherSet<N>, name: N, said: SaidName, message: Message): Message {
  switch (said) {
    case 'readBits':
    case 'readWords':
      return { ...message, head: device(set, name, said, message.head as DeviceAddress, Number(message.points)) }
    case 'writeBits':
    case 'writeWords': {
      const { length } = message.values as readonly unknown[]
      return { ...message, head: device(set, name, said, message.head as DeviceAddress, length) }
    }
    case 'writeRandomBits':
      return { bits: list(set, name, said, message.bits) }
    case 'writeRandomWords':
      return { words: list(set, name, said, message.words), doubleWords: [] }
    case 'remoteRun':
      return { mode: 1, clearMode: 0 }
    case 'remoteStop':
    case 'readTypeName':
      return {}
    case 'selfTest':
      return message
    default:
      return said satisfies never
  }
}

function list<N extends string>(set: OtherSet<N>, name: N, said: SaidName, elements: unknown): readonly Message[] {
  // The shape of the declaration: decoded by it.
  const given = elements as readonly { readonly device: DeviceAddress }[]
  const max = pointLimit(set.rules, name, 'M') ?? 0
  if (given.length > max) throw new Refusal(set.endCodes.points, `${name}: ${given.length} devices, at most ${max}`)
  return given.map((element) => ({ ...element, device: device(set, name, said, element.device, 1) }))
}

function device<N extends string>(
  { rules, endCodes, exclusions }: OtherSet<N>,
  name: N,
  said: SaidName,
  address: DeviceAddress,
  points: number,
): DeviceAddress {
  // The memory has special relays and registers under their iQ-F names, whatever the family calls them.
  const found = fromFrame(fx5Windows, address)
  if (found === undefined) {
    throw new Refusal(endCodes.device, `${rules.frame} does not reach ${address.device}${address.number}`)
  }
  const problem = deviceProblem(rules, fx5Windows, name, found, points)
  if (problem !== undefined) throw new Refusal(endCodes[problem.kind], problem.message)
  const exclusion = exclusions.find(
    ({ commands, devices }) => commands.includes(said) && devices.includes(found.device),
  )
  if (exclusion !== undefined) throw new Refusal(exclusion.endCode, exclusion.reason)
  return found
}
