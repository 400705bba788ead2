/** The system's error numbers, turned into what happened, where, and what to do. */
import { ConnectionError, type ConnectionErrorCode } from '../errors'

/** Where it happened. */
export interface Place {
  readonly protocol: 'tcp' | 'udp'
  /** `192.168.3.39:5007`, or what the user typed as long as the name is not resolved. */
  readonly target: string
  /** What the user fixed of the local side, e.g. `local port 5000`; undefined when nothing. */
  readonly local: string | undefined
  /** Whether something ever came back from there: then the address and the port are the right ones. */
  readonly answeredBefore: boolean
}

interface Explanation {
  readonly what: string
  /** Ranked, most likely first. */
  readonly causes: readonly string[]
  /** The same for a place from which something came back before. */
  readonly afterItAnswered?: readonly string[]
}

const NETWORK_CHANGED = 'an address or a firewall was changed since it last answered'
const CHANGED = 'the port settings of the PLC were changed since it last answered'

const REFUSED = {
  tcp: {
    what: 'the connection was refused, nothing accepts TCP connections on this port',
    causes: [
      'the port number differs from the one in the open settings of the PLC',
      'the PLC offers this port over UDP, not TCP',
      'all connections that the PLC has for this port are taken',
    ],
    afterItAnswered: [
      'the PLC is restarting, and does not take connections yet',
      'all connections that the PLC has for this port are taken',
      CHANGED,
    ],
  },
  udp: {
    what: 'nothing receives UDP datagrams on this port',
    causes: [
      'the port number differs from the one in the open settings of the PLC',
      'the PLC offers this port over TCP, not UDP',
      'the program on the other side has ended',
    ],
    afterItAnswered: [
      'the PLC is restarting, and does not listen yet',
      'the program on the other side has ended',
      CHANGED,
    ],
  },
} satisfies Record<'tcp' | 'udp', Explanation>

const NO_ROUTE: Explanation = {
  what: 'the address cannot be reached',
  causes: ['the PLC is off or its cable is unplugged', 'wrong IP address', 'wrong subnet mask or default gateway'],
  afterItAnswered: [
    'the PLC is off or its cable is unplugged',
    'a switch or router on the way is off',
    NETWORK_CHANGED,
  ],
}
const NO_ANSWER: Explanation = {
  what: 'there was no answer to the connection request',
  causes: ['the PLC is off or its cable is unplugged', 'wrong IP address', 'a firewall drops the packets'],
  afterItAnswered: [
    'the PLC is off or its cable is unplugged',
    'a switch or router on the way is off',
    NETWORK_CHANGED,
  ],
}
const NO_NAME: Explanation = {
  what: 'the host name could not be resolved to an address',
  causes: ['the name is misspelt', 'the name server cannot be reached: give the IP address instead'],
}
const NOT_ALLOWED: Explanation = {
  what: 'this computer does not allow it',
  causes: ['a firewall on this computer', 'the address is a broadcast address'],
}
const NO_RESOURCES: Explanation = {
  what: 'this computer has no more sockets to give',
  causes: ['a program leaves connections open', 'the limit of open files is too low'],
}

const CONNECT_EXPLANATIONS: Readonly<Record<string, Explanation>> = {
  ECONNRESET: { ...REFUSED.tcp, what: 'the connection was reset while it was being opened' },
  ETIMEDOUT: NO_ANSWER,
  EHOSTUNREACH: NO_ROUTE,
  EHOSTDOWN: NO_ROUTE,
  ENETUNREACH: NO_ROUTE,
  ENETDOWN: NO_ROUTE,
  ENOTFOUND: NO_NAME,
  EAI_AGAIN: NO_NAME,
  EAI_FAIL: NO_NAME,
  EAI_NONAME: NO_NAME,
  EACCES: NOT_ALLOWED,
  EPERM: NOT_ALLOWED,
  EMFILE: NO_RESOURCES,
  ENFILE: NO_RESOURCES,
  ENOBUFS: NO_RESOURCES,
}

const LOST_EXPLANATIONS: Readonly<Record<string, string>> = {
  ECONNRESET: 'the peer reset the connection (restarted, or it dropped this connection)',
  EPIPE: 'the peer no longer accepts data on this connection',
  ETIMEDOUT: 'the peer no longer answers (off, or a cable is unplugged)',
  EHOSTUNREACH: 'the peer can no longer be reached (off, or a cable is unplugged)',
  ENETUNREACH: 'the network can no longer be reached (interface down or cable unplugged)',
  ENETDOWN: 'the network interface of this computer went down',
}

/**
 * The attempt failed: the address, the name, the port or this computer. For datagrams also later on, because an
 * absent peer shows only when something was sent.
 */
