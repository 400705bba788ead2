// The settings of a client of a Sharp JW: defaults and checks of its options. Everything is checked here, before a connection is
// tried.
import { badOption, checkBooleans, checkNames, oneOf, wholeNumber } from '../../basics/option-checks'
import { type JwModel, jwModels } from '../../jw/commands/command'
import { headerBytes, type JwHeader } from '../../jw/header'
import type { JwArea } from '../../jw/operand/area'
import { placeOfJw } from '../../jw/operand/place'
import { type Clock, realClock } from '../../transport/clock'
import { checkFormat, type ValueFormat } from '../../value/format'
import {
  checkFunction,
  checkLocalAddress,
  checkObject,
  checkPeer,
  LONGEST,
  PAUSE_NAMES,
  pausesOf,
} from '../connection/option-checks'
import {
  JW_OPTION_NAMES,
  type JwClientOptions,
  type JwProbeKind,
  type JwTransportName,
  jwProbeKinds,
  jwTransportNames,
} from './options'

/** Options with every default filled in. */
export interface JwSettings {
  readonly transport: JwTransportName
  readonly model: JwModel
  readonly header: JwHeader
  readonly marker: 'once' | 'each'
  readonly lists: boolean
  readonly areas: readonly JwArea[] | undefined
  /** Bytes of data in one request. */
  readonly maxData: number
  /** Bytes of a whole message, its header included. */
  readonly maxMessage: number
  readonly timeout: number
  readonly connectTimeout: number
  /** Frames without a serial number. */
  readonly inFlight: 1
  readonly queueLimit: number
  readonly allowWrites: boolean
  readonly allowControl: boolean
  readonly allowParameters: boolean
  readonly probe: JwProbeKind
  readonly gap: number
  readonly format: ValueFormat
  readonly first: number
  readonly longest: number
  readonly settleGap: number
  readonly clock: Clock
  readonly random: () => number
}

/** Data of one request (JW300 option unit manual, 24H and 34H). */
const MOST_DATA = 1024
/** Data through two layers of networks (JW-20FL5 manual, 9-18). */
const MOST_RELAYED = 256
/** Header and message over UDP stay below 1024 bytes together (JW-20FL5 manual, 9-18). */
const MOST_OF_DATAGRAM = 1023
/** What stands around the data of a message at most, with room to spare. */
const AROUND = 16

/** @throws RequestError BAD_OPTION naming the option. */
export function settleJw(options: JwClientOptions): JwSettings {
  checkNames('', options, JW_OPTION_NAMES)
  checkNames('reconnect.', options.reconnect ?? {}, PAUSE_NAMES)
  checkObject('format', options.format)
  checkFormat(options.format ?? {})
  checkFunction('openTransport', options.openTransport)
  checkFunction('random', options.random)
  checkLocalAddress(options.localAddress)
  checkBooleans(options, ['lists', 'allowWrites', 'allowControl', 'allowParameters'])
  wholeNumber('localPort', options.localPort ?? 0, 0, 65_535)
  if (options.openTransport === undefined) checkPeer(options)
  checkAreas(options.areas)
  const transport = oneOf('transport', options.transport ?? 'tcp', jwTransportNames)
  const model = oneOf('model', options.model ?? 'jw300', jwModels)
  const header = options.header ?? 'none'
  const headerLength = headerBytes(header).length
  checkProvable(options, transport, model)
  return {
    transport,
    model,
    header,
    marker: oneOf('marker', options.marker ?? 'once', ['once', 'each']),
    lists: (options.lists ?? true) && model === 'jw300',
    areas: options.areas,
    ...boundsOf(options, transport, headerLength),
    timeout: wholeNumber('timeout', options.timeout ?? 3000, 1, LONGEST),
    connectTimeout: wholeNumber('connectTimeout', options.connectTimeout ?? 5000, 1, LONGEST),
    inFlight: 1,
    queueLimit: wholeNumber('queueLimit', options.queueLimit ?? 256, 1, 1_000_000),
    allowWrites: options.allowWrites ?? false,
    allowControl: options.allowControl ?? false,
    allowParameters: options.allowParameters ?? false,
    probe: oneOf('probe', options.probe ?? 'writeMode', jwProbeKinds),
    gap: wholeNumber('gap', options.gap ?? 128, 0, MOST_DATA),
    format: options.format ?? {},
    ...pausesOf(options.reconnect ?? {}),
    settleGap: wholeNumber('settleGap', options.settleGap ?? 50, 0, LONGEST),
    clock: options.clock ?? realClock,
    random: options.random ?? Math.random,
  }
}

/** Whether messages are passed on to another station. */
function isRelayed(header: JwHeader): boolean {
  return typeof header === 'object' && !(header instanceof Uint8Array)
}

function boundsOf(
  { header = 'none', maxData }: JwClientOptions,
  transport: JwTransportName,
  headerLength: number,
): Pick<JwSettings, 'maxData' | 'maxMessage'> {
  const usual = isRelayed(header) ? MOST_RELAYED : MOST_DATA
  const data = wholeNumber('maxData', maxData ?? usual, 1, MOST_DATA)
  const ofData = data < MOST_DATA ? headerLength + AROUND + data : Number.POSITIVE_INFINITY
  return { maxData: data, maxMessage: transport === 'udp' ? Math.min(MOST_OF_DATAGRAM, ofData) : ofData }
}

/** @throws RequestError BAD_OPTION for areas that are none */
function checkAreas(areas: readonly JwArea[] | undefined): void {
  if (areas === undefined) return
  if (!Array.isArray(areas)) badOption('areas', 'areas is a list of areas, e.g. assumedJwAreas.')
  // Looking anything up reads all of them.
  placeOfJw({ kind: 'relay', number: 0 }, { areas })
}

/** On a fixed port a late answer is told from the next one by a loopback, which must go where the requests go. */
function checkProvable(
  { localPort = 0, header = 'none' }: JwClientOptions,
  transport: JwTransportName,
  model: JwModel,
): void {
  if (transport !== 'udp' || localPort === 0) return
  const over = 'Over UDP with a fixed localPort a late answer is told from the next one by a loopback (80H)'
  const instead = 'Leave localPort out, or use TCP.'
  if (model !== 'jw300') badOption('localPort', `${over}, which only a JW300 has. ${instead}`)
  if (isRelayed(header))
    badOption('localPort', `${over}, which proves nothing about a station behind a relay. ${instead}`)
}
