// A request as it arrived: which command it is, what it says, or why it cannot be read.
import { field, type Message, readerOf } from '../codec/codec'
import { PlcError, ProtocolError } from '../errors'
import type { RequestFrame } from '../link/link'
import { commands } from '../melsec/commands/commands'
import { deviceAddress } from '../melsec/device/codec'
import { findCommand } from '../melsec/device/form'
import { limitsOf } from '../melsec/device/limit'
import { setReset } from '../melsec/device/set-reset'
import type { Head1e } from '../melsec/frame/frame-1e'
import type { SlmpFrameName } from '../melsec/frame/frames'
import type { ReceivedRequest, SlmpCommandSet } from '../melsec/protocol'
import type { ACompatiblePort } from './a-compatible-port'
import type { AnyHead } from './any-frame'
import type { Translated } from './other-set'
import { Refusal, requestErrors } from './refusal'

/** A frame and what was understood of it. */
export interface Received {
  readonly frame: RequestFrame<AnyHead>
  /** Command and subcommand as sent; 0 when the frame is too short for them. */
  readonly command: number
  readonly subcommand: number
  /** The request, or why there is none. */
  readonly request: ReceivedRequest | Refusal
  /** 1E: writes the data of the answer. */
  readonly respond?: (response: Message) => Buffer
}

/** The protocols of a port. */
export interface Ports {
  /** 3E and 4E. */
  readonly slmp: SlmpCommandSet
  /** The same commands in the station extension frame. */
  readonly extended: SlmpCommandSet
  readonly aCompatible: ACompatiblePort
}

/** The protocol of the SLMP set for a frame. */
export function slmpOf({ slmp, extended }: Ports, frame: SlmpFrameName): SlmpCommandSet {
  return frame === 'ext' ? extended : slmp
}

/** Reads a frame; never throws for what a client can send. */
export function receive(ports: Ports, frame: RequestFrame<AnyHead>): Received {
  if (frame.head.frame === '1E') return receive1e(ports.aCompatible, frame, frame.head.head)
  return { frame, ...slmpRequest(slmpOf(ports, frame.head.frame), frame) }
}

/** Reads a frame of the SLMP set; never throws for what a client can send. */
export function slmpRequest(
  protocol: SlmpCommandSet,
  frame: Pick<RequestFrame, 'body'>,
): Pick<Received, 'command' | 'subcommand' | 'request'> {
  const { command, subcommand } = codesOf(protocol, frame.body)
  return { command, subcommand, request: requestOf(protocol, frame, command, subcommand) }
}

function receive1e(port: ACompatiblePort, frame: RequestFrame<AnyHead>, head: Head1e): Received {
  const known = { frame, command: head.command, subcommand: 0 }
  try {
    const { respond, ...request } = port.read({ ...frame, head })
    return { ...known, request: requestIn(request), respond }
  } catch (error) {
    if (error instanceof Refusal) return { ...known, request: error }
    throw error
  }
}

/** A request of a frame with a set of its own, whose devices have one form. */
export function requestIn({ name, message }: Pick<Translated, 'name' | 'message'>): ReceivedRequest {
  return { name, command: commands[name], message, form: 'short', subcommand: 0 }
}

function codesOf(protocol: SlmpCommandSet, body: Buffer): { command: number; subcommand: number } {
  const reader = readerOf(protocol.code, body)
  try {
    return { command: reader.uint(2), subcommand: reader.uint(2) }
  } catch (error) {
    if (error instanceof PlcError) return { command: 0, subcommand: 0 }
    throw error
  }
}

function requestOf(
  protocol: SlmpCommandSet,
  frame: Pick<RequestFrame, 'body'>,
  code: number,
  subcommand: number,
): ReceivedRequest | Refusal {
  try {
    const read = protocol.readRequest(frame)
    if (!('unknown' in read)) return read
    return new Refusal(protocol.profile.refusals.command, 'no such command or subcommand')
  } catch (error) {
    if (!(error instanceof PlcError)) throw error
    return new Refusal(endCodeOf(protocol, code, subcommand, error), error.message)
  }
}

/** The end code for a request whose data are not what its command says. */
function endCodeOf(protocol: SlmpCommandSet, code: number, subcommand: number, error: PlcError): number {
  const { refusals } = protocol.profile
  if (error.code === 'BAD_DIGIT') return requestErrors.asciiConversion
  if (error.code === 'TRUNCATED' || error.code === 'TRAILING') return refusals.length
  const found = findCommand(commands, protocol.profile, code, subcommand)
  const culprit =
    found && error instanceof ProtocolError ? field.fieldAt(found.command.request, error.field ?? '') : undefined
  // The station extension frame has fixed values in front of the data.
  if (found === undefined || culprit === undefined) return requestErrors.content
  const codec = culprit.kind === 'value' ? culprit.codec : undefined
  if (codec === deviceAddress) {
    return found.form.startsWith('extended') ? refusals.extendedDeviceName : refusals.deviceName
  }
  if (codec === setReset) return requestErrors.bitData
  // The other fields of commands that have limits are points and counts: here one of them is 0.
  const [limit] = limitsOf(protocol.profile, found.command.name, found.form, protocol.code)
  return limit?.endCode ?? requestErrors.content
}
