// SLMP frames for a trace.
import { type DataCode, hasSecret, readerOf } from '../../codec/codec'
import { PlcError } from '../../errors'
import type { AnswerFraming, FrameExplainer, ReceivedFrame, SentFrame } from '../../link/link'
import type { Command } from '../commands/command'
import { knownCommands } from '../commands/known'
import type { SlmpFrameName } from '../frame/frames'
import { isSerialFrame, type SerialFormat, type SerialFrameName } from '../frame/serial-frames'
import type { Profile } from '../profiles/profile'
import { explainFrame } from './frame'
import type { ExplainFrameOptions } from './options'

export interface SlmpExplainerOptions {
  readonly frame: SlmpFrameName | SerialFrameName
  /** What finds the frames among the bytes. `wholeBody`: where a request does not say where its body ends. */
  readonly framing: AnswerFraming & { wholeBody?(soFar: Buffer): number }
  /** Of a serial frame. */
  readonly messageFormat?: SerialFormat | undefined
  readonly code: DataCode
  readonly profile: Profile
  readonly xyRadix?: 8 | 16
  readonly wRadix?: 10 | 16
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
  readonly asciiZr?: 'decimal' | 'hexadecimal' | undefined
  /** Declarations to know instead of all of this package's. */
  readonly commands?: Readonly<Record<string, Command>>
}

export function slmpExplainer(options: SlmpExplainerOptions): FrameExplainer {
  const { code, framing } = options
  const commands: Readonly<Record<string, Command>> = options.commands ?? knownCommands
  const { request, response } = framing
  const list = Object.values(commands)
  const secret = list.filter((command) => hasSecret(command.request) || hasSecret(command.response))
  const secretCodes = new Set(secret.map((command) => command.code))
  const registering = new Set(list.flatMap(({ context }) => (context === undefined ? [] : [commands[context]?.code])))
  const explaining = explainOptions(options, commands)
  return {
    hasSecretAnswers: secret.some(
      (command) => hasSecret(command.response) || Object.values(command.response).some(({ kind }) => kind === 'echo'),
    ),
    endsWithRequest: false,
    sent(bytes): SentFrame | undefined {
      const scanned = attempt(() => request.scan(bytes, (_head, soFar) => framing.wholeBody?.(soFar)))
      if (scanned === undefined) return undefined
      const { serial = 0, body } = scanned.frame
      const asked = attempt(() => readerOf(code, body).uint(2))
      return {
        serial,
        isRegistration: asked !== undefined && registering.has(asked),
        isSecret: secretCodes.size > 0 && (asked === undefined || secretCodes.has(asked)),
      }
    },
    received(bytes): ReceivedFrame | undefined {
      if (response.isUnsolicited?.(bytes) === true) {
        const unasked = request.scan(bytes, () => undefined)
        return unasked && { used: unasked.used, serial: undefined }
      }
      const answer = response.scan(bytes, () => undefined)
      return answer && { used: answer.used, serial: answer.frame.serial ?? 0 }
    },
    explain: (bytes, known) => explainFrame(bytes, { ...explaining, ...known }),
  }
}

function explainOptions(
  { frame, messageFormat, code, profile, xyRadix, wRadix, asciiXy, asciiZr }: SlmpExplainerOptions,
  commands: Readonly<Record<string, Command>>,
): ExplainFrameOptions {
  return {
    ...(isSerialFrame(frame) ? { frame } : {}),
    ...(messageFormat === undefined ? {} : { format: messageFormat }),
    code,
    profile,
    commands,
    ...(xyRadix === undefined ? {} : { xyRadix }),
    ...(wRadix === undefined ? {} : { wRadix }),
    // Elsewhere the port has no such setting.
    ...(asciiXy === undefined || profile.asciiXy !== 'setting' ? {} : { asciiXy }),
    ...(asciiZr === undefined ? {} : { asciiZr }),
  }
}

/** What a scan finds, or `undefined` when the bytes are nothing it knows: a trace shows them all the same. */
function attempt<T>(scan: () => T): T | undefined {
  try {
    return scan()
  } catch (error) {
    if (error instanceof PlcError) return undefined
    throw error
  }
}
