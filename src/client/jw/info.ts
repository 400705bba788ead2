// What a PLC says of itself.
import { EndCodeError } from '../../errors'
import { jwCommands } from '../../jw/commands/commands'
import { type CallOptions, callOptionsOf } from '../connection/call'
import type { JwInfo, JwMemorySize } from './client'
import { jwClock } from './clock'
import { type JwCallParts, jwControl, sharing } from './control'
import { jwSecret } from './secret'
import type { SendJwCommand } from './send-command'

/** K words by the code of a JW300 (4DH). */
const KILO_WORDS: Readonly<Record<number, number>> = { 3: 32, 7: 64, 8: 128, 9: 256 }

export async function jwMemorySize(send: SendJwCommand, options?: CallOptions): Promise<JwMemorySize> {
  const { size: code } = await send(jwCommands.readMemorySize, {}, options)
  const kiloWords = KILO_WORDS[code]
  return kiloWords === undefined ? { code } : { code, kiloWords }
}

export async function jwInfo(parts: JwCallParts, options: CallOptions = {}): Promise<JwInfo> {
  // All of them share the deadline of the call.
  const shared = { ...parts, send: sharing(parts, callOptionsOf(options)) }
  const control = jwControl(shared)
  const memorySize = await told(() => jwMemorySize(shared.send))
  const runState = await told(() => control.runState())
  const writeMode = await told(() => control.writeMode())
  const secret = await told(() => jwSecret(shared.send).isEnabled())
  const clock = await told(() => jwClock(shared).read())
  return {
    ...(memorySize === undefined ? {} : { memorySize }),
    ...(runState === undefined ? {} : { runState }),
    ...(writeMode === undefined ? {} : { writeMode }),
    ...(secret === undefined ? {} : { secret }),
    ...(clock === undefined ? {} : { clock }),
  }
}

/** `undefined` when the PLC refuses to tell: it has no clock, or does not know the command. */
async function told<T>(ask: () => Promise<T>): Promise<T | undefined> {
  try {
    return await ask()
  } catch (error) {
    if (error instanceof EndCodeError) return undefined
    throw error
  }
}
