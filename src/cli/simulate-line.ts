// `simulate` for a serial line with several stations.
import { type Command, InvalidArgumentError, Option } from 'commander'
import { definedOf } from '../basics/defined'
import {
  createLineSimulator,
  demoPlantTags,
  type LineSimulator,
  type LineSimulatorOptions,
  plantVariantOf,
  startDemoPlant,
} from '../entry/simulator'
import { ethernetFrameNames, type FrameName, type ProfileId, profiles, RequestError } from '../index'
import { exitCodes } from './exit-code'
import { faultOf } from './fault-option'
import { interruption } from './interruption'
import { whole } from './option'
import { json, table } from './output'
import { addSerialLineOptions, type SerialLineOptions } from './serial-options'
import { addressRow, isLoopback, outcomeText, plantTable } from './simulated'
import type { Terminal } from './terminal'

/** The options that a line has alone. */
interface OwnOptions extends SerialLineOptions {
  readonly stations?: readonly number[]
  readonly pace?: boolean
  readonly echo?: boolean
  readonly messageWait?: number
  readonly silence?: number
}

/** The options of a line as commander gives them, those among them that a PLC at Ethernet has, too. */
export interface LineOptions extends OwnOptions {
  readonly family: 'melsec' | 'jw'
  readonly profile: ProfileId
  readonly host: string
  readonly port: number
  readonly frame?: FrameName
  readonly asciiXy?: 'octal' | 'hexadecimal'
  readonly plant?: boolean
  readonly fault: readonly string[]
  readonly scanTime?: number
  readonly resetAllowed?: boolean
  readonly log?: boolean
  readonly json?: boolean
}

const OWN = {
  serial: true,
  baudRate: true,
  dataLength: true,
  parity: true,
  stopBits: true,
  rts: true,
  messageFormat: true,
  sumCheck: true,
  stations: true,
  pace: true,
  echo: true,
  messageWait: true,
  silence: true,
} as const satisfies Readonly<Record<keyof OwnOptions, true>>

const SHARED = {
  family: true,
  profile: true,
  host: true,
  port: true,
  frame: true,
  asciiXy: true,
  plant: true,
  fault: true,
  scanTime: true,
  resetAllowed: true,
  log: true,
  json: true,
} as const satisfies Readonly<Record<Exclude<keyof LineOptions, keyof OwnOptions>, true>>

export const lineExamples = [
  'simulate --stations 0,1,2 --message-format 4 --port 4001',
  'simulate --serial /dev/ttyUSB0 --baud-rate 19200 --frame 3C --message-format 4 --stations 0,1,2 --plant',
]

/** Adds the options of a serial line. */
export function addLineOptions(command: Command): Command {
  addSerialLineOptions(command)
  return command
    .addOption(
      new Option('--stations <numbers>', 'a serial line with these stations, e.g. 0,1,2').argParser(stationsOf),
    )
    .option('--serial <path>', 'a serial line at this port, e.g. COM3 or /dev/ttyUSB0; without it at --port only')
    .option('--pace', 'serial line: characters take their time, at --port too')
    .option('--echo', 'serial line: whoever sends hears it, as on one pair of RS-485')
    .addOption(new Option('--message-wait <ms>', 'serial line: before answers in 3C and 4C').argParser(whole(0, 150)))
    .addOption(
      new Option('--silence <ms>', 'serial line: within a message, after which it is broken off').argParser(
        whole(1, 32_767),
      ),
    )
}

function stationsOf(text: string): readonly number[] {
  const numbers = text.split(',').map((part) => (/^\s*\d+\s*$/.test(part) ? Number(part) : Number.NaN))
  if (numbers.some(Number.isNaN)) throw new InvalidArgumentError('It is numbers with commas between, e.g. 0,1,2.')
  if (new Set(numbers).size < numbers.length) throw new InvalidArgumentError('A station is there once.')
  return numbers
}

/**
 * Whether a serial line is meant: by an option that only a line has, or by the profile.
 * @throws RequestError BAD_OPTION for options that do not go together
 */
