// The parameters of an option unit as COM 02H and 12H reach them, and the rule of the start switch (JW300 option unit manual,
// "Parameter setting", "Parameters" of each unit). Addresses are octal, as the manual prints them.
import { octal } from '../../basics/octal'
import { isPlainObject } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { sumOf } from '../../codec/codec'
import { RequestError } from '../../errors'

/** Where what stands among the parameters of a unit in a JW300. */
export const parameterArea = {
  /** Last address; the first is 0. */
  last: 0o3777,
  /** Made by the unit when the start switch goes from 0 to 1. */
  checkCode: 0o3776,
  startSwitch: 0o3777,
  /** Bytes that one request reads or writes. */
  longest: 1024,
} as const

/** Values of the start switch. */
export const startSwitch = {
  /** Parameters can be written, and only then. */
  stop: 0,
  /** From 0 to 1: the unit takes the parameters over. */
  start: 1,
  /** Result codes a write may get while the switch is 1: the manual prints none. Any other must be expected too. */
  likelyRefusals: [0x07, 0x10],
} as const

/** Bytes and the parameter address of the first one. */
export interface ParameterBlock {
  /** 0 to 0o3777. */
  readonly address: number
  /** From there on. */
  readonly bytes: Uint8Array
}

/** A parameter address as the manual prints it. */
export function parameterText(address: number): string {
  return octal(address, 4)
}

/**
 * Check code of the parameters 0000 to 3775. The manual calls it a sum check code and says no more, so this is an
 * assumption: the low byte of the sum. Only a simulated unit computes it; a real one does so itself.
 */
export function checkCodeOf(parameters: Uint8Array): number {
  return sumOf(parameters, 0, parameterArea.checkCode)
}

/** One request of the start switch procedure. */
export type ParameterStep =
  | { readonly kind: 'write'; readonly purpose: 'stop' | 'parameters' | 'start'; readonly block: ParameterBlock }
  | { readonly kind: 'read'; readonly purpose: 'checkCode'; readonly address: number; readonly length: number }

/**
 * The requests that bring parameters into a unit, in their order: start switch to 0, the parameters, start switch to 1,
 * check code and start switch read back. When one fails, those behind it must not be sent: with the switch at 0 the unit
 * does not start on half of its parameters.
 * @throws RequestError BAD_VALUE for blocks that are empty, overlap, leave the area or hold check code or start switch
 */
export function startProcedure(blocks: readonly ParameterBlock[]): readonly ParameterStep[] {
  checkBlocks(blocks)
  for (const { address, bytes } of blocks) {
    if (address + bytes.length <= parameterArea.checkCode) continue
    const own = `${parameterText(parameterArea.checkCode)} and ${parameterText(parameterArea.startSwitch)}`
    refuse(
      `The parameters reach ${own}: check code and start switch are written by the procedure itself. Leave them out.`,
    )
  }
  const data = blocks.flatMap(pieces).map((block) => ({ kind: 'write', purpose: 'parameters', block }) as const)
  const { checkCode, last } = parameterArea
  return [
    switched('stop'),
    ...data,
    switched('start'),
    { kind: 'read', purpose: 'checkCode', address: checkCode, length: last + 1 - checkCode },
  ]
}

function switched(purpose: 'stop' | 'start'): ParameterStep {
  const block = { address: parameterArea.startSwitch, bytes: Uint8Array.of(startSwitch[purpose]) }
  return { kind: 'write', purpose, block }
}

function pieces({ address, bytes }: ParameterBlock): ParameterBlock[] {
  const found: ParameterBlock[] = []
  for (let at = 0; at < bytes.length; at += parameterArea.longest)
    found.push({ address: address + at, bytes: bytes.subarray(at, at + parameterArea.longest) })
  return found
}

/** @throws RequestError BAD_VALUE for blocks that are empty, overlap or leave the area */
export function checkBlocks(blocks: readonly ParameterBlock[]): void {
  if (!Array.isArray(blocks)) refuse(`Parameters are a list of blocks with address and bytes, not ${shown(blocks)}.`)
  blocks.forEach(checkBlock)
  const sorted = [...blocks].sort((one, other) => one.address - other.address)
  sorted.forEach((block, i) => {
    const next = sorted[i + 1]
    if (next === undefined || block.address + block.bytes.length <= next.address) return
    refuse(`Two blocks of parameters hold address ${parameterText(next.address)}. Give each address once.`)
  })
}

function checkBlock(block: ParameterBlock): void {
  if (!isPlainObject(block) || !(block.bytes instanceof Uint8Array) || !Number.isInteger(block.address))
    refuse(`A block of parameters is an object with address (a whole number) and bytes, not ${shown(block)}.`)
  const { address, bytes } = block
  if (bytes.length === 0) refuse(`The block at address ${parameterText(address)} has no bytes. Leave it out.`)
  if (address >= 0 && address + bytes.length - 1 <= parameterArea.last) return
  const end = `0000 to ${parameterText(parameterArea.last)} octal`
  refuse(`Parameters have the addresses ${end}; ${bytes.length} bytes from ${shown(address)} on leave them.`)
}

function refuse(message: string): never {
  throw new RequestError('BAD_VALUE', message)
}

/** What was the first parameter address of a JW-22CM or JW-21MN in a JW20H or JW30H is the first in a JW300. */
const CLASSIC_FIRST = 0o4000

/**
 * Parameter address in a JW300 of one that the manuals of JW-22CM and JW-21MN print: 4000 to 7777 octal are 0000 to 3777.
 * @throws RequestError OUT_OF_RANGE
 * @example fromClassicAddress(0o4012)   // 0o0012
 */
export function fromClassicAddress(classic: number): number {
  const address = classic - CLASSIC_FIRST
  if (Number.isInteger(address) && address >= 0 && address <= parameterArea.last) return address
  const range = `${parameterText(CLASSIC_FIRST)} to ${parameterText(CLASSIC_FIRST + parameterArea.last)} octal`
  throw new RequestError(
    'OUT_OF_RANGE',
    `A JW-22CM or JW-21MN has the classic parameter addresses ${range}, not ${shown(classic)}.`,
  )
}

/**
 * The address that the manuals of JW-22CM and JW-21MN print for a parameter address in a JW300.
 * @throws RequestError OUT_OF_RANGE
 */
export function toClassicAddress(address: number): number {
  if (Number.isInteger(address) && address >= 0 && address <= parameterArea.last) return address + CLASSIC_FIRST
  const range = `0000 to ${parameterText(parameterArea.last)} octal`
  throw new RequestError(
    'OUT_OF_RANGE',
    `A unit in a JW300 has the parameter addresses ${range}, not ${shown(address)}.`,
  )
}
