import { hex } from '../../basics/hex'
import type { Message } from '../../codec/codec'
import { EndCodeError, RequestError } from '../../errors'
import { endedWith, type Framing, HeadProtocol, type NamedCommand, type ResponseFrame } from '../../link/link'
import { addressesOf, withFrameNames } from '../a-compatible/frame-names'
import { type DeviceWindow, fx5Windows } from '../a-compatible/windows'
import { FORM_XY_OCTAL } from '../device/codec'
import { refusalTexts } from '../end-codes/end-code'
import { factsOf } from '../end-codes/facts'
import { isOneC, oneCCommands } from './commands'
import { oneCFront } from './front'
import { oneCRules } from './rules'

/** What the head of every 1C frame says. */
export type OneCHead = { readonly station: number }

export interface OneCOptions<H extends OneCHead> {
  /** Any whose requests carry command, message wait and characters, and whose answers carry the data alone. */
  readonly framing: Framing<H>
  /** The station; FFH is every station on the line, for the global signal only (44.6). */
  readonly head: H
  /** Which devices there are under which names. Default: FX5. */
  readonly windows?: readonly DeviceWindow[]
  /** Digits of X and Y: the message format of the PLC's port. Without it X and Y are refused. */
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
  /** ms before the PLC answers at the earliest: 0 to 150 in steps of 10. Default 0. */
  readonly messageWait?: number
  /** Whether what is for all stations is answered. Default false. */
  readonly answeredToAll?: boolean | undefined
}

const ALL_STATIONS = 0xff

/**
 * The 1C frame with its command set. Devices are given by the PLC's own names: SM8000 goes out as M8000, LCS0 as CS200.
 * @example oneCProtocol({ framing, head }).exchange(oneCCommands.WR, { head: { device: 'D', number: 0 }, points: 3 })
 */
export function oneCProtocol<H extends OneCHead>(options: OneCOptions<H>): HeadProtocol<H> {
  const { framing, head, windows = fx5Windows, asciiXy, messageWait = 0, answeredToAll = false } = options
  return new HeadProtocol<H>({
    framing,
    commands: oneCCommands,
    code: 'ascii',
    form: asciiXy === 'octal' ? FORM_XY_OCTAL : 0,
    headOf: () => head,
    // 44.6 does not say whether the stations answer what is for all of them: they would speak at once.
    isAnswered: () => answeredToAll || head.station !== ALL_STATIONS,
    front: oneCFront(messageWait),
    prepare(command, message) {
      const { name } = command
      if (!isOneC(name)) throw new RequestError('UNSUPPORTED', `A 1C frame has no command ${name}.`, name)
      if (head.station === ALL_STATIONS && name !== 'GW') refuseForAll(command)
      if (asciiXy === undefined) refuseXy(message)
      return withFrameNames(oneCRules, windows, name, message)
    },
    refusal,
  })
}

function refuseForAll({ title, name }: NamedCommand): never {
  throw new RequestError(
    'UNSUPPORTED',
    `${title} (${name}) goes to one station: station FFH, all stations, is for Global signal ON/OFF (GW) only.`,
    'route.station',
  )
}

function refuseXy(message: Message): void {
  const found = addressesOf(message).find(({ device }) => device === 'X' || device === 'Y')
  if (found === undefined) return
  throw new RequestError(
    'BAD_OPTION',
    `${found.device} takes octal or hexadecimal digits, depending on the message format "Format 1 (X,Y OCT)" or "Format 1 (X,Y HEX)", of format 4 alike. Set the option asciiXy to octal or hexadecimal as in the PLC.`,
    'asciiXy',
  )
}

function refusal(command: NamedCommand, { endCode }: ResponseFrame): EndCodeError {
  const { texts, sentences } = refusalTexts('1C', { endCode, commandName: command.name })
  const facts = factsOf['1C'].refusal(command, endCode)
  const what = endedWith(facts, `error code ${hex(endCode, 2)}H`)
  return new EndCodeError(endCode, `${command.title} (${command.name}) ${what}: ${sentences}`, {
    family: '1C',
    ...facts,
    ...texts,
  })
}
