// The package `serialport`: loaded when a port is opened or asked for, and not before.
import { ConnectionError } from '../errors'

export type SerialPortClass = typeof import('serialport').SerialPort

/** Its class, or why there is none. Bundlers make an `import()` of the `require`, because the package may be absent: scripts/modules.mjs. */
export async function loadSerialPort(): Promise<SerialPortClass | ConnectionError> {
  try {
    return (require('serialport') as typeof import('serialport')).SerialPort
  } catch (cause) {
    const message =
      'Serial ports need the package serialport, which is not installed here, or not for this system: npm install serialport'
    return new ConnectionError('PORT_UNAVAILABLE', message, 'notSent', cause)
  }
}
