import { type Command, Option } from 'commander'
import {
  createPlcSimulator,
  demoPlantTags,
  type ExtensionMemory,
  type PlcSimulator,
  type PlcSimulatorOptions,
  plantVariantOf,
  startDemoPlant,
} from '../entry/simulator'
import { ethernetFrameNames, frameNames } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { addCodeOptions, frameOption, profileOption, simulatedPassword } from './connection-options'
import { drivesOf } from './drive-option'
import { exitCodes } from './exit-code'
import { byFamily, familyOption, onlyFor } from './family'
import { faultHelp, faultOf } from './fault-option'
import { interruption } from './interruption'
import { labelsOf } from './label-option'
import { moduleOf } from './module-option'
import { onDemandWords, sendAgainAndAgain, takeLines } from './on-demand'
import { jsonOption, whole } from './option'
import { json, table } from './output'
import { addSimulatedJwOptions, type JwOptions, jwExamples, simulateJw } from './simulate-jw'
import { addLineOptions, isLine, type LineOptions, lineExamples, simulateLine } from './simulate-line'
import { addressRow, addressText, isLoopback, outcomeText, plantTable } from './simulated'
import type { Terminal } from './terminal'

const examples = [
  'simulate --plant',
  'simulate --profile iq-f --port 5010',
  'simulate --on-demand 1,2,3 --on-demand-every 500',
  "simulate --label Line1.Speed:REAL=12.5 --label 'Line1.Values:INT[10]=1,2,3'",
  'simulate --port 0 --no-udp --fault delay:ms=500 --fault endCode:endCode=C056,commands=readWords,times=1',
  ...lineExamples,
  ...jwExamples,
]

/** The port of the demo, too. */
const USUAL_PORT = 5007

interface SimulateOptions extends LineOptions, JwOptions {
  readonly ascii?: boolean
  readonly asciiZr?: 'decimal' | 'hexadecimal'
  readonly drive: readonly string[]
  readonly onDemand?: readonly number[]
  readonly onDemandEvery: number
  readonly interactive?: boolean
  readonly module: NonNullable<ExtensionMemory['modules']>
  readonly bufferMemory?: number
  readonly label: readonly string[]
  readonly labels?: string
  readonly password?: boolean
  readonly passwordAttempts?: number
  readonly lockOutTime?: number
}

/** `melsec-jw simulate` */
export const simulateCommand: MakeCommand = (run) => {
  const command = newCommand('simulate', 'start a simulated PLC; Ctrl-C ends it', examples)
    .description(
      'Start a simulated PLC that answers SLMP as a CPU of the family does, or as a Sharp JW does. It listens on this computer only, unless ' +
        '--host says otherwise, and lives until Ctrl-C.',
    )
    .addOption(familyOption())
    .option('--host <address>', 'address to listen on', '127.0.0.1')
    .addOption(
      new Option('--port <number>', 'TCP port, and UDP port; 0 = any free one')
        .default(USUAL_PORT)
        .argParser(whole(0, 65535)),
    )
    .addOption(new Option('--udp-port <number>', 'another UDP port').argParser(whole(0, 65535)))
    .option('--no-tcp', 'no TCP')
    .option('--no-udp', 'no UDP')
    .option('--plant', 'run the demo plant in it: a mixing tank; in a Sharp JW a bottling line')
    .addOption(
      new Option('--fault <fault>', 'switch a fault on; may be repeated').default([], 'none').argParser(collect),
    )
    .addOption(new Option('--scan-time <ms>', 'time from a request to its answer in RUN').argParser(whole(0, 60_000)))
    .addOption(new Option('--max-connections <number>', 'connection entries').argParser(whole(1, 1000)))
    .option('--log', 'print every request')
    .addOption(jsonOption())
  onlyFor('melsec', 'A simulated Sharp JW does not have it: leave it out.', command, (to) => {
    addMelsecOptions(to.optionsGroup('MELSEC:'))
    addLineOptions(to.optionsGroup('A serial line of them:'))
  })
  onlyFor('jw', 'With a Sharp JW say --family jw.', command, (to) =>
    addSimulatedJwOptions(to.optionsGroup('Sharp JW (--family jw):')),
  )
  command.addHelpText('after', faultHelp)
  return command.action((options: SimulateOptions) =>
    perform(run, options, () =>
      byFamily(command, options, {
        melsec: async () =>
          isLine(command, options) ? simulateLine(run.terminal, command, options) : simulate(run.terminal, options),
        jw: () => simulateJw(run.terminal, options),
      }),
    ),
  )
}

