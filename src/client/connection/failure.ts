// The errors of a connection, with what to do about them.
import { ClosedError, ConnectionError, PlcError, TimeoutError } from '../../errors'

/** Title of a call that only waits for the connection. */
export const CONNECTING = 'Connecting'

/** Such a call sends nothing, so nothing was "not sent". */
function unsent(title: string): string {
  return title === CONNECTING ? 'Not connected' : `${title} was not sent`
}

/** No connection now, and not the first attempt: fail at once instead of letting every call run into its deadline. */
export function offline(title: string, reason: PlcError | undefined): ConnectionError {
  const causes = reason instanceof ConnectionError || reason instanceof TimeoutError ? reason.causes : []
  const text = reason === undefined ? '' : ` ${reason.message}`
  const state = title === CONNECTING ? 'the connection' : 'there is no connection; it'
  const message = `${unsent(title)}: ${state} is being restored.${text}`
  return new ConnectionError('OFFLINE', message, 'notSent', reason, causes)
}

/** As `offline`, when no further attempt is made. */
export function refusedToUnlock(title: string, reason: PlcError | undefined): ConnectionError {
  const message =
    `${unsent(title)}: the PLC refused the remote password. It is not sent again, because the PLC would lock out; ` +
    `correct it with setPassword(). ${reason?.message ?? ''}`
  return new ConnectionError('OFFLINE', message, 'notSent', reason)
}

/** The PLC has locked the port on a connection that had unlocked it. */
export function lockedAgain(peer: string, reason: PlcError): ConnectionError {
  const message = `${peer} is locked by the remote password again; the connection is made anew to unlock it.`
  return endedHere(new ConnectionError('DISCONNECTED', message, 'notSent', reason))
}

/** A PLC locks a UDP connection after 10 minutes without traffic. */
export function unlockExpired(peer: string): ConnectionError {
  const message = `${peer} was idle for so long that the PLC has locked it by now; it is unlocked anew.`
  return endedHere(new ConnectionError('DISCONNECTED', message, 'notSent'))
}

export function closedBeforeSending(title: string): ClosedError {
  return new ClosedError('CLOSED', `${unsent(title)}: the client is closed.`)
}

export function abortedBeforeSending(title: string, reason: unknown): ClosedError {
  const what = title === CONNECTING ? 'was aborted' : 'was aborted before it was sent'
  return new ClosedError('ABORTED', `${title} ${what}.`, 'notSent', reason)
}

export function closedMeanwhile(call: { exchange: { title: string } }, outcome: 'notSent' | 'unknown'): ClosedError {
  const { title } = call.exchange
  const what = outcome === 'notSent' ? unsent(title) : `${title} was in flight`
  return new ClosedError('CLOSED', `${what} when the client was closed.`, outcome)
}

export function queueFull(title: string, waiting: number): ClosedError {
  const message = `${unsent(title)}: ${waiting} requests are waiting already. Ask less often, or raise queueLimit.`
  return new ClosedError('QUEUE_FULL', message)
}

/** `Read Type Name (0101)`, or several such names. */
function listed(names: readonly string[]): string {
  return names.join(' and ')
}

/**
 * The PLC ended the connection. Without a single byte before it, that means that no entry was free, or that it does not
 * know the client's own requests, which are all that it was asked: `asked`.
 */
export function closedByPeer(peer: string, receivedAnything: boolean, asked: readonly string[]): ConnectionError {
  if (receivedAnything) {
    return new ConnectionError('DISCONNECTED', `The PLC closed the connection (${peer}).`, 'unknown')
  }
  const message =
    `${peer} accepted the connection and closed it at once${asked.length === 0 ? '' : `, without an answer to ${listed(asked)}`}. ` +
    'All connection entries of this port are probably taken, also by a program that ended without closing. Close the other one, add an entry in the PLC parameters, ' +
    `or wait for the PLC to release it.${otherProbe(asked)}`
  return new ConnectionError('ENTRY_BUSY', message)
}

/** More is asked than the PLC answers: sent now, it would expire in flight, and perhaps take the connection with it. */
export function overloaded(title: string, waiting: number, roundTrip: number | undefined): ClosedError {
  const others = waiting > 1 ? `${waiting} requests wait` : 'its time was used up by waiting'
  const each =
    roundTrip === undefined ? '' : `, and the PLC needs about ${Math.max(1, Math.round(roundTrip))} ms for each`
  const message =
    `${title} was not sent, because its answer would come after its deadline: ${others}${each}. ` +
    'Ask less often, read more by one request, or raise the timeout.'
  return new ClosedError('OVERLOADED', message)
}

/** What helps with a device that meets the client's own request with closing: it was asked nothing else. */
function otherProbe(asked: readonly string[]): string {
  if (asked.length === 0) return ''
  const values = asked.length === 1 ? 'read or none' : 'none'
  return ` Or the device does not know ${listed(asked)}: set probe to ${values}.`
}

/** A probe got no answer; the next connection tries another one. */
export function probeUnanswered(peer: string, asked: string, next: string, reason: PlcError): ConnectionError {
  const message = `${peer} did not answer ${asked}; the next connection is proved by ${next}. ${reason.message}`
  return new ConnectionError('SILENT', message, 'unknown', reason)
}

export function lostInFlight(title: string, reason: PlcError): ConnectionError {
  const message = `The connection was lost while ${title} was in flight; whether the PLC carried it out is not known. ${reason.message}`
  return new ConnectionError('DISCONNECTED', message, 'unknown', reason)
}

