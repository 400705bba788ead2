// Limits of the SLMP reference manual (SH(NA)-081293), chapter 5.2, as rows. One set for both codes unless a row says so.
// End codes: as measured by others on R120P, QnUDV, L02 and L26 CPUs; the manual gives none.

import type { DeviceForm } from '../device/device-form'
import type { LimitRule, Weights } from '../device/limit-rule'
import { labelCommandNames } from './no-labels'

/** FX5 and Q/L alike: 12 per word, 14 per double word. */
export const randomWriteWeights: Weights = { words: 12, doubleWords: 14 }
export const blockCounts: Weights = { wordBlocks: 1, bitBlocks: 1 }
/** Write Block: each block weighs something beside its points. */
export function writtenBlockWeights(perBlock: number): Weights {
  return { wordBlocks: perBlock, bitBlocks: perBlock, 'wordBlocks.values': 1, 'bitBlocks.values': 1 }
}

const slmp = 'SLMP reference manual 5.2'

/** Characters of the remote password. The commands take no device, so the limit holds in whatever form is the default. */
export function passwordLimit(min: number, max: number, source: string): LimitRule {
  return {
    commands: ['unlock', 'lock'],
    forms: ['short', 'long'],
    sum: { password: 1 },
    min,
    max,
    unit: 'characters',
    endCode: 0xc200,
    source,
  }
}
const password = 'SLMP reference manual 5.7, remote password length'

/** Read and Write, the same in every form. */
function batchLimits(forms: readonly DeviceForm[]): readonly LimitRule[] {
  return [
    {
      commands: ['readWords', 'writeWords'],
      forms,
      max: 960,
      unit: 'points',
      endCode: 0xc051,
      source: `${slmp}, Read and Write`,
    },
    {
      commands: ['readBits', 'writeBits'],
      forms,
      max: 7168,
      asciiFactor: 2,
      unit: 'points',
      endCode: 0xc052,
      source: `${slmp}, Read and Write`,
    },
    { commands: ['readBlock'], forms, max: 960, unit: 'points', endCode: 0xc051, source: `${slmp}, Read Block` },
  ]
}

const short: readonly DeviceForm[] = ['short', 'extendedShort']

/** Q and L: 000x and 008x. "Counted double with 008x" is for Read Random and Entry Monitor Device only. */
export const qAndLLimits: readonly LimitRule[] = [
  passwordLimit(4, 4, password),
  ...batchLimits(short),
  {
    commands: ['readRandom', 'entryMonitorDevice'],
    forms: short,
    max: 192,
    extendedFactor: 2,
    unit: 'points',
    endCode: 0xc054,
    source: `${slmp}, Read Random, footnote *1`,
  },
  {
    commands: ['writeRandomBits'],
    forms: short,
    max: 188,
    unit: 'points',
    endCode: 0xc053,
    source: `${slmp}, Write Random; 188 with 008x measured by others (Q12H with QJ71E71-100)`,
  },
  {
    commands: ['writeRandomWords'],
    forms: short,
    sum: randomWriteWeights,
    max: 1920,
    unit: 'weightedPoints',
    endCode: 0xc054,
    source: `${slmp}, Write Random`,
  },
  {
    commands: ['readBlock', 'writeBlock'],
    forms: short,
    sum: blockCounts,
    max: 120,
    unit: 'blocks',
    endCode: 0xc0d8,
    source: `${slmp}, Read Block and Write Block`,
  },
  {
    commands: ['writeBlock'],
    forms: short,
    sum: writtenBlockWeights(4),
    max: 960,
    unit: 'weightedPoints',
    endCode: 0xc051,
    source: `${slmp}, Write Block`,
  },
]

/**
 * With the file register ZR counted twice in Read Random and Entry Monitor Device: of High Performance model QCPUs. The
 * footnote does not say whether 008x counts it four times: it does here, so that no request is too long.
 */
export function zrTwice(rules: readonly LimitRule[]): readonly LimitRule[] {
  return rules.map((rule) =>
    rule.commands.includes('readRandom')
      ? { ...rule, twice: ['ZR'], source: `${rule.source}: ZR of High Performance model QCPUs counted twice` }
      : rule,
  )
}

const long: readonly DeviceForm[] = ['long', 'extendedLong']

/** iQ-R: as Q/L in 000x, everything counted double with 0080; half of it in 0002 and 0082. */
export const iqRLimits: readonly LimitRule[] = [
  passwordLimit(6, 32, password),
  ...batchLimits([...short, ...long]),
  {
    commands: labelCommandNames,
    forms: [...short, ...long],
    // "At most 1920 bytes are sent": counted here with command and subcommand, and in ASCII code as characters.
    max: 1920,
    unit: 'bytes',
    endCode: 0xc075,
    source: 'SLMP reference manual 5.3, Number of array points; the end code background',
  },
  {
    commands: ['readRandom', 'entryMonitorDevice'],
    forms: short,
    max: 192,
    extendedFactor: 2,
    unit: 'points',
    endCode: 0xc054,
    source: `${slmp}, Read Random, footnote *1`,
  },
  {
    commands: ['readRandom', 'entryMonitorDevice'],
    forms: long,
    max: 96,
    unit: 'points',
    endCode: 0xc054,
    source: `${slmp}, Read Random`,
  },
  // The manual has no row for 0081 and 0083: counted double, as the FX5 communication manual does (38.2, Write Random).
  {
    commands: ['writeRandomBits'],
    forms: short,
    max: 188,
    extendedFactor: 2,
    unit: 'points',
    endCode: 0xc053,
    source: `${slmp}, Write Random`,
  },
  {
    commands: ['writeRandomBits'],
    forms: long,
    max: 94,
    unit: 'points',
    endCode: 0xc053,
    source: `${slmp}, Write Random`,
  },
  {
    commands: ['writeRandomWords'],
    forms: short,
    sum: randomWriteWeights,
    max: 1920,
    extendedFactor: 2,
    unit: 'weightedPoints',
    endCode: 0xc054,
    source: `${slmp}, Write Random, footnote *1`,
  },
  {
    commands: ['writeRandomWords'],
    forms: long,
    sum: randomWriteWeights,
    max: 960,
    unit: 'weightedPoints',
    endCode: 0xc054,
    source: `${slmp}, Write Random`,
  },
  {
    commands: ['readBlock', 'writeBlock'],
    forms: short,
    sum: blockCounts,
    max: 120,
    extendedFactor: 2,
    unit: 'blocks',
    endCode: 0xc0d8,
    source: `${slmp}, Read Block and Write Block, footnote *1`,
  },
  {
    commands: ['readBlock', 'writeBlock'],
    forms: long,
    sum: blockCounts,
    max: 60,
    unit: 'blocks',
    endCode: 0xc0d8,
    source: `${slmp}, Read Block and Write Block`,
  },
  {
    commands: ['writeBlock'],
    forms: ['short'],
    sum: writtenBlockWeights(4),
    max: 960,
    unit: 'weightedPoints',
    endCode: 0xc051,
    source: `${slmp}, Write Block`,
  },
  // Footnote *1 doubles the number of blocks, so also where it is multiplied by 4; the points are not doubled.
  {
    commands: ['writeBlock'],
    forms: ['extendedShort'],
    sum: writtenBlockWeights(8),
    max: 960,
    unit: 'weightedPoints',
    endCode: 0xc051,
    source: `${slmp}, Write Block, footnote *1`,
  },
  {
    commands: ['writeBlock'],
    forms: long,
    sum: writtenBlockWeights(9),
    max: 960,
    unit: 'weightedPoints',
    endCode: 0xc051,
    source: `${slmp}, Write Block`,
  },
]
