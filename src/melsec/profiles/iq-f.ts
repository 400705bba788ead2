import { fx5Over1e } from '../a-compatible/rules'
import type { DeviceForm } from '../device/device-form'
import type { LimitRule } from '../device/limit-rule'
import { noFileFacts, noFiles } from './files'
import { blockCounts, passwordLimit, randomWriteWeights, writtenBlockWeights } from './limits'
import { noLabels } from './no-labels'
import { authentication } from './password'
import type { Profile } from './profile'
import { pointsOf } from './ranges'
import { noMemoryCommands } from './shared-lacks'

const forms: readonly DeviceForm[] = ['short', 'extendedShort', 'extendedLong']
const manual = 'FX5 communication manual 38.1 and 38.2'
const twice = { asciiFactor: 2, extendedFactor: 2 } as const

/** The manual has two tables in 38.1, of the CPU module and of the Ethernet modules; these rows are in both. */
// C051 and C052 the other way round than on iQ-R, Q and L: the manual's end codes (47.4), and measured by others.
export const fx5Limits: readonly LimitRule[] = [
  {
    commands: ['readWords'],
    forms,
    max: 960,
    asciiFactor: 2,
    unit: 'points',
    endCode: 0xc052,
    source: manual,
  },
  {
    commands: ['readBits', 'writeBits'],
    forms,
    max: 3584,
    asciiFactor: 2,
    unit: 'points',
    endCode: 0xc051,
    source: manual,
  },
  { commands: ['writeRandomBits'], forms, max: 188, ...twice, unit: 'points', endCode: 0xc053, source: manual },
  {
    commands: ['readBlock', 'writeBlock'],
    forms,
    sum: blockCounts,
    max: 120,
    ...twice,
    unit: 'blocks',
    endCode: 0xc0d8,
    source: manual,
  },
  { commands: ['readBlock'], forms, max: 960, asciiFactor: 2, unit: 'points', endCode: 0xc052, source: manual },
]

/** Of the CPU module, without the password. */
export const iqFLimits: readonly LimitRule[] = [
  ...fx5Limits,
  { commands: ['writeWords'], forms, max: 960, asciiFactor: 2, unit: 'points', endCode: 0xc052, source: manual },
  { commands: ['readRandom'], forms, max: 192, ...twice, unit: 'points', endCode: 0xc054, source: manual },
  {
    commands: ['writeRandomWords'],
    forms,
    sum: randomWriteWeights,
    max: 1920,
    ...twice,
    unit: 'weightedPoints',
    endCode: 0xc054,
    source: manual,
  },
  writtenBlocks(760, `${manual}: 760 of the CPU module (Ethernet module 770)`),
]

/** Write Block: blocks weigh four points each. */
export function writtenBlocks(max: number, source: string): LimitRule {
  const sum = writtenBlockWeights(4)
  return { commands: ['writeBlock'], forms, sum, max, asciiFactor: 2, unit: 'weightedPoints', endCode: 0xc052, source }
}

const doubleWordDevices = ['LCN', 'LTN', 'LSTN', 'LZ'] as const
const contactsAndCoils = ['TS', 'TC', 'STS', 'STC', 'CS', 'CC'] as const

