// What every profile of a serial line has, whatever the PLC.
import { type SerialFrameName, serialFormatCodes, serialFrameFacts } from '../frame/serial-frames'
import type { Profile } from './profile'

/** The usual frame first. */
export function serialPort({
  frames,
  source,
}: {
  readonly frames: readonly SerialFrameName[]
  readonly source: string
}) {
  const formats = frames.flatMap((frame) => serialFrameFacts[frame].formats.map((format) => serialFormatCodes[format]))
  return {
    frames,
    frame: frames[0] ?? '3C',
    codes: [...new Set(formats)],
    code: 'ascii',
    transports: ['serial', 'tcp'],
    inFlight: { tcp: 1, udpBuffer: 0, ports: [], source: 'FX5 communication manual 41.1: half duplex' },
    connections: { most: 1, source: 'a serial line has one host' },
    monitoringTimer: {
      default: 0,
      zeroOnly: true,
      source: `serial frames have no monitoring timer: ${source}`,
    },
  } as const satisfies Partial<Profile>
}
