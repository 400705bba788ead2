/**
 * `POST /melsec-jw/connection/test`: connects, asks the CPU who it is and measures the round trip.
 * `POST /melsec-jw/connection/find`: tries which frames and data codes are answered; on a serial line, which stations answer, else in which form.
 *
 * Body: `{ id, settings, line? }`: the connection node and its settings as they stand in the dialog, also before they are
 * deployed, and those of its serial line. So the host is whatever the user typed: whoever may call this may deploy flows that connect anywhere, and
 * needs the permission `melsec-jw.write`. One test at a time, and none without an end.
 */
import type { NodeAPI } from 'node-red'
import {
  type CallOptions,
  ConnectionError,
  EndCodeError,
  type Identity,
  type JwClientOptions,
  type JwInfo,
  type MelsecClient,
  type MelsecOptions,
  type PlcError,
  type PlcOnLine,
  ProtocolError,
  RequestError,
  TimeoutError,
} from '../src/index'
import { endpoint, objectIn, type Reply } from './admin'
import { withoutCauses } from './causes'
import { type PlcConnection, peerOf } from './connection'
import { type AnsweringLine, answeringLines } from './connection-find'
import { familyOf, isOnLine, jwOptions, LINE_PROFILE, optionsOf, settingsOf } from './connection-settings'
import { detailsOf, type FailureDetails } from './failure'
import { type FailureCode, isBadAnswer } from './failure-code'
import { type AnyPlc, clientOf, type FamilyName, type FamilyOptions, forFamily } from './family'
import { resolverOf } from './fields'
import { type AnsweringForm, answeringForms } from './form-find'
import { type AnsweringHeader, answeringHeader, jwIdentity, jwRounds } from './jw-test'
import { lineToTest, type TestedLine } from './line-test'
import type { StoredSettings } from './migration'
import { type AnsweringStation, answeringStations, profileOnLine } from './station-find'
import type { Texts } from './texts'

/** ms: how long connecting may take; a PLC that is off answers nothing at all. */
const CONNECT = 8_000
/** ms for each question. */
const QUESTION = 3_000
const ROUNDS = 10
/** ms: longest for a search, which asks up to 32 stations of a line that is in use. */
const SEARCH = 60_000
/** ms for all of them: on a slow line a few must do. */
const ENOUGH = 5_000

/** The port is there, and another way to speak to it may be answered. */
const MAY_FIND: readonly FailureCode[] = ['SILENT', 'TIMEOUT', 'DISCONNECTED', 'ENTRY_BUSY', 'OFFLINE']

/** How a PLC turns away one connection more than it has entries for. */
const TURNED_AWAY: readonly FailureCode[] = ['ENTRY_BUSY', 'CONNECT_FAILED', 'DISCONNECTED']

export interface TestResult extends Partial<Identity> {
  readonly ok: true
  /** What a Sharp JW says of itself. */
  readonly jw?: JwInfo
  /** ms */
  readonly roundTrip: { readonly min: number; readonly mean: number; readonly max: number; readonly count: number }
  /** Why the CPU did not say who it is. */
  readonly unidentified?: string
}

export interface TestFailure extends FailureDetails {
  readonly ok: false
  readonly causes: readonly string[]
  /** Something is there, so it may be worth to try other frames and data codes. */
  readonly mayFind: boolean
}

export function connectionTest(RED: NodeAPI, texts: Texts, deployed: (id: string) => PlcConnection | undefined): void {
  let busy = false
  endpoint(RED, '/melsec-jw/connection/test', 'melsec-jw.write', texts, (body, over) =>
    alone(() => outcome(RED, texts, body, over, deployed)),
  )
  const finding = { permission: 'melsec-jw.write', patience: SEARCH }
  endpoint(RED, '/melsec-jw/connection/find', finding, texts, (body, over) =>
    alone(() => found(RED, texts, body, over, deployed)),
  )

  async function alone(work: () => Promise<object>): Promise<Reply> {
    if (busy) return { status: 409, body: { message: texts('error.testBusy') } }
    busy = true
    try {
      return { status: 200, body: await work() }
    } finally {
      busy = false
    }
  }
}

async function outcome(
  RED: NodeAPI,
  texts: Texts,
  body: StoredSettings,
  over: AbortSignal,
  deployed: (id: string) => PlcConnection | undefined,
): Promise<TestResult | TestFailure> {
  const id = typeof body.id === 'string' ? body.id : ''
  const connection = deployed(id)
  let peer = ''
  let port: number | undefined
  let family: FamilyName = 'melsec'
  try {
    const given = givenIn(RED, id, body, texts)
    family = given.family
    peer = peerOf(given.options)
    port = given.options.port
    const running = connected(connection, given)
    if (running !== undefined) return await ask(running, over, isLineOf(given))
    const plc = clientOf(withPatience(given))
    try {
      return await ask(plc, over, isLineOf(given))
    } finally {
      await plc.client.close()
    }
  } catch (error) {
    const details = detailsOf(error, texts)
    const { code, causes = [] } = details
    const strange = isBadAnswer(code) || badAnswerBehind(error)
    const further = strange && causes.length === 0 && port !== undefined ? strangers(family, port, texts) : causes
    const ours = isUp(connection) && TURNED_AWAY.includes(code)
    const message = shortMessage(details, peer, texts, port === undefined)
    return {
      ok: false,
      ...details,
      message,
      causes: ours ? [texts('error.entryHeld'), ...further] : further,
      mayFind: MAY_FIND.includes(code) || strange,
    }
  }
}

