/** The commands shown in the documentation run as they stand there, and every command and option of the help is in docs/cli.md. */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { exitCodes } from '../../src/cli/exit-code'
import { runProgram } from '../../src/cli/program'
import type { Terminal } from '../../src/cli/terminal'
import { fencesOf, pages, proseOf, tableAfter } from './markdown'
import { Bench } from './programs'

interface Printed {
  readonly exit: number
  readonly text: string
}

async function run(args: readonly string[]): Promise<Printed> {
  const printed: string[] = []
  const print = (text: string) => void printed.push(text)
  const terminal: Terminal = {
    out: print,
    error: print,
    interactive: true,
    ask: async () => 'y',
    input: async () => '',
  }
  const exit = await runProgram(args, '0.0.0', terminal)
  return { exit, text: printed.join('\n') }
}

/** Arguments as a shell takes a line apart: at spaces, unless they are quoted. */
function argumentsOf(line: string): string[] {
  return [...line.matchAll(/'([^']*)'|(\S+)/g)].map(([, quoted, plain = '']) => quoted ?? plain)
}

const lines = pages.flatMap((page) =>
  fencesOf(page)
    .filter(({ info }) => info[0] === 'sh')
    .flatMap(({ text }) => text.split('\n'))
    .filter((line) => line.startsWith('melsec-jw '))
    .map((line) => ({ page, line, args: argumentsOf(line).slice(1) })),
)

/** The command's options with two hyphens, as its help lists them. */
async function optionsOf(command: string): Promise<string[]> {
  const { text } = await run(['help', command])
  return [...text.matchAll(/^ {2}(?:-\w, )?(--[\w-]+)/gm)].map(([, option = '']) => option)
}

async function commandsOf(): Promise<string[]> {
  const { text } = await run(['--help'])
  const [, list = ''] = /\nCommands:\n((?: {2}.*\n)+)/.exec(text) ?? []
  return [...list.matchAll(/^ {2}(\w[\w-]*)/gm)].flatMap(([, name = '']) => (name === 'help' ? [] : [name]))
}

/** As a spreadsheet saves labels of GX Works3. */
const LABELS = 'Label Name,Data Type,Assign (Device/Label),Comment\r\nLevel,Word [Signed],D100,level\r\n'

describe('the line', () => {
  const bench = new Bench()
  const home = process.cwd()
  const folder = mkdtempSync(join(tmpdir(), 'melsec-jw-'))
  beforeAll(async () => {
    // Files of the reader's computer that the lines name.
    mkdirSync(join(folder, 'backup'))
    writeFileSync(join(folder, 'recipe.csv'), 'A,72.5,15\r\n')
    writeFileSync(join(folder, 'labels.csv'), LABELS)
    process.chdir(folder)
    await bench.open()
  })
  afterAll(async () => {
    process.chdir(home)
    rmSync(folder, { recursive: true, force: true })
    await bench.close()
  })

  /** They go on until Ctrl-C. */
  const endless = ['simulate', 'listen']
  test.each(lines.filter(({ args }) => !endless.includes(args[0] ?? '')))('$line ($page) runs', async ({ args }) => {
    const { exit, text } = await run(args.map((arg) => bench.addressOf(arg)))
    expect(`${exit} ${text}`).toMatch(/^0 /)
  })

  test('exists in docs/cli.md for each command', async () => {
    const shown = new Set(lines.filter(({ page }) => page === 'docs/cli.md').map(({ args }) => args[0]))
    expect((await commandsOf()).filter((name) => !shown.has(name))).toEqual([])
  })

  test('uses options that its command has', async () => {
    for (const { line, args } of lines) {
      const known = await optionsOf(args[0] ?? '')
      expect([line, args.filter((arg) => arg.startsWith('--') && !known.includes(arg))]).toEqual([line, []])
    }
  })
})

describe('docs/cli.md', () => {
  const page = 'docs/cli.md'

  test('names every command', async () => {
    const names = tableAfter(page, 'commands').flatMap(([cell = '']) => /`([\w-]+)`/.exec(cell)?.[1] ?? [])
    expect(names).toEqual(await commandsOf())
  })

  test('names every option of every command', async () => {
    const named = new Set([...proseOf(page).matchAll(/`(--[\w-]+)[^`]*`/g)].map(([, option]) => option))
    for (const command of await commandsOf()) {
      const missing = (await optionsOf(command)).filter((option) => option !== '--help' && !named.has(option))
      expect([command, missing]).toEqual([command, []])
    }
  })

  test('names the exit codes', () => {
    const shown = tableAfter(page, 'exit codes').map(([code, meaning]) => [Number(code), meaning])
    expect(shown).toEqual(Object.values(exitCodes).map(({ code, meaning }) => [code, meaning]))
  })
})
