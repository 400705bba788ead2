// What is known of an end code beside its number.

/**
 * Whose number an end code is: the same number means something else in another family. `slmp`: the four digits of 3E, 4E,
 * station extension, 3C and 4C frames, and of the registers of the PLC. `1E`, `1C`: the two digits of these frames, of 1E
 * abnormal codes too. `jw`: the result codes of Sharp JW.
 */
export const endCodeFamilies = ['slmp', '1E', '1C', 'jw'] as const
/** Whose number an end code is. */
export type EndCodeFamily = (typeof endCodeFamilies)[number]

/** What an end code is about. */
export const endCodeAbouts = [
  'item', // the device, address or label of one item; the others of the request may be fine
  'size', // more than one request may carry
  'command', // the PLC does not have the command, or not for this target
  'request', // form or data of the request as a whole, e.g. its length or data code
  'file', // the file or drive it names
  'state', // a state or setting of the PLC: RUN, busy, writing not enabled, locked by a password
  'route', // the way to the station, or the station at its end
  'transmission', // the request arrived damaged
  'unknown', // nobody knows
] as const
/** What an end code is about. */
export type EndCodeAbout = (typeof endCodeAbouts)[number]

/** What an `EndCodeError` knows beside its number. */
export interface EndCodeDetail {
  /** Whose number it is. */
  readonly family: EndCodeFamily
  /** Default `unknown`. */
  readonly about?: EndCodeAbout
  /** `false`: the PLC did nothing of it. Missing: it may have been carried out, all or in part. */
  readonly carriedOut?: false
  /** Manual's name of the command, e.g. `Read (word units)`. */
  readonly command?: string
  /** Name of the command in its set, e.g. `readWords`. */
  readonly commandName?: string
  /** Station that reported the error, where the frame says so, e.g. `network 0, station 255, module I/O 03FF, multidrop 0`. */
  readonly station?: string
  /** Of a 1E frame with end code 5BH: the code behind it, which says why. */
  readonly abnormalCode?: number
  /** What the code means, in English. */
  readonly meaning?: string
  /** What to do about it, in English. */
  readonly remedy?: string
}
