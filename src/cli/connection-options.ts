// The options that say which PLC, the same for every command that talks to one; of MELSEC, and what they share with other families.
import { type Command, InvalidArgumentError, Option } from 'commander'
import {
  createMelsecClient,
  encodings,
  ethernetFrameNames,
  type FrameName,
  frameNames,
  type JwProbeKind,
  jwProbeKinds,
  type MelsecClient,
  type MelsecClientOptions,
  moduleIoNumbers,
  type NetworkPlc,
  type ProbeKind,
  type ProfileId,
  probeKinds,
  profileIds,
  profiles,
  type SerialPlc,
  type ValueFormat,
} from '../index'
import { type FamilyOptions, familyOption, onlyFor } from './family'
import { addJwOptions, type JwConnectionOptions } from './jw/connection'
import { choice, given, named, whole } from './option'
import { addPeerOptions, badPeer, networkText, type PeerOptions, peerOf } from './peer'
import { addSerialLineOptions, type SerialLineOptions, serialPortOf } from './serial-options'
import {
  addSessionOptions,
  connected,
  type Need,
  nowhere,
  type Plc,
  refusedUnsent,
  type SessionOptions,
} from './session'
import type { Terminal } from './terminal'

/** The options as commander gives them. */
export interface ConnectionOptions extends SerialLineOptions, PeerOptions, SessionOptions, FamilyOptions {
  readonly profile?: ProfileId
  readonly frame?: FrameName
  readonly ascii?: boolean
  readonly asciiXy?: 'octal' | 'hexadecimal'
  readonly asciiZr?: 'decimal' | 'hexadecimal'
  readonly asciiWordOrder?: 'low-first' | 'high-first'
  readonly xyRadix?: 8 | 16
  readonly wRadix?: 10 | 16
  readonly network?: number
  readonly station?: number
  readonly moduleIo?: number
  readonly multidrop?: number
  readonly extensionStation?: number
  readonly pc?: number
  readonly selfStation?: number
  readonly messageWait?: number
  readonly answerTime?: number
  readonly monitoringTimer?: number
  readonly probe?: ProbeKind | JwProbeKind
  readonly password?: boolean
}

/** The options that say which PLC, of any family. */
export type AnyConnectionOptions = ConnectionOptions & JwConnectionOptions

/** The options that say how words become values. */
export interface FormatOptions {
  readonly wordOrder?: NonNullable<ValueFormat['wordOrder']>
  readonly byteOrder?: NonNullable<ValueFormat['byteOrder']>
  readonly encoding?: NonNullable<ValueFormat['encoding']>
}

const ORDERS = ['low-first', 'high-first'] as const satisfies readonly NonNullable<ValueFormat['wordOrder']>[]

export const profileOption = () => choice('--profile <id>', 'family of the PLC', profileIds)

/** Options of data code, also of a simulated PLC. */
export function addCodeOptions(command: Command): Command {
  return addDigitOptions(command.addOption(new Option('--ascii', 'communication data code ASCII; without it binary')))
}

/** Options of the digits in ASCII code. */
export function addDigitOptions(command: Command): Command {
  return command
    .addOption(
      choice('--ascii-xy <digits>', 'ASCII code on iQ-F: as the port is set, "X,Y OCT" or "X,Y HEX"', [
        'octal',
        'hexadecimal',
      ]),
    )
    .addOption(choice('--ascii-zr <digits>', 'ASCII code: digits of ZR', ['decimal', 'hexadecimal']))
}

export const xyRadixOption = () =>
  new Option(
    '--xy-radix <8|16>',
    "X and Y are written in octal (8) or hexadecimal (16); default: the profile's",
  ).argParser(radix)

export const wRadixOption = () =>
  new Option(
    '--w-radix <10|16>',
    "W is written in decimal (10, as SLMP inverters are said to) or hexadecimal (16); default: the profile's",
  ).argParser(wRadix)

/** `names`: the frames that make sense there. */
export function frameOption<N extends FrameName>(description: string, names: readonly N[]): Option {
  return choice('--frame <name>', description, names)
}

const INSTEAD = {
  plc: 'A Sharp JW has one kind of messages, in binary, with octal addresses: leave it out. --model says the family of its CPU, --header what stands in front of messages.',
  serial: 'The serial computer link of a Sharp JW is not spoken here: give address and port of its Ethernet unit.',
  route: 'Another station of a Sharp JW is behind its FL-net unit: --header relay:pda,psa,slot,station.',
  times: 'A Sharp JW is told no such time: leave it out. --timeout says how long this computer waits.',
} as const

/** Adds the options that say which PLC, to a command that only MELSEC has; `--family jw` is taken, to be refused with what to do. */
export function addConnectionOptions(command: Command): Command {
  return addAllOptions(command, () => {})
}

/** Adds the options that say which PLC, of any family. */
export function addAnyConnectionOptions(command: Command): Command {
  return addAllOptions(command, () =>
    onlyFor('jw', 'With a Sharp JW say --family jw, with a MELSEC leave it out.', command, addJwOptions),
  )
}

