// What stands in front of a message on Ethernet. The JW300 option unit manual prints messages without anything; the manual of
// the JW-20FL5, which passes the same messages on, prints 40 bytes, normally all 00 (9-19), and how a relay fills them (9-43).
import { badOption, checkNames, isPlainObject, wholeNumber } from '../basics/option-checks'
import { shown } from '../basics/show'

/** To a station of the FL-net behind the PLC on Ethernet. */
export interface JwRelay {
  /** Pseudo station of the JW-255CM (PDA), 1 to 254. */
  readonly pda: number
  /** Pseudo station of the sender (PSA), 1 to 254. */
  readonly psa: number
  /** Slot of the FL-net unit in the PLC on Ethernet (PO0), 2 to 7. */
  readonly slot: number
  /** Station on the FL-net (EA1), 1 to 254. */
  readonly station: number
}

/** Nothing, 40 bytes 00, a relay, or bytes as they are. */
export type JwHeader = 'none' | 'zero40' | JwRelay | Uint8Array

/** Bytes of every header that is known. */
export const HEADER_LENGTH = 40
const MOST = 255
const NAMES = { pda: true, psa: true, slot: true, station: true } as const
const AT = { pda: 4, psa: 5, ft0: 6, slot: 7, station: 8, ft1: 9 } as const
const FT0 = 0x60
const FT1 = 0x40

/** First bytes of messages: what begins like one is no header. */
export const ID = { request: 0x47, response: 0x45 } as const

/** @throws RequestError BAD_OPTION for a header that cannot be told from a message, and for a relay out of range. */
export function headerBytes(header: JwHeader = 'none'): Buffer {
  if (header === 'none') return Buffer.alloc(0)
  if (header === 'zero40') return Buffer.alloc(HEADER_LENGTH)
  if (header instanceof Uint8Array) return givenBytes(header)
  if (!isPlainObject(header))
    badOption('header', `header is ${shown(header)}; it must be none, zero40, a relay or bytes.`)
  return relayBytes(checkedRelay(header))
}

function givenBytes(given: Uint8Array): Buffer {
  const bytes = Buffer.from(given)
  if (bytes.length === 0 || bytes.length > MOST)
    badOption('header', `header has ${bytes.length} byte(s); it must have 1 to ${MOST}.`)
  if (bytes[0] === ID.request || bytes[0] === ID.response) {
    badOption('header', 'header begins with 45H or 47H, as messages do: what is received could not be told apart.')
  }
  return bytes
}

function checkedRelay(relay: JwRelay): JwRelay {
  checkNames('header.', relay, NAMES)
  for (const name of ['pda', 'psa', 'station'] as const) wholeNumber(`header.${name}`, relay[name], 1, 254)
  wholeNumber('header.slot', relay.slot, 2, 7)
  return relay
}

function relayBytes({ pda, psa, slot, station }: JwRelay): Buffer {
  const bytes = Buffer.alloc(HEADER_LENGTH)
  bytes[AT.pda] = pda
  bytes[AT.psa] = psa
  bytes[AT.ft0] = FT0
  bytes[AT.slot] = slot
  bytes[AT.station] = station
  bytes[AT.ft1] = FT1
  return bytes
}

/** The numbers of a relay in a header, where it is one. */
export function relayIn(header: Buffer): JwRelay | undefined {
  if (header.length !== HEADER_LENGTH || header[AT.ft0] !== FT0 || header[AT.ft1] !== FT1) return undefined
  const [pda = 0, psa = 0, , slot = 0, station = 0] = header.subarray(AT.pda)
  return { pda, psa, slot, station }
}

/** The header of an answer: PSA is the PDA of the request (JW-20FL5 manual 9-43). That PDA is its PSA is assumed. */
export function answeringHeader(length: number, relay: Partial<JwRelay>): Buffer {
  const { pda, psa, slot, station } = relay
  if (pda === undefined || psa === undefined || slot === undefined || station === undefined) return Buffer.alloc(length)
  return relayBytes({ pda: psa, psa: pda, slot, station })
}
