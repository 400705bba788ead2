// Parameters of the units of a Sharp JW: as settings where a map says what they mean, else as bytes.
import { Option } from 'commander'
import { hexPairs } from '../../basics/hex'
import { octal } from '../../basics/octal'
import {
  dl1Parameters,
  dl9Parameters,
  flNetParameters,
  type ParameterMap,
  type ParameterProblem,
  type ParameterRow,
} from '../../entry/codec'
import { type JwClient, type JwUnitPlace, type ParameterBlock, RequestError } from '../../index'
import { pastedBytes } from '../bytes'
import { type MakeCommand, newCommand, perform } from '../command'
import { exitCodes } from '../exit-code'
import { onlyOf } from '../family'
import { choice, whole } from '../option'
import { json, table } from '../output'
import type { Plc } from '../session'
import { refusalOf, type Terminal } from '../terminal'
import { addJwConnectionOptions, type JwConnectionOptions, jwPlc } from './connection'

const examples = [
  'parameters read --unit 3 --map fl-net --plc 192.168.3.60:4000',
  'parameters read 3776 2 --unit 3 --plc 192.168.3.60:4000',
  `parameters write '{"stations":[{"bytes":8},{"bytes":4}]}' --unit 3 --map dl1 --plc 192.168.3.60:4000`,
  "parameters write 010 'AA 55' --unit 3 --special-io --plc 192.168.3.60:4000",
]

const NO_PARAMETERS = {
  what: 'such parameters of units',
  instead: 'Buffer memory of its modules is reached with module, or as items: read U3\\G100.',
}

const MAP_NAMES = ['fl-net', 'dl1', 'dl9'] as const

interface ParameterOptions extends JwConnectionOptions {
  readonly yes?: boolean
  readonly rack: number
  readonly unit: number
  readonly map?: (typeof MAP_NAMES)[number]
  readonly unitNumber?: number
  readonly specialIo?: boolean
}

/** A map with what the switches of the unit say. */
interface KnownUnit {
  readonly title: string
  readonly areas: readonly { readonly address: number; readonly length: number }[]
  read(blocks: readonly ParameterBlock[]): {
    readonly settings: unknown
    readonly problems: readonly ParameterProblem[]
  }
  explain(blocks: readonly ParameterBlock[]): readonly ParameterRow[]
  /** @throws RequestError */
  write(settings: object): {
    readonly blocks: readonly ParameterBlock[]
    readonly warnings: readonly ParameterProblem[]
  }
}

function known<S extends object, R extends S, A>(map: ParameterMap<S, R, A>, about: A): KnownUnit {
  return {
    title: map.unit,
    areas: map.areas,
    read: (blocks) => map.read(blocks, about),
    explain: (blocks) => map.explain(blocks, about),
    // What was typed is whatever it is: the map checks every name and value.
    write: (settings) => map.write(settings as S, about),
  }
}

function unitOf({ map, unitNumber }: ParameterOptions): KnownUnit | undefined {
  if (unitNumber !== undefined && map !== 'dl9') {
    throw new RequestError('BAD_OPTION', '--unit-number is of --map dl9.', 'unitNumber')
  }
  if (map === undefined) return undefined
  if (map === 'fl-net') return known(flNetParameters, undefined)
  if (map === 'dl1') return known(dl1Parameters, undefined)
  if (unitNumber !== undefined) return known(dl9Parameters, { unitNumber })
  throw new RequestError(
    'BAD_OPTION',
    '--map dl9 needs --unit-number, the unit number switch of the master (0 to 5).',
    'unitNumber',
  )
}

