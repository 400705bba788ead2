// The simulated JW behind the wire: what it answers to a message, without headers, connections or time on the way.
import type { Message } from '../../codec/codec'
import { PlcError } from '../../errors'
import { checkSendable } from '../../jw/check'
import { type JwCommand, jwCommands } from '../../jw/commands/commands'
import type { JwHead } from '../../jw/frame'
import { jwProtocol } from '../../jw/protocol'
import type { HeadProtocol, RequestFrame } from '../../link/link'
import { Refusal } from '../refusal'
import { DEFINITION, DIRECTION, RingBuffers, SpecifiedBuffers } from './buffers'
import { PlcClock } from './clock'
import { JwCpu, type JwStateChange } from './cpu'
import { Files } from './files'
import type { JwParts } from './handler'
import { conditions, jwHandlers } from './handlers'
import { type JwSettings, numbered } from './options'
import { result } from './result'
import { Secret } from './secret'
import { Timers } from './timers'
import { OptionUnits, SpecialIo } from './units'

const SYSTEM_MEMORY = 0x480

/** A request as it was understood. */
export interface JwReceived {
  readonly command: JwCommand
  readonly message: Message
}

export class JwPlc {
  readonly cpu: JwCpu
  readonly parts: JwParts
  readonly #settings: JwSettings
  readonly #protocol: HeadProtocol<JwHead>

  constructor(settings: JwSettings, changed: (change: JwStateChange) => void) {
    const { model, marker, clock } = settings
    const files = new Files(settings.files)
    this.#settings = settings
    this.#protocol = jwProtocol({ model, marker })
    this.cpu = new JwCpu(settings, changed)
    this.parts = {
      files,
      systemMemory: { 8: Buffer.alloc(SYSTEM_MEMORY), 9: Buffer.alloc(SYSTEM_MEMORY) },
      timers: new Timers(settings.timers, files, settings),
      clock: new PlcClock(() => clock.time()),
      secret: new Secret(settings.password),
      specifiedBuffers: new SpecifiedBuffers(files),
      ringBuffers: new RingBuffers(files),
      optionUnits: new OptionUnits(settings.optionUnits, settings.startSwitchRefusal),
      specialIo: new SpecialIo(),
      cpu: this.cpu,
    }
    this.#defineBuffers()
  }

  /** Where the text of a message ends; `undefined` while more of it must come. What cannot be read ends with what has arrived. */
  lengthOf(head: JwHead, soFar: Buffer): number | undefined {
    try {
      return this.#protocol.requestLength(head, soFar)
    } catch (error) {
      if (error instanceof PlcError) return soFar.length
      throw error
    }
  }

  /** What a message asks for, or why nobody can tell. */
  receive(frame: RequestFrame<JwHead>): JwReceived | Refusal {
    try {
      const { command, message } = this.#protocol.readRequest(frame)
      const known = commandNamed(command.name)
      if (known !== undefined) return { command: known, message }
      return new Refusal(result.format, `there is no command ${command.name}`)
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return new Refusal(formatCode(frame, error), error.message)
    }
  }

  /** The text of the answer. */
  answer({ command, message }: JwReceived): Buffer | Refusal {
    try {
      this.#check(command, message)
      // The message was read by the declaration of this command.
      const handle = jwHandlers[command.name] as (message: Message, parts: JwParts) => Message
      return this.#protocol.writeResponse(command, message, handle(message, this.parts))
    } catch (error) {
      if (error instanceof Refusal) return error
      throw error
    }
  }

  #check(command: JwCommand, message: Message): void {
    const { mode = 0, stopped, clock } = conditions[command.name] ?? {}
    this.#checkSendable(command, message)
    if (clock === true && !this.#settings.hasClock) throw new Refusal(result.noClock, 'there is no clock')
    if (this.cpu.writeMode < mode) {
      throw new Refusal(result.writeMode, `it takes write mode ${mode}, and this is ${this.cpu.writeMode}`)
    }
    if (stopped === true && this.cpu.running) throw new Refusal(result.notStopped, 'the PLC runs')
  }

  /** What a client does not send: commands and addresses that the model lacks, and what ends behind its area. */
  #checkSendable(command: JwCommand, message: Message): void {
    try {
      checkSendable(command, message, this.#settings.model)
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      throw new Refusal(error.code === 'OUT_OF_RANGE' ? result.capacity : result.format, error.message)
    }
  }

  #defineBuffers(): void {
    const { specifiedBuffers, ringBuffers } = this.#settings
    for (const [number, { definition = 'indirect', ...place }] of numbered(
      'specifiedBuffers',
      specifiedBuffers,
      0x1f,
    )) {
      this.parts.specifiedBuffers.define(number, { ...place, definition: DEFINITION[definition] })
    }
    for (const [number, { definition = 'indirect', direction = 'read', ...place }] of numbered(
      'ringBuffers',
      ringBuffers,
      0x0f,
    )) {
      const pointers = { writePointer: 0, readPointer: 0, direction: DIRECTION[direction] }
      this.parts.ringBuffers.define(number, { ...place, ...pointers, definition: DEFINITION[definition] })
    }
  }
}

function commandNamed(name: string): JwCommand | undefined {
  return Object.values(jwCommands).find((command) => command.name === name)
}

/** A password of other characters has a code of its own. */
function formatCode({ head }: RequestFrame<JwHead>, error: PlcError): number {
  const isPassword = 'field' in error && error.field === 'password'
  return isPassword && head.command === jwCommands.secretPassword.code && error.code === 'BAD_FIELD'
    ? result.badPassword
    : result.format
}
