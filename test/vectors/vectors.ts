/**
 * Byte vectors from the manuals: what goes over the wire, beside what it means in this package's message shapes.
 * The meaning was written from the manuals and held against the bytes by an encoder that shares no code with `src`,
 * so a test against a vector is not a test of the package with itself. See README.md.
 */
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import type { DeviceAddress, DeviceExtension, DeviceName } from '../../src/melsec/device/device'

export type Form = 'short' | 'long' | 'extendedShort' | 'extendedLong'
export type Side = 'request' | 'response'
/** The digit of a serial frame is its format. */
export type Frame =
  | '3E'
  | '4E'
  | 'ext'
  | '1E'
  | '1C1'
  | '1C4'
  | '3C1'
  | '3C4'
  | '4C1'
  | '4C4'
  | '4C5'
  | 'JW'
  | 'JWserial'

/** What a message holds when it is written as JSON. */
export type Json = boolean | number | string | readonly Json[] | { readonly [name: string]: Json }
export type Message = { readonly [name: string]: Json }

interface Known {
  readonly id: string
  /** Manual and section. */
  readonly source: string
  /**
   * `printed`: byte by byte. `reconstructed`: from printed values and printed rules. `corrected`: the print contradicts
   * its own rules, see `note`. `assumed`: depends on an open question, see `note`.
   */
  readonly basis: 'printed' | 'reconstructed' | 'corrected' | 'assumed'
  readonly code: 'binary' | 'ascii'
  /** The bytes on the wire. */
  readonly hex: string
  readonly note?: string
}

interface OfCommand {
  /** Name of the command's declaration. */
  readonly command: string
  readonly form?: Form
  /** File commands. */
  readonly subcommand?: number
  /** Radix of X and Y in ASCII code when it is not 16. */
  readonly xyRadix?: 8
  /** 1C only: wait before the answer, in ms. */
  readonly messageWait?: number
  readonly frame?: Frame
}

/** Command, subcommand (both absent in 1E and JW) and data, as they stand in the frame. */
export interface RequestDataVector extends Known, OfCommand {
  readonly kind: 'requestData'
  readonly message: Message
}

/** The first bytes of request data (1E: of the frame); the rest is not legible. `message` is a whole message. */
export interface PrefixVector extends Known, OfCommand {
  readonly kind: 'prefix'
  readonly head?: Head
  readonly message: Message
}

/** Data behind the end code. */
export interface ResponseDataVector extends Known, OfCommand {
  readonly kind: 'responseData'
  readonly message: Message
  /** The request it answers. */
  readonly request: Message
  /** Execute Monitor: the Entry Monitor Device request that says what is answered. */
  readonly registration?: Message
  /** What the words mean, e.g. a REAL. */
  readonly typed?: { readonly type: string; readonly value: Json }
}

/** The parts of a frame around its body. What a frame does not have is absent. */
export interface Head {
  readonly serial?: number
  readonly route?: Readonly<Record<string, number>>
  /** 1E. */
  readonly pc?: number
  /** Monitoring timer, in units of 250 ms. */
  readonly timer?: number
}

/** A whole frame. */
export interface FrameVector extends Known {
  readonly kind: 'frame'
  readonly frame: Frame
  readonly side: Side
  readonly command: string
  readonly form?: Form
  readonly xyRadix?: 8
  readonly messageWait?: number
  readonly head?: Head
  /** Serial frames: with a sum check code. */
  readonly sumCheck?: boolean
  /** Request message, or message of a normal answer; absent in an answer that refuses. */
  readonly message?: Message
  /** Of an answer: the request it answers. */
  readonly request?: Message
  /** Of an answer; 0 is success. */
  readonly endCode?: number
  /** 3E, 4E and station extension: what an answer that refuses says about the station and the command. */
  readonly errorInformation?: Readonly<Record<string, number>>
  /** JW: code of the command, result code of an answer, bytes in front of the message. */
  readonly commandCode?: number
  readonly result?: number
  readonly header?: string
  /** JW lists: where FFH stands, when it is not once before the first address. */
  readonly marker?: 'each'
}

/** A request outside a printed limit: an encoder refuses the message, a responder the bytes. */
export interface RefusedVector extends Known {
  readonly kind: 'refused'
  readonly frame: Frame
  readonly side: 'request'
  readonly command: string
  readonly commandCode?: number
  readonly message: Message
}

/** Unsigned integers in their order. */
export interface FieldVector extends Known {
  readonly kind: 'field'
  readonly fields: readonly { readonly name: string; readonly width: 1 | 2 | 4; readonly value: number }[]
  readonly frame?: Frame
  readonly command?: string
  readonly form?: Form
  /** Direct memory specification: of which extension. */
  readonly extensionKind?: DeviceExtension['kind']
}

