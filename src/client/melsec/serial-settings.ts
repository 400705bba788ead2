// What the options of a client say about a serial line: its own one, or one that it shares.
import { definedOf } from '../../basics/defined'
import { oneOf, wholeNumber } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import type { DataCode } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { SerialProtocolOptions } from '../../melsec/client-protocol'
import { isSerialFrame, serialFormatCodes, serialRoute } from '../../melsec/frame/serial-frames'
import { type FrameName, type Profile, type TransportName, transportNames } from '../../melsec/profiles/profile'
import { lineTime } from '../../transport/serial'
import type { MelsecClientOptions } from './options'
import type { SerialLink } from './serial-diagnosis'
import { SerialLine, serialLineOf } from './serial-line'

/** The line of a serial frame: its own, or the one it shares. */
export function serialLineFor(options: MelsecClientOptions, profile: Profile): SerialLine | undefined {
  const { frame: given, line, serial, host, port, messageFormat, sumCheck, serialFrame } = options
  if (line !== undefined) {
    refuseEthernetOptions(options)
    for (const name of [
      'frame',
      'messageFormat',
      'sumCheck',
      'serialFrame',
      'serial',
      'host',
      'port',
      'openTransport',
    ] as const) {
      if (options[name] === undefined) continue
      throw new RequestError('BAD_OPTION', `${name} belongs to the line: give it to createMelsecLine().`, name)
    }
    return serialLineOf(line)
  }
  const usual = profile.frames.find(isSerialFrame)
  const frame = given ?? (usual === undefined || messageFormat === 5 ? undefined : profile.frame)
  const isSerial = frame === undefined ? usual !== undefined : isSerialFrame(frame)
  if (!isSerial) {
    refuseSerialOptions(options, frame ?? profile.frame)
    return undefined
  }
  refuseEthernetOptions(options)
  return new SerialLine(
    definedOf({
      frame: frame === undefined || !isSerialFrame(frame) ? undefined : frame,
      messageFormat,
      sumCheck,
      serialFrame,
      serial,
      host,
      port,
      connectTimeout: options.connectTimeout,
      openTransport: options.openTransport,
      clock: options.clock,
    }),
    { isOwn: true },
  )
}

/** What says nothing about any other frame: a parity that nobody uses would look as if it counted. */
function refuseSerialOptions(options: MelsecClientOptions, frame: FrameName): void {
  for (const name of ['serial', 'messageFormat', 'sumCheck', 'serialFrame', 'messageWait'] as const) {
    if (options[name] === undefined) continue
    const message = `${name} is for the serial frames 1C, 3C and 4C, not for ${frame}: choose a serial profile or frame, or leave it out.`
    throw new RequestError('BAD_OPTION', message, name)
  }
}

/** What a serial line has no use for, also behind a device server. */
function refuseEthernetOptions({ transport, localAddress, localPort }: MelsecClientOptions): void {
  const given = { localAddress, localPort, transport: transport === 'udp' ? transport : undefined }
  for (const [name, value] of Object.entries(given)) {
    if (value === undefined || value === 0) continue
    const message = `${name} ${shown(value)} is for Ethernet ports of PLCs: on a serial line leave it out. A device server is reached by TCP.`
    throw new RequestError('BAD_OPTION', message, name)
  }
}

export function codeOfLine({ frame, messageFormat }: SerialLine, { code }: MelsecClientOptions): DataCode {
  const own = serialFormatCodes[messageFormat]
  if (code === undefined || code === own) return own
  const message = `${frame} in format ${messageFormat} is ${own} code: leave code out, or choose another format.`
  throw new RequestError('BAD_OPTION', message, 'code')
}

const LONGEST_WAIT = 150
const WAIT_UNIT = 10

export function serialOf(
  line: SerialLine,
  profile: Profile,
  { route = {}, messageWait }: MelsecClientOptions,
): SerialProtocolOptions {
  const { frame, ...format } = line.settings.frame
  const wait = wholeNumber('messageWait', messageWait ?? 0, 0, LONGEST_WAIT)
  if (wait % WAIT_UNIT !== 0) {
    throw new RequestError(
      'BAD_OPTION',
      `messageWait is ${wait} ms; it counts in steps of ${WAIT_UNIT} ms.`,
      'messageWait',
    )
  }
  if (messageWait !== undefined && frame !== '1C') {
    const message = `In a ${frame} frame the wait before an answer is a parameter of the PLC: leave messageWait out.`
    throw new RequestError('BAD_OPTION', message, 'messageWait')
  }
  const { port, recovery } = line.settings
  const turnRound = Math.round((wait + (recovery.gap ?? 0)) / lineTime(1, port))
  return { ...format, messageWait: wait, turnRound, head: serialRoute(frame, route, profile.serial?.reach) }
}

/** What both sides of a serial line must have alike. */
export function serialLinkOf(
  line: SerialLine | undefined,
  serial: SerialProtocolOptions | undefined,
): SerialLink | undefined {
  if (line === undefined || serial === undefined) return undefined
  const { frame, port } = line.settings
  const { format, sumCheck = true } = frame
  return { station: serial.head.station, format, sumCheck, port, isRemote: line.isRemote }
}

/** A way that the frame cannot take, and an option that is of no use, would look as if they counted. */
export function transportOf({ transport, serial, line, openTransport }: MelsecClientOptions): TransportName {
  const isPort = serial?.path !== undefined || line !== undefined
  const chosen = oneOf('transport', transport ?? (isPort ? 'serial' : 'tcp'), transportNames)
  if (isPort && chosen !== 'serial') {
    throw new RequestError(
      'BAD_OPTION',
      `transport is ${chosen}, and serial.path or line say serial: leave one out.`,
      'transport',
    )
  }
  if (chosen === 'serial' && !isPort && openTransport === undefined) {
    throw new RequestError(
      'BAD_OPTION',
      'transport is serial: give serial.path, e.g. COM3 or /dev/ttyUSB0, or line.',
      'serial.path',
    )
  }
  return chosen
}
