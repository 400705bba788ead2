/**
 * `POST /melsec-jw/address/check`: what items will read, while they are being typed. Nothing is sent to a PLC.
 *
 * Body: `{ settings, items: [{ address, type }] }`, where `settings` are those of the connection, also ones that are
 * not deployed yet. Answer: `{ results }`, for each item `{ ok: true, ...ItemExplanation }` or `{ ok: false, message }`.
 */
import type { NodeAPI } from 'node-red'
import { createMelsecClient, type ItemExplanation, type MelsecClient } from '../src/index'
import { endpoint, objectIn, type Reply } from './admin'
import { settingsOf, speech } from './connection-settings'
import { detailsOf } from './failure'
import type { StoredSettings } from './migration'
import { itemOf } from './stored'
import type { Texts } from './texts'

/** More rows than a person types. */
const MOST_ITEMS = 1000
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
    // What decides about addresses is chosen from lists, so it holds no variables; the rest does not matter here.
    const { profile, ...said } = settingsOf(given, { texts, resolve: (text) => text })
    const { frame, code, asciiXy, asciiZr, xyRadix, wRadix } = said
    const chosen = { profile: profile === '' ? 'generic' : profile, frame, code, asciiXy, asciiZr, xyRadix, wRadix }
    const settings = settingsOf(chosen, { texts, resolve: (text) => text })
    return createMelsecClient({ host: 'nowhere', port: 1, ...speech(settings, texts) })
  } catch (error) {
    return { problem: texts('error.connection', { message: detailsOf(error, texts).message }) }
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
