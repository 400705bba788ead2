// What stands behind the head of a 3E, 4E or 4C frame, in words: the same in all of them.

import { hex } from '../../basics/hex'
import { type Context, type DataCode, hasSecret, type Message, type Shape } from '../../codec/codec'
import { type AnnotatedRow, type Annotation, annotate, type Explainer, type Leaf } from '../../codec/explanation'
import type { Command } from '../commands/command'
import { FORM_XY_OCTAL, FORM_ZR_HEX } from '../device/codec'
import { type DeviceName, deviceInfo } from '../device/device'
import type { DeviceForm } from '../device/device-form'
import { codecBits, findCommand } from '../device/form'
import { devicesOf as usedDevices } from '../device/uses'
import { type BodyLayout, commandFields, plainBody } from '../frame/body'
import type { Profile } from '../profiles/profile'
import { commandText, describeHead, subcommandText } from './head'
import { describeValue, devicesOf, type Placed, splitRow, summaryOf, type WordsFor } from './values'

/** What is known before a frame is read. */
export interface ExplainSettings extends WordsFor {
  readonly code: DataCode
  readonly profile: Profile
  readonly asciiXy: 'octal' | 'hexadecimal' | undefined
  readonly asciiZr: 'decimal' | 'hexadecimal' | undefined
  readonly commands: Readonly<Record<string, Command>>
  /** What stands around the data; default as in 3E and 4E. */
  readonly body?: BodyLayout
}

/** A request as far as its answer needs it. */
export interface KnownRequest {
  readonly command: Command
  /** Bits of the value codecs. */
  readonly form: number
  readonly message: Message
}

interface Recognised {
  readonly command: Command
  readonly form: DeviceForm
  readonly subcommand: number
}

/** The command that a command and a subcommand number name. */
function recognise({ commands, profile }: ExplainSettings, code: number, subcommand: number): Recognised | undefined {
  const found = findCommand(commands, profile, code, subcommand)
  return found === undefined ? undefined : { ...found, subcommand }
}

/** Digits of X, Y and ZR in ASCII code are a setting of the port: bits of the value codecs. */
function digitBits({ code, profile, asciiXy, asciiZr }: ExplainSettings): number {
  if (code !== 'ascii') return 0
  const octal = asciiXy === undefined ? profile.xyRadix === 8 : asciiXy === 'octal'
  return (octal ? FORM_XY_OCTAL : 0) | (asciiZr === 'hexadecimal' ? FORM_ZR_HEX : 0)
}

/** The body of a request read without words, for the answer to it; `undefined` when it is none. */
export function readRequestBody(body: Buffer, settings: ExplainSettings): KnownRequest | undefined {
  const { code } = settings
  const head = annotate({ ...commandFields, ...reservedOf(settings) }, body, { code })
  const found = recognise(settings, Number(head.message.command), Number(head.message.subcommand))
  if (head.fault !== undefined || found === undefined) return undefined
  const form = codecBits(found.command, found.form, found.subcommand) | digitBits(settings)
  const data: Annotation = annotate(found.command.request, body.subarray(head.used), { code, form })
  return data.fault === undefined ? { command: found.command, form, message: data.message } : undefined
}

function reservedOf({ body = plainBody }: ExplainSettings): Shape {
  return body.reserved
}

/** What a body turned out to be. */
export interface ExplainedBody {
  readonly command: Command | undefined
  /** e.g. `Read (word units), D100, 10 points` */
  readonly title: string
  /** What could not be read of it must not be shown. */
  readonly secret: boolean
}

/** Reads command, subcommand and data of a request. */
export function explainRequestBody(explainer: Explainer, settings: ExplainSettings): ExplainedBody {
  const start = explainer.position
  const { found, code, subcommand } = readCommand(explainer, settings)
  if (explainer.fault !== undefined) return { command: undefined, title: 'cut short', secret: false }
  if (found === undefined) return explainUnknown(explainer, start, code, subcommand)
  return explainKnown(explainer, settings, found)
}

