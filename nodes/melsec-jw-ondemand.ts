/** Node `melsec-jw-ondemand`: a message for each On-demand, which a program in the PLC sends of its own accord. */
import type { Node, NodeAPI, NodeDef, NodeMessage } from 'node-red'
import { type OnDemand, type UnsolicitedFrame, valueOfBytes } from '../src/index'
import { failureOf, NodeFailure } from './failure'
import type { Migration, StoredSettings } from './migration'
import { begin, type Tools } from './node'
import type { Display } from './status'
import { textIn, wordIn } from './stored'

const migrations: readonly Migration[] = []

/** Numbers from 0 to 65535, a Buffer, or text in the encoding of the connection. */
const outputs = ['words', 'buffer', 'text'] as const

interface Message extends NodeMessage {
  readonly route: OnDemand['route']
  /** Milliseconds since 1970. */
  readonly timestamp: number
}

/** Listens before the node uses the connection, so that nothing is missed. */
function listen(settings: StoredSettings, tools: Tools, display: Display): undefined {
  const { node, texts, connection } = tools
  const output = wordIn(settings, 'output', outputs, texts)
  const topic = textIn(settings, 'topic', texts)
  const named = topic === '' ? {} : { topic }
  const client = connection.melsec('onDemand')

  const failed = (error: unknown, { route, timestamp }: OnDemand | UnsolicitedFrame, payload: Buffer) => {
    const failure = failureOf(error, texts)
    display.failed(failure)
    const message: Message = { ...named, payload, route: { ...route }, timestamp }
    node.error(failure, message)
  }
  const told = (onDemand: OnDemand) => {
    const { route, timestamp, data } = onDemand
    let payload: unknown
    try {
      payload = payloadOf(onDemand, output, tools)
    } catch (error) {
      failed(error, onDemand, Buffer.from(data))
      return
    }
    display.succeeded()
    const message: Message = { ...named, payload, route: { ...route }, timestamp }
    node.send(message)
  }
  const unreadable = (frame: UnsolicitedFrame) => {
    if (frame.error !== undefined) failed(frame.error, frame, Buffer.from(frame.body))
  }
  const ends = [client.on('onDemand', told), client.on('unsolicited', unreadable)]
  node.on('close', () => {
    for (const end of ends) end()
  })
  return undefined
}

/** @throws NodeFailure or PlcError when the data are not what was chosen */
function payloadOf({ data, words }: OnDemand, output: (typeof outputs)[number], { texts, connection }: Tools): unknown {
  switch (output) {
    case 'words':
      // Several nodes are told of the same arrays, and flows change their messages.
      if (words !== undefined) return [...words]
      throw new NodeFailure({
        code: 'BAD_FIELD',
        message: texts('error.oddBytes', { count: data.length }),
        outcome: 'unknown',
      })
    case 'buffer':
      return Buffer.from(data)
    case 'text':
      return data.length === 0 ? '' : valueOfBytes(data, `STRING(${data.length})`, 0, connection.options?.format)
    default:
      return output satisfies never
  }
}

export = function register(RED: NodeAPI): void {
  RED.nodes.registerType('melsec-jw-ondemand', function (this: Node, stored: NodeDef) {
    RED.nodes.createNode(this, stored)
    begin(RED, this, { ...stored }, migrations, listen)
  })
}
