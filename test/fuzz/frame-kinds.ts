/** Every frame there is, with the protocol that speaks it, in the terms of the fuzz. */

import type { DataCode } from '../../src/codec/codec'
import { RequestError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { type ExplainJwOptions, explainJwFrame } from '../../src/jw/explain-frame'
import { type JwProtocolOptions, jwProtocol } from '../../src/jw/protocol'
import type { Framing, Head, HeadProtocol, RequestFrame } from '../../src/link/link'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { aCompatibleProtocol } from '../../src/melsec/a-compatible/protocol'
import { explainFrame } from '../../src/melsec/explain/frame'
import type { ExplainFrameOptions } from '../../src/melsec/explain/options'
import { type EthernetFrameName, isEthernetFrame, type SlmpFrameName } from '../../src/melsec/frame/frames'
import { ownStation } from '../../src/melsec/frame/route'
import { serialRoute } from '../../src/melsec/frame/serial-frames'
import { type SerialFrameOptions, serialFraming } from '../../src/melsec/frame/serial-framing'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { oneCCommands } from '../../src/melsec/one-c/commands'
import { oneCProtocol } from '../../src/melsec/one-c/protocol'
import type { ProfileId } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { lenient } from '../simulator/support'
import { type Sample, samplesOf, samplesOfHead } from './corpus'

const CODES: readonly DataCode[] = ['binary', 'ascii']

/** A frame with everything that reads it. */
export interface Spoken<H extends Head> {
  readonly framing: Framing<H>
  readonly samples: readonly Sample[]
  readonly code: DataCode
  /** The PLC's side: where a request ends, for frames that do not say it, and what it is. */
  readonly requestLength: (head: H, soFar: Buffer) => number | undefined
  readonly readRequest: (frame: RequestFrame<H>) => unknown
  /** In words; `request` is the one that is answered. */
  readonly explain: (bytes: Buffer, request: Buffer | undefined) => unknown
  /** Where the frame has no room for others. */
  readonly endCodes?: readonly number[]
  /** Simulated PLCs that take it. */
  readonly plc?: { readonly profile: ProfileId; readonly frames: readonly EthernetFrameName[] }
}

/** Hides the type of the head: each kind has its own. */
export interface FrameKind {
  readonly name: string
  use<T>(run: <H extends Head>(spoken: Spoken<H>) => T): T
}

function kind<H extends Head>(name: string, make: () => Spoken<H>): FrameKind {
  return { name, use: (run) => run(make()) }
}

function slmp(frame: SlmpFrameName, code: DataCode): FrameKind {
  return kind(`${frame} ${code}`, () => {
    const protocol = new MelsecProtocol({
      framing: slmpFraming(frame, code),
      head: { ...ownStation, timer: 0 },
      profile: lenient(profiles['iq-r']),
      code,
      asciiZr: 'decimal',
    })
    return {
      framing: protocol.framing,
      samples: samplesOf(protocol),
      code,
      requestLength: () => undefined,
      readRequest: (received) => protocol.readRequest(received),
      explain: explaining({ profile: 'iq-r' }),
      plc: { profile: 'iq-r', frames: [frame] },
    }
  })
}

function explaining(options: ExplainFrameOptions): Spoken<Head>['explain'] {
  return (bytes, request) => explainFrame(bytes, { ...options, ...(request === undefined ? {} : { request }) })
}

function serialName({ frame, format, sumCheck }: SerialFrameOptions): string {
  return `${frame} format ${format}${sumCheck === false ? ' without sum check' : ''}`
}

function serial(options: SerialFrameOptions): FrameKind {
  return kind(serialName(options), () => {
    const framing = serialFraming(options)
    const { code } = framing
    const protocol = new MelsecProtocol({
      framing,
      head: serialRoute(options.frame),
      profile: lenient(profiles.q),
      code,
      asciiZr: 'decimal',
    })
    return {
      framing,
      samples: samplesOf(protocol),
      code,
      requestLength: (_head, soFar) => (options.format === 1 ? protocol.requestLength(soFar) : undefined),
      readRequest: (received) => protocol.readRequest(received),
      explain: explaining({ ...options, profile: 'q' }),
    }
  })
}

function aCompatible(code: DataCode, family: 'iq-f' | 'fx3'): FrameKind {
  return kind(`1E ${code} ${family}`, () => {
    const { aCompatible: facts } = profiles[family]
    if (facts === undefined) throw new Error(`${family} takes no 1E frame`)
    const protocol = aCompatibleProtocol({ code, family: facts, asciiXy: 'octal', oddBits: 'padded' })
    return headed(protocol, aCompatibleCommands, code, {
      explain: explaining({ frame: '1E', code, profile: family }),
      plc: { profile: family, frames: ['1E'] },
    })
  })
}

function oneC(format: 1 | 4, sumCheck: boolean): FrameKind {
  const options = { frame: '1C', format, sumCheck } as const
  return kind(serialName(options), () => {
    const framing = serialFraming(options)
    const protocol = oneCProtocol({ framing, head: { station: 0, pc: 0xff }, asciiXy: 'octal' })
    return headed(protocol, oneCCommands, 'ascii', {
      endCodes: [1, 0x5b, 0x10, 0xff],
      explain: explaining({ ...options, profile: 'iq-f', asciiXy: 'octal' }),
    })
  })
}

function jw(name: string, options: JwProtocolOptions): FrameKind {
  return kind(`JW, ${name}`, () => {
    const { marker = 'once' } = options
    const explain = (bytes: Buffer, request: Buffer | undefined) => {
      const known: ExplainJwOptions = request === undefined ? { marker } : { marker, request }
      return explainJwFrame(bytes, known)
    }
    return headed(jwProtocol(options), jwCommands, 'binary', { explain })
  })
}

function headed<H extends Head>(
  protocol: HeadProtocol<H>,
  list: Parameters<typeof samplesOfHead>[1],
  code: DataCode,
  rest: Pick<Spoken<H>, 'explain' | 'plc' | 'endCodes'>,
): Spoken<H> {
  return {
    framing: protocol.framing,
    samples: samplesOfHead(protocol, list, code),
    code,
    requestLength: (head, soFar) => protocol.requestLength(head, soFar),
    readRequest: (received) => protocol.readRequest(received),
    ...rest,
  }
}

/** Every frame that a family speaks, so that a new one is here without being written down. */
const names: readonly EthernetFrameName[] = [
  ...new Set(Object.values(profiles).flatMap(({ frames }) => frames.filter(isEthernetFrame))),
]

function kindsOf(name: EthernetFrameName): FrameKind[] {
  if (name !== '1E') return CODES.filter((code) => exists(name, code)).map((code) => slmp(name, code))
  return CODES.flatMap((code) => (['iq-f', 'fx3'] as const).map((family) => aCompatible(code, family)))
}

/** Not every frame has both codes. */
function exists(name: SlmpFrameName, code: DataCode): boolean {
  try {
    return slmpFraming(name, code) !== undefined
  } catch (error) {
    if (error instanceof RequestError) return false
    throw error
  }
}

export const frameKinds: readonly FrameKind[] = [
  ...names.flatMap(kindsOf),
  serial({ frame: '3C', format: 1 }),
  serial({ frame: '3C', format: 4, sumCheck: false }),
  serial({ frame: '4C', format: 1, sumCheck: false }),
  serial({ frame: '4C', format: 4 }),
  serial({ frame: '4C', format: 5 }),
  serial({ frame: '4C', format: 5, sumCheck: false }),
  ...([1, 4] as const).flatMap((format) => [oneC(format, true), oneC(format, false)]),
  jw('no header', {}),
  jw('40 bytes 00', { header: 'zero40', marker: 'each' }),
  jw('relay, JW30H', { header: { pda: 1, psa: 2, slot: 3, station: 4 }, model: 'jw30h' }),
]