/** Command, subcommand and fixed values, as they stand in requests and where answers repeat them. */
function readCommand(
  explainer: Explainer,
  settings: ExplainSettings,
): { readonly found: Recognised | undefined; readonly code: number; readonly subcommand: number } {
  let found: Recognised | undefined
  const { command: code, subcommand } = annotate(commandFields, explainer.ahead(), { code: settings.code }).message
  if (typeof code === 'number' && typeof subcommand === 'number') found = recognise(settings, code, subcommand)
  explainer.read({ ...commandFields, ...reservedOf(settings) }, commandWords(settings, found?.command))
  return { found, code: Number(code), subcommand: Number(subcommand) }
}

/** Command and subcommand in words, and what stands beside them. */
function commandWords(settings: ExplainSettings, command: Command | undefined): (leaf: Leaf) => string | undefined {
  return (leaf) => {
    if (leaf.name === 'command') return commandText(Number(leaf.value), command ?? named(settings, leaf.value))
    return leaf.name === 'subcommand' ? subcommandText(Number(leaf.value), command?.unit) : describeHead(leaf)
  }
}

function explainUnknown(explainer: Explainer, start: number, code: number, subcommand: number): ExplainedBody {
  const name = `command ${hex(code, 4)}H, subcommand ${hex(subcommand, 4)}H`
  explainer.notes.push(`No command is known here for ${name} (byte ${start}); its data is left as it is.`)
  explainer.take(explainer.remaining, { name: 'data', kind: 'bytes', text: 'data of an unknown command' })
  return { command: undefined, title: name, secret: false }
}

function explainKnown(
  explainer: Explainer,
  settings: ExplainSettings,
  { command, form, subcommand }: Recognised,
): ExplainedBody {
  const bits = codecBits(command, form, subcommand) | digitBits(settings)
  const message = readData(explainer, settings, command.request, { form: bits })
  const summary = summaryOf(command, message, settings)
  const used = usedDevices(command, message).map(({ address }) => address.device)
  noteUncertainDigits(explainer, settings, used)
  if (command.unit === 'bit') {
    const { bitUnitsOfWordDevice } = settings.profile.refusals
    noteBitUnits(explainer, used, `${hex(bitUnitsOfWordDevice, 4)}H: use subcommand ${hex(subcommand & ~1, 4)}H`)
  }
  if (command.sender === 'plc') explainer.notes.push('The PLC sends this of its own accord; nobody answers it.')
  return {
    command,
    title: summary === '' ? command.title : `${command.title}, ${summary}`,
    secret: hasSecret(command.request),
  }
}

/** Reads the data of an answer: with the request field by field, without it as words. */
export function explainResponseBody(
  explainer: Explainer,
  settings: ExplainSettings,
  request: KnownRequest | undefined,
  registration: KnownRequest | undefined,
): ExplainedBody {
  const echoed = settings.body?.echoed === true ? readCommand(explainer, settings) : undefined
  const isOther = echoed !== undefined && request !== undefined && echoed.code !== request.command.code
  if (isOther) explainer.notes.push(OTHER_COMMAND)
  if (request === undefined || isOther) {
    explainRaw(explainer, settings, isOther)
    const command = echoed?.found?.command
    return { command, title: command?.title ?? '', secret: false }
  }
  const { command, form } = request
  const context = contextOf(settings, request, registration)
  if (context === undefined) {
    explainer.notes.push(`The values of ${command.title} have no names: give the request that registered the devices.`)
    explainRaw(explainer, settings, true)
  } else readData(explainer, settings, command.response, { form, context })
  const summary = summaryOf(command, request.message, settings)
  return {
    command,
    title: summary === '' ? command.title : `${command.title}, ${summary}`,
    secret: hasSecret(command.response) || hasSecret(command.request),
  }
}

