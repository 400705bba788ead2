// The serial C24 modules of Q, L and iQ-R: the command set of their CPUs in 3C and 4C frames.
import type { LimitRule } from '../device/limit-rule'
import { iqR } from './iq-r'
import { l } from './l'
import type { Lack, Profile } from './profile'
import { q } from './q'
import { serialPort } from './serial'

/**
 * No manual at hand prints the limits of C24 modules. These are those of the Ethernet ports of the same CPUs in ASCII code,
 * which are the lower ones: a request that is smaller than it could be is right on every module.
 */
function lowerOf({ asciiFactor = 1, max, ...rule }: LimitRule): LimitRule {
  const lower = Math.floor(max / asciiFactor)
  return { ...rule, max: lower, source: `${rule.source}; of C24 modules not printed: the lower figure, of ASCII code` }
}

function doubtful(command: 'unlock' | 'lock'): Lack {
  return {
    command,
    endCode: 0x7e40,
    reason: 'C24 modules have a remote password with a modem only.',
    instead: 'Leave the password away.',
    source: 'background: user’s manuals of C24 modules, remote password check by the modem function',
  }
}

/** The profile of the same CPUs behind a C24 module. */
function overC24(profile: Profile, own: Pick<Profile, 'id' | 'title' | 'series'>): Profile {
  return {
    ...profile,
    ...own,
    ...serialPort({ frames: ['3C', '4C'], source: 'background: MC protocol reference manual, frames of C24 modules' }),
    doubtful: [...profile.doubtful, doubtful('unlock'), doubtful('lock')],
    limits: profile.limits.map(lowerOf),
    notes: [
      'The channel needs "MC protocol (format 1, 4 or 5)" as communication protocol in the settings of the module, which say speed, parity, sum check and station number, too.',
      'Other stations behind the module are reached with network, pc, moduleIo and multidrop of the route.',
      'Formats 2 and 3, On-demand data and 1C frames of these modules are in no manual at hand: not supported.',
    ],
    serial: {
      reach: 'c24',
      lastStation: 31,
      source: 'background: MC protocol reference manual, stations 0 to 31',
    },
    sources: { ...profile.sources, frames: 'background: MC protocol reference manual, 3C and 4C of C24 modules' },
  }
}

export const iqRC24 = overC24(iqR, {
  id: 'iq-r-c24',
  title: 'MELSEC iQ-R C24 serial module',
  series: 'RCPU by RJ71C24, RJ71C24-R2 or RJ71C24-R4',
})

export const qC24 = overC24(q, {
  id: 'q-c24',
  title: 'MELSEC-Q C24 serial module',
  series: 'QCPU by QJ71C24, QJ71C24N and their -R2 and -R4',
})

export const lC24 = overC24(l, {
  id: 'l-c24',
  title: 'MELSEC-L C24 serial module',
  series: 'LCPU by LJ71C24 or LJ71C24-R2',
})
