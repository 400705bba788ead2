// A captured frame in words, field by field: for the command line, for traces, for people with a protocol analyser.
import { type DataCode, field, isSameDigit, measure, type Shape } from '../../codec/codec'
import { type Direction, Explainer, type FrameExplanation, notAFrame } from '../../codec/explanation'
import { RequestError } from '../../errors'
import type { Command } from '../commands/command'
import { knownCommands } from '../commands/known'
import { bodies } from '../frame/body'
import { frameFacts, type SlmpFrameName, slmpFrameNames } from '../frame/frames'
import { isConnectedStation, ownStation } from '../frame/route'
import { checkFormat, isSerialFrame, type SerialFrameName } from '../frame/serial-frames'
import { slmpFraming } from '../frame/slmp-frame'
import { addressOptionsOf, asciiXyOf } from '../profiles/profile'
import { resolveProfile } from '../profiles/profiles'
import {
  type ExplainSettings,
  explainErrorInformation,
  explainRequestBody,
  explainResponseBody,
  type KnownRequest,
  OTHER_COMMAND,
  readRequestBody,
} from './body'
import { explain1e } from './frame-1e'
import { describeHead, endCodeText } from './head'
import type { ExplainFrameOptions, Known } from './options'
import { explainSerial, serialFrameOf } from './serial'

export {
  type AnnotatedRow,
  type Direction,
  type FrameExplanation,
  type FrameFault,
  formatExplanation,
} from '../../codec/explanation'

/**
 * Explains a frame, also a broken one: then up to where it is wrong. Never throws for what is in the bytes.
 * @throws RequestError BAD_OPTION when there is no such profile, or the profile has no such setting.
 * @example console.log(formatExplanation(explainFrame(Buffer.from('500000ffff03000c00100001040000640000a80200', 'hex'))))
 */
export function explainFrame(bytes: Buffer, options: ExplainFrameOptions = {}): FrameExplanation {
  const profile = resolveProfile(options.profile ?? 'generic')
  const known: Known = {
    profile,
    ...addressOptionsOf(profile, options),
    asciiXy: asciiXyOf(profile, options.asciiXy),
    asciiZr: options.asciiZr,
    commands: options.commands ?? knownCommands,
  }
  if (options.frame === '1E') return explain1e(bytes, known, options)
  const serial = serialFrameIn(bytes, options)
  if (serial !== undefined) return explainSerial(bytes, serial, known, options)
  const detected = detect(bytes, options)
  return typeof detected === 'string'
    ? notAFrame(bytes, detected, hintsFor(bytes))
    : explain3e(bytes, known, detected, options)
}

// --- which frame it is

/** The serial frame that is said or shown by the bytes. @throws RequestError BAD_OPTION for a format it does not have */
function serialFrameIn(bytes: Buffer, { frame, format, sumCheck }: ExplainFrameOptions): SerialFrameName | undefined {
  const found = frame === undefined ? serialFrameOf(bytes) : isSerialFrame(frame) ? frame : undefined
  if (frame !== undefined && found === undefined && (format ?? sumCheck) !== undefined) {
    const option = format === undefined ? 'sumCheck' : 'format'
    throw new RequestError('BAD_OPTION', `The ${frame} frame has no ${option}: 1C, 3C and 4C have.`, option)
  }
  if (format === undefined) return found
  // Who says a format means a serial frame.
  const serial = found ?? (format === 5 ? '4C' : '1C')
  if (frame !== undefined) checkFormat(serial, format)
  return serial
}

interface Subheader {
  readonly frame: SlmpFrameName
  readonly code: DataCode
  readonly direction: Direction
  /** What the frame begins with: written by the framing itself. */
  readonly bytes: Buffer
}

const SUBHEADERS: readonly Subheader[] = slmpFrameNames.flatMap((frame) =>
  frameFacts[frame].codes.flatMap((code) => {
    const { request, response } = slmpFraming(frame, code)
    const head = { ...ownStation, timer: 0 }
    const size = code === 'ascii' ? 4 : 2
    const none = Buffer.alloc(0)
    return [
      { frame, code, direction: 'request', bytes: request.write(head, 0, none).subarray(0, size) },
      { frame, code, direction: 'response', bytes: response.write(head, 0, 0, none).subarray(0, size) },
    ] satisfies Subheader[]
  }),
)

