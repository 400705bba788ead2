// Every profile, and the one a user means.
import { RequestError } from '../../errors'
import { iqRC24, lC24, qC24 } from './c24'
import { fx3 } from './fx3'
import { fx3Serial } from './fx3-serial'
import { fx5Enet } from './fx5-enet'
import { fx5Serial } from './fx5-serial'
import { generic } from './generic'
import { iqF } from './iq-f'
import { iqR } from './iq-r'
import { l } from './l'
import { nz2gfEtb } from './nz2gf-etb'
import { withOverrides } from './override'
import { type Profile, type ProfileId, type ProfileInfo, type ProfileOverrides, profileIds } from './profile'
import { q } from './q'
import { qBuiltIn, qE71 } from './q-ports'
import { remoteHead } from './remote-head'

/** Every profile by its id. */
export const profiles: Readonly<Record<ProfileId, Profile>> = {
  'iq-r': iqR,
  'iq-f': iqF,
  'fx5-enet': fx5Enet,
  q,
  'q-built-in': qBuiltIn,
  'q-e71': qE71,
  l,
  fx3,
  'fx5-serial': fx5Serial,
  'fx3-serial': fx3Serial,
  'iq-r-c24': iqRC24,
  'q-c24': qC24,
  'l-c24': lC24,
  'remote-head': remoteHead,
  'nz2gf-etb': nz2gfEtb,
  generic,
}

function isProfileId(id: string): id is ProfileId {
  return Object.hasOwn(profiles, id)
}

function profileOf(id: string): Profile {
  if (isProfileId(id)) return profiles[id]
  throw new RequestError(
    'BAD_OPTION',
    `There is no profile "${id}". Choose one of: ${profileIds.join(', ')}.`,
    'profile',
  )
}

/** Users have a part of it only in its type: what they hand back is all of it. */
function isWhole(profile: ProfileInfo): profile is Profile {
  return (
    typeof profile === 'object' &&
    profile !== null &&
    isProfileId(profile.id) &&
    'limits' in profile &&
    'refusals' in profile
  )
}

function wholeOf(profile: ProfileInfo): Profile {
  if (isWhole(profile)) return profile
  const message = `profile is one of ${profileIds.join(', ')}, or what resolveProfile() gives.`
  throw new RequestError('BAD_OPTION', message, 'profile')
}

/**
 * The profile with an id, or the one given, with the user's own values merged in field by field.
 *
 * @throws RequestError BAD_OPTION: unknown id, or an override that cannot be.
 * @example resolveProfile('q', { lacks: { readBlock: true, writeBlock: true }, limits: { readWords: 480 } })
 */
export function resolveProfile(idOrProfile: ProfileId | ProfileInfo, overrides?: ProfileOverrides): Profile {
  const profile = typeof idOrProfile === 'string' ? profileOf(idOrProfile) : wholeOf(idOrProfile)
  return overrides === undefined ? profile : withOverrides(profile, overrides)
}
