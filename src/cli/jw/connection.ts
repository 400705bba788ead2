// A Sharp JW as the options of a command say it, and a client of it.
import { type Command, InvalidArgumentError, Option } from 'commander'
import { hexPairs } from '../../basics/hex'
import {
  assumedJwAreas,
  createJwClient,
  type JwArea,
  type JwClient,
  type JwClientOptions,
  type JwHeader,
  type JwModel,
  type JwProbeKind,
  jwModels,
  jwProbeKinds,
  type ProbeKind,
  type ValueFormat,
} from '../../index'
import type { FamilyOptions } from '../family'
import { familyOption } from '../family'
import { choice, given, named, whole } from '../option'
import { addPeerOptions, networkText, type PeerOptions, peerOf } from '../peer'
import {
  addSessionOptions,
  connected,
  type Need,
  nowhere,
  type Plc,
  refusedUnsent,
  type SessionOptions,
} from '../session'
import type { Terminal } from '../terminal'

/** As commander gives them. */
export interface JwConnectionOptions extends PeerOptions, SessionOptions, FamilyOptions {
  readonly model?: JwModel
  readonly header?: JwHeader
  readonly marker?: 'once' | 'each'
  /** Of commander: true without the option. */
  readonly lists?: boolean
  readonly maxData?: number
  readonly area?: readonly JwArea[]
  readonly assumedAreas?: boolean
  readonly probe?: ProbeKind | JwProbeKind
  readonly wordOrder?: NonNullable<ValueFormat['wordOrder']>
  readonly byteOrder?: NonNullable<ValueFormat['byteOrder']>
  readonly encoding?: NonNullable<ValueFormat['encoding']>
}

export const modelOption = () => choice('--model <model>', 'family of the CPU; default jw300', jwModels)
export const markerOption = () =>
  choice('--marker <place>', 'where FFH stands in lists of relays and registers; default once', ['once', 'each'])
export const headerOption = () =>
  new Option(
    '--header <header>',
    'in front of messages: none, zero40 (40 bytes 00), relay:pda,psa,slot,station, or hexadecimal digits; default none',
  ).argParser(headerOf)

/** Adds the options that a Sharp JW alone has. */
export function addJwOptions(command: Command): Command {
  return addFurtherOptions(command.optionsGroup('Sharp JW:').addOption(headerOption()))
}

/** Those beside the header. */
function addFurtherOptions(command: Command): Command {
  return command
    .addOption(modelOption())
    .addOption(markerOption())
    .option('--no-lists', 'only what lies in a row shares a request')
    .addOption(new Option('--max-data <bytes>', 'data of one request at most').argParser(whole(1, 1024)))
    .addOption(
      new Option(
        '--area <first..last@F0:byte>',
        'where operands lie that no source places, octal, e.g. 016000..017777@F0:020000; may be repeated',
      ).argParser((text, before: readonly JwArea[] = []) => [...before, areaOf(text)]),
    )
    .option('--assumed-areas', 'take the places that are only assumed: docs/jw-addresses.md')
}

/** Adds the options that say which Sharp JW, to a command that no other PLC has. `header`: false where it is looked for. */
export function addJwConnectionOptions(command: Command, { header = true } = {}): Command {
  addPeerOptions(command.optionsGroup('Which PLC:')).addOption(familyOption('jw'))
  if (header) addJwOptions(command)
  else addFurtherOptions(command.optionsGroup('Sharp JW:'))
  const addProbe = () =>
    header && command.addOption(choice('--probe <name>', 'request that proves the connection', jwProbeKinds))
  return addSessionOptions(command, addProbe, { trace: header })
}

/** @example headerOf('relay:1,2,3,4') // { pda: 1, psa: 2, slot: 3, station: 4 } */
export function headerOf(text: string): JwHeader {
  const clean = text.trim().toLowerCase()
  if (clean === 'none' || clean === 'zero40') return clean
  const [, pda, psa, slot, station] = /^relay:(\d+),(\d+),(\d+),(\d+)$/.exec(clean) ?? []
  if (station !== undefined) {
    return { pda: Number(pda), psa: Number(psa), slot: Number(slot), station: Number(station) }
  }
  const digits = clean.replace(/[\s:,-]/g, '')
  if (/^([0-9a-f]{2})+$/.test(digits)) return Buffer.from(digits, 'hex')
  throw new InvalidArgumentError('It is none, zero40, relay:pda,psa,slot,station (decimal), or hexadecimal digits.')
}

