// What a client refuses to send although the PLC could do it.
import { RequestError } from '../../errors'

/** A registration that arrives twice or late would take the place of another one, and its values would be wrong. */
export function overUdp(title: string): RequestError {
  return new RequestError('UNSUPPORTED', `${title} over UDP is not safe: use readRandom, or TCP.`, 'transport')
}

/** Others may register in between. */
export function onSharedLine(title: string): RequestError {
  const message = `${title} on a serial line that others may use is not safe: use readRandom.`
  return new RequestError('UNSUPPORTED', message, 'line')
}

export function notPermitted(title: string, option: 'allowWrites' | 'allowControl'): RequestError {
  const what = option === 'allowWrites' ? 'writing to' : 'controlling'
  return new RequestError(
    'NOT_PERMITTED',
    `${title} was not sent: ${what} this PLC is not allowed. Set ${option} to true if it should be.`,
    option,
  )
}
