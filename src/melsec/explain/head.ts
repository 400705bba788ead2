// Words for what stands around the data of a command: route, timer, end code, command and subcommand.

import { endCodeDigits } from '../../basics/end-code-digits'
import { hex } from '../../basics/hex'
import type { Declaration } from '../../codec/codec'
import type { Leaf } from '../../codec/explanation'
import type { DeviceForm } from '../device/device-form'
import { readSubcommand } from '../device/form'
import { explained, type MelsecEndCodeFamily } from '../end-codes/end-code'
import { moduleIoNumbers, ownStation } from '../frame/route'

/** A field of a head in words, by its name; `undefined` for one that is no field of a head. */
export function describeHead({ name, value }: Leaf): string | undefined {
  if (typeof value !== 'number') return undefined
  switch (name) {
    case 'network':
      return value === ownStation.network ? '0 (network of the connected station)' : `${value}`
    case 'station':
      return value === ownStation.station ? '255 (FFH: the connected station)' : `${value} (${hex(value, 2)}H)`
    case 'pc':
      return value === 0xff ? '255 (FFH: the connected station)' : `${value} (${hex(value, 2)}H)`
    case 'moduleIo':
      return moduleIoText(value)
    case 'extensionStation':
      return extensionText(value)
    case 'multidrop':
      return value === 0 ? '0 (no multidrop station)' : `${value}`
    case 'monitoringTimer':
      return value === 0 ? '0 (the PLC waits for ever)' : `${value} (${value * 250} ms)`
    case 'serial':
      return `${value} (${hex(value, 4)}H)`
    case 'reserved':
    case 'fixedValue':
    case 'fixedValueOfStation':
    case 'systemArea':
    case 'systemAreaEnd':
      return 'fixed'
    case 'frameId':
      return `${hex(value, 2)}H (4C frame)`
    case 'responseId':
      return `${hex(value, 4)}H (answer)`
    default:
      return undefined
  }
}

function extensionText(value: number): string {
  const code = `${value} (${hex(value, 4)}H`
  // SLMP reference manual p. 23; with 0 the station field says what is meant.
  if (value === 0) return `${code}: the station field says it; behind station 124 the designated master station)`
  return value === 0xffff ? `${code}: the connected station)` : `${code})`
}

function moduleIoText(value: number): string {
  const named = moduleIoNumbers.find(({ number }) => number === value)
  return `${hex(value, 4)}H (${named?.title ?? `start I/O number ${hex(value, 3)}0H`})`
}

/** An end code in words: meaning, likely cause, remedy. */
export function endCodeText(family: MelsecEndCodeFamily, endCode: number, commandName?: string): string {
  const code = `${endCodeDigits(endCode, family)}H`
  if (endCode === 0) return `${code} (carried out)`
  return `${code} (refused${textOf(family, endCode, commandName)}`
}

function textOf(family: MelsecEndCodeFamily, endCode: number, commandName: string | undefined): string {
  const text = explained(family, { endCode, commandName })
  if (text === undefined) return '; no text is known for this code)'
  return [')', text.meaning, ...(text.cause === undefined ? [] : [text.cause]), text.remedy].join(' ')
}

const FORM_TEXT: Readonly<Record<DeviceForm, string>> = {
  short: 'device code and number in the short form',
  long: 'device code and number in the long (iQ-R) form',
  extendedShort: 'extended device specification, short form',
  extendedLong: 'extended device specification, long (iQ-R) form',
}

/** A subcommand in words; `unit` is the command's, which may not depend on devices. */
export function subcommandText(subcommand: number, unit: 'bit' | 'word' | 'none' | undefined): string {
  const code = `${hex(subcommand, 4)}H`
  if (unit === 'none') return code
  const read = readSubcommand(subcommand)
  return read === undefined ? code : `${code} (${read.unit} units, ${FORM_TEXT[read.form]})`
}

/** The command of a number in words. */
export function commandText(code: number, command: Pick<Declaration, 'title'> | undefined): string {
  return `${hex(code, 4)}H (${command?.title ?? 'no command that is known here'})`
}
