/** A simulated PLC on loopback, and frames as hexadecimal text. */
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/simulator/server'
import { tcpTransport } from '../../src/transport/tcp'
import { udpTransport } from '../../src/transport/udp'
import { type Recorder, record, settle } from '../transport/recorder'

export type Protocol = 'tcp' | 'udp'

/** Read one word of D, binary: 3E without a serial number, 4E with one. */
export function readD(number: number, serial?: number): Buffer {
  const body = `01040000${little(number, 3)}a80100`
  return frame('50', '54', serial, `0000${body}`)
}

/** Write one word of D, binary. */
export function writeD(number: number, value: number, serial?: number): Buffer {
  return frame('50', '54', serial, `000001140000${little(number, 3)}a80100${little(value, 2)}`)
}

/** The answer with one word. */
export function word(value: number, serial?: number): Buffer {
  return frame('d0', 'd4', serial, `0000${little(value, 2)}`)
}

/** The answer without data. */
export function done(serial?: number): Buffer {
  return frame('d0', 'd4', serial, '0000')
}

/** The answer that refuses Read (`0401`) or another command, subcommand 0000. */
export function refused(endCode: number, serial?: number, command = '0104'): Buffer {
  return frame('d0', 'd4', serial, `${little(endCode, 2)}00ffff0300${command}0000`)
}

function frame(plain: string, serialized: string, serial: number | undefined, rest: string): Buffer {
  const subheader = serial === undefined ? `${plain}00` : `${serialized}00${little(serial, 2)}0000`
  return Buffer.from(`${subheader}00ffff0300${little(rest.length / 2, 2)}${rest}`, 'hex')
}

function little(value: number, bytes: number): string {
  const buffer = Buffer.alloc(bytes)
  buffer.writeUIntLE(value, 0, bytes)
  return buffer.toString('hex')
}

export interface Bench {
  readonly plc: PlcSimulator
  /** A client that is connected. */
  client(protocol: Protocol): Promise<Recorder>
  close(): Promise<void>
}

export async function bench(options: PlcSimulatorOptions = {}): Promise<Bench> {
  const plc = createPlcSimulator(options)
  await plc.listen()
  const clients: Recorder[] = []
  return {
    plc,
    async client(protocol) {
      const client = record(open(plc, protocol))
      clients.push(client)
      await client.opened
      return client
    },
    async close() {
      for (const { transport } of clients) transport.close()
      await plc.close()
    },
  }
}

/** A transport to the PLC that is not opened yet. */
export function open(plc: PlcSimulator, protocol: Protocol) {
  const endpoint = plc[protocol]
  if (endpoint === undefined) throw new Error(`does not listen on ${protocol}`)
  return protocol === 'tcp' ? tcpTransport(endpoint)() : udpTransport(endpoint)()
}

const MOST_TURNS = 20_000

/** Lets the event loop turn until it is so. */
export async function until(condition: () => boolean): Promise<void> {
  for (let turn = 0; !condition(); turn++) {
    if (turn >= MOST_TURNS) throw new Error(`never: ${condition}`)
    await settle()
  }
}

/** Runs with a PLC and a client, and ends both. */
export async function withClient(
  protocol: Protocol,
  options: PlcSimulatorOptions,
  run: (plc: PlcSimulator, client: Recorder, bench: Bench) => Promise<void>,
): Promise<void> {
  const joined = await bench(options)
  try {
    await run(joined.plc, await joined.client(protocol), joined)
  } finally {
    await joined.close()
  }
}
