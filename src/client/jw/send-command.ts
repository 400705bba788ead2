import type { MessageInput, MessageOf } from '../../codec/codec'
import type { JwCommand } from '../../jw/commands/commands'
import type { JwHead } from '../../jw/frame'
import type { HeadProtocol } from '../../link/link'
import type { CallOptions } from '../connection/call'

/** The message of a command. */
export type JwRequestOf<C extends JwCommand> = MessageInput<C['request']>
/** What a command is answered with. */
export type JwResponseOf<C extends JwCommand> = MessageOf<C['response']>

/** How a client of a Sharp JW speaks to it. */
export type JwProtocol = HeadProtocol<JwHead>

/** Sends one command: what the client gives to the functions here. */
export type SendJwCommand = <C extends JwCommand>(
  command: C,
  message: JwRequestOf<C>,
  options?: CallOptions,
) => Promise<JwResponseOf<C>>
