// What the test of a connection asks a Sharp JW. All of it reads, and changes nothing.
import {
  type CallOptions,
  findJwHeader,
  type JwClient,
  type JwClientOptions,
  type JwHeader,
  type JwInfo,
} from '../src/index'

/** ms for each header: a PLC that understands answers in a fraction of it. */
const PATIENCE = 2000

/** What stands in front of the messages that a unit answers, as the dialog has it. */
export interface AnsweringHeader {
  readonly header: Extract<JwHeader, string>
}

/** Memory size, run state and the like; what the PLC refuses to tell is missing. */
export function jwIdentity(client: JwClient, call: CallOptions): Promise<JwInfo> {
  return client.info(call)
}

/** ms of each round: of reading the write mode, which every model answers in any mode. */
export async function jwRounds(client: JwClient, call: CallOptions, count: number): Promise<number[]> {
  const times: number[] = []
  while (times.length < count) {
    await client.control.writeMode(call)
    times.push(client.statistics.roundTrip?.last ?? Number.NaN)
  }
  return times
}

/** Tries no other headers than those that have no numbers of a plant in them. @throws PlcError when none is answered */
export async function answeringHeader(options: JwClientOptions, signal: AbortSignal): Promise<AnsweringHeader> {
  const { header: _header, probe: _probe, connectTimeout: _connect, timeout: _timeout, ...unit } = options
  const found = await findJwHeader({ ...unit, timeout: PATIENCE, connectTimeout: PATIENCE }, ['zero40', 'none'], {
    timeout: PATIENCE,
    signal,
  })
  return { header: found.header === 'zero40' ? 'zero40' : 'none' }
}
