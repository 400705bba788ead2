// What a client refuses to send although the PLC could do it.
import { RequestError } from '../../errors'

const WHAT = {
  allowWrites: 'writing to this PLC',
  allowControl: 'controlling this PLC',
  allowParameters: 'changing how this PLC is set up',
} as const

export function jwNotPermitted(title: string, option: keyof typeof WHAT): RequestError {
  const message = `${title} was not sent: ${WHAT[option]} is not allowed. Set ${option} to true if it should be.`
  return new RequestError('NOT_PERMITTED', message, option)
}
