/** The vectors of serial frames as cases of feedings, and the body that each of them carries. */
import { type Context, encode, type Shape, writerOf } from '../../src/codec/codec'
import type { BodyLength } from '../../src/link/link'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { FORM_BITS, subcommandOf } from '../../src/melsec/device/form'
import type { SerialFormat, SerialFrameName, SerialHead } from '../../src/melsec/frame/serial-frames'
import { type SerialFrameOptions, serialFraming } from '../../src/melsec/frame/serial-framing'
import { oneCProtocol } from '../../src/melsec/one-c/protocol'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import type { FrameCase } from './feedings'
import { bytesOf, type FrameVector, vectorsOfKind } from './vectors'

const profile = resolveProfile('generic')

/** Whole frames of 1C, 3C and 4C in every format. */
export const serialVectors: readonly FrameVector[] = [
  ...vectorsOfKind('mc-serial', 'frame'),
  ...vectorsOfKind('mc-serial-ascii', 'frame'),
]

const FRAME = /^(1C|3C|4C)([145])$/

/** Frame, format and sum check of a vector. */
export function optionsOf({ frame: name, sumCheck = true }: FrameVector): SerialFrameOptions {
  const [, frame, format] = FRAME.exec(name) ?? []
  if (frame === undefined) throw new Error(`${name} is no serial frame`)
  return { frame: frame as SerialFrameName, format: Number(format) as SerialFormat, sumCheck }
}

export function headOf({ head }: FrameVector): SerialHead {
  const { station, pc, ...others } = head?.route ?? {}
  if (station === undefined || pc === undefined) throw new Error('the vector has no route')
  return { station, pc, ...others }
}

/** A case of feedings; other `options` than the vector's change what stands around the body only. */
export function serialCase(vector: FrameVector, options = optionsOf(vector)): FrameCase<SerialHead> {
  const body = bodyOf(vector)
  return {
    framing: serialFraming(options),
    side: vector.side,
    bytes: bytesOf(vector),
    head: headOf(vector),
    askedHead: headOf(vector),
    body,
    ...(vector.endCode === undefined ? {} : { endCode: vector.endCode }),
    bodyLength: lengthOf(vector),
  }
}

/** Where a body ends: known in format 1 by its command only. */
export function lengthOf(vector: FrameVector): BodyLength {
  const { frame, format } = optionsOf(vector)
  if (format !== 1 || vector.side === 'response') {
    return () => {
      throw new Error('a frame with an end asked for a length')
    }
  }
  if (frame !== '1C') return (_head, soFar) => slmp(vector).requestLength(soFar)
  const protocol = oneCProtocol({ framing: serialFraming(optionsOf(vector)), head: headOf(vector) })
  return (head, soFar) => protocol.requestLength(head, soFar)
}

/** The protocol of a 3C or 4C vector. */
export function slmp(vector: FrameVector): MelsecProtocol<SerialHead> {
  const framing = serialFraming(optionsOf(vector))
  return new MelsecProtocol({ framing, head: headOf(vector), profile, code: vector.code })
}

/** Command, subcommand and data, or response data: of 3C and 4C from their message, of 1C as it is printed. */
export function bodyOf(vector: FrameVector): Buffer {
  if (vector.frame.startsWith('1C')) return printedBody(vector)
  const { code, form = 'short', side, message, request } = vector
  const command = commands[vector.command as CommandName]
  const writer = writerOf(code, FORM_BITS[form])
  if (side === 'request') {
    writer.uint(command.code, 2)
    writer.uint(subcommandOf(command, form, profile), 2)
    encode<Shape>(command.request, message ?? {}, writer)
  } else if (message !== undefined) {
    const context: Context = { shape: command.request, message: request ?? {} }
    encode<Shape>(command.response, message, writer, context)
  }
  return writer.take()
}

const [STX, ETX, ACK, NAK] = [2, 3, 6, 0x15]

/** What stands between the route of a 1C frame (4 characters) and what ends it. */
function printedBody(vector: FrameVector): Buffer {
  const bytes = bytesOf(vector)
  const [start] = bytes
  if (start === ACK || start === NAK) return Buffer.alloc(0)
  const behind = (vector.frame === '1C4' ? 2 : 0) + (vector.sumCheck === true ? 2 : 0)
  return bytes.subarray(5, start === STX ? bytes.indexOf(ETX ?? 0) : bytes.length - behind)
}
