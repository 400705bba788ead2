/** Flows for the tests of the nodes: a connection to a simulated PLC, and nodes that use it. */
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/entry/simulator'
import type { FlowNode } from '../support/node-red'

type Settings = Readonly<Record<string, unknown>>

export async function startPlc(options: PlcSimulatorOptions = {}): Promise<PlcSimulator> {
  const plc = createPlcSimulator(options)
  await plc.listen()
  return plc
}

/** The port of a simulated PLC, as a setting. */
export function portOf(plc: PlcSimulator): string {
  if (plc.tcp === undefined) throw new Error('the simulated PLC does not listen')
  return String(plc.tcp.port)
}

export function connectionTo(plc: PlcSimulator, more: Settings = {}): FlowNode {
  return {
    id: 'plc',
    type: 'melsec-jw-connection',
    version: 1,
    host: '127.0.0.1',
    port: portOf(plc),
    profile: plc.profile.id,
    // Long enough for a busy machine; tests of silence take a shorter one.
    timeout: '8000',
    ...more,
  }
}

/** A read node whose rows are addresses, or names with addresses. */
export function readNode(items: readonly string[] | Readonly<Record<string, string>>, more: Settings = {}): FlowNode {
  const rows = Array.isArray(items)
    ? items.map((address: string) => ({ name: '', address, type: '' }))
    : Object.entries(items).map(([name, address]) => ({ name, address, type: '' }))
  return user('read', 'melsec-jw-read', { addressesType: 'rows', items: rows, output: 'object', ...more })
}

export function writeNode(more: Settings = {}): FlowNode {
  return user('write', 'melsec-jw-write', { valuesType: 'msg', values: 'payload', items: [], ...more })
}

export function controlNode(more: Settings = {}): FlowNode {
  return user('control', 'melsec-jw-control', { commandType: 'msg', command: 'payload', ...more })
}

export function ondemandNode(more: Settings = {}): FlowNode {
  return user('ondemand', 'melsec-jw-ondemand', { output: 'words', topic: '', ...more })
}

export function requestNode(more: Settings = {}): FlowNode {
  return user('request', 'melsec-jw-request', more)
}

export function fileNode(more: Settings = {}): FlowNode {
  return user('file', 'melsec-jw-file', { fileType: 'str', data: 'payload', dataType: 'msg', ...more })
}

export function catchNode(): FlowNode {
  return { id: 'catch', type: 'catch', scope: null, uncaught: false, wires: [[]] }
}

function user(id: string, type: string, more: Settings): FlowNode {
  return { id, type, version: 1, connection: 'plc', wires: [[]], ...more }
}

/** An environment variable as people type it in a setting: a dollar sign and its name in braces. */
export function variable(name: string): string {
  return ['$', '{', name, '}'].join('')
}

/** What a Catch node gets of a failure, besides the message. */
export interface CaughtError {
  readonly message: string
  readonly code: string
  readonly source: { readonly id: string }
  readonly cause: Readonly<Record<string, unknown>>
}