function addAllOptions(command: Command, addOthers: () => void): Command {
  command.optionsGroup('Which PLC:')
  addPeerOptions(command).addOption(familyOption())
  onlyFor('melsec', INSTEAD.serial, command, addSerialPortOption)
  onlyFor('melsec', INSTEAD.plc, command, addPlcOptions)
  onlyFor('melsec', INSTEAD.serial, command, addLineOptions)
  onlyFor('melsec', INSTEAD.route, command, addRouteOptions)
  addOthers()
  return addSessionOptions(command, addTimeOptions)
}

function addSerialPortOption(command: Command): void {
  command.addOption(new Option('--serial <path>', 'serial port instead, e.g. COM3 or /dev/ttyUSB0'))
}

function addPlcOptions(command: Command): void {
  command
    .addOption(profileOption().default('generic'))
    .addOption(frameOption("frame; default: the profile's", frameNames))
  addCodeOptions(command)
  command
    .addOption(choice('--ascii-word-order <order>', 'labels in ASCII code: order of the words of a value', ORDERS))
    .addOption(xyRadixOption())
    .addOption(wRadixOption())
    .addOption(new Option('--password', `ask for the remote password; without it ${PASSWORD} is used, if set`))
}

function addLineOptions(command: Command): void {
  addSerialLineOptions(command.optionsGroup('Serial line, also behind a device server:'))
  command.addOption(
    new Option('--message-wait <ms>', '1C: the PLC waits so long before it answers; 0 to 150').argParser(whole(0, 150)),
  )
}

function addRouteOptions(command: Command): void {
  command
    .addOption(
      new Option(
        '--answer-time <ms>',
        'until the first character of an answer, then the PLC counts as silent; default 500',
      ).argParser(whole(1, 60_000)),
    )
    .optionsGroup('Another station or CPU:')
    .addOption(new Option('--network <number>', 'another network').argParser(whole(0, 255)))
    .addOption(
      new Option(
        '--station <number>',
        'another station of that network, above 120 with --frame ext; on a serial line its station',
      ).argParser(whole(0, 65_534)),
    )
    .addOption(new Option('--pc <number>', 'serial line: PC number, decimal').argParser(whole(0, 255)))
    .addOption(new Option('--self-station <number>', 'serial line: self-station number').argParser(whole(0, 31)))
    .addOption(
      new Option(
        '--module-io <number>',
        `another CPU: hexadecimal, or ${moduleIoNumbers.map(({ name }) => name).join(', ')}`,
      ).argParser(moduleIo),
    )
    .addOption(new Option('--multidrop <number>', 'station behind a serial module').argParser(whole(0, 31)))
    .addOption(
      new Option(
        '--extension-station <number>',
        '--frame ext: the number of a station whose number means something else, with --station 124',
      ).argParser(whole(0, 65_535)),
    )
}

function addTimeOptions(command: Command): void {
  onlyFor('melsec', INSTEAD.times, command, () =>
    command.addOption(
      new Option('--monitoring-timer <ms>', 'time the PLC gives a request; 0 = for ever').argParser(
        whole(0, 16_383_750),
      ),
    ),
  )
  const names = [...new Set([...probeKinds, ...jwProbeKinds])]
  const description = `request that proves the connection; MELSEC ${probeKinds.join(', ')} (default: auto), Sharp JW ${jwProbeKinds.join(', ')} (default: writeMode)`
  command.addOption(choice('--probe <name>', description, names))
}

export const encodingOption = (description: string) => choice('--encoding <name>', description, encodings)

/** Adds the options that say how words become values. */
export function addFormatOptions(command: Command): Command {
  return command
    .optionsGroup('Values:')
    .addOption(choice('--word-order <order>', 'order of the words of a value', ORDERS))
    .addOption(choice('--byte-order <order>', 'order of the bytes of a word', ORDERS))
    .addOption(encodingOption('encoding of STRING'))
}

function radix(text: string): 8 | 16 {
  if (text === '8' || text === '16') return text === '8' ? 8 : 16
  throw new InvalidArgumentError('It is 8 (octal) or 16 (hexadecimal).')
}

function wRadix(text: string): 10 | 16 {
  if (text === '10' || text === '16') return text === '10' ? 10 : 16
  throw new InvalidArgumentError('It is 10 (decimal) or 16 (hexadecimal).')
}

function moduleIo(text: string): number {
  const named = moduleIoNumbers.find(({ name }) => name.toLowerCase() === text.toLowerCase())
  if (named !== undefined) return named.number
  if (/^(0x)?[0-9a-f]{1,4}h?$/i.test(text)) return Number.parseInt(text.replace(/^0x/i, ''), 16)
  throw new InvalidArgumentError('It is a hexadecimal number such as 3E1, or a name.')
}

/** Remote password: not an option, because the arguments of a program are seen by everybody on the computer. */
const PASSWORD = 'MELSEC_JW_PASSWORD'

