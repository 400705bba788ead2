/**
 * What the nodes that use a connection share: how they are registered, how a message becomes a result or an error, and
 * that `done` is called exactly once. A node itself only says what to do with a message.
 */
import type { Node, NodeAPI, NodeDef, NodeMessage, NodeMessageInFlow } from 'node-red'
import { Busy, type BusyRuleOf } from './busy'
import { connectionOf, type PlcConnection } from './connection'
import { failureOf, type NodeFailure, refusal } from './failure'
import { type Migration, migrated, type StoredSettings } from './migration'
import { Display } from './status'
import { sharedTexts, type Texts } from './texts'

/** What a node works with. */
export interface Tools {
  readonly RED: NodeAPI
  readonly node: Node
  readonly texts: Texts
  readonly connection: PlcConnection
}

/** What came of a message. */
export interface Answer {
  /** To send from the only output, in this order. */
  readonly messages: readonly NodeMessage[]
  /** Items that failed while others were delivered. */
  readonly partly?: { readonly failed: number; readonly all: number }
  /** Nothing was delivered but that everything failed, for this reason. */
  readonly nothing?: NodeFailure
  /** Carried out, but whether it has its effect could not be looked at. */
  readonly unverified?: true
}

export type Work = (message: NodeMessageInFlow) => Promise<Answer>

/** A type of node that uses a connection. */
export interface UserType {
  readonly type: string
  readonly migrations: readonly Migration[]
  /** It may change the PLC: a deploy waits for what is under way, and no outcome is kept quiet. */
  readonly changesPlc: boolean | ((settings: StoredSettings) => boolean)
  /** What becomes of a message while one before it is under way. Without it each is worked on at once. */
  readonly busy?: (settings: StoredSettings, tools: Tools) => BusyRuleOf
  /** A deploy waits even where nothing is changed: something has to be put in order again. */
  readonly putsInOrder?: true
  /**
   * Reads the settings once.
   * @throws NodeFailure when they are wrong; every message then ends with it.
   */
  readonly prepare: (settings: StoredSettings, tools: Tools, display: Display) => Work
  /** What the editor knows of the library, so that nothing is written twice. Node-RED wants names such as `melsecJwReadTypes`. */
  readonly editorSettings?: Readonly<Record<string, { readonly value: unknown; readonly exportable: true }>>
  /** What Node-RED keeps apart from the flow and does not export. */
  readonly credentials?: Readonly<Record<string, { readonly type: 'password' }>>
}

export function registerUser(RED: NodeAPI, type: UserType): void {
  const { editorSettings, credentials } = type
  function construct(this: Node, stored: NodeDef): void {
    RED.nodes.createNode(this, stored)
    start(RED, this, type, { ...stored })
  }
  RED.nodes.registerType(type.type, construct, {
    ...(editorSettings === undefined ? {} : { settings: { ...editorSettings } }),
    ...(credentials === undefined ? {} : { credentials: { ...credentials } }),
  })
}

/** Settings at the version the node reads. @throws NodeFailure when a newer version of the package made them. */
export function readSettings(stored: StoredSettings, migrations: readonly Migration[], texts: Texts): StoredSettings {
  try {
    return migrated(stored, migrations)
  } catch {
    throw refusal('NOT_CONFIGURED', texts('error.newerVersion'))
  }
}

function start(RED: NodeAPI, node: Node, type: UserType, stored: StoredSettings): void {
  begin(RED, node, stored, type.migrations, (settings, tools, display) => {
    const work = type.prepare(settings, tools, display)
    const { connection, texts } = tools
    const changesPlc = typeof type.changesPlc === 'function' ? type.changesPlc(settings) : type.changesPlc
    const waits = changesPlc || type.putsInOrder === true
    const ruleOf = type.busy?.(settings, tools)
    const entrance = ruleOf && { ruleOf, busy: new Busy(texts, () => connection.current?.state.name === 'connected') }
    return () => serve(node, { work, connection, display, texts, changesPlc, waits, entrance })
  })
}

