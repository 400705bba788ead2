// How the requests of a file transfer are sent: one after another, each with its own deadline.
import { ClosedError } from '../../errors'
import type { Exchange } from '../../link/link'
import type { ClientProtocol } from '../../melsec/client-protocol'
import { frameFacts } from '../../melsec/frame/frames'
import type { Connection } from '../connection/connection'
import { Deadline } from '../connection/deadline'
import type { FileParts } from '../file/files'
import type { OpenFile } from '../file/open-file'
import type { MelsecClientOptions } from './options'
import type { Settings } from './settings'

/** What the client lends. */
interface Lent {
  readonly settings: Settings
  readonly options: Pick<MelsecClientOptions, 'localPort'>
  readonly protocol: ClientProtocol
  readonly connection: Connection
  /** @throws RequestError NOT_PERMITTED */
  readonly permit: (effect: Exchange<unknown>['effect'], title: string) => void
}

export function filePartsOf({ settings, options, protocol, connection, permit }: Lent): FileParts {
  const open = new Set<OpenFile>()
  const closings = { count: 0 }
  return {
    profile: settings.profile,
    unusable: unusable(settings, options.localPort),
    permitWrite: (title) => permit('write', title),
    open,
    closings,
    calls: ({ signal, ...unaborted }) => ({
      open,
      closings,
      connection: () => connection.generation,
      send: async (command, message, how = {}) => {
        permit(command.effect, command.title)
        const exchange = protocol.exchange(command, message)
        // Giving a request up on the way may cost the connection, and with it the way to close what is open.
        const unheard = how.unaborted ?? (open.size > 0 ? 'onceSent' : undefined)
        if (unheard === 'onceSent' && signal?.aborted === true) throw aborted(command.title, signal)
        const heard = unheard !== undefined || signal === undefined ? unaborted : { ...unaborted, signal }
        const deadline = new Deadline(settings.clock, heard, settings.timeout)
        const bound = how.onlyOn === undefined ? {} : { onlyOn: how.onlyOn }
        return connection.request(exchange, { ...deadline.ofRequest(command.title), ...bound })
      },
    }),
  }
}

function aborted(title: string, { reason }: AbortSignal): ClosedError {
  return new ClosedError('ABORTED', `${title} was aborted before it was sent.`, 'notSent', reason)
}

/** The PLC locks an open file for the external device that opened it. */
function unusable({ transport, frame }: Settings, localPort: number | undefined): string | undefined {
  if (transport !== 'udp' || frameFacts[frame].serial || (localPort ?? 0) > 0) return undefined
  return (
    `Over UDP the ${frameFacts[frame].title} frame changes the local port with every request, so the PLC would not find the file open again. ` +
    'Use TCP, the 4E frame, or a fixed localPort.'
  )
}
