// The settings of a MELSEC client: defaults and checks of its options. Everything is checked here, before a connection is tried.
import { checkNames, oneOf, wholeNumber } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import type { DataCode } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { SerialProtocolOptions } from '../../melsec/client-protocol'
import { type EthernetFrameName, frameFacts } from '../../melsec/frame/frames'
import { checkRouteOf, completeRoute, isConnectedStation, ownStation, type Route } from '../../melsec/frame/route'
import { isSerialFrame } from '../../melsec/frame/serial-frames'
import {
  asciiXyOf,
  type FrameName,
  inFlightBound,
  type Profile,
  profileIds,
  type TransportName,
} from '../../melsec/profiles/profile'
import { profiles, resolveProfile } from '../../melsec/profiles/profiles'
import { type Clock, realClock } from '../../transport/clock'
import { checkFormat, type ValueFormat } from '../../value/value'
import {
  checkFunction,
  checkLocalAddress,
  checkObject,
  checkPeer,
  LONGEST,
  PAUSE_NAMES,
  pausesOf,
} from '../connection/option-checks'
import type { LabelFormat } from '../label/item'
import { type MelsecClientOptions, OPTION_NAMES } from './options'
import { checkProbe, type ProbeKind, probeKinds } from './probes'
import type { SerialLine } from './serial-line'
import { codeOfLine, serialLineFor, serialOf, transportOf } from './serial-settings'

/** Options with every default filled in. */
export interface Settings {
  readonly transport: TransportName
  readonly profile: Profile
  readonly frame: FrameName
  readonly code: DataCode
  readonly asciiXy: 'octal' | 'hexadecimal' | undefined
  /** On a serial line the connected station: `serial` says which. */
  readonly route: Route
  readonly serial: SerialProtocolOptions | undefined
  /** What carries the bytes of a serial frame. */
  readonly serialLine: SerialLine | undefined
  /** In units of 250 ms. */
  readonly timer: number
  readonly xyRadix: 8 | 16
  readonly wRadix: 10 | 16
  /** Neither the profile nor the user says how X and Y are numbered. */
  readonly xyUnknown: boolean
  readonly timeout: number
  readonly connectTimeout: number
  readonly inFlight: number
  readonly queueLimit: number
  readonly allowWrites: boolean
  readonly allowControl: boolean
  readonly probe: ProbeKind
  readonly gap: number
  readonly format: ValueFormat
  readonly labelFormat: LabelFormat
  readonly first: number
  readonly longest: number
  readonly settleGap: number
  readonly clock: Clock
  readonly random: () => number
}

const TIMER_UNIT = 250
const LONGEST_TIMER = 0xffff * TIMER_UNIT

