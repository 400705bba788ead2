// The command set of an FX5 over a serial line in 3C and 4C frames: that of its Ethernet port with figures of its own, as far
// as the serial part of the manual prints them (chapter 43).
import type { LimitRule } from '../device/limit-rule'
import { iqF, iqFLimits } from './iq-f'
import type { DeviceExclusion, Lack, Profile } from './profile'

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

export const fx5Over3c: Profile = {
  ...iqF,
  title: 'MELSEC iQ-F by a serial line',
  series: 'FX5S, FX5UJ, FX5U and FX5UC CPU modules by RS-485 or RS-232C',
  codes: ['ascii', 'binary'],
  code: 'ascii',
  transports: [],
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
  inFlight: { tcp: 1, udpBuffer: 0, ports: [], source: '41.1: half duplex' },
  connections: { most: 1, source: 'a serial line has one host' },
  monitoringTimer: { default: 0, zeroOnly: true, source: '42.2: serial frames have no monitoring timer' },
  subcommands: { clearError: { value: 0x0000, source: 'command list 43.1 and 43.4' } },
  notes: [],
  sources: {
    ...iqF.sources,
    asciiXy: '43.2: message format "(X,Y OCT)" or "(X,Y HEX)"',
    frames: '42: 3C and 4C carry the data of 3E',
    forms: '43.1: the command list has 0000/0001 and 0080 to 0083 only',
    extensions: 'appendix 11: module access; link direct devices are marked as not available',
    absentDevices: 'device table 43.2; V, ZR, RD and long timers measured by others over Ethernet (C05C)',
  },
}
