// The secret function, which keeps others from the program of the PLC.
import { oneOf } from '../../basics/option-checks'
import { jwCommands } from '../../jw/commands/commands'
import type { CallOptions } from '../connection/call'
import type { SendJwCommand } from './send-command'

/** The secret function. Everything but its state needs `allowParameters`. Passwords are four letters and digits; none is ever shown. */
export interface JwSecret {
  /** Whether it is enabled (FDH). */
  isEnabled(options?: CallOptions): Promise<boolean>
  /** Enables it (FBH). */
  enable(options?: CallOptions): Promise<void>
  /** Erases the password (FBH 0FH). */
  erasePassword(options?: CallOptions): Promise<void>
  /** Releases it (FCH). A wrong password is refused, and is not sent again. */
  release(password: string, options?: CallOptions): Promise<void>
  /** Registers a password (FCH): `final` false for the time being, true for good. */
  register(password: string, final: boolean, options?: CallOptions): Promise<void>
}

const FUNCTION = { enable: 0x01, erase: 0x0f } as const
const PASSWORD = { release: 0, provisional: 1, final: 2 } as const

export function jwSecret(send: SendJwCommand): JwSecret {
  const set = async (value: number, options?: CallOptions) => {
    await send(jwCommands.setSecretFunction, { function: value }, options)
  }
  const give = async (value: number, password: string, options?: CallOptions) => {
    await send(jwCommands.secretPassword, { function: value, password }, options)
  }
  return {
    isEnabled: async (options) => (await send(jwCommands.readSecretState, {}, options)).state === 1,
    enable: async (options) => set(FUNCTION.enable, options),
    erasePassword: async (options) => set(FUNCTION.erase, options),
    release: async (password, options) => give(PASSWORD.release, password, options),
    register: async (password, final, options) => {
      oneOf('final', final, [true, false])
      await give(final ? PASSWORD.final : PASSWORD.provisional, password, options)
    },
  }
}
