import type { CommandName } from '../commands/commands'
import type { FileFacts, FileRefusals, Lack } from './profile'

/** Every file command. */
export const fileCommandNames = [
  'readDirectory',
  'searchFile',
  'newFile',
  'deleteFile',
  'copyFile',
  'changeFileState',
  'changeFileDate',
  'openFile',
  'readFile',
  'writeFile',
  'closeFile',
] as const satisfies readonly CommandName[]

const manual = 'SLMP reference manual 5.8, Drive number; subcommands: table of commands and targets (2.1)'

/** The manual gives none. */
const cpuRefusals: FileRefusals = {
  drive: 0x4021,
  notFound: 0x4022,
  directory: 0x4022,
  name: 0x4022,
  exists: 0x4028,
  space: 0x4029,
  password: 0x4026,
  readOnly: 0x4052,
  locked: 0x4025,
  kind: 0x4024,
  range: 0x4027,
  writeProtected: 0x4050,
  pointer: 0x4022,
  now: 0x402c,
  running: 0x4010,
  failed: 0x4051,
  source: 'background: error code lists of the CPU modules',
}

/** Where the FX5 communication manual (47.1) has a code for it, it is taken for iQ-R too. */
const iqRRefusals: FileRefusals = {
  ...cpuRefusals,
  drive: 0x41c7,
  notFound: 0x41c5,
  directory: 0x41cc,
  name: 0x41eb,
  space: 0x41cf,
  readOnly: 0x41ce,
  locked: 0x41d8,
  kind: 0x41cd,
  writeProtected: 0x41df,
  failed: 0x41e4,
  source:
    'background: FX5 communication manual 47.1 for the same refusals of the FX5 CPU, error code lists of the CPU modules',
}

/** 4.1, Request destination module I/O No.: not a system that a switch-over changes. */
const ofCpu = [0x3ff, 0x3d2, 0x3d3]
/** CPU No. 1 to 4: 4.1 does not name them for file commands, appendix 3 lists the commands for every CPU. */
const ofMultipleCpus = [0x3e0, 0x3e1, 0x3e2, 0x3e3]
const ofRemoteHead = [0x3ff, 0x3e0, 0x3e1]

export const iqRFiles: FileFacts = {
  subcommands: [0x0040],
  drives: [
    { number: 1, title: 'device/label memory', same: 3 },
    { number: 2, title: 'SD memory card' },
    { number: 3, title: 'device/label memory' },
    { number: 4, title: 'data memory' },
  ],
  moduleIo: ofCpu,
  doubtfulModuleIo: ofMultipleCpus,
  stopToChange: false,
  refusals: iqRRefusals,
  source: manual,
}

/** The remote head RJ72GF15-T2. */
export const remoteHeadFiles: FileFacts = { ...iqRFiles, moduleIo: ofRemoteHead, doubtfulModuleIo: [] }

const drivesOfQAndL: FileFacts['drives'] = [
  { number: 0, title: 'program memory' },
  { number: 1, title: 'SRAM card' },
  { number: 2, title: 'Flash card, ATA card, SD memory card' },
  { number: 3, title: 'standard RAM' },
  { number: 4, title: 'standard ROM' },
]

/** "0004 cannot access QCPU". */
export const qFiles: FileFacts = {
  subcommands: [0x0000],
  drives: drivesOfQAndL,
  moduleIo: ofCpu,
  doubtfulModuleIo: ofMultipleCpus,
  stopToChange: true,
  refusals: cpuRefusals,
  source: manual,
}
export const lFiles: FileFacts = { ...qFiles, subcommands: [0x0000, 0x0004] }

/** Of a PLC nobody knows: every subcommand, and every drive of a family. */
export const anyFiles: FileFacts = {
  subcommands: [0x0000, 0x0004, 0x0040],
  drives: [0, 1, 2, 3, 4].map((number) => ({ number, title: `drive ${number}` })),
  moduleIo: [...new Set([...ofCpu, ...ofRemoteHead])],
  doubtfulModuleIo: ofMultipleCpus,
  stopToChange: false,
  refusals: cpuRefusals,
  source: manual,
}

export const noFileFacts: FileFacts = {
  subcommands: [],
  drives: [],
  moduleIo: [],
  doubtfulModuleIo: [],
  stopToChange: false,
  refusals: cpuRefusals,
  source: 'no file commands',
}

/** Of a family without access to files. */
export function noFiles(source: string): readonly Lack[] {
  return fileCommandNames.map((command) => ({
    command,
    endCode: 0xc059,
    reason: 'Its files cannot be reached by SLMP.',
    instead: 'Use GX Works, or the SD memory card of the CPU by FTP or in a card reader.',
    source,
  }))
}
