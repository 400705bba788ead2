import type { Command, RequestOf, ResponseOf } from '../../melsec/commands/command'
import type { CommandName, commands } from '../../melsec/commands/commands'
import type { CallOptions } from '../connection/call'

/** Sends one command: what the client gives to the functions here. */
export type SendCommand = <C extends Command<(typeof commands)[CommandName], string>>(
  command: C,
  message: RequestOf<C>,
  options?: CallOptions,
) => Promise<ResponseOf<C>>
