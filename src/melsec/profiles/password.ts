// How ports refuse a remote password.
import type { PasswordFacts } from './profile'

/** iQ-R and iQ-F. */
export const authentication: PasswordFacts = {
  wrong: 0xc810,
  last: 0xc815,
  lockedOut: 0xc816,
  lockChecks: true,
  source: 'FX5 communication manual 47.4',
}

/** One end code for all of it. */
export const passwordMismatch: PasswordFacts = {
  wrong: 0xc200,
  last: 0xc200,
  lockedOut: 0xc200,
  lockChecks: true,
  source: 'background: error code lists of the Ethernet modules of Q and L',
}
