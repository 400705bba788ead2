// From what a request is to read to a request that can be sent again and again, and from its answer to bytes in a row.

import { hex } from '../../basics/hex'
import { octal } from '../../basics/octal'
import type { JwCommand } from '../../jw/commands/commands'
import { jwCommands } from '../../jw/commands/commands'
import { timerValue } from '../../jw/operand/timer'
import type { Exchange } from '../../link/link'
import type { ByteType } from '../../value/byte-type'
import { valuesOfBytes } from '../../value/byte-value'
import type { ValueFormat } from '../../value/format'
import type { PlcValue } from '../../value/value'
import type { ReadPlace, ReadStepOf } from '../plan/planned-read'
import type { RequestDescription, SendExchange } from '../plan/request'
import type { ParsedJwItem } from './item'
import { CELL, extendedIn, headIn, type JwPiece, type JwSpace } from './layout'
import type { ListProof } from './list-proof'
import type { JwProtocol } from './send-command'

/** Cells in a row that are asked for, and what lies in them. */
export interface JwRun {
  readonly space: JwSpace
  readonly from: number
  readonly to: number
  readonly pieces: readonly JwPiece[]
}

/** One request to be: cells in a row, or bytes that are scattered. */
export type JwDraft =
  | { readonly kind: 'row'; readonly run: JwRun }
  | { readonly kind: 'list'; readonly runs: readonly JwRun[] }

/** What a request is answered with. */
export interface JwCells {
  /** Bytes in a row; of timers none. */
  readonly bytes: Uint8Array
  /** Of timers. */
  readonly words?: readonly number[]
  readonly attributes?: Uint8Array
}

/** Where the values of a piece stand in an answer. */
export interface JwValuePlace extends ReadPlace {
  readonly parsed: ParsedJwItem
  /** Bit of the answer; of timers the number times 8. */
  readonly at: number
  readonly count: number
}

/** One request of a plan. */
export interface JwReadStep extends ReadStepOf<JwCells, JwValuePlace> {
  readonly prepared: JwPreparedRead
  readonly pieces: readonly JwPiece[]
  readonly draft: JwDraft
}

/** A request as it is sent. */
export interface JwPrepared {
  readonly command: JwCommand
  readonly exchange: Exchange<unknown>
  readonly points: number
  /** What it does, without the command. */
  readonly text: string
}

/** A request that reads. */
export interface JwPreparedRead extends JwPrepared {
  fetch(send: SendExchange): Promise<JwCells>
}

/** Segment of the system memory. */
export const SYSTEM = 8

export function jwReadStep(
  protocol: JwProtocol,
  draft: JwDraft,
  items: readonly (ParsedJwItem | undefined)[],
  lists: ListProof,
): JwReadStep {
  const runs = draft.kind === 'row' ? [draft.run] : draft.runs
  const places: JwValuePlace[] = []
  let before = 0
  for (const { from, to, pieces } of runs) {
    for (const { item, part, first, count, layout } of pieces) {
      const parsed = items[item]
      const at = layout.start + first * layout.width - from * CELL + before * CELL
      if (parsed !== undefined) places.push({ item, part, parsed, at, count })
    }
    before += to - from
  }
  const prepared = draft.kind === 'row' ? row(protocol, draft.run) : list(protocol, draft.runs, lists)
  return { prepared, pieces: runs.flatMap(({ pieces }) => pieces), places, draft }
}

/** The same request, whose answer is read as something else. */
function fetching<T>(exchange: Exchange<T>, read: (answer: T) => JwCells): JwPreparedRead['fetch'] {
  const asked: Exchange<JwCells> = { ...exchange, decode: (frame) => read(exchange.decode(frame)) }
  return (send) => send(asked)
}

