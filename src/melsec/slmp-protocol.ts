// SLMP as a client speaks it: 3E, 4E and the station extension frame.
import { ProtocolError } from '../errors'
import type { RequestFrame } from '../link/link'
import type { ClientProtocol, ProtocolOptions, UnaskedFrame } from './client-protocol'
import { nameOfCommand } from './commands/command-name'
import { slmpExplainer } from './explain/slmp-explainer'
import type { SlmpFrameName } from './frame/frames'
import { ownStation, type Route } from './frame/route'
import { type SlmpFraming, type SlmpHead, slmpFraming } from './frame/slmp-frame'
import { readOnDemand } from './on-demand'
import { MelsecProtocol } from './protocol'

export interface SlmpOptions extends ProtocolOptions {
  readonly frame: SlmpFrameName
}

/** @throws RequestError BAD_OPTION when the frame has no such data code */
export function slmpProtocol(options: SlmpOptions): ClientProtocol {
  const { frame, code, profile, route, timer, asciiXy, asciiZr } = options
  const framing = slmpFraming(frame, code)
  const protocol = new MelsecProtocol<SlmpHead>({
    framing,
    head: { ...route, timer },
    connectedHead: { ...ownStation, timer },
    moduleIo: route.moduleIo,
    profile,
    code,
    asciiXy,
    asciiZr,
  })
  return {
    framing,
    profile,
    code,
    exchange: (command, message, given) => protocol.exchange(command, message, given),
    check: (command, message) => protocol.check(command, message),
    bodyBytes: (command, message, form) => protocol.bodyBytes(command, message, form),
    readUnasked: (unasked) => read(framing, options, unasked),
    answerBytes: (body) => protocol.answerBytes(body),
    nameOf: nameOfCommand,
    explainer: (shownAs) => slmpExplainer({ ...options, framing, ...shownAs }),
  }
}

function read({ body: { reserved } }: SlmpFraming, { code }: SlmpOptions, { head, body }: RequestFrame): UnaskedFrame {
  const route = routeOf(head)
  try {
    // A copy: the bytes of the chunk are somebody else's as soon as this returns.
    return { route, data: Buffer.from(readOnDemand(code, body, reserved)) }
  } catch (error) {
    if (error instanceof ProtocolError) return { route, data: error }
    throw error
  }
}

/** The way of a frame that this framing has scanned. */
function routeOf({ network, station, moduleIo, multidrop, extensionStation }: RequestFrame['head']): Route {
  const { network: own, station: connected, moduleIo: cpu, multidrop: none } = ownStation
  return {
    network: network ?? own,
    station: station ?? connected,
    moduleIo: moduleIo ?? cpu,
    multidrop: multidrop ?? none,
    ...(extensionStation === undefined ? {} : { extensionStation }),
  }
}