/** As it is typed. @example headerText({ pda: 1, psa: 2, slot: 3, station: 4 }) // 'relay:1,2,3,4' */
export function headerText(header: JwHeader): string {
  if (typeof header === 'string') return header
  if (header instanceof Uint8Array) return hexPairs(header).replaceAll(' ', '')
  return `relay:${[header.pda, header.psa, header.slot, header.station].join(',')}`
}

/** @example areaOf('016000..017777@F0:020000') */
function areaOf(text: string): JwArea {
  const [, first, last, file = '', byte = ''] =
    /^([^.@]+)\.\.([^.@]+)@F([0-9a-f]{1,2}):([0-7]+)$/i.exec(text.trim()) ?? []
  if (first === undefined || last === undefined) {
    throw new InvalidArgumentError(
      'It is first..last@F<file, hexadecimal>:<byte, octal>, e.g. 016000..017777@F0:020000.',
    )
  }
  return { first, last, file: Number.parseInt(file, 16), address: Number.parseInt(byte, 8) }
}

/** What a command needs to be allowed. */
type JwAllowed = Pick<JwClientOptions, 'allowWrites' | 'allowControl' | 'allowParameters'>

/** Where operands lie, beside what is confirmed. */
export function areasOf({ area = [], assumedAreas = false }: JwConnectionOptions): readonly JwArea[] {
  return [...area, ...(assumedAreas ? assumedJwAreas : [])]
}

/** The client's options. */
export function jwClientOptions(options: JwConnectionOptions, allow: JwAllowed = {}): JwClientOptions {
  const areas = areasOf(options)
  return {
    ...peerOf(options, 'jw'),
    ...(options.udp === true ? { transport: 'udp' as const } : {}),
    connectTimeout: options.connectTimeout,
    format: given(options, ['wordOrder', 'byteOrder', 'encoding']),
    ...given(options, ['header', 'model', 'marker', 'maxData', 'localAddress', 'localPort', 'timeout']),
    ...(options.lists === false ? { lists: false } : {}),
    ...(areas.length === 0 ? {} : { areas }),
    ...(options.probe === undefined ? {} : { probe: named('probe', options.probe, jwProbeKinds) }),
    ...allow,
  }
}

/** e.g. `tcp 192.168.3.60:4000` */
export function jwText(options: JwConnectionOptions): string {
  return networkText(options, 'jw')
}

/** Connects, does `work`, and closes whatever happens. */
function withJw<T>(
  terminal: Terminal,
  options: JwConnectionOptions,
  allow: JwAllowed,
  work: (client: JwClient) => Promise<T>,
): Promise<T> {
  return connected(terminal, options, createJwClient(jwClientOptions(options, allow)), work)
}

/** What the client refuses before it sends anything. @throws RequestError */
function refuseUnsentJw(
  options: JwConnectionOptions,
  allow: JwAllowed,
  call: (client: JwClient) => Promise<unknown>,
): Promise<void> {
  return refusedUnsent(createJwClient({ ...jwClientOptions(options, allow), openTransport: nowhere }), call)
}

/** What each need allows. Items may lie in the system memory, which is parameters. */
const ALLOWED: Readonly<Record<Need, JwAllowed>> = {
  reading: {},
  writing: { allowWrites: true, allowParameters: true },
  control: { allowControl: true },
  parameters: { allowParameters: true },
}

/** A Sharp JW, for what is done with a PLC of any family. */
export function jwPlc(terminal: Terminal, options: JwConnectionOptions): Plc<JwClient> {
  return {
    text: jwText(options),
    offline: () => createJwClient(jwClientOptions(options)),
    unsent: (need, call) => refuseUnsentJw(options, ALLOWED[need], call),
    with: (need, work) => withJw(terminal, options, ALLOWED[need], work),
  }
}
