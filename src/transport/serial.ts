/** A serial port of this computer. The package `serialport` is loaded when one is opened, and not before. */
import type { SerialPort } from 'serialport'
import { ConnectionError, RequestError } from '../errors'
import { notOpen, notRenewable } from './failure'
import { loadSerialPort } from './serial-package'
import type { OpenTransport, Transport, TransportHandlers } from './transport'

/** What the serial port of an FX5 takes (FX5 communication manual 34.1); whoever speaks to others may need no more. */
export const baudRates = [300, 600, 1200, 2400, 4800, 9600, 19_200, 38_400, 57_600, 115_200] as const
/** Bits per second. */
export type BaudRate = (typeof baudRates)[number]

const DATA_LENGTHS = [7, 8] as const
const PARITIES = ['none', 'odd', 'even'] as const
const STOP_BITS = [1, 2] as const
const RTS = ['on', 'off', 'sending'] as const

/** As in the parameters of the PLC's port; the defaults are those of an FX5. */
export interface SerialOptions {
  /** `COM3`, `/dev/ttyUSB0`. */
  readonly path: string
  /** Bits per second; 9600. */
  readonly baudRate?: BaudRate
  /** Bits of a character; 7. Format 5 needs 8. */
  readonly dataLength?: (typeof DATA_LENGTHS)[number]
  /** Default `odd`. */
  readonly parity?: (typeof PARITIES)[number]
  /** Default 1. */
  readonly stopBits?: (typeof STOP_BITS)[number]
  /** Request to send: `on` (default), `off`, or on only while `sending`, for converters to RS-485 that are switched by it. */
  readonly rts?: (typeof RTS)[number]
}

/** Everything that is left out filled in. */
export type SerialSettings = Required<SerialOptions>

/** @throws RequestError BAD_OPTION naming the field */
export function serialSettings(options: SerialOptions): SerialSettings {
  const { path, baudRate = 9600, dataLength = 7, parity = 'odd', stopBits = 1, rts = 'on' } = options
  if (typeof path !== 'string' || path.trim() === '') {
    throw new RequestError(
      'BAD_OPTION',
      'path is empty: give the name of the serial port, e.g. COM3 or /dev/ttyUSB0',
      'path',
    )
  }
  check('baudRate', baudRate, baudRates)
  check('dataLength', dataLength, DATA_LENGTHS)
  check('parity', parity, PARITIES)
  check('stopBits', stopBits, STOP_BITS)
  check('rts', rts, RTS)
  return { path, baudRate, dataLength, parity, stopBits, rts }
}

function check(field: keyof SerialOptions, value: unknown, values: readonly unknown[]): void {
  if (values.includes(value)) return
  throw new RequestError('BAD_OPTION', `${field} ${String(value)}: give ${values.join(', ')}`, field)
}

/** ms that so many bytes take on the line: a start bit, the data, parity and stop bits each. */
export function lineTime(bytes: number, { baudRate, dataLength, parity, stopBits }: SerialSettings): number {
  const bits = 1 + dataLength + (parity === 'none' ? 0 : 1) + stopBits
  return (bytes * bits * 1000) / baudRate
}

/**
 * Opens a serial port again and again, one transport after another.
 * @throws RequestError BAD_OPTION
 * @example const open = serialTransport({ path: '/dev/ttyUSB0', baudRate: 19_200, dataLength: 8, parity: 'even' })
 */
export function serialTransport(options: SerialOptions): OpenTransport {
  const settings = serialSettings(options)
  return () => new SerialTransport(settings)
}

class SerialTransport implements Transport {
  readonly kind = 'stream'
  readonly renewable = false
  readonly #settings: SerialSettings
  #state: 'new' | 'opening' | 'open' | 'done' = 'new'
  #handlers: TransportHandlers | undefined
  #port: SerialPort | undefined
  #sent = false
  /** With RTS while sending: what is being sent, and what follows. */
  readonly #outgoing: Uint8Array[] = []
  /** The system is opening it. */
  #isTrying = false
  /** Told when a port that was given up meanwhile is closed, or could not be opened. */
  #whenTried = () => {}

  constructor(settings: SerialSettings) {
    this.#settings = settings
  }

  get description(): string {
    const { path, baudRate, dataLength, parity, stopBits } = this.#settings
    return `serial ${path} (${baudRate} ${dataLength}${parity.charAt(0).toUpperCase()}${stopBits})`
  }

  get ready(): boolean {
    return this.#state === 'open'
  }

