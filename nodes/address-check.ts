/**
 * `POST /melsec-jw/address/check`: what items will read, while they are being typed. Nothing is sent to a PLC.
 *
 * Body: `{ settings, items: [{ address, type }] }`, where `settings` are those of the connection, also ones that are
 * not deployed yet. Answer: `{ results }`, for each item `{ ok: true, ...ItemExplanation }` or `{ ok: false, message }`.
 */
import type { NodeAPI } from 'node-red'
import {
  createMelsecClient,
  createMelsecLine,
  type ItemExplanation,
  type MelsecClient,
  type MelsecClientOptions,
} from '../src/index'
import { endpoint, objectIn, type Reply } from './admin'
import { isOnLine, LINE_PROFILE, settingsOf, speech, speechOnLine } from './connection-settings'
import { detailsOf } from './failure'
import { type LineContext, lineOptionsOf, lineSettingsOf } from './line-settings'
import type { StoredSettings } from './migration'
import { itemOf } from './stored'
import type { Texts } from './texts'

/** More rows than a person types. */
const MOST_ITEMS = 1000
const NOWHERE = { host: 'nowhere', port: 1 } as const
/** Longer than any address. */
const LONGEST = 500

export type Checked = ({ readonly ok: true } & ItemExplanation) | { readonly ok: false; readonly message: string }

export function addressCheck(RED: NodeAPI, texts: Texts): void {
  endpoint(RED, '/melsec-jw/address/check', 'melsec-jw.read', texts, (body) => check(body, texts))
}

function check(body: StoredSettings, texts: Texts): Reply {
  const { items } = body
  if (!Array.isArray(items) || items.length > MOST_ITEMS) {
    return { status: 400, body: { message: texts('error.badBody') } }
  }
  const client = speaker(objectIn(body, 'settings'), texts)
  return { status: 200, body: { results: items.map((item: unknown) => checkItem(client, item, texts)) } }
}

/** A client that never connects: it knows how addresses of this PLC are written, and nothing of where it is. */
export function speaker(given: StoredSettings, texts: Texts): MelsecClient | { readonly problem: string } {
  try {
    return createMelsecClient(speakerOptions(given, { texts, labels: texts, resolve: (text) => text }))
  } catch (error) {
    return { problem: texts('error.connection', { message: detailsOf(error, texts).message }) }
  }
}

/** What decides about addresses is chosen from lists, so it holds no variables; the rest does not matter here. */
function speakerOptions(given: StoredSettings, context: LineContext): MelsecClientOptions {
  const { texts } = context
  const settings = settingsOf(given, context)
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

function checkItem(client: ReturnType<typeof speaker>, item: unknown, texts: Texts): Checked {
  if ('problem' in client) return { ok: false, message: client.problem }
  try {
    const { address, type } = { address: '', type: '', ...(typeof item === 'object' ? item : {}) }
    if (typeof address !== 'string' || typeof type !== 'string' || address.length > LONGEST || type.length > LONGEST) {
      return { ok: false, message: texts('error.badBody') }
    }
    return { ok: true, ...client.explain(itemOf({ name: '', address: address.trim(), type: type.trim() })) }
  } catch (error) {
    return { ok: false, message: detailsOf(error, texts).message }
  }
}
