// From a batch to what is sent: one Write, Write Random or Write Block, or a Read and a Write for bits of words.

import type { Exchange } from '../../link/link'
import { commands } from '../../melsec/commands/commands'
import type { AddressOptions } from '../../melsec/device/address'
import { type Area, addressAt } from './area'
import { beforeWriting } from './before-writing'
import type { Stretch } from './chunk'
import type { Areas } from './layout'
import type { PlanProtocol } from './limit'
import {
  blocksText,
  type Prepared,
  pointsText,
  prepareRead,
  rangeText,
  type SendExchange,
  wordsOfBits,
} from './request'
import type { Batch } from './write-batch'
import type { WriteUnit } from './write-unit'

/** One write, ready to be sent. */
export interface WriteStep {
  readonly units: readonly WriteUnit[]
  /** What it sends: the write, and before it the read of words that are written back. */
  readonly prepared: readonly Prepared[]
  /** Rejects with an error whose outcome is that of the write. */
  perform(send: SendExchange): Promise<void>
}

export interface WriteContext {
  readonly protocol: PlanProtocol
  /** Areas as they are read, for words that are read before they are written. */
  readonly readAreas: Areas
  readonly options: AddressOptions
}

/** @throws RequestError when the request cannot be sent. */
export function prepareWrite(context: WriteContext, batch: Batch): WriteStep {
  if (batch.kind === 'masked') return readModifyWrite(context, batch.units)
  const prepared = preparedOf(context, batch)
  const { exchange } = prepared
  return {
    units: batch.units,
    prepared: [prepared],
    perform: async (send) => {
      await send(exchange)
    },
  }
}

function preparedOf(context: WriteContext, { kind, units, words }: Batch): Prepared {
  if (kind === 'block') return blocks(context, units)
  if (kind === 'random') return random(context, units)
  return direct(context, words === undefined ? rowOf(units) : inWords(rowOf(units), words))
}

/** Cells in a row and what they are set to. */
interface WrittenRow {
  readonly area: Area
  readonly from: number
  readonly to: number
  readonly bits: readonly boolean[]
  readonly words: readonly number[]
}

function rowOf(units: readonly WriteUnit[]): WrittenRow {
  const ordered = [...units].sort((a, b) => a.from - b.from)
  const from = ordered[0]?.from ?? 0
  return {
    area: areaOf(units),
    from,
    to: ordered.at(-1)?.to ?? from,
    bits: ordered.flatMap(({ content }) => (content.kind === 'bits' ? content.bits : [])),
    words: ordered.flatMap(({ content }) => (content.kind === 'words' ? content.words : [])),
  }
}

/** Bits from a multiple of sixteen on as the words they are. */
function inWords({ from, to, bits }: WrittenRow, area: Area): WrittenRow {
  return { area, from: from / 16, to: to / 16, bits: [], words: wordsOfBits(bits) }
}

function direct({ protocol, options }: WriteContext, { area, from, to, bits, words }: WrittenRow): Prepared {
  const head = addressAt(area, from)
  const points = area.kind === 'bit' ? bits.length : words.length
  const text = `${rangeText(area, from, to, options)}, ${pointsText(points)}`
  const { form } = area.ways
  return area.kind === 'bit'
    ? {
        command: 'writeBits',
        form,
        points,
        text,
        exchange: protocol.exchange(commands.writeBits, { head, values: bits }),
      }
    : {
        command: 'writeWords',
        form,
        points,
        text,
        exchange: protocol.exchange(commands.writeWords, { head, values: words }),
      }
}

function blocks({ protocol }: WriteContext, units: readonly WriteUnit[]): Prepared {
  const rows = rowsOf(units)
  const lists = { wordBlocks: listed(rows, 'wordBlocks'), bitBlocks: listed(rows, 'bitBlocks') }
  const { wordBlocks, bitBlocks } = lists
  const points = rows.reduce((sum, { words }) => sum + words.length, 0)
  return {
    command: 'writeBlock',
    form: areaOf(units).ways.form,
    points,
    text: blocksText(wordBlocks.length, bitBlocks.length, points),
    exchange: protocol.exchange(commands.writeBlock, lists),
  }
}

/** Units that are neighbours as one row. */
function rowsOf(units: readonly WriteUnit[]): WrittenRow[] {
  const byArea = new Map<Area, WriteUnit[]>()
  for (const unit of units) byArea.set(unit.area, [...(byArea.get(unit.area) ?? []), unit])
  return [...byArea.values()].flatMap((own) => {
    const rows: WriteUnit[][] = []
    let end = Number.NaN
    for (const unit of own.sort((a, b) => a.from - b.from)) {
      if (unit.from === end) rows.at(-1)?.push(unit)
      else rows.push([unit])
      end = unit.to
    }
    return rows.map(rowOf)
  })
}

function listed(rows: readonly WrittenRow[], list: 'wordBlocks' | 'bitBlocks') {
  return rows
    .filter(({ area }) => area.ways.block === list)
    .map(({ area, from, words }) => ({ head: addressAt(area, from), values: words }))
}

