// A 1E frame in words. It has no length and no serial number: where an answer ends, only its request tells.
import { type DataCode, field, type Message, type Shape } from '../../codec/codec'
import { annotate, type Direction, Explainer, type FrameExplanation, type Leaf } from '../../codec/explanation'
import { aCompatibleCommands } from '../a-compatible/commands'
import { addressesOf } from '../a-compatible/frame-names'
import { mayEndWithZero, WITH_ABNORMAL_CODE } from '../frame/frame-1e'
import { type ExplainSettings, noteBitUnits, noteUncertainDigits } from './body'
import { type FrameCommand, type FrameRequest, frameForm, readFrameData } from './frame-value'
import { commandText, describeHead, endCodeText } from './head'
import type { ExplainFrameOptions, Known } from './options'
import { summaryOf } from './values'

const { fixed, u16, u8 } = field

/** The subheader of an answer is its request's with this bit (FX5 communication manual 37.2); a test holds it against the framing. */
const ANSWER = 0x80

const requestHead = { subheader: u8(), pc: u8(), monitoringTimer: u16() } as const satisfies Shape
const responseHead = { subheader: u8(), endCode: u8() } as const satisfies Shape

export function explain1e(bytes: Buffer, known: Known, options: ExplainFrameOptions): FrameExplanation {
  const code = options.code ?? codeOf(bytes)
  const settings: ExplainSettings = { ...known, code }
  const explainer = new Explainer(bytes, code)
  const subheader = firstByte(bytes, code)
  const direction = options.direction ?? (subheader !== undefined && subheader >= ANSWER ? 'response' : 'request')
  return direction === 'request'
    ? explainRequest(explainer, settings, bytes.length)
    : explainResponse(explainer, settings, options, bytes.length)
}

/** Subheaders are 00 to 1F and 80 to 9F: in ASCII code their first byte is a digit, which is none of them. */
function codeOf(bytes: Buffer): DataCode {
  return bytes.length > 0 && /^[0-9A-F]/i.test(bytes.toString('latin1', 0, 1)) ? 'ascii' : 'binary'
}

function firstByte(bytes: Buffer, code: DataCode): number | undefined {
  const { message } = annotate({ subheader: u8() }, bytes, { code })
  return typeof message.subheader === 'number' ? message.subheader : undefined
}

function commandOf(code: unknown): FrameCommand | undefined {
  return Object.values(aCompatibleCommands).find((command) => command.code === code)
}

const nameOf = (direction: Direction, code: DataCode) =>
  `1E ${direction}, ${code === 'ascii' ? 'ASCII' : 'binary'} code`

function explainRequest(explainer: Explainer, settings: ExplainSettings, total: number): FrameExplanation {
  const { code } = settings
  const head = explainer.read(requestHead, describe1e)
  const command = commandOf(head.subheader)
  const about = { frame: '1E', code, direction: 'request' } as const
  if (command === undefined) return explainUnknown(explainer, nameOf('request', code), about, total)
  const message = readFrameData(explainer, settings, command, command.request)
  if (command.name === 'writeBits') takeDummy(explainer, code, message)
  const devices = addressesOf(message).map(({ device }) => device)
  noteUncertainDigits(explainer, settings, devices)
  if (BIT_UNITS.includes(command.name)) noteBitUnits(explainer, devices, 'use command 01H, 03H or 05H')
  const title = [command.title, summaryOf(command, message, settings)].filter((part) => part !== '').join(', ')
  return end(explainer, { ...about, title: `${nameOf('request', code)}: ${title}`, command: command.name }, total)
}

const BIT_UNITS: readonly string[] = ['readBits', 'writeBits', 'writeRandomBits']

/** A request of 1E has no length, so what stands behind it may be the next one. */
function end(explainer: Explainer, about: Parameters<Explainer['end']>[0], total: number): FrameExplanation {
  if (explainer.fault === undefined) explainer.limit(explainer.position)
  return explainer.end(about, total)
}

