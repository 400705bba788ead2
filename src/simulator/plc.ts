// The PLC behind the wire: what it answers to a request, without frames, connections or time.
import type { Message } from '../codec/codec'
import type { CommandName } from '../melsec/commands/commands'
import type { DeviceAddress } from '../melsec/device/device'
import type { Route } from '../melsec/frame/route'
import type { Profile } from '../melsec/profiles/profile'
import type { ReceivedRequest, SlmpCommandSet } from '../melsec/protocol'
import { ExtendUnits, OwnBuffer } from './buffer-memory'
import { checkRequest, routeRefusal } from './check'
import { Cpu, type StateChange } from './cpu'
import { ErrorLog } from './error-log'
import { type FilesParts, SimulatedFiles } from './files'
import type { Caller, Handler, HandlerCall } from './handler'
import { handlers } from './handlers'
import { DeviceMemory } from './memory'
import type { SimulatorSettings } from './options'
import { TypedMemory } from './program-memory'
import { Refusal } from './refusal'
import { type Ports, type Received, slmpOf } from './request'

/** The answer to a request: response data, an end code, or nothing at all. */
export type Answer =
  | { readonly kind: 'data'; readonly body: Buffer }
  | { readonly kind: 'refused'; readonly endCode: number; readonly message: string; readonly abnormal?: number }
  | { readonly kind: 'none' }

/** What is asked of a station of a serial line: in the SLMP set, or in 1C, whose limits and devices were checked where it was read. */
export type LineAsked = { readonly request: ReceivedRequest } & (
  | { readonly protocol: SlmpCommandSet; readonly respond?: undefined }
  | { readonly protocol?: undefined; readonly respond: (response: Message) => Buffer }
)

/** Commands that a port takes while the remote password locks it. */
const FREE: readonly CommandName[] = ['unlock', 'lock']

type PlcSettings =
  | 'profile'
  | 'model'
  | 'latch'
  | 'extensions'
  | 'bufferMemory'
  | 'labels'
  | 'drives'
  | 'maxOpenFiles'
  | 'fileLocks'
  | 'resetAllowed'
  | 'otherStations'

export interface PlcParts extends Pick<SimulatorSettings, PlcSettings> {
  /** Clock of the PLC, as files have it. */
  readonly now: FilesParts['now']
  readonly changed: (change: StateChange) => void
  /** Devices were set to 0 by remote control. */
  readonly cleared: (scope: 'unlatched' | 'all') => void
  readonly restart: () => void
}

export class Plc {
  readonly profile: Profile
  readonly memory: TypedMemory
  readonly cpu: Cpu
  readonly errors = new ErrorLog()
  readonly files: SimulatedFiles
  readonly #otherStations: PlcParts['otherStations']
  readonly #devices: DeviceMemory
  readonly #call: Omit<HandlerCall, 'caller'>

