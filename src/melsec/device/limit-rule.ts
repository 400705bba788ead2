// The form profiles keep limits in; limit.ts reads them.
import type { DataCode } from '../../codec/codec'
import type { CommandName } from '../commands/commands'
import type { DeviceName } from './device'
import type { DeviceForm } from './device-form'

/**
 * What a limit counts. `weightedPoints`: points and blocks with weights, as the manuals give them. `bytes`: the request
 * data as sent, from the command on; it has no sum.
 */
export type LimitUnit = 'points' | 'blocks' | 'weightedPoints' | 'bytes' | 'characters'

/** 1E: a request carries fewer words of bit devices than of the others. */
export type LimitedUnit = 'bit' | 'word'

/**
 * Weight of each request field. A number field counts its value, a list, bulk or text field its length;
 * `wordBlocks.points` is the sum over the list (value of a number, length of a bulk field).
 */
export type Weights = Readonly<Record<string, number>>

/** One row of a profile's table. It stands for a limit per command, form and code; see `limitsOf`. */
export interface LimitRule {
  readonly commands: readonly CommandName[]
  readonly forms: readonly DeviceForm[]
  /** Data codes it holds in; without it both. */
  readonly codes?: readonly DataCode[]
  /** Devices it is about; without it all. */
  readonly of?: LimitedUnit
  /** Points of these devices count twice. */
  readonly twice?: readonly DeviceName[]
  /** Weights; without it every point counts once (`pointFields`). */
  readonly sum?: Weights
  /** In binary code and for a device specification that is not extended. */
  readonly max: number
  /** Default 1. */
  readonly min?: number
  readonly unit: LimitUnit
  /** Everything counts so many times in ASCII code (FX5: 2). */
  readonly asciiFactor?: number
  /** Everything counts so many times with an extended device specification (008x). */
  readonly extendedFactor?: number
  readonly endCode: number
  readonly source: string
}
