/**
 * Which frames and data codes a PLC answers to. Each is tried on a connection of its own, one after the other, with a
 * read of D0, which every device knows; one that answers is asked who it is. Nothing else is sent.
 */
import {
  type CallOptions,
  ConnectionError,
  createMelsecClient,
  type DataCode,
  type FrameName,
  type MelsecClient,
  type MelsecOptions,
  type NetworkPlc,
  PlcError,
  type ProfileId,
  profiles,
} from '../src/index'

/** What was tried and answered, with what the CPU said of itself. */
export interface AnsweringLine {
  readonly frame: FrameName
  readonly code: DataCode
  readonly model?: string
  /** Profile that the model or the frame suggests. */
  readonly profile?: ProfileId
}

/** ms for each question: a PLC that understands answers in a fraction of it. All of them stay below the endpoint's. */
const PATIENCE = 1500
/** ms between two connections, for a PLC that has one entry and needs a moment to have it free again. */
const BETWEEN = 100

/** The usual ones first. A profile that knows the frame and nothing more. */
const LINES = [
  { frame: '3E', code: 'binary', profile: 'generic' },
  { frame: '4E', code: 'binary', profile: 'generic' },
  { frame: '3E', code: 'ascii', profile: 'generic' },
  { frame: '4E', code: 'ascii', profile: 'generic' },
  { frame: '1E', code: 'binary', profile: 'fx3' },
  { frame: '1E', code: 'ascii', profile: 'fx3' },
] as const satisfies readonly { readonly frame: FrameName; readonly code: DataCode; readonly profile: ProfileId }[]
type Line = (typeof LINES)[number]

/** By a network: a serial line has nothing to try that is not an option of its own. */
type PlcOptions = MelsecOptions & NetworkPlc

/** @throws PlcError when nobody is there. */
export async function answeringLines(options: PlcOptions, over: AbortSignal): Promise<AnsweringLine[]> {
  const answering: AnsweringLine[] = []
  for (const [index, line] of LINES.entries()) {
    if (index > 0) await pause(BETWEEN)
    if (over.aborted) break
    try {
      const found = await answerTo(line, options, over)
      answering.push({ ...profileFor(line, options.profile, answering), ...found })
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      // Where nobody is, the other ones need no try. Later it is a PLC that has not yet taken leave of the one before.
      if (index === 0 && error instanceof ConnectionError && isNobodyThere(error)) throw error
    }
  }
  return answering
}

function isNobodyThere({ code }: ConnectionError): boolean {
  return code === 'CONNECT_FAILED' || code === 'PORT_UNAVAILABLE'
}

/** @throws PlcError when it is no answer */
async function answerTo(line: Line, options: PlcOptions, signal: AbortSignal): Promise<AnsweringLine> {
  const client = createMelsecClient(optionsFor(line, options))
  const { frame, code } = line
  const call = { timeout: PATIENCE, signal }
  try {
    await client.connect(call)
    return { frame, code, ...(await whoIs(client, call)) }
  } finally {
    await client.close()
  }
}

function optionsFor({ frame, code, profile }: Line, options: PlcOptions): PlcOptions {
  const { host, port, transport, localAddress, localPort, route } = options
  return {
    host,
    port,
    ...(transport === undefined ? {} : { transport }),
    ...(localAddress === undefined ? {} : { localAddress }),
    ...(localPort === undefined ? {} : { localPort }),
    // A 1E frame reaches the connected station only.
    ...(route === undefined || frame === '1E' ? {} : { route }),
    frame,
    code,
    profile,
    probe: 'read',
    timeout: PATIENCE,
    connectTimeout: PATIENCE,
  }
}

/** Not every device tells, and a locked one tells nobody; that it answered is enough. */
async function whoIs(client: MelsecClient, call: CallOptions): Promise<Pick<AnsweringLine, 'model' | 'profile'>> {
  try {
    const { model, profile } = await client.identify(call)
    return { ...(model === '' ? {} : { model }), ...(profile === undefined ? {} : { profile }) }
  } catch (error) {
    if (error instanceof PlcError) return {}
    throw error
  }
}

/** For a device that did not tell its series where the chosen one lacks the frame: with it nothing would work. */
function profileFor(
  { frame, profile }: Line,
  chosen: PlcOptions['profile'],
  answering: readonly AnsweringLine[],
): Pick<AnsweringLine, 'profile'> {
  const knows = (known: { readonly frames: readonly FrameName[] } | undefined) => known?.frames.includes(frame) === true
  if (knows(typeof chosen === 'string' ? profiles[chosen] : chosen)) return {}
  const other = answering.find((line) => line.profile !== undefined && knows(profiles[line.profile]))
  return { profile: other?.profile ?? profile }
}

/** Waits. */
export function pause(ms: number): Promise<void> {
  return new Promise((resolve) => {
    AbortSignal.timeout(ms).addEventListener('abort', () => resolve(), { once: true })
  })
}