function random({ protocol }: WriteContext, units: readonly WriteUnit[]): Prepared {
  const { form } = areaOf(units).ways
  const bits = units.flatMap(({ area, from, content }) =>
    content.kind === 'bits' ? content.bits.map((value, i) => ({ device: addressAt(area, from + i), value })) : [],
  )
  if (bits.length > 0) {
    return {
      command: 'writeRandomBits',
      form,
      points: bits.length,
      text: pointsText(bits.length, 'bit'),
      exchange: protocol.exchange(commands.writeRandomBits, { bits }),
    }
  }
  const scattered = units.map(scatter)
  const words = scattered.flatMap((one) => one.words)
  const doubleWords = scattered.flatMap((one) => one.doubleWords)
  return {
    command: 'writeRandomWords',
    form,
    points: words.length + doubleWords.length,
    text: `${pointsText(words.length, 'word')}, ${pointsText(doubleWords.length, 'double word')}`,
    exchange: protocol.exchange(commands.writeRandomWords, { words, doubleWords }),
  }
}

type DeviceValue = { readonly device: ReturnType<typeof addressAt>; readonly value: number }

/** Words in pairs, so that the PLC writes the two words of a number in one step. */
function scatter({ area, from, content }: WriteUnit): { words: DeviceValue[]; doubleWords: DeviceValue[] } {
  const found: { words: DeviceValue[]; doubleWords: DeviceValue[] } = { words: [], doubleWords: [] }
  if (content.kind !== 'words') return found
  const { words } = content
  for (let at = 0; at < words.length; at += 2) {
    const device = addressAt(area, from + (area.kind === 'record' ? at / 2 : at))
    const low = words[at] ?? 0
    const high = words[at + 1]
    if (high === undefined) found.words.push({ device, value: low })
    else found.doubleWords.push({ device, value: low + high * 0x10000 })
  }
  return found
}

function areaOf(units: readonly WriteUnit[]): Area {
  const area = units[0]?.area
  if (area === undefined) throw new Error('a request without a unit')
  return area
}

/** One word of which some bits are set. */
interface MaskedWord {
  readonly area: Area
  readonly cell: number
  mask: number
  word: number
}

function maskedWords(units: readonly WriteUnit[]): MaskedWord[] {
  const found = new Map<string, MaskedWord>()
  for (const { area, from, content } of units) {
    if (content.kind !== 'masked') continue
    content.masks.forEach((mask, i) => {
      const key = `${area.key} ${from + i}`
      const known = found.get(key)
      const word = content.words[i] ?? 0
      if (known === undefined) found.set(key, { area, cell: from + i, mask, word })
      else {
        known.mask |= mask
        known.word |= word
      }
    })
  }
  return [...found.values()]
}

function readModifyWrite(context: WriteContext, units: readonly WriteUnit[]): WriteStep {
  const { protocol, readAreas, options } = context
  const targets = maskedWords(units)
  const runs = targets.map(({ area, cell }): Stretch => {
    // Cell 0, because cells of a modified address are counted from it.
    const readArea = readAreas.find('word', addressAt(area, 0))
    return { area: readArea, from: cell, to: cell + 1, members: [] }
  })
  const row = inRow(targets, runs)
  const read = prepareRead(
    protocol,
    row === undefined ? { kind: 'random', runs } : { kind: 'direct', run: row },
    options,
  )
  const write = (words: readonly number[]) =>
    row === undefined
      ? protocol.exchange(commands.writeRandomWords, {
          words: targets.map(({ area, cell }, i) => ({ device: addressAt(area, cell), value: words[i] ?? 0 })),
          doubleWords: [],
        })
      : protocol.exchange(commands.writeWords, { head: addressAt(areaOf(units), row.from), values: words })
  return {
    units,
    prepared: [read, describedWrite(units, row === undefined, write(targets.map(() => 0)), targets.length)],
    perform: async (send) => {
      const words = await beforeWriting(read.fetch(send))
      await send(write(targets.map(({ mask, word }, i) => ((words[i] ?? 0) & ~mask & 0xffff) | word)))
    },
  }
}

function describedWrite(
  units: readonly WriteUnit[],
  isRandom: boolean,
  exchange: Exchange<unknown>,
  points: number,
): Prepared {
  return {
    command: isRandom ? 'writeRandomWords' : 'writeWords',
    form: areaOf(units).ways.form,
    points,
    text: `${pointsText(points, 'word')} with changed bits`,
    exchange,
  }
}

/** The words as one row, when they are one that Read and Write can take. */
function inRow(targets: readonly MaskedWord[], runs: readonly Stretch[]): Stretch | undefined {
  const [first] = runs
  const [target] = targets
  if (first === undefined || target === undefined) return undefined
  if (target.area.ways.direct === undefined || first.area.ways.direct === undefined) return undefined
  const isRow = runs.every(({ area, from }, i) => area === first.area && from === first.from + i)
  return isRow ? { ...first, to: first.from + runs.length } : undefined
}
