import { iqRFiles } from './files'
import { iqRLimits } from './limits'
import { authentication } from './password'
import type { Profile } from './profile'
import { pointsOf } from './ranges'
import { networks, openSettings, ownStationTimer } from './reach'
import { cpuRefusals } from './refusals'
import { doubtfulClearError, doubtfulMemoryCommands } from './shared-lacks'

/** Figures of SLMP reference manual SH(NA)-081293 unless said otherwise. */
export const iqR: Profile = {
  id: 'iq-r',
  title: 'MELSEC iQ-R',
  series: 'R00 to R120 CPUs (also EN, P, SF, PSF) by their Ethernet port or RJ71EN71; iQ-L and MELSEC MX behave alike',
  cpu: 'iq-r',
  xyRadix: 16,
  xyRadixKnown: true,
  wRadix: 16,
  asciiXy: 'hexadecimal',
  frames: ['4E', '3E', 'ext'],
  frame: '4E',
  codes: ['binary', 'ascii'],
  code: 'binary',
  transports: ['tcp', 'udp'],
  forms: ['short', 'long', 'extendedShort', 'extendedLong'],
  form: 'long',
  shortDevices: [],
  extensions: ['link', 'module', 'cpu'],
  absentDevices: [],
  lacks: [],
  doubtful: [...doubtfulMemoryCommands, doubtfulClearError],
  exclusions: [
    {
      commands: ['writeBits', 'writeWords', 'writeRandomBits', 'writeRandomWords', 'writeBlock'],
      devices: ['S'],
      endCode: 0x4030,
      reason: 'Step relays can be read but not written.',
      instead: 'Control the SFC program with M devices or SFC instructions.',
      source: 'measured by others: R120PCPU answers 4030',
    },
  ],
  limits: iqRLimits,
  ranges: {
    points: pointsOf(
      {
        SM: 4096,
        SD: 4096,
        X: 12288,
        Y: 12288,
        DX: 12288,
        DY: 12288,
        M: 12288,
        L: 8192,
        F: 2048,
        V: 2048,
        B: 8192,
        SB: 2048,
        S: 1024,
        D: 18432,
        W: 8192,
        SW: 2048,
        Z: 20,
        LZ: 2,
        R: 32768,
        ZR: 65536,
        RD: 524288,
      },
      { T: 1024, ST: 1024, C: 512, LT: 1024, LST: 1024, LC: 512 },
    ),
    source:
      'background: defaults of R04CPU to R120CPU (CPU parameter, memory/device setting); Z and LZ measured by others. ' +
      'ST, LST, S, R and ZR have no points until a project gives them some: usual values',
  },
  refusals: {
    ...cpuRefusals,
    deviceName: 0x4030,
    device: 0x4030,
    extension: 0x4043,
    source:
      'device number and name, also in an extension specification, and parts of LCN measured by others on R120PCPU; the others background (error code lists of CPU and Ethernet modules)',
  },
  password: authentication,
  // R08CPU
  model: { code: 0x4801 },
  inFlight: {
    tcp: 1,
    udpBuffer: 32,
    ports: [
      { port: 'built-in Ethernet port', buffer: 32 },
      { port: 'RJ71EN71', buffer: 190 },
    ],
    source: '3.3: RCPU 1 + 32 / connections (RJ71EN71: 190). TCP: one at a time, so that no PLC can merge two requests',
  },
  connections: { most: 16, source: openSettings },
  reach: networks('2.3: the built-in port reaches its own station only, RJ71EN71 and network modules others too'),
  lastIndex: { Z: 24, LZ: 12, source: 'SLMP reference manual, appendix 1' },
  monitoringTimer: ownStationTimer,
  subcommands: {},
  remote: {
    clearModes: [0, 1, 2],
    reset: 'only in STOP, and only if the CPU parameter "Remote Reset" is enabled; no answer when it succeeds',
    status: {
      device: 'SD',
      number: 203,
      source: 'background: special register list of the MELSEC iQ-R CPU module manual (application)',
    },
    source: 'SLMP reference manual 5.6',
  },
  files: iqRFiles,
  notes: [
    'SLMP needs an entry in GX Works3: "External Device Configuration" of the Ethernet port, with protocol, port number and "Enable Online Change" for writing.',
    'The built-in Ethernet port reaches its own station only; other networks need an RJ71EN71 or a network module (SLMP reference manual 2.3).',
    'Only an RJ71GN11-T2 (CC-Link IE TSN) takes and relays the station extension frame, in binary code (SLMP reference manual 2.1, 2.3).',
    'Labels answer only with "Access from External Device" ticked in GX Works3.',
  ],
  sources: {
    xyRadix: 'device table of the SLMP reference manual',
    wRadix: 'device table of the SLMP reference manual',
    asciiXy: 'device table of the SLMP reference manual: hexadecimal numbers',
    frames: '4.1; 4E as default for its serial number; the station extension frame by an RJ71GN11-T2 only (2.3)',
    forms: '5.2: 0002/0003 for iQ-R, 0000/0001 for compatibility with Q and L',
    extensions: 'appendix 1',
    absentDevices: 'device table of the SLMP reference manual',
  },
}
