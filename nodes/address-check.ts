/**
 * `POST /melsec-jw/address/check`: what items will read, while they are being typed. Nothing is sent to a PLC.
 *
 * Body: `{ settings, items: [{ address, type }] }`, where `settings` are those of the connection, also ones that are
 * not deployed yet. Answer: `{ results }`, for each item `{ ok: true, ...ItemExplanation }` or `{ ok: false, message }`.
 */
import type { NodeAPI } from 'node-red'
import { hex } from '../src/basics/hex'
import { octal } from '../src/basics/octal'
import { parseJwItem } from '../src/entry/address'
import { createMelsecLine, type Item, type JwClient, type MelsecClientOptions } from '../src/index'
import { endpoint, objectIn, type Reply } from './admin'
import {
  type ConnectionSettings,
  familyOf,
  isOnLine,
  jwSpeechOf,
  LINE_PROFILE,
  settingsOf,
  speech,
  speechOnLine,
} from './connection-settings'
import { detailsOf } from './failure'
import { type AnyPlc, clientOf, type FamilyOptions, forFamily, type NodeClient } from './family'
import { type LineContext, lineOptionsOf, lineSettingsOf } from './line-settings'
import type { StoredSettings } from './migration'
import { itemOf } from './stored'
import type { Texts } from './texts'

/** More rows than a person types. */
const MOST_ITEMS = 1000
const NOWHERE = { host: 'nowhere', port: 1 } as const
/** Longer than any address. */
const LONGEST = 500

export type Checked =
  | ({ readonly ok: true } & ReturnType<NodeClient['explain']>)
  | { readonly ok: false; readonly message: string }

export function addressCheck(RED: NodeAPI, texts: Texts): void {
  endpoint(RED, '/melsec-jw/address/check', 'melsec-jw.read', texts, (body) => check(body, texts))
}

function check(body: StoredSettings, texts: Texts): Reply {
  const { items } = body
  if (!Array.isArray(items) || items.length > MOST_ITEMS) {
    return { status: 400, body: { message: texts('error.badBody') } }
  }
  const plc = speaker(objectIn(body, 'settings'), texts)
  return { status: 200, body: { results: items.map((item: unknown) => checkItem(plc, item, texts)) } }
}

/** A client that never connects: it knows how addresses of this PLC are written, and nothing of where it is. */
export function speaker(given: StoredSettings, texts: Texts): AnyPlc | { readonly problem: string } {
  try {
    return clientOf(speakerOptions(given, { texts, labels: texts, resolve: (text) => text }))
  } catch (error) {
    return { problem: texts('error.connection', { message: detailsOf(error, texts).message }) }
  }
}

function speakerOptions(given: StoredSettings, context: LineContext): FamilyOptions {
  const settings = settingsOf(given, context)
  const family = familyOf(settings, context.texts)
  return family === 'jw'
    ? { family, options: { ...NOWHERE, ...jwSpeechOf(settings, context.texts) } }
    : { family, options: melsecSpeaker(given, settings, context) }
}

/** What decides about addresses is chosen from lists, so it holds no variables; the rest does not matter here. */
function melsecSpeaker(given: StoredSettings, settings: ConnectionSettings, context: LineContext): MelsecClientOptions {
  const { texts } = context
  const { profile, way, frame, code, asciiXy, asciiZr, xyRadix, wRadix } = settings
  const said = { way, asciiXy, asciiZr, xyRadix, wRadix }
  if (!isOnLine(settings, texts)) {
    const chosen = { ...said, profile: profile === '' ? 'generic' : profile, frame, code }
    return { ...NOWHERE, ...speech(settingsOf(chosen, context), texts) }
  }
  const { messageFormat } = given
  const line = lineSettingsOf({ ...NOWHERE, transport: 'tcp', frame: given.lineFrame, messageFormat }, context)
  const chosen = { ...said, profile: profile === '' ? LINE_PROFILE : profile }
  return {
    line: createMelsecLine(lineOptionsOf(line, context)),
    ...speechOnLine(settingsOf(chosen, context), texts),
  }
}

/** Where an operand of a Sharp JW lies, for people: file numbers are hexadecimal, addresses and numbers octal. */
export interface OperandPlace {
  readonly in: 'file' | 'system' | 'timer'
  readonly file?: string
  /** Byte, or number of the timer. */
  readonly at: string
  readonly bit?: number
}

function whereOf({ options: { areas } }: JwClient, item: Item): OperandPlace {
  const { place } = parseJwItem(item, areas === undefined ? {} : { areas })
  if (place.in === 'timer') return { in: 'timer', at: octal(place.number, 4) }
  return {
    in: place.in,
    ...(place.in === 'file' ? { file: hex(place.file) } : {}),
    at: octal(place.address, 6),
    ...(place.bit === undefined ? {} : { bit: place.bit }),
  }
}

function checkItem(plc: ReturnType<typeof speaker>, item: unknown, texts: Texts): Checked {
  if ('problem' in plc) return { ok: false, message: plc.problem }
  try {
    const { address, type } = { address: '', type: '', ...(typeof item === 'object' ? item : {}) }
    if (typeof address !== 'string' || typeof type !== 'string' || address.length > LONGEST || type.length > LONGEST) {
      return { ok: false, message: texts('error.badBody') }
    }
    const given = itemOf({ name: '', address: address.trim(), type: type.trim() })
    return forFamily<Checked>(plc, {
      melsec: (client) => ({ ok: true, ...client.explain(given) }),
      jw: (client) => ({ ok: true, ...client.explain(given), where: whereOf(client, given) }),
    })
  } catch (error) {
    return { ok: false, message: detailsOf(error, texts).message }
  }
}
