// The program with its commands: `melsec-jw`.
import { Command, CommanderError } from 'commander'
import { memoryCommand, moduleCommand } from './buffer-memory'
import type { CommandRun, MakeCommand } from './command'
import { commandsCommand } from './commands'
import { controlCommand } from './control'
import { cpCommand } from './cp'
import { decodeCommand } from './decode'
import { exitCodeHelp, exitCodes } from './exit-code'
import { explainCommand } from './explain'
import { getCommand } from './get'
import { identifyCommand } from './identify'
import { bufferCommand } from './jw/buffer'
import { clockCommand } from './jw/clock'
import { findHeaderCommand } from './jw/find-header'
import { parametersCommand } from './jw/parameters'
import { listenCommand } from './listen'
import { lsCommand } from './ls'
import { profilesCommand } from './profiles'
import { putCommand } from './put'
import { readCommand } from './read'
import { requestCommand } from './request'
import { rmCommand } from './rm'
import { simulateCommand } from './simulate'
import { tagsCommand } from './tags'
import type { Terminal } from './terminal'
import { writeCommand } from './write'

const COMMANDS: readonly MakeCommand[] = [
  identifyCommand,
  readCommand,
  writeCommand,
  controlCommand,
  requestCommand,
  commandsCommand,
  memoryCommand,
  moduleCommand,
  lsCommand,
  getCommand,
  putCommand,
  cpCommand,
  rmCommand,
  listenCommand,
  clockCommand,
  findHeaderCommand,
  parametersCommand,
  bufferCommand,
  simulateCommand,
  tagsCommand,
  decodeCommand,
  profilesCommand,
  explainCommand,
]

const DESCRIPTION =
  'Talk to Mitsubishi MELSEC PLCs over SLMP (MC protocol: 3E, 4E, station extension and 1E frames) and serial lines, to Sharp JW PLCs ' +
  'with --family jw, and simulate one. A MELSEC ' +
  'needs an SLMP entry in its Ethernet parameters; give its address and port with --plc, or once and for all in the environment ' +
  'variable MELSEC_JW_PLC. "melsec-jw help read" explains a command.'

/**
 * Runs the command line.
 * @param args what stands behind the program's name
 * @returns the exit code
 */
export async function runProgram(args: readonly string[], version: string, terminal: Terminal): Promise<number> {
  let exitCode: number = exitCodes.ok.code
  const program = new Command('melsec-jw').description(DESCRIPTION).version(version).addHelpText('after', exitCodeHelp)
  const run: CommandRun = {
    terminal,
    exit: (code) => {
      exitCode = code
    },
  }
  for (const make of COMMANDS) program.addCommand(make(run))
  for (const command of [program, ...program.commands]) configure(command, terminal)
  try {
    await program.parseAsync([...args], { from: 'user' })
    return exitCode
  } catch (error) {
    // Commander ends so for help and version, too; what is wrong it has printed already.
    if (error instanceof CommanderError) return error.exitCode === 0 ? exitCodes.ok.code : exitCodes.usage.code
    throw error
  }
}

function configure(command: Command, terminal: Terminal): void {
  const trimmed = (text: string) => text.replace(/\n$/, '')
  command
    .exitOverride()
    .showHelpAfterError('(add --help for the options)')
    .configureOutput({
      writeOut: (text) => terminal.out(trimmed(text)),
      writeErr: (text) => terminal.error(trimmed(text)),
    })
}
