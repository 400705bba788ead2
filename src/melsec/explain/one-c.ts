// What a 1C frame carries, in words: its commands have two characters, and the message wait stands behind them.
import type { Message } from '../../codec/codec'
import { annotate, type Explainer, type Leaf } from '../../codec/explanation'
import { addressesOf } from '../a-compatible/frame-names'
import { oneCCommands } from '../one-c/commands'
import { codeOf, frontShape } from '../one-c/front'
import { oneCRules } from '../one-c/rules'
import { type ExplainSettings, noteBitUnits, noteUncertainDigits } from './body'
import { type FrameCommand, type FrameRequest, frameForm, readFrameData } from './frame-value'
import type { BodyWords, MakeWords, SaidBody } from './serial-body'
import { summaryOf } from './values'

export const oneCWords: MakeWords = (settings, { request }): BodyWords => {
  const asked = request && requestIn(request, settings)
  return {
    family: '1C',
    asked: asked?.command,
    request: (explainer) => explainRequest(explainer, settings),
    response: (explainer) => explainResponse(explainer, settings, asked),
  }
}

function commandOf(characters: unknown): FrameCommand | undefined {
  if (typeof characters !== 'string') return undefined
  const code = codeOf(characters)
  return Object.values<FrameCommand>(oneCCommands).find((command) => command.code === code)
}

function requestIn(body: Buffer, settings: ExplainSettings): FrameRequest | undefined {
  const front = annotate(frontShape, body, { code: 'ascii' })
  const command = commandOf(front.message.command)
  if (front.fault !== undefined || command === undefined) return undefined
  const data = annotate(command.request, body.subarray(front.used), { code: 'ascii', form: frameForm(settings) })
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
  const message = readFrameData(explainer, settings, command, command.request)
  const used = addressesOf(message).map(({ device }) => device)
  noteUncertainDigits(explainer, settings, used)
  if (oneCRules.bitUnits.some((name) => name === command.name)) noteBitUnits(explainer, used, 'use WR, WW or WT')
  return { command: command.name, title: titleOf(command, message, settings), secret: false }
}

function titleOf(command: FrameCommand, message: Message, settings: ExplainSettings): string {
  return [`${command.title} (${command.name})`, summaryOf(command, message, settings)]
    .filter((part) => part !== '')
    .join(', ')
}

/** An answer does not name its command. */
function explainResponse(explainer: Explainer, settings: ExplainSettings, asked: FrameRequest | undefined): SaidBody {
  if (asked !== undefined) {
    readFrameData(explainer, settings, asked.command, asked.command.response, asked.message)
    return { command: asked.command.name, title: titleOf(asked.command, asked.message, settings), secret: false }
  }
  if (explainer.remaining > 0) {
    explainer.notes.push('What the values mean is in the request: give it to have them named.')
    explainer.take(explainer.remaining, { name: 'data', kind: 'text', text: 'data without its request' })
  }
  return { title: '', secret: false }
}
