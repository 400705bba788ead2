// FX3 CPUs by their computer link: the 1C frame, with the devices of FX3.
import { fx3 } from './fx3'
import { profileOver1c } from './over-1c'
import type { Profile } from './profile'
import { serialPort } from './serial'

const port: Profile = {
  ...fx3,
  ...serialPort({ frames: ['1C'], source: 'FX5 communication manual 44' }),
  id: 'fx3-serial',
  title: 'MELSEC FX3 serial',
  series: 'FX3S, FX3G, FX3GC, FX3U and FX3UC CPUs by computer link',
  asciiXy: 'octal',
  notes: [
    'Computer link is set up in GX Works2 (PLC system (2)) or in D8120: dedicated protocol, format 1 or 4.',
    'Special relays and registers M8000 to M8511 and D8000 to D8511 are also called SM8000 and SD8000 here, because the iQ-F calls them so.',
  ],
  serial: {
    reach: 'fx5',
    lastStation: 15,
    source:
      'background: FX series user’s manual, data communication edition, computer link: stations 0 to 15, PC number FF',
  },
  sources: {
    ...fx3.sources,
    asciiXy:
      'background: FX series user’s manual, data communication edition, computer link 7.2: X040 to X077 are thirty-two inputs',
    frames:
      'FX5 communication manual 44: the 1C frame is compatible with computer link of FX3, and has the commands of this chapter only',
  },
}

/** It has no other frame, so it is what 1C leaves of it. */
export const fx3Serial: Profile = { ...profileOver1c(port), title: port.title }
