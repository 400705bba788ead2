// Buffer memory by Memory and Extend Unit: of the connected module itself, and of MELSEC-Q modules by their names.

import { type Command, InvalidArgumentError, Option } from 'commander'
import { hex } from '../basics/hex'
import { type BufferMemory, type MelsecClient, type ModulePlace, RequestError } from '../index'
import { type CommandRun, type MakeCommand, newCommand, perform } from './command'
import { addConnectionOptions, type ConnectionOptions, peerText, refuseUnsent, withClient } from './connection-options'
import { exitCodes } from './exit-code'
import { onlyOf } from './family'
import { json, table } from './output'
import { refusalOf, type Terminal } from './terminal'

type MemoryOptions = ConnectionOptions & {
  readonly yes?: boolean
  readonly model?: string
  readonly startIo?: number
  readonly slot0?: 0 | 1
}

const NO_MODULES = {
  what: 'buffer memory of modules',
  instead:
    'Its specified buffers and ring buffers are reached with buffer, the parameters of its units with parameters.',
}

/** Whose buffer memory it is, and what it is called. */
interface Whose {
  readonly title: (options: MemoryOptions) => string
  readonly of: (client: MelsecClient, options: MemoryOptions) => BufferMemory
}

const ownMemory: Whose = { title: () => 'the connected module', of: ({ memory }) => memory }

const moduleMemory: Whose = {
  title: ({ model, startIo }) => `${model} at ${hex(startIo ?? 0, 4)}`,
  of: (client, { model = '', startIo = Number.NaN, slot0 }) => {
    const place: ModulePlace = { startIo, ...(slot0 === undefined ? {} : { slot0 }) }
    return client.module(model, place)
  },
}

/** `melsec-jw memory` */
export const memoryCommand: MakeCommand = (run) =>
  make(
    run,
    ownMemory,
    newCommand('memory', 'buffer memory of the connected module (asks before writing)', [
      'memory read 0x78 10 --plc 192.168.3.39:5010 --profile q',
      'memory write 0x2680 0x2000 0 --plc 192.168.3.39:5010 --profile q',
    ]).description('Read and write the buffer memory of the connected module itself: command Memory (0613, 1613).'),
  )

/** `melsec-jw module` */
export const moduleCommand: MakeCommand = (run) =>
  make(
    run,
    moduleMemory,
    newCommand('module', 'buffer memory of a MELSEC-Q module by its name (asks before writing)', [
      'module read 1 2 --model Q62DA --start-io 0030 --plc 192.168.3.39:5010 --profile q',
      'module write 0x18 1000 --model Q62DA --start-io 0030 --plc 192.168.3.39:5010 --profile q',
    ])
      .description('Read and write the buffer memory of a MELSEC-Q module: command Extend Unit (0601, 1601).')
      .optionsGroup('Module:')
      .addOption(new Option('--model <name>', 'model of the module, e.g. Q62DA').makeOptionMandatory())
      .addOption(
        new Option('--start-io <number>', 'start I/O number, hexadecimal: 0030 when it has X/Y 30 and on')
          .argParser(startIo)
          .makeOptionMandatory(),
      )
      .addOption(
        new Option(
          '--slot0 <0|1>',
          'module number on slot 0, for models whose cell of the manual is not legible',
        ).argParser(slot0),
      ),
  )

function make(run: CommandRun, whose: Whose, command: Command): Command {
  command
    .argument('<action>', 'read or write')
    .argument('<address>', 'buffer memory address, decimal or 0x1F')
    .argument('<numbers...>', 'read: how many words. write: the words, 0 to 65535, decimal or 0x1F')
    .optionsGroup('Writing:')
    .option('-y, --yes', 'do not ask')
  addConnectionOptions(command)
  return command.action((action: string, address: string, numbers: readonly string[], options: MemoryOptions) =>
    perform(run, options, () =>
      onlyOf('melsec', NO_MODULES, options, async () => {
        const words = numbers.map(wholeNumber)
        const at = wholeNumber(address)
        if (action === 'read') return read(run.terminal, whose, { at, words }, options)
        if (action === 'write') return write(run.terminal, whose, { at, words }, options)
        throw new RequestError('BAD_OPTION', `There is no ${JSON.stringify(action)}: choose read or write.`, 'action')
      }),
    ),
  )
}

interface Asked {
  readonly at: number
  readonly words: readonly number[]
}

async function read(terminal: Terminal, whose: Whose, { at, words }: Asked, options: MemoryOptions): Promise<number> {
  const [points = 0, ...more] = words
  if (more.length > 0) throw new RequestError('BAD_OPTION', 'read takes an address and how many words.', 'numbers')
  await refuseUnsent(options, {}, async (client) => whose.of(client, options).read(at, points))
  const values = await withClient(terminal, options, {}, (client) => whose.of(client, options).read(at, points))
  if (options.json === true) terminal.out(json({ address: at, values }))
  else terminal.out(table(rowsOf(at, values)))
  return exitCodes.ok.code
}

async function write(terminal: Terminal, whose: Whose, { at, words }: Asked, options: MemoryOptions): Promise<number> {
  const wide = words.find((word) => word > 0xffff)
  if (wide !== undefined) throw new RequestError('BAD_VALUE', `${wide} is no word: 0 to 65535.`, 'numbers')
  await refuseUnsent(options, { allowWrites: true }, async (client) => whose.of(client, options).write(at, words))
  const question = `Write to the buffer memory of ${whose.title(options)}, ${peerText(options)}:\n${table(rowsOf(at, words), '  ')}`
  const refusal = await refusalOf(terminal, options.yes === true, question)
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was written. ${refusal}`, '--yes')
  await withClient(terminal, options, { allowWrites: true }, (client) => whose.of(client, options).write(at, words))
  if (options.json === true) terminal.out(json({ address: at, values: words, ok: true }))
  else terminal.out(table(rowsOf(at, words)))
  return exitCodes.ok.code
}

/** Address and word, decimal and hexadecimal: the manuals of modules use both. */
function rowsOf(at: number, words: readonly number[]): string[][] {
  return words.map((word, i) => [String(at + i), `(${hex(at + i, 4)}H)`, '=', String(word), `(${hex(word, 4)}H)`])
}

function wholeNumber(text: string): number {
  if (/^\d+$/.test(text) || /^0x[0-9a-f]+$/i.test(text)) return Number(text)
  throw new RequestError('BAD_VALUE', `${JSON.stringify(text)} is no whole number: decimal such as 120, or 0x78.`, text)
}

function startIo(text: string): number {
  if (/^(0x)?[0-9a-f]{1,4}h?$/i.test(text)) return Number.parseInt(text.replace(/^0x/i, ''), 16)
  throw new InvalidArgumentError('It is a hexadecimal number, a multiple of 10, such as 0030.')
}

function slot0(text: string): 0 | 1 {
  if (text === '0' || text === '1') return text === '0' ? 0 : 1
  throw new InvalidArgumentError('It is 0 or 1.')
}
