// 1E frames for a trace. An answer has no length: it is whole when its request says so.
import type { DataCode } from '../../codec/codec'
import type { FrameExplainer } from '../../link/link'
import type { Profile } from '../profiles/profile'
import { explainFrame } from './frame'
import type { ExplainFrameOptions } from './options'

export interface Explainer1eOptions {
  readonly code: DataCode
  readonly profile: Profile
  readonly xyRadix?: 8 | 16
  readonly wRadix?: 10 | 16
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
}

export function explainer1e({ code, profile, xyRadix, wRadix, asciiXy }: Explainer1eOptions): FrameExplainer {
  const options: ExplainFrameOptions = {
    frame: '1E',
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
    endsWithRequest: true,
    sent: () => ({ serial: 0, isRegistration: false, isSecret: false }),
    received(bytes, request) {
      const isWhole = explain(bytes, request === undefined ? {} : { request }).fault === undefined
      return isWhole ? { used: bytes.length, serial: 0 } : undefined
    },
    explain,
  }
}
