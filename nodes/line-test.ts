// The serial line that a test of a connection is made on: the one that runs, or one of its own. A port that the runtime has open
// is never opened a second time.
import type { NodeAPI } from 'node-red'
import { createMelsecLine, type MelsecLine, type MelsecLineOptions } from '../src/index'
import { refusal } from './failure'
import { resolverOf } from './fields'
import { lineAt, lineOf, type PlcLine } from './line'
import { lineOptionsOf, lineSettingsOf } from './line-settings'
import type { StoredSettings } from './migration'
import { type Texts, textsOf } from './texts'

/** ms that a search waits for the first character of an answer on a line of its own: most of the stations are not there. */
const SEARCH_ANSWER_TIME = 500

/** What a test is made on. */
export interface TestedLine {
  readonly line: MelsecLine
  /** What it is made of. */
  readonly options: MelsecLineOptions
  /** Whether the runtime has its port open. */
  readonly isTaken: () => boolean
}

/**
 * @param id the line node
 * @param given its settings as they stand in the editor, also before they are deployed; without any the deployed ones
 * @param searching many stations are asked that are not there
 * @throws NodeFailure when there is no line, its settings are wrong, or its port is open with others
 */
export function lineToTest(
  RED: NodeAPI,
  { id, given, searching }: { readonly id: string; readonly given: StoredSettings; readonly searching: boolean },
  texts: Texts,
): TestedLine {
  const node = RED.nodes.getNode(id)
  const running = lineOf(node)
  if (Object.keys(given).length === 0) {
    if (running === undefined) throw refusal('NOT_CONFIGURED', texts('error.noLine'), { field: 'line' })
    return testedOf(running)
  }
  const context = { texts, labels: textsOf(RED, 'melsec-jw-line'), resolve: resolverOf(RED, node, texts) }
  const options = lineOptionsOf(lineSettingsOf(given, context), context)
  if (running?.isLike(options) === true) return testedOf(running)
  const own = searching ? hurried(options) : options
  const line = createMelsecLine(own)
  if (lineAt(options) === undefined) return { line, options: own, isTaken: () => lineAt(options) !== undefined }
  throw refusal('PORT_UNAVAILABLE', texts('error.lineInUse', { line: line.description }), { field: 'line' })
}

function testedOf(running: PlcLine): TestedLine {
  const { line, options = {} } = running
  return { line, options: hurried(options), isTaken: () => running.isOpen }
}

function hurried(options: MelsecLineOptions): MelsecLineOptions {
  return { ...options, serial: { answerTime: SEARCH_ANSWER_TIME, ...options.serial } }
}