export interface SubheaderVector extends Known {
  readonly kind: 'subheader'
  readonly frame: '3E' | '4E' | 'ext'
  readonly side: Side
  readonly serial?: number
}

export interface DeviceCodeVector extends Known {
  readonly kind: 'deviceCode'
  readonly device: DeviceName
  /** Absent in 1E. */
  readonly form?: Form
  readonly frame?: Frame
}

export interface DeviceNumberVector extends Known {
  readonly kind: 'deviceNumber'
  readonly device: DeviceName
  readonly number: number
  readonly form: Form
}

/** Subcommand and one device specification. */
export interface DeviceVector extends Known {
  readonly kind: 'device'
  readonly subcommand: number
  readonly form: Form
  readonly address: DeviceAddress
  /** The print ends within the specification. */
  readonly complete?: false
}

/** The extension specification of an address (`J1\`, `U1\`), without the rest. */
export interface ExtensionVector extends Known {
  readonly kind: 'extension'
  readonly extension: DeviceExtension
}

/** Sum check code of the bytes in `over`. */
export interface SumVector extends Known {
  readonly kind: 'sum'
  readonly frame: Frame
  readonly over: string
}

/** Format 5: `unstuffed` with the additional code 10H. */
export interface AdditionalCodeVector extends Known {
  readonly kind: 'additionalCode'
  readonly frame: '4C5'
  readonly unstuffed: string
}

/** A control sequence that is a frame of its own (EOT, CL). */
export interface ControlVector extends Known {
  readonly kind: 'control'
  readonly frame: Frame
}

/** A field of characters. */
export interface TextVector extends Known {
  readonly kind: 'text'
  readonly frame: Frame
  readonly field: string
  readonly text: string
}

/** A device in a 1C message. */
export interface Device1cVector extends Known {
  readonly kind: 'device1C'
  readonly frame: '1C1'
  readonly command: string
  readonly address: { readonly device: DeviceName; readonly number: number }
}

/** Name of a label, with its length in front when it is `counted`. */
export interface LabelNameVector extends Known {
  readonly kind: 'labelName'
  readonly name: string
  readonly counted?: true
  /** What an abbreviated name stands for. */
  readonly expanded?: string
}

/** Abbreviation points and the names that are abbreviated. */
export interface LabelAbbreviationsVector extends Known {
  readonly kind: 'labelAbbreviations'
  readonly names: readonly string[]
}

/** One value of a file command. */
export interface FileValueVector extends Known {
  readonly kind: 'fileValue'
  readonly codec: 'fileName' | 'directoryPath' | 'fileNumber'
  readonly subcommand: number
  readonly value: string | number
  /** `false`: without its length in front. */
  readonly counted?: false
}

/** One file in the answer of Read Directory/File. */
export interface FileEntryVector extends Known {
  readonly kind: 'fileEntry'
  readonly subcommand: number
  readonly entry: Message
}

export type Vector =
  | RequestDataVector
  | PrefixVector
  | ResponseDataVector
  | FrameVector
  | RefusedVector
  | FieldVector
  | SubheaderVector
  | DeviceCodeVector
  | DeviceNumberVector
  | DeviceVector
  | ExtensionVector
  | SumVector
  | AdditionalCodeVector
  | ControlVector
  | TextVector
  | Device1cVector
  | LabelNameVector
  | LabelAbbreviationsVector
  | FileValueVector
  | FileEntryVector

/** One file each: SLMP (and 3E, 4E), labels and files of SLMP, 1E, serial for format 5, serial for formats 1 and 4, JW as printed, JW as it follows from the layouts, JW over serial lines. */
export const FAMILIES = [
  'slmp',
  'labels',
  'files',
  'mc-ethernet-1e',
  'mc-serial',
  'mc-serial-ascii',
  'jw-printed',
  'jw',
  'jw-serial',
] as const
export type Family = (typeof FAMILIES)[number]

/** The vectors of a family, in the order of the manual. */
export function vectorsOf(family: Family): readonly Vector[] {
  return JSON.parse(readFileSync(join(__dirname, `${family}.json`), 'utf8')) as readonly Vector[]
}

/** Those of one kind; fails when there are none, so that a test never runs over nothing. */
export function vectorsOfKind<K extends Vector['kind']>(family: Family, kind: K): readonly (Vector & { kind: K })[] {
  const found = vectorsOf(family).filter((vector): vector is Vector & { kind: K } => vector.kind === kind)
  if (found.length === 0) throw new Error(`No vector of kind ${kind} in ${family}`)
  return found
}

/** A decoded message as the vectors write it: bytes as a list of numbers. */
export function plain(message: object): unknown {
  const entries = Object.entries(message).map(([name, value]) => [
    name,
    value instanceof Uint8Array ? [...value] : value,
  ])
  return Object.fromEntries(entries)
}

export function bytesOf(vector: Vector): Buffer {
  return Buffer.from(vector.hex, 'hex')
}
