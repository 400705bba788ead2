// What every command has in common: a name, a line that says what it does, examples, and how it ends.
import { Command } from 'commander'
import { PlcError } from '../index'
import { exitOf } from './exit-code'
import { printError } from './output'
import type { Terminal } from './terminal'

/** One run of the command line. */
export interface CommandRun {
  readonly terminal: Terminal
  /** Says what the process ends with. */
  exit(code: number): void
}

/** Adds a command to the program. */
export type MakeCommand = (run: CommandRun) => Command

/** A command with examples in its help. */
export function newCommand(name: string, summary: string, examples: readonly string[]): Command {
  const shown = examples.map((example) => `  melsec-jw ${example}`).join('\n')
  return new Command(name).summary(summary).description(summary).addHelpText('after', `\nExamples:\n${shown}`)
}

/** Runs a command: `work` gives the exit code, or throws what went wrong. */
export async function perform(
  run: CommandRun,
  options: { readonly json?: boolean },
  work: () => Promise<number>,
): Promise<void> {
  try {
    run.exit(await work())
  } catch (error) {
    if (!(error instanceof PlcError)) throw error
    printError(run.terminal, error, options.json === true)
    run.exit(exitOf(error))
  }
}
