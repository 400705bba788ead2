// Serial frames as planners see them.
import type { PlanProtocol } from '../../src/client/plan/limit'
import type { LimitRule } from '../../src/melsec/device/limit-rule'
import { type SerialFormat, type SerialHead, serialRoute } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { protocolOver1c } from '../../src/melsec/one-c/slmp-over-1c'
import type { Profile } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'

export function over1c(format: 1 | 4 = 1, sumCheck = true, turnRound = 0): PlanProtocol {
  return protocolOver1c({
    profile: profiles['fx5-serial'],
    framing: serialFraming({ frame: '1C', format, sumCheck }),
    head: serialRoute('1C'),
    asciiXy: 'octal',
    turnRound,
  })
}

const fx5 = profiles['fx5-serial']

export function overSerial(
  frame: '3C' | '4C',
  format: SerialFormat,
  sumCheck = true,
  profile = fx5,
): MelsecProtocol<SerialHead> {
  const framing = serialFraming({ frame, format, sumCheck })
  return new MelsecProtocol({ framing, head: serialRoute(frame), profile, code: framing.code, asciiXy: 'octal' })
}

/** The FX5 with requests that carry less: points of each command, as its manual counts them. */
export function smallFx5(max: Readonly<Partial<Record<LimitRule['commands'][number], number>>>): Profile {
  const limits = fx5.limits.map((rule) => {
    const least = rule.commands
      .map((name) => (rule.unit === 'blocks' ? undefined : max[name]))
      .filter((n) => n !== undefined)
    return least.length === 0 ? rule : { ...rule, max: Math.min(...least) }
  })
  return { ...fx5, limits }
}
