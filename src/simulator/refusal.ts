// How the simulated PLC says no. What a family answers is in its profile; here is what profiles do not hold.
import type { ProfileId } from '../melsec/profiles/profile'

/** Ends the work on a request; the PLC answers with the end code. It never leaves this room. */
export class Refusal extends Error {
  constructor(
    readonly endCode: number,
    /** For the error log, for people. */
    message: string,
    /** 1E: abnormal code behind end code 5B. */
    readonly abnormal?: number,
  ) {
    super(message)
    this.name = 'Refusal'
  }
}

/** End codes of the request itself, alike on all families (FX5 communication manual 47.4). */
export const requestErrors = {
  /** ASCII code: characters that are no digits. */
  asciiConversion: 0xc050,
  /** A field of the request with a value that cannot be. */
  content: 0xc05c,
  /** Set/reset of a bit that is neither. */
  bitData: 0xc060,
  /** Only logged, never answered: binary expected, ASCII received, or another frame. */
  dataCode: 0xc06f,
} as const

/** End codes that depend on the family and that a profile does not need for the client's sake. */
export interface FurtherRefusals {
  /** Device that this command does not take. */
  readonly device: number
  /** Contact or coil of a timer or counter in Entry Monitor Device. */
  readonly monitoredContact: number
  /** Long timers and counters not in whole devices. */
  readonly wholeDevices: number
  /** Beyond the buffer memory of a module. */
  readonly bufferMemory: number
  /** A station that cannot be reached. */
  readonly station: number
  /** A module of this station that is no CPU. */
  readonly module: number
}

// Background (error code lists of the CPU modules), with C051 of LCN and the iQ-F rows as measured by others.
const cpuModules: FurtherRefusals = {
  device: 0x4030,
  monitoredContact: 0x4032,
  wholeDevices: 0xc051,
  bufferMemory: 0x4041,
  station: 0x4b00,
  module: 0x4b02,
}

const qAndL: FurtherRefusals = { ...cpuModules, device: 0xc05b }

// 47.4: C05B device that cannot be accessed, C05F request that the target cannot execute, C056 address.
const iqF: FurtherRefusals = {
  device: 0xc05b,
  monitoredContact: 0xc05b,
  wholeDevices: 0xc05c,
  bufferMemory: 0xc056,
  station: 0xc05f,
  module: 0xc05f,
}

export const furtherRefusals: Readonly<Record<ProfileId, FurtherRefusals>> = {
  'iq-r': cpuModules,
  generic: cpuModules,
  'remote-head': cpuModules,
  q: qAndL,
  'q-built-in': qAndL,
  'q-e71': qAndL,
  l: qAndL,
  'nz2gf-etb': qAndL,
  'iq-f': iqF,
  'fx5-enet': iqF,
  // None of them is reached: the port checks 1E requests itself.
  fx3: iqF,
}
