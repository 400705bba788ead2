// What a client refuses to send although the PLC could do it.
import { RequestError } from '../../errors'

/** A registration that arrives twice or late would take the place of another one, and its values would be wrong. */
export function overUdp(title: string): RequestError {
  return new RequestError('UNSUPPORTED', `${title} over UDP is not safe: use readRandom, or TCP.`, 'transport')
}

/** Options in the third place, ignored there, would be the usual ones without anybody noticing. */
export function optionsOfMany<Options>(second: Options, third: unknown): Options {
  if (third === undefined) return second
  const message =
    'Of many values the options stand in the second place: write({ D0: 1, D1: 2 }, { allOrNothing: true }).'
  throw new RequestError('BAD_OPTION', message, 'options')
}

export function notPermitted(title: string, option: 'allowWrites' | 'allowControl'): RequestError {
  const what = option === 'allowWrites' ? 'writing to' : 'controlling'
  return new RequestError(
    'NOT_PERMITTED',
    `${title} was not sent: ${what} this PLC is not allowed. Set ${option} to true if it should be.`,
    option,
  )
}