function explainUnknown(
  explainer: Explainer,
  title: string,
  about: Omit<Parameters<Explainer['end']>[0], 'title'>,
  total: number,
): FrameExplanation {
  if (explainer.fault === undefined) {
    explainer.notes.push('The data of this command is not known here; it is left as it is.')
    explainer.take(explainer.remaining, { name: 'data', kind: 'bytes', text: 'data of an unknown command' })
  }
  return explainer.end({ ...about, title }, total)
}

function describe1e(leaf: Leaf): string | undefined {
  const value = Number(leaf.value)
  if (leaf.name !== 'subheader') return describeHead(leaf)
  return value < ANSWER
    ? commandText(value, commandOf(value)).slice(2)
    : `${commandText(value, commandOf(value - ANSWER)).slice(2)} answer`
}

/** Some PLCs put a dummy character behind an odd number of bits (FX3U-ENET-ADP user's manual 7.5). */
function takeDummy(explainer: Explainer, code: DataCode, { values }: Message): void {
  const odd = Array.isArray(values) && values.length % 2 === 1
  if (code !== 'ascii' || !odd || explainer.fault !== undefined || explainer.remaining !== 1) return
  explainer.take(1, { name: 'dummy', kind: 'text', text: 'dummy behind an odd number of bits' })
}

function explainAbnormalCode(explainer: Explainer): void {
  if (explainer.remaining === 0) return
  explainer.read({ abnormalCode: u8() }, ({ value }) => endCodeText('1E', Number(value)).replace(' (refused)', ':'))
}

/** FX3 modules send it, the FX5 manual prints none. */
function explainZeroBehind(explainer: Explainer, command: number, endCode: unknown): void {
  if (explainer.fault !== undefined || explainer.remaining === 0) return
  if (mayEndWithZero(command, Number(endCode))) explainer.read({ reserved: fixed(0, 1) }, () => 'fixed, of FX3')
}

function explainResponse(
  explainer: Explainer,
  settings: ExplainSettings,
  options: ExplainFrameOptions,
  total: number,
): FrameExplanation {
  const { code } = settings
  const asked = options.request === undefined ? undefined : requestIn(options.request, settings)
  if (options.request !== undefined && asked === undefined) {
    explainer.notes.push('The frame given as request is no request that can be read.')
  }
  const head = explainer.read(responseHead, (leaf) =>
    leaf.name === 'endCode' ? endCodeText('1E', Number(leaf.value)) : describe1e(leaf),
  )
  const about = {
    frame: '1E',
    code,
    direction: 'response',
    ...(typeof head.endCode === 'number' ? { endCode: head.endCode } : {}),
  } as const
  if (typeof head.subheader === 'number' && asked !== undefined && head.subheader !== asked.command.code + ANSWER) {
    explainer.fail(0, `this answers another command than the request (${asked.command.title})`, 'subheader')
  }
  const name = nameOf('response', code)
  if (head.endCode !== 0) {
    if (head.endCode === WITH_ABNORMAL_CODE) explainAbnormalCode(explainer)
    explainZeroBehind(explainer, Number(head.subheader) - ANSWER, head.endCode)
    return explainer.end({ ...about, title: `${name}: refused` }, total)
  }
  if (asked === undefined) {
    explainer.notes.push('What the values mean is in the request: give it to have them named.')
    explainer.take(explainer.remaining, { name: 'data', kind: 'bytes', text: 'data without its request' })
    return explainer.end({ ...about, title: name }, total)
  }
  const message = readFrameData(explainer, settings, asked.command, asked.command.response, asked.message)
  if (asked.command.name === 'readBits') takeDummy(explainer, code, message)
  explainZeroBehind(explainer, asked.command.code, head.endCode)
  const summary = summaryOf(asked.command, asked.message, settings)
  const title = [asked.command.title, summary].filter((part) => part !== '').join(', ')
  return end(explainer, { ...about, title: `${name}: ${title}`, command: asked.command.name }, total)
}

function requestIn(bytes: Buffer, settings: ExplainSettings): FrameRequest | undefined {
  const { code } = settings
  const head = annotate(requestHead, bytes, { code })
  const command = commandOf(head.message.subheader)
  if (head.fault !== undefined || command === undefined) return undefined
  const { message, fault } = annotate(command.request, bytes.subarray(head.used), { code, form: frameForm(settings) })
  return fault === undefined ? { command, message } : undefined
}