/** `melsec-jw parameters` */
export const parametersCommand: MakeCommand = (run) => {
  const command = newCommand('parameters', 'parameters of the units of a Sharp JW (asks before writing)', examples)
    .description(
      'Reads and writes the parameters of option units and special I/O units. With --map they are settings, as the manual names them; ' +
        'without it bytes from an octal address on. An option unit takes what is written over with its start switch: it is stopped, written, ' +
        'started, and its check code is read back.',
    )
    .argument('<action>', 'read or write')
    .argument('[what]', 'with --map: write takes the settings as JSON. Else the first parameter, octal')
    .argument('[bytes]', 'without --map: read how many bytes, decimal; write the bytes, hexadecimal')
    .optionsGroup('Unit:')
    .addOption(new Option('--rack <number>', 'rack of the unit, 0 to 7').default(0).argParser(whole(0, 7)))
    .addOption(new Option('--unit <number>', 'unit in the rack, 0 to 7').makeOptionMandatory().argParser(whole(0, 7)))
    .option('--special-io', 'a special I/O unit; without it an option unit')
    .addOption(choice('--map <name>', 'what the parameters mean: FL-net units, JW-21CM DL1 or DL9', MAP_NAMES))
    .addOption(new Option('--unit-number <number>', 'dl9: the unit number switch').argParser(whole(0, 5)))
    .option('-y, --yes', 'do not ask')
  addJwConnectionOptions(command)
  return command.action(
    (action: string, what: string | undefined, bytes: string | undefined, options: ParameterOptions) =>
      perform(run, options, () =>
        onlyOf('jw', NO_PARAMETERS, options, () => parameters(run.terminal, { action, what, bytes }, options)),
      ),
  )
}

interface Typed {
  readonly action: string
  readonly what: string | undefined
  readonly bytes: string | undefined
}

async function parameters(terminal: Terminal, typed: Typed, options: ParameterOptions): Promise<number> {
  const { action, what, bytes } = typed
  const unit = unitOf(options)
  if (unit !== undefined && options.specialIo === true) bad('--map is of option units: leave --special-io out.', 'map')
  if (unit !== undefined && bytes !== undefined) bad('With --map there are settings, and no bytes.', 'bytes')
  const plc = jwPlc(terminal, options)
  if (action === 'read') {
    if (unit === undefined) return readBytes(terminal, addressOf(what), lengthOf(bytes), options, plc)
    if (what !== undefined) bad('With --map all that the map names is read: leave the address out.', 'what')
    return readSettings(terminal, unit, options, plc)
  }
  if (action !== 'write') bad(`There is no ${JSON.stringify(action)}: choose read or write.`, 'action')
  if (unit === undefined) return writeBytes(terminal, addressOf(what), bytes ?? '', options, plc)
  return writeSettings(terminal, unit, settingsOf(what === '-' ? await terminal.input() : what), options, plc)
}

async function readSettings(
  terminal: Terminal,
  unit: KnownUnit,
  options: ParameterOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  const blocks = await plc.with('reading', async ({ parameters }) => {
    const found: ParameterBlock[] = []
    for (const { address, length } of unit.areas) {
      found.push({ address, bytes: await parameters.optionUnit(placeOf(options)).read(address, length) })
    }
    return found
  })
  const { settings, problems } = unit.read(blocks)
  if (options.json === true) terminal.out(json({ plc: plc.text, ...placeOf(options), settings, problems }))
  else terminal.out(rowsText(unit.explain(blocks)))
  for (const { severity, setting, message } of problems) terminal.error(`${severity}: ${setting}: ${message}`)
  return exitCodes.ok.code
}

async function writeSettings(
  terminal: Terminal,
  unit: KnownUnit,
  settings: object,
  options: ParameterOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  const { blocks, warnings } = unit.write(settings)
  for (const { setting, message } of warnings) terminal.error(`warning: ${setting}: ${message}`)
  return writeBlocks(terminal, blocks, rowsText(unit.explain(blocks), '  '), options, plc)
}

