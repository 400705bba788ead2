// Requests of the SLMP set in 1C frames, for a client.
import type { Message } from '../../codec/codec'
import { RequestError } from '../../errors'
import { deviceProblem } from '../a-compatible/device-rules'
import { addressesOf, pointsOf } from '../a-compatible/frame-names'
import type { SaidName } from '../a-compatible/names'
import { type Said, SlmpOver, saidAlike } from '../a-compatible/slmp-over'
import type { DeviceWindow } from '../a-compatible/windows'
import type { ClientProtocol, ProtocolOptions } from '../client-protocol'
import { otherSetExplainer } from '../explain/other-set-explainer'
import { allStations } from '../frame/serial-frames'
import { serialFraming } from '../frame/serial-framing'
import { profileOver1c, windowsOver1c } from '../profiles/over-1c'
import { asciiXyOf, type Profile } from '../profiles/profile'
import { serialOptionsOf } from '../serial-options'
import { type OneCCommandName, oneCCommands } from './commands'
import { over1c } from './names'
import { type OneCHead, type OneCOptions, oneCProtocol } from './protocol'
import { oneCRules } from './rules'

/** How a client speaks 1C to its PLC. */
export interface Over1cOptions<H extends OneCHead> extends Omit<OneCOptions<H>, 'windows'> {
  readonly profile: Profile
  /** Waits of each request, as bytes that the line could carry; default 0. */
  readonly turnRound?: number
}

const names = { frame: '1C', instead: '3C or 4C' } as const

/**
 * Whatever else only 1C has is reached by `own`.
 * @throws RequestError BAD_OPTION when the PLC does not take 1C, or not with these digits of X and Y
 * @example protocol.own.exchange(oneCCommands.GW, { on: true })
 */
export function protocolOver1c<H extends OneCHead>(options: Over1cOptions<H>): SlmpOver<H> {
  const { profile, head, framing, turnRound = 0 } = options
  if (!profile.frames.includes('1C')) {
    throw new RequestError('BAD_OPTION', `${profile.title} takes no 1C frame.`, 'frame')
  }
  const windows = windowsOver1c(profile)
  const asciiXy = asciiXyOf(profile, options.asciiXy)
  const narrowed = profileOver1c(profile)
  const toAll = oneCProtocol({ ...options, head: { ...head, ...allStations }, windows, asciiXy })
  const protocol = oneCProtocol({ ...options, windows, asciiXy })
  return new SlmpOver({
    ...names,
    protocol,
    profile: narrowed,
    code: 'ascii',
    anyHead: head,
    turnRound,
    said: (name, message) => saidIn1c(windows, name, message),
    globalSignal: (on, to) => (to === 'all' ? toAll : protocol).exchange(oneCCommands.GW, { on }),
    nameOf(name) {
      const [first] = over1c[name]
      return `${oneCCommands[first].title} (${first})`
    },
    explainer: (shownAs) =>
      otherSetExplainer({
        frame: '1C',
        code: 'ascii',
        profile: narrowed,
        asciiXy,
        answerIn: (bytes) => framing.response.scan(bytes, () => undefined)?.used,
        ...shownAs,
      }),
  })
}

/** As a client speaks it. @throws RequestError as `protocolOver1c` */
export function clientProtocolOver1c(options: ProtocolOptions): ClientProtocol {
  const { profile } = options
  // The digits are settled already, also where the family has no setting.
  const asciiXy = profile.asciiXy === 'setting' ? options.asciiXy : undefined
  const { head, messageWait, turnRound = 0, ...serial } = serialOptionsOf(options)
  const framing = serialFraming({ ...serial, frame: '1C' })
  const { answeredToAll } = serial
  return protocolOver1c({ profile, asciiXy, head, messageWait, turnRound, answeredToAll, framing })
}

function saidIn1c(windows: readonly DeviceWindow[], name: SaidName, given: Message): Said {
  const { message, answer } = saidAlike(names, name, given)
  return { command: oneCCommands[commandFor(windows, over1c[name], message)], message, answer }
}

/** The command with the fewest digits that takes the devices; the last one says what is wrong where none does. */
function commandFor(
  windows: readonly DeviceWindow[],
  [first, ...longer]: readonly [OneCCommandName, ...OneCCommandName[]],
  message: Message,
): OneCCommandName {
  const points = pointsOf(message)
  const takesAll = (command: OneCCommandName) =>
    addressesOf(message).every((address) => deviceProblem(oneCRules, windows, command, address, points) === undefined)
  return takesAll(first) ? first : (longer.find(takesAll) ?? longer.at(-1) ?? first)
}
