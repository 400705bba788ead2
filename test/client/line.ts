/** The whole line: a client and a simulated PLC, joined by real sockets on loopback. */
import type { MelsecClientOptions, MelsecOptions, NetworkPlc } from '../../src/client/melsec/options'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/entry/simulator'
import {
  createMelsecClient,
  type FrameName,
  type MelsecClient,
  PlcError,
  type ProfileId,
  profiles,
  type ReadResult,
} from '../../src/index'

export interface Kind {
  readonly transport: 'tcp' | 'udp'
  readonly frame: FrameName
  readonly code: 'binary' | 'ascii'
  readonly profile: ProfileId
}

/** `tcp 4E binary iq-r` */
export function kind(text: string): Kind {
  const [transport, frame, code, profile] = text.split(' ')
  return { transport, frame, code, profile } as Kind
}

/** Every transport, frame, code and profile, and every pair of transport and frame in each code; not all combinations. */
export const kinds: readonly string[] = [
  'tcp 4E binary iq-r',
  'tcp 3E ascii iq-r',
  'udp 4E ascii iq-r',
  'udp 3E binary iq-r',
  'tcp 3E binary iq-f',
  'udp 3E ascii iq-f',
  'tcp 4E ascii q',
  'udp 4E binary l',
  'tcp 3E binary generic',
  'tcp ext binary iq-r',
  'udp ext binary generic',
]

/** Both transports, with and without serial numbers; and the frame that repeats the command. */
export const links: readonly string[] = [
  'tcp 3E binary iq-r',
  'tcp 4E binary iq-r',
  'udp 3E binary iq-r',
  'udp 4E binary iq-r',
  'tcp ext binary iq-r',
]

export interface Line extends Kind {
  readonly plc: PlcSimulator
  readonly client: MelsecClient
  /** Another client of the same PLC. */
  another(options?: Partial<MelsecOptions & NetworkPlc>): MelsecClient
}

export interface LineOptions {
  readonly plc?: PlcSimulatorOptions
  readonly client?: Partial<MelsecOptions & NetworkPlc>
}

/** Ample for loopback on a busy computer: for what is to be answered. */
const AMPLE = 5000
/** For a call that must succeed, where the others are to end soon. */
export const ample = { timeout: AMPLE } as const

export function clientOptions(
  { transport, frame, code, profile }: Kind,
  plc: PlcSimulator,
  options: Partial<MelsecOptions & NetworkPlc> = {},
): MelsecClientOptions {
  const port = plc[transport]?.port
  if (port === undefined) throw new Error(`does not listen on ${transport}`)
  return {
    host: '127.0.0.1',
    port,
    transport,
    frame,
    code,
    profile,
    ...(code === 'ascii' ? { asciiZr: 'decimal' } : {}),
    ...(code === 'ascii' && profiles[profile].cpu === 'iq-f' ? { asciiXy: 'octal' } : {}),
    timeout: AMPLE,
    allowWrites: true,
    allowControl: true,
    reconnect: { first: 1, longest: 20 },
    settleGap: 1,
    ...options,
  }
}

/** Runs with a client and a simulated PLC, and ends both. */
export async function withLine(text: string, options: LineOptions, run: (line: Line) => Promise<void>): Promise<void> {
  const wanted = kind(text)
  const plc = createPlcSimulator({ profile: wanted.profile, code: wanted.code, ...options.plc })
  await plc.listen()
  const clients: MelsecClient[] = []
  const another = (more: Partial<MelsecOptions & NetworkPlc> = {}) => {
    const client = createMelsecClient(clientOptions(wanted, plc, { ...options.client, ...more }))
    clients.push(client)
    return client
  }
  try {
    await run({ ...wanted, plc, client: another(), another })
  } finally {
    for (const client of clients) await client.close()
    await plc.close()
  }
}

/** What a call was rejected with. */
export async function failureOf(call: Promise<unknown>): Promise<PlcError> {
  const outcome = await call.then(
    (value) => ({ value }),
    (error: unknown) => ({ error }),
  )
  if ('value' in outcome) throw new Error(`it did not fail, but gave ${String(outcome.value)}`)
  if (outcome.error instanceof PlcError) return outcome.error
  throw outcome.error
}

/** The value, or the code of the error. */
export function brief(result: ReadResult): unknown {
  return result.ok ? result.value : result.error.code
}

/** The next event that fits. */
export function nextState(client: MelsecClient, name: string): Promise<void> {
  if (client.state.name === name) return Promise.resolve()
  return new Promise((resolve) => {
    const stop = client.on('state', (state) => {
      if (state.name !== name) return
      stop()
      resolve()
    })
  })
}

/** Lets the sockets do what they have to do, until it is so. */
export async function until(condition: () => boolean, what = String(condition)): Promise<void> {
  const end = performance.now() + AMPLE
  while (!condition()) {
    if (performance.now() > end) throw new Error(`never: ${what}`)
    await new Promise<void>((resolve) => setImmediate(resolve))
  }
}
