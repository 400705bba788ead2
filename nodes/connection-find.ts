/**
 * Which frames and data codes a PLC answers to. Each is tried on a connection of its own, with the first harmless
 * question of the client (Read Type Name, its counterpart in 1E frames, or a self test); nothing else is sent.
 */
import {
  ConnectionError,
  createMelsecClient,
  type DataCode,
  type FrameName,
  type Identity,
  type MelsecClientOptions,
  PlcError,
  type ProfileId,
} from '../src/index'

/** What was tried and answered, with what the CPU said of itself. */
export interface AnsweringLine {
  readonly frame: FrameName
  readonly code: DataCode
  readonly model?: string
  /** Profile that the model suggests. */
  readonly profile?: ProfileId
}

/** ms for each try: a PLC that understands answers in a fraction of it. */
const PATIENCE = 1500

/** The usual ones first. A profile that knows the frame and nothing more. */
const LINES = [
  { frame: '3E', code: 'binary', profile: 'generic' },
  { frame: '4E', code: 'binary', profile: 'generic' },
  { frame: '3E', code: 'ascii', profile: 'generic' },
  { frame: '4E', code: 'ascii', profile: 'generic' },
  { frame: '1E', code: 'binary', profile: 'fx3' },
  { frame: '1E', code: 'ascii', profile: 'fx3' },
] as const satisfies readonly { readonly frame: FrameName; readonly code: DataCode; readonly profile: ProfileId }[]

/** @throws PlcError when nobody is there. */
export async function answeringLines(options: MelsecClientOptions, over: AbortSignal): Promise<AnsweringLine[]> {
  const answering: AnsweringLine[] = []
  for (const line of LINES) {
    if (over.aborted) break
    const identity = await answerTo(line, options, over)
    if (identity === undefined) continue
    const { model, profile } = identity
    const { frame, code } = line
    answering.push({
      frame,
      code,
      ...(model === undefined ? {} : { model }),
      ...(profile === undefined ? {} : { profile }),
    })
  }
  return answering
}

async function answerTo(
  { frame, code, profile }: (typeof LINES)[number],
  { host, port, transport, localAddress, localPort, route }: MelsecClientOptions,
  signal: AbortSignal,
): Promise<Partial<Identity> | undefined> {
  const client = createMelsecClient({
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
    timeout: PATIENCE,
    connectTimeout: PATIENCE,
  })
  try {
    await client.connect({ timeout: PATIENCE, signal })
    return await client.identify({ timeout: PATIENCE, signal }).catch(() => ({}))
  } catch (error) {
    // Without anybody there the other lines need no try.
    if (error instanceof ConnectionError && error.code === 'CONNECT_FAILED') throw error
    if (error instanceof PlcError) return undefined
    throw error
  } finally {
    await client.close()
  }
}
