// Facts about the remote password that both sides need (SLMP reference manual 5.7, FX5 communication manual 13.2, 38.6).
import type { EndCodeError } from '../errors'
import { limitsOf } from './device/limit'
import { lackOf, type Profile } from './profiles/profile'

const PRINTABLE = /^[\x20-\x7e]*$/

/** Why this cannot be a remote password of the family; undefined when it can. Never names the password. */
export function passwordProblem(profile: Profile, password: unknown): string | undefined {
  const lack = lackOf(profile, 'unlock')
  if (lack !== undefined) return `${profile.title} cannot be unlocked: ${lack.reason} ${lack.instead}`
  const [limit] = limitsOf(profile, 'unlock', profile.form, 'binary')
  const { min = 1, max = 32 } = limit ?? {}
  const range = min === max ? `${min}` : `${min} to ${max}`
  if (typeof password !== 'string') return `the remote password must be a text of ${range} characters`
  if (!PRINTABLE.test(password)) return 'the remote password may hold only characters from 20H to 7EH (ASCII)'
  if (password.length >= min && password.length <= max) return undefined
  return `the remote password has ${password.length} characters; ${profile.title} takes ${range}`
}

/** End code: the port is locked by the remote password; unlock it first. */
export const PORT_LOCKED = 0xc201

/** Whether the port waits for its remote password. */
export function isPortLocked({ family, endCode }: EndCodeError): boolean {
  return family === 'slmp' && endCode === PORT_LOCKED
}

/**
 * Whether a refusal of Unlock is about the password itself. Sending it again could only lock the PLC out. Other
 * refusals (a CPU that is just starting) may pass.
 */
export function isPasswordRefusal({ family, endCode }: EndCodeError): boolean {
  if (family !== 'slmp') return false
  return (endCode >= 0xc200 && endCode <= 0xc20f) || (endCode >= 0xc810 && endCode <= 0xc81f)
}
