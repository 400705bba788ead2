// From a batch to what is sent.
import { hex } from '../../basics/hex'
import { EndCodeError, PlcError, UnfinishedError } from '../../errors'
import type { JwCommand } from '../../jw/commands/commands'
import { jwCommands } from '../../jw/commands/commands'
import { type Exchange, endedWith } from '../../link/link'
import { beforeWriting } from '../plan/before-writing'
import type { SendExchange } from '../plan/request'
import type { RunStep } from '../plan/write-run'
import { extendedIn, headIn, type JwSpace } from './layout'
import type { ListProof } from './list-proof'
import { countText, type JwPrepared, rangeText, SYSTEM } from './read-request'
import type { JwProtocol } from './send-command'
import { bitsOfUnit, type JwBatch } from './write-batch'
import type { JwWriteUnit } from './write-unit'

/** One write, ready to be sent. */
export interface JwWriteStep extends RunStep {
  readonly units: readonly JwWriteUnit[]
  /** What it sends: the write, and before it the read of a byte that is written back. */
  readonly prepared: readonly JwPrepared[]
  /** Whether it is a list. */
  readonly isList: boolean
}

export interface JwWriteContext {
  readonly protocol: JwProtocol
  readonly lists: ListProof
}

/** @throws RequestError when the request cannot be sent */
export function jwWriteStep(context: JwWriteContext, { kind, units }: JwBatch): JwWriteStep {
  switch (kind) {
    case 'row':
      return sending(units, row(context.protocol, units))
    case 'timer':
      return sending(units, timer(context.protocol, firstOf(units)))
    case 'registers':
      return registers(context, units)
    case 'relays':
      return relays(context, units)
    case 'masked':
      return masked(context.protocol, firstOf(units))
    default:
      return kind satisfies never
  }
}

function sending(units: readonly JwWriteUnit[], prepared: JwPrepared): JwWriteStep {
  const perform = async (send: SendExchange) => {
    try {
      await send(prepared.exchange)
    } catch (error) {
      throw prepared.points === 1 ? wholly(error, prepared.command) : error
    }
  }
  return { units, prepared: [prepared], isList: false, perform }
}

/**
 * A code about an address leaves open what became of the elements in front of it. Where there is one element, there is nothing in
 * front: nothing was done.
 */
function wholly(error: unknown, { title, name }: JwCommand): unknown {
  if (!(error instanceof EndCodeError) || error.about !== 'item' || error.outcome !== 'unknown') return error
  const { endCode, meaning, remedy } = error
  const facts = { family: 'jw', about: 'item', carriedOut: false, command: title, commandName: name } as const
  const texts = { ...(meaning === undefined ? {} : { meaning }), ...(remedy === undefined ? {} : { remedy }) }
  const sentences = [meaning, remedy].filter((text) => text !== undefined).join(' ')
  const message = `${title} ${endedWith(facts, `result code ${hex(endCode, 2)}H`)}. ${sentences}`
  return new EndCodeError(endCode, message, { ...facts, ...texts })
}

function firstOf(units: readonly JwWriteUnit[]): JwWriteUnit {
  const [first] = units
  if (first === undefined) throw new Error('a request without anything to write')
  return first
}

/** Fewest bytes that are shorter as one byte and how often. */
const FILLED = 2

function row(protocol: JwProtocol, units: readonly JwWriteUnit[]): JwPrepared {
  const { space } = firstOf(units)
  const ordered = [...units].sort((a, b) => a.from - b.from)
  const { from } = firstOf(ordered)
  const data = Buffer.concat(ordered.map(({ content }) => (content.kind === 'bytes' ? content.bytes : NOTHING)))
  const points = data.length
  const text = `${rangeText(space, from, from + points)}, ${countText(points, space)}`
  if (space.in === 'system') {
    const exchange = protocol.exchange(jwCommands.writeSystemMemory, { segment: SYSTEM, address: from, data })
    return { command: jwCommands.writeSystemMemory, exchange, points, text }
  }
  const head = headIn(space, from)
  const [byte = 0] = data
  if (points >= FILLED && data.every((other) => other === byte)) {
    const exchange = protocol.exchange(jwCommands.fillDataMemory, { head, length: points, value: byte })
    return { command: jwCommands.fillDataMemory, exchange, points, text }
  }
  const exchange = protocol.exchange(jwCommands.writeDataMemory, { head, data })
  return { command: jwCommands.writeDataMemory, exchange, points, text }
}

const NOTHING = new Uint8Array(0)

function timer(protocol: JwProtocol, { space, from, to, content }: JwWriteUnit): JwPrepared {
  const command = jwCommands.setTimerCounter
  const isSet = content.kind === 'timer' && content.isSet
  const exchange = protocol.exchange(command, { number: from, value: Number(isSet) })
  return { command, exchange, points: 1, text: `${isSet ? 'set' : 'reset'} ${rangeText(space, from, to)}` }
}

function registers(context: JwWriteContext, units: readonly JwWriteUnit[]): JwWriteStep {
  const items = units.flatMap(({ space, from, content }) =>
    content.kind === 'bytes'
      ? Array.from(content.bytes, (value, i) => ({ address: extendedIn(space, from + i), value }))
      : [],
  )
  const command = jwCommands.writeRegisters
  const exchange = context.protocol.exchange(command, { items })
  const single = units.map((unit) => row(context.protocol, [unit]))
  const prepared = { command, exchange, points: items.length, text: textOf(units, items.length) }
  return listed(context, units, prepared, single)
}

