// What the client of a Sharp JW can do, beside what every client can.

import type { JwCommand } from '../../jw/commands/commands'
import type { CallOptions } from '../connection/call'
import type { TraceEntry } from '../connection/trace'
import type { ItemTyping } from '../item/item-typing'
import type { Item } from '../item/parts'
import type { PlcClient, PlcEvents } from '../plan/plc-client'
import type { JwBuffers } from './buffers'
import type { JwClock, JwClockTime } from './clock'
import type { JwControl, JwRunState, JwWriteModeName } from './control'
import type { JwItemExplanation } from './item-access'
import type { JwItemInput, JwItemValue } from './item-text'
import type { JwRequestExplanation } from './named-request'
import type { JwClientOptions } from './options'
import type { JwParameters } from './parameters'
import type { JwSecret } from './secret'
import type { JwRequestOf, JwResponseOf } from './send-command'

/** What a client of a Sharp JW tells those who listen. */
export interface JwClientEvents extends PlcEvents {
  /** A message was sent or received. Costs time only while somebody listens. */
  readonly trace: TraceEntry
}

/** Items of a Sharp JW. */
export interface JwItemTypes extends ItemTyping {
  /** By the text of the item. */
  readonly value: JwItemValue<this['item']>
  /** By the text of the item. */
  readonly input: JwItemInput<this['item']>
}

/** Size of the program memory. */
export interface JwMemorySize {
  /** As the PLC says it. */
  readonly code: number
  /** K words, where a JW300 has this code. */
  readonly kiloWords?: number
}

/** What a PLC says of itself. What it refuses to tell is missing. */
export interface JwInfo {
  /** Size of the program memory. */
  readonly memorySize?: JwMemorySize
  /** Whether it runs. */
  readonly runState?: JwRunState
  /** What may be written. */
  readonly writeMode?: JwWriteModeName
  /** Whether the secret function is enabled. */
  readonly secret?: boolean
  /** Its clock. */
  readonly clock?: JwClockTime
}

/**
 * A client of one Sharp JW over the Ethernet of a JW-255CM or its relatives: see `createJwClient`.
 * @example
 * const plc = createJwClient({ host: '192.168.3.40', port: 10000, header: 'zero40' })
 * const level = await plc.read('09012:INT')
 */
export interface JwClient extends PlcClient<JwClientEvents, JwItemTypes> {
  /** As given. */
  readonly options: JwClientOptions
  /** Run state, stop and release, write mode. Changing needs `allowControl`. */
  readonly control: JwControl
  /** The clock. Setting needs `allowControl`. */
  readonly clock: JwClock
  /** Specified buffers and ring buffers. Needs `allowWrites`; defining them `allowParameters`. */
  readonly buffers: JwBuffers
  /** Parameters of option units and special I/O units. Writing needs `allowParameters`. */
  readonly parameters: JwParameters
  /** The secret function. Everything but its state needs `allowParameters`. */
  readonly secret: JwSecret

  /** What reading the item will touch, for people and editors. @throws RequestError when it is not an item. */
  explain(item: Item): JwItemExplanation
  /**
   * Sends any declared command. `write` needs `allowWrites`, `control` `allowControl`, `configure` `allowParameters`.
   * @example await plc.request(jwCommands.readDataMemory, { head: { file: 0, address: 0o4000 }, length: 4 })
   */
  request<C extends JwCommand>(command: C, message: JwRequestOf<C>, options?: CallOptions): Promise<JwResponseOf<C>>
  /**
   * Sends any declared command by its name or code, with its message as JSON: see `jwMessageFromJson`.
   * @example await plc.requestByName('readDataMemory', { head: '09000', length: 4 })
   */
  requestByName(name: string, message?: unknown, options?: CallOptions): Promise<Readonly<Record<string, unknown>>>
  /** What `requestByName` would send. @throws RequestError for what it would refuse before sending, but not permissions */
  explainRequest(name: string, message?: unknown): JwRequestExplanation
  /** Sends 1 to 1024 bytes and compares what comes back (80H of a JW300). @returns ms from sending to the answer. */
  selfTest(data?: Uint8Array, options?: CallOptions): Promise<{ readonly roundTrip: number }>
  /** Size of the program memory (4DH). */
  memorySize(options?: CallOptions): Promise<JwMemorySize>
  /** What the PLC says of itself: memory, run state, write mode, secret function, clock. */
  info(options?: CallOptions): Promise<JwInfo>
}
