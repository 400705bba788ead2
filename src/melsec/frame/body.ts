// What stands around the data of a command in the body of a frame (SLMP reference manual 4.1, 4.2).
import { field, type MessageOf, type Shape } from '../../codec/codec'
import type { SlmpFrameName } from './frames'

const { fixed, u16, u8 } = field

/** In front of the data of every request of the SLMP set. */
export const commandFields = { command: u16(), subcommand: u16() } as const satisfies Shape

const stationFields = { network: u8(), station: u8(), moduleIo: u16(), multidrop: u8() } as const satisfies Shape

const errorInformation = { ...stationFields, ...commandFields } as const satisfies Shape

/** The station that failed (it may differ from the one asked) and the command it failed in. */
export type ErrorInformation = MessageOf<typeof errorInformation> & {
  /** Station extension frame only. */
  readonly extensionStation?: number
}

/** The layout of a body as data. */
export interface BodyLayout {
  /** Fixed values between subcommand and data. */
  readonly reserved: Shape
  /** An answer repeats command, subcommand and the fixed values in front of its data, whatever its end code. */
  readonly echoed: boolean
  /** All that follows an end code other than 0; absent where nothing does. */
  readonly errorInformation?: typeof errorInformation
}

/** The body of a frame that says what failed where. */
export interface InformedBody extends BodyLayout {
  readonly errorInformation: typeof errorInformation
}

/** 3E and 4E. */
export const plainBody: InformedBody = { reserved: {}, echoed: false, errorInformation }

/** 3C and 4C. */
export const serialBody: BodyLayout = { reserved: {}, echoed: false }

/** Fixed value 00H and system area (five times 00H); both count as data. */
const reserved = {
  fixedValue: fixed(0, 1),
  systemArea: fixed(0, 4),
  systemAreaEnd: fixed(0, 1),
} as const satisfies Shape

/** The station extension frame: the error information in another order, with an extension station number. */
const extendedErrorInformation = {
  ...commandFields,
  ...reserved,
  ...stationFields,
  fixedValueOfStation: fixed(0, 1),
  extensionStation: u16(),
} as const satisfies Shape

const extendedBody: InformedBody = { reserved, echoed: true, errorInformation: extendedErrorInformation }

export const bodies: Readonly<Record<SlmpFrameName, InformedBody>> = {
  '3E': plainBody,
  '4E': plainBody,
  ext: extendedBody,
}
