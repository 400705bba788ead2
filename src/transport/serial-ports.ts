// The serial ports that this computer has.
import { readdir } from 'node:fs/promises'
import { ConnectionError } from '../errors'
import { loadSerialPort, type SerialPortClass } from './serial-package'

/** A serial port of this computer. */
export interface SerialPortInfo {
  /** `COM3`, `/dev/ttyUSB0`. */
  readonly path: string
  /** On Linux a name that stays the same whatever else is plugged in, of adapters that have one. */
  readonly lastingPath?: string
  /** Who made the adapter, as it says itself. */
  readonly manufacturer?: string
}

/** What ports are called on systems where nobody tells of them (containers have no udev). */
const NAMES = /^(?:tty(?:USB|ACM|AMA|S|MFD|O|XRUSB)\d+|rfcomm\d+)$/

/**
 * The serial ports of this computer, by their names.
 * @throws ConnectionError PORT_UNAVAILABLE without the package `serialport`
 */
export async function serialPorts(): Promise<readonly SerialPortInfo[]> {
  const Port = await loadSerialPort()
  if (Port instanceof ConnectionError) throw Port
  const ports = await told(Port).catch((cause: unknown) => named(cause))
  return [...ports].sort((one, other) => one.path.localeCompare(other.path, 'en', { numeric: true }))
}

async function told(Port: SerialPortClass): Promise<SerialPortInfo[]> {
  const ports = await Port.list()
  return ports.map(({ path, manufacturer, pnpId }) => ({
    path,
    ...(manufacturer === undefined ? {} : { manufacturer }),
    // Elsewhere it is something else.
    ...(process.platform !== 'linux' || pnpId === undefined ? {} : { lastingPath: `/dev/serial/by-id/${pnpId}` }),
  }))
}

async function named(cause: unknown): Promise<SerialPortInfo[]> {
  try {
    return (await readdir('/dev')).filter((name) => NAMES.test(name)).map((name) => ({ path: `/dev/${name}` }))
  } catch {
    const message = `This system does not tell its serial ports${cause instanceof Error ? ` (${cause.message})` : ''}: type the name of the port.`
    throw new ConnectionError('PORT_UNAVAILABLE', message, 'notSent', cause)
  }
}
