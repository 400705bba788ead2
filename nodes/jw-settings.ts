// The settings of a connection to a Sharp JW as a flow stores them, and the client's options made of them.
import {
  assumedJwAreas,
  encodings,
  type JwArea,
  type JwClientOptions,
  type JwHeader,
  jwModels,
  jwProbeKinds,
  jwTransportNames,
  type NetworkPlc,
} from '../src/index'
import { type Fields, present } from './fields'
import type { StoredSettings } from './migration'

/** Fields that a Sharp JW alone has. Numbers are text as typed, and `''` is the default of the client. */
export const JW_FIELDS = [
  'model',
  'header',
  'headerBytes',
  'pda',
  'psa',
  'slot',
  'relayStation',
  'marker',
  'lists',
  'maxData',
  'areas',
  'jwProbe',
  'gapBytes',
] as const

/** Fields that it shares with the others. */
type SharedField =
  | 'host'
  | 'port'
  | 'transport'
  | 'localAddress'
  | 'localPort'
  | 'timeout'
  | 'queueLimit'
  | 'reconnectFirst'
  | 'reconnectLongest'
  | 'encoding'
  | 'wordOrder'
export type JwField = (typeof JW_FIELDS)[number]
type Field = JwField | SharedField

/** What the editor stores of a Sharp JW. */
export interface JwSettings extends Readonly<Record<Field, string>> {
  readonly allowWrites: boolean
  readonly allowControl: boolean
  readonly allowParameters: boolean
  /** The areas of the user as JSON, where `areas` is `own`. */
  readonly ownAreas: string
}

/** What stands in front of a message. */
export const headerChoices = ['none', 'zero40', 'relay', 'bytes'] as const
/** Where operands lie: as printed, also as is likely, or as the user says. */
export const areaChoices = ['printed', 'assumed', 'own'] as const
/** Longer than any map of a PLC. */
const LONGEST_AREAS = 20_000

/** @throws NodeFailure NOT_CONFIGURED naming the field that is no text */
export function ownAreasIn(given: StoredSettings, fields: Fields<Field>): string {
  const { ownAreas = '' } = given
  if (typeof ownAreas !== 'string' || ownAreas.length > LONGEST_AREAS) throw fields.bad('ownAreas', 'error.notText')
  return ownAreas.trim()
}

/**
 * The options of the client of a Sharp JW. Ranges and combinations are the client's business; here only texts become numbers.
 * @param longestPause ms between attempts to connect, where none is given
 * @throws NodeFailure NOT_CONFIGURED naming the field
 */
export function jwOptionsOf(
  settings: JwSettings,
  fields: Fields<Field>,
  longestPause: number,
): JwClientOptions & NetworkPlc {
  return {
    host: settings.host === '' ? fields.missing('host') : settings.host,
    port: fields.wholeNumber(settings, 'port') ?? fields.missing('port'),
    ...present({
      transport: fields.choice(settings, 'transport', jwTransportNames),
      localAddress: settings.localAddress === '' ? undefined : settings.localAddress,
      localPort: fields.wholeNumber(settings, 'localPort'),
      header: headerOf(settings, fields),
      timeout: fields.wholeNumber(settings, 'timeout'),
      probe: fields.choice(settings, 'jwProbe', jwProbeKinds),
      queueLimit: fields.wholeNumber(settings, 'queueLimit'),
      gap: fields.wholeNumber(settings, 'gapBytes'),
      maxData: fields.wholeNumber(settings, 'maxData'),
    }),
    reconnect: {
      ...present({ first: fields.wholeNumber(settings, 'reconnectFirst') }),
      longest: fields.wholeNumber(settings, 'reconnectLongest') ?? longestPause,
    },
    ...jwSpeech(settings, fields),
    allowWrites: settings.allowWrites,
    allowControl: settings.allowControl,
    allowParameters: settings.allowParameters,
  }
}

/** Everything that decides how items are written and what they may be. */
export function jwSpeech(settings: JwSettings, fields: Fields<Field>): JwClientOptions {
  return {
    ...present({
      model: fields.choice(settings, 'model', jwModels),
      marker: fields.choice(settings, 'marker', ['once', 'each']),
      lists: fields.switch(settings, 'lists'),
      areas: areasOf(settings, fields),
    }),
    format: present({
      encoding: fields.choice(settings, 'encoding', encodings),
      wordOrder: fields.choice(settings, 'wordOrder', ['low-first', 'high-first']),
    }),
  }
}

function headerOf(settings: JwSettings, fields: Fields<Field>): JwHeader | undefined {
  const choice = fields.choice(settings, 'header', headerChoices)
  const number = (field: Field) => fields.wholeNumber(settings, field) ?? fields.missing(field)
  switch (choice) {
    case 'relay':
      return { pda: number('pda'), psa: number('psa'), slot: number('slot'), station: number('relayStation') }
    case 'bytes':
      return bytesOf(settings.headerBytes, fields)
    default:
      return choice
  }
}

function bytesOf(text: string, fields: Fields<Field>): Uint8Array {
  const digits = text.replaceAll(/\s/g, '')
  if (digits === '') fields.missing('headerBytes')
  if (!/^(?:[0-9a-f]{2})+$/i.test(digits)) throw fields.bad('headerBytes', 'error.notHexBytes', { value: text })
  return Uint8Array.from(Buffer.from(digits, 'hex'))
}

/** What the areas of the user are is checked by the client. */
function areasOf(settings: JwSettings, fields: Fields<Field>): readonly JwArea[] | undefined {
  const choice = fields.choice(settings, 'areas', areaChoices)
  if (choice !== 'own') return choice === 'assumed' ? assumedJwAreas : undefined
  const own = jsonOf(settings.ownAreas)
  if (!Array.isArray(own)) throw fields.bad('ownAreas', 'error.notAreas')
  return own
}

function jsonOf(text: string): unknown {
  try {
    return JSON.parse(text)
  } catch {
    return undefined
  }
}
