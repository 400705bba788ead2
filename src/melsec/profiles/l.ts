import { lFiles } from './files'
import { qAndLLimits } from './limits'
import type { Profile } from './profile'
import { q } from './q'
import { networks } from './reach'

/** A MELSEC-L CPU answers as a MELSEC-Q CPU does; what differs is written here. */
export const l: Profile = {
  ...q,
  id: 'l',
  title: 'MELSEC-L',
  series: 'LCPU by LJ71E71-100, and L02, L06 and L26 CPUs by their own Ethernet port',
  cpu: 'l',
  limits: qAndLLimits,
  ranges: {
    points: { ...q.ranges.points, ZR: 131072 },
    source: 'background: defaults of LCPU (device tab of the PLC parameter); Z, R and ZR measured by others',
  },
  refusals: {
    ...q.refusals,
    source:
      'device number, device name, command and extension measured by others on LCPU; the others background (error code lists of CPU and Ethernet modules)',
  },
  // L02CPU
  model: { code: 0x0541 },
  inFlight: {
    tcp: 1,
    udpBuffer: 57,
    ports: [{ port: 'LJ71E71-100', buffer: 57 }],
    source:
      '3.3: LJ71E71-100 1 + 57 / connections; the CPUs own port is not in the list. TCP: one at a time, so that no PLC can merge two requests',
  },
  files: lFiles,
  reach: networks('2.3: a built-in port reaches its own station only, an Ethernet module others too'),
  notes: [
    'Built-in port: PLC Parameter, Built-in Ethernet Port Setting, Open Setting, "MC Protocol", with the port number; tick "Enable online change" for writing.',
    'Built-in ports refuse module access (U\\G) with C070; the LJ71E71-100 has it.',
    'Write Random over its limit is answered with 4080 by the LJ71E71-100, with C054 by built-in ports (measured by others).',
    'LJ72GF15-T2 head modules answer as L does, but Remote PAUSE and latch clear are printed as not available (the table of commands and targets, 2.1, is damaged).',
    '4E exists on the LJ71E71-100; 3E is the default because every module and CPU has it.',
  ],
}
