/**
 * A small PLC for the tests of the connection: D0 to D9999 with D[n] = n, Read, Write, Read Type Name and Remote Reset.
 * What it does with a request is a script, so that it can be late, silent, wrong or gone.
 */

import { proofs } from '../../src/client/melsec/control'
import type { RequestFrame } from '../../src/link/link'
import { Responder } from '../../src/link/link'
import { commands } from '../../src/melsec/commands/commands'
import { ownStation, type Route } from '../../src/melsec/frame/route'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import type { ServerConnection } from '../../src/transport/transport'

export type Frame = '3E' | '4E' | 'ext'

/** A request as the script sees it. */
export interface Asked {
  /** e.g. `readWords`, `readTypeName` (the probe), `writeWords` */
  readonly name: string
  /** First device of a read or write. */
  readonly device: number
  readonly frame: RequestFrame<SlmpHead>
  readonly peer: ServerConnection
  /** The right answer; a write is carried out when it is called. */
  answer(): Buffer
  refuse(endCode: number): Buffer
  /** Sends the right answer. */
  reply(): void
}

export type Script = (asked: Asked) => void

export const replying: Script = (asked) => asked.reply()
export const silent: Script = () => {}

export function protocolOf(
  frame: Frame,
  code: 'binary' | 'ascii' = 'binary',
  route = ownStation,
): MelsecProtocol<SlmpHead> {
  const head = { ...route, timer: 0 }
  return new MelsecProtocol({ framing: slmpFraming(frame, code), head, profile: resolveProfile('iq-r'), code })
}

export class ScriptedPlc {
  readonly words = Uint16Array.from({ length: 10_000 }, (_, i) => i)
  /** Names of the requests that arrived, with the device: `readWords 100`. The probe is left out. */
  readonly asked: string[] = []
  readonly peers: ServerConnection[] = []
  /** Connections that are open at the moment. */
  open = 0
  probes = 0
  /** What it does with a request; the probe is answered unless `probe` says otherwise. */
  script: Script = replying
  probe: Script = replying
  /** What it does with the self tests that prove a fixed port. */
  proof: Script = replying
  proofs = 0
  /** What it does with a connection, before anything is received. */
  onConnection: (peer: ServerConnection) => void = () => {}
  readonly #protocol: MelsecProtocol<SlmpHead>

  constructor(
    frame: Frame,
    private readonly kind: 'stream' | 'datagram',
    code: 'binary' | 'ascii' = 'binary',
  ) {
    this.#protocol = protocolOf(frame, code)
  }

  readonly accept = (peer: ServerConnection): void => {
    const responder = new Responder(this.#protocol.framing, this.kind, () => undefined)
    this.peers.push(peer)
    this.open += 1
    peer.onClosed = () => {
      this.open -= 1
    }
    peer.onReceived = (bytes) => {
      for (const frame of responder.receive(bytes)) this.#received(responder, frame, peer)
    }
    this.onConnection(peer)
  }

  #received(responder: Responder<SlmpHead>, frame: RequestFrame<SlmpHead>, peer: ServerConnection): void {
    const request = this.#protocol.readRequest(frame)
    if ('unknown' in request) throw new Error('the PLC was asked something it does not know')
    const message = request.message as { head?: { number: number }; points: number; values: number[]; data: string }
    const device = message.head?.number ?? -1
    const answer = () => {
      if (request.name === 'writeWords') this.words.set(message.values, device)
      return responder.answer(
        frame,
        0,
        this.#protocol.writeResponse(request, this.#response(request.name, device, message.points, message.data)),
      )
    }
    const asked: Asked = {
      name: request.name,
      device,
      frame,
      peer,
      answer,
      refuse: (endCode) => responder.answer(frame, endCode, Buffer.alloc(0)),
      reply: () => peer.send(answer()),
    }
    if (request.name === 'readTypeName') {
      this.probes += 1
      this.probe(asked)
      return
    }
    if (request.name === 'selfTest') {
      this.proofs += 1
      this.proof(asked)
      return
    }
    this.asked.push(device < 0 ? request.name : `${request.name} ${device}`)
    this.script(asked)
  }

  #response(name: string, device: number, points: number, data: string): Record<string, unknown> {
    if (name === 'readTypeName') return { model: 'R04CPU'.padEnd(16), modelCode: 0x4800 }
    if (name === 'selfTest') return { data }
    return name === 'readWords' ? { values: [...this.words.subarray(device, device + points)] } : {}
  }
}

const protocols = { '3E': protocolOf('3E'), '4E': protocolOf('4E'), ext: protocolOf('ext') }

/** Requests ready to be sent. `route`: to another station than the connected one. */
export function exchanges(frame: Frame, route?: Route) {
  const protocol = route === undefined ? protocols[frame] : protocolOf(frame, 'binary', route)
  const head = (number: number) => ({ device: 'D', number }) as const
  return {
    probe: () => protocol.exchange(commands.readTypeName, {}),
    proof: proofs(protocol, () => 0.5),
    read: (number: number, points = 1) => protocol.exchange(commands.readWords, { head: head(number), points }),
    write: (number: number, ...values: number[]) =>
      protocol.exchange(commands.writeWords, { head: head(number), values }),
    reset: () => protocol.exchange(commands.remoteReset, {}),
  }
}
