/** Flows for the tests of serial lines: a simulated line with stations 1 and 2, its line node, and connections to them. */
import { createLineSimulator, type LineSimulator, type LineSimulatorOptions } from '../../src/entry/simulator'
import type { FlowNode } from '../support/node-red'
import { readNode } from './flow'

type Settings = Readonly<Record<string, unknown>>

/** Stations 1 and 2, each with its number in D100. */
export async function startLine(options: LineSimulatorOptions = {}): Promise<LineSimulator> {
  const line = createLineSimulator({ stations: { 1: {}, 2: {} }, messageFormat: 4, ...options })
  await line.listen()
  for (const [number, station] of line.stations) station.write('D100', number)
  return line
}

/** As a device server. */
export function lineTo(line: LineSimulator, more: Settings = {}): FlowNode {
  return lineNode({ transport: 'tcp', host: '127.0.0.1', port: String(line.tcp?.port), ...more })
}

export function lineNode(more: Settings = {}): FlowNode {
  return {
    id: 'line',
    type: 'melsec-jw-line',
    version: 1,
    transport: 'serial',
    baudRate: '115200',
    frame: '3C',
    messageFormat: '4',
    sumCheck: true,
    ...more,
  }
}

export function stationNode(station: number, more: Settings = {}): FlowNode {
  return {
    id: `plc${station}`,
    type: 'melsec-jw-connection',
    version: 2,
    way: 'serial',
    line: 'line',
    lineStation: String(station),
    profile: 'fx5-serial',
    asciiXy: 'octal',
    timeout: '2000',
    ...more,
  }
}

export function readOf(station: number, more: Settings = {}): FlowNode {
  return readNode(['D100'], { id: `read${station}`, connection: `plc${station}`, output: 'value', ...more })
}
