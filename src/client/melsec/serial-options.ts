// The options of a serial line: defaults and checks. One PLC has them among its client's, several that share a line on it.
import { definedOf } from '../../basics/defined'
import { checkNames, type OptionNames, oneOf, wholeNumber } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import type { RecoveryOptions } from '../../link/link'
import {
  checkFormat,
  type SerialFormat,
  type SerialFrameName,
  serialFrameNames,
} from '../../melsec/frame/serial-frames'
import type { SerialFrameOptions } from '../../melsec/frame/serial-framing'
import { lineTime, type SerialOptions, type SerialSettings, serialSettings } from '../../transport/serial'

/**
 * The serial port as the parameters of the PLC have it, and the times of the line. Behind a device server (`host` and `port`)
 * it has no `path`: the rest says how long characters take there. Times in milliseconds.
 */
export interface SerialPortOptions extends Omit<SerialOptions, 'path'> {
  /** `COM3`, `/dev/ttyUSB0`. */
  readonly path?: string
  /**
   * From the last character of a request until the first one of its answer, after which the PLC counts as silent: the longest
   * scan of its program, at least. Default 500.
   */
  readonly answerTime?: number
  /** Between two characters of an answer, after which the rest does not come; default 100, or more at low speeds. */
  readonly betweenBytes?: number
  /** Without a character, after which nothing asked before is answered any more; default 100, or more at low speeds. */
  readonly quiet?: number
  /** From the end of an answer until the next request, also to another PLC; default 0. */
  readonly gap?: number
  /** Whether the line gives back what is sent, as converters with one pair do; default `auto`: the first request shows it. */
  readonly echo?: (typeof ECHO)[number]
}

const ECHO = ['auto', 'always', 'never'] as const

/** What the manual leaves open (FX5 communication manual 42): the defaults are what its examples show. */
export type SerialFrameDetails = Partial<
  Pick<
    SerialFrameOptions,
    'etxInSum' | 'sumOfAck' | 'errorDigits' | 'errorInformation' | 'initialise' | 'answeredToAll'
  >
>

/** How the frames of a serial line look, as the parameters of the PLC have it. */
export interface SerialLineFormat {
  /** Frame of the line; default: 4C in format 5, else the profile's, on a shared line 3C. */
  readonly frame?: SerialFrameName
  /** Message format: 1 (default, as in a new project of GX Works3), 4, or 5 (4C only, binary code). */
  readonly messageFormat?: SerialFormat
  /** Sum check code; default true. Switch it on in the PLC: without it a damaged character is not noticed. */
  readonly sumCheck?: boolean
  /** What the manual leaves open. */
  readonly serialFrame?: SerialFrameDetails
}

/** A line with every default filled in. */
export interface SerialLineSettings {
  readonly frame: SerialFrameOptions & { readonly frame: SerialFrameName; readonly format: SerialFormat }
  /** Speed and form of the characters; of its own port, too, when it has one. */
  readonly port: SerialSettings
  readonly recovery: RecoveryOptions
}

const PORT_NAMES = {
  path: true,
  baudRate: true,
  dataLength: true,
  parity: true,
  stopBits: true,
  rts: true,
  answerTime: true,
  betweenBytes: true,
  quiet: true,
  gap: true,
  echo: true,
} as const satisfies OptionNames<SerialPortOptions>

const DETAIL_NAMES = {
  etxInSum: true,
  sumOfAck: true,
  errorDigits: true,
  errorInformation: true,
  initialise: true,
  answeredToAll: true,
} as const satisfies OptionNames<SerialFrameDetails>

const LONGEST = 60_000
/** Characters whose time is waited at low speeds. */
const PATIENCE = 10
/** ms: adapters and device servers hand on what they have after a while only. */
const LEAST_TIME = 100
/** ms: a long scan, and the delays of adapters. */
const ANSWER_TIME = 500
/** Of a port behind a device server: errors of its settings name no path. */
const ELSEWHERE = 'a device server'

/**
 * @param usual the frame when none is said
 * @throws RequestError BAD_OPTION naming the option
 */
export function settleSerialLine(
  options: SerialLineFormat & { readonly serial?: SerialPortOptions | undefined },
  usual: SerialFrameName = '3C',
): SerialLineSettings {
  const frame = frameOf(options, usual)
  const port = portOf(options.serial ?? {}, frame.format)
  const least = Math.max(LEAST_TIME, Math.ceil(lineTime(PATIENCE, port)))
  const { answerTime = ANSWER_TIME, betweenBytes = least, quiet = least, gap = 0, echo = 'auto' } = options.serial ?? {}
  return {
    frame,
    port,
    recovery: {
      byteTime: lineTime(1, port),
      answerTime: wholeNumber('serial.answerTime', answerTime, 1, LONGEST),
      betweenBytes: wholeNumber('serial.betweenBytes', betweenBytes, 1, LONGEST),
      quiet: wholeNumber('serial.quiet', quiet, 1, LONGEST),
      gap: wholeNumber('serial.gap', gap, 0, LONGEST),
      echo: oneOf('serial.echo', echo, ECHO),
    },
  }
}

function frameOf(options: SerialLineFormat, usual: SerialFrameName): SerialLineSettings['frame'] {
  const format = oneOf('messageFormat', options.messageFormat ?? 1, [1, 4, 5])
  const frame = oneOf('frame', options.frame ?? (format === 5 ? '4C' : usual), serialFrameNames)
  checkFormat(frame, format)
  const details = options.serialFrame ?? {}
  checkNames('serialFrame.', details, DETAIL_NAMES)
  for (const name of ['etxInSum', 'sumOfAck', 'errorInformation', 'answeredToAll'] as const) {
    oneOf(`serialFrame.${name}`, details[name], [undefined, true, false])
  }
  oneOf('serialFrame.errorDigits', details.errorDigits, [undefined, 2, 4])
  oneOf('serialFrame.initialise', details.initialise, [undefined, 'EOT', 'CL'])
  return { frame, format, sumCheck: oneOf('sumCheck', options.sumCheck ?? true, [true, false]), ...details }
}

function portOf(given: SerialPortOptions, format: SerialFormat): SerialSettings {
  checkNames('serial.', given, PORT_NAMES)
  const { baudRate, dataLength, parity, stopBits, rts, path = ELSEWHERE } = given
  const rest = definedOf({ baudRate, dataLength, parity, stopBits, rts })
  const usual = format === 5 ? { dataLength: 8 as const } : {}
  const port = named(() => serialSettings({ ...usual, ...rest, path }))
  if (format !== 5 || port.dataLength === 8) return port
  const message = `Format 5 sends binary data, which need 8 bits: serial.dataLength is ${shown(port.dataLength)}.`
  throw new RequestError('BAD_OPTION', message, 'serial.dataLength')
}

/** Errors of the port name its options as they stand here. */
function named<T>(make: () => T): T {
  try {
    return make()
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    throw new RequestError(error.code, `serial.${error.message}`, `serial.${error.field}`)
  }
}
