/** The ways to speak to a PLC that the campaign tries, each with a client and a PLC of its own. */
import type { MelsecOptions, NetworkPlc } from '../../src/index'
import type { Model } from './answers'
import type { Code } from './bytes'
import type { Request } from './request'

export interface Configuration {
  readonly name: string
  readonly transport: 'tcp' | 'udp'
  readonly frame: Request['frame']
  readonly code: Code
  readonly profile: 'iq-r' | 'iq-f' | 'q' | 'q-built-in' | 'fx3'
  readonly inFlight: number
  /** The client always uses the same local port. */
  readonly fixedPort: boolean
  /** Answers are told apart by a serial number. */
  readonly serial: boolean
}

const FRAMES: readonly (readonly [Request['frame'], Code, Configuration['profile']])[] = [
  ['3E', 'binary', 'iq-f'],
  ['3E', 'ascii', 'iq-r'],
  ['4E', 'binary', 'iq-r'],
  ['4E', 'ascii', 'q'],
  ['ext', 'binary', 'iq-r'],
  ['1E', 'binary', 'iq-f'],
  ['1E', 'ascii', 'iq-f'],
]

export const configurations: readonly Configuration[] = [
  ...FRAMES.map((frame) => configuration('tcp', frame)),
  configuration('tcp', ['3E', 'binary', 'q'], { fixedPort: true }),
  configuration('tcp', ['1E', 'binary', 'fx3']),
  configuration('udp', ['1E', 'ascii', 'fx3']),
  ...FRAMES.map((frame) => configuration('udp', frame)),
  configuration('udp', ['4E', 'binary', 'iq-r'], { inFlight: 4 }),
  configuration('udp', ['4E', 'ascii', 'iq-r'], { inFlight: 8 }),
  ...FRAMES.map((frame) => configuration('udp', frame, { fixedPort: true })),
  // This one proves a connection by reading a word: an answer like many others.
  configuration('udp', ['3E', 'binary', 'q-built-in'], { fixedPort: true }),
  configuration('udp', ['4E', 'binary', 'iq-r'], { fixedPort: true, inFlight: 4 }),
]

function configuration(
  transport: Configuration['transport'],
  [frame, code, profile]: (typeof FRAMES)[number],
  { inFlight = 1, fixedPort = false }: { readonly inFlight?: number; readonly fixedPort?: boolean } = {},
): Configuration {
  const more = [inFlight > 1 ? `${inFlight} in flight` : '', fixedPort ? 'fixed port' : ''].filter(
    (text) => text !== '',
  )
  return {
    name: [transport.toUpperCase(), frame, code, profile, ...more].join(' '),
    transport,
    frame,
    code,
    profile,
    inFlight,
    fixedPort,
    serial: frame === '4E' || frame === 'ext',
  }
}

/** ms. Short, because most faults end in it. */
export const TIMEOUT = 40

export function clientOptions(
  { transport, frame, code, profile, inFlight }: Configuration,
  random: () => number,
): Omit<MelsecOptions & NetworkPlc, 'port' | 'localPort'> {
  return {
    host: '127.0.0.1',
    transport,
    frame,
    code,
    profile,
    inFlight,
    allowWrites: true,
    timeout: TIMEOUT,
    connectTimeout: 10 * TIMEOUT,
    queueLimit: QUEUE_LIMIT,
    gap: 0,
    reconnect: { first: 1, longest: 4 },
    settleGap: 0,
    random,
  }
}

export const QUEUE_LIMIT = 6

export const models: Readonly<Record<Configuration['profile'], Model>> = {
  'iq-r': { name: 'R04CPU', code: 0x4800, oneE: 'F3' },
  'iq-f': { name: 'FX5U-32MR/ES', code: 0x4a21, oneE: 'F3' },
  q: { name: 'Q03UDVCPU', code: 0x0366, oneE: 'F3' },
  'q-built-in': { name: 'Q03UDVCPU', code: 0x0366, oneE: 'F3' },
  fx3: { name: 'FX3U', code: 0, oneE: 'F300' },
}
