/**
 * `POST /melsec-jw/request/check`: whether a command takes a message, while it is being typed. Nothing is sent to a PLC.
 *
 * Body: `{ settings, command, message }`, where `settings` are those of the connection and `message` is the JSON text.
 * Answer: `{ ok: true }` or `{ ok: false, message }`.
 */
import type { NodeAPI } from 'node-red'
import { speaker } from './address-check'
import { endpoint, objectIn, type Reply } from './admin'
import { detailsOf } from './failure'
import type { StoredSettings } from './migration'
import { requestsOf } from './named-requests'
import type { Texts } from './texts'

export type CheckedRequest = { readonly ok: true } | { readonly ok: false; readonly message: string }

export function requestCheck(RED: NodeAPI, texts: Texts): void {
  endpoint(RED, '/melsec-jw/request/check', 'melsec-jw.read', texts, (body) => check(body, texts))
}

function check(body: StoredSettings, texts: Texts): Reply {
  const { command, message } = body
  if (typeof command !== 'string' || typeof message !== 'string') {
    return { status: 400, body: { message: texts('error.badBody') } }
  }
  return { status: 200, body: checkMessage(objectIn(body, 'settings'), { command, message }, texts) }
}

function checkMessage(
  settings: StoredSettings,
  { command, message }: { readonly command: string; readonly message: string },
  texts: Texts,
): CheckedRequest {
  const plc = speaker(settings, texts)
  if ('problem' in plc) return { ok: false, message: plc.problem }
  try {
    requestsOf(plc).check(command, jsonOf(message, texts))
    return { ok: true }
  } catch (error) {
    return { ok: false, message: detailsOf(error, texts).message }
  }
}

/** @throws Error that does not repeat the text: there may be a password in it. */
export function jsonOf(text: string, texts: Texts): unknown {
  try {
    return JSON.parse(text)
  } catch {
    throw new Error(texts('error.notJson'))
  }
}
