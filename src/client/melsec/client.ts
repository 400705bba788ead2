// What the client of a MELSEC PLC can do, beside what every client can.
import type { DataCode } from '../../codec/codec'
import type { Command, RequestOf, ResponseOf } from '../../melsec/commands/command'
import type { Notation } from '../../melsec/device/json'
import type { ModulePlace } from '../../melsec/extend-unit'
import type { ProfileInfo } from '../../melsec/profiles/profile'
import type { ExchangeOptions } from '../../melsec/protocol'
import type { CallOptions } from '../connection/call'
import type { Files } from '../file/files'
import type { MelsecItems } from '../item/item-typing'
import type { ItemResults, Items } from '../item/item-value'
import type { Item } from '../item/parts'
import type { ItemExplanation } from '../label/explain'
import type { Labels } from '../label/labels'
import type { Monitor } from '../plan/monitor'
import type { PlcClient } from '../plan/plc-client'
import type { BufferMemory } from './buffer-memory'
import type { ClientEvents } from './client-events'
import type { Control, Identity } from './control'
import type { RequestExplanation } from './named-request'
import type { MelsecClientOptions } from './options'

/**
 * A client of one MELSEC PLC over SLMP (3E, 4E or station extension frame) or in 1E frames: see `createMelsecClient`.
 * @example
 * const plc = createMelsecClient({ host: '192.168.3.39', port: 5007, profile: 'iq-r' })
 * const level = await plc.read('D100:REAL')
 */
export interface MelsecClient extends PlcClient<ClientEvents, MelsecItems> {
  /** As given, without the password. */
  readonly options: Omit<MelsecClientOptions, 'password'>
  /** The family of PLCs it speaks to, with the overrides merged in. */
  readonly profile: ProfileInfo
  /** Data code in use: that of the options, else the profile's. */
  readonly code: DataCode
  /** How X, Y and W are numbered in addresses; without X and Y where nobody knows. */
  readonly notation: Notation
  /** Remote RUN, STOP, PAUSE, latch clear and reset. Needs `allowControl`. */
  readonly control: Control
  /** Global labels by name (iQ-R). Writing needs `allowWrites`. */
  readonly labels: Labels
  /** Buffer memory of the connected module itself: Memory (0613, 1613). */
  readonly memory: BufferMemory
  /** Files on the drives of the CPU. Everything but reading needs `allowWrites`. */
  readonly files: Files

  /**
   * Another remote password, from the next connection on. After a refusal this is what makes the client try again.
   * `undefined`: the PLC has none. @throws RequestError BAD_OPTION
   */
  setPassword(password: string | undefined): void
  /** What reading the item will touch, for people and editors. @throws RequestError when it is not an item. */
  explain(item: Item): ItemExplanation
  /**
   * Items that are registered in the PLC once and then read with a request that names none of them (0801, 0802).
   * Where the profile has no monitor commands, Read Random is used instead and `note` says so.
   * @example const { level } = await plc.monitor({ level: 'D100:REAL', running: 'M10' }).read()
   */
  monitor<const L extends Items>(items: L): Monitor<ItemResults<L>>
  /**
   * Sends any declared command.
   * @example await plc.request(commands.readWords, { head: { device: 'D', number: 100 }, points: 2 })
   */
  request<C extends Command>(
    command: C,
    message: RequestOf<C>,
    options?: CallOptions & ExchangeOptions,
  ): Promise<ResponseOf<C>>
  /**
   * Sends any declared command by its name or code, with its message as JSON: see `messageFromJson`. Execute Monitor also
   * takes the message of its registration, which is sent before it.
   * @example await plc.requestByName('readWords', { head: 'D100', points: 2 })   // { values: [..., ...] }
   */
  requestByName(
    name: string,
    message?: unknown,
    options?: CallOptions & Pick<ExchangeOptions, 'form'>,
  ): Promise<Readonly<Record<string, unknown>>>
  /** What `requestByName` would send. @throws RequestError for what it would refuse before sending, but not permissions */
  explainRequest(name: string, message?: unknown): RequestExplanation
  /** Who the PLC says it is, with what its model code means. */
  identify(options?: CallOptions): Promise<Identity>
  /** Sends characters 0-9, A-F (1 to 960) to the connected module and back. @returns ms from sending to the answer. */
  selfTest(data?: string, options?: CallOptions): Promise<{ readonly roundTrip: number }>
  /**
   * Buffer memory of a MELSEC-Q module on the base: Extend Unit (0601, 1601). Nothing is sent yet.
   * @throws RequestError BAD_OPTION when the module is not in the manual's table
   * @example const [setting] = await plc.module('Q62DA', { startIo: 0x30 }).read(0x18, 1)
   */
  module(model: string, place: ModulePlace): BufferMemory
  /** Clears the error codes of the connected module and turns its error LED off. Needs `allowControl`. */
  clearError(options?: CallOptions): Promise<void>
}
