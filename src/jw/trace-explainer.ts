// Messages of a JW for a trace. An answer has no length: it is whole when its request says so.
import { hasSecret } from '../codec/codec'
import type { FrameExplainer } from '../link/link'
import { jwCommands } from './commands/commands'
import { type ExplainJwOptions, explainJwFrame, messageStartIn } from './explain-frame'

/** Codes of the commands whose request holds a password. */
const SECRET: ReadonlySet<number> = new Set(
  Object.values(jwCommands)
    .filter(({ request }) => hasSecret(request))
    .map(({ code }) => code),
)
/** Of COM behind the start of a message. */
const COMMAND = 2

export function jwExplainer(options: Pick<ExplainJwOptions, 'marker' | 'header'>): FrameExplainer {
  const explain: FrameExplainer['explain'] = (bytes, { request }) =>
    explainJwFrame(bytes, request === undefined ? options : { ...options, request })
  return {
    hasSecretAnswers: false,
    endsWithRequest: true,
    sent(bytes) {
      const command = bytes[messageStartIn(bytes, options) + COMMAND]
      return { serial: 0, isRegistration: false, isSecret: command !== undefined && SECRET.has(command) }
    },
    received(bytes, request) {
      const isWhole = explain(bytes, request === undefined ? {} : { request }).fault === undefined
      return isWhole ? { used: bytes.length, serial: 0 } : undefined
    },
    explain,
  }
}
