// Specified buffers and ring buffers of a Sharp JW: areas of its memory that a program of the PLC shares with a partner.
import { hex, hexPairs } from '../../basics/hex'
import { octal } from '../../basics/octal'
import { type JwClient, RequestError } from '../../index'
import { pastedBytes } from '../bytes'
import { type MakeCommand, newCommand, perform } from '../command'
import { exitCodes } from '../exit-code'
import { onlyOf } from '../family'
import { json } from '../output'
import type { Plc } from '../session'
import { refusalOf, type Terminal } from '../terminal'
import { addJwConnectionOptions, type JwConnectionOptions, jwPlc } from './connection'

const examples = [
  'buffer info 1 --plc 192.168.3.60:4000',
  'buffer read 1 0 16 --plc 192.168.3.60:4000',
  "buffer write 1 0 'AA 55' --plc 192.168.3.60:4000",
  'buffer read 0 64 --ring --plc 192.168.3.60:4000',
]

const NO_BUFFERS = {
  what: 'such buffers',
  instead: 'Its buffer memory is reached with memory and module, or as items: read U3\\G100.',
}

interface BufferOptions extends JwConnectionOptions {
  readonly yes?: boolean
  readonly ring?: boolean
}

/** What is sent, and what is said of it. */
interface Step {
  /** Missing: it changes nothing, and nobody is asked. */
  readonly question?: string
  run(client: JwClient): Promise<Readonly<Record<string, unknown>>>
}

/** `melsec-jw buffer` */
export const bufferCommand: MakeCommand = (run) => {
  const command = newCommand(
    'buffer',
    'specified buffers and ring buffers of a Sharp JW (asks before it changes one)',
    examples,
  )
    .description(
      'Reads and writes the specified buffers of a Sharp JW, and with --ring its ring buffers. Reading a ring buffer takes what was read ' +
        'out of it, so that is asked about, too, and never repeated. All numbers are decimal.',
    )
    .argument('<action>', 'info, read or write')
    .argument('<buffer>', 'its number: 0 to 31, with --ring 0 to 15')
    .argument(
      '[numbers...]',
      'read: first byte and how many; write: first byte and bytes, hexadecimal. With --ring without the first byte',
    )
    .optionsGroup('Buffer:')
    .option('--ring', 'a ring buffer; without it a specified buffer')
    .option('-y, --yes', 'do not ask')
  addJwConnectionOptions(command)
  return command.action((action: string, number: string, rest: readonly string[], options: BufferOptions) =>
    perform(run, options, () =>
      onlyOf('jw', NO_BUFFERS, options, () => {
        const step = stepOf(action, decimal(number, 'the number of the buffer'), rest, options.ring === true)
        return buffer(run.terminal, step, options, jwPlc(run.terminal, options))
      }),
    ),
  )
}

async function buffer(
  terminal: Terminal,
  { question, run }: Step,
  options: BufferOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  await plc.unsent('writing', run)
  if (question !== undefined) {
    const refusal = await refusalOf(terminal, options.yes === true, `${question} (${plc.text}).`)
    if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was sent. ${refusal}`, '--yes')
  }
  const found = await plc.with(question === undefined ? 'reading' : 'writing', run)
  if (options.json === true) terminal.out(json({ plc: plc.text, ...found }))
  else
    terminal.out(
      Object.entries(found)
        .map(([name, value]) => `${name}: ${shown(name, value)}`)
        .join('\n'),
    )
  return exitCodes.ok.code
}

/** Files are hexadecimal, addresses octal, as everywhere. */
function shown(name: string, value: unknown): string {
  if (value instanceof Uint8Array) return hexPairs(value)
  if (typeof value !== 'number') return String(value)
  if (/file$/i.test(name)) return `${hex(value, 2)}H`
  return /address$/i.test(name) ? `${octal(value, 6)} octal` : String(value)
}

function stepOf(action: string, number: number, rest: readonly string[], isRing: boolean): Step {
  const key = `${action}${isRing ? ' --ring' : ''}`
  const make = Object.hasOwn(STEPS, key) ? STEPS[key] : undefined
  if (make === undefined) bad(`There is no ${JSON.stringify(action)}: choose info, read or write.`, 'action')
  return make(number, rest)
}

const STEPS: Readonly<Record<string, (number: number, rest: readonly string[]) => Step>> = {
  info: (number, rest) => {
    few(rest, 0, 'info takes the number of the buffer.')
    return { run: async ({ buffers }) => ({ ...(await buffers.specified.info(number)) }) }
  },
  'info --ring': (number, rest) => {
    few(rest, 0, 'info takes the number of the buffer.')
    return { run: async ({ buffers }) => ({ ...(await buffers.ring.info(number)) }) }
  },
  read: (number, rest) => {
    const [at = '', length = ''] = few(rest, 2, 'read takes the buffer, the first byte and how many bytes.')
    const [first, count] = [decimal(at, 'the first byte'), decimal(length, 'how many bytes')]
    return { run: async ({ buffers }) => ({ data: await buffers.specified.read(number, first, count) }) }
  },
  'read --ring': (number, rest) => {
    const [length = ''] = few(rest, 1, 'read --ring takes the buffer and how many bytes at most.')
    const count = decimal(length, 'how many bytes')
    return {
      question: `Take up to ${count} bytes out of ring buffer ${number}: nobody gets them again`,
      run: async ({ buffers }) => ({ ...(await buffers.ring.read(number, count)) }),
    }
  },
  write: (number, rest) => {
    const [at = '', ...bytes] = rest
    const first = decimal(at, 'the first byte')
    const data = bytesOf(bytes)
    return {
      question: `Write ${hexPairs(data)} to specified buffer ${number} from byte ${first} on`,
      run: async ({ buffers }) => {
        await buffers.specified.write(number, first, data)
        return { written: data.length }
      },
    }
  },
  'write --ring': (number, rest) => {
    const data = bytesOf(rest)
    return {
      question: `Put ${hexPairs(data)} into ring buffer ${number}`,
      run: async ({ buffers }) => ({ ...(await buffers.ring.write(number, data)) }),
    }
  },
}

function few(rest: readonly string[], count: number, message: string): readonly string[] {
  return rest.length === count ? rest : bad(message, 'numbers')
}

function bytesOf(texts: readonly string[]): Buffer {
  return Buffer.concat(pastedBytes(texts.join(' '), 'the bytes'))
}

function decimal(text: string, what: string): number {
  if (/^\d{1,5}$/.test(text)) return Number(text)
  return bad(`${JSON.stringify(text)} is no decimal number: it is ${what}.`, 'numbers')
}

function bad(message: string, field: string): never {
  throw new RequestError('BAD_OPTION', message, field)
}
