import { readFile, rename, rm, writeFile } from 'node:fs/promises'
import { extname } from 'node:path'
import { type Command, Option } from 'commander'
import {
  createJwClient,
  createMelsecClient,
  diffTags,
  type ExplainedItem,
  exportTags,
  importTags,
  mergeTags,
  type ProfileId,
  type ReadTagItem,
  RequestError,
  type Tag,
  type TagCheckOptions,
  type TagDifference,
  type TagImport,
  type TagItem,
  type TagMergeOptions,
  tagFileEncodings,
  tagFileKinds,
  tagReaderOf,
} from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { profileOption, wRadixOption, xyRadixOption } from './connection-options'
import { exitCodes } from './exit-code'
import { byFamily, type FamilyOptions, familyOption, onlyFor } from './family'
import { choice, choiceArgument, jsonOption } from './option'
import { json, table } from './output'
import { refusalOf, type Terminal } from './terminal'

const examples = [
  'tags check labels.csv --profile iq-r',
  'tags diff labels.csv plant.json --profile iq-r',
  'tags import labels.csv plant.json --profile iq-r',
  'tags export plant.json plant.csv',
  'tags export plant.json labels.csv --kind gxWorks3Labels --profile iq-r',
]

const ACTIONS = ['import', 'check', 'diff', 'export'] as const
const DELIMITERS = { comma: ',', semicolon: ';', tab: '\t' } as const

interface TagsOptions extends FamilyOptions {
  readonly profile: ProfileId
  readonly xyRadix?: 8 | 16
  readonly wRadix?: 10 | 16
  readonly kind?: (typeof tagFileKinds)[number]
  readonly fileEncoding?: (typeof tagFileEncodings)[number]
  readonly delimiter?: keyof typeof DELIMITERS
  readonly template?: boolean
  readonly removeGone?: boolean
  readonly replaceConflicts?: boolean
  readonly yes?: boolean
  readonly force?: boolean
  readonly json?: boolean
}

/** `melsec-jw tags` */
export const tagsCommand: MakeCommand = (run) => {
  const command = newCommand('tags', 'tables of tags: import, check, diff, export', examples)
    .description(
      'Tables of tags in files. import brings labels or device comments of GX Works, CSV or JSON into a table, diff shows what that ' +
        'would change, check says what is wrong in a file, export writes a table as another file. No PLC is needed.',
    )
    .addArgument(choiceArgument('<action>', 'what to do', ACTIONS))
    .argument('<file>', 'check, diff, import: the file that is read; export: the table')
    .argument('[other]', 'diff, import: the table, .json or .csv; export: the file that is written')
  addTagOptions(command)
  return command.action(
    (action: (typeof ACTIONS)[number], file: string, other: string | undefined, options: TagsOptions) =>
      perform(run, options, () => {
        const work = () => act(run.terminal, action, file, other, options)
        return byFamily(command, options, { melsec: work, jw: work })
      }),
  )
}

function addTagOptions(command: Command): void {
  command.addOption(familyOption())
  onlyFor('melsec', 'A Sharp JW has one notation of operands: leave it out.', command, () =>
    command.addOption(profileOption().default('generic')).addOption(xyRadixOption()).addOption(wRadixOption()),
  )
  command
    .addOption(
      choice(
        '--kind <kind>',
        'what the file is; found out when it is read, by its name when it is written',
        tagFileKinds,
      ),
    )
    .addOption(
      choice('--file-encoding <name>', 'character code of the file; found out when it is read', tagFileEncodings),
    )
    .addOption(
      choice(
        '--delimiter <name>',
        'between the cells of CSV; found out when it is read',
        Object.keys(DELIMITERS) as (keyof typeof DELIMITERS)[],
      ),
    )
    .option('--template', 'the table is for many machines: {station} stands for what differs')
    .option('--remove-gone', 'import: remove tags that the file does not have')
    .option('--replace-conflicts', 'import: of tags in conflict take those of the file')
    .addOption(new Option('-y, --yes', 'import: do not ask'))
    .option('--force', 'export: replace a file')
    .addOption(jsonOption())
}

async function act(
  terminal: Terminal,
  action: (typeof ACTIONS)[number],
  file: string,
  other: string | undefined,
  options: TagsOptions,
): Promise<number> {
  if (action === 'check') {
    if (other !== undefined) throw new RequestError('BAD_OPTION', 'check takes one file.', 'other')
    return check(terminal, file, options)
  }
  if (other === undefined) {
    const missing = action === 'export' ? 'the file that is written' : 'the table, .json or .csv'
    throw new RequestError('BAD_OPTION', `${action} takes two files; the second is ${missing}.`, 'other')
  }
  if (action === 'export') return exported(terminal, file, other, options)
  return action === 'diff' ? diff(terminal, file, other, options) : imported(terminal, file, other, options)
}

