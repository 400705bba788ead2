// The options that say which PLC, the same for every command that talks to one.
import { type Command, InvalidArgumentError, Option } from 'commander'
import {
  createMelsecClient,
  encodings,
  ethernetFrameNames,
  type FrameName,
  frameNames,
  type MelsecClient,
  type MelsecClientOptions,
  moduleIoNumbers,
  type NetworkPlc,
  type OpenTransport,
  PlcError,
  type ProfileId,
  probeKinds,
  profileIds,
  profiles,
  RequestError,
  type SerialPlc,
  type ValueFormat,
} from '../index'
import { choice, given, whole } from './option'
import { addSerialLineOptions, type SerialLineOptions, serialPortOf } from './serial-options'
import type { Terminal } from './terminal'

/** The options as commander gives them. */
export interface ConnectionOptions extends SerialLineOptions {
  readonly plc?: string
  readonly host?: string
  readonly port?: number
  readonly udp?: boolean
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
  readonly monitoringTimer?: number
  readonly localAddress?: string
  readonly localPort?: number
  readonly probe?: NonNullable<MelsecClientOptions['probe']>
  readonly timeout?: number
  readonly connectTimeout: number
  readonly password?: boolean
  readonly trace?: boolean
  readonly json?: boolean
}

/** The options that say how words become values. */
export interface FormatOptions {
  readonly wordOrder?: NonNullable<ValueFormat['wordOrder']>
  readonly byteOrder?: NonNullable<ValueFormat['byteOrder']>
  readonly encoding?: NonNullable<ValueFormat['encoding']>
}

const ORDERS = ['low-first', 'high-first'] as const satisfies readonly NonNullable<ValueFormat['wordOrder']>[]

export const jsonOption = () => new Option('--json', 'print one JSON document instead of text')
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

/** Adds the options that say which PLC. */
export function addConnectionOptions(command: Command): Command {
  command
    .optionsGroup('Which PLC:')
    .option(
      '--plc <host:port>',
      `address and port of the PLC, e.g. 192.168.3.39:5010; else ${VARIABLE} in the environment`,
    )
    .addOption(new Option('--host <host>', 'address of the PLC'))
    .addOption(
      new Option('--port <number>', 'port of an SLMP (MC protocol) entry of the PLC, decimal').argParser(
        whole(1, 65535),
      ),
    )
    .addOption(new Option('--udp', 'UDP; without it TCP'))
    .addOption(new Option('--serial <path>', 'serial port instead, e.g. COM3 or /dev/ttyUSB0'))
    .addOption(profileOption().default('generic'))
    .addOption(frameOption("frame; default: the profile's", frameNames))
  addCodeOptions(command)
  command
    .addOption(choice('--ascii-word-order <order>', 'labels in ASCII code: order of the words of a value', ORDERS))
    .addOption(xyRadixOption())
    .addOption(wRadixOption())
    .addOption(new Option('--password', `ask for the remote password; without it ${PASSWORD} is used, if set`))
  addSerialLineOptions(command.optionsGroup('Serial line, also behind a device server:'))
  return command
    .addOption(
      new Option('--message-wait <ms>', '1C: the PLC waits so long before it answers; 0 to 150').argParser(
        whole(0, 150),
      ),
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
    .optionsGroup('Times and ports:')
    .addOption(
      new Option('--monitoring-timer <ms>', 'time the PLC gives a request; 0 = for ever').argParser(
        whole(0, 16_383_750),
      ),
    )
    .addOption(new Option('--local-address <address>', 'address of the network interface to use'))
    .addOption(
      new Option('--local-port <number>', "fixed port of this computer, when the PLC's entry names one").argParser(
        whole(1, 65535),
      ),
    )
    .addOption(choice('--probe <name>', 'request that proves the connection (default: auto)', probeKinds))
    .addOption(new Option('--timeout <ms>', 'time for an answer (default: 3000)').argParser(whole(1, 3_600_000)))
    .addOption(
      new Option('--connect-timeout <ms>', 'time for the connection').default(5000).argParser(whole(1, 3_600_000)),
    )
    .optionsGroup('Output:')
    .addOption(new Option('--trace', 'show every frame, explained, on the error output'))
    .addOption(jsonOption())
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

/** Names the PLC when no option does. */
const VARIABLE = 'MELSEC_JW_PLC'

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

/** Address and port: both from the options, or both from the environment, never one from each. */
export function peerOf({ plc, host, port }: ConnectionOptions): { readonly host: string; readonly port: number } {
  if (plc !== undefined && host !== undefined) throw badPeer('Give --plc or --host, not both.', 'plc')
  const text = plc ?? (host === undefined && port === undefined ? process.env[VARIABLE] : undefined)
  const given = text === undefined ? {} : splitPeer(text)
  if (given.port !== undefined && port !== undefined) {
    throw badPeer(`The port is given twice, as ${given.port} and as ${port}.`, 'port')
  }
  const found = { host: host ?? given.host, port: port ?? given.port }
  if (found.host === undefined || found.host === '') {
    throw badPeer('Which PLC? Give its address and port, e.g. --plc 192.168.3.39:5010.', 'host')
  }
  if (found.port === undefined) {
    const example = `--plc ${found.host}:5010`
    throw badPeer(
      `Which port of ${found.host}? Give the port of its SLMP (MC protocol) entry, e.g. ${example}.`,
      'port',
    )
  }
  return { host: found.host, port: found.port }
}

function badPeer(message: string, option: string): RequestError {
  return new RequestError('BAD_OPTION', message, option)
}

/** `host`, `host:port`, `[IPv6]:port`, IPv6. */
function splitPeer(text: string): { readonly host?: string; readonly port?: number } {
  const [, bracketed, plain, digits] = /^(?:\[([^\]]*)\]|([^:]*))(?::(\d+))?$/.exec(text.trim()) ?? []
  const host = bracketed ?? plain ?? text.trim()
  if (digits === undefined) return { host }
  const port = Number(digits)
  if (port >= 1 && port <= 65535) return { host, port }
  throw badPeer(`${digits} is not a port: 1 to 65535.`, 'port')
}

/** The client's options; `allow` is what the command itself needs. */
export function clientOptions(
  options: ConnectionOptions & FormatOptions,
  allow: Pick<MelsecClientOptions, 'allowWrites' | 'allowControl'> = {},
): MelsecClientOptions {
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
      'probe',
      'timeout',
      'messageFormat',
      'messageWait',
    ]),
    // Commander has it as true without the option.
    ...(options.sumCheck === false ? { sumCheck: false } : {}),
    ...allow,
  }
}

