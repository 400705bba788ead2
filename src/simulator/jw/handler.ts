// What a handler of a command of a simulated JW is given, and what it gives.
import type { MessageInput, MessageOf } from '../../codec/codec'
import type { JwCommandName, JwCommands } from '../../jw/commands/commands'
import type { RingBuffers, SpecifiedBuffers } from './buffers'
import type { PlcClock } from './clock'
import type { JwCpu } from './cpu'
import type { Files } from './files'
import type { Secret } from './secret'
import type { Timers } from './timers'
import type { OptionUnits, SpecialIo } from './units'

export type { JwCommandName }

/** What a handler works on. */
export interface JwParts {
  readonly files: Files
  /** Segments 08 and 09. */
  readonly systemMemory: Readonly<Record<number, Buffer>>
  readonly timers: Timers
  readonly clock: PlcClock
  readonly secret: Secret
  readonly specifiedBuffers: SpecifiedBuffers
  readonly ringBuffers: RingBuffers
  readonly optionUnits: OptionUnits
  readonly specialIo: SpecialIo
  readonly cpu: JwCpu
}

/** The response data to a request. Throws `Refusal` for a result code. */
export type JwHandler<N extends JwCommandName> = (
  message: MessageOf<JwCommands[N]['request']>,
  parts: JwParts,
) => MessageInput<JwCommands[N]['response']>