/** @throws RequestError BAD_OPTION naming the option. */
export function settle(options: MelsecClientOptions): Settings {
  checkNames('', options, OPTION_NAMES)
  checkNames('reconnect.', options.reconnect ?? {}, PAUSE_NAMES)
  checkObject('route', options.route)
  checkObject('format', options.format)
  wholeNumber('localPort', options.localPort ?? 0, 0, 65_535)
  checkFunction('openTransport', options.openTransport)
  checkFunction('random', options.random)
  checkLocalAddress(options.localAddress)
  oneOf('asciiZr', options.asciiZr, [undefined, 'decimal', 'hexadecimal'])
  oneOf('asciiWordOrder', options.asciiWordOrder, [undefined, 'low-first', 'high-first'])
  const profile = profileOf(options)
  const transport = transportOf(options)
  const serialLine = serialLineFor(options, profile)
  const frame = frameOf(profile, serialLine?.frame ?? options.frame)
  const code = serialLine === undefined ? codeOf(frame, options.code ?? profile.code) : codeOfLine(serialLine, options)
  if (options.openTransport === undefined && serialLine === undefined) checkPeer(options)
  checkFormat(options.format ?? {})
  checkPasswordPort(options, transport, frame)
  return {
    transport,
    profile,
    frame,
    code,
    asciiXy: asciiXyOf(profile, oneOf('asciiXy', options.asciiXy, [undefined, 'octal', 'hexadecimal'])),
    serialLine,
    serial: serialLine && serialOf(serialLine, profile, options),
    route: isSerialFrame(frame)
      ? ownStation
      : provable(options, transport, frame, reachable(profile, routeOf(frame, options.route))),
    timer: timerOf(profile, options.monitoringTimer),
    xyRadix: oneOf('xyRadix', options.xyRadix ?? profile.xyRadix, [8, 16]),
    wRadix: wRadixOf(code, options.wRadix ?? profile.wRadix),
    xyUnknown: !profile.xyRadixKnown,
    timeout: wholeNumber('timeout', options.timeout ?? 3000, 1, LONGEST),
    connectTimeout: wholeNumber('connectTimeout', options.connectTimeout ?? 5000, 1, LONGEST),
    inFlight: inFlightOf(profile, transport, frame, options.inFlight),
    queueLimit: wholeNumber('queueLimit', options.queueLimit ?? 256, 1, 1_000_000),
    allowWrites: oneOf('allowWrites', options.allowWrites ?? false, [true, false]),
    allowControl: oneOf('allowControl', options.allowControl ?? false, [true, false]),
    probe: checkProbe(profile, oneOf('probe', options.probe ?? 'auto', probeKinds)),
    gap: wholeNumber('gap', options.gap ?? 64, 0, 960),
    format: options.format ?? {},
    labelFormat: labelFormatOf(options),
    ...pausesOf(options.reconnect ?? {}),
    settleGap: wholeNumber('settleGap', options.settleGap ?? 50, 0, LONGEST),
    clock: options.clock ?? realClock,
    random: options.random ?? Math.random,
  }
}

/** Of a PLC nobody knows the notation is the user's word for what it is, as if it stood in a profile. */
function profileOf({ profile: given, profileOverrides, xyRadix }: MelsecClientOptions): Profile {
  const profile = resolveProfile(given ?? 'generic')
  const isSaid = !profile.xyRadixKnown && (xyRadix === 8 || xyRadix === 16)
  return resolveProfile(profile, isSaid ? { ...profileOverrides, xyRadix } : (profileOverrides ?? undefined))
}

/** The PLC says the types of labels and how their words lie; only text has a code that it does not say. */
function labelFormatOf({ format: { encoding, trimSpaces } = {}, asciiWordOrder }: MelsecClientOptions): LabelFormat {
  return {
    ...(encoding === undefined ? {} : { encoding }),
    ...(trimSpaces === undefined ? {} : { trimSpaces }),
    ...(asciiWordOrder === undefined ? {} : { asciiWordOrder }),
  }
}

/** A PLC unlocks one peer, and over UDP with 3E the local port would change with every request. */
function checkPasswordPort(
  { password, localPort, openTransport }: MelsecClientOptions,
  transport: TransportName,
  frame: FrameName,
): void {
  if (password === undefined || transport !== 'udp' || frameFacts[frame].serial) return
  if ((localPort ?? 0) > 0 || openTransport !== undefined) return
  const message =
    'A remote password over UDP needs localPort with the 3E frame: the PLC unlocks one peer, and without it every request ' +
    'leaves from another port. Set it as in the open settings of the PLC, or use TCP or the 4E frame.'
  throw new RequestError('BAD_OPTION', message, 'localPort')
}

function frameOf(profile: Profile, frame: FrameName | undefined): FrameName {
  const chosen = frame ?? profile.frame
  if (profile.frames.includes(chosen)) return chosen
  throw new RequestError(
    'BAD_OPTION',
    `${profile.title} has no ${shown(chosen)} frame: use ${profile.frames.join(' or ')}.${otherProfile(chosen)}`,
    'frame',
  )
}

/** The same CPU by its other port. */
function otherProfile(frame: FrameName): string {
  const others = profileIds.filter((id) => profiles[id].frames.includes(frame))
  return isSerialFrame(frame) ? ` On a serial line its profile is another one: ${others.join(', ')}.` : ''
}

