import { field, type MessageOf } from '../codec/codec'

const { u16, u8 } = field

/**
 * What follows an end code other than 0 in a 3E or 4E answer: the station that failed (it may differ from the one
 * asked) and the command it failed in. SLMP reference manual 4.2, "error information".
 */
export const errorInformation = {
  network: u8(),
  station: u8(),
  moduleIo: u16(),
  multidrop: u8(),
  command: u16(),
  subcommand: u16(),
} as const

export type ErrorInformation = MessageOf<typeof errorInformation>
