// What commands do with a client of any family: connect, do something, close.
import { type Command, Option } from 'commander'
import {
  type ItemExplanation,
  type JwItemExplanation,
  type OpenTransport,
  type PlcClient,
  PlcError,
  RequestError,
  type TraceEntry,
} from '../index'
import { jsonOption, whole } from './option'
import type { Terminal } from './terminal'

/** As commander gives them. */
export interface SessionOptions {
  readonly localAddress?: string
  readonly localPort?: number
  readonly timeout?: number
  readonly connectTimeout: number
  readonly trace?: boolean
  readonly json?: boolean
}

/**
 * Adds options of times, ports of this computer and output, under their titles. `more`: others of times and ports;
 * `trace`: false where the frames are nobody's business.
 */
export function addSessionOptions(
  command: Command,
  more: (command: Command) => unknown = () => {},
  { trace = true } = {},
): Command {
  command.optionsGroup('Times and ports:')
  more(command)
  command
    .addOption(new Option('--local-address <address>', 'address of the network interface to use'))
    .addOption(
      new Option('--local-port <number>', "fixed port of this computer, when the PLC's entry names one").argParser(
        whole(1, 65535),
      ),
    )
    .addOption(new Option('--timeout <ms>', 'time for an answer (default: 3000)').argParser(whole(1, 3_600_000)))
    .addOption(
      new Option('--connect-timeout <ms>', 'time for the connection').default(5000).argParser(whole(1, 3_600_000)),
    )
    .optionsGroup('Output:')
  if (trace) command.addOption(new Option('--trace', 'show every frame, explained, on the error output'))
  return command.addOption(jsonOption())
}

/** ms for the answer that proves the connection, when nobody says how long. */
const USUAL_TIME = 3000

/** A client that tells what is sent and received. */
export interface Traced {
  on(event: 'trace', listener: (entry: TraceEntry) => void): unknown
}

/** Connects, does `work`, and closes whatever happens. `prepare`: before it connects, to miss nothing that comes at once. */
export async function connected<C extends Pick<PlcClient, 'connect' | 'close'> & Traced, T>(
  terminal: Terminal,
  options: SessionOptions,
  client: C,
  work: (client: C) => Promise<T>,
  prepare: (client: C) => void = () => {},
): Promise<T> {
  if (options.trace === true) {
    client.on('trace', ({ time, direction, text }) => {
      terminal.error(`${new Date(time).toISOString()} ${direction}\n${text}\n`)
    })
  }
  try {
    prepare(client)
    // A deadline of its own: it holds the attempt and the answer that proves the connection, and says why it failed.
    await client.connect({ timeout: options.connectTimeout + (options.timeout ?? USUAL_TIME) })
    return await work(client)
  } finally {
    await client.close()
  }
}

/** For a client that only says what it refuses. */
export const nowhere: OpenTransport = () => {
  throw new Error('There is no way to a PLC: only what is refused before it is sent counts.')
}

/**
 * What a client refuses before it sends anything: said before anybody is asked, and before a connection is tried.
 * @param client one that leads `nowhere`
 * @throws RequestError
 */
export async function refusedUnsent<C extends Pick<PlcClient, 'close'>>(
  client: C,
  call: (client: C) => Promise<unknown>,
): Promise<void> {
  try {
    await call(client)
  } catch (error) {
    if (error instanceof RequestError || !(error instanceof PlcError)) throw error
  } finally {
    await client.close()
  }
}

/** What is known of an item, whatever its family. */
export type Explained = ItemExplanation | JwItemExplanation

/** A client of any family that explains its items. */
export interface ItemClient extends PlcClient {
  explain(item: string): Explained
}

/** What a command itself needs to be allowed. */
export type Need = 'reading' | 'writing' | 'control' | 'parameters'

/** A PLC of any family, as its options say it. */
export interface Plc<C extends ItemClient = ItemClient> {
  /** e.g. `tcp 192.168.3.39:5010` */
  readonly text: string
  /** A client of it that was not connected: for what is known without the PLC. */
  offline(): C
  /** What a client refuses before it sends anything. @throws RequestError */
  unsent(need: Need, call: (client: C) => Promise<unknown>): Promise<void>
  /** Connects, does `work`, and closes. */
  with<T>(need: Need, work: (client: C) => Promise<T>): Promise<T>
}
