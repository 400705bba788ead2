// Specified buffers and ring buffers: areas of the memory that a program of the PLC shares with a partner.
import { checkBooleans, type OptionNames } from '../../basics/option-checks'
import { jwCommands } from '../../jw/commands/commands'
import { type CallOptions, callOptionsOf } from '../connection/call'
import type { JwRequestOf, JwResponseOf, SendJwCommand } from './send-command'

/** Of a request to a ring buffer: bits of its function switch. */
export interface JwRingOptions extends CallOptions {
  /** Data of the confirmed type (bit 7): the next request acknowledges that this answer has arrived. Default false. */
  readonly confirmed?: boolean
  /** The answer to the request before has arrived (bit 1). Default false. */
  readonly acknowledge?: boolean
}

const RING_OPTIONS: OptionNames<Omit<JwRingOptions, keyof CallOptions>> = { confirmed: true, acknowledge: true }
/** Bits of FUN (39H; 29H is taken to have the same). */
const FUN = { requested: 0x01, acknowledge: 0x02, confirmed: 0x80 } as const

/** Specified buffers 0 to 1FH. Writing needs `allowWrites`, defining `allowParameters`. */
export interface JwSpecifiedBuffers {
  /** 1 to 1024 bytes (28H). @param offset of the first byte in the buffer */
  read(buffer: number, offset: number, length: number, options?: CallOptions): Promise<Uint8Array>
  /** 1 to 1024 bytes (38H). */
  write(buffer: number, offset: number, data: Uint8Array, options?: CallOptions): Promise<void>
  /** Where the buffer is (68H). */
  info(buffer: number, options?: CallOptions): Promise<JwResponseOf<typeof jwCommands.readSpecifiedBufferInformation>>
  /** Defines the buffer (78H). */
  define(
    buffer: number,
    definition: Omit<JwRequestOf<typeof jwCommands.writeSpecifiedBufferInformation>, 'buffer'>,
    options?: CallOptions,
  ): Promise<void>
}

/** What a ring buffer gave. */
export interface JwRingData {
  /** What was taken out of it. */
  readonly data: Uint8Array
  /** Read pointer of the data. */
  readonly pointer: number
  /** Whether there is more that nobody has read. */
  readonly more: boolean
}

/** What a ring buffer took. */
export interface JwRingWritten {
  /** Bytes that were written: perhaps not all. */
  readonly written: number
  /** Bytes that are free now. */
  readonly free: number
  /** Write pointer before. */
  readonly pointer: number
}

/**
 * Ring buffers 0 to 0FH. Reading and writing move pointers, so both need `allowWrites` and neither is ever repeated: what was read
 * and lost on the way does not come again.
 */
export interface JwRingBuffers {
  /** Takes up to 1024 bytes out (29H). That its function switch has the bits of 39H is assumed: the manual leaves them out. */
  read(ring: number, length?: number, options?: JwRingOptions): Promise<JwRingData>
  /** Puts up to 1024 bytes in (39H). Look at `written`. */
  write(ring: number, data: Uint8Array, options?: JwRingOptions): Promise<JwRingWritten>
  /** Where the buffer is, and its pointers (69H). */
  info(ring: number, options?: CallOptions): Promise<JwResponseOf<typeof jwCommands.readRingBufferInformation>>
  /** Defines the buffer (79H). Needs `allowParameters`. */
  define(
    ring: number,
    definition: Omit<JwRequestOf<typeof jwCommands.writeRingBufferInformation>, 'buffer'>,
    options?: CallOptions,
  ): Promise<void>
}

/** Both kinds of buffers. */
export interface JwBuffers {
  /** Specified buffers. */
  readonly specified: JwSpecifiedBuffers
  /** Ring buffers. */
  readonly ring: JwRingBuffers
}

function functionOf({ confirmed = false, acknowledge = false }: JwRingOptions): number {
  return FUN.requested + (acknowledge ? FUN.acknowledge : 0) + (confirmed ? FUN.confirmed : 0)
}

export function jwBuffers(send: SendJwCommand): JwBuffers {
  const ringCall = (options: JwRingOptions): CallOptions => {
    const call = callOptionsOf(options, RING_OPTIONS)
    checkBooleans(options, ['confirmed', 'acknowledge'])
    return call
  }
  return {
    specified: {
      read: async (buffer, offset, length, options) =>
        (await send(jwCommands.readSpecifiedBuffer, { buffer, offset, length }, options)).data,
      write: async (buffer, offset, data, options) => {
        await send(jwCommands.writeSpecifiedBuffer, { buffer, offset, data }, options)
      },
      info: async (buffer, options) => send(jwCommands.readSpecifiedBufferInformation, { buffer }, options),
      define: async (buffer, definition, options) => {
        await send(jwCommands.writeSpecifiedBufferInformation, { ...definition, buffer }, options)
      },
    },
    ring: {
      read: async (ring, length = 1024, options = {}) => {
        const call = ringCall(options)
        const message = { buffer: ring, function: functionOf(options), length }
        const { data, pointer, more } = await send(jwCommands.readRingBuffer, message, call)
        return { data, pointer, more: more === 1 }
      },
      write: async (ring, data, options = {}) => {
        const call = ringCall(options)
        const message = { buffer: ring, function: functionOf(options), data }
        const { written, free, pointer } = await send(jwCommands.writeRingBuffer, message, call)
        return { written, free, pointer }
      },
      info: async (ring, options) => send(jwCommands.readRingBufferInformation, { buffer: ring }, options),
      define: async (ring, definition, options) => {
        await send(jwCommands.writeRingBufferInformation, { ...definition, buffer: ring }, options)
      },
    },
  }
}
