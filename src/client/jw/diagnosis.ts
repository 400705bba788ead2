// Why a Sharp JW that can be reached says nothing: ranked causes, most likely first. No manual at hand prints how a unit on
// Ethernet is set up, so these are what the messages themselves leave open.
import type { Silence } from '../connection/connection-options'
import type { JwClientOptions } from './options'
import type { JwSettings } from './settings'

/** Ranked causes of a silence, as sentences that say what to check. */
export function explainJwSilence(
  settings: Pick<JwSettings, 'transport' | 'header' | 'probe'>,
  { port, localPort }: Pick<JwClientOptions, 'port' | 'localPort'>,
  silence: Silence,
): readonly string[] {
  if (silence.answeredBefore) {
    return [
      'The PLC is off, restarting, or its cable or a switch on the way is interrupted.',
      'The PLC needed longer than the timeout: raise it, or ask for less at once.',
      'The parameters of the unit were changed since it last answered.',
      'The device answers other requests, but does not know this one and says nothing to it.',
    ]
  }
  const { transport, header } = settings
  const other = header === 'none' ? 'zero40 (40 bytes 00)' : header === 'zero40' ? 'none' : 'zero40 or none'
  const wrongHeader = `The unit expects another header in front of messages: set header to ${other}, or let findJwHeader() find out.`
  const peer = `UDP: the unit answers the partner of its parameters; enter this computer's address there${localPort === undefined ? ' and set a fixed local port here' : ` and port ${localPort}`}. A firewall on the way has the same effect.`
  const entry = `${port === undefined ? 'The port' : `Port ${port}`} is open for something else, or for ${transport === 'tcp' ? 'UDP' : 'TCP'}: compare the parameters of the unit.`
  const behind = 'The station behind the relay does not answer: check station, slot and pseudo stations of the header.'
  const slow = 'The PLC is busy or the line slow: raise the timeout.'
  const isRelay = typeof header === 'object' && !(header instanceof Uint8Array)
  const causes = [...(isRelay ? [behind] : []), wrongHeader, ...(transport === 'udp' ? [peer] : []), entry, slow]
  const { onlyAsked } = silence
  if (onlyAsked === undefined) return causes
  return [
    ...causes,
    `The device does not know ${onlyAsked}, which is all that it was asked: set probe to ${settings.probe === 'read' ? 'writeMode' : 'read'} or none.`,
  ]
}
