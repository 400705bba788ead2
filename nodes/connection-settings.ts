// The settings of a connection as a flow stores them, and the client's options made of them.
import type {
  JwClientOptions,
  MelsecLine,
  MelsecOptions,
  NetworkPlc,
  PlcOnLine,
  ProfileId,
  RouteOptions,
  ValueFormat,
} from '../src/index'
import { encodings, ethernetFrameNames, probeKinds, profileIds, profiles } from '../src/index'
import { type FamilyName, type FamilyOptions, familyNames } from './family'
import { Fields, present, type SettingsContext } from './fields'
import { JW_FIELDS, type JwSettings, jwOptionsOf, jwSpeech, ownAreasIn } from './jw-settings'
import type { Texts } from './texts'

/**
 * What the editor stores. Numbers are text as typed, `''` is the default of the PLC series or the system, and any
 * text may hold `${NAME}`.
 */
export interface ConnectionSettings extends JwSettings {
  /** `melsec` or `jw`; `''` is `melsec`. */
  readonly family: string
  /** `ethernet` or `serial`; `''` is `ethernet`. */
  readonly way: string
  /** Id of the serial line. */
  readonly line: string
  /** Station number on the serial line. */
  readonly lineStation: string
  /** PC number, on a serial line. */
  readonly pc: string
  /** Self station number, on a serial line. */
  readonly selfStation: string
  /** ms; 1C frames. */
  readonly messageWait: string
  readonly host: string
  readonly port: string
  readonly transport: string
  readonly localAddress: string
  readonly localPort: string
  readonly profile: string
  /** One of `ethernetFrameNames` or `''`. */
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
  'family',
  ...JW_FIELDS,
  'way',
  'line',
  'lineStation',
  'pc',
  'selfStation',
  'messageWait',
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

/** Where a series is yet to be found out: it knows every serial frame. */
export const LINE_PROFILE = 'fx5-serial' satisfies ProfileId

/** The transports of an Ethernet port. */
const TRANSPORTS = ['tcp', 'udp'] as const

/** What stands in the settings of a new connection and says nothing: the frames of a serial line do not all have these fields. */
const OWN_ROUTE: Readonly<Partial<Record<TextField, string>>> = {
  network: '0',
  pc: '255',
  moduleIo: '3FF',
  multidrop: '0',
  selfStation: '0',
}

function fieldsOf(texts: Texts): Fields<TextField> {
  return new Fields(texts, (field) => texts(`label.${field}`), 'error.missing')
}

/**
 * Settings from a stored configuration or a request of the editor, with variables replaced.
 * @throws NodeFailure NOT_CONFIGURED naming the field that is no text.
 */
export function settingsOf(
  given: Readonly<Record<string, unknown>>,
  { texts, resolve }: SettingsContext,
): ConnectionSettings {
  const fields = fieldsOf(texts)
  return {
    ...fields.textsOf(given, TEXT_FIELDS, resolve),
    ownAreas: ownAreasIn(given, fields),
    allowWrites: given.allowWrites === true,
    allowControl: given.allowControl === true,
    allowParameters: given.allowParameters === true,
  }
}

/** The family of the PLC. @throws NodeFailure NOT_CONFIGURED for one that there is not */
export function familyOf(settings: ConnectionSettings, texts: Texts): FamilyName {
  return fieldsOf(texts).choice(settings, 'family', familyNames) ?? 'melsec'
}

/**
 * The options of the client of whichever family the PLC is.
 * @param lineOf as of `optionsOf`
 * @throws NodeFailure NOT_CONFIGURED naming the field
 */
export function familyOptionsOf(
  settings: ConnectionSettings,
  texts: Texts,
  lineOf: (id: string) => MelsecLine,
): FamilyOptions {
  const family = familyOf(settings, texts)
  return family === 'jw'
    ? { family, options: jwOptions(settings, texts) }
    : { family, options: optionsOf(settings, texts, lineOf) }
}

/** The options of the client of a Sharp JW. @throws NodeFailure NOT_CONFIGURED naming the field */
export function jwOptions(settings: ConnectionSettings, texts: Texts): JwClientOptions {
  return jwOptionsOf(settings, fieldsOf(texts), LONGEST_PAUSE)
}

/** Everything of a Sharp JW but where it is: enough to read its operands. */
export function jwSpeechOf(settings: ConnectionSettings, texts: Texts): JwClientOptions {
  return jwSpeech(settings, fieldsOf(texts))
}

/** Whether the PLC is on a serial line. @throws NodeFailure NOT_CONFIGURED for anything else than the two ways */
export function isOnLine(settings: ConnectionSettings, texts: Texts): boolean {
  return fieldsOf(texts).choice(settings, 'way', ['ethernet', 'serial']) === 'serial'
}

/**
 * The client's options. Ranges and combinations are the client's business; here only texts become numbers.
 * @param lineOf the serial line with this id, when the PLC is on one; it throws where there is none
 * @throws NodeFailure NOT_CONFIGURED naming the field.
 */
export function optionsOf(
  settings: ConnectionSettings,
  texts: Texts,
  lineOf: (id: string) => MelsecLine,
): MelsecOptions & (NetworkPlc | PlcOnLine) {
  if (!isOnLine(settings, texts)) return networkOptionsOf(settings, texts)
  return { line: lineOf(settings.line), ...speechOnLine(settings, texts) }
}

/** Of a PLC by a network. @throws NodeFailure NOT_CONFIGURED naming the field. */
export function networkOptionsOf(settings: ConnectionSettings, texts: Texts): MelsecOptions & NetworkPlc {
  const fields = fieldsOf(texts)
  return {
    host: settings.host === '' ? fields.missing('host') : settings.host,
    port: fields.wholeNumber(settings, 'port') ?? fields.missing('port'),
    ...speech(settings, texts),
  }
}

/** Everything but where the PLC is: enough to read addresses. */
export function speech(settings: ConnectionSettings, texts: Texts): MelsecOptions {
  const fields = fieldsOf(texts)
  return {
    ...present({
      transport: fields.choice(settings, 'transport', TRANSPORTS),
      localAddress: settings.localAddress === '' ? undefined : settings.localAddress,
      localPort: fields.wholeNumber(settings, 'localPort'),
      frame: fields.choice(settings, 'frame', ethernetFrameNames),
      code: fields.choice(settings, 'code', ['binary', 'ascii']),
      monitoringTimer: fields.wholeNumber(settings, 'monitoringTimer'),
      inFlight: fields.wholeNumber(settings, 'inFlight'),
    }),
    ...common(settings, fields),
    profile: profileOf(settings, fields, false),
    route: present({
      network: fields.wholeNumber(settings, 'network'),
      station: fields.wholeNumber(settings, 'station'),
      moduleIo: fields.hexNumber(settings, 'moduleIo'),
      multidrop: fields.wholeNumber(settings, 'multidrop'),
      extensionStation: fields.wholeNumber(settings, 'extensionStation'),
    }),
  }
}

/** The same of a PLC on a serial line: the line says the rest. */
export function speechOnLine(settings: ConnectionSettings, texts: Texts): MelsecOptions {
  const fields = fieldsOf(texts)
  const wait = fields.wholeNumber(settings, 'messageWait')
  return {
    // It is a part of 1C frames; as delivered it says nothing.
    ...(wait === undefined || wait === 0 ? {} : { messageWait: wait }),
    ...common(settings, fields),
    profile: profileOf(settings, fields, true),
    route: routeOnLine(settings, fields),
  }
}

function routeOnLine(settings: ConnectionSettings, fields: Fields<TextField>): RouteOptions {
  const number = (field: TextField, read: 'wholeNumber' | 'hexNumber') =>
    settings[field].toUpperCase() === OWN_ROUTE[field] ? undefined : fields[read](settings, field)
  return present({
    station: fields.wholeNumber(settings, 'lineStation'),
    network: number('network', 'wholeNumber'),
    pc: number('pc', 'wholeNumber'),
    moduleIo: number('moduleIo', 'hexNumber'),
    multidrop: number('multidrop', 'wholeNumber'),
    selfStation: number('selfStation', 'wholeNumber'),
  })
}

/** What does not depend on the way to the PLC. */
function common(settings: ConnectionSettings, fields: Fields<TextField>): MelsecOptions {
  return {
    ...present({
      asciiXy: fields.choice(settings, 'asciiXy', ['octal', 'hexadecimal']),
      asciiZr: fields.choice(settings, 'asciiZr', ['decimal', 'hexadecimal']),
      asciiWordOrder: fields.choice(settings, 'asciiWordOrder', ['low-first', 'high-first']),
      xyRadix: fields.numberOf(settings, 'xyRadix', [8, 16]),
      wRadix: fields.numberOf(settings, 'wRadix', [10, 16]),
      timeout: fields.wholeNumber(settings, 'timeout'),
      probe: fields.choice(settings, 'probe', probeKinds),
      queueLimit: fields.wholeNumber(settings, 'queueLimit'),
      gap: fields.wholeNumber(settings, 'gap'),
    }),
    format: formatOf(settings, fields),
    reconnect: reconnectOf(settings, fields),
    allowWrites: settings.allowWrites,
    allowControl: settings.allowControl,
  }
}

/** @param onLine whether it must be one of a serial line, or one of an Ethernet port */
function profileOf(settings: ConnectionSettings, fields: Fields<TextField>, onLine: boolean): ProfileId {
  // Not defaulted: with the wrong series X10 is another input, and the PLC does not say so.
  const profile = fields.choice(settings, 'profile', profileIds) ?? fields.missing('profile')
  if ((profiles[profile].serial !== undefined) === onLine) return profile
  throw fields.bad('profile', onLine ? 'error.notOnLine' : 'error.onlyOnLine', { series: profiles[profile].title })
}

function reconnectOf(
  settings: ConnectionSettings,
  fields: Fields<TextField>,
): { readonly first?: number; readonly longest: number } {
  return {
    ...present({ first: fields.wholeNumber(settings, 'reconnectFirst') }),
    longest: fields.wholeNumber(settings, 'reconnectLongest') ?? LONGEST_PAUSE,
  }
}

function formatOf(settings: ConnectionSettings, fields: Fields<TextField>): ValueFormat {
  return present({
    encoding: fields.choice(settings, 'encoding', encodings),
    wordOrder: fields.choice(settings, 'wordOrder', ['low-first', 'high-first']),
  })
}
