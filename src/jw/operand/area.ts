/**
 * Where operands lie in the files of a Sharp JW: typed data with its source. What no source says is not here.
 *
 * The map is printed for JW20 and JW20H (JW-21MN manual, 8-1). JW30H and JW300 are taken to keep it: the message commands are
 * common to them, and the examples of the JW300 manual (89000 to 89777 are 512 bytes) fit. None is printed for a JW300.
 */

/**
 * How far a place is to be trusted. `printed`: a manual prints it. `derived`: it follows from what is printed by counting on.
 * `assumed`: likely, and said by nobody. `given`: the user says so.
 */
export type JwConfidence = 'printed' | 'derived' | 'assumed' | 'given'

/** Operands that lie one behind the other in a file, from the first to the last. */
export interface JwArea {
  /** First operand, in its own notation, e.g. `016000`. Of bits the first of a byte. */
  readonly first: string
  /** Last operand, of the same kind. */
  readonly last: string
  /** File number, 00 to 80H. */
  readonly file: number
  /** Byte in the file where the first operand lies, e.g. `0o20000`. */
  readonly address: number
  /** Missing in a user's area: `given`. */
  readonly confidence?: JwConfidence
  /** Where it is said. */
  readonly source?: string
}

const MAP = 'JW-21MN manual, 8-1 (JW20, JW20H)'

/** What sources confirm. Relays are bits from bit 0 of their byte on: relay 04033 is bit 3 of byte 000403 (JW-20FL5 manual, 9-19). */
export const jwAreas: readonly JwArea[] = [
  { first: '000000', last: '003777', file: 0, address: 0o0, confidence: 'printed', source: `${MAP}, I/O relays` },
  {
    first: '004000',
    last: '006777',
    file: 0,
    address: 0o400,
    confidence: 'printed',
    source: `${MAP}, auxiliary relays`,
  },
  { first: '007000', last: '007777', file: 0, address: 0o700, confidence: 'printed', source: `${MAP}, latched relays` },
  { first: '010000', last: '015777', file: 0, address: 0o1000, confidence: 'printed', source: `${MAP}, relays` },
  { first: 'b0000', last: 'b1777', file: 0, address: 0o2000, confidence: 'printed', source: `${MAP}, current values` },
  {
    first: '09000',
    last: '59777',
    file: 0,
    address: 0o4000,
    confidence: 'printed',
    source: `${MAP}, registers; JW-20FL5 manual, 9-29: 09000 is byte 004000`,
  },
  {
    first: '69000',
    last: '99777',
    file: 0,
    address: 0o12000,
    confidence: 'derived',
    source: `${MAP}: the blocks before have 512 bytes each and follow one another, and 89000 to 89777 has 512 bytes (JW300 option unit manual, DL9)`,
  },
]

/**
 * What is likely and not confirmed. Nothing is read or written by it unless it is among the `areas` that a user gives: try it
 * on the PLC first, with operands whose values are known.
 */
export const assumedJwAreas: readonly JwArea[] = [
  {
    first: 'E0000',
    last: 'E1777',
    file: 0,
    address: 0o16000,
    confidence: 'assumed',
    source: 'they would fill the 8 KiB behind register 99777',
  },
  {
    first: 'T-C0000',
    last: 'T-C1777',
    file: 0,
    address: 0o1600,
    confidence: 'assumed',
    source: `${MAP} prints the bytes (T-C000 to T-C777 in 001600 to 001777) and not the bits; counted like relays, 1024 contacts fill them`,
  },
]
