import { fx3Over1e } from '../a-compatible/rules'
import { noFileFacts } from './files'
import { profileOver1e } from './over-1e'
import { passwordMismatch } from './password'
import type { Profile } from './profile'

const manual = 'background: FX3U-ENET-ADP user’s manual, chapter 7'

/**
 * FX3 CPUs by FX3U-ENET-ADP or FX3U-ENET, which take 1E frames only. The FX5 communication manual's chapter on 1E (39)
 * is made to be compatible with them: devices and limits are its figures.
 */
export const fx3: Profile = profileOver1e(
  {
    id: 'fx3',
    title: 'MELSEC FX3',
    series: 'FX3U, FX3UC, FX3G, FX3GC and FX3S CPUs by FX3U-ENET-ADP or FX3U-ENET',
    cpu: 'fx3',
    xyRadix: 8,
    xyRadixKnown: true,
    wRadix: 16,
    asciiXy: 'hexadecimal',
    frames: ['1E'],
    frame: '1E',
    codes: ['binary', 'ascii'],
    code: 'binary',
    transports: ['tcp', 'udp'],
    forms: ['short'],
    form: 'short',
    shortDevices: [],
    extensions: [],
    absentDevices: [],
    lacks: [],
    doubtful: [],
    exclusions: [],
    aCompatible: fx3Over1e,
    limits: [],
    ranges: {
      points: {
        SM: 8512,
        SD: 8512,
        X: 256,
        Y: 256,
        M: 7680,
        S: 4096,
        D: 8000,
        R: 32768,
        TS: 512,
        TN: 512,
        CS: 200,
        CN: 200,
        LCS: 56,
        LCN: 56,
      },
      source: `FX5 communication manual 39.2; ${manual}`,
    },
    refusals: {
      deviceNumber: 0x57,
      deviceName: 0x56,
      extendedDeviceName: 0x56,
      bitUnitsOfWordDevice: 0x58,
      extension: 0x56,
      command: 0x50,
      monitorNotRegistered: 0x50,
      length: 0x57,
      notInStop: 0x5b,
      remote: 0x5b,
      device: 0x56,
      monitoredContact: 0x56,
      wholeDevices: 0x57,
      bufferMemory: 0x57,
      station: 0x5b,
      module: 0x5b,
      source: manual,
    },
    // No command asks for it.
    password: passwordMismatch,
    // What 1E tells of itself; it has no names.
    model: { code: fx3Over1e.typeCode, name: 'FX3U' },
    inFlight: { tcp: 1, udpBuffer: 0, ports: [], source: 'the answer names no request: one at a time' },
    connections: { most: 4, source: 'background: open settings of the FX3U-ENET-ADP' },
    reach: {
      stations: 'connected',
      ownModuleIo: [0x3ff],
      nonControlCpus: [],
      ownModuleIoOnly: true,
      source: `${manual}: PC No. FF, the local station`,
    },
    lastIndex: { Z: -1, LZ: -1, source: 'a 1E frame has no index modification' },
    monitoringTimer: {
      default: 2500,
      zeroOnly: false,
      recommended: { from: 250, to: 10_000 },
      source: `${manual}: its examples have 000AH, 2500 ms`,
    },
    subcommands: {},
    remote: { clearModes: [0], reset: 'not by a 1E frame', source: 'FX5 communication manual 39.3' },
    files: noFileFacts,
    notes: [
      'Special relays and registers M8000 to M8511 and D8000 to D8511 are also called SM8000 and SD8000 here, because the iQ-F calls them so.',
      'The counters of 32 bits C200 to C255 are LCN0 to LCN55 (value) and LCS0 to LCS55 (contact).',
      'The port needs an open setting with MC protocol in GX Works2; its data code is set there, too.',
    ],
    sources: {
      xyRadix: manual,
      wRadix: manual,
      asciiXy:
        'background: FX3U-ENET-ADP user’s manual, p. 55 (data codes) and 81 (Y20 is 00000010); FX3U-ENET user’s manual, p. 9-26',
      frames: `${manual}: A-compatible 1E frame only`,
      forms: manual,
      extensions: manual,
      absentDevices: manual,
    },
  },
  fx3Over1e,
)
