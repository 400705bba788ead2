// The frames of MELSEC PLCs over Ethernet: what is true of each, whatever family speaks it.
import type { DataCode } from '../../codec/codec'

interface FrameFacts {
  /** For people: the manual's word without "frame". */
  readonly title: string
  /** Data codes that exist of it (SLMP reference manual 2.1). */
  readonly codes: readonly DataCode[]
  /** A serial number in the subheader tells late answers from new ones. */
  readonly serial: boolean
}

const BOTH: readonly DataCode[] = ['binary', 'ascii']

/** By the name that options take. 1E is the A-compatible frame with its own command set. */
export const frameFacts = {
  '3E': { title: '3E', codes: BOTH, serial: false },
  '4E': { title: '4E', codes: BOTH, serial: true },
  ext: { title: 'station extension', codes: ['binary'] as readonly DataCode[], serial: true },
  '1E': { title: '1E', codes: BOTH, serial: false },
} as const satisfies Readonly<Record<string, FrameFacts>>

export type FrameName = keyof typeof frameFacts
/** Frames of the SLMP set. */
export type SlmpFrameName = Exclude<FrameName, '1E'>