export function connectFailure(place: Place, cause: unknown, outcome: 'notSent' | 'unknown'): ConnectionError {
  const code = codeOf(cause)
  const local = localFailure(place, cause, code, outcome)
  if (local !== undefined) return local
  const explanation = explain(place.protocol, code)
  const message = `${where(place)}: ${explanation?.what ?? 'it failed'} (${code})`
  return error('CONNECT_FAILED', message, outcome, cause, explanation && causesOf(explanation, place))
}

/** It was open and ended without the peer closing it. */
export function lostConnection(place: Place, cause: unknown, outcome: 'notSent' | 'unknown'): ConnectionError {
  const code = codeOf(cause)
  const message = `${where(place)}: ${LOST_EXPLANATIONS[code] ?? 'the connection was lost'} (${code})`
  return error('DISCONNECTED', message, outcome, cause)
}

/** No connection within the transport's own limit. */
export function connectTimedOut(place: Place, ms: number): ConnectionError {
  const message = `${where(place)}: ${NO_ANSWER.what} within ${ms} ms`
  return error('CONNECT_FAILED', message, 'notSent', undefined, causesOf(NO_ANSWER, place))
}

/** `send` or `renew` outside the time in which the transport is open. */
export function notOpen(description: string): ConnectionError {
  return new ConnectionError('DISCONNECTED', `${description}: not open, nothing was sent`)
}

/** `renew` where the local port cannot change: a bug of the caller, which would believe a late answer afterwards. */
export function notRenewable(description: string): ConnectionError {
  return new ConnectionError('DISCONNECTED', `${description}: its local port cannot be changed`)
}

/** Listening failed. */
export function listenFailure(protocol: 'tcp' | 'udp', endpoint: string, cause: unknown): ConnectionError {
  const code = codeOf(cause)
  const what = CONNECT_EXPLANATIONS[code]?.what ?? 'it failed'
  const message =
    bindExplanation(code, `${protocol} ${endpoint}`) ?? `${protocol} ${endpoint}: cannot listen, ${what} (${code})`
  return error('PORT_UNAVAILABLE', message, 'notSent', cause)
}

/** The failures of the local side, which have other remedies than those of the network and the PLC. */
function localFailure(
  place: Place,
  cause: unknown,
  code: string,
  outcome: 'notSent' | 'unknown',
): ConnectionError | undefined {
  const bound =
    textOf(cause, 'syscall') === 'bind'
      ? bindExplanation(code, `${place.protocol} ${place.local ?? 'local port'}`)
      : undefined
  if (bound !== undefined) return error('PORT_UNAVAILABLE', `${where(place)}: ${bound}`, outcome, cause)
  if (code !== 'EADDRINUSE' && code !== 'EADDRNOTAVAIL') return undefined
  const what =
    place.local === undefined
      ? 'no local port is free: too many connections were opened in a short time'
      : `${place.local} still holds an earlier connection to the same port of the PLC: close that, wait a minute, or let the system choose the local port`
  return error('PORT_UNAVAILABLE', `${where(place)}: ${what} (${code})`, outcome, cause)
}

function bindExplanation(code: string, what: string): string | undefined {
  switch (code) {
    case 'EADDRINUSE':
      return `${what} is already in use: end the other program or choose another port (${code})`
    case 'EADDRNOTAVAIL':
      return `${what} is not an address of this computer (${code})`
    case 'EACCES':
    case 'EPERM':
      return `${what} may not be used by this user: choose a port above 1023 (${code})`
    default:
      return undefined
  }
}

function explain(protocol: 'tcp' | 'udp', code: string): Explanation | undefined {
  // Windows reports an unreachable UDP port as a reset.
  if (code === 'ECONNREFUSED' || (protocol === 'udp' && code === 'ECONNRESET')) return REFUSED[protocol]
  return CONNECT_EXPLANATIONS[code]
}

function causesOf({ causes, afterItAnswered }: Explanation, { answeredBefore }: Place): readonly string[] {
  return (answeredBefore ? afterItAnswered : undefined) ?? causes
}

function where(place: Place): string {
  return `${place.protocol} ${place.target}`
}

function error(
  code: ConnectionErrorCode,
  message: string,
  outcome: 'notSent' | 'unknown',
  cause: unknown,
  causes: readonly string[] = [],
): ConnectionError {
  const advice = causes.length === 0 ? '' : `. Likely: ${causes.join('; ')}`
  return new ConnectionError(code, `${message}${advice}`, outcome, cause, causes)
}

function codeOf(cause: unknown): string {
  return textOf(cause, 'code') ?? (cause instanceof Error ? cause.message : 'no reason given')
}

function textOf(cause: unknown, name: 'code' | 'syscall'): string | undefined {
  if (typeof cause !== 'object' || cause === null || !(name in cause)) return undefined
  const value: unknown = Reflect.get(cause, name)
  return typeof value === 'string' ? value : undefined
}
