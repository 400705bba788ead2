// The settings of a connection as a flow stores them, and the client's options made of them.
import type { Node, NodeAPI } from 'node-red'
import type { MelsecOptions, NetworkPlc, ProfileId, Route, ValueFormat } from '../src/index'
import { encodings, frameNames, probeKinds, profileIds, transportNames } from '../src/index'
import { type NodeFailure, refusal } from './failure'
import type { Texts } from './texts'
import { withVariables } from './typed-input'

/**
 * What the editor stores. Numbers are text as typed, `''` is the default of the PLC series or the system, and any
 * text may hold `${NAME}`.
 */
export interface ConnectionSettings {
  readonly host: string
  readonly port: string
  readonly transport: string
  readonly localAddress: string
  readonly localPort: string
  readonly profile: string
  /** One of `frameNames` or `''`. */
  readonly frame: string
  /** `binary` or `ascii`. */
  readonly code: string
  /** Digits of X and Y in ASCII code: `octal`, `hexadecimal` or `''`. */
  readonly asciiXy: string
  /** Digits of ZR in ASCII code: `decimal`, `hexadecimal` or `''`. */
  readonly asciiZr: string
  /** Labels in ASCII code: `low-first`, `high-first` or `''`. */
  readonly asciiWordOrder: string
  /** Numbering of X and Y in addresses: `8`, `16` or `''`. */
  readonly xyRadix: string
  /** Numbering of W in addresses: `10`, `16` or `''`. */
  readonly wRadix: string
  readonly network: string
  readonly station: string
  /** Hexadecimal, e.g. `3FF`. */
  readonly moduleIo: string
  readonly multidrop: string
  /** Station extension frame; `''` where the station number says all. */
  readonly extensionStation: string
  /** ms */
  readonly monitoringTimer: string
  /** ms */
  readonly timeout: string
  readonly probe: string
  readonly inFlight: string
  readonly queueLimit: string
  /** ms: pauses between attempts to connect. */
  readonly reconnectFirst: string
  readonly reconnectLongest: string
  /** Words. */
  readonly gap: string
  /** Characters of STRING, one of `encodings`. */
  readonly encoding: string
  /** `low-first` or `high-first`. */
  readonly wordOrder: string
  readonly allowWrites: boolean
  readonly allowControl: boolean
}

const TEXT_FIELDS = [
  'host',
  'port',
  'transport',
  'localAddress',
  'localPort',
  'profile',
  'frame',
  'code',
  'asciiXy',
  'asciiZr',
  'asciiWordOrder',
  'xyRadix',
  'wRadix',
  'network',
  'station',
  'moduleIo',
  'multidrop',
  'extensionStation',
  'monitoringTimer',
  'timeout',
  'probe',
  'inFlight',
  'queueLimit',
  'reconnectFirst',
  'reconnectLongest',
  'gap',
  'encoding',
  'wordOrder',
] as const satisfies readonly (keyof ConnectionSettings)[]
type TextField = (typeof TEXT_FIELDS)[number]

/** ms: a line that runs again should not wait half a minute for its values, and one attempt in five seconds costs a PLC nothing. */
export const LONGEST_PAUSE = 5000

/** Longer than any host name or number: what is longer is no setting. */
const LONGEST = 255

/** Turns `${NAME}` into its value. */
export type Resolve = (text: string) => string

/** How settings are read: the texts of refusals, and the environment. */
export interface SettingsContext {
  readonly texts: Texts
  readonly resolve: Resolve
}

/** @param node the connection, for the variables of its flow; `null` when it is not deployed */
export function resolverOf(RED: NodeAPI, node: Node, texts: Texts): Resolve {
  return (text) =>
    withVariables(RED, node, text, (name) => refusal('NOT_CONFIGURED', texts('error.variable', { name })))
}

/**
 * Settings from a stored configuration or a request of the editor, with variables replaced.
 * @throws NodeFailure NOT_CONFIGURED naming the field that is no text.
 */
export function settingsOf(given: Readonly<Record<string, unknown>>, context: SettingsContext): ConnectionSettings {
  const entries = TEXT_FIELDS.map((field): [TextField, string] => [field, textOf(given[field], field, context)])
  return {
    ...(Object.fromEntries(entries) as Record<TextField, string>),
    allowWrites: given.allowWrites === true,
    allowControl: given.allowControl === true,
  }
}

function textOf(value: unknown, field: TextField, { texts, resolve }: SettingsContext): string {
  if (value === undefined || value === null) return ''
  const plain = typeof value === 'number' ? String(value) : value
  if (typeof plain !== 'string' || plain.length > LONGEST) throw bad(texts, field, 'error.notText')
  return resolve(plain).trim()
}

function bad(
  texts: Texts,
  field: keyof ConnectionSettings,
  key: string,
  values: Record<string, string> = {},
): NodeFailure {
  return refusal('NOT_CONFIGURED', texts(key, { ...values, field: texts(`label.${field}`) }), { field })
}

/**
 * The client's options. Ranges and combinations are the client's business; here only texts become numbers.
 * @throws NodeFailure NOT_CONFIGURED naming the field.
 */
