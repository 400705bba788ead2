// `simulate` for a Sharp JW.
import { type Command, Option } from 'commander'
import {
  createJwSimulator,
  demoBottlingTags,
  type JwModel,
  type JwSimulator,
  type JwSimulatorOptions,
  startDemoBottling,
} from '../entry/simulator'
import { exitCodes } from './exit-code'
import type { FamilyOptions } from './family'
import { jwFaultOf } from './fault-option'
import { interruption } from './interruption'
import { modelOption } from './jw/connection'
import { choice, given, whole } from './option'
import { json, table } from './output'
import { addressRow, isLoopback, outcomeIn, plantTable } from './simulated'
import type { Terminal } from './terminal'

/** The options that a Sharp JW has alone. */
interface OwnOptions {
  readonly model?: JwModel
  readonly header?: 'any' | 'none' | 'zero40'
  readonly writeMode?: number
}

/** The options of a Sharp JW as commander gives them, those among them that other PLCs at Ethernet have, too. */
export interface JwOptions extends OwnOptions, FamilyOptions {
  readonly host: string
  readonly port: number
  readonly udpPort?: number
  readonly tcp: boolean
  readonly udp: boolean
  readonly plant?: boolean
  readonly fault: readonly string[]
  readonly scanTime?: number
  readonly maxConnections?: number
  readonly log?: boolean
  readonly json?: boolean
}

export const jwExamples = [
  'simulate --family jw --plant --write-mode 1',
  'simulate --family jw --port 5010 --header zero40 --fault endCode:endCode=10,commands=writeDataMemory,times=1',
]

/** Adds the options that a simulated Sharp JW alone has. */
export function addSimulatedJwOptions(command: Command): Command {
  return command
    .addOption(modelOption())
    .addOption(choice('--header <header>', 'Sharp JW: in front of messages; default any', ['any', 'none', 'zero40']))
    .addOption(
      new Option(
        '--write-mode <mode>',
        'Sharp JW: what may be written: 0 nothing (default), 1 data memory, 2 all',
      ).argParser(whole(0, 2)),
    )
}

export async function simulateJw(terminal: Terminal, options: JwOptions): Promise<number> {
  const plc = createJwSimulator(simulatorOptions(options))
  for (const text of options.fault) plc.faults.add(jwFaultOf(text))
  await plc.listen()
  const interrupted = interruption()
  if (options.plant === true) startDemoBottling(plc)
  if (options.log === true) logRequests(terminal, plc)
  show(terminal, plc, options)
  await interrupted
  await plc.close()
  return exitCodes.ok.code
}

function simulatorOptions(options: JwOptions): JwSimulatorOptions {
  const { host, port, udpPort = port, tcp, udp, writeMode } = options
  const mode = ([0, 1, 2] as const).find((known) => known === writeMode)
  return {
    host,
    tcp: tcp ? { port } : false,
    udp: udp ? { port: udpPort } : false,
    ...given(options, ['model', 'header', 'scanTime', 'maxConnections']),
    ...(mode === undefined ? {} : { writeMode: mode }),
  }
}

function show(terminal: Terminal, plc: JwSimulator, options: JwOptions): void {
  const { tcp, udp, model } = plc
  const { writeMode } = plc.cpu
  const { header = 'any', plant } = options
  if (options.json === true) {
    const more = plant === true ? { plant: demoBottlingTags } : {}
    terminal.out(json({ family: 'jw', model, tcp, udp, header, writeMode, ...more }))
    return
  }
  const rows = [
    ...addressRow('TCP', tcp),
    ...addressRow('UDP', udp),
    ['Header', header],
    ['Write mode', WRITE_MODES[writeMode]],
  ]
  terminal.out(
    [
      `Simulated Sharp ${model.toUpperCase()} with JW-255CM. Ctrl-C ends it.`,
      table(rows, '  '),
      ...(options.fault.length === 0 ? [] : [`Faults: ${options.fault.join('  ')}`]),
      ...(plant === true ? ['', 'Bottling line:', plantTable(demoBottlingTags)] : []),
    ].join('\n'),
  )
  if (!isLoopback(options.host))
    terminal.error(`Everybody who reaches ${options.host} can write to this simulated PLC.`)
}

const WRITE_MODES = [
  '0, nothing may be written',
  '1, data memory may be written',
  '2, all memory may be written',
] as const

function logRequests(terminal: Terminal, plc: JwSimulator): void {
  plc.on('connection', ({ change, connection: { remote } }) => terminal.error(`${remote} ${change}`))
  plc.on('request', ({ remote, command, endCode }) => terminal.error(`${remote} ${outcomeIn('jw', command, endCode)}`))
}