/**
 * Gives a node its connection and its status. With wrong settings it lives all the same, and says so.
 * @param prepare reads the settings before the node uses its connection; what it returns is called as soon as it does
 */
export function begin(
  RED: NodeAPI,
  node: Node,
  stored: StoredSettings,
  migrations: readonly Migration[],
  prepare: (settings: StoredSettings, tools: Tools, display: Display) => (() => void) | undefined,
): void {
  const texts = sharedTexts(RED)
  const display = new Display(node, texts)
  const connection = connectionOf(RED.nodes.getNode(String(stored.connection ?? '')))
  try {
    if (connection === undefined) throw refusal('NOT_CONFIGURED', texts('error.noConnection'))
    if (connection.failure !== undefined) throw connection.failure
    const settings = readSettings(stored, migrations, texts)
    const go = prepare(settings, { RED, node, texts, connection }, display)
    const leave = connection.join(display)
    node.on('close', () => {
      display.close()
      leave()
    })
    go?.()
  } catch (error) {
    refuseAll(node, display, failureOf(error, texts), connection?.failure !== undefined)
  }
}

/** The node lives, so that its status and a Catch node tell what is wrong. */
function refuseAll(node: Node, display: Display, failure: NodeFailure, logged: boolean): void {
  display.failed(failure)
  if (!logged) node.error(failure)
  node.on('input', (_message, _send, done) => done(failure))
}

interface Service {
  readonly work: Work
  readonly connection: PlcConnection
  readonly display: Display
  readonly texts: Texts
  readonly changesPlc: boolean
  /** Closing the connection waits for what is under way. */
  readonly waits: boolean
  readonly entrance: { readonly ruleOf: BusyRuleOf; readonly busy: Busy } | undefined
}

function serve(node: Node, service: Service): void {
  const { connection, entrance, waits } = service
  let closed = false
  node.on('close', () => {
    closed = true
    entrance?.busy.close()
  })
  node.on('input', (message, send, done) => {
    const work = async (): Promise<void> => {
      const handled = handle(service, message, send, done, () => closed || connection.closed)
      // What is wrong here is no result of the work, which handle() settles: it must be seen and must not end Node-RED.
      await handled.catch((error: unknown) => node.error(error))
    }
    const settled = entrance === undefined ? work() : enter(service, entrance, message, work, done)
    if (waits) connection.track(settled)
  })
}

/** Lets a message in when it is its turn. */
async function enter(
  { display, texts }: Service,
  { ruleOf, busy }: NonNullable<Service['entrance']>,
  message: NodeMessageInFlow,
  work: () => Promise<void>,
  done: Done,
): Promise<void> {
  try {
    await busy.enter(ruleOf(message), { read: work, skip: () => done() })
  } catch (error) {
    const failure = failureOf(error, texts)
    display.failed(failure)
    done(failure)
  }
}

type Send = (message: NodeMessage | (NodeMessage | NodeMessage[] | null)[]) => void
type Done = (error?: Error) => void

async function handle(
  { work, connection, display, texts, changesPlc, entrance }: Service,
  message: NodeMessageInFlow,
  send: Send,
  done: Done,
  closing: () => boolean,
): Promise<void> {
  let answer: Answer
  try {
    answer = await work(message)
  } catch (error) {
    const failure = failureOf(error, texts)
    display.failed(failure)
    // A value nobody waits for any more because of a deploy is no failure. A write is, whatever became of it.
    const unwanted = !changesPlc && closing() && (failure.code === 'CLOSED' || failure.code === 'ABORTED')
    done(unwanted ? undefined : failure)
    return
  }
  if (answer.nothing !== undefined) display.failed(answer.nothing)
  else if (answer.partly !== undefined) display.partly(answer.partly.failed, answer.partly.all)
  else if (answer.unverified === true) display.unverified()
  else display.succeeded(entrance?.busy.load(), () => connection.current?.statistics.roundTrip?.mean)
  const [first, ...more] = answer.messages
  if (first !== undefined) send(more.length === 0 ? first : [[...answer.messages]])
  done()
}
