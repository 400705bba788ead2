/** A simulated serial line with a host in memory: what is sent and heard as people write it, time made of numbers. */
import {
  type SerialFrameName,
  type SerialHead,
  serialFrameFacts,
  serialRoute,
} from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { createLineSimulator, type LineSimulator, type LineSimulatorOptions } from '../../src/simulator/line'
import { type ManualClock, manualClock } from '../support/manual-clock'
import { controlText } from '../vectors/control-text'

const NAMES: Readonly<Record<number, string>> = {
  2: 'STX',
  3: 'ETX',
  4: 'EOT',
  5: 'ENQ',
  6: 'ACK',
  10: 'LF',
  12: 'CL',
  13: 'CR',
  16: 'DLE',
  21: 'NAK',
}

/** Bytes as people write them. */
export function shown(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) =>
    byte >= 0x20 && byte <= 0x7e ? String.fromCharCode(byte) : `<${NAMES[byte] ?? byte.toString(16).padStart(2, '0')}>`,
  ).join('')
}

/** Longer than the reception time-out and the longest message wait. */
export const LONG = 300

export interface AHost {
  /** Chunks as they came. */
  readonly chunks: Buffer[]
  /** Sends the text or the bytes. */
  send(what: string | Buffer): void
  /** All that has come since it was asked last. */
  heard(): string
  /** As `heard`, in bytes. */
  bytes(): Buffer
  /** Sends a request and gives what has come of it after a while. */
  ask(frame: SerialFrameName, station: number, body: string | Buffer, head?: Partial<SerialHead>): string
  close(): void
}

export interface ALine {
  readonly line: LineSimulator
  readonly clock: ManualClock
  readonly host: AHost
  /** Another host at the line. */
  another(): AHost
  /** A request as it goes out. */
  request(frame: SerialFrameName, station: number, body: string | Buffer, head?: Partial<SerialHead>): Buffer
}

export function aLine(options: LineSimulatorOptions = {}): ALine {
  const clock = manualClock()
  const line = createLineSimulator({ clock, ...options })
  const { messageFormat: format = 1, sumCheck = true } = options
  const request: ALine['request'] = (frame, station, body, head = {}) => {
    const route = station === 0xff ? { station, pc: 0xff } : serialRoute(frame, { station, ...head }, 'c24')
    const bytes = typeof body === 'string' ? Buffer.from(body, 'latin1') : body
    return serialFraming({ frame, format, sumCheck }).request.write(route, 0, bytes)
  }
  const another = () => hostOf(line, clock, request)
  return { line, clock, host: another(), another, request }
}

function hostOf(line: LineSimulator, clock: ManualClock, request: ALine['request']): AHost {
  const chunks: Buffer[] = []
  let read = 0
  const transport = line.connect({ delivery: 'synchronous' })()
  transport.open({ opened() {}, received: (bytes) => void chunks.push(Buffer.from(bytes)), closed() {} })
  const host: AHost = {
    chunks,
    send: (what) => transport.send(typeof what === 'string' ? controlText(what) : what),
    heard: () => shown(host.bytes()),
    bytes() {
      const come = Buffer.concat(chunks.slice(read))
      read = chunks.length
      return come
    },
    ask(frame, station, body, head) {
      host.bytes()
      host.send(request(frame, station, body, head))
      clock.advance(LONG)
      return host.heard()
    },
    close: () => transport.close(),
  }
  return host
}

/** Every frame in every format it has. */
export const frameFormats = (['1C', '3C', '4C'] as const).flatMap((frame) =>
  serialFrameFacts[frame].formats.map((messageFormat) => ({ frame, messageFormat })),
)