/** Options of a simulated MELSEC. */
function addMelsecOptions(command: Command): void {
  command
    .addOption(profileOption().default('iq-r'))
    .addOption(frameOption('take this frame only; default: all of the profile', frameNames))
  addCodeOptions(command)
  command
    .option('--reset-allowed', 'CPU parameter "Remote Reset"')
    .addOption(
      new Option('--module <model@start I/O>', 'module with buffer memory, e.g. Q62DA@0030; may be repeated')
        .default([], 'none')
        .argParser((text, before: SimulateOptions['module']) => [...before, moduleOf(text)]),
    )
    .addOption(
      new Option('--buffer-memory <words>', 'buffer memory of the port itself, for Memory').argParser(
        whole(0, 0x1000000),
      ),
    )
    .addOption(
      new Option('--label <name:type=value>', 'global label, e.g. Line1.Speed:REAL=12.5; may be repeated')
        .default([], 'none')
        .argParser(collect),
    )
    .option('--labels <file>', 'global labels: a JSON object by name, of { type, dimensions, value }')
    .addOption(
      new Option('--drive <number=folder>', 'a folder as a drive with files, e.g. 2=./card; may be repeated')
        .default([], 'a few files in memory')
        .argParser(collect),
    )
    .option('--password', 'lock the port: a remote password, from the environment (MELSEC_JW_PASSWORD) or asked for')
    .addOption(
      new Option('--password-attempts <number>', 'wrong passwords in a row that lock out').argParser(whole(1, 1000)),
    )
    .addOption(new Option('--lock-out-time <ms>', 'how long it takes no password then').argParser(whole(0, 86_400_000)))
    .addOption(
      new Option('--on-demand <words>', 'send On-demand to every client again and again, e.g. 1,2,0xFFFF').argParser(
        onDemandWords,
      ),
    )
    .addOption(
      new Option('--on-demand-every <ms>', 'pause before each of them').default(1000).argParser(whole(10, 3_600_000)),
    )
    .option('--interactive', 'take lines from the standard input: "ondemand 1 2 3" sends On-demand once')
}

function collect(text: string, before: readonly string[]): readonly string[] {
  return [...before, text]
}

async function simulate(terminal: Terminal, options: SimulateOptions): Promise<number> {
  const labels = await labelsOf(options.labels, options.label)
  const password = options.password === true ? { password: await simulatedPassword(terminal) } : {}
  const plc = createPlcSimulator({ ...simulatorOptions(options), labels, ...password })
  for (const text of options.fault) plc.faults.add(faultOf(text))
  await plc.listen()
  const interrupted = interruption()
  if (options.plant === true) startDemoPlant(plc)
  if (options.log === true) logRequests(terminal, plc)
  show(terminal, plc, { ...options, names: Object.keys(labels) })
  const ends = [
    ...(options.onDemand === undefined ? [] : [sendAgainAndAgain(plc, options.onDemand, options.onDemandEvery)]),
    ...(options.interactive === true ? [takeLines(terminal, plc)] : []),
  ]
  await interrupted
  for (const end of ends) end()
  await plc.close()
  return exitCodes.ok.code
}

