// Connects to a Sharp JW, and says what it tells of itself.
import { hex } from '../../basics/hex'
import type { JwClient, JwInfo } from '../../index'
import { exitCodes } from '../exit-code'
import { json, table } from '../output'
import type { Plc } from '../session'
import type { Terminal } from '../terminal'
import { clockText } from './clock'
import { headerText, type JwConnectionOptions } from './connection'
import { MODES, STATES } from './control'

export function identifyJw(terminal: Terminal, options: JwConnectionOptions, plc: Plc<JwClient>): Promise<number> {
  return plc.with('reading', async (client) => {
    const info = await client.info()
    const { roundTrip: { last: roundTrip } = {} } = client.statistics
    if (options.json === true) terminal.out(json({ plc: plc.text, ...info, roundTrip }))
    else {
      const link = `${plc.text}, header ${headerText(options.header ?? 'none')}`
      const time = roundTrip === undefined ? 'not measured' : `${roundTrip.toFixed(1)} ms`
      terminal.out(table([['PLC', link], ...rowsOf(info), ['Round trip', time]]))
    }
    return exitCodes.ok.code
  })
}

/** What it refuses to tell is said to be so. */
function rowsOf({ memorySize, runState, writeMode, secret, clock }: JwInfo): string[][] {
  return [
    ['Program memory', memorySize === undefined ? NOT_TOLD : memoryText(memorySize)],
    ['Run state', runState === undefined ? NOT_TOLD : STATES[runState]],
    ['Write mode', writeMode === undefined ? NOT_TOLD : `${writeMode}: ${MODES[writeMode]}`],
    ['Secret', secret === undefined ? NOT_TOLD : secret ? 'the secret function is enabled' : 'not enabled'],
    ['Clock', clock === undefined ? NOT_TOLD : clockText(clock)],
  ]
}

const NOT_TOLD = 'not told'

function memoryText({ code, kiloWords }: NonNullable<JwInfo['memorySize']>): string {
  return `${kiloWords === undefined ? 'of a size that is not in the manual' : `${kiloWords} K words`} (${hex(code, 2)}H)`
}
