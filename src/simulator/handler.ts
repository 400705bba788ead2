// What a handler of a command is given, and what it gives.
import type { MessageInput, MessageOf } from '../codec/codec'
import type { CommandName, Commands } from '../melsec/commands/commands'
import type { Profile } from '../melsec/profiles/profile'
import type { ExtendUnits, OwnBuffer } from './buffer-memory'
import type { Cpu } from './cpu'
import type { ErrorLog } from './error-log'
import type { SimulatedFiles } from './files'
import type { LabelTable } from './labels'
import type { DeviceMemory } from './memory'
import type { PortLock } from './port-lock'

export type RandomDevices = MessageOf<Commands['entryMonitorDevice']['request']>

/** Who asks, and what the PLC remembers of them. */
export interface Caller {
  /** External device, as remote control tells them apart. */
  readonly owner: string
  /** Entry Monitor Device of this connection. */
  monitored: RandomDevices | undefined
  /** Remote password of this connection. */
  readonly lock: PortLock
}

/** What a handler works on. */
export interface HandlerCall {
  readonly profile: Profile
  readonly memory: DeviceMemory
  readonly cpu: Cpu
  readonly errors: ErrorLog
  readonly buffer: OwnBuffer
  readonly extendUnits: ExtendUnits
  readonly labels: LabelTable
  readonly files: SimulatedFiles
  /** Model name, padded to 16 characters, and model code. */
  readonly model: { readonly model: string; readonly modelCode: number }
  readonly caller: Caller
  /** Starts the PLC again; everybody is disconnected. */
  readonly restart: () => void
}

/** The response data to a request. Throws `Refusal` for an end code. */
export type Handler<N extends CommandName> = (
  message: MessageOf<Commands[N]['request']>,
  call: HandlerCall,
  subcommand: number,
) => MessageInput<Commands[N]['response']>