/** The remote password: from the environment, or typed when `--password` says so. */
async function passwordOf(terminal: Terminal, options: ConnectionOptions): Promise<string | undefined> {
  if (options.password !== true) return process.env[PASSWORD] || undefined
  if (!terminal.interactive) throw badPeer(`This is no terminal to ask on. Set ${PASSWORD} instead.`, 'password')
  return terminal.ask('Remote password: ', { hidden: true })
}

/** The remote password of a simulated PLC: from the environment, else typed. @throws RequestError */
export async function simulatedPassword(terminal: Terminal): Promise<string> {
  const set = process.env[PASSWORD]
  if (set) return set
  if (!terminal.interactive) throw badPeer(`This is no terminal to ask on. Set ${PASSWORD} instead.`, 'password')
  return terminal.ask('Remote password of the simulated PLC: ', { hidden: true })
}

type Allowed = Pick<MelsecClientOptions, 'allowWrites' | 'allowControl'>

/** The client's options; `allow` is what the command itself needs. */
export function clientOptions(options: ConnectionOptions & FormatOptions, allow: Allowed = {}): MelsecClientOptions {
  return {
    ...wayTo(options),
    ...codeOf(options),
    connectTimeout: options.connectTimeout,
    route: given(options, ['network', 'station', 'moduleIo', 'multidrop', 'extensionStation', 'pc', 'selfStation']),
    format: given(options, ['wordOrder', 'byteOrder', 'encoding']),
    ...given(options, [
      'profile',
      'frame',
      'asciiXy',
      'asciiZr',
      'asciiWordOrder',
      'xyRadix',
      'wRadix',
      'monitoringTimer',
      'localAddress',
      'localPort',
      'timeout',
      'messageFormat',
      'messageWait',
    ]),
    // Commander has it as true without the option.
    ...(options.sumCheck === false ? { sumCheck: false } : {}),
    ...(options.probe === undefined ? {} : { probe: named('probe', options.probe, probeKinds) }),
    ...allow,
  }
}

/** Address and port, or a serial port. */
function wayTo(options: ConnectionOptions): NetworkPlc | SerialPlc {
  const { serial: path, udp } = options
  const { path: _, ...port } = serialPortOf(options) ?? {}
  const line = { ...port, ...given(options, ['answerTime']) }
  if (path !== undefined) {
    const other = (['plc', 'host', 'port', 'udp'] as const).find((name) => options[name] !== undefined)
    if (other !== undefined) throw badPeer(`Give --serial or --${other}, not both.`, 'serial')
    return { serial: { ...line, path } }
  }
  const server = Object.keys(line).length === 0 ? {} : { serial: line }
  return { ...peerOf(options, 'melsec'), ...server, ...(udp === true ? { transport: 'udp' } : {}) }
}

/** The data code. Of a serial frame the message format says it. */
function codeOf({ ascii, profile = 'generic', frame = profiles[profile].frame }: ConnectionOptions) {
  if (ascii === true) return { code: 'ascii' } as const
  return ethernetFrameNames.some((name) => name === frame) ? ({ code: 'binary' } as const) : {}
}

/** e.g. `tcp 192.168.3.39:5010`, `serial /dev/ttyUSB0` */
export function peerText(options: ConnectionOptions): string {
  if (options.serial !== undefined) return `serial ${options.serial}`
  return networkText(options, 'melsec')
}

/** Connects, does `work`, and closes whatever happens. */
export async function withClient<T>(
  terminal: Terminal,
  options: ConnectionOptions & FormatOptions,
  allow: Allowed,
  work: (client: MelsecClient) => Promise<T>,
  /** Before it connects: to miss nothing that comes at once. */
  prepare: (client: MelsecClient) => void = () => {},
): Promise<T> {
  const password = await passwordOf(terminal, options)
  const client = createMelsecClient({ ...clientOptions(options, allow), ...given({ password }, ['password']) })
  return connected(terminal, options, client, work, prepare)
}

/**
 * What the client refuses before it sends anything, such as a command that the profile lacks: said before anybody is
 * asked, and before a connection is tried. A client that cannot connect makes the call.
 * @throws RequestError
 */
export async function refuseUnsent(
  options: ConnectionOptions,
  allow: Allowed,
  call: (client: MelsecClient) => Promise<unknown>,
): Promise<void> {
  await refusedUnsent(createMelsecClient({ ...clientOptions(options, allow), openTransport: nowhere }), call)
}

/** What each need allows. */
const ALLOWED: Readonly<Record<Need, Allowed>> = {
  reading: {},
  writing: { allowWrites: true },
  control: { allowControl: true },
  // Parameters of a MELSEC are written as whatever they are in.
  parameters: {},
}

/** A MELSEC PLC, for what is done with one of any family. */
export function melsecPlc(terminal: Terminal, options: ConnectionOptions & FormatOptions): Plc<MelsecClient> {
  return {
    text: peerText(options),
    offline: () => createMelsecClient(clientOptions(options)),
    unsent: (need, call) => refuseUnsent(options, ALLOWED[need], call),
    with: (need, work) => withClient(terminal, options, ALLOWED[need], work),
  }
}
