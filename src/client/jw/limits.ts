// What fits into one request, over the transport and behind the header that are used.

import { RequestError } from '../../errors'
import { jwCommands } from '../../jw/commands/commands'
import type { Exchange } from '../../link/link'
import type { JwProtocol } from './send-command'
import type { JwSettings } from './settings'

type Bounds = Pick<JwSettings, 'maxData' | 'maxMessage' | 'lists' | 'model'>

/** How many of what one request carries. Scattered ones 0: there is no such request. */
export interface JwLimits {
  /** Bytes in a row, in either form of addresses. */
  readonly readBytes: number
  readonly writeBytes: number
  /** Bytes of the system memory. */
  readonly readSystem: number
  readonly writeSystem: number
  readonly readTimers: number
  /** Parameters of an option unit. */
  readonly readParameters: number
  readonly writeParameters: number
  /** Scattered. */
  readonly readRegisters: number
  readonly writeRegisters: number
  readonly setRelays: number
}

/** Elements of a list (JW300 option unit manual, 21H to 37H), numbers of 23H, bytes of 44H and 54H. */
const MOST = { list: 128, timers: 256 } as const
const HEAD = { file: 1, address: 0, extended: true } as const

/** Worked out from the messages themselves: their size grows evenly. */
export function jwLimits(protocol: JwProtocol, settings: Bounds): JwLimits {
  const { maxData } = settings
  const bounds = { ...settings, isJw300: settings.model === 'jw300' }
  const fitting = (most: number, exchange: (count: number) => Exchange<unknown>) => {
    const sizes = [1, 2].map((count) => sizeOf(exchange(count)))
    const [one = [], two = []] = sizes
    const room = one.map((size, side) => {
      const step = (two[side] ?? 0) - size
      return step <= 0 ? most : Math.floor((bounds.maxMessage - size) / step) + 1
    })
    return Math.max(1, Math.min(most, ...room))
  }
  const list = (exchange: (count: number) => Exchange<unknown>) => (bounds.lists ? fitting(MOST.list, exchange) : 0)
  // A model that has none refuses the request, and says why.
  const parameters = (exchange: (count: number) => Exchange<unknown>) =>
    bounds.isJw300 ? fitting(maxData, exchange) : maxData
  const unit = { rack: 0, unit: 0, address: 0 } as const
  const items = <T>(count: number, item: T) => Array.from({ length: count }, () => item)
  const system = { segment: 8, address: 0 } as const
  // Where there are no extended addresses the basic ones are shorter.
  const head = bounds.isJw300 ? HEAD : { file: 1, address: 0 }
  return {
    readBytes: fitting(maxData, (length) => protocol.exchange(jwCommands.readDataMemory, { head, length })),
    writeBytes: fitting(maxData, (length) =>
      protocol.exchange(jwCommands.writeDataMemory, { head, data: Buffer.alloc(length) }),
    ),
    readSystem: fitting(maxData, (length) => protocol.exchange(jwCommands.readSystemMemory, { ...system, length })),
    writeSystem: fitting(maxData, (length) =>
      protocol.exchange(jwCommands.writeSystemMemory, { ...system, data: Buffer.alloc(length) }),
    ),
    readTimers: fitting(MOST.timers, (points) =>
      protocol.exchange(jwCommands.monitorTimersCounters, { number: 0, points }),
    ),
    readParameters: parameters((length) => protocol.exchange(jwCommands.readOptionParameters, { ...unit, length })),
    writeParameters: parameters((length) =>
      protocol.exchange(jwCommands.writeOptionParameters, { ...unit, data: Buffer.alloc(length) }),
    ),
    readRegisters: list((count) =>
      protocol.exchange(jwCommands.monitorRegisters, { items: items(count, { address: HEAD }) }),
    ),
    writeRegisters: list((count) =>
      protocol.exchange(jwCommands.writeRegisters, { items: items(count, { address: HEAD, value: 0 }) }),
    ),
    setRelays: list((count) =>
      protocol.exchange(jwCommands.setRelays, { items: items(count, { address: HEAD, bit: 0, value: 0 }) }),
    ),
  }
}

function sizeOf(exchange: Exchange<unknown>): number[] {
  return [exchange.write(0).length, exchange.answerSize() ?? 0]
}

/** @throws RequestError LIMIT_EXCEEDED for a request or an answer that a message cannot carry here */
export function checkMessageSize(exchange: Exchange<unknown>, { maxMessage }: Pick<JwSettings, 'maxMessage'>): void {
  const [request = 0, answer = 0] = sizeOf(exchange)
  if (request <= maxMessage && answer <= maxMessage) return
  const message = `${exchange.title}: its request has ${request} bytes and its answer ${answer}; a message has ${maxMessage} at most here. Ask for less at once.`
  throw new RequestError('LIMIT_EXCEEDED', message)
}
