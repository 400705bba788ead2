// Framing of the serial frames: frame, format, and what the manual leaves open.
import { badMessage, type DataCode } from '../../codec/codec'
import type { Framing, Head } from '../../link/link'
import { type BodyLayout, plainBody, serialBody } from './body'
import { asciiFraming, checkCharacters } from './serial-ascii'
import { format5 } from './serial-binary'
import {
  allStations,
  type ControlCode,
  checkFormat,
  controlCodes,
  factsOfSerial,
  LONGEST_SERIAL_FRAME,
  type SerialFormat,
  type SerialFrameName,
  type SerialHead,
  serialFormatCodes,
  serialRouteFields,
} from './serial-frames'

export interface SerialFrameOptions {
  readonly frame: SerialFrameName
  readonly format: SerialFormat
  /** Sum check code: a parameter of the PLC's port. Default true. */
  readonly sumCheck?: boolean
  /** Formats 1 and 4: whether the sum of an answer with data includes its ETX. The text does not say; default true. */
  readonly etxInSum?: boolean
  /** Formats 1 and 4: a sum check code behind ACK and NAK. The text shows none; default false. */
  readonly sumOfAck?: boolean
  /** Formats 1 and 4: digits of the error code behind NAK; default 2 in 1C, 4 in 3C and 4C. */
  readonly errorDigits?: 2 | 4
  /** Format 5: error information behind an error code, as in 3E. The text shows none; default false. */
  readonly errorInformation?: boolean
  /** Formats 1 and 4: what brings the PLC to a known state. Default EOT. */
  readonly initialise?: 'EOT' | 'CL'
  /** 1C: whether a station answers the global signal to all of them (44.6 does not say it). Default false. */
  readonly answeredToAll?: boolean
}

/** Format 5 has no control code for it. The manual names a command 1615 (42.3), which its list of commands lacks. */
const NOTHING = Buffer.alloc(0)
/** More than any frame has around its data. */
const HEAD_AND_SUM = 64
const SUM = 2

/** Framing of a serial frame: also says what stands around the data of a command. */
export interface SerialFraming extends Framing<SerialHead> {
  readonly body: BodyLayout
  readonly code: DataCode
  /** @throws RequestError BAD_MESSAGE for a body that the frame cannot carry, as `write` does */
  checkBody?(body: Uint8Array): void
  /** Length of the body of a request that is there as a whole: format 1 does not say where it ends. */
  wholeBody(soFar: Buffer): number
}

/**
 * Framing of 1C, 3C or 4C. A request in format 1 carries no length: its responder must know where a body ends.
 * @throws RequestError BAD_OPTION when the frame does not have the format
 * @example const framing = serialFraming({ frame: '3C', format: 4 })
 */
export function serialFraming(options: SerialFrameOptions): SerialFraming {
  const { frame, format, sumCheck = true, errorInformation = false } = options
  checkFormat(frame, format)
  const common = {
    name: `${frame} format ${format}`,
    correlation: 'order',
    code: serialFormatCodes[format],
    mismatch: (asked: SerialHead, answered: Head) => mismatch(frame, asked, answered),
    wholeBody: (soFar: Buffer) => soFar.length - (sumCheck ? SUM : 0),
  } as const
  if (format === 5) {
    const body = errorInformation ? plainBody : serialBody
    return { ...common, ...format5(factsOfSerial(frame), sumCheck), body, checkBody: checkSize, recovery: NOTHING }
  }
  const {
    etxInSum = true,
    sumOfAck = false,
    errorDigits = factsOfSerial(frame).errorDigits,
    initialise = 'EOT',
  } = options
  return {
    ...common,
    ...asciiFraming({ facts: factsOfSerial(frame), crLf: format === 4, sumCheck, etxInSum, sumOfAck, errorDigits }),
    body: serialBody,
    checkBody(body) {
      checkSize(body)
      checkCharacters(body)
    },
    recovery: recoveryIn(format, initialise),
  }
}

/** A scan refuses what is longer, so that a broken frame ends. */
function checkSize(body: Uint8Array): void {
  const most = LONGEST_SERIAL_FRAME - HEAD_AND_SUM
  if (body.length > most) badMessage(`a serial frame carries at most ${most} bytes of a message, not ${body.length}`)
}

/** The control code alone, without any station: 42.3. */
function recoveryIn(format: 1 | 4, code: ControlCode): Buffer {
  const { CR, LF } = controlCodes
  return Buffer.from(format === 4 ? [controlCodes[code], CR, LF] : [controlCodes[code]])
}

function mismatch(frame: SerialFrameName, asked: SerialHead, answered: Head): string | undefined {
  for (const field of factsOfSerial(frame).route) {
    // What is for all stations is answered by one of them, if at all.
    if (field === 'station' && asked.station === allStations.station) continue
    const wanted = asked[field] ?? serialRouteFields[field].own
    if (wanted !== answered[field]) return `${field} is ${answered[field]}, asked ${wanted}`
  }
  return undefined
}
