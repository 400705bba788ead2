// What the admin endpoints of the editor share.
import type { NodeAPI } from 'node-red'
import type { StoredSettings } from './migration'
import type { Texts } from './texts'

/** What an endpoint answers: a JSON body with a status code of HTTP. */
export interface Reply {
  readonly status: number
  readonly body: object
}

/** Larger than any dialog of ours can send. */
const LARGEST = 100_000

/** Longest an endpoint works on an answer, in ms, unless it says otherwise. */
const PATIENCE = 20_000

/** The signal is aborted when the editor no longer waits for the answer, and when it took too long. */
export type Handler = (body: StoredSettings, over: AbortSignal) => Reply | Promise<Reply>

/**
 * A POST endpoint of the admin API that takes and gives JSON.
 * @param rule permission, e.g. `melsec-jw.write`, checked by Node-RED's own user management, and how long it may work, ms
 */
export function endpoint(
  RED: NodeAPI,
  path: string,
  rule: string | { readonly permission: string; readonly patience: number },
  texts: Texts,
  handler: Handler,
): void {
  const { permission, patience } = typeof rule === 'string' ? { permission: rule, patience: PATIENCE } : rule
  RED.httpAdmin.post(path, RED.auth.needsPermission(permission), (request, response) => {
    const over = new AbortController()
    response.on('close', () => over.abort())
    AbortSignal.timeout(patience).addEventListener('abort', () => over.abort(), { once: true })
    const body: unknown = request.body
    answer(body, over.signal, handler, texts).then(
      (reply) => response.status(reply.status).json(reply.body),
      (error: unknown) => {
        RED.log.error(error)
        response.status(500).json({ message: texts('error.unexpected') })
      },
    )
  })
}

async function answer(body: unknown, over: AbortSignal, handler: Handler, texts: Texts): Promise<Reply> {
  if (typeof body !== 'object' || body === null || Array.isArray(body)) {
    return { status: 400, body: { message: texts('error.badBody') } }
  }
  if (JSON.stringify(body).length > LARGEST) return { status: 413, body: { message: texts('error.largeBody') } }
  return handler({ ...body }, over)
}

/** An object inside a body; an empty one when it is missing or something else. */
export function objectIn(body: StoredSettings, field: string): StoredSettings {
  const value = body[field]
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? { ...value } : {}
}
