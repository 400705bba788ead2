// Frames of 1E and 1C for a trace. An answer of 1E has no length: it is whole when its request says so. One of 1C ends by itself.
import type { DataCode } from '../../codec/codec'
import type { FrameExplainer } from '../../link/link'
import type { Profile } from '../profiles/profile'
import { explainFrame } from './frame'
import type { ExplainFrameOptions } from './options'

export interface OtherSetExplainerOptions {
  readonly frame: '1E' | '1C'
  readonly code: DataCode
  readonly profile: Profile
  readonly xyRadix?: 8 | 16
  readonly wRadix?: 10 | 16
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
  /** Bytes of the answer at the front, where it ends by itself; `undefined` when it is not whole yet. */
  readonly answerIn?: (bytes: Buffer) => number | undefined
}

export function otherSetExplainer({
  frame,
  code,
  profile,
  xyRadix,
  wRadix,
  asciiXy,
  answerIn,
}: OtherSetExplainerOptions): FrameExplainer {
  const options: ExplainFrameOptions = {
    frame,
    code,
    profile,
    ...(xyRadix === undefined ? {} : { xyRadix }),
    ...(wRadix === undefined ? {} : { wRadix }),
    // Elsewhere the port has no such setting.
    ...(asciiXy === undefined || profile.asciiXy !== 'setting' ? {} : { asciiXy }),
  }
  const explain: FrameExplainer['explain'] = (bytes, { request }) =>
    explainFrame(bytes, request === undefined ? options : { ...options, request })
  return {
    hasSecretAnswers: false,
    endsWithRequest: answerIn === undefined,
    sent: () => ({ serial: 0, isRegistration: false, isSecret: false }),
    received(bytes, request) {
      if (answerIn !== undefined) {
        const used = answerIn(bytes)
        return used === undefined ? undefined : { used, serial: 0 }
      }
      const isWhole = explain(bytes, request === undefined ? {} : { request }).fault === undefined
      return isWhole ? { used: bytes.length, serial: 0 } : undefined
    },
    explain,
  }
}