  constructor(parts: PlcParts) {
    this.#otherStations = parts.otherStations
    this.profile = parts.profile
    this.#devices = new DeviceMemory(parts.profile, parts.latch, parts.extensions)
    this.memory = new TypedMemory(this.#devices, parts.profile)
    this.cpu = new Cpu({
      profile: parts.profile,
      resetAllowed: parts.resetAllowed,
      changed: (change) => {
        this.#refreshSystemDevices()
        parts.changed(change)
      },
      clear: (scope) => {
        this.#devices.clear(scope)
        parts.cleared(scope)
      },
    })
    this.files = new SimulatedFiles({ ...parts, cpu: () => this.cpu.state })
    const { profile, cpu, errors, files } = this
    const { labels, model, restart } = parts
    const buffer = new OwnBuffer(profile, parts.bufferMemory)
    const extendUnits = new ExtendUnits(profile, parts.extensions)
    this.#call = { profile, cpu, errors, memory: this.#devices, buffer, extendUnits, labels, files, model, restart }
    this.#refreshSystemDevices()
  }

  /** What the handlers get for requests of this caller. */
  callOf(caller: Caller): HandlerCall {
    return { ...this.#call, caller }
  }

  /** Carries a request out. */
  answer(ports: Ports, received: Received, call: HandlerCall): Answer {
    const { head } = received.frame
    try {
      if (head.frame === '1E') return this.#answer1e(received, call)
      return this.#answer(slmpOf(ports, head.frame), head.head, received, call)
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      const { endCode, message, abnormal } = head.frame === '1E' ? ports.aCompatible.refusalOf(error) : error
      return { kind: 'refused', endCode, message, ...(abnormal === undefined ? {} : { abnormal }) }
    }
  }

  #answer(protocol: SlmpCommandSet, route: Route, { request }: Received, call: HandlerCall): Answer {
    const wrongRoute = routeRefusal(this.profile, route)
    if (wrongRoute !== undefined) {
      if (this.#otherStations === 'silence') return { kind: 'none' }
      throw wrongRoute
    }
    call.caller.lock.enter(!(request instanceof Refusal) && FREE.includes(request.name))
    if (request instanceof Refusal) throw request
    checkRequest(this.profile, protocol.code, request)
    // What clients write to the system's devices does not stay there.
    this.#refreshSystemDevices()
    return this.#carryOut(protocol, request, call)
  }

  /** Limits and devices were checked where the request was read: 1E has its own. */
  #answer1e({ request, respond }: Received, call: HandlerCall): Answer {
    // 1E cannot unlock: it works where another frame has unlocked the connection.
    call.caller.lock.enter(false)
    if (request instanceof Refusal) throw request
    if (respond === undefined) throw new TypeError('a 1E request without a way to answer')
    this.#refreshSystemDevices()
    return { kind: 'data', body: respond(handle(request, call)) }
  }

  /** Carries a request of a serial line out: the line has looked at its route. @throws Refusal */
  answerOnLine({ request, protocol, respond }: LineAsked, call: HandlerCall): Answer {
    if (protocol !== undefined) checkRequest(this.profile, protocol.code, request)
    this.#refreshSystemDevices()
    if (protocol !== undefined) return this.#carryOut(protocol, request, call)
    return { kind: 'data', body: respond(handle(request, call)) }
  }

  /** Sets a bit device, as the system of the CPU does. */
  setRelay(relay: DeviceAddress, on: boolean): void {
    this.#devices.writeBits(relay, [on])
  }

  /** The same of a word device. */
  setRegister(register: DeviceAddress, word: number): void {
    this.#devices.writeWords(register, [word])
  }

  /** Power goes off: everything that is not latched is lost. */
  down(): void {
    this.cpu.down()
    this.#devices.clear('unlatched')
    this.#call.buffer.clear()
    this.files.down()
    this.errors.clear()
  }

  up(): void {
    this.cpu.up()
  }

  #carryOut(protocol: SlmpCommandSet, request: ReceivedRequest, call: HandlerCall): Answer {
    const { command } = request
    const response = handle(request, call)
    if (command.answered === 'no') return { kind: 'none' }
    const context = command.context === undefined ? request.message : (call.caller.monitored ?? {})
    return { kind: 'data', body: protocol.writeResponse(request, response, context) }
  }

  /** SD203: state of the CPU. SM400 and SM401: always on, always off. */
  #refreshSystemDevices(): void {
    this.#devices.writeWords({ device: 'SD', number: 203 }, [this.cpu.statusWord])
    this.#devices.writeBits({ device: 'SM', number: 400 }, [true, false])
  }
}

function handle({ name, message, subcommand }: ReceivedRequest, call: HandlerCall) {
  return handleAs(name, message, call, subcommand)
}

function handleAs<N extends CommandName>(
  name: N,
  message: ReceivedRequest['message'],
  call: HandlerCall,
  subcommand: number,
) {
  const handler: Handler<N> = handlers[name]
  // The message was decoded by this command's declaration, from which its type is inferred.
  return handler(message as Parameters<Handler<N>>[0], call, subcommand)
}
