// Profiles as users see them: what they can read, without what only this package needs.
import type { ProfileId, ProfileInfo, ProfileOverrides } from './profile'
import { resolveProfile as resolveWhole, profiles as whole } from './profiles'

/** Every profile by its id. */
export const profiles: Readonly<Record<ProfileId, ProfileInfo>> = whole

/**
 * The profile with an id, or one that this function gave, with your own values merged in field by field. Clients, simulators and
 * `explainFrame()` take it as `profile`.
 * @throws RequestError BAD_OPTION: unknown id, data that is no profile, or an override that cannot be
 * @example resolveProfile('q', { lacks: { readBlock: true, writeBlock: true }, limits: { readWords: 480 } })
 */
export function resolveProfile(idOrProfile: ProfileId | ProfileInfo, overrides?: ProfileOverrides): ProfileInfo {
  return resolveWhole(idOrProfile, overrides)
}