/** The subheader the bytes begin with, or why there is none. */
function detect(bytes: Buffer, { frame, code, direction }: ExplainFrameOptions): Subheader | string {
  if (bytes.length === 0) return 'there are no bytes'
  const found = SUBHEADERS.filter((one) => {
    const size = Math.min(one.bytes.length, bytes.length)
    return beginsWith(bytes, one.code, one.bytes.subarray(0, size))
  })
  const fitting = found.filter(
    (one) =>
      (frame ?? one.frame) === one.frame &&
      (code ?? one.code) === one.code &&
      (direction ?? one.direction) === one.direction,
  )
  const [first] = fitting
  if (first !== undefined && fitting.length === 1) return first
  if (fitting.length > 1) return `${bytes.length} byte(s) are too few to tell the frame`
  const [other] = found
  if (other !== undefined && found.length === 1) return `this is the subheader of a ${nameOf(other)}`
  return `no 3E, 4E or station extension subheader, which is ${SUBHEADERS.map(shown).join(', ')}`
}

function beginsWith(bytes: Buffer, code: DataCode, subheader: Buffer): boolean {
  const start = bytes.subarray(0, subheader.length)
  if (code === 'binary' || start.length < subheader.length) return start.equals(subheader)
  return subheader.every((digit, i) => isSameDigit(digit, start[i]))
}

function nameOf({ frame, code, direction }: Pick<Subheader, 'frame' | 'code' | 'direction'>): string {
  return `${frameFacts[frame].title} ${direction}, ${code === 'ascii' ? 'ASCII' : 'binary'} code`
}

function shown({ bytes, code }: Subheader): string {
  return code === 'ascii'
    ? JSON.stringify(bytes.toString('latin1'))
    : bytes.toString('hex').replace(/..\B/g, '$& ').toUpperCase()
}

/** What else the bytes may be. */
function hintsFor(bytes: Buffer): readonly string[] {
  if ((bytes[0] === 0x47 || bytes[0] === 0x45) && bytes[1] === 0)
    return ['They begin like a Sharp JW message: say frame JW.']
  const first = bytes[0] ?? 0
  if ((first & 0x7f) <= 0x3f) return ['A 1E frame has no mark of its own: if it is one, say frame 1E.']
  return []
}

// --- 3E, 4E and station extension

const { bytes: bytesOf, fixed, u16, u8 } = field

/** What stands in front of the body (SLMP reference manual 4.1, 4.2); a test holds it against the framing. */
function headOf(subheader: Subheader): Shape {
  return { ...upToLength(subheader), ...(subheader.direction === 'request' ? { monitoringTimer: u16() } : {}) }
}

function upToLength({ frame }: Subheader): Shape {
  return {
    subheader: bytesOf(2),
    ...(frameFacts[frame].serial ? { serial: u16(), reserved: fixed(0, 2) } : {}),
    network: u8(),
    station: u8(),
    moduleIo: u16(),
    multidrop: u8(),
    ...(frame === 'ext' ? { fixedValue: fixed(0, 1), extensionStation: u16() } : {}),
    dataLength: u16(),
  }
}

function explain3e(bytes: Buffer, known: Known, detected: Subheader, options: ExplainFrameOptions): FrameExplanation {
  const { frame, code, direction } = detected
  const settings: ExplainSettings = { ...known, code, body: bodies[frame] }
  const explainer = new Explainer(bytes, code)
  const lengthEnd = endOfLength(bytes, detected)
  const head = explainer.read(headOf(detected), (leaf) => {
    if (leaf.name === 'subheader') return nameOf(detected)
    if (leaf.name === 'dataLength') return lengthText(Number(leaf.value), bytes.length - lengthEnd)
    return describeHead(leaf)
  })
  const announced = typeof head.dataLength === 'number' ? head.dataLength : undefined
  if (announced !== undefined) checkLength(explainer, announced, lengthEnd, bytes.length)
  const about = { frame, code, direction, ...(typeof head.serial === 'number' ? { serial: head.serial } : {}) }
  const rest =
    direction === 'request'
      ? explainRequest(explainer, settings)
      : explainResponse(explainer, settings, options, about.serial)
  if (direction === 'request') noteConnectedOnly(explainer, settings, rest.about.command, head)
  if (announced !== undefined && lengthEnd + announced > bytes.length) {
    explainer.cutShort(lengthEnd + announced - bytes.length, announced)
  }
  const title = [nameOf(detected), rest.title].filter((part) => part !== '').join(': ')
  return explainer.end({ title, ...about, ...rest.about }, bytes.length, rest.secret)
}