function codeOf(frame: FrameName, given: DataCode): DataCode {
  const code = oneOf('code', given, ['binary', 'ascii'])
  const { title, codes } = frameFacts[frame]
  if (codes.includes(code)) return code
  throw new RequestError(
    'BAD_OPTION',
    `The ${title} frame exists in ${codes.join(' and ')} code only: set code to ${codes[0]}, or choose another frame.`,
    'code',
  )
}

/** W902 is 902 or 386H on the line: in ASCII code another register would be written, and no manual at hand says which. */
function wRadixOf(code: DataCode, given: 10 | 16): 10 | 16 {
  const wRadix = oneOf('wRadix', given, [10, 16])
  if (wRadix === 16 || code === 'binary') return wRadix
  const message =
    'W in decimal (wRadix 10) goes with binary code only: which digits such a device takes in ASCII code is not known.'
  throw new RequestError('BAD_OPTION', message, 'wRadix')
}

function routeOf(frame: EthernetFrameName, given: Partial<Route> | undefined): Route {
  const route = completeRoute(given)
  checkRouteOf(frame, route)
  return route
}

function timerOf(profile: Profile, given: number | undefined): number {
  const ms = wholeNumber('monitoringTimer', given ?? profile.monitoringTimer.default, 0, LONGEST_TIMER)
  if (ms % TIMER_UNIT !== 0) {
    throw new RequestError(
      'BAD_OPTION',
      `monitoringTimer is ${ms} ms; it counts in steps of 250 ms.`,
      'monitoringTimer',
    )
  }
  if (ms !== 0 && profile.monitoringTimer.zeroOnly) {
    throw new RequestError('BAD_OPTION', `${profile.title} takes monitoringTimer 0 only.`, 'monitoringTimer')
  }
  return ms / TIMER_UNIT
}

/** Ports that reach nothing else would refuse every request, or carry it out on the connected station. */
function reachable({ title, reach }: Profile, route: Route): Route {
  const { moduleIo, multidrop } = route
  const own = isConnectedStation(route) && multidrop === ownStation.multidrop
  const moduleTaken = !reach.ownModuleIoOnly || reach.ownModuleIo.includes(moduleIo)
  if (reach.stations === 'networks' || (own && moduleTaken)) return route
  const message = `${title} reaches the connected station only: leave route out (${reach.source}).`
  throw new RequestError('UNSUPPORTED', message, 'route')
}

/**
 * On a fixed port a late answer is told from the next one by a self test, which the connected module returns. It proves
 * nothing about a request that is passed on: the pattern may be back before the answer of another station, of a station
 * behind a serial module or of another CPU. CPU No. 1 (03E0) and the control system (03D0) need not be the own CPU.
 */
function provable(
  { localPort = 0 }: MelsecClientOptions,
  transport: TransportName,
  frame: FrameName,
  route: Route,
): Route {
  if (transport !== 'udp' || localPort === 0 || frameFacts[frame].serial) return route
  if (isConnectedStation(route) && route.moduleIo === ownStation.moduleIo && route.multidrop === ownStation.multidrop) {
    return route
  }
  const message =
    `With the ${frame} frame over UDP and a fixed localPort only the connected station and its own CPU (module I/O 03FF) can be ` +
    'reached: a late answer of another one could not be told from the next one. Leave localPort out, or use the 4E frame or TCP.'
  throw new RequestError('BAD_OPTION', message, 'localPort')
}

function inFlightOf(profile: Profile, transport: TransportName, frame: FrameName, given: number | undefined): number {
  const bound = inFlightBound(profile, transport, frame)
  const inFlight = wholeNumber('inFlight', given ?? 1, 1, 65_535)
  if (inFlight <= bound) return inFlight
  const reason = bound === 1 ? 'more needs the 4E frame over UDP' : `the receive buffer of the PLC holds no more`
  throw new RequestError(
    'BAD_OPTION',
    `inFlight is ${inFlight}; ${profile.title} over ${transport} with ${frame} takes ${bound}: ${reason}.`,
    'inFlight',
  )
}
