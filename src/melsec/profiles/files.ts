import type { CommandName } from '../commands/commands'
import type { FileFacts, Lack } from '../profile'

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

/** iQ-R, and the remote head RJ72GF15-T2. */
export const iqRFiles: FileFacts = {
  subcommands: [0x0040],
  drives: [
    { number: 1, title: 'device/label memory', same: 3 },
    { number: 2, title: 'SD memory card' },
    { number: 3, title: 'device/label memory' },
    { number: 4, title: 'data memory' },
  ],
  source: manual,
}

const drivesOfQAndL: FileFacts['drives'] = [
  { number: 0, title: 'program memory' },
  { number: 1, title: 'SRAM card' },
  { number: 2, title: 'Flash card, ATA card, SD memory card' },
  { number: 3, title: 'standard RAM' },
  { number: 4, title: 'standard ROM' },
]

/** "0004 cannot access QCPU". */
export const qFiles: FileFacts = { subcommands: [0x0000], drives: drivesOfQAndL, source: manual }
export const lFiles: FileFacts = { subcommands: [0x0000, 0x0004], drives: drivesOfQAndL, source: manual }

/** Of a PLC nobody knows: every subcommand, and every drive of a family. */
export const anyFiles: FileFacts = {
  subcommands: [0x0000, 0x0004, 0x0040],
  drives: [0, 1, 2, 3, 4].map((number) => ({ number, title: `drive ${number}` })),
  source: manual,
}

export const noFileFacts: FileFacts = { subcommands: [], drives: [], source: 'no file commands' }

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