export function optionsOf(settings: ConnectionSettings, texts: Texts): MelsecOptions & NetworkPlc {
  if (settings.host === '') throw bad(texts, 'host', 'error.missing')
  return {
    host: settings.host,
    port: wholeNumber(settings, 'port', texts) ?? missing('port', texts),
    ...speech(settings, texts),
  }
}

/** Everything but where the PLC is: enough to read addresses. */
export function speech(settings: ConnectionSettings, texts: Texts): MelsecOptions {
  const number = (field: TextField) => wholeNumber(settings, field, texts)
  return {
    ...present({
      transport: choice(settings, 'transport', transportNames, texts),
      localAddress: settings.localAddress === '' ? undefined : settings.localAddress,
      localPort: number('localPort'),
      frame: choice(settings, 'frame', frameNames, texts),
      code: choice(settings, 'code', ['binary', 'ascii'], texts),
      asciiXy: choice(settings, 'asciiXy', ['octal', 'hexadecimal'], texts),
      asciiZr: choice(settings, 'asciiZr', ['decimal', 'hexadecimal'], texts),
      asciiWordOrder: choice(settings, 'asciiWordOrder', ['low-first', 'high-first'], texts),
      xyRadix: xyRadixOf(settings, texts),
      wRadix: wRadixOf(settings, texts),
      monitoringTimer: number('monitoringTimer'),
      timeout: number('timeout'),
      probe: choice(settings, 'probe', probeKinds, texts),
      inFlight: number('inFlight'),
      queueLimit: number('queueLimit'),
      gap: number('gap'),
    }),
    profile: profileOf(settings, texts),
    route: routeOf(settings, texts),
    format: formatOf(settings, texts),
    reconnect: reconnectOf(settings, texts),
    allowWrites: settings.allowWrites,
    allowControl: settings.allowControl,
  }
}

function profileOf(settings: ConnectionSettings, texts: Texts): ProfileId {
  // Not defaulted: with the wrong series X10 is another input, and the PLC does not say so.
  return choice(settings, 'profile', profileIds, texts) ?? missing('profile', texts)
}

function routeOf(settings: ConnectionSettings, texts: Texts): Partial<Route> {
  return present({
    network: wholeNumber(settings, 'network', texts),
    station: wholeNumber(settings, 'station', texts),
    moduleIo: hexNumber(settings, 'moduleIo', texts),
    multidrop: wholeNumber(settings, 'multidrop', texts),
    extensionStation: wholeNumber(settings, 'extensionStation', texts),
  })
}

function reconnectOf(
  settings: ConnectionSettings,
  texts: Texts,
): { readonly first?: number; readonly longest: number } {
  return {
    ...present({ first: wholeNumber(settings, 'reconnectFirst', texts) }),
    longest: wholeNumber(settings, 'reconnectLongest', texts) ?? LONGEST_PAUSE,
  }
}

function formatOf(settings: ConnectionSettings, texts: Texts): ValueFormat {
  return present({
    encoding: choice(settings, 'encoding', encodings, texts),
    wordOrder: choice(settings, 'wordOrder', ['low-first', 'high-first'], texts),
  })
}

function xyRadixOf(settings: ConnectionSettings, texts: Texts): 8 | 16 | undefined {
  const text = choice(settings, 'xyRadix', ['8', '16'], texts)
  return text === undefined ? undefined : text === '8' ? 8 : 16
}

function wRadixOf(settings: ConnectionSettings, texts: Texts): 10 | 16 | undefined {
  const text = choice(settings, 'wRadix', ['10', '16'], texts)
  return text === undefined ? undefined : text === '10' ? 10 : 16
}

function choice<T extends string>(
  settings: ConnectionSettings,
  field: TextField,
  choices: readonly T[],
  texts: Texts,
): T | undefined {
  const text = settings[field]
  const chosen = choices.find((candidate) => candidate === text)
  if (chosen !== undefined || text === '') return chosen
  throw bad(texts, field, 'error.notChoice', { value: text, choices: choices.join(', ') })
}

function wholeNumber(settings: ConnectionSettings, field: TextField, texts: Texts): number | undefined {
  const text = settings[field]
  if (text === '') return undefined
  if (/^[0-9]{1,9}$/.test(text)) return Number(text)
  throw bad(texts, field, 'error.notNumber', { value: text })
}

function hexNumber(settings: ConnectionSettings, field: TextField, texts: Texts): number | undefined {
  const text = settings[field].replace(/h$/i, '')
  if (text === '') return undefined
  if (/^[0-9a-f]{1,4}$/i.test(text)) return Number.parseInt(text, 16)
  throw bad(texts, field, 'error.notHex', { value: text })
}

function missing(field: keyof ConnectionSettings, texts: Texts): never {
  throw bad(texts, field, 'error.missing')
}

type Present<T> = { [K in keyof T]?: Exclude<T[K], undefined> }

/** Without the fields that are undefined: an option that is there must have a value. */
function present<T extends object>(fields: T): Present<T> {
  return Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== undefined)) as Present<T>
}