export function isLine(command: Command, { profile, frame }: LineOptions): boolean {
  const given = (name: string) => command.getOptionValueSource(name) === 'cli'
  const names = command.options.map((option) => option.attributeName())
  const isChosen = frame !== undefined && !ethernetFrameNames.some((name) => name === frame)
  const line = given('serial') || given('stations') || isChosen || profiles[profile].serial !== undefined
  const wrong = names.find((name) => given(name) && (line ? !(name in OWN || name in SHARED) : name in OWN))
  if (wrong === undefined) return line
  const flag = command.options.find((option) => option.attributeName() === wrong)?.long ?? wrong
  const message = line
    ? `A serial line has no ${flag}.`
    : `${flag} is for a serial line: give --stations, --serial, or a frame or profile of a serial line.`
  throw new RequestError('BAD_OPTION', message, wrong)
}

export async function simulateLine(terminal: Terminal, command: Command, options: LineOptions): Promise<number> {
  const line = createLineSimulator(lineOptionsOf(command, options))
  for (const text of options.fault) line.faults.add(faultOf(text))
  await line.listen()
  const interrupted = interruption()
  if (options.plant === true) for (const station of line.stations.values()) startDemoPlant(station)
  if (options.log === true) logLine(terminal, line)
  show(terminal, line, options)
  await interrupted
  await line.close()
  return exitCodes.ok.code
}

function lineOptionsOf(command: Command, options: LineOptions): LineSimulatorOptions {
  const { serial: path, stations = [0], frame, messageFormat, sumCheck, asciiXy, host, port } = options
  const { pace = false, echo = false, messageWait, silence, scanTime, resetAllowed } = options
  const speed = speedOf(options)
  const listens = path === undefined || command.getOptionValueSource('port') === 'cli'
  const station = definedOf({ scanTime, resetAllowed })
  // The usual one of `simulate` is at Ethernet.
  const isChosen = command.getOptionValueSource('profile') === 'cli'
  return {
    ...(isChosen ? { profile: options.profile } : {}),
    stations: Object.fromEntries(stations.map((number) => [number, station])),
    ...definedOf({ messageFormat, sumCheck, asciiXy, messageWait, timeout: silence }),
    // The line says which ones there are.
    ...(frame === undefined ? {} : { frames: [frame as NonNullable<LineSimulatorOptions['frames']>[number]] }),
    echo,
    pace: pace ? speed : false,
    host,
    tcp: listens ? { port } : false,
    ...(path === undefined ? {} : { serial: { path, ...speed } }),
  }
}

function speedOf({ baudRate, dataLength, parity, stopBits, rts, messageFormat, serial }: LineOptions) {
  const usual = messageFormat === 5 ? { dataLength: 8 as const } : {}
  return {
    ...usual,
    ...definedOf({ baudRate, dataLength, parity, stopBits, rts: serial === undefined ? undefined : rts }),
  }
}

function show(terminal: Terminal, line: LineSimulator, options: LineOptions): void {
  const stations = [...line.stations.values()]
  const [first] = stations
  const tags = demoPlantTags[plantVariantOf(first?.profile.id ?? 'fx5-serial')]
  const { serial, messageFormat = 1, sumCheck, frame, plant } = options
  const numbers = stations.map(({ number }) => number)
  if (options.json === true) {
    const { tcp } = line
    const plantTags = plant === true ? { plant: tags } : {}
    terminal.out(
      json({ profile: first?.profile.id, serial, tcp, stations: numbers, messageFormat, sumCheck, ...plantTags }),
    )
    return
  }
  const rows = [
    ...(serial === undefined ? [] : [['Serial', line.hosts[0]?.remote ?? serial]]),
    ...addressRow('TCP', line.tcp),
    ['Stations', numbers.join(', ')],
    ['Format', `${messageFormat}, ${sumCheck ? 'with' : 'without'} sum check code`],
    ...(frame === undefined ? [] : [['Frame', frame]]),
  ]
  terminal.out(
    [
      `Simulated serial line of ${first?.profile.title}. Ctrl-C ends it.`,
      table(rows, '  '),
      ...(options.fault.length === 0 ? [] : [`Faults: ${options.fault.join('  ')}`]),
      ...(plant === true ? ['', 'Demo plant in each station:', plantTable(tags)] : []),
    ].join('\n'),
  )
  if (line.tcp !== undefined && !isLoopback(options.host))
    terminal.error(`Everybody who reaches ${options.host} can write to these simulated PLCs.`)
}

function logLine(terminal: Terminal, line: LineSimulator): void {
  line.on('host', ({ change, host: { remote } }) => terminal.error(`${remote} ${change}`))
  line.on('request', (event) => terminal.error(`${event.remote} station ${event.station} ${outcomeText(event)}`))
}
