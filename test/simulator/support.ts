/** A client's session joined to a simulated PLC in memory, with time made of numbers. */

import { encode, type MessageInput, writerOf } from '../../src/codec/codec'
import { EndCodeError } from '../../src/errors'
import type { Job } from '../../src/link/link'
import { Session } from '../../src/link/link'
import type { Command, RequestOf, ResponseOf } from '../../src/melsec/commands/command'
import type { DeviceForm } from '../../src/melsec/device/device-form'
import { FORM_BITS } from '../../src/melsec/device/form'
import type { SlmpFrameName } from '../../src/melsec/frame/frames'
import { completeRoute, type Route } from '../../src/melsec/frame/route'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { anyFiles } from '../../src/melsec/profiles/files'
import type { Profile } from '../../src/melsec/profiles/profile'
import { profiles, resolveProfile } from '../../src/melsec/profiles/profiles'
import { type ExchangeOptions, MelsecProtocol } from '../../src/melsec/protocol'
import type { ConnectOptions } from '../../src/simulator/listening'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/simulator/server'
import { type ManualClock, manualClock } from '../support/manual-clock'
import { questionOf } from '../support/question'

const ALL_FORMS: readonly DeviceForm[] = ['short', 'long', 'extendedShort', 'extendedLong']

/** The profile without anything the client would refuse by itself. */
export function lenient(profile: Profile): Profile {
  return {
    ...profile,
    limits: [],
    lacks: [],
    exclusions: [],
    absentDevices: [],
    lastIndex: profiles['iq-r'].lastIndex,
    files: profile.files.drives.length === 0 ? anyFiles : profile.files,
    forms: ALL_FORMS,
    extensions: ['link', 'module', 'cpu'],
  }
}

/** Frames of the SLMP set. */
export type SlmpFrame = SlmpFrameName

export interface AskerOptions {
  readonly frame?: SlmpFrame
  readonly code?: 'binary' | 'ascii'
  readonly route?: Partial<Route>
  readonly connect?: ConnectOptions
}

/** Asks one request at a time over one connection; everything happens before `ask` returns. */
export class Asker {
  readonly protocol: MelsecProtocol<SlmpHead>
  readonly received: Buffer[] = []
  closed = false
  readonly #head: SlmpHead
  readonly #session: Session
  readonly #send: (bytes: Uint8Array) => void
  readonly close: () => void

  constructor(plc: PlcSimulator, options: AskerOptions = {}) {
    const { frame = plc.profile.frame === '4E' ? '4E' : '3E', code = 'binary', route, connect = {} } = options
    const kind = connect.kind ?? 'stream'
    const framing = slmpFraming(frame, code)
    this.#head = { ...completeRoute(route), timer: 0 }
    this.protocol = new MelsecProtocol({
      framing,
      head: this.#head,
      profile: lenient(resolveProfile(plc.profile)),
      code,
      asciiXy: plc.profile.xyRadix === 8 ? 'octal' : undefined,
      asciiZr: 'decimal',
    })
    this.#session = new Session(framing, { kind, window: 1 })
    const transport = plc.connect({ delivery: 'synchronous', ...connect })()
    transport.open({
      opened: () => {},
      received: (bytes) => {
        this.received.push(bytes)
        this.#session.receive(bytes, 0)
      },
      closed: () => {
        this.closed = true
        this.#session.disconnected()
      },
    })
    this.#send = (bytes) => transport.send(bytes)
    this.close = () => transport.close()
  }

  /** The answer; throws what the client would throw; undefined when there is none. */
  ask<C extends Command>(command: C, message: RequestOf<C>, options?: ExchangeOptions): ResponseOf<C> | undefined {
    const exchange = this.protocol.exchange(command, message, options)
    const frame = this.#exchange(exchange.body)
    return frame === undefined ? undefined : exchange.decode(frame)
  }

  /** As `ask`, for the end code: 0 when it went well. */
  endCode<C extends Command>(command: C, message: RequestOf<C>, options?: ExchangeOptions): number | undefined {
    try {
      return this.ask(command, message, options) === undefined ? undefined : 0
    } catch (error) {
      if (error instanceof EndCodeError) return error.endCode
      throw error
    }
  }

  /** End code of the answer to any body. */
  rawEndCode(body: Buffer): number | undefined {
    return this.#exchange(body)?.endCode
  }

  /** Bytes as they are. */
  send(bytes: Uint8Array): void {
    this.#send(bytes)
  }

  #exchange(body: Buffer) {
    const session = this.#session
    const job: Job = { ...questionOf(this.protocol.framing, this.#head, body), deadline: 1 }
    session.submit(job, 0)
    for (let bytes = session.transmit(); bytes !== undefined; bytes = session.transmit()) this.#send(bytes)
    let frame: { readonly endCode: number; readonly body: Buffer } | undefined
    const take = () => {
      for (let event = session.poll(); event !== undefined; event = session.poll()) {
        if (event.kind !== 'done' || event.job !== job) continue
        if (event.outcome.kind === 'answered') frame = event.outcome.frame
        if (event.outcome.kind === 'failed') throw event.outcome.error
      }
    }
    take()
    if (frame === undefined) {
      session.timeout(1)
      take()
      return undefined
    }
    return { head: this.#head, serial: undefined, ...frame }
  }
}

/** A body with any subcommand, past every check of the client. */
export function rawBody<C extends Command>(
  command: C,
  subcommand: number,
  form: DeviceForm,
  message: MessageInput<C['request']>,
  code: 'binary' | 'ascii' = 'binary',
): Buffer {
  const writer = writerOf(code, FORM_BITS[form])
  writer.uint(command.code, 2)
  writer.uint(subcommand, 2)
  encode<C['request']>(command.request, message, writer)
  return writer.take()
}

export interface Joined {
  readonly plc: PlcSimulator
  readonly clock: ManualClock
  readonly asker: Asker
  /** Another connection. */
  connect(options?: AskerOptions): Asker
}

export function join(options: PlcSimulatorOptions = {}, asking: AskerOptions = {}): Joined {
  const clock = manualClock()
  const plc = createPlcSimulator({ clock, ...options })
  const code = options.code ?? 'binary'
  const connect = (more: AskerOptions = {}) => new Asker(plc, { code, ...more })
  return { plc, clock, asker: connect(asking), connect }
}
