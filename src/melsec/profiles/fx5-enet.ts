import type { CommandName } from '../commands/commands'
import type { DeviceForm } from '../device/device-form'
import type { LimitRule } from '../device/limit-rule'
import { fx5Limits, iqF, writtenBlocks } from './iq-f'
import { randomWriteWeights } from './limits'
import type { Lack, Profile } from './profile'

const manual = 'FX5 communication manual 38.1 and 38.2, Ethernet module'
const extended: readonly DeviceForm[] = ['extendedShort', 'extendedLong']
const all: readonly DeviceForm[] = ['short', ...extended]
const random = { commands: ['readRandom'], unit: 'points', endCode: 0xc054, source: manual } as const
const randomWrite = {
  commands: ['writeRandomWords'],
  unit: 'weightedPoints',
  endCode: 0xc054,
  source: manual,
} as const satisfies Partial<LimitRule>

/**
 * What the Ethernet module prints otherwise than the CPU module. In binary code with subcommand 0000 it counts its own
 * way (123 points; 18 and 20 of 1962); in ASCII code and with 008x the figures of the CPU module are printed.
 */
const limits: readonly LimitRule[] = [
  ...fx5Limits,
  {
    commands: ['writeWords'],
    forms: all,
    codes: ['binary'],
    max: 949,
    unit: 'points',
    endCode: 0xc052,
    source: manual,
  },
  { commands: ['writeWords'], forms: all, codes: ['ascii'], max: 480, unit: 'points', endCode: 0xc052, source: manual },
  { ...random, forms: ['short'], codes: ['binary'], max: 123 },
  { ...random, forms: ['short'], codes: ['ascii'], max: 192, asciiFactor: 2 },
  { ...random, forms: extended, max: 192, asciiFactor: 2, extendedFactor: 2 },
  { ...randomWrite, forms: ['short'], codes: ['binary'], sum: { words: 18, doubleWords: 20 }, max: 1962 },
  { ...randomWrite, forms: ['short'], codes: ['ascii'], sum: randomWriteWeights, max: 1920, asciiFactor: 2 },
  { ...randomWrite, forms: extended, sum: randomWriteWeights, max: 1920, asciiFactor: 2, extendedFactor: 2 },
  writtenBlocks(770, manual),
]

function cpuOnly(command: CommandName, instead: string): Lack {
  return {
    command,
    endCode: 0xc059,
    reason: 'The Ethernet port of the CPU module has it, the Ethernet module has not.',
    instead,
    source: 'command list 38.1: in the table of the CPU module only',
  }
}

/** FX5-ENET and the modules that share its table, with an iQ-F CPU behind it. */
export const fx5Enet: Profile = {
  ...iqF,
  id: 'fx5-enet',
  title: 'MELSEC iQ-F Ethernet module',
  series: 'iQ-F CPUs by FX5-ENET, FX5-ENET/IP, FX5-CCLGN-MS, FX5-CCLIEF, FX5-40SSC-G or FX5-80SSC-G',
  lacks: [
    ...iqF.lacks,
    cpuOnly('clearError', 'Clear the error in GX Works3 or by the CPU program.'),
    cpuOnly('unlock', 'This module has no remote password for SLMP: leave the password away.'),
    cpuOnly('lock', 'This module has no remote password for SLMP: leave the password away.'),
  ],
  limits,
  exclusions: iqF.exclusions,
  exclusions1e: [
    {
      commands: ['writeWords'],
      devices: ['LCN'],
      endCode: 0x56,
      reason: 'The Ethernet module does not write counters of 32 bits in a 1E frame.',
      instead: 'Use a 3E frame, or a 1E frame to the Ethernet port of the CPU module.',
      source: 'FX5 communication manual 39.2, batch write: notes on command 03H',
    },
    {
      commands: ['writeRandomWords'],
      devices: ['TS'],
      endCode: 0x56,
      reason: 'The Ethernet module does not take contacts of timers in Test in word units.',
      instead: 'Use bit units.',
      source: 'FX5 communication manual 39.1, footnote *4 (command 05H)',
    },
  ],
  refusals: {
    ...iqF.refusals,
    deviceName: 0xc05b,
    extendedDeviceName: 0xc05b,
    length: 0xc057,
    source: 'end codes 47.4, Ethernet module (C057 and C061 have the same text); remote control background',
  },
  connections: { most: 32, source: '6.1: SLMP, MELSOFT, sockets, simple CPU communication and BACnet together' },
  lastIndex: { Z: 24, LZ: 12, source: 'appendix 9: Ethernet module' },
  monitoringTimer: {
    default: 4000,
    zeroOnly: false,
    recommended: { from: 250, to: 10_000 },
    source: '37.1: 0001 to FFFF on the Ethernet module only, recommended 01 to 28',
  },
  subcommands: {},
  notes: [
    'SLMP needs an entry in the External Device Configuration of the module in GX Works3, with protocol and port number.',
    'At most 32 connections, shared with other protocols; own port 1 to 5548 or 5570 to 65534.',
    'Only the connected module and its CPU are reached: network 0, station 255, module I/O 03FF, multidrop 0.',
    'Binary code with subcommand 0000 has its own limits: 123 points of Read Random, 949 words of Write, 18 and 20 of 1962 in Write Random.',
    'C05E: the CPU did not answer within the monitoring timer. 4032: timer and counter contacts in Read Random and Write Random.',
    'Read Type Name gives the code of the CPU behind the module, so identify() cannot tell the module from the CPU port.',
  ],
  sources: {
    ...iqF.sources,
    forms: '38.1: the command list of the Ethernet module has 0000/0001 and 0080 to 0083 only',
  },
}