function row(protocol: JwProtocol, { space, from, to }: JwRun): JwPreparedRead {
  const points = to - from
  const text = `${rangeText(space, from, to)}, ${countText(points, space)}`
  if (space.in === 'timer') {
    const command = jwCommands.monitorTimersCounters
    const exchange = protocol.exchange(command, { number: from, points })
    const fetch = fetching(exchange, ({ words, attributes }) => ({ bytes: NOTHING, words, attributes }))
    return { command, exchange, points, text, fetch }
  }
  if (space.in === 'system') {
    const command = jwCommands.readSystemMemory
    const exchange = protocol.exchange(command, { segment: SYSTEM, address: from, length: points })
    return { command, exchange, points, text, fetch: fetching(exchange, ({ data }) => ({ bytes: data })) }
  }
  const command = jwCommands.readDataMemory
  const exchange = protocol.exchange(command, { head: headIn(space, from), length: points })
  return { command, exchange, points, text, fetch: fetching(exchange, ({ data }) => ({ bytes: data })) }
}

function list(protocol: JwProtocol, runs: readonly JwRun[], lists: ListProof): JwPreparedRead {
  const command = jwCommands.monitorRegisters
  const items = runs.flatMap(({ space, from, to }) =>
    Array.from({ length: to - from }, (_, i) => ({ address: extendedIn(space, from + i) })),
  )
  const exchange = protocol.exchange(command, { items })
  const text = runs.map(({ space, from, to }) => rangeText(space, from, to)).join(', ')
  const asked = fetching(exchange, ({ values }) => ({ bytes: Uint8Array.from(values) }))
  const fetch: JwPreparedRead['fetch'] = async (send) => {
    try {
      const cells = await asked(send)
      lists.proved()
      return cells
    } catch (error) {
      lists.failed(error)
      throw error
    }
  }
  return { command, exchange, points: items.length, text: `${text}, ${items.length} bytes`, fetch }
}

const NOTHING = new Uint8Array(0)

/** As a JW numbers them: `file 0, 004000 to 004003`. */
export function rangeText(space: JwSpace, from: number, to: number): string {
  const digits = space.in === 'file' ? 6 : 4
  const first = octal(from, digits)
  const range = to - from === 1 ? first : `${first} to ${octal(to - 1, digits)}`
  if (space.in === 'system') return `system memory ${range}`
  return space.in === 'timer' ? `numbers ${range}` : `file ${hex(space.file)}, ${range}`
}

export function countText(points: number, space: JwSpace): string {
  const unit = space.in === 'timer' ? 'number' : 'byte'
  return `${points} ${unit}${points === 1 ? '' : 's'}`
}

/** @throws ProtocolError BAD_FIELD when what came is no value of the type; it is about this value alone */
export function jwValueAt(cells: JwCells, { parsed, at, count }: JwValuePlace): PlcValue | PlcValue[] {
  const { operand, type, format, count: wanted } = parsed
  const { words, attributes } = cells
  const values =
    words === undefined || attributes === undefined
      ? valuesIn(cells.bytes, type, at, count, format)
      : Array.from({ length: count }, (_, i) => {
          const word = words[at / CELL + i] ?? 0
          return type.name === 'WORD' ? word : timerValue(word, attributes[at / CELL + i] ?? 0, operand.kind).value
        })
  return wanted === undefined ? (values[0] as PlcValue) : values
}

function valuesIn(bytes: Uint8Array, type: ByteType, at: number, count: number, format: ValueFormat): PlcValue[] {
  if (type.name !== 'BOOL') return valuesOfBytes(type, bytes, at / CELL, count, format)
  return Array.from({ length: count }, (_, i) => (((bytes[(at + i) >> 3] ?? 0) >> ((at + i) & 7)) & 1) === 1)
}

export function describeJw(
  { command, exchange, points, text }: JwPrepared,
  items: readonly string[],
): RequestDescription {
  const response = exchange.answerSize()
  return {
    command: command.name,
    points,
    requestBytes: exchange.write(0).length,
    ...(response === undefined ? {} : { responseBytes: response }),
    items,
    text: `${command.title} (${hex(command.code, 2)}H): ${text}`,
  }
}