/** The request an answer's shape refers to: for Execute Monitor the registration before it. */
function contextOf(
  { commands }: ExplainSettings,
  { command, message }: KnownRequest,
  registration: KnownRequest | undefined,
): Context | undefined {
  if (command.context === undefined) return { shape: command.request, message }
  if (registration === undefined || registration.command.name !== command.context) return undefined
  const shape = commands[command.context]?.request
  return shape === undefined ? undefined : { shape, message: registration.message }
}

function readData(
  explainer: Explainer,
  settings: ExplainSettings,
  shape: Shape,
  options: { readonly form: number; readonly context?: Context },
): Message {
  return explainer.read(
    shape,
    (leaf: Leaf) => describeValue(leaf, settings),
    options,
    (row, bytes, message) => {
      const placed: Placed = { shape, message, ...options }
      return splitRow(row, bytes, settings, devicesOf(row.name, placed, settings))
    },
  )
}

/** Answer data without its request: words as far as they are whole words, else bytes. */
function explainRaw(explainer: Explainer, settings: ExplainSettings, noted = false): void {
  if (explainer.remaining === 0) return
  if (!noted) explainer.notes.push('What the values mean is in the request: give it to have them named.')
  const count = explainer.remaining / (2 * explainer.unit)
  const words: Shape = { data: { kind: 'words', count } }
  const split = (row: AnnotatedRow, bytes: Buffer) => splitRow(row, bytes, settings, undefined)
  const readable =
    Number.isInteger(count) && annotate(words, explainer.ahead(), { code: settings.code }).fault === undefined
  if (readable) explainer.read(words, () => undefined, {}, split)
  else explainer.take(explainer.remaining, { name: 'data', kind: 'bytes', text: 'no whole number of words' })
}

/** An answer that is not the given request's. */
export const OTHER_COMMAND = 'The answer is about another command than the request that was given.'

/** Reads what stands behind an end code: which station refused which command. */
export function explainErrorInformation(explainer: Explainer, settings: ExplainSettings): Message {
  const { errorInformation = plainBody.errorInformation } = settings.body ?? plainBody
  const { command, subcommand } = annotate(errorInformation, explainer.ahead(), { code: settings.code }).message
  const found = recognise(settings, Number(command), Number(subcommand))?.command
  return explainer.read(errorInformation, commandWords(settings, found))
}

/** A command of this number, whatever its subcommand. */
function named({ commands }: ExplainSettings, code: unknown): Command | undefined {
  return Object.values(commands).find((command) => command.code === code)
}

/** Says which setting of the port the addresses of these devices depend on, when nobody has said it. */
export function noteUncertainDigits(
  explainer: Explainer,
  settings: ExplainSettings,
  used: readonly DeviceName[],
): void {
  if (settings.code !== 'ascii') return
  if (settings.asciiXy === undefined && settings.profile.xyRadix === 8 && (used.includes('X') || used.includes('Y'))) {
    explainer.notes.push('X and Y are read as octal digits; if the port is set to "ASCII (X,Y HEX)", say asciiXy.')
  }
  if (settings.wRadix === 10 && used.includes('W')) {
    explainer.notes.push(
      'W is read as hexadecimal digits; which a device takes that numbers W in decimal is not known.',
    )
  }
  if (settings.asciiZr === undefined && used.includes('ZR')) {
    explainer.notes.push('ZR is read as decimal digits; the manuals disagree, see asciiZr.')
  }
}

/** Bit units of a word device look right, and no PLC carries them out. */
export function noteBitUnits(explainer: Explainer, used: readonly DeviceName[], advice: string): void {
  const names = new Set(used.filter((device) => deviceInfo(device).unit !== 'bit'))
  if (names.size === 0) return
  const wordDevices = [...names].join(', ')
  explainer.notes.push(`${wordDevices} has words, and the PLC refuses bit units of it (${advice}, word units).`)
}
