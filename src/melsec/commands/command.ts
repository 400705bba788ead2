import type { Declaration, MessageInput, MessageOf, Named } from '../../codec/codec'

/** A command of the SLMP set. The subcommand is computed: bit 0 unit, bit 1 long (iQ-R) form, bit 7 extension. */
export interface MelsecDeclaration extends Declaration {
  /** `none`: the subcommand does not depend on devices and is 0000. */
  readonly unit: 'bit' | 'word' | 'none'
  /** Subcommands that are about something else than devices, when it is not 0000 alone: of files, how names are sent. */
  readonly subcommands?: readonly number[]
  /** Only the station the connection goes to carries it out: it goes there, whatever the route of the client is. */
  readonly to?: 'connected'
  /** Only the control CPU of a multiple CPU system carries it out (SLMP reference manual appendix 3). */
  readonly controlCpuOnly?: true
}

/**
 * A declared command, one of `commands`.
 * @experimental Its shape may change in any version; its name and what its messages hold do not.
 */
export type Command<D extends MelsecDeclaration = MelsecDeclaration, N extends string = string> = Named<D, N>

/** What a request of the command is given as. */
export type RequestOf<C extends Declaration> = MessageInput<C['request']>
/** What a response of the command is read as. */
export type ResponseOf<C extends Declaration> = MessageOf<C['response']>
