import type { DeviceName } from '../device/device'
import { qFiles } from './files'
import { qAndLLimits, zrTwice } from './limits'
import { noLabels } from './no-labels'
import { passwordMismatch } from './password'
import type { Lack, Profile, StatusRegister } from './profile'
import { pointsOf } from './ranges'
import { networks, openSettings, ownStationTimer } from './reach'
import { cpuRefusals } from './refusals'
import { doubtfulClearError, doubtfulMemoryCommands } from './shared-lacks'

/** What Q and L share: long devices came with iQ-R. */
const absentOnQAndL: readonly DeviceName[] = [
  'LTS',
  'LTC',
  'LTN',
  'LSTS',
  'LSTC',
  'LSTN',
  'LCS',
  'LCC',
  'LCN',
  'LZ',
  'RD',
  'HG',
]

const builtIn =
  'measured by others: the built-in Ethernet ports of QnUDV and LCPU answer C059, Ethernet modules (E71) have it'

/** Measured to be refused by the CPU's own Ethernet port. */
export const notOnBuiltInPorts: readonly Lack[] = [
  {
    command: 'readBlock',
    endCode: 0xc059,
    reason: 'Built-in Ethernet ports do not have it.',
    instead: 'Use Read Random or several Reads.',
    source: builtIn,
  },
  {
    command: 'writeBlock',
    endCode: 0xc059,
    reason: 'Built-in Ethernet ports do not have it.',
    instead: 'Use Write Random or several Writes.',
    source: builtIn,
  },
  {
    command: 'readTypeName',
    endCode: 0xc059,
    reason: 'Built-in Ethernet ports do not have it.',
    instead: 'Take any successful read as the sign of life, and name the CPU yourself.',
    source: builtIn,
  },
]

const qStatus: StatusRegister = {
  device: 'SD',
  number: 203,
  source: 'special register list of the QCPU manuals, Operating status of CPU',
}

/** Figures of SLMP reference manual SH(NA)-081293 unless said otherwise. */
export const q: Profile = {
  id: 'q',
  title: 'MELSEC-Q',
  series:
    'QCPU by QJ71E71-100, and QnUDE, QnUDV and QnUDPV CPUs by their own Ethernet port, when it is not known which',
  cpu: 'q',
  xyRadix: 16,
  xyRadixKnown: true,
  wRadix: 16,
  asciiXy: 'hexadecimal',
  frames: ['3E', '4E'],
  frame: '3E',
  codes: ['binary', 'ascii'],
  code: 'binary',
  transports: ['tcp', 'udp'],
  forms: ['short', 'extendedShort'],
  form: 'short',
  shortDevices: [],
  extensions: ['link', 'module'],
  absentDevices: absentOnQAndL,
  lacks: noLabels('SLMP reference manual 5.3: global labels of GX Works2 cannot be accessed'),
  doubtful: [...notOnBuiltInPorts, doubtfulClearError, ...doubtfulMemoryCommands],
  exclusions: [],
  limits: zrTwice(qAndLLimits),
  ranges: {
    points: pointsOf(
      {
        SM: 2048,
        SD: 2048,
        X: 8192,
        Y: 8192,
        DX: 8192,
        DY: 8192,
        M: 8192,
        L: 8192,
        F: 2048,
        V: 2048,
        B: 8192,
        SB: 2048,
        S: 8192,
        D: 12288,
        W: 8192,
        SW: 2048,
        Z: 20,
        R: 32768,
        ZR: 393216,
      },
      { T: 2048, ST: 2048, C: 1024 },
    ),
    source:
      'background: defaults of the Universal model QCPU (device tab of the PLC parameter); Z, R and ZR measured by others on Q06UDV. ' +
      'ST has no points until a project gives it some: a usual value',
  },
  refusals: {
    ...cpuRefusals,
    deviceName: 0xc05b,
    device: 0xc05b,
    extension: 0xc070,
    source:
      'device number, device name, command and extension measured by others on QnUDV; the others background (error code lists of CPU and Ethernet modules)',
  },
  password: passwordMismatch,
  // Q03UDVCPU
  model: { code: 0x0366 },
  inFlight: {
    tcp: 1,
    udpBuffer: 57,
    ports: [
      { port: 'QJ71E71-100', buffer: 57 },
      { port: 'built-in Ethernet port of QnUDV and QnUDPV', buffer: 576 },
    ],
    source:
      '3.3: QJ71E71-100 1 + 57 / connections (QnUDV, QnUDPV: 576). TCP: one at a time, so that no PLC can merge two requests',
  },
  connections: { most: 16, source: openSettings },
  reach: networks('2.3: a built-in port reaches its own station only, an Ethernet module others too'),
  lastIndex: { Z: 15, LZ: -1, source: 'SLMP reference manual, appendix 1; LZ came with iQ-R' },
  monitoringTimer: ownStationTimer,
  subcommands: {},
  remote: {
    clearModes: [0, 1, 2],
    reset: 'only in STOP, and only if the PLC parameter "Remote Reset" is enabled; no answer when it succeeds',
    status: qStatus,
    source: 'SLMP reference manual 5.6',
  },
  files: qFiles,
  notes: [
    'Built-in port: PLC Parameter, Built-in Ethernet Port Setting, Open Setting, "MC Protocol", with the port number; tick "Enable online change" for writing.',
    'QJ71E71-100: UDP port 5000 is open without a setting ("Auto open UDP port"), as long as it is not assigned otherwise.',
    'Built-in ports refuse module access (U\\G) with C070; Ethernet modules have it.',
    'Profiles for one kind of port: q-built-in and q-e71.',
    'Read Random and Entry Monitor Device count ZR double on High Performance model QCPUs. It is counted so here, which is safe on every QCPU; zrCountsDouble: false ends it.',
    'Write Random over its limit is answered with 4080 by Ethernet modules, with C054 by built-in ports (measured by others).',
    '4E exists on current modules only: 3E is the default because every one of them has it.',
  ],
  sources: {
    xyRadix: 'device table of the SLMP reference manual',
    wRadix: 'device table of the SLMP reference manual',
    asciiXy: 'device table of the SLMP reference manual: hexadecimal numbers',
    frames: '4.1 and appendix 2; 3E as default because older modules and CPUs lack 4E (background)',
    forms: '5.2: 0000/0001 and 0080/0081 for Q and L',
    extensions: 'appendix 1: CPU buffer memory is for iQ-R',
    absentDevices: 'measured by others on QnUDV, L02S and L26: C05B',
  },
}