function textOf(units: readonly JwWriteUnit[], count: number): string {
  const ranges = units.map(({ space, from, to }) => rangeText(space, from, to))
  return `${ranges.join(', ')}, ${count} byte${count === 1 ? '' : 's'}`
}

/** One relay, or a list of them. */
function relays(context: JwWriteContext, units: readonly JwWriteUnit[]): JwWriteStep {
  const { protocol } = context
  const bits = units.flatMap((unit) => bitsOfUnit(unit).map((bit) => ({ ...bit, space: unit.space })))
  const single = bits.map(({ space, address, bit, value }): JwPrepared => {
    const command = jwCommands.setRelay
    const exchange = protocol.exchange(command, { address: headIn(space, address), bit, value })
    return { command, exchange, points: 1, text: `${value === 1 ? 'set' : 'reset'} ${bitText(space, address, bit)}` }
  })
  const [only] = single
  if (single.length === 1 && only !== undefined) return sending(units, only)
  const command = jwCommands.setRelays
  const items = bits.map(({ space, address, bit, value }) => ({ address: extendedIn(space, address), bit, value }))
  const exchange = protocol.exchange(command, { items })
  const relayTexts = bits.map(({ space, address, bit }) => bitText(space, address, bit)).join(', ')
  const text = `${relayTexts}, ${items.length} relays`
  return listed(context, units, { command, exchange, points: items.length, text }, single)
}

function bitText(space: JwSpace, address: number, bit: number): string {
  return `${rangeText(space, address, address + 1)}.${bit}`
}

/** @throws UnfinishedError when one fails behind others that were written */
async function oneByOne(single: readonly JwPrepared[], send: SendExchange): Promise<void> {
  for (const [at, { exchange, text }] of single.entries()) {
    try {
      await send(exchange)
    } catch (error) {
      if (!(error instanceof PlcError) || at === 0) throw error
      const message = `The first ${at} of ${single.length} requests were carried out, and then not ${text}: ${error.message}`
      throw new UnfinishedError(message, error)
    }
  }
}

/**
 * A list: nothing is written by one before one was read, which shows how the PLC understands them.
 * @param single the same one by one, where the PLC has turned out to have no lists since this was planned
 */
function listed(
  { protocol, lists }: JwWriteContext,
  units: readonly JwWriteUnit[],
  prepared: JwPrepared,
  single: readonly JwPrepared[],
): JwWriteStep {
  const proof = proofOf(protocol, units)
  return {
    units,
    prepared: [prepared],
    isList: true,
    perform: async (send) => {
      if (!lists.mayBeUsed) return oneByOne(single, send)
      if (!lists.isProved) await prove(lists, proof, prepared, send)
      await send(prepared.exchange)
    },
  }
}

/** Reads two of the bytes that are to be written, by a list. */
function proofOf(protocol: JwProtocol, units: readonly JwWriteUnit[]): Exchange<unknown> {
  const addresses = units.flatMap(({ space, from, to }) =>
    Array.from({ length: to - from }, (_, i) => extendedIn(space, from + i)),
  )
  const [first] = addresses
  const last = addresses.at(-1)
  if (first === undefined || last === undefined) throw new Error('a list of nothing')
  return protocol.exchange(jwCommands.monitorRegisters, { items: [{ address: first }, { address: last }] })
}

async function prove(
  lists: ListProof,
  proof: Exchange<unknown>,
  prepared: JwPrepared,
  send: SendExchange,
): Promise<void> {
  try {
    await send(proof)
    lists.proved()
  } catch (error) {
    if (!(error instanceof EndCodeError)) {
      lists.failed(error)
      return beforeWriting(Promise.reject(error))
    }
    lists.refusedBy(error)
    throw refusedBefore(error, prepared)
  }
}

/** Nothing was written, and each item may be written alone. */
function refusedBefore({ endCode, message: why }: EndCodeError, { command }: JwPrepared): EndCodeError {
  const message = `${command.title} was not sent, because the PLC did not read a list of what it writes. ${why}`
  return new EndCodeError(endCode, message, {
    family: 'jw',
    about: 'item',
    carriedOut: false,
    command: command.title,
    commandName: command.name,
  })
}

/** Bits of one byte of the system memory. */
function masked(protocol: JwProtocol, unit: JwWriteUnit): JwWriteStep {
  const { space, from } = unit
  const read = protocol.exchange(jwCommands.readSystemMemory, { segment: SYSTEM, address: from, length: 1 })
  const write = (byte: number) =>
    protocol.exchange(jwCommands.writeSystemMemory, { segment: SYSTEM, address: from, data: Buffer.of(byte) })
  const bits = bitsOfUnit(unit)
  const text = rangeText(space, from, from + 1)
  const described = (command: JwCommand, exchange: Exchange<unknown>): JwPrepared => ({
    command,
    exchange,
    points: 1,
    text,
  })
  return {
    units: [unit],
    prepared: [described(jwCommands.readSystemMemory, read), described(jwCommands.writeSystemMemory, write(0))],
    isList: false,
    perform: async (send) => {
      const { data } = await beforeWriting(send(read))
      let byte = data[0] ?? 0
      for (const { bit, value } of bits) byte = value === 1 ? byte | (1 << bit) : byte & ~(1 << bit) & 0xff
      await send(write(byte))
    },
  }
}

/** Cells that are read before they are written: nobody else may write meanwhile. */
export function changesBits(units: readonly JwWriteUnit[]): boolean {
  return units.some(({ content, space }) => content.kind === 'bits' && space.in === 'system')
}