/** Why something answers that is not what was expected. */
function strangers(family: FamilyName, port: number, texts: Texts): string[] {
  return {
    melsec: [texts('test.otherService', { port }), texts('test.otherLine')],
    jw: [texts('test.otherServiceJw', { port }), texts('test.otherHeader')],
  }[family]
}

/** With its causes a message is long, and they are listed below it. */
function shortMessage(
  { code, message, causes = [] }: FailureDetails,
  peer: string,
  texts: Texts,
  isLine: boolean,
): string {
  if (code !== 'SILENT' || causes.length === 0) return withoutCauses(message, causes, texts)
  return texts(isLine ? 'test.silentLine' : 'test.silent', { peer })
}

/** A connection that ended because of what came over it. */
function badAnswerBehind(error: unknown): boolean {
  for (let cause = error, depth = 0; cause instanceof Error && depth < 5; cause = cause.cause, depth++) {
    if (cause instanceof ProtocolError) return true
  }
  return false
}

/** What `POST /melsec-jw/connection/find` answers. */
type Found =
  | { readonly ok: true; readonly lines: readonly AnsweringLine[] }
  | { readonly ok: true; readonly headers: readonly AnsweringHeader[] }
  | { readonly ok: true; readonly stations: readonly AnsweringStation[] }
  | { readonly ok: true; readonly station: number; readonly forms: readonly AnsweringForm[] }
  | { readonly ok: false; readonly message: string; readonly causes: readonly string[] }

/** Which frames and data codes the PLC answers to, or which stations of a line answer. */
async function found(
  RED: NodeAPI,
  texts: Texts,
  body: StoredSettings,
  over: AbortSignal,
  deployed: (id: string) => PlcConnection | undefined,
): Promise<Found> {
  const id = typeof body.id === 'string' ? body.id : ''
  let peer = ''
  try {
    const given = givenIn(RED, id, body, texts, true)
    peer = peerOf(given.options)
    if (given.family === 'jw') return await headersFound(given.options, over)
    const { options, tested } = given
    if (options.line !== undefined) return await foundOnLine(options, tested, texts, over)
    const lines = await answeringLines(options, over)
    if (lines.length > 0) return { ok: true, lines }
    const causes = isUp(deployed(id)) ? [texts('error.entryHeld')] : []
    return { ok: false, message: texts('test.foundNone', { peer }), causes }
  } catch (error) {
    const details = detailsOf(error, texts)
    return { ok: false, message: shortMessage(details, peer, texts, false), causes: details.causes ?? [] }
  }
}

async function foundOnLine(
  options: MelsecOptions & PlcOnLine,
  tested: TestedLine | undefined,
  texts: Texts,
  over: AbortSignal,
): Promise<Found> {
  const stations = await answeringStations(options, over)
  if (stations.length > 0) return { ok: true, stations }
  const message = texts('test.foundNoStation', { peer: options.line.description })
  // Other forms need a port that nobody else has open.
  if (tested === undefined || tested.isTaken()) return { ok: false, message, causes: [texts('test.lineInUse')] }
  const forms = await answeringForms(options, tested.options, over)
  return forms.length > 0
    ? { ok: true, station: options.route?.station ?? 0, forms }
    : { ok: false, message, causes: [] }
}

async function headersFound(options: JwClientOptions, over: AbortSignal): Promise<Found> {
  return { ok: true, headers: [await answeringHeader(options, over)] }
}

/** A client's options as the test makes them: with a place that is known, by a network or on a line. */
type Given =
  | { readonly family: 'melsec'; readonly options: ReturnType<typeof optionsOf>; readonly tested?: TestedLine }
  | { readonly family: 'jw'; readonly options: JwClientOptions }

