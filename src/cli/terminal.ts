// Where the command line writes to and whom it asks.
import { createInterface } from 'node:readline/promises'
import { Writable } from 'node:stream'

export interface Terminal {
  /** Results. */
  out(text: string): void
  /** Everything else: errors, questions, traces. */
  error(text: string): void
  /** Whether somebody is there to answer a question. */
  readonly interactive: boolean
  /** The answer that was typed; empty when the input ended. `hidden`: it does not appear on the screen. */
  ask(question: string, options?: { readonly hidden?: boolean }): Promise<string>
  /** All of the standard input. */
  input(): Promise<string>
}

/** The terminal of this process. */
export function processTerminal(): Terminal {
  return {
    out: (text) => void process.stdout.write(`${text}\n`),
    error: (text) => void process.stderr.write(`${text}\n`),
    // The question goes to stderr, so that the results can be piped.
    interactive: process.stdin.isTTY === true && process.stderr.isTTY === true,
    ask: async (question, { hidden = false } = {}) => {
      if (hidden) process.stderr.write(question)
      const output = hidden ? nowhere() : process.stderr
      const lines = createInterface({ input: process.stdin, output, terminal: process.stderr.isTTY === true })
      const ended = new Promise<string>((resolve) => lines.once('close', () => resolve('')))
      try {
        return await Promise.race([lines.question(hidden ? '' : question), ended])
      } finally {
        lines.close()
        if (hidden) process.stderr.write('\n')
      }
    },
    input: async () => {
      const chunks: Buffer[] = []
      for await (const chunk of process.stdin) chunks.push(Buffer.from(chunk))
      return Buffer.concat(chunks).toString('utf8')
    },
  }
}

/** Takes what would appear on the screen. */
function nowhere(): Writable {
  return new Writable({ write: (_chunk, _encoding, done) => done() })
}

/**
 * Whether to go on with something that changes the PLC: said beforehand (`yes`), or answered with y.
 * @returns why not; `undefined` to go on.
 */
export async function refusalOf(terminal: Terminal, yes: boolean, what: string): Promise<string | undefined> {
  if (yes) return undefined
  if (!terminal.interactive) return 'This is no terminal to ask on. Look at what is to be done, then say --yes.'
  const answer = await terminal.ask(`${what}\nGo on? [y/N] `)
  return /^\s*y(es)?\s*$/i.test(answer) ? undefined : 'Not confirmed.'
}
