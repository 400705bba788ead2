// The options of a serial line, for whoever speaks on one. Their values are checked by the library.
import { type Command, Option } from 'commander'
import type { MelsecOptions, SerialPortOptions } from '../index'
import { choice, given } from './option'

/** As commander gives them. */
export interface SerialLineOptions extends Pick<MelsecOptions, 'messageFormat' | 'sumCheck'> {
  readonly serial?: string
  readonly baudRate?: NonNullable<SerialPortOptions['baudRate']>
  readonly dataLength?: NonNullable<SerialPortOptions['dataLength']>
  readonly parity?: NonNullable<SerialPortOptions['parity']>
  readonly stopBits?: NonNullable<SerialPortOptions['stopBits']>
  readonly rts?: NonNullable<SerialPortOptions['rts']>
}

const PORT = ['baudRate', 'dataLength', 'parity', 'stopBits', 'rts'] as const

/** Adds the options of a serial port and of the frames on its line. */
export function addSerialLineOptions(command: Command): Command {
  return command
    .addOption(new Option('--baud-rate <number>', 'bits per second; default 9600').argParser(Number))
    .addOption(new Option('--data-length <bits>', '7 or 8; default 7, with format 5 8').argParser(Number))
    .addOption(choice('--parity <parity>', 'default odd', ['none', 'odd', 'even']))
    .addOption(new Option('--stop-bits <number>', '1 or 2; default 1').argParser(Number))
    .addOption(choice('--rts <rts>', 'request to send; default on', ['on', 'off', 'sending']))
    .addOption(new Option('--message-format <number>', 'format 1, 4 or 5; default 1').argParser(Number))
    .option('--no-sum-check', 'without sum check code')
}

/** The library's options of the port; nothing when none was given. */
export function serialPortOf(options: SerialLineOptions): SerialPortOptions | undefined {
  const port = { ...given({ path: options.serial }, ['path']), ...given(options, PORT) }
  return Object.keys(port).length === 0 ? undefined : port
}
