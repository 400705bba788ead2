// Requests of the SLMP set in 1E frames, for a client.
import { hex } from '../../basics/hex'
import type { Message } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { ClientProtocol, ProtocolOptions } from '../client-protocol'
import { otherSetExplainer } from '../explain/other-set-explainer'
import type { Head1e } from '../frame/frame-1e'
import { ownStation, type Route } from '../frame/route'
import { profileOver1e } from '../profiles/over-1e'
import type { Profile } from '../profiles/profile'
import { aCompatibleCommands } from './commands'
import { isAddress } from './frame-names'
import { over1e, type SaidName } from './names'
import { aCompatibleProtocol } from './protocol'
import type { ACompatibleFamily } from './rules'
import { nothing, type OtherSet, type Said, SlmpOver, saidAlike } from './slmp-over'
import { type DeviceWindow, windowOf } from './windows'

const names = { frame: '1E', instead: '3E' } as const

/**
 * 1E reaches the connected station only.
 * @throws RequestError BAD_OPTION when the PLC does not take 1E, or for another route
 */
export function protocolOver1e({ profile, route, code, asciiXy, timer }: ProtocolOptions): ClientProtocol {
  refuseOtherStations(route)
  const family = familyOf(profile)
  const narrowed = profileOver1e(profile, family)
  const bits = new BitsOf1e(code, family)
  const set: OtherSet<Head1e> = {
    ...names,
    protocol: aCompatibleProtocol({ code, asciiXy, timer, family }),
    profile: narrowed,
    code,
    anyHead: { command: 0, pc: 0, timer: 0 },
    said: (name, message) => bits.said(name, message) ?? saidAs(name, message),
    nameOf(name) {
      const { title, code: number } = aCompatibleCommands[over1e[name]]
      return `${title} (${hex(number, 2)}H)`
    },
    explainer: (shownAs) => otherSetExplainer({ frame: '1E', code, profile: narrowed, asciiXy, ...shownAs }),
  }
  return new SlmpOver(set)
}

function saidAs(name: SaidName, message: Message): Said {
  return { command: aCompatibleCommands[over1e[name]], ...saidAlike(names, name, message) }
}

function familyOf({ aCompatible, title }: Profile): ACompatibleFamily {
  if (aCompatible !== undefined) return aCompatible
  throw new RequestError('BAD_OPTION', `${title} has no 1E frame here: use 3E.`, 'frame')
}

function refuseOtherStations(route: Route): void {
  for (const name of ['network', 'station', 'moduleIo', 'multidrop'] as const) {
    if (route[name] === ownStation[name]) continue
    throw new RequestError(
      'BAD_OPTION',
      `A 1E frame reaches the connected station only: leave out route.${name}.`,
      'route',
    )
  }
}

/** Whether a dummy follows an odd number of bits in ASCII code is not known: none is asked for then. */
class BitsOf1e {
  constructor(
    private readonly code: ProtocolOptions['code'],
    private readonly family: ACompatibleFamily,
  ) {}

  /** What is said otherwise than usual; `undefined` when it is not. */
  said(name: SaidName, message: Message): Said | undefined {
    if (name === 'readBits') return this.#evenBits(message)
    return name === 'writeBits' ? this.#writtenBits(message) : undefined
  }

  #avoidsOdd(count: number): boolean {
    return this.code === 'ascii' && this.family.oddBits === undefined && count % 2 === 1
  }

  #evenBits(message: Message): Said | undefined {
    const { head, points } = message
    const window = isAddress(head) ? windowOf(this.family.windows, head) : undefined
    if (typeof points !== 'number' || !this.#avoidsOdd(points) || window === undefined || !isAddress(head)) {
      return undefined
    }
    const isLast = head.number + points >= endOf(window)
    const from = isLast ? { ...head, number: head.number - 1 } : head
    const skip = isLast ? 1 : 0
    return {
      command: aCompatibleCommands.readBits,
      message: { ...message, head: from, points: points + 1 },
      answer: ({ values }) => ({ values: Array.isArray(values) ? values.slice(skip, skip + points) : values }),
    }
  }

  /** One by one instead, which needs no dummy and writes the same. */
  #writtenBits({ head, values }: Message): Said | undefined {
    if (!isAddress(head) || !Array.isArray(values) || !this.#avoidsOdd(values.length)) return undefined
    const bits = Array.from(values, (value: unknown, i) => ({ device: { ...head, number: head.number + i }, value }))
    return { command: aCompatibleCommands.writeRandomBits, message: { bits }, answer: nothing }
  }
}

function endOf({ number, points }: DeviceWindow): number {
  return number + points
}
