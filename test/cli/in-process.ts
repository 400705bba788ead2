/** The command line without a process of its own: for the many cases that differ in a word only. */
import { runProgram } from '../../src/cli/program'
import type { Terminal } from '../../src/cli/terminal'
import type { Ended } from './cli'

export interface Answered extends Ended {
  readonly questions: readonly string[]
}

/**
 * Runs `melsec-jw` in this process.
 * @param answer what somebody types who is asked; `undefined`: nobody is there
 * @param input the standard input
 */
export async function runHere(args: readonly string[], answer?: string, input = ''): Promise<Answered> {
  const questions: string[] = []
  let out = ''
  let err = ''
  const terminal: Terminal = {
    out: (text) => {
      out += `${text}\n`
    },
    error: (text) => {
      err += `${text}\n`
    },
    interactive: answer !== undefined,
    ask: async (question) => {
      questions.push(question)
      return answer ?? ''
    },
    input: async () => input,
  }
  const code = await runProgram(args, '1.2.3', terminal)
  return { code, out, err, questions }
}
