// The client of a Sharp JW: one connection in the background, typed items on top of it.
import { isPlainObject } from '../../basics/option-checks'
import { RequestError } from '../../errors'
import type { JwCommand } from '../../jw/commands/commands'
import { jwCommands } from '../../jw/commands/commands'
import type { JwOperandOptions } from '../../jw/operand/map'
import { jwProtocol } from '../../jw/protocol'
import { jwExplainer } from '../../jw/trace-explainer'
import type { Exchange } from '../../link/link'
import type { TagDefinitions, TagTable } from '../../tags/table/table'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { Connection, type ConnectionState } from '../connection/connection'
import { Deadline } from '../connection/deadline'
import { Listeners } from '../connection/listeners'
import type { Statistics } from '../connection/statistics'
import { Tracer } from '../connection/trace'
import { isItem } from '../item/input-checks'
import type { EntriesIn, InputIn, InputsIn, ResultsIn, ValueIn, ValuesIn } from '../item/item-typing'
import type { Items, WriteEntry, WriteValue, WriteValues } from '../item/item-value'
import type { Item } from '../item/parts'
import { entriesOf } from '../item/plain-values'
import { checkAllWritten } from '../item/write-outcome'
import {
  optionsOfMany,
  planItems,
  readEachOf,
  readItems,
  readValuesOf,
  writeEachOf,
  writeItem,
} from '../plan/item-calls'
import type { ReadPlan, WritePlan } from '../plan/plans'
import type { WatchedIn } from '../plan/plc-client'
import type { PlcTags, TagsOptions } from '../plan/plc-tags'
import type { WriteCallOptions, WriteOptions, WriteResult } from '../plan/write'
import { type OpenCall, WriteTurns } from '../plan/write-turns'
import { ItemTags } from '../tags/item-tags'
import { tagReaderOf } from '../tags/tag-reader'
import type { Watch, WatchOptions } from '../watch/watch'
import { Watching } from '../watch/watching'
import { type JwBuffers, jwBuffers } from './buffers'
import type { JwClient, JwClientEvents, JwInfo, JwItemTypes, JwMemorySize } from './client'
import { type JwClock, jwClock } from './clock'
import { type JwCallParts, type JwControl, jwControl } from './control'
import { explainJwSilence } from './diagnosis'
import { jwInfo, jwMemorySize } from './info'
import { JwItemAccess, type JwItemExplanation } from './item-access'
import { checkMessageSize, type JwLimits, jwLimits } from './limits'
import { jwLine } from './line-of'
import { ListProof } from './list-proof'
import { explainJwRequest, type JwRequestExplanation, namedJwRequest } from './named-request'
import type { JwClientOptions } from './options'
import { type JwParameters, jwParameters } from './parameters'
import { jwNotPermitted } from './permission'
import { jwProbes } from './probes'
import { type JwSecret, jwSecret } from './secret'
import type { JwProtocol, JwRequestOf, JwResponseOf, SendJwCommand } from './send-command'
import { type JwSettings, settleJw } from './settings'

/** Node.js before 20.5 has no such symbol; programs for it bring one of this name. */
const asyncDispose: typeof Symbol.asyncDispose = Symbol.asyncDispose ?? Symbol.for('Symbol.asyncDispose')

const EVENTS = { state: true, trace: true } as const satisfies Record<keyof JwClientEvents, true>
const LOOPBACK = Buffer.from('0123456789ABCDEF')

type Watched<L extends Items> = WatchedIn<JwItemTypes, L>

export class JwPlcClient implements JwClient {
  readonly #settings: JwSettings
  readonly #protocol: JwProtocol
  readonly #limits: JwLimits
  readonly #connection: Connection
  readonly #listeners = new Listeners<JwClientEvents>(EVENTS, () => this.#traceIfWanted())
  readonly #tracer: Tracer
  readonly #turns = new WriteTurns()
  readonly #items: JwItemAccess
  readonly #parts: JwCallParts
  readonly #watching: Watching
  readonly options: JwClientOptions
  readonly control: JwControl
  readonly clock: JwClock
  readonly buffers: JwBuffers
  readonly parameters: JwParameters
  readonly secret: JwSecret