async function check(terminal: Terminal, file: string, options: TagsOptions): Promise<number> {
  const found = await tagsIn(file, options)
  if (options.json === true) terminal.out(json({ file, ...found }))
  else {
    terminal.out(`${file}: ${found.kind}, ${found.encoding}: ${counted(found.tags.length, 'tag')}.`)
    tell(terminal, file, found)
  }
  return exitOf(found)
}

async function diff(terminal: Terminal, file: string, table: string, options: TagsOptions): Promise<number> {
  const found = await tagsIn(file, options)
  const difference = diffTags(await tableIn(table, options), found.tags, checksOf(options))
  if (options.json === true) terminal.out(json({ file, table, ...difference, messages: found.messages }))
  else {
    terminal.out(differenceText(difference))
    tell(terminal, file, found)
  }
  return exitOf(found)
}

async function imported(terminal: Terminal, file: string, target: string, options: TagsOptions): Promise<number> {
  const kind = tableKindOf(target)
  const found = await tagsIn(file, options)
  const before = await tableIn(target, options, true)
  const how: TagMergeOptions = {
    ...checksOf(options),
    ...(options.removeGone === true ? { gone: 'remove' } : {}),
    ...(options.replaceConflicts === true ? { conflicts: 'replace' } : {}),
  }
  const difference = diffTags(before, found.tags, how)
  const merged = mergeTags(before, found.tags, how)
  if (options.json !== true) tell(terminal, file, found)
  if (JSON.stringify(merged) === JSON.stringify(before)) {
    done(
      terminal,
      options,
      { file, table: target, ...difference, messages: found.messages },
      `${target}: nothing changes.`,
    )
    return exitOf(found)
  }
  const question = [`Change ${target}:`, differenceText(difference), ...effects(difference, options)].join('\n')
  // A table that is not there yet loses nothing.
  const refusal = before.length === 0 ? undefined : await refusalOf(terminal, options.yes === true, question)
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was changed. ${refusal}`, '--yes')
  await replace(target, exportTags(merged, { kind }).bytes)
  done(
    terminal,
    options,
    { file, table: target, ...difference, messages: found.messages },
    `${target}: ${counted(merged.length, 'tag')}.`,
  )
  return exitOf(found)
}

async function exported(terminal: Terminal, table: string, file: string, options: TagsOptions): Promise<number> {
  const { kind = tableKindOf(file), fileEncoding, delimiter, template } = options
  if (options.family === 'jw' && kind !== 'csv' && kind !== 'json') {
    throw new RequestError('UNSUPPORTED', 'GX Works knows no Sharp JW: export csv or json.', 'kind')
  }
  const tags = await tableIn(table, withoutFile(options))
  const { bytes, messages } = exportTags(tags, {
    kind,
    ...(fileEncoding === undefined ? {} : { encoding: fileEncoding }),
    ...(delimiter === undefined ? {} : { delimiter: DELIMITERS[delimiter] }),
    ...(template === true ? {} : { readItem: readerOf(options) }),
  })
  if (options.force === true) await replace(file, bytes)
  else await writeNew(file, bytes)
  const left = messages.filter(({ about }) => about === 'tag').length
  done(terminal, options, { table, file, kind, messages }, `${file}: ${counted(tags.length - left, 'tag')}.`)
  if (options.json !== true) for (const { name, message } of messages) terminal.error(`${name}: ${message}`)
  return left > 0 ? exitCodes.partly.code : exitCodes.ok.code
}

/** The options of the table that is exported: `--kind` and others are about the file. */
function withoutFile({
  kind: _kind,
  fileEncoding: _encoding,
  delimiter: _delimiter,
  ...options
}: TagsOptions): TagsOptions {
  return options
}

function done(terminal: Terminal, options: TagsOptions, data: object, text: string): void {
  terminal.out(options.json === true ? json(data) : text)
}

/** Some rows have become no tags. */
function exitOf({ messages }: TagImport): number {
  return messages.some(({ about }) => about === 'row') ? exitCodes.partly.code : exitCodes.ok.code
}

function tell(terminal: Terminal, file: string, { kind, messages }: TagImport): void {
  const at = kind === 'json' ? ' tag ' : ':'
  for (const { line, message } of messages) terminal.error(`${file}${at}${line}: ${message}`)
}

/** What the system says of a file, e.g. ENOENT. */
function systemCode(error: unknown): unknown {
  return typeof error === 'object' && error !== null && 'code' in error ? error.code : undefined
}

/** What this computer's file system refuses is the caller's to mend. */
function faultOf(file: string, error: unknown): unknown {
  if (systemCode(error) === undefined) return error
  const reason = typeof error === 'object' && error !== null && 'message' in error ? error.message : error
  return new RequestError('BAD_OPTION', `${file}: ${String(reason)}.`, 'file')
}

async function bytesOf(file: string): Promise<Uint8Array | undefined> {
  try {
    return await readFile(file)
  } catch (error) {
    if (systemCode(error) === 'ENOENT') return undefined
    throw faultOf(file, error)
  }
}

async function tagsIn(file: string, options: TagsOptions): Promise<TagImport> {
  const bytes = await bytesOf(file)
  if (bytes === undefined) throw new RequestError('BAD_OPTION', `There is no file ${file}.`, 'file')
  const { kind, fileEncoding, delimiter } = options
  return importTags(bytes, {
    ...checksOf(options),
    ...(kind === undefined ? {} : { kind }),
    ...(fileEncoding === undefined ? {} : { encoding: fileEncoding }),
    ...(delimiter === undefined ? {} : { delimiter: DELIMITERS[delimiter] }),
  })
}

/** A table is whole: what could not be read of it would be lost when it is written. */
async function tableIn(file: string, options: TagsOptions, mayBeNew = false): Promise<readonly Tag[]> {
  const bytes = await bytesOf(file)
  if (bytes === undefined && mayBeNew) return []
  if (bytes === undefined) throw new RequestError('BAD_OPTION', `There is no table ${file}.`, 'table')
  const { tags, messages, kind } = importTags(bytes, { template: options.template === true })
  if (messages.length === 0) return tags
  const list = messages.map(({ line, message }) => `${file}${kind === 'json' ? ' tag ' : ':'}${line}: ${message}`)
  throw new RequestError('BAD_OPTION', ['The table cannot be used.', ...list].join('\n'), 'table')
}

function checksOf(options: TagsOptions): TagCheckOptions {
  return options.template === true ? { template: true } : { readItem: readerOf(options) }
}

/** What a PLC of the family knows of addresses; it is never connected. */
function readerOf({ family, profile, xyRadix, wRadix }: TagsOptions): ReadTagItem {
  const nowhere = { host: 'none', port: 1 }
  const client: { explain(item: TagItem): ExplainedItem } =
    family === 'jw'
      ? createJwClient(nowhere)
      : createMelsecClient({
          ...nowhere,
          profile,
          ...(xyRadix === undefined ? {} : { xyRadix }),
          ...(wRadix === undefined ? {} : { wRadix }),
        })
  return tagReaderOf(client)
}

function tableKindOf(file: string): 'json' | 'csv' {
  const end = extname(file).toLowerCase()
  if (end === '.json') return 'json'
  if (end === '.csv') return 'csv'
  throw new RequestError('BAD_OPTION', `${file} is a table when it ends with .json or .csv.`, 'table')
}

async function replace(file: string, bytes: Uint8Array): Promise<void> {
  // Complete or not there: half a table must not be taken for the whole.
  const part = `${file}.part`
  try {
    await writeFile(part, bytes)
    await rename(part, file)
  } catch (error) {
    await rm(part, { force: true })
    throw faultOf(file, error)
  }
}

async function writeNew(file: string, bytes: Uint8Array): Promise<void> {
  try {
    await writeFile(file, bytes, { flag: 'wx' })
  } catch (error) {
    if (systemCode(error) === 'EEXIST') {
      throw new RequestError('BAD_OPTION', `${file} exists: say --force to replace it.`, 'file')
    }
    throw faultOf(file, error)
  }
}

function counted(number: number, what: string): string {
  return `${number} ${what}${number === 1 ? '' : 's'}`
}

/** Lines as a difference of files has them: + new, ~ changed, - gone, ! in conflict. */
function differenceText({ added, changed, gone, conflicts, same }: TagDifference): string {
  const rows = [
    ...added.map(({ name, address, type }) => ['+', name, type === undefined ? address : `${address} ${type}`]),
    ...changed.flatMap(({ name, fields }) =>
      fields.map(({ field, before, after }) => ['~', name, `${field}: ${fieldText(before)} -> ${fieldText(after)}`]),
    ),
    ...gone.map(({ name, address }) => ['-', name, address]),
    ...conflicts.map(({ name, reason }) => ['!', name, reason]),
  ]
  const counts = [
    `${added.length} new`,
    `${changed.length} changed`,
    `${gone.length} gone`,
    `${conflicts.length} in conflict`,
    `${same} the same`,
  ]
  return [...(rows.length === 0 ? [] : [table(rows)]), counts.join(', ')].join('\n')
}

function fieldText(value: unknown): string {
  return value === undefined ? '(none)' : typeof value === 'string' ? value : JSON.stringify(value)
}

function effects({ gone, conflicts }: TagDifference, options: TagsOptions): string[] {
  return [
    ...(gone.length === 0 ? [] : [`What is gone is ${options.removeGone === true ? 'removed' : 'kept'}.`]),
    ...(conflicts.length === 0
      ? []
      : [`What is in conflict is ${options.replaceConflicts === true ? 'replaced' : 'kept as it is'}.`]),
  ]
}