async function readBytes(
  terminal: Terminal,
  address: number,
  length: number,
  options: ParameterOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  const reading = ({ parameters }: JwClient) =>
    options.specialIo === true
      ? parameters.specialIo(placeOf(options)).read(address, length)
      : parameters.optionUnit(placeOf(options)).read(address, length)
  await plc.unsent('reading', reading)
  const bytes = await plc.with('reading', reading)
  if (options.json === true) terminal.out(json({ plc: plc.text, ...placeOf(options), address, bytes }))
  else terminal.out(bytesText([{ address, bytes }]))
  return exitCodes.ok.code
}

async function writeBytes(
  terminal: Terminal,
  address: number,
  text: string,
  options: ParameterOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  const blocks = [{ address, bytes: Buffer.concat(pastedBytes(text, 'the bytes')) }]
  return writeBlocks(terminal, blocks, bytesText(blocks, '  '), options, plc)
}

async function writeBlocks(
  terminal: Terminal,
  blocks: readonly ParameterBlock[],
  shown: string,
  options: ParameterOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  const writing = async ({ parameters }: JwClient) => {
    if (options.specialIo !== true) return parameters.optionUnit(placeOf(options)).write(blocks)
    for (const { address, bytes } of blocks) await parameters.specialIo(placeOf(options)).write(address, bytes)
    return undefined
  }
  await plc.unsent('parameters', writing)
  const { rack, unit } = options
  const what =
    options.specialIo === true ? 'the special I/O unit' : 'the option unit, which is stopped and started for it'
  const question = `Write parameters of ${what} (rack ${rack}, unit ${unit} of ${plc.text}):\n${shown}`
  const refusal = await refusalOf(terminal, options.yes === true, question)
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was written. ${refusal}`, '--yes')
  const started = await plc.with('parameters', writing)
  if (options.json === true) terminal.out(json({ plc: plc.text, ...placeOf(options), ...started, ok: true }))
  else
    terminal.out(
      `Written.${started === undefined ? '' : ` The unit was started; its check code is ${started.checkCode}.`}`,
    )
  return exitCodes.ok.code
}

function placeOf({ rack, unit }: ParameterOptions): JwUnitPlace {
  return { rack, unit }
}

/** Addresses as the manual prints them. */
function rowsText(rows: readonly ParameterRow[], indent = ''): string {
  return table(
    rows.map(({ address, bytes, setting, text }) => [octal(address, 4), bytes, setting, text]),
    indent,
  )
}

const IN_A_ROW = 8

function bytesText(blocks: readonly ParameterBlock[], indent = ''): string {
  const rows = blocks.flatMap(({ address, bytes }) =>
    Array.from({ length: Math.ceil(bytes.length / IN_A_ROW) }, (_, i) => [
      octal(address + i * IN_A_ROW, 4),
      hexPairs(bytes.subarray(i * IN_A_ROW, (i + 1) * IN_A_ROW)),
    ]),
  )
  return table(rows, indent)
}

function addressOf(text: string | undefined): number {
  if (text !== undefined && /^[0-7]{1,4}$/.test(text)) return Number.parseInt(text, 8)
  const found = text === undefined ? 'is missing' : `${JSON.stringify(text)} is no octal number from 0000 to 3777`
  return bad(`The first parameter ${found}. Give it, e.g. 3776; or say with --map what the parameters mean.`, 'what')
}

function lengthOf(text: string | undefined): number {
  const length = text !== undefined && /^\d{1,4}$/.test(text) ? Number(text) : Number.NaN
  return length >= 1 ? length : bad('How many bytes? Give a decimal number behind the address.', 'bytes')
}

function settingsOf(text = ''): object {
  try {
    const settings: unknown = JSON.parse(text)
    if (typeof settings === 'object' && settings !== null && !Array.isArray(settings)) return settings
  } catch (error) {
    if (!(error instanceof SyntaxError)) throw error
  }
  return bad(
    'The settings are no JSON object: docs/jw-parameters.md lists them. parameters read --json prints those of now.',
    'what',
  )
}

function bad(message: string, field: string): never {
  throw new RequestError('BAD_OPTION', message, field)
}
