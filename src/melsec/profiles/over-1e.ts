// What is left of a profile when its PLC is spoken to in 1E frames.
import { slmpNameOf } from '../a-compatible/names'
import { type ACompatibleFamily, aCompatibleLimitSource, aCompatibleLimits } from '../a-compatible/rules'
import { contactsInWords, narrowed } from './over-other-set'
import type { Profile } from './profile'

/** Too many points, or a device behind the last one. */
const TOO_MANY = 0x57
const NO_DEVICE = 0x56
const NO_COMMAND = 0x50
const source = aCompatibleLimitSource

/** The profile of the same PLC over 1E. */
export function profileOver1e(profile: Profile, { windows }: ACompatibleFamily): Profile {
  return {
    ...narrowed(profile, {
      frame: '1E',
      instead: 'Use a 3E frame if the PLC takes it.',
      windows,
      limits: aCompatibleLimits.map(({ command, ...limit }) => ({ ...limit, command: slmpNameOf(command) })),
      exclusions: [
        ...contactsInWords(NO_DEVICE, source),
        {
          commands: ['writeRandomWords'],
          devices: ['LCN'],
          endCode: NO_DEVICE,
          reason: 'Test does not write counters of 32 bits.',
          instead: 'Use bit units, or Write.',
          source,
        },
        ...(profile.exclusions1e ?? []),
      ],
      endCodes: { command: NO_COMMAND, points: TOO_MANY },
      source,
    }),
    title: profile.frames.length > 1 ? `${profile.title} in a 1E frame` : profile.title,
    frames: ['1E'],
    frame: '1E',
  }
}
