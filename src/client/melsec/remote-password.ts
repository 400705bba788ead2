// The remote password of a client: held here and nowhere else, so that nothing that is shown or logged can hold it.
import { RequestError } from '../../errors'
import type { Exchange } from '../../link/link'
import type { ClientProtocol } from '../../melsec/client-protocol'
import { commands } from '../../melsec/commands/commands'
import { passwordProblem } from '../../melsec/remote-password'

type Protocol = Pick<ClientProtocol, 'profile' | 'exchange'>

export class RemotePassword {
  readonly #protocol: Protocol
  #password: string | undefined

  /** @throws RequestError BAD_OPTION */
  constructor(protocol: Protocol, password: string | undefined) {
    this.#protocol = protocol
    this.set(password)
  }

  /** `undefined`: the PLC has none. @throws RequestError BAD_OPTION; the one before stays then */
  set(password: string | undefined): void {
    const problem = password === undefined ? undefined : passwordProblem(this.#protocol.profile, password)
    if (problem !== undefined) throw new RequestError('BAD_OPTION', `password: ${problem}.`, 'password')
    this.#password = password
  }

  /** What opens a connection; undefined without a password. */
  unlock(): Exchange<unknown> | undefined {
    const password = this.#password
    return password === undefined ? undefined : this.#protocol.exchange(commands.unlock, { password })
  }

  lock(): Exchange<unknown> | undefined {
    const password = this.#password
    return password === undefined ? undefined : this.#protocol.exchange(commands.lock, { password })
  }
}
