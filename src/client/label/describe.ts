// Label requests as people see them. Names are known beforehand; types, and with them sizes, once the PLC has said them.

import { measure, type Named } from '../../codec/codec'
import type { Exchange } from '../../link/link'
import type { Command } from '../../melsec/commands/command'
import { type CommandName, commands } from '../../melsec/commands/commands'
import { subcommandOf } from '../../melsec/device/form'
import { wordsOfArea } from '../../melsec/label/codec'
import type { PlanProtocol } from '../plan/limit'
import type { PlanDescription, RequestDescription } from '../plan/request'
import { pointsText } from '../plan/request'
import { ArrayParts } from './array'
import type { LabelInItems } from './in-items'
import type { AskedLabel } from './item'
import { type ArrayRead, arrayMessage, LabelRequests, randomMessage } from './request'
import type { LabelType } from './value'

/** What is known of the labels of a plan. */
export type KnownTypes = ReadonlyMap<AskedLabel, LabelType>

/** Only the requests are asked for: nothing is sent. */
function requestsOf(protocol: PlanProtocol): LabelRequests {
  const send = () => Promise.reject(new Error('a description sends nothing'))
  return new LabelRequests({ protocol, send })
}

/** The requests that read labels. */
export function describeLabelRead(
  protocol: PlanProtocol,
  items: readonly LabelInItems[],
  known: KnownTypes,
): PlanDescription {
  const requests = requestsOf(protocol)
  const asked = items.map(({ label }) => label)
  const textOf = (label: AskedLabel) => items.find((item) => item.label === label)?.text ?? label.address.name
  const random = requests.randomRequests(asked).map((some) => randomRequest(protocol, some, known, textOf))
  const arrays = asked.filter(({ count }) => count !== undefined)
  const parts = new ArrayParts(requests)
  for (const label of arrays) {
    const type = known.get(label)
    if (type !== undefined) parts.add(label, type)
  }
  const pieces = parts.requests.map((some) => arrayRequest(protocol, some))
  const unknown = arrays.filter((label) => !known.has(label))
  return {
    requests: [...random, ...pieces],
    notes: [
      ...(asked.every((label) => known.has(label)) ? [] : [UNKNOWN_TYPES]),
      ...unknown.map((label) => `${textOf(label)}: its elements are read by Array Label Read when its type is known.`),
    ],
  }
}

const UNKNOWN_TYPES =
  'The PLC says the types of labels when it is asked: how long its answers are is known after the first reading.'

function randomRequest(
  protocol: PlanProtocol,
  asked: readonly AskedLabel[],
  known: KnownTypes,
  textOf: (label: AskedLabel) => string,
): RequestDescription {
  const labels = asked.flatMap((label) => {
    const type = known.get(label)
    return type === undefined ? [] : [{ typeId: type.typeId, spare: 0, data: new Array<number>(type.size).fill(0) }]
  })
  const command = commands.readRandomLabels
  const exchange = protocol.exchange(command, randomMessage(asked))
  return {
    ...described(protocol, command, exchange, asked.length),
    ...(labels.length < asked.length ? {} : { responseBytes: answerBytes(protocol, command, exchange, { labels }) }),
    items: [...new Set(asked.map(textOf))],
  }
}

function arrayRequest(protocol: PlanProtocol, pieces: readonly ArrayRead[]): RequestDescription {
  const arrays = pieces.map(({ extent }) => ({
    typeId: 0,
    area: { ...extent, words: new Array<number>(wordsOfArea(extent)).fill(0) },
  }))
  const command = commands.readArrayLabels
  const exchange = protocol.exchange(command, arrayMessage(pieces))
  return {
    ...described(protocol, command, exchange, pieces.length),
    responseBytes: answerBytes(protocol, command, exchange, { arrays }),
    items: pieces.map(({ name }) => name),
  }
}

/** Bytes of the frame of an answer. */
function answerBytes(
  protocol: PlanProtocol,
  { request, response }: Command,
  { message: asked }: Exchange<unknown>,
  message: Readonly<Record<string, unknown>>,
): number {
  const context = { shape: request, message: asked }
  const bytes = measure(response, { ascii: protocol.code === 'ascii', form: 0, message, context })
  return protocol.answerBytes(bytes)
}

function described(
  { profile }: PlanProtocol,
  command: Named<Command, CommandName>,
  { message, write }: Exchange<unknown>,
  points: number,
): Omit<RequestDescription, 'items'> {
  const { abbreviations } = message as { readonly abbreviations: readonly { readonly name: string }[] }
  const short = abbreviations.map(({ name }, at) => `%${at + 1} for ${name}`)
  return {
    command: command.name,
    subcommand: subcommandOf(command, 'short', profile),
    points,
    requestBytes: write(0).length,
    text: `${command.title}: ${[pointsText(points, 'label'), ...short].join(', ')}`,
  }
}

/** The requests that read the types of labels before they are written. */
export function describeLabelTypes(
  protocol: PlanProtocol,
  items: readonly LabelInItems[],
): readonly RequestDescription[] {
  // Without counts: the elements of arrays are not read.
  const types = items.map(({ text, label: { address } }) => ({ text, label: { address } }))
  return describeLabelRead(protocol, types, new Map()).requests
}

/**
 * The requests that write labels which follow one another. One of them may turn out to be several: the length of the
 * values is not known without the types.
 */
export function describeLabelWrite(protocol: PlanProtocol, items: readonly LabelInItems[]): RequestDescription[] {
  const runs: LabelInItems[][] = []
  for (const item of items) {
    const last = runs.at(-1)
    if (last?.[0] !== undefined && isArray(last[0]) === isArray(item)) last.push(item)
    else runs.push([item])
  }
  return runs.map((run): RequestDescription => {
    const command = run.some(isArray) ? commands.writeArrayLabels : commands.writeRandomLabels
    return {
      command: command.name,
      subcommand: subcommandOf(command, 'short', protocol.profile),
      points: run.length,
      responseBytes: protocol.answerBytes(0),
      items: run.map(({ text }) => text),
      text: `${command.title}: ${pointsText(run.length, 'label')}`,
    }
  })
}

function isArray({ label }: LabelInItems): boolean {
  return label.count !== undefined
}
