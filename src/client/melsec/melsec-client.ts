// The client of a MELSEC PLC: one connection in the background, typed items on top of it.
import type { DataCode } from '../../codec/codec'
import type { Exchange, RequestFrame } from '../../link/link'
import type { ClientProtocol } from '../../melsec/client-protocol'
import { clientProtocolOf } from '../../melsec/client-protocols'
import type { Command, RequestOf, ResponseOf } from '../../melsec/commands/command'
import { commands } from '../../melsec/commands/commands'
import type { Notation } from '../../melsec/device/json'
import { extendUnitOf, type ModulePlace } from '../../melsec/extend-unit'
import type { ProfileInfo } from '../../melsec/profiles/profile'
import type { ExchangeOptions } from '../../melsec/protocol'
import { isPasswordRefusal, isPortLocked } from '../../melsec/remote-password'
import type { TagDefinitions, TagTable } from '../../tags/table/table'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { Connection, type ConnectionState } from '../connection/connection'
import { Deadline } from '../connection/deadline'
import { Listeners } from '../connection/listeners'
import type { Statistics } from '../connection/statistics'
import { Tracer } from '../connection/trace'
import { FileAccess, type Files } from '../file/files'
import { checkRequest, isItem, isList } from '../item/input-checks'
import type { MelsecItems } from '../item/item-typing'
import type {
  ItemInput,
  ItemInputs,
  ItemResults,
  Items,
  ItemValue,
  ItemValues,
  WriteEntries,
  WriteValue,
  WriteValues,
} from '../item/item-value'
import type { Item } from '../item/parts'
import { entriesOf } from '../item/plain-values'
import { checkAllWritten } from '../item/write-outcome'
import type { ItemExplanation } from '../label/explain'
import { type Labels, labelsOf } from '../label/labels'
import {
  optionsOfMany,
  planItems,
  readEachOf,
  readItems,
  readValuesOf,
  writeEachOf,
  writeItem,
} from '../plan/item-calls'
import { type Monitor, namedMonitor, Registration } from '../plan/monitor'
import type { ReadPlan, WritePlan } from '../plan/plans'
import type { WatchedIn } from '../plan/plc-client'
import type { PlcTags, TagsOptions } from '../plan/plc-tags'
import type { WriteCallOptions, WriteOptions, WriteResult } from '../plan/write'
import { type OpenCall, WriteTurns } from '../plan/write-turns'
import { ItemTags } from '../tags/item-tags'
import { tagReaderOf } from '../tags/tag-reader'
import type { Watch, WatchOptions } from '../watch/watch'
import { Watching } from '../watch/watching'
import { type BufferMemory, memoryOf, moduleOf } from './buffer-memory'
import type { MelsecClient } from './client'
import type { ClientEvents } from './client-events'
import { type Control, controlOf, type Identity, identify, selfTestOf } from './control'
import { explainSilence } from './diagnosis'
import { filePartsOf } from './file-calls'
import { ItemAccess } from './item-access'
import { lineOf } from './line-of'
import {
  EXCHANGE_OPTIONS,
  explainRequest,
  FORM_OPTION,
  type NamedRequest,
  namedRequest,
  type RequestExplanation,
} from './named-request'
import { checkOnDemand, unsolicitedOf } from './on-demand'
import type { MelsecClientOptions } from './options'
import { notPermitted, onSharedLine, overUdp } from './permission'
import { probesOf } from './probes'
import { RemotePassword } from './remote-password'
import type { SendCommand } from './send-command'
import { serialLinkOf } from './serial-settings'
import { type Settings, settle } from './settings'

/** Node.js before 20.5 has no such symbol; programs for it bring one of this name. */
const asyncDispose: typeof Symbol.asyncDispose = Symbol.asyncDispose ?? Symbol.for('Symbol.asyncDispose')

/** ms that closing may wait for the PLC to close open files, and to lock itself: over TCP the end of the connection does. */
const CLOSING_TIME = 500

const EVENTS = {
  state: true,
  trace: true,
  onDemand: true,
  unsolicited: true,
} as const satisfies Record<keyof ClientEvents, true>

type Watched<L extends Items> = WatchedIn<MelsecItems, L>

