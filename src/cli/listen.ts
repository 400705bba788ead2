import { Option } from 'commander'
import { hexPairs } from '../basics/hex'
import { type MelsecClient, type OnDemand, PlcError, type UnsolicitedFrame, valueOfBytes } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import {
  addConnectionOptions,
  type ConnectionOptions,
  encodingOption,
  type FormatOptions,
  peerText,
  withClient,
} from './connection-options'
import { exitCodes } from './exit-code'
import { onlyOf } from './family'
import { interruption } from './interruption'
import { choice, whole } from './option'
import { errorText } from './output'
import type { Terminal } from './terminal'

const examples = [
  'listen --plc 192.168.3.39:5010 --profile iq-r',
  'listen --plc 192.168.3.39:5010 --profile iq-r --as text --encoding shift-jis',
  'listen --plc 192.168.3.39:5010 --profile iq-r --count 1 --json',
]

const FORMS = ['words', 'hex', 'text'] as const

const SILENT = {
  what: 'messages that it sends unasked',
  instead: 'Read it again and again: read --family jw.',
}

type ListenOptions = ConnectionOptions &
  Pick<FormatOptions, 'encoding'> & { readonly as: (typeof FORMS)[number]; readonly count?: number }

/** `melsec-jw listen` */
export const listenCommand: MakeCommand = (run) => {
  const command = newCommand(
    'listen',
    'print what the PLC sends unasked (On-demand); Ctrl-C ends it',
    examples,
  ).description(
    'Print what a program in the PLC sends of its own accord (On-demand, 2101), one line for each. It stays connected, and ' +
      'connects again by itself, until Ctrl-C. Over UDP it needs --local-port, as in the open settings of the PLC.',
  )
  addConnectionOptions(command)
    .addOption(choice('--as <form>', 'words (0 to 65535), hex (bytes), or text', FORMS).default('words'))
    .addOption(encodingOption('characters of --as text'))
    .addOption(new Option('--count <number>', 'end after so many').argParser(whole(1, 1_000_000_000)))
  return command.action((options: ListenOptions) =>
    perform(run, options, () => onlyOf('melsec', SILENT, options, () => listen(run.terminal, options))),
  )
}

async function listen(terminal: Terminal, options: ListenOptions): Promise<number> {
  let left = options.count ?? Number.POSITIVE_INFINITY
  let enough = () => {}
  const counted = new Promise<void>((resolve) => {
    enough = resolve
  })
  const prepare = (client: MelsecClient) => {
    client.on('onDemand', (onDemand) => {
      if (left <= 0) return
      left -= 1
      print(terminal, onDemand, options)
      if (left <= 0) enough()
    })
    client.on('unsolicited', (frame) => complain(terminal, frame))
  }
  await withClient(
    terminal,
    options,
    {},
    async (client) => {
      // Before it says so: who reads "Ctrl-C ends it" may press it at once.
      const interrupted = interruption(counted)
      tellStates(terminal, client, options)
      await interrupted
    },
    prepare,
  )
  return exitCodes.ok.code
}

function print(terminal: Terminal, onDemand: OnDemand, { as, encoding, json }: ListenOptions): void {
  const { route, data, words, timestamp } = onDemand
  const time = new Date(timestamp).toISOString()
  if (json === true) {
    // One line each, so that a program can read them as they come.
    terminal.out(JSON.stringify({ time, timestamp, route, data: data.toString('hex'), words }))
    return
  }
  try {
    terminal.out(
      `${time}  ${as === 'text' ? textIn(data, encoding) : as === 'words' ? wordsIn(onDemand) : hexIn(data)}`,
    )
  } catch (error) {
    if (!(error instanceof PlcError)) throw error
    terminal.error(`${time}  ${errorText(error)}`)
    terminal.out(`${time}  ${hexIn(data)}`)
  }
}

function wordsIn({ words, data }: OnDemand): string {
  if (words === undefined) return hexIn(data)
  return `${words.length} ${words.length === 1 ? 'word' : 'words'}: ${words.join(' ')}`.trimEnd()
}

function hexIn(data: Buffer): string {
  return `${data.length} ${data.length === 1 ? 'byte' : 'bytes'}: ${hexPairs(data)}`.trimEnd()
}

function textIn(data: Buffer, encoding: ListenOptions['encoding']): string {
  const format = encoding === undefined ? {} : { encoding }
  return data.length === 0 ? '""' : JSON.stringify(valueOfBytes(data, `STRING(${data.length})`, 0, format))
}

/** What came unasked and could not be read. */
function complain(terminal: Terminal, { error, body, timestamp }: UnsolicitedFrame): void {
  if (error === undefined) return
  terminal.error(`${new Date(timestamp).toISOString()}  ${errorText(error)} The frame holds ${hexIn(body)}`)
}

function tellStates(terminal: Terminal, client: MelsecClient, options: ListenOptions): void {
  terminal.error(`Connected to ${peerText(options)}. Ctrl-C ends it.`)
  let lost = false
  client.on('state', ({ name, error }) => {
    // Once for each loss, not for every attempt of a night without the PLC.
    if (name === 'waiting' && !lost && error !== undefined) {
      lost = true
      terminal.error(`No connection: ${errorText(error)}`)
    }
    if (name === 'connected' && lost) {
      lost = false
      terminal.error('Connected again.')
    }
  })
}