/** What the PLC remembered for the request went with the connection it belongs to. */
export function otherConnection(title: string, reason?: PlcError): ConnectionError {
  const message = `${title} was not sent: it belongs to a connection that is gone. ${reason?.message ?? ''}`.trimEnd()
  return new ConnectionError('DISCONNECTED', message, 'notSent', reason)
}

export function connectTimedOut(peer: string, ms: number): ConnectionError {
  const causes = ['the PLC is off or its cable is unplugged', 'wrong IP address', 'a firewall drops the packets']
  const message = `${peer} did not accept a connection within ${ms} ms. Likely: ${causes.join('; ')}`
  return new ConnectionError('CONNECT_FAILED', message, 'notSent', undefined, causes)
}

/** Requests before it took too long. */
export function notSentInTime(title: string): TimeoutError {
  return new TimeoutError(`${title} was not sent before its deadline: earlier requests took too long.`, 'notSent')
}

/** Where an attempt to connect stands. */
export interface Attempt {
  readonly peer: string
  /** There is a connection, but the PLC has not answered on it yet. */
  readonly open: boolean
  /** It was asked nothing on it yet: others who share it go first. */
  readonly waitsForTurn: boolean
  /** Ranked causes of the silence, most likely first. */
  readonly causes: readonly string[]
  /** Why the connection before it was lost. */
  readonly reason: PlcError | undefined
  /** What it was asked last to prove the connection. */
  readonly asked: string | undefined
}

/** The connection took too long. `title` is undefined for a call that only waits for the connection. */
export function notConnectedInTime(title: string | undefined, attempt: Attempt): TimeoutError {
  const { causes, reason } = attempt
  const what = title === undefined ? 'Connecting took longer than allowed' : `${title} was not sent before its deadline`
  const before = reason === undefined ? '' : ` ${reason.message}`
  return new TimeoutError(`${what}: ${stateOf(attempt)}.${mostLikely(causes)}${before}`, 'notSent', causes)
}

function stateOf({ peer, open, waitsForTurn, asked }: Attempt): string {
  if (!open) return `there is no connection to ${peer} yet`
  if (waitsForTurn)
    return `its turn on the line has not come yet (${peer}): others who share it are asked first, or are silent`
  return `${peer} has not answered ${asked === undefined ? '' : `${asked} `}yet`
}

function mostLikely(causes: readonly string[]): string {
  return causes[0] === undefined ? '' : ` Most likely: ${causes[0]}`
}

export function noAnswer(
  title: string,
  peer: string,
  causes: readonly string[],
  by: 'deadline' | 'answer time' = 'deadline',
): TimeoutError {
  const when = by === 'deadline' ? 'before the deadline' : 'within the answer time of the line'
  return new TimeoutError(`${title}: no answer from ${peer} ${when}.${mostLikely(causes)}`, 'unknown', causes)
}

/** Connected, but nothing answers. */
export function silent(
  peer: string,
  causes: readonly string[],
  cause: PlcError,
  asked: readonly string[],
): ConnectionError {
  const ranked = causes.map((text, i) => `${i + 1}. ${text}`).join(' ')
  const what = asked.length === 0 ? '' : ` ${listed(asked)}`
  const message = `${peer} does not answer${what}.${ranked === '' ? '' : ` Possible causes: ${ranked}`}`
  return new ConnectionError('SILENT', message, 'unknown', cause, causes)
}

/** Behind a proof that did not come; the other causes of a silence follow. */
export const NO_SELF_TEST =
  'The device does not return self tests (0619), which a fixed local port needs: leave localPort out, or use the 4E frame or TCP.'

/** On a fixed local port of a frame without serial number: after an unanswered request a self test must come back first. */
export function unproved(title: string, peer: string, causes: readonly string[]): TimeoutError {
  const message =
    `${title} was not sent: ${peer} did not return the self test that proves that no late answer to an earlier request is still on its way ` +
    '(the local port is fixed, and the frame has no serial number).' +
    mostLikely(causes)
  return new TimeoutError(message, 'notSent', causes)
}

/** The PLC was reset by a command that it does not answer. */
export function reset(peer: string): ConnectionError {
  const message = `${peer} was reset, which ends its connections; the connection is made anew.`
  return new ConnectionError('DISCONNECTED', message, 'unknown')
}

/** A failure that is no `PlcError` is a bug of this package; it ends the connection and is reported, not thrown. */
export function unexpected(error: unknown): ConnectionError {
  return endedHere(new ConnectionError('DISCONNECTED', `Unexpected failure: ${String(error)}`, 'unknown', error))
}

export function asPlcError(error: unknown): PlcError {
  return error instanceof PlcError ? error : unexpected(error)
}

/**
 * Whether a connection that was lost for this reason is the success of a command that is not answered (Remote Reset):
 * the PLC has gone silent or has gone. Not when it was never there, or spoke nonsense.
 */
export function isGone(reason: PlcError): boolean {
  if (!(reason instanceof ConnectionError) || ENDED_HERE.has(reason)) return false
  return reason.code === 'DISCONNECTED' || reason.code === 'SILENT'
}

/** Why this side ended a connection on which the PLC may go on answering. */
const ENDED_HERE = new WeakSet<PlcError>()

function endedHere(error: ConnectionError): ConnectionError {
  ENDED_HERE.add(error)
  return error
}
