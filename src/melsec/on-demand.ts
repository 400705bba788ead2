// On-demand as a body: command, subcommand and data, from both sides (SLMP reference manual 5.11).
import { hex } from '../basics/hex'
import { type DataCode, decode, encode, readerOf, type Shape, writerOf } from '../codec/codec'
import { unsolicitedCommands } from './commands/on-demand'

const { onDemand } = unsolicitedCommands
/** It does not depend on devices, so that the subcommand has no bits. */
const SUBCOMMAND = 0

/**
 * The data of a frame that came unasked.
 * @param reserved what the frame has between subcommand and data
 * @returns bytes, low byte of each word first
 * @throws ProtocolError when it is not On-demand, or its data are too long or no whole digits
 */
export function readOnDemand(code: DataCode, body: Buffer, reserved: Shape = {}): Uint8Array {
  const head = readerOf(code, body)
  const command = head.uint(2)
  if (command !== onDemand.code) head.fail('BAD_FIELD', `${named(command)} is not ${named(onDemand.code)}, On-demand`)
  const subcommand = head.uint(2)
  if (subcommand !== SUBCOMMAND) head.fail('BAD_FIELD', `On-demand has no sub${named(subcommand)}`)
  decode(reserved, head)
  const { data } = decode(onDemand.request, head)
  head.end()
  return data
}

/**
 * The body that a PLC sends.
 * @param data bytes, low byte of each word first
 * @throws RequestError BAD_MESSAGE
 */
export function writeOnDemand(code: DataCode, data: Uint8Array, reserved: Shape = {}): Buffer {
  const writer = writerOf(code)
  writer.uint(onDemand.code, 2)
  writer.uint(SUBCOMMAND, 2)
  encode(reserved, {}, writer)
  encode(onDemand.request, { data }, writer)
  return writer.take()
}

function named(code: number): string {
  return `command ${hex(code, 4)}H`
}
