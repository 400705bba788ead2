// On-demand from the simulated PLC: what a program in it would send, to clients that asked for nothing.
import type { DataCode } from '../codec/codec'
import { RequestError } from '../errors'
import { bytesOfWords } from '../melsec/commands/on-demand'
import type { EthernetFrameName } from '../melsec/frame/frames'
import { ownStation } from '../melsec/frame/route'
import type { SlmpHead } from '../melsec/frame/slmp-frame'
import { writeOnDemand } from '../melsec/on-demand'
import type { AnyHead } from './any-frame'

/** Bytes, low byte of each word first; or words, 0 to 65535 each. */
export type OnDemandData = Uint8Array | readonly number[]

/** Who gets data that are sent unasked. */
export interface OnDemandOptions {
  /** Numbers of the connections that get it, see `connections`. Default: all. */
  readonly connections?: readonly number[]
}

/** @throws RequestError BAD_VALUE when it is neither bytes nor words, BAD_MESSAGE when no frame can carry it */
export function onDemandBytes(data: OnDemandData, code: DataCode): Uint8Array {
  const bytes = data instanceof Uint8Array ? Uint8Array.from(data) : bytesOfWords(wordsOf(data))
  // What cannot be sent is refused before anybody gets anything.
  writeOnDemand(code, bytes)
  return bytes
}

function wordsOf(given: unknown): readonly number[] {
  const list: readonly unknown[] | undefined = Array.isArray(given) ? Array.from<unknown>(given) : undefined
  const words = list?.filter((word): word is number => isWord(word))
  if (words !== undefined && words.length === list?.length) return words
  const message = 'The data of On-demand are bytes (Uint8Array) or an array of words, whole numbers from 0 to 65535.'
  throw new RequestError('BAD_VALUE', message, 'data')
}

function isWord(given: unknown): boolean {
  return typeof given === 'number' && Number.isInteger(given) && given >= 0 && given <= 0xffff
}

/** The connections that were chosen. @throws RequestError BAD_OPTION for one that is not there */
export function chosen<C extends { readonly id: number }>(all: Iterable<C>, { connections }: OnDemandOptions): C[] {
  const there = [...all]
  if (connections === undefined) return there
  return connections.map((id) => {
    const found = there.find((connection) => connection.id === id)
    if (found !== undefined) return found
    const ids = there.map((connection) => connection.id).join(', ') || 'none'
    throw new RequestError('BAD_OPTION', `There is no connection ${String(id)}; there are ${ids}.`, 'connections')
  })
}

/** What stands in front of a body that nobody asked for. A 1E frame cannot carry one. */
export function unaskedHead(frame: EthernetFrameName): Extract<AnyHead, { readonly head: SlmpHead }> | undefined {
  return frame === '1E' ? undefined : { frame, head: { ...ownStation, timer: 0 } }
}