/** Address and port, or a serial port. */
function wayTo(options: ConnectionOptions): NetworkPlc | SerialPlc {
  const { serial: path, udp } = options
  const { path: _, ...line } = serialPortOf(options) ?? {}
  if (path !== undefined) {
    const other = (['plc', 'host', 'port', 'udp'] as const).find((name) => options[name] !== undefined)
    if (other !== undefined) throw badPeer(`Give --serial or --${other}, not both.`, 'serial')
    return { serial: { ...line, path } }
  }
  const server = Object.keys(line).length === 0 ? {} : { serial: line }
  return { ...peerOf(options), ...server, ...(udp === true ? { transport: 'udp' } : {}) }
}

/** The data code. Of a serial frame the message format says it. */
function codeOf({ ascii, profile = 'generic', frame = profiles[profile].frame }: ConnectionOptions) {
  if (ascii === true) return { code: 'ascii' } as const
  return ethernetFrameNames.some((name) => name === frame) ? ({ code: 'binary' } as const) : {}
}

/** e.g. `tcp 192.168.3.39:5010`, `serial /dev/ttyUSB0` */
export function peerText(options: ConnectionOptions): string {
  if (options.serial !== undefined) return `serial ${options.serial}`
  const { host, port } = peerOf(options)
  return `${options.udp === true ? 'udp' : 'tcp'} ${host.includes(':') ? `[${host}]` : host}:${port}`
}

/** Connects, does `work`, and closes whatever happens. */
export async function withClient<T>(
  terminal: Terminal,
  options: ConnectionOptions & FormatOptions,
  allow: Pick<MelsecClientOptions, 'allowWrites' | 'allowControl'>,
  work: (client: MelsecClient) => Promise<T>,
  /** Before it connects: to miss nothing that comes at once. */
  prepare: (client: MelsecClient) => void = () => {},
): Promise<T> {
  const password = await passwordOf(terminal, options)
  const client = createMelsecClient({ ...clientOptions(options, allow), ...given({ password }, ['password']) })
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

/** ms for the answer that proves the connection, when nobody says how long. */
const USUAL_TIME = 3000

const nowhere: OpenTransport = () => {
  throw new Error('There is no way to a PLC: only what is refused before it is sent counts.')
}

/**
 * What the client refuses before it sends anything, such as a command that the profile lacks: said before anybody is
 * asked, and before a connection is tried. A client that cannot connect makes the call.
 * @throws RequestError
 */
export async function refuseUnsent(
  options: ConnectionOptions,
  allow: Pick<MelsecClientOptions, 'allowWrites' | 'allowControl'>,
  call: (client: MelsecClient) => Promise<unknown>,
): Promise<void> {
  const client = createMelsecClient({ ...clientOptions(options, allow), openTransport: nowhere })
  try {
    await call(client)
  } catch (error) {
    if (error instanceof RequestError || !(error instanceof PlcError)) throw error
  } finally {
    await client.close()
  }
}