  open(handlers: TransportHandlers): void {
    if (this.#state !== 'new') throw new Error(`${this.description}: open() was called before, make another transport`)
    this.#state = 'opening'
    this.#handlers = handlers
    void this.#openPort(closing.get(this.#settings.path))
  }

  /** @param before the port is being closed, which takes the system a moment */
  async #openPort(before: Promise<void> | undefined): Promise<void> {
    const Port = await loadSerialPort()
    await before
    if (this.#state !== 'opening') return
    if (Port instanceof ConnectionError) {
      this.#finish(Port)
      return
    }
    const { path, baudRate, dataLength: dataBits, parity, stopBits, rts } = this.#settings
    // Nobody else may send in between: the port is ours alone.
    const port = new Port({ path, baudRate, dataBits, parity, stopBits, lock: true, autoOpen: false })
    this.#port = port
    port.on('data', (bytes: Buffer) => {
      if (this.#state === 'open') this.#handlers?.received(bytes)
    })
    port.on('error', (error) => this.#finish(this.#lost(error)))
    port.on('close', (error: unknown) => this.#finish(this.#lost(error)))
    this.#isTrying = true
    port.open((error) => {
      this.#isTrying = false
      if (this.#state !== 'opening') this.#closeAgain(port)
      else if (error !== null) this.#finish(cannotOpen(this.description, error))
      else if (rts === 'on') this.#opened()
      else port.set({ rts: false }, (failed) => (failed ? this.#finish(this.#lost(failed)) : this.#opened()))
    })
  }

  send(bytes: Uint8Array): void {
    const port = this.#port
    if (this.#state !== 'open' || port === undefined) throw notOpen(this.description)
    this.#sent = true
    if (this.#settings.rts !== 'sending') {
      port.write(bytes)
      return
    }
    this.#outgoing.push(bytes)
    if (this.#outgoing.length === 1) this.#sendNext(port)
  }

  /**
   * One after another, and each step when the one before is done: setting a line takes an adapter longer than passing a
   * character on, so the first ones would be sent before the converter drives the line.
   */
  #sendNext(port: SerialPort): void {
    const [bytes] = this.#outgoing
    if (bytes === undefined) return
    const then = (next: () => void) => (failed: Error | null | undefined) => {
      if (failed) this.#finish(this.#lost(failed))
      else if (this.#state === 'open') next()
    }
    const released = then(() => {
      this.#outgoing.shift()
      this.#sendNext(port)
    })
    const raised = then(() => {
      port.write(bytes)
      // Drained is when the last bit is on the line, as well as the system knows it.
      port.drain(then(() => port.set({ rts: false }, released)))
    })
    port.set({ rts: true }, raised)
  }

  renew(): void {
    throw notRenewable(this.description)
  }

  close(): void {
    if (this.#state === 'done') return
    this.#end()
  }

  #opened(): void {
    if (this.#state !== 'opening') return
    this.#state = 'open'
    this.#handlers?.opened()
  }

  #finish(error: ConnectionError): void {
    if (this.#state === 'done') return
    const handlers = this.#handlers
    this.#end()
    handlers?.closed(error)
  }

  #end(): void {
    this.#state = 'done'
    this.#handlers = undefined
    const port = this.#port
    if (port?.isOpen === true) taken(port, (done) => port.close(done))
    else if (port !== undefined && this.#isTrying) taken(port, (done) => (this.#whenTried = done))
  }

  /** Given up while it was being opened: what is open must be closed all the same. */
  #closeAgain(port: SerialPort): void {
    if (port.isOpen) port.close(() => this.#whenTried())
    else this.#whenTried()
  }

  #lost(cause: unknown): ConnectionError {
    const message = `${this.description}: the port is gone${cause instanceof Error ? ` (${cause.message})` : ''}: was the adapter unplugged?`
    return new ConnectionError('DISCONNECTED', message, this.#sent ? 'unknown' : 'notSent', cause)
  }
}

/** Ports that are closing, by name: until the system is done with it, a port is taken. */
const closing = new Map<string, Promise<void>>()

/** Until `run` calls back, whatever it says then: of being closed already it means nothing. */
function taken({ path }: SerialPort, run: (done: () => void) => void): void {
  const over = new Promise<void>((resolve) => run(() => resolve())).then(() => {
    if (closing.get(path) === over) closing.delete(path)
  })
  closing.set(path, over)
}

function cannotOpen(description: string, cause: Error): ConnectionError {
  return new ConnectionError('PORT_UNAVAILABLE', `${description}: ${whyNot(cause.message)}`, 'notSent', cause)
}

/** The package says it in the system's words. */
function whyNot(message: string): string {
  const said = message.replace(/^Error:? */, '')
  if (/no such file|file not found/i.test(said))
    return `there is no such port (${said}): is the adapter plugged in, and what is its name?`
  if (/permission denied|access denied/i.test(said)) {
    return `it may not be used (${said}): another program has it open, or this user is not in the group dialout`
  }
  if (/cannot lock|busy|temporarily unavailable/i.test(said)) return `another program has it open (${said})`
  return `it cannot be opened (${said})`
}