export class MelsecPlcClient implements MelsecClient {
  readonly #settings: Settings
  readonly #protocol: ClientProtocol
  readonly #connection: Connection
  readonly #listeners = new Listeners<ClientEvents>(EVENTS, () => this.#traceIfWanted())
  readonly #tracer: Tracer
  readonly #registration: Registration
  readonly #send: SendCommand
  readonly #turns = new WriteTurns()
  readonly #items: ItemAccess
  readonly #files: FileAccess
  readonly #password: RemotePassword
  readonly #watching: Watching
  readonly options: Omit<MelsecClientOptions, 'password'>
  readonly control: Control
  readonly labels: Labels
  readonly memory: BufferMemory
  readonly files: Files

  constructor(given: MelsecClientOptions) {
    const settings = settle(given)
    const { password, ...options } = given
    this.options = options
    this.#settings = settings
    this.#protocol = clientProtocolOf({ ...settings, asciiZr: options.asciiZr })
    this.#password = new RemotePassword(this.#protocol, password)
    const kind = settings.transport === 'udp' ? 'datagram' : 'stream'
    this.#tracer = new Tracer(this.#protocol.explainer(settings), kind)
    this.#connection = new Connection(lineOf(settings, options, this.#protocol), {
      clock: settings.clock,
      supervisor: settings,
      queueLimit: settings.queueLimit,
      connectTimeout: settings.connectTimeout,
      timeout: settings.timeout,
      messageWait: settings.serial?.messageWait ?? 0,
      unlocking: { exchange: () => this.#password.unlock(), isFinal: isPasswordRefusal, isLocked: isPortLocked },
      probes: probesOf(this.#protocol, settings.probe),
      explainSilence: (silence) =>
        explainSilence(
          {
            ...settings,
            port: options.port,
            localPort: options.localPort,
            frames: settings.profile.frames,
            link: serialLinkOf(settings.serialLine, settings.serial),
          },
          silence,
        ),
      onState: (state) => this.#changed(state),
      onUnsolicited: (frame) => this.#cameUnasked(frame),
    })
    this.#registration = new Registration(() => this.#connection.generation)
    this.#send = async (command, message, call) => this.request(command, message, callOptionsOf(call))
    const { clock, timeout } = settings
    this.control = controlOf({
      send: this.#send,
      sendExchange: (exchange, call) => this.#call(call).send(exchange),
      protocol: this.#protocol,
      profile: this.#protocol.profile,
      clock,
      timeout,
    })
    this.labels = labelsOf({
      call: (call) => {
        const { send } = this.#call(call)
        return {
          protocol: this.#protocol,
          send: async (command, message) => send(this.#protocol.exchange(command, message)),
        }
      },
      permitWrite: () => this.#permit('write', 'Writing'),
      time: () => settings.clock.time(),
      format: settings.labelFormat,
    })
    this.#items = new ItemAccess({
      settings,
      protocol: this.#protocol,
      registration: this.#registration,
      call: (call) => this.#call(call),
      permit: (effect, title) => this.#permit(effect, title),
    })
    this.#watching = new Watching(this.#items, clock)
    this.memory = memoryOf(this.#send)
    this.#files = new FileAccess(
      filePartsOf({
        settings,
        options,
        protocol: this.#protocol,
        connection: this.#connection,
        permit: (effect, title) => this.#permit(effect, title),
      }),
    )
    this.files = this.#files
  }

  get profile(): ProfileInfo {
    return this.#settings.profile
  }

  get code(): DataCode {
    return this.#settings.code
  }

  get state(): ConnectionState {
    return this.#connection.state
  }

  get statistics(): Statistics {
    return this.#connection.statistics
  }

  on<E extends keyof ClientEvents>(event: E, listener: (event: ClientEvents[E]) => void): () => void {
    if (event === 'onDemand') checkOnDemand(this.#protocol, this.#settings, this.options)
    return this.#listeners.on(event, listener)
  }

  once<E extends keyof ClientEvents>(event: E, listener: (event: ClientEvents[E]) => void): () => void {
    if (event === 'onDemand') checkOnDemand(this.#protocol, this.#settings, this.options)
    return this.#listeners.once(event, listener)
  }

  off<E extends keyof ClientEvents>(event: E, listener: (event: ClientEvents[E]) => void): void {
    this.#listeners.off(event, listener)
  }

  #traceIfWanted(): void {
    const tell: Connection['onTrace'] = (frame) => this.#listeners.tell('trace', this.#tracer.entry(frame))
    this.#connection.onTrace = this.#listeners.has('trace') ? tell : undefined
  }

  #cameUnasked(request: RequestFrame): void {
    const read = this.#protocol.readUnasked?.(request)
    if (read === undefined) return
    const { frame, onDemand } = unsolicitedOf(read, request.body, this.#settings.clock.time())
    this.#listeners.tell('unsolicited', frame)
    if (onDemand !== undefined) this.#listeners.tell('onDemand', onDemand)
  }

  #changed(state: ConnectionState): void {
    // What a trace was putting together does not go on behind another connection.
    if (state.name !== 'connected') this.#tracer.reset()
    this.#watching.stateChanged(state)
    this.#listeners.tell('state', state)
  }

  async connect(options: CallOptions = {}): Promise<void> {
    return this.#connection.connect(callOptionsOf(options))
  }

  async close(): Promise<void> {
    this.#watching.close()
    const released = this.#files.release()
    if (released !== undefined) await this.#soon(released)
    const lock = this.#password.lock()
    if (lock === undefined) this.#connection.close()
    else await this.#connection.finish(lock, CLOSING_TIME)
  }

  async [asyncDispose](): Promise<void> {
    await this.close()
  }

  /** A courtesy to the PLC: whether it comes to its end or not, nobody waits long for it. */
  #soon(work: Promise<unknown>): Promise<void> {
    const deadline = new Deadline(this.#settings.clock, {}, CLOSING_TIME)
    return deadline.wait(work, 'Closing').catch(() => {})
  }

  setPassword(password: string | undefined): void {
    this.#password.set(password)
    this.#connection.retry()
  }

  read<const I extends Item>(item: I, options?: CallOptions): Promise<ItemValue<I>>
  read<const L extends Items>(items: L, options?: CallOptions): Promise<ItemResults<L>>
  read(items: Item | Items, options?: CallOptions): Promise<unknown> {
    return readItems(this.#items, items, options)
  }

  readEach<const L extends Items>(items: L, options?: CallOptions): Promise<ItemResults<L>>
  readEach(items: Items, options?: CallOptions): Promise<unknown> {
    return readEachOf(this.#items, items, options)
  }

  readValues<const L extends Items>(items: L, options?: CallOptions): Promise<ItemValues<L>>
  readValues(items: Items, options?: CallOptions): Promise<unknown> {
    return readValuesOf(this.#items, items, options)
  }

  plan<const L extends Items>(items: L): ReadPlan<ItemResults<L>>
  plan(items: Items): ReadPlan<unknown> {
    return planItems(this.#items, items)
  }

  /** One call: all its requests share one absolute deadline. @throws RequestError BAD_OPTION */
  #call(options: CallOptions | undefined): OpenCall {
    const { clock, timeout } = this.#settings
    const deadline = new Deadline(clock, options && callOptionsOf(options), timeout)
    return this.#turns.open(deadline, (exchange) => {
      this.#permit(exchange.effect, exchange.title)
      return this.#connection.request(exchange, deadline.ofRequest(exchange.title))
    })
  }

  explain(item: Item): ItemExplanation {
    return this.#items.explain(item)
  }

  write<const L extends readonly Item[], A extends string>(
    values: WriteEntries<L> | ItemInputs<A>,
    options?: WriteCallOptions,
  ): Promise<void>
  write<const I extends Item>(item: I, value: ItemInput<I>, options?: WriteCallOptions): Promise<void>
  async write(
    target: Item | WriteValues,
    second?: WriteValue | WriteCallOptions,
    third?: WriteCallOptions,
  ): Promise<void> {
    if (!isItem(target)) return this.writeValues(target, optionsOfMany(second as WriteCallOptions | undefined, third))
    await writeItem(this.#items, target, second as WriteValue, third)
  }

  async writeValues<const L extends readonly Item[], A extends string>(
    values: WriteEntries<L> | ItemInputs<A>,
    options?: WriteCallOptions,
  ): Promise<void> {
    checkAllWritten(await this.#items.write(entriesOf(values), options))
  }

  writeEach<const L extends readonly Item[]>(
    entries: WriteEntries<L>,
    options?: WriteCallOptions,
  ): Promise<WriteResult[]>
  writeEach<A extends string>(values: ItemInputs<A>, options?: WriteCallOptions): Promise<Record<A, WriteResult>>
  writeEach(values: WriteValues, options?: WriteCallOptions): Promise<unknown> {
    return writeEachOf(this.#items, values, options)
  }

  planWrite<const L extends readonly Item[]>(entries: WriteEntries<L>, options: WriteOptions = {}): WritePlan {
    return this.#items.planWrite(entries, options)
  }

  monitor<const L extends Items>(items: L): Monitor<ItemResults<L>>
  monitor(items: Items): Monitor<unknown> {
    return isList(items) ? this.#items.monitor(items) : namedMonitor(items, (list) => this.#items.monitor(list))
  }

  watch<const L extends Items>(items: L, options: WatchOptions<Watched<L>>): Watch<Watched<L>>
  watch(items: Items, options: object): unknown {
    return this.#watching.open(items, options)
  }

  tags<const D extends TagDefinitions>(table: TagTable<D>, options?: TagsOptions): PlcTags<MelsecItems, D>
  tags(table: TagTable, options?: TagsOptions): unknown {
    return new ItemTags({ source: this.#items, watching: this.#watching, readItem: tagReaderOf(this) }, table, options)
  }

  async request<C extends Command>(
    command: C,
    message: RequestOf<C>,
    options: CallOptions & ExchangeOptions = {},
  ): Promise<ResponseOf<C>> {
    const { deadline, send } = this.#call(callOptionsOf(options, EXCHANGE_OPTIONS))
    checkRequest(command, message, options.form)
    const exchange = this.#protocol.exchange(command, message, options)
    if (command.name !== commands.entryMonitorDevice.name) return send(exchange)
    // The place of a monitor's registration is taken, in its turn: no monitor may read these devices for its own.
    return this.#registration.inTurn(deadline, command.title, () => {
      this.#registration.lose()
      return send(exchange)
    })
  }

  get notation(): Notation {
    const { xyRadix, wRadix, xyUnknown } = this.#settings
    return xyUnknown ? { wRadix } : { xyRadix, wRadix }
  }

  async requestByName(
    name: string,
    message: unknown = {},
    options: CallOptions & Pick<ExchangeOptions, 'form'> = {},
  ): Promise<Readonly<Record<string, unknown>>> {
    const call = callOptionsOf(options, FORM_OPTION)
    const named = namedRequest(name, message, this.notation)
    if (named.before === undefined) return this.request(named.command, named.message, options)
    const { deadline, send } = this.#call(call)
    const [registering, asking] = this.#exchangesOf(named, options)
    return this.#registration.inTurn(deadline, asking.title, async () => {
      this.#registration.lose()
      if (registering !== undefined) await send(registering)
      return send(asking)
    })
  }

  explainRequest(name: string, message: unknown = {}): RequestExplanation {
    const named = namedRequest(name, message, this.notation)
    this.#exchangesOf(named, {})
    return explainRequest(named, this.notation)
  }

  #exchangesOf({ command, message, before }: NamedRequest, options: Pick<ExchangeOptions, 'form'>) {
    if (before === undefined) return [undefined, this.#protocol.exchange(command, message, options)] as const
    if (this.#settings.transport === 'udp') throw overUdp(command.title)
    if (this.#settings.serialLine?.isShared === true) throw onSharedLine(command.title)
    const registering = this.#protocol.exchange(before.command, before.message, options)
    const context = registering.message
    return [registering, this.#protocol.exchange(command, message, { ...options, context })] as const
  }

  #permit(effect: Exchange<unknown>['effect'], title: string): void {
    if (effect === 'write' && !this.#settings.allowWrites) throw notPermitted(title, 'allowWrites')
    // No MELSEC command configures, but a declaration of one's own may.
    const isControl = effect === 'control' || effect === 'configure'
    if (isControl && !this.#settings.allowControl) throw notPermitted(title, 'allowControl')
  }

  identify(options?: CallOptions): Promise<Identity> {
    return identify(this.#send, this.#settings.profile, this.#settings.wRadix, options)
  }

  async selfTest(data?: string, options?: CallOptions): Promise<{ readonly roundTrip: number }> {
    const { deadline } = this.#call(options)
    const exchange = selfTestOf(this.#protocol, data)
    return { roundTrip: await this.#connection.roundTrip(exchange, deadline.ofRequest(exchange.title)) }
  }

  module(model: string, place: ModulePlace): BufferMemory {
    return moduleOf(this.#send, extendUnitOf(model, place))
  }

  async clearError(options?: CallOptions): Promise<void> {
    await this.#send(commands.clearError, {}, options)
  }
}

/**
 * Makes a client. Nothing is connected before the first call or `connect()`.
 * @throws RequestError BAD_OPTION naming the option that is wrong.
 * @example const plc = createMelsecClient({ host: '192.168.3.39', port: 5007, profile: 'iq-f' })
 */
export function createMelsecClient(options: MelsecClientOptions): MelsecClient {
  return new MelsecPlcClient(options)
}
