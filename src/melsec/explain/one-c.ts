// What a 1C frame carries, in words: its commands have two characters, and the message wait stands behind them.
import type { Declaration, Message, Named } from '../../codec/codec'
import { annotate, type Explainer, type Leaf } from '../../codec/explanation'
import { addressesOf } from '../a-compatible/frame-names'
import { FORM_XY_OCTAL } from '../device/codec'
import { oneCCommands } from '../one-c/commands'
import { codeOf, frontShape } from '../one-c/front'
import { oneCRules } from '../one-c/rules'
import { type ExplainSettings, noteBitUnits, noteUncertainDigits } from './body'
import { describeFrameValue } from './frame-value'
import type { BodyWords, MakeWords, SaidBody } from './serial-body'
import { devicesOf, splitRow, summaryOf } from './values'

type Command = Named<Declaration, string>

interface Request {
  readonly command: Command
  readonly message: Message
}

export const oneCWords: MakeWords = (settings, { request }): BodyWords => {
  const asked = request && requestIn(request, settings)
  return {
    family: '1C',
    asked: asked?.command,
    request: (explainer) => explainRequest(explainer, settings),
    response: (explainer) => explainResponse(explainer, settings, asked),
  }
}

function commandOf(characters: unknown): Command | undefined {
  if (typeof characters !== 'string') return undefined
  const code = codeOf(characters)
  return Object.values<Command>(oneCCommands).find((command) => command.code === code)
}

function formOf({ profile, asciiXy }: ExplainSettings): number {
  const octal = asciiXy === undefined ? profile.xyRadix === 8 : asciiXy === 'octal'
  return octal ? FORM_XY_OCTAL : 0
}

function requestIn(body: Buffer, settings: ExplainSettings): Request | undefined {
  const front = annotate(frontShape, body, { code: 'ascii' })
  const command = commandOf(front.message.command)
  if (front.fault !== undefined || command === undefined) return undefined
  const data = annotate(command.request, body.subarray(front.used), { code: 'ascii', form: formOf(settings) })
  return data.fault === undefined ? { command, message: data.message } : undefined
}

function describeFront({ name, value }: Leaf): string | undefined {
  if (name === 'command') return `${String(value)} (${commandOf(value)?.title ?? 'no command that is known here'})`
  return `${String(value)} ms (the answer comes no sooner)`
}

function explainRequest(explainer: Explainer, settings: ExplainSettings): SaidBody {
  const front = explainer.read(frontShape, describeFront)
  if (explainer.fault !== undefined) return { title: 'cut short', secret: false }
  const command = commandOf(front.command)
  if (command === undefined) {
    explainer.notes.push(`No command ${String(front.command)} is known here; its data is left as it is.`)
    explainer.take(explainer.remaining, { name: 'data', kind: 'text', text: 'data of an unknown command' })
    return { title: `command ${String(front.command)}`, secret: false }
  }
  const message = readData(explainer, settings, command, command.request)
  const used = addressesOf(message).map(({ device }) => device)
  noteUncertainDigits(explainer, settings, used)
  if (oneCRules.bitUnits.some((name) => name === command.name)) noteBitUnits(explainer, used, 'use WR, WW or WT')
  return { command: command.name, title: titleOf(command, message, settings), secret: false }
}

function titleOf(command: Command, message: Message, settings: ExplainSettings): string {
  return [`${command.title} (${command.name})`, summaryOf(command, message, settings)]
    .filter((part) => part !== '')
    .join(', ')
}

/** An answer does not name its command. */
function explainResponse(explainer: Explainer, settings: ExplainSettings, asked: Request | undefined): SaidBody {
  if (asked !== undefined) {
    readData(explainer, settings, asked.command, asked.command.response, asked.message)
    return { command: asked.command.name, title: titleOf(asked.command, asked.message, settings), secret: false }
  }
  if (explainer.remaining > 0) {
    explainer.notes.push('What the values mean is in the request: give it to have them named.')
    explainer.take(explainer.remaining, { name: 'data', kind: 'text', text: 'data without its request' })
  }
  return { title: '', secret: false }
}

function readData(
  explainer: Explainer,
  settings: ExplainSettings,
  command: Command,
  shape: Declaration['request'],
  request?: Message,
): Message {
  const context = request === undefined ? {} : { context: { shape: command.request, message: request } }
  return explainer.read(
    shape,
    (leaf) => describeFrameValue(leaf, settings),
    { form: formOf(settings), ...context },
    (row, bytes, message) =>
      splitRow(row, bytes, settings, devicesOf(row.name, { shape, message, ...context }, settings)),
  )
}
