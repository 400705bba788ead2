// A line that several PLCs share: one serial port, or one device server, and one queue for all of them.
import { checkNames, type OptionNames, wholeNumber } from '../../basics/option-checks'
import { RequestError } from '../../errors'
import type { SerialFormat, SerialFrameName } from '../../melsec/frame/serial-frames'
import { serialFraming } from '../../melsec/frame/serial-framing'
import { type Clock, realClock } from '../../transport/clock'
import { serialTransport } from '../../transport/serial'
import { tcpTransport } from '../../transport/tcp'
import type { OpenTransport } from '../../transport/transport'
import { Line } from '../connection/line'
import {
  type SerialLineFormat,
  type SerialLineSettings,
  type SerialPortOptions,
  settleSerialLine,
} from './serial-options'

/** What carries the bytes of a line: a port of this computer (`serial.path`), or a device server. Times in milliseconds. */
export interface MelsecLineOptions extends SerialLineFormat {
  /** The serial port, and the times of the line. */
  readonly serial?: SerialPortOptions
  /** Address or name of a serial device server, which brings the line to a TCP port. */
  readonly host?: string
  /** TCP port of the device server. */
  readonly port?: number
  /** Time for an attempt to open it; 5000. */
  readonly connectTimeout?: number
  /** Makes the transport instead: for tests and the in-process simulator. */
  readonly openTransport?: OpenTransport
  /** Time, for tests. @internal */
  readonly clock?: Clock
}

/** A serial line for several clients. It is open as long as one of them is connected. */
export interface MelsecLine {
  /** What it is, e.g. `serial /dev/ttyUSB0 (19200 8E1)`. */
  readonly description: string
  /** Frame of all PLCs on it. */
  readonly frame: SerialFrameName
  /** Message format of all PLCs on it. */
  readonly messageFormat: SerialFormat
  /** Whether bytes can be sent. */
  readonly isOpen: boolean
}

const NAMES = {
  frame: true,
  messageFormat: true,
  sumCheck: true,
  serialFrame: true,
  serial: true,
  host: true,
  port: true,
  connectTimeout: true,
  openTransport: true,
  clock: true,
} as const satisfies OptionNames<MelsecLineOptions>

/** What the clients on it need beside what everybody may see. */
export class SerialLine implements MelsecLine {
  readonly settings: SerialLineSettings
  readonly line: Line
  /** Behind a device server. */
  readonly isRemote: boolean
  /** Others may ask the same PLC on it. */
  readonly isShared: boolean
  readonly #description: string

  /** `isOwn`: of one client, and made by it. */
  constructor(options: MelsecLineOptions, { isOwn = false }: { readonly isOwn?: boolean } = {}) {
    this.settings = settleSerialLine(options)
    this.isRemote = options.host !== undefined
    this.isShared = this.isRemote || !isOwn
    const openTransport = options.openTransport ?? transportOf(options, this.settings)
    this.#description = options.openTransport === undefined ? openTransport().description : 'a transport of its own'
    this.line = new Line({
      framing: serialFraming(this.settings.frame),
      openTransport,
      clock: options.clock ?? realClock,
      inFlight: 1,
      connectTimeout: wholeNumber('connectTimeout', options.connectTimeout ?? 5000, 1, LONGEST),
      timeout: LONGEST,
      recovery: this.settings.recovery,
      random: Math.random,
      // Only ports of datagrams are proved.
      proof: () => {
        throw new TypeError('A line has no port to prove')
      },
    })
  }

  get description(): string {
    return this.#description
  }

  get frame(): SerialFrameName {
    return this.settings.frame.frame
  }

  get messageFormat(): SerialFormat {
    return this.settings.frame.format
  }

  get isOpen(): boolean {
    return this.line.isOpen
  }
}

const LONGEST = 24 * 60 * 60 * 1000

function transportOf({ serial = {}, host, port }: MelsecLineOptions, settings: SerialLineSettings): OpenTransport {
  if (serial.path !== undefined) {
    if (host === undefined && port === undefined) return serialTransport(settings.port)
    const message = 'serial.path is a port of this computer and host a device server: give one of them.'
    throw new RequestError('BAD_OPTION', message, 'serial.path')
  }
  if (host === undefined || host.trim() === '') {
    const message = 'Which line? Give serial.path, e.g. COM3 or /dev/ttyUSB0, or host and port of a device server.'
    throw new RequestError('BAD_OPTION', message, 'serial.path')
  }
  return tcpTransport({ host, port: wholeNumber('port', port ?? 0, 1, 65_535) })
}

/**
 * Makes a line that several clients share; a single PLC needs none. Nothing is opened before the first client connects.
 * @throws RequestError BAD_OPTION naming the option that is wrong
 * @example
 * const line = createMelsecLine({ serial: { path: '/dev/ttyUSB0', baudRate: 19200 }, frame: '3C', messageFormat: 4 })
 * const [first, second] = [1, 2].map((station) => createMelsecClient({ line, profile: 'fx5-serial', route: { station } }))
 */
export function createMelsecLine(options: MelsecLineOptions): MelsecLine {
  checkNames('', options, NAMES)
  return new SerialLine(options)
}

/** @throws RequestError BAD_OPTION for what is none */
export function serialLineOf(line: MelsecLine): SerialLine {
  if (line instanceof SerialLine) return line
  throw new RequestError('BAD_OPTION', 'line is what createMelsecLine() gives.', 'line')
}