/** Figures of the FX5 communication manual SH(NA)-082626 unless said otherwise: the CPU module's own Ethernet port. */
export const iqF: Profile = {
  id: 'iq-f',
  title: 'MELSEC iQ-F',
  series: 'FX5S, FX5UJ, FX5U and FX5UC CPU modules by their Ethernet port',
  cpu: 'iq-f',
  xyRadix: 8,
  xyRadixKnown: true,
  wRadix: 16,
  asciiXy: 'setting',
  frames: ['3E', '1E'],
  frame: '3E',
  codes: ['binary', 'ascii'],
  code: 'binary',
  transports: ['tcp', 'udp'],
  forms,
  form: 'short',
  shortDevices: ['LZ'],
  extensions: ['module'],
  absentDevices: ['V', 'ZR', 'RD', 'DX', 'DY', 'LTS', 'LTC', 'LTN', 'LSTS', 'LSTC', 'LSTN', 'HG'],
  lacks: [
    ...(['entryMonitorDevice', 'executeMonitor'] as const).map((command) => ({
      command,
      endCode: 0xc059,
      reason: 'iQ-F CPU modules have no monitor registration.',
      instead: 'Read the same devices with Read Random (readRandom).',
      source: 'command list 38.1 has no 0801/0802; measured by others: C059',
    })),
    ...noLabels('command list 38.1 has no label commands'),
    ...noFiles('command list 38.1 has no file commands'),
    ...noMemoryCommands('command list 38.1 has no 0613, 1613, 0601 and 1601'),
  ],
  doubtful: [],
  exclusions: [
    {
      commands: ['readBits', 'readWords', 'writeBits', 'writeWords', 'readBlock', 'writeBlock'],
      devices: doubleWordDevices,
      endCode: 0xc05b,
      reason: 'Devices of two words cannot be accessed by Read, Write, Read Block and Write Block.',
      instead: 'Use Read Random and Write Random (word units), as double word.',
      source: `${manual}, notes of 0401, 1401, 0406, 1406`,
    },
    {
      commands: ['readRandom'],
      devices: [...contactsAndCoils, 'LCS', 'LCC'],
      endCode: 0xc05b,
      reason: 'Contacts and coils of timers and counters cannot be accessed by Read Random.',
      instead: 'Use Read (bit units).',
      source: `${manual}, note of 0403`,
    },
    {
      commands: ['writeRandomBits', 'writeRandomWords'],
      devices: contactsAndCoils,
      endCode: 0xc05b,
      reason: 'Contacts and coils of timers and counters cannot be accessed by Write Random.',
      instead: 'Use Write (bit units).',
      source: `${manual}, note of 1402`,
    },
  ],
  aCompatible: fx5Over1e,
  limits: [passwordLimit(6, 32, 'FX5 communication manual 38.6'), ...iqFLimits],
  ranges: {
    points: pointsOf(
      {
        SM: 10000,
        SD: 12000,
        X: 1024,
        Y: 1024,
        M: 7680,
        L: 7680,
        F: 128,
        B: 256,
        SB: 512,
        S: 4096,
        D: 8000,
        W: 512,
        SW: 512,
        Z: 20,
        LZ: 2,
        R: 32768,
      },
      { T: 512, ST: 16, C: 256, LC: 64 },
    ),
    source: 'measured by others: read from SD260 onward on FX5UC-32MT/D and FX5U-32MR/DS; S background',
  },
  refusals: {
    deviceNumber: 0xc056,
    deviceName: 0xc05c,
    extendedDeviceName: 0xc05c,
    bitUnitsOfWordDevice: 0xc05c,
    extension: 0xc060,
    command: 0xc059,
    monitorNotRegistered: 0xc059,
    length: 0xc061,
    notInStop: 0x4013,
    remote: 0x408b,
    device: 0xc05b,
    monitoredContact: 0xc05b,
    wholeDevices: 0xc05c,
    bufferMemory: 0xc056,
    station: 0xc05f,
    module: 0xc05f,
    source:
      'end codes 47.4 (C05B device that cannot be accessed, C05F request that the target cannot execute, C056 address); device number, device name and absent module measured by others on FX5U and FX5UC; remote control background',
  },
  password: {
    ...authentication,
    lockChecks: false,
    source: 'end codes 47.4; 38.6: length and password are not used by Lock',
  },
  // FX5U-32MR/ES
  model: { code: 0x4a21 },
  inFlight: {
    tcp: 1,
    udpBuffer: 0,
    ports: [],
    source: '36.3: half duplex; 6.5: over UDP a request that comes before the answer to the last one is discarded',
  },
  connections: { most: 8, source: '6.1: SLMP, MELSOFT, sockets and the others together' },
  reach: {
    stations: 'connected',
    ownModuleIo: [0x3ff],
    nonControlCpus: [],
    ownModuleIoOnly: true,
    source:
      '37.1: Ethernet-equipped modules take network 00, station FF, module I/O 03FF and multidrop station 00 only',
  },
  lastIndex: { Z: 23, LZ: 11, source: 'appendix 9: FX5S, FX5U and FX5UC; FX5UJ Z19 and LZ1' },
  monitoringTimer: { default: 0, zeroOnly: true, source: '37.1: 0000 on the CPU module' },
  subcommands: {
    clearError: {
      value: 0x0000,
      source: '0000 in the section on Clear Error and in the serial command lists; the command list 38.1 prints 0001',
    },
  },
  remote: {
    clearModes: [0],
    reset: 'only in STOP, and only if the CPU parameter "Remote Reset" is enabled; may not be answered',
    status: {
      device: 'SD',
      number: 203,
      source:
        'background: special register list of the FX5 application manual, to which the communication manual refers',
    },
    source: '38.3 Remote RUN and Remote Reset',
  },
  files: noFileFacts,
  notes: [
    'SLMP needs an entry in GX Works3: Module Parameter, Ethernet Port, External Device Configuration, "SLMP Connection Module", with protocol and port number.',
    'At most 8 connections, shared with other protocols; own port 1 to 5548 or 5570 to 65534.',
    'Only the connected module is reached: network 0, station 255, module I/O 03FF, multidrop 0.',
    'The long form (0002/0003) does not exist: LCS, LCC and LCN need the extended long form (0082/0083) with all extension fields 0.',
    '1E frames (FX5U and FX5UC from firmware 1.210, FX5UJ from 1.030, FX5S) reach X, Y, M, S, D, R, T, C and by other names SM8000 to SM8511, SD8000 to SD8511, LCS and LCN.',
    'Numbers of X and Y are octal in GX Works3; in ASCII code the port setting "ASCII (X, Y octal)" or "ASCII (X, Y hexadecimal)" decides what is sent.',
    'Remote latch clear: the manual prints 0000 for the fixed field, the SLMP manual 0001.',
  ],
  sources: {
    xyRadix: '38.2 device numbers of X and Y',
    wRadix: '38.2 device codes',
    asciiXy: '38.2 and 39.2: communication data code "ASCII (X,Y OCT)" or "ASCII (X,Y HEX)"',
    frames: '36.1: 3E and 1E, no 4E',
    forms: '38.1: the command list has 0000/0001 and 0080 to 0083 only',
    extensions: 'appendix 9: module access; link direct devices are marked as not available',
    absentDevices: 'device table 38.2; V, ZR, RD and long timers measured by others (C05C)',
  },
}