function simulatorOptions(options: SimulateOptions): PlcSimulatorOptions {
  const {
    profile,
    host,
    port,
    udpPort = port,
    frame,
    asciiXy,
    asciiZr,
    scanTime,
    maxConnections,
    resetAllowed,
    passwordAttempts,
    lockOutTime,
    module: modules,
    bufferMemory,
  } = options
  // Others are those of a serial line.
  const taken = ethernetFrameNames.find((name) => name === frame)
  return {
    profile,
    host,
    tcp: options.tcp ? { port } : false,
    udp: options.udp ? { port: udpPort } : false,
    code: options.ascii === true ? 'ascii' : 'binary',
    ...(taken === undefined ? {} : { frames: [taken] }),
    ...(asciiXy === undefined ? {} : { asciiXy }),
    ...(asciiZr === undefined ? {} : { asciiZr }),
    ...(scanTime === undefined ? {} : { scanTime }),
    ...(maxConnections === undefined ? {} : { maxConnections }),
    ...(resetAllowed === undefined ? {} : { resetAllowed }),
    ...(passwordAttempts === undefined ? {} : { passwordAttempts }),
    ...(lockOutTime === undefined ? {} : { lockOutTime }),
    ...(modules.length === 0 ? {} : { extensions: { modules } }),
    ...(bufferMemory === undefined ? {} : { bufferMemory }),
    drives: drivesOf(options.drive),
  }
}

/** As it runs: with the names of its labels. */
type Shown = SimulateOptions & { readonly names: readonly string[] }

function show(terminal: Terminal, plc: PlcSimulator, options: Shown): void {
  const tags = demoPlantTags[plantVariantOf(plc.profile.id)]
  if (options.json === true) {
    const { profile, tcp, udp } = plc
    const { names: labels } = options
    const more = { ...(options.plant === true ? { plant: tags } : {}), ...(labels.length === 0 ? {} : { labels }) }
    terminal.out(json({ profile: profile.id, tcp, udp, ...more }))
    return
  }
  const { profile } = plc
  const frames = options.frame ?? profile.frames.join(', ')
  const code = options.ascii === true ? 'ASCII' : 'binary'
  terminal.out(
    [
      `Simulated ${profile.title}, profile ${profile.id}. Ctrl-C ends it.`,
      table([...addressRow('TCP', plc.tcp), ...addressRow('UDP', plc.udp), ['Frames', frames], ['Code', code]], '  '),
      ...(options.fault.length === 0 ? [] : [`Faults: ${options.fault.join('  ')}`]),
      ...(options.names.length === 0 ? [] : [`Labels: ${options.names.join('  ')}`]),
      ...(options.password === true ? ['The port is locked by a remote password.'] : []),
      ...(options.plant === true ? ['', 'Demo plant:', plantTable(tags)] : []),
      '',
      `Try: ${trial(plc, options)}`,
    ].join('\n'),
  )
  if (!isLoopback(options.host))
    terminal.error(`Everybody who reaches ${options.host} can write to this simulated PLC.`)
}

/** A command that reads something from it. */
function trial({ tcp, udp, profile }: PlcSimulator, { ascii, frame, plant, password, names }: Shown): string {
  const peer = tcp ?? udp
  const settings = [
    ...(peer === undefined ? [] : [`--plc ${addressText(peer)}`]),
    ...(tcp === undefined ? ['--udp'] : []),
    `--profile ${profile.id}`,
    ...(frame === undefined ? [] : [`--frame ${frame}`]),
    ...(ascii === true ? ['--ascii'] : []),
    ...(password === true ? ['--password'] : []),
  ]
  const [label] = names
  const items = [plant === true ? 'D100:REAL M10' : 'D0 M0', ...(label === undefined ? [] : [`label:${label}`])]
  return `melsec-jw read ${settings.join(' ')} ${items.join(' ')}`
}

function logRequests(terminal: Terminal, plc: PlcSimulator): void {
  plc.on('connection', ({ change, connection: { remote } }) => terminal.error(`${remote} ${change}`))
  plc.on('request', (event) => terminal.error(`${event.remote} ${outcomeText(event)}`))
}
