// On-demand of the simulated PLC: by itself, and as somebody types it.
import { createInterface } from 'node:readline'
import { InvalidArgumentError } from 'commander'
import type { OnDemandData, PlcSimulator } from '../entry/simulator'
import { PlcError, RequestError } from '../index'
import type { Terminal } from './terminal'
import { typedValue } from './typed-value'

/**
 * Words as they are typed: decimal, or hexadecimal as `0xFFFF`; a negative number is the word that GX Works shows so.
 * @throws RequestError BAD_VALUE
 * @example wordsTyped('1, -1, 0x1F')   // [1, 65535, 31]
 */
function wordsTyped(text: string): readonly number[] {
  const parts = text.split(/[\s,]+/).filter((part) => part !== '')
  return parts.map((part) => {
    const word = typedValue({ text: 'On-demand', type: 'DINT' }, part)
    if (typeof word === 'number' && word >= -0x8000 && word <= 0xffff) return word & 0xffff
    throw new RequestError('BAD_VALUE', `On-demand takes words from -32768 to 65535, not ${part}.`, 'On-demand')
  })
}

/** The words of an option. */
export function onDemandWords(text: string): readonly number[] {
  try {
    return wordsTyped(text)
  } catch (error) {
    if (error instanceof PlcError) throw new InvalidArgumentError(error.message)
    throw error
  }
}

/** Sends the words to every client, with `ms` before each. @returns what ends it */
export function sendAgainAndAgain(plc: PlcSimulator, words: readonly number[], ms: number): () => void {
  let cancel = () => {}
  const wait = () => {
    cancel = plc.clock.timer(ms, () => {
      plc.sendOnDemand(words)
      wait()
    })
  }
  wait()
  return () => cancel()
}

/** Does what the lines of the standard input say. @returns what ends it */
export function takeLines(terminal: Terminal, plc: PlcSimulator): () => void {
  // Not as a terminal of its own: Ctrl-C must still end the program.
  const lines = createInterface({ input: process.stdin, terminal: false })
  lines.on('line', (line) => {
    try {
      obey(terminal, plc, line.trim())
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      terminal.error(error.message)
    }
  })
  return () => lines.close()
}

const HELP = 'Type "ondemand 1 2 0xFFFF" to send words, or "ondemand \'text\'" to send characters.'

function obey(terminal: Terminal, plc: PlcSimulator, line: string): void {
  if (line === '') return
  const [, given] = /^on-?demand(?:\s+(.*))?$/i.exec(line) ?? [undefined, HELP]
  if (given === HELP) {
    terminal.error(HELP)
    return
  }
  const told = plc.sendOnDemand(dataTyped(given ?? ''))
  terminal.error(`Sent to ${told} ${told === 1 ? 'client' : 'clients'}.`)
}

function dataTyped(text: string): OnDemandData {
  const [, , characters] = /^(['"])(.*)\1$/.exec(text) ?? []
  if (characters === undefined) return wordsTyped(text)
  if (/^[\x20-\x7e]*$/.test(characters)) return Buffer.from(characters, 'latin1')
  throw new RequestError('BAD_VALUE', 'On-demand takes a text of the characters 20H to 7EH (ASCII) here.', 'On-demand')
}
