// The secret function of a simulated JW (COM FB, FC, FD). The manual prints the commands and the result codes, not how they go
// together: a password is registered for the time being, then for good, and guards the function that is enabled by it.
import { Refusal } from '../refusal'
import { result } from './result'

export class Secret {
  #password: string | undefined
  #provisional: string | undefined
  #enabled = false

  constructor(password: string | undefined) {
    this.#password = password
    this.#enabled = password !== undefined
  }

  /** Enabled, and not released. */
  get enabled(): boolean {
    return this.#enabled
  }

  get hasPassword(): boolean {
    return this.#password !== undefined
  }

  /** @throws Refusal */
  enable(): void {
    this.#registered()
    this.#enabled = true
  }

  /** @throws Refusal */
  erase(): void {
    this.#registered()
    this.#mustBeReleased()
    this.#password = undefined
    this.#provisional = undefined
  }

  /** @throws Refusal */
  release(password: string): void {
    if (password !== this.#registered()) throw new Refusal(result.wrongPassword, 'it is another password')
    this.#enabled = false
  }

  /** For the time being: registering it for good takes the same one again. @throws Refusal */
  propose(password: string): void {
    this.#mustBeReleased()
    this.#provisional = password
  }

  /** @throws Refusal */
  register(password: string): void {
    this.#mustBeReleased()
    if (this.#provisional === undefined) throw new Refusal(result.noPassword, 'none was registered for the time being')
    if (password !== this.#provisional)
      throw new Refusal(result.wrongPassword, 'it is not the one that was registered for the time being')
    this.#password = password
    this.#provisional = undefined
  }

  #registered(): string {
    if (this.#password === undefined) throw new Refusal(result.noPassword, 'no password is registered')
    return this.#password
  }

  #mustBeReleased(): void {
    if (this.#enabled) throw new Refusal(result.notReleased, 'the secret function is not released')
  }
}