/** @param searching many stations of a line are asked that are not there */
function givenIn(RED: NodeAPI, id: string, body: StoredSettings, texts: Texts, searching = false): Given {
  const settings = settingsOf(objectIn(body, 'settings'), {
    texts,
    resolve: resolverOf(RED, RED.nodes.getNode(id), texts),
  })
  if (familyOf(settings, texts) === 'jw') return { family: 'jw', options: jwOptions(settings, texts) }
  // The test is what finds the series out, so it does not need it.
  const usual = isOnLine(settings, texts) ? LINE_PROFILE : 'generic'
  const known = settings.profile === '' ? { ...settings, profile: usual } : settings
  let tested: TestedLine | undefined
  const options = optionsOf(known, texts, (line) => {
    tested = lineToTest(RED, { id: line, given: objectIn(body, 'line'), searching }, texts)
    return tested.line
  })
  return { family: 'melsec', options, ...(tested === undefined ? {} : { tested }) }
}

function isLineOf(given: Given): boolean {
  return given.family === 'melsec' && given.options.line !== undefined
}

function withPatience(given: Given): FamilyOptions {
  return given.family === 'melsec'
    ? { family: 'melsec', options: { ...given.options, connectTimeout: CONNECT } }
    : { family: 'jw', options: { ...given.options, connectTimeout: CONNECT } }
}

/** The deployed connection has an entry of its PLC. */
function isUp(connection: PlcConnection | undefined): boolean {
  return connection?.connected !== undefined
}

/** The running client, when it speaks as is to be tested: the PLC may have no second entry for a test. */
function connected(connection: PlcConnection | undefined, given: Given): AnyPlc | undefined {
  const running = connection?.given
  if (running === undefined || running.family !== given.family) return undefined
  const isSame = lineIn(running) === lineIn(given) && wire(running.options) === wire(given.options)
  return isSame ? connection?.connected : undefined
}

function lineIn({ family, options }: FamilyOptions): unknown {
  return family === 'melsec' ? options.line : undefined
}

/** What the PLC does not see of a client's options; its line is compared by itself. The dialog does not give the password away. */
const UNSEEN: readonly string[] = [
  'allowWrites',
  'allowControl',
  'allowParameters',
  'gap',
  'format',
  'areas',
  'password',
  'reconnect',
  'queueLimit',
  'line',
]

function wire(options: FamilyOptions['options']): string {
  return JSON.stringify(Object.entries(options).filter(([name]) => !UNSEEN.includes(name)))
}

/** @param isLine what the client was told of its line says how long a question takes there */
async function ask(plc: AnyPlc, signal: AbortSignal, isLine: boolean): Promise<TestResult> {
  const call = isLine ? { signal } : { timeout: QUESTION, signal }
  await plc.client.connect(isLine ? call : { timeout: CONNECT, signal })
  return forFamily<Promise<TestResult>>(plc, {
    melsec: async (client) => {
      const identity = await unlessRefused(() => identified(client, call, isLine))
      return {
        ...('refusal' in identity ? { unidentified: identity.refusal } : identity.value),
        ...measured(await rounds(client, call)),
      }
    },
    jw: async (client) => ({ jw: await jwIdentity(client, call), ...measured(await jwRounds(client, call, ROUNDS)) }),
  })
}

function measured(times: readonly number[]): Pick<TestResult, 'ok' | 'roundTrip'> {
  return {
    ok: true,
    roundTrip: {
      min: Math.min(...times),
      mean: sumOf(times) / times.length,
      max: Math.max(...times),
      count: times.length,
    },
  }
}

async function identified(client: MelsecClient, call: CallOptions, isLine: boolean): Promise<Identity> {
  const { profile, ...identity } = await client.identify(call)
  const own = isLine ? profileOnLine(profile) : profile
  return own === undefined ? identity : { ...identity, profile: own }
}

function sumOf(times: readonly number[]): number {
  return times.reduce((sum, time) => sum + time, 0)
}

/** Self Test does nothing but send back; a PLC that lacks it is read instead. */
async function rounds(client: MelsecClient, call: CallOptions): Promise<number[]> {
  const times: number[] = []
  let measure = async () => (await client.selfTest(undefined, call)).roundTrip
  const first = await unlessRefused(measure)
  if ('refusal' in first) {
    measure = async () => {
      await client.read('D0', call)
      return client.statistics.roundTrip?.last ?? Number.NaN
    }
  } else {
    times.push(first.value)
  }
  while (times.length === 0 || (times.length < ROUNDS && sumOf(times) < ENOUGH)) times.push(await measure())
  return times
}

/** Not to know a command is no fault of the connection: some devices refuse it, others say nothing or close. */
function isUnknown(error: unknown): error is PlcError {
  return error instanceof TimeoutError || (error instanceof ConnectionError && error.code === 'DISCONNECTED')
}

/** A PLC that refuses answers, and that is what is tested; everything else is thrown. */
async function unlessRefused<T>(ask: () => Promise<T>): Promise<{ value: T } | { refusal: string }> {
  try {
    return { value: await ask() }
  } catch (error) {
    if (
      isUnknown(error) ||
      error instanceof EndCodeError ||
      (error instanceof RequestError && error.code === 'UNSUPPORTED')
    ) {
      return { refusal: error.message }
    }
    throw error
  }
}