  constructor(options: JwClientOptions) {
    const settings = settleJw(options)
    this.options = options
    this.#settings = settings
    this.#protocol = jwProtocol(settings)
    this.#limits = jwLimits(this.#protocol, settings)
    this.#tracer = new Tracer(jwExplainer(settings), settings.transport === 'udp' ? 'datagram' : 'stream')
    this.#connection = new Connection(jwLine(settings, options, this.#protocol), {
      clock: settings.clock,
      supervisor: settings,
      queueLimit: settings.queueLimit,
      connectTimeout: settings.connectTimeout,
      timeout: settings.timeout,
      probes: jwProbes(this.#protocol, settings.probe),
      explainSilence: (silence) => explainJwSilence(settings, options, silence),
      onState: (state) => this.#changed(state),
      // No source knows of messages that a PLC sends unasked.
      onUnsolicited: () => {},
    })
    const send: SendJwCommand = async (command, message, call) => this.request(command, message, call)
    this.#parts = {
      send,
      clock: settings.clock,
      timeout: settings.timeout,
      permit: (effect, title) => this.#permit(effect, title),
    }
    this.control = jwControl(this.#parts)
    this.clock = jwClock(this.#parts)
    this.buffers = jwBuffers(send)
    this.parameters = jwParameters(this.#parts, this.#limits)
    this.secret = jwSecret(send)
    this.#items = new JwItemAccess({
      settings,
      protocol: this.#protocol,
      limits: this.#limits,
      lists: new ListProof(settings.lists),
      call: (call) => this.#call(call),
      permit: (effect, title) => this.#permit(effect, title),
    })
    this.#watching = new Watching(this.#items, settings.clock)
  }

  get state(): ConnectionState {
    return this.#connection.state
  }

  get statistics(): Statistics {
    return this.#connection.statistics
  }

  on<E extends keyof JwClientEvents>(event: E, listener: (event: JwClientEvents[E]) => void): () => void {
    return this.#listeners.on(event, listener)
  }

  once<E extends keyof JwClientEvents>(event: E, listener: (event: JwClientEvents[E]) => void): () => void {
    return this.#listeners.once(event, listener)
  }

  off<E extends keyof JwClientEvents>(event: E, listener: (event: JwClientEvents[E]) => void): void {
    this.#listeners.off(event, listener)
  }

  #traceIfWanted(): void {
    const tell: Connection['onTrace'] = (frame) => this.#listeners.tell('trace', this.#tracer.entry(frame))
    this.#connection.onTrace = this.#listeners.has('trace') ? tell : undefined
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
    this.#connection.close()
  }

  async [asyncDispose](): Promise<void> {
    await this.close()
  }

  read<const I extends Item>(item: I, options?: CallOptions): Promise<ValueIn<JwItemTypes, I>>
  read<const L extends Items>(items: L, options?: CallOptions): Promise<ResultsIn<JwItemTypes, L>>
  read(items: Item | Items, options?: CallOptions): Promise<unknown> {
    return readItems(this.#items, items, options)
  }

  readEach<const L extends Items>(items: L, options?: CallOptions): Promise<ResultsIn<JwItemTypes, L>>
  readEach(items: Items, options?: CallOptions): Promise<unknown> {
    return readEachOf(this.#items, items, options)
  }

  readValues<const L extends Items>(items: L, options?: CallOptions): Promise<ValuesIn<JwItemTypes, L>>
  readValues(items: Items, options?: CallOptions): Promise<unknown> {
    return readValuesOf(this.#items, items, options)
  }

  plan<const L extends Items>(items: L): ReadPlan<ResultsIn<JwItemTypes, L>>
  plan(items: Items): ReadPlan<unknown> {
    return planItems(this.#items, items)
  }

  watch<const L extends Items>(items: L, options: WatchOptions<Watched<L>>): Watch<Watched<L>>
  watch(items: Items, options: object): unknown {
    return this.#watching.open(items, options)
  }

  tags<const D extends TagDefinitions>(table: TagTable<D>, options?: TagsOptions): PlcTags<JwItemTypes, D>
  tags(table: TagTable, options?: TagsOptions): unknown {
    return new ItemTags({ source: this.#items, watching: this.#watching, readItem: tagReaderOf(this) }, table, options)
  }

  explain(item: Item): JwItemExplanation {
    return this.#items.explain(item)
  }

  write<const L extends readonly Item[], A extends string>(
    values: EntriesIn<JwItemTypes, L> | InputsIn<JwItemTypes, A>,
    options?: WriteCallOptions,
  ): Promise<void>
  write<const I extends Item>(item: I, value: InputIn<JwItemTypes, I>, options?: WriteCallOptions): Promise<void>
  async write(
    target: Item | WriteValues,
    second?: WriteValue | WriteCallOptions,
    third?: WriteCallOptions,
  ): Promise<void> {
    if (isItem(target)) return writeItem(this.#items, target, second as WriteValue, third)
    const options = optionsOfMany(second as WriteCallOptions | undefined, third)
    return this.#writeMany(target, options)
  }

  writeValues<const L extends readonly Item[], A extends string>(
    values: EntriesIn<JwItemTypes, L> | InputsIn<JwItemTypes, A>,
    options?: WriteCallOptions,
  ): Promise<void>
  writeValues(values: WriteValues, options?: WriteCallOptions): Promise<void> {
    return this.#writeMany(values, options)
  }

  async #writeMany(values: WriteValues, options?: WriteCallOptions): Promise<void> {
    checkOrder(values)
    checkAllWritten(await this.#items.write(entriesOf(values), options))
  }

  writeEach<const L extends readonly Item[]>(
    entries: EntriesIn<JwItemTypes, L>,
    options?: WriteCallOptions,
  ): Promise<WriteResult[]>
  writeEach<A extends string>(
    values: InputsIn<JwItemTypes, A>,
    options?: WriteCallOptions,
  ): Promise<Record<A, WriteResult>>
  async writeEach(values: WriteValues, options?: WriteCallOptions): Promise<unknown> {
    checkOrder(values)
    return writeEachOf(this.#items, values, options)
  }

  planWrite<const L extends readonly Item[]>(entries: EntriesIn<JwItemTypes, L>, options?: WriteOptions): WritePlan
  planWrite(entries: readonly WriteEntry[], options: WriteOptions = {}): WritePlan {
    return this.#items.planWrite(entries, options)
  }

  /** One call: all its requests share one absolute deadline. @throws RequestError BAD_OPTION */
  #call(options: CallOptions | undefined): OpenCall {
    const { clock, timeout } = this.#settings
    const deadline = new Deadline(clock, options && callOptionsOf(options), timeout)
    return this.#turns.open(deadline, (exchange) => {
      this.#permit(exchange.effect, exchange.title)
      checkMessageSize(exchange, this.#settings)
      return this.#connection.request(exchange, deadline.options(exchange.title))
    })
  }

  #permit(effect: Exchange<unknown>['effect'], title: string): void {
    const { allowWrites, allowControl, allowParameters } = this.#settings
    if (effect === 'write' && !allowWrites) throw jwNotPermitted(title, 'allowWrites')
    if (effect === 'control' && !allowControl) throw jwNotPermitted(title, 'allowControl')
    if (effect === 'configure' && !allowParameters) throw jwNotPermitted(title, 'allowParameters')
  }

  async request<C extends JwCommand>(
    command: C,
    message: JwRequestOf<C>,
    options?: CallOptions,
  ): Promise<JwResponseOf<C>> {
    const { send } = this.#call(options)
    checkJwRequest(command, message)
    return send(this.#protocol.exchange(command, message))
  }

  async requestByName(
    name: string,
    message: unknown = {},
    options?: CallOptions,
  ): Promise<Readonly<Record<string, unknown>>> {
    const named = namedJwRequest(name, message, this.#operands)
    return this.request(named.command, named.message, options)
  }

  explainRequest(name: string, message: unknown = {}): JwRequestExplanation {
    const named = namedJwRequest(name, message, this.#operands)
    this.#protocol.exchange(named.command, named.message)
    return explainJwRequest(named)
  }

  get #operands(): JwOperandOptions {
    const { areas } = this.#settings
    return areas === undefined ? {} : { areas }
  }

  async selfTest(data: Uint8Array = LOOPBACK, options?: CallOptions): Promise<{ readonly roundTrip: number }> {
    const { clock, timeout } = this.#settings
    const deadline = new Deadline(clock, options && callOptionsOf(options), timeout)
    const exchange = this.#protocol.exchange(jwCommands.loopback, { data })
    checkMessageSize(exchange, this.#settings)
    return { roundTrip: await this.#connection.roundTrip(exchange, deadline.options(exchange.title)) }
  }

  memorySize(options?: CallOptions): Promise<JwMemorySize> {
    return jwMemorySize(this.#parts.send, options)
  }

  info(options?: CallOptions): Promise<JwInfo> {
    return jwInfo(this.#parts, options)
  }
}

/**
 * JavaScript moves names that are whole numbers, as 19000 is, to the front of an object: the order in which it was written down,
 * and in which it would have to be sent, is lost.
 * @throws RequestError BAD_OPTION
 */
function checkOrder(values: WriteValues): void {
  if (typeof values !== 'object' || values === null || Array.isArray(values)) return
  const names = Object.keys(values)
  const moved = names.find((name) => /^(0|[1-9]\d*)$/.test(name))
  if (moved === undefined || names.length < 2) return
  const message = `In an object ${moved} comes first wherever it was written down, because it is a whole number to JavaScript, so that the order is lost. Give a list of entries: [{ item, value }, ...].`
  throw new RequestError('BAD_OPTION', message, moved)
}

/** What programs without types pass. @throws RequestError BAD_MESSAGE */
function checkJwRequest(command: JwCommand, message: unknown): void {
  const isDeclared = isPlainObject(command) && Object.values<unknown>(jwCommands).includes(command)
  if (!isDeclared) {
    throw new RequestError(
      'BAD_MESSAGE',
      'request() takes a declared command, e.g. jwCommands.readDataMemory.',
      'command',
    )
  }
  if (isPlainObject(message)) return
  throw new RequestError(
    'BAD_MESSAGE',
    `The message of ${command.title} is an object, not a value of type ${typeof message}.`,
  )
}

/**
 * Makes a client of a Sharp JW. Nothing is connected before the first call or `connect()`.
 * @throws RequestError BAD_OPTION naming the option that is wrong.
 * @example const plc = createJwClient({ host: '192.168.3.40', port: 10000, header: 'zero40' })
 */
export function createJwClient(options: JwClientOptions): JwClient {
  return new JwPlcClient(options)
}
