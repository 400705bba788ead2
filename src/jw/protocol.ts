import { hex } from '../basics/hex'
import { EndCodeError } from '../errors'
import { endedWith, HeadProtocol } from '../link/link'
import { jwCommands } from './commands'
import { type JwFrameOptions, type JwHead, jwFrame } from './frame'
import { resultFacts } from './result-codes'

/**
 * The JW-255CM commands over Ethernet; binary only.
 * @example jwProtocol().exchange(jwCommands.readDataMemory, { head: { segment: 0, address: 0o4000 }, length: 4 })
 */
export function jwProtocol(options: JwFrameOptions = {}): HeadProtocol<JwHead> {
  return new HeadProtocol<JwHead>({
    framing: jwFrame(options),
    commands: jwCommands,
    code: 'binary',
    form: 0,
    headOf: (command) => ({ command: command.code }),
    codeOf: (head) => head.command,
    refusal: (command, frame) => {
      const facts = resultFacts.refusal(command, frame.endCode)
      const what = endedWith(facts, `result code ${hex(frame.endCode, 2)}H`)
      return new EndCodeError(frame.endCode, `${command.title} ${what}.`, { family: 'jw', ...facts })
    },
  })
}
