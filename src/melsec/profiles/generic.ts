import { anyFiles } from './files'
import { iqF } from './iq-f'
import { iqR } from './iq-r'
import { passwordLimit } from './limits'
import type { Profile } from './profile'
import { networks } from './reach'

/** For a PLC nobody knows: every form and command, and of all limits the lower ones. */
export const generic: Profile = {
  ...iqR,
  id: 'generic',
  title: 'generic SLMP device',
  series: 'any device that speaks SLMP or the MC protocol',
  cpu: 'generic',
  xyRadixKnown: false,
  asciiXy: 'setting',
  frame: '3E',
  form: 'short',
  lacks: [],
  doubtful: iqF.lacks,
  exclusions: [],
  // Both tables at once: all limits of a command hold together, so the lower figure wins (limitsOf). Those of Q and L
  // are never below iQ-R's.
  limits: [
    ...[...iqR.limits, ...iqF.limits].filter(({ unit }) => unit !== 'characters'),
    passwordLimit(4, 32, 'Q and L 4, iQ-R and iQ-F 6 to 32'),
  ],
  ranges: { points: {}, simulated: iqR.ranges.points, source: 'unknown: no device number is checked' },
  inFlight: { tcp: 1, udpBuffer: 0, ports: [], source: 'the lowest of all profiles' },
  // Nothing is known of it, so nothing is refused for it.
  reach: networks('unknown: the PLC says what it cannot reach; 03E1 is also head module No. 2', [0x3e2, 0x3e3]),
  monitoringTimer: {
    default: 0,
    zeroOnly: false,
    recommended: { from: 250, to: 10_000 },
    source: '0 is taken by every family, FX5 CPU modules take nothing else',
  },
  files: anyFiles,
  remote: { clearModes: iqR.remote.clearModes, reset: iqR.remote.reset, source: iqR.remote.source },
  notes: [
    'Choose the profile of your PLC when you know it: it knows the numbering of X and Y, the limits and what the PLC lacks.',
  ],
  sources: {
    ...iqR.sources,
    asciiXy: 'unknown: it may be an iQ-F',
    frames: '3E is on every SLMP device',
    forms: 'every form of the SLMP reference manual',
    absentDevices: 'unknown',
  },
}
