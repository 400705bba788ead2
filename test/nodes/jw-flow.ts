/** Flows for the tests of the nodes with a Sharp JW: a simulated one, and the connection to it. */
import { createJwSimulator, type JwSimulator, type JwSimulatorOptions } from '../../src/entry/simulator'
import type { FlowNode } from '../support/node-red'

export async function startJw(options: JwSimulatorOptions = {}): Promise<JwSimulator> {
  const plc = createJwSimulator({ writeMode: 2, ...options })
  await plc.listen()
  return plc
}

/** The settings of a connection to it. */
export function jwSettings(plc: JwSimulator, more: Readonly<Record<string, unknown>> = {}) {
  return {
    family: 'jw',
    model: 'jw300',
    host: '127.0.0.1',
    port: String(plc.tcp?.port),
    // Long enough for a busy machine; tests of silence take a shorter one.
    timeout: '8000',
    ...more,
  }
}

export function jwConnection(plc: JwSimulator, more: Readonly<Record<string, unknown>> = {}): FlowNode {
  return { id: 'plc', type: 'melsec-jw-connection', version: 3, ...jwSettings(plc, more) }
}
