// What fits the fields of a request and must not be sent all the same.

import { hex } from '../basics/hex'
import { octal } from '../basics/octal'
import { type Declaration, type Message, sizeIn } from '../codec/codec'
import { RequestError } from '../errors'
import { type JwAddress, lastAddress } from './address'
import type { Extent, JwDeclaration, JwModel } from './commands/command'

/** A command, with what is declared of it here. */
type Sendable = Declaration & Partial<Pick<JwDeclaration, 'models' | 'extent'>>

const NAMES: Readonly<Record<JwModel, string>> = { jw300: 'a JW300', jw30h: 'JW20H and JW30H' }

/**
 * @throws RequestError UNSUPPORTED for what the model does not have, OUT_OF_RANGE for what ends behind its area. What does
 * not fit the fields is left to the encoder.
 */
export function checkSendable(command: Sendable, message: Message, model: JwModel): void {
  if (command.models?.includes(model) === false) refuse(`${titleOf(command)} does not exist on ${NAMES[model]}`)
  if (model !== 'jw300') checkAddresses(message, model)
  if (command.extent !== undefined) checkExtent(command.extent, message)
}

/** Segments of the program (JW-20FL5 manual, 9-34: COM 04H). On a JW300 they are file registers. */
const PROGRAM: readonly number[] = [0x08, 0x09]

/** Why a file holds no data in a model; `undefined`: it may. */
export function noDataIn(file: number, model: JwModel): string | undefined {
  if (model === 'jw300' || !PROGRAM.includes(file)) return undefined
  return `file ${hex(file, 2)}H is the program memory of ${NAMES[model]}, and no data`
}

function checkAddresses(message: Message, model: JwModel): void {
  for (const [name, value] of Object.entries(message)) {
    if (!isAddress(value)) continue
    if (value.extended === true) refuse(`${name}: ${NAMES[model]} do not know extended addresses`, name)
    const why = noDataIn(value.file, model)
    if (why !== undefined) throw new RequestError('OUT_OF_RANGE', `${name}: ${why}`, name)
  }
}

function titleOf({ title, code }: Declaration): string {
  return `${title} (${hex(code, 2)}H)`
}

function isAddress(given: unknown): given is JwAddress {
  return typeof given === 'object' && given !== null && 'file' in given && 'address' in given
}

/** Where nothing is printed about the next file, a request does not run into it. */
function checkExtent({ first, size, end }: Extent, message: Message): void {
  const head = message[first]
  const from = isAddress(head) ? head.address : head
  const behind = isAddress(head) ? (lastAddress(head) ?? 0) + 1 : end
  const count = sizeIn(message[size])
  if (typeof from !== 'number' || behind === undefined || count === undefined || from + count <= behind) return
  throw new RequestError(
    'OUT_OF_RANGE',
    `${first}: ${count} byte(s) from ${octal(from, 4)} on go past ${octal(behind - 1, 4)} (octal), the last there is`,
    first,
  )
}

function refuse(message: string, field?: string): never {
  throw new RequestError('UNSUPPORTED', message, field)
}