/** Commands for the connected station only, sent elsewhere. */
function noteConnectedOnly(
  explainer: Explainer,
  { commands }: ExplainSettings,
  name: string | undefined,
  { network, station, extensionStation = 0 }: Readonly<Record<string, unknown>>,
): void {
  const command = Object.values(commands).find((one) => one.name === name)
  if (command?.to !== 'connected' || typeof network !== 'number' || typeof station !== 'number') return
  if (isConnectedStation({ network, station, extensionStation: Number(extensionStation) })) return
  explainer.notes.push(`${command.title} is for the connected station only (network 0, station 255); others refuse it.`)
}

/** Where the data length ends: what it counts begins there. */
function endOfLength(bytes: Buffer, subheader: Subheader): number {
  return Math.min(measure(upToLength(subheader), { ascii: subheader.code === 'ascii', form: 0 }), bytes.length)
}

function lengthText(announced: number, present: number): string {
  if (announced === present) return `${announced} (bytes that follow)`
  return present < announced
    ? `${announced} (but only ${present} bytes follow)`
    : `${announced} (bytes that follow; ${present - announced} more stand behind the frame)`
}

/** The data length says where the frame ends. */
function checkLength(explainer: Explainer, announced: number, lengthEnd: number, total: number): void {
  if (lengthEnd + announced < explainer.position) {
    explainer.fail(
      lengthEnd - 2 * explainer.unit,
      `data length ${announced} is shorter than what must follow`,
      'dataLength',
    )
    explainer.limit(explainer.position)
  } else explainer.limit(Math.min(total, lengthEnd + announced))
}

interface Rest {
  readonly title: string
  readonly secret: boolean
  readonly about: Pick<FrameExplanation, 'command' | 'endCode'>
}

function explainRequest(explainer: Explainer, settings: ExplainSettings): Rest {
  const { command, title, secret } = explainRequestBody(explainer, settings)
  return { title, secret, about: aboutOf(command) }
}

function explainResponse(
  explainer: Explainer,
  settings: ExplainSettings,
  options: ExplainFrameOptions,
  serial: number | undefined,
): Rest {
  const asked = requestOf(explainer, options.request, settings, serial, 'request')
  const registered = requestOf(explainer, options.registration, settings, undefined, 'registration')
  const command = asked?.command
  const about = aboutOf(command)
  const { endCode } = explainer.read({ endCode: u16() }, ({ value }) =>
    endCodeText('slmp', Number(value), command?.name),
  )
  if (typeof endCode !== 'number') return { title: 'cut short', secret: false, about }
  if (endCode === 0) {
    const { title, secret, command: answered } = explainResponseBody(explainer, settings, asked, registered)
    return { title, secret, about: { ...aboutOf(answered ?? command), endCode } }
  }
  explainRefusal(explainer, settings, asked)
  return {
    title: `refused${command === undefined ? '' : ` (${command.title})`}`,
    secret: false,
    about: { ...about, endCode },
  }
}

function aboutOf(command: Command | undefined): Rest['about'] {
  return command === undefined ? {} : { command: command.name }
}

/** Error information; devices exist that shorten it or leave it out. */
function explainRefusal(explainer: Explainer, settings: ExplainSettings, asked: KnownRequest | undefined): void {
  if (explainer.remaining === 0) return
  const found = explainErrorInformation(explainer, settings)
  if (asked !== undefined && typeof found.command === 'number' && found.command !== asked.command.code) {
    explainer.notes.push(OTHER_COMMAND)
  }
}

/** The request of an answer from its own frame; says why when it is none. */
function requestOf(
  explainer: Explainer,
  bytes: Buffer | undefined,
  settings: ExplainSettings,
  serial: number | undefined,
  option: string,
): KnownRequest | undefined {
  if (bytes === undefined) return undefined
  const found = SUBHEADERS.filter(({ direction }) => direction === 'request').find((one) =>
    beginsWith(bytes, one.code, one.bytes),
  )
  const scanned = found && scanned3e(found, bytes)
  const request = found && scanned && readRequestBody(scanned.body, { ...settings, body: bodies[found.frame] })
  if (request === undefined) explainer.notes.push(`The frame given as ${option} is no request that can be read.`)
  if (serial !== undefined && scanned?.serial !== undefined && scanned.serial !== serial) {
    explainer.notes.push(`The request has serial number ${scanned.serial}: this does not answer it.`)
  }
  return request
}

function scanned3e(
  { frame, code }: Subheader,
  bytes: Buffer,
): { body: Buffer; serial: number | undefined } | undefined {
  try {
    return slmpFraming(frame, code).request.scan(bytes, () => undefined)?.frame
  } catch {
    // Not a frame: the caller says so.
    return undefined
  }
}
