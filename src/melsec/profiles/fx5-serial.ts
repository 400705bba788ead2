// The command set of an FX5 over a serial line in 3C and 4C frames: that of its Ethernet port with figures of its own, as far
// as the serial part of the manual prints them (chapter 43). In 1C frames there is less of it (over-1c.ts).
import type { LimitRule } from '../device/limit-rule'
import { fx5Channels } from '../serial-channels'
import { iqF, iqFLimits } from './iq-f'
import type { DeviceExclusion, Lack, Profile } from './profile'
import { serialPort } from './serial'

const manual = 'FX5 communication manual 43.1 and 43.2'

/** NAK codes (47.2, 3C and 4C frames). */
const NAK = {
  headNumber: 0x7143,
  content: 0x7164,
  command: 0x7e40,
  randomPoints: 0x7e41,
  points: 0x7e42,
  device: 0x7e43,
  data: 0x7f23,
} as const

const RANDOM: readonly string[] = ['readRandom', 'writeRandomBits', 'writeRandomWords']

/** The same figures as over Ethernet, but in ASCII code the full ones. */
function overSerial({ asciiFactor: _, ...rule }: LimitRule): LimitRule {
  const isRandom = rule.commands.some((name) => RANDOM.includes(name))
  // The footnote of the command list counts all points of 1406 with an extension double, its section does not: the lower.
  const isWrittenBlocks = rule.unit === 'weightedPoints' && rule.commands.includes('writeBlock')
  return {
    ...rule,
    ...(isWrittenBlocks ? { extendedFactor: 2 } : {}),
    endCode: isRandom ? NAK.randomPoints : NAK.points,
    source: manual,
  }
}

/** The serial part prints it of Read and Write only. */
function excluded(exclusion: DeviceExclusion): readonly DeviceExclusion[] {
  const printed = (name: string) => /^(read|write)(Bits|Words)$/.test(name)
  const own = exclusion.commands.filter(printed)
  const others = exclusion.commands.filter((name) => !printed(name))
  const here = { ...exclusion, endCode: NAK.device }
  return [
    ...(own.length === 0 ? [] : [{ ...here, commands: own, source: `${manual}, notes of 0401 and 1401` }]),
    ...(others.length === 0
      ? []
      : [
          {
            ...here,
            commands: others,
            doubtful: true as const,
            source: `${exclusion.source}: printed of the Ethernet port, not in the serial chapter 43`,
          },
        ]),
  ]
}

function noPassword(command: 'unlock' | 'lock'): Lack {
  return {
    command,
    endCode: NAK.command,
    reason: 'The serial ports have no 1630 and 1631.',
    instead: 'Leave the password away.',
    source: 'command list 43.1 has no 1630 and 1631',
  }
}

export const fx5Serial: Profile = {
  ...iqF,
  ...serialPort({ frames: ['3C', '4C', '1C'], source: `${manual}, 42.2` }),
  id: 'fx5-serial',
  title: 'MELSEC iQ-F serial',
  series: 'FX5S, FX5UJ, FX5U and FX5UC CPU modules by RS-485 or RS-232C',
  lacks: [
    ...iqF.lacks.map((lack) => ({
      ...lack,
      endCode: NAK.command,
      source: lack.source.replace('command list 38.1', 'command list 43.1'),
    })),
    noPassword('unlock'),
    noPassword('lock'),
  ],
  exclusions: iqF.exclusions.flatMap(excluded),
  limits: iqFLimits.map(overSerial),
  refusals: {
    deviceNumber: NAK.headNumber,
    deviceName: NAK.device,
    extendedDeviceName: NAK.device,
    bitUnitsOfWordDevice: NAK.device,
    extension: NAK.content,
    command: NAK.command,
    monitorNotRegistered: NAK.command,
    length: NAK.data,
    notInStop: iqF.refusals.notInStop,
    remote: iqF.refusals.remote,
    device: NAK.device,
    monitoredContact: NAK.device,
    wholeDevices: NAK.content,
    bufferMemory: NAK.headNumber,
    station: NAK.content,
    module: NAK.content,
    source:
      'NAK codes 47.2; which one it is for an extension, a station or a module is not printed; remote control background',
  },
  subcommands: { clearError: { value: 0x0000, source: 'command list 43.1 and 43.4' } },
  notes: [
    'The serial port needs MC protocol as protocol format in GX Works3; speed, parity, sum check, station and message format are set there, too.',
    '1C frames: FX5U and FX5UC from firmware 1.110. Message formats with X and Y in hexadecimal digits: FX5U and FX5UC from 1.040.',
    'In 3C and 4C the wait before an answer is a parameter of the port; in 1C each request says it, and the parameter counts for nothing.',
    'One-pair wiring with an FX-485PC-IF needs a message wait of 70 to 150 ms; two pairs and RS-232C need none.',
  ],
  serial: {
    reach: 'fx5',
    lastStation: 15,
    channels: fx5Channels,
    source: 'FX5 communication manual 42.5: all but the station number is fixed',
  },
  sources: {
    ...iqF.sources,
    asciiXy: '43.2 and 44.4: message formats "Format 1 (X,Y OCT)" and the like',
    frames: '18.4: 4C in formats 1, 4 and 5, 3C and 1C in formats 1 and 4; 42: 3C and 4C carry the data of 3E',
    forms: '43.1: the command list has 0000/0001 and 0080 to 0083 only',
    extensions: 'appendix 11: module access; link direct devices are marked as not available',
    absentDevices: 'device table 43.2; V, ZR, RD and long timers measured by others over Ethernet (C05C)',
  },
}
