// The frames of MELSEC PLCs: what is true of each, whatever family speaks it.
import type { DataCode } from '../../codec/codec'
import { isSerialFrame, serialFrameNames } from './serial-frames'

/** Frames of the SLMP set. */
export const slmpFrameNames = ['3E', '4E', 'ext'] as const
/** Frames of the SLMP set. */
export type SlmpFrameName = (typeof slmpFrameNames)[number]

/** Frames of Ethernet ports. */
export const ethernetFrameNames = [...slmpFrameNames, '1E'] as const
/** Frames of Ethernet ports. */
export type EthernetFrameName = (typeof ethernetFrameNames)[number]

/** The frames that options take, by name; `ext` is the station extension frame, 1C, 3C and 4C are those of serial lines. */
export const frameNames = [...ethernetFrameNames, ...serialFrameNames] as const
/** Name of a frame; `ext`: the station extension frame; 1C, 3C and 4C: serial lines. */
export type FrameName = (typeof frameNames)[number]

/** Whether it is one of an Ethernet port. */
export function isEthernetFrame(name: FrameName): name is EthernetFrameName {
  return !isSerialFrame(name)
}

export interface FrameFacts {
  /** For people: the manual's word without "frame". */
  readonly title: string
  /** Data codes that exist of it (SLMP reference manual 2.1). */
  readonly codes: readonly DataCode[]
  /** A serial number in the subheader tells late answers from new ones. */
  readonly serial: boolean
  /** The frame to try on a PLC that says nothing to this one. */
  readonly instead: FrameName
  /** Which PLCs know it or do not, for people, where not every PLC does. */
  readonly knownTo?: string
}

const BOTH: readonly DataCode[] = ['binary', 'ascii']

const ASCII: readonly DataCode[] = ['ascii']

/** By the name that options take. 1E is the A-compatible frame with its own command set. */
export const frameFacts = {
  '3E': {
    title: '3E',
    codes: BOTH,
    serial: false,
    instead: '4E',
    knownTo: 'an FX3 knows 1E only: choose its profile',
  },
  '4E': { title: '4E', codes: BOTH, serial: true, instead: '3E', knownTo: 'iQ-F and older E71 modules have 3E only' },
  ext: {
    title: 'station extension',
    codes: ['binary'] as readonly DataCode[],
    serial: true,
    instead: '4E',
    knownTo: 'only an RJ71GN11-T2 knows and relays it',
  },
  '1E': { title: '1E', codes: BOTH, serial: false, instead: '3E' },
  '1C': { title: '1C', codes: ASCII, serial: false, instead: '3C' },
  '3C': {
    title: '3C',
    codes: ASCII,
    serial: false,
    instead: '4C',
    knownTo: 'an FX3 knows 1C only: choose its profile',
  },
  '4C': { title: '4C', codes: BOTH, serial: false, instead: '3C', knownTo: 'an FX3 knows 1C only: choose its profile' },
} as const satisfies Readonly<Record<FrameName, FrameFacts>>
