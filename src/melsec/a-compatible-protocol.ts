import { type DataCode, readerOf } from '../codec/codec'
import { EndCodeError } from '../errors'
import { HeadProtocol, type NamedCommand, type ResponseFrame } from '../link/link'
import { aCompatibleCommands } from './a-compatible'
import { FORM_XY_OCTAL } from './device-codec'
import { explainEndCode } from './end-code'
import { frame1e, type Head1e } from './frame-1e'

export interface ACompatibleOptions {
  readonly code: DataCode
  /** PC number, default FFH: the connected station. */
  readonly pc?: number
  /** Monitoring timer in units of 250 ms, default 0 = wait for ever, which an FX5 CPU module demands. */
  readonly timer?: number
  /** ASCII code with octal X/Y digits: a setting of the PLC's port. */
  readonly xyOctal?: boolean
}

/**
 * The 1E frame with its command set.
 * @example aCompatibleProtocol({ code: 'binary' }).exchange(aCompatibleCommands.readWords, { head, points: 3 })
 */
export function aCompatibleProtocol(options: ACompatibleOptions): HeadProtocol<Head1e> {
  const { code, pc = 0xff, timer = 0 } = options
  return new HeadProtocol<Head1e>({
    framing: frame1e(code),
    commands: aCompatibleCommands,
    code,
    form: options.xyOctal === true ? FORM_XY_OCTAL : 0,
    headOf: (command) => ({ command: command.code, pc, timer }),
    codeOf: (head) => head.command,
    refusal: (command, frame) => refusal(code, command, frame),
  })
}

function refusal(code: DataCode, command: NamedCommand, frame: ResponseFrame<Head1e>): EndCodeError {
  const abnormal = frame.body.length === 0 ? '' : `, abnormal code ${hex(readerOf(code, frame.body).uint(1))}H`
  const text = explainEndCode(frame.endCode)
  return new EndCodeError(
    frame.endCode,
    `${command.title} was refused with end code ${hex(frame.endCode)}H${abnormal}.`,
    {
      command: command.title,
      ...(text === undefined ? {} : { meaning: text.meaning, remedy: text.remedy }),
    },
  )
}

function hex(byte: number): string {
  return byte.toString(16).toUpperCase().padStart(2, '0')
}
