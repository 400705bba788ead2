import { hex } from '../basics/hex'
import { oneOf } from '../basics/option-checks'
import { EndCodeError } from '../errors'
import { endedWith, HeadProtocol } from '../link/link'
import { checkSendable } from './check'
import { type JwModel, jwModels } from './commands/command'
import { jwCommands } from './commands/commands'
import { markerForms } from './commands/data-memory'
import { type JwFrameOptions, type JwHead, jwFrame } from './frame'
import { explainResultCode } from './result-codes/explain'
import { resultFacts } from './result-codes/facts'

export interface JwProtocolOptions extends JwFrameOptions {
  /** Where FFH stands in lists of relays and registers: once before the first (as the manual draws it) or before each. Default `once`. */
  readonly marker?: keyof typeof markerForms
  /** What it may be asked. Default `jw300`. */
  readonly model?: JwModel
}

/**
 * The JW-255CM commands over Ethernet; binary only, one request in flight.
 * @throws RequestError BAD_OPTION
 * @example jwProtocol().exchange(jwCommands.readDataMemory, { head: { file: 0, address: 0o4000 }, length: 4 })
 */
export function jwProtocol({
  marker = 'once',
  model = 'jw300',
  ...frame
}: JwProtocolOptions = {}): HeadProtocol<JwHead> {
  oneOf('model', model, jwModels)
  oneOf('marker', marker, Object.keys(markerForms))
  return new HeadProtocol<JwHead>({
    framing: jwFrame(frame),
    commands: jwCommands,
    code: 'binary',
    form: markerForms[marker],
    headOf: (command) => ({ command: command.code }),
    codeOf: (head) => head.command,
    prepare: (command, message) => {
      checkSendable(command, message, model)
      return message
    },
    refusal: (command, frame) => {
      const facts = resultFacts.refusal(command, frame.endCode)
      const what = endedWith(facts, `result code ${hex(frame.endCode, 2)}H`)
      const text = explainResultCode(frame.endCode)
      const sentences = text === undefined ? 'No text is known for this code.' : `${text.meaning} ${text.remedy}`
      const texts = text === undefined ? {} : { meaning: text.meaning, remedy: text.remedy }
      return new EndCodeError(frame.endCode, `${command.title} ${what}. ${sentences}`, {
        family: 'jw',
        ...facts,
        ...texts,
      })
    },
  })
}
