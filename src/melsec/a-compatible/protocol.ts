import { hex } from '../../basics/hex'
import { type DataCode, type Message, readerOf } from '../../codec/codec'
import { EndCodeError, RequestError } from '../../errors'
import { endedWith, HeadProtocol, type NamedCommand, type ResponseFrame } from '../../link/link'
import { FORM_XY_OCTAL } from '../device/codec'
import { refusalTexts } from '../end-codes/end-code'
import { factsOf } from '../end-codes/facts'
import { frame1e, type Head1e } from '../frame/frame-1e'
import { aCompatibleCommands, isACompatible } from './commands'
import { addressesOf, sizeOf, withFrameNames } from './frame-names'
import { type ACompatibleFamily, aCompatibleRules, fx5Over1e, type OddBits } from './rules'

export interface ACompatibleOptions {
  readonly code: DataCode
  /** Which devices there are under which names, and how the PLC deviates. Default: iQ-F. */
  readonly family?: ACompatibleFamily
  /** PC number, default FFH: the connected station. */
  readonly pc?: number
  /** Monitoring timer in units of 250 ms, default 0 = wait for ever, which an FX5 CPU module demands. */
  readonly timer?: number
  /** ASCII code: digits of X and Y, a setting of the PLC's port. Without it X and Y are refused in ASCII code. */
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
  /** ASCII code: what stands for an odd number of bits. Default the family's; without one odd numbers are refused. */
  readonly oddBits?: OddBits | undefined
}

/**
 * The 1E frame with its command set. Devices are given by the PLC's own names: SM8000 goes out as M8000, LCN0 as CN200.
 * @example aCompatibleProtocol({ code: 'binary' }).exchange(aCompatibleCommands.readWords, { head, points: 3 })
 */
export function aCompatibleProtocol(options: ACompatibleOptions): HeadProtocol<Head1e> {
  const { code, pc = 0xff, timer = 0, asciiXy, family = fx5Over1e } = options
  const oddBits = options.oddBits ?? family.oddBits
  return new HeadProtocol<Head1e>({
    framing: frame1e(code),
    commands: aCompatibleCommands,
    code,
    form: code === 'ascii' && asciiXy === 'octal' ? FORM_XY_OCTAL : 0,
    headOf: (command) => ({ command: command.code, pc, timer }),
    codeOf: (head) => head.command,
    prepare(command, message) {
      const { name } = command
      if (!isACompatible(name)) throw new RequestError('UNSUPPORTED', `A 1E frame has no command ${name}.`, name)
      if (code === 'ascii') checkAscii(command, message, asciiXy, oddBits)
      return withFrameNames(aCompatibleRules, family.windows, name, message)
    },
    dummies: (command, request, side) =>
      code === 'ascii' && oddBits === 'padded' && isOdd(command, request, side) ? 1 : 0,
    refusal: (command, frame) => refusal(code, command, frame),
  })
}

/** Whether an odd number of bits stands in the request, or in its answer. */
function isOdd({ name }: NamedCommand, { points, values }: Message, side?: 'request' | 'response'): boolean {
  if (name === 'readBits' && side !== 'request') return typeof points === 'number' && points % 2 === 1
  return name === 'writeBits' && side !== 'response' && (sizeOf(values) ?? 0) % 2 === 1
}

function checkAscii(command: NamedCommand, message: Message, asciiXy: unknown, oddBits: unknown): void {
  if (oddBits === undefined && isOdd(command, message)) {
    throw new RequestError(
      'BAD_OPTION',
      `${command.title} of an odd number of points in ASCII code: whether a dummy character follows is not in the manual of this PLC. Ask for an even number of points, or set the option oddBits to exact or padded.`,
      'oddBits',
    )
  }
  const device = addressesOf(message).find(({ device: name }) => name === 'X' || name === 'Y')
  if (asciiXy === undefined && device !== undefined) {
    throw new RequestError(
      'BAD_OPTION',
      `${device.device} in ASCII code takes octal or hexadecimal digits, depending on the communication data code "ASCII (X,Y OCT)" or "ASCII (X,Y HEX)". Set the option asciiXy to octal or hexadecimal as in the PLC.`,
      'asciiXy',
    )
  }
}

function refusal(code: DataCode, command: NamedCommand, frame: ResponseFrame): EndCodeError {
  const { endCode } = frame
  const abnormalCode = frame.body.length === 0 ? undefined : readerOf(code, frame.body).uint(1)
  const { texts, sentences } = refusalTexts('1E', { endCode, abnormalCode, commandName: command.name })
  const facts = factsOf['1E'].refusal(command, abnormalCode ?? endCode)
  const why = abnormalCode === undefined ? '' : `, abnormal code ${hex(abnormalCode, 2)}H`
  const what = endedWith(facts, `end code ${hex(endCode, 2)}H${why}`)
  return new EndCodeError(endCode, `${command.title} ${what}: ${sentences}`, {
    family: '1E',
    ...facts,
    ...(abnormalCode === undefined ? {} : { abnormalCode }),
    ...texts,
  })
}
