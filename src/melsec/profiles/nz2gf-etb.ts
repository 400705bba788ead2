import type { CommandName } from '../commands/commands'
import { noFileFacts, noFiles } from './files'
import { qAndLLimits } from './limits'
import { noLabels } from './no-labels'
import type { Lack, Profile } from './profile'
import { q } from './q'
import { networks, openSettings } from './reach'

const table = 'SLMP reference manual 5.1, table of commands and targets'

function lack(command: CommandName, reason: string, instead: string, source = table): Lack {
  return { command, endCode: 0xc059, reason, instead, source }
}

const damaged = `${table}: printed as not available, in a row whose columns are damaged`

/** The Ethernet adapter of CC-Link IE Field: no CPU, but a connected station with a row of its own in the manual. */
export const nz2gfEtb: Profile = {
  ...q,
  id: 'nz2gf-etb',
  title: 'CC-Link IE Field Ethernet adapter',
  series: 'NZ2GF-ETB; for a CPU behind it choose the profile of that CPU',
  cpu: 'nz2gf-etb',
  lacks: [...noLabels(`${table}: not available`), ...noFiles(`${table}: not available`)],
  doubtful: [
    lack('unlock', 'It has no remote password.', 'Leave the password away.', damaged),
    lack('lock', 'It has no remote password.', 'Leave the password away.', damaged),
    lack('remotePause', 'It executes no program.', 'Use Remote STOP.', damaged),
    lack('remoteLatchClear', 'It executes no program.', 'Clear devices by writing 0.', damaged),
    lack('writeExtendUnit', 'It only reads there.', 'Use the buffer memory commands of the CPU.', damaged),
  ],
  limits: qAndLLimits,
  ranges: {
    points: {},
    simulated: q.ranges.points,
    source: 'not in the manuals at hand: no device number is checked',
  },
  model: { code: 0x0642 },
  inFlight: {
    tcp: 1,
    udpBuffer: 50,
    ports: [{ port: 'NZ2GF-ETB', buffer: 50 }],
    source: '3.3: 1 + 50 / connections. TCP: one at a time, so that no device can merge two requests',
  },
  connections: { most: 16, source: openSettings },
  reach: networks('2.3: a connected station by which other stations of CC-Link IE Field are reached'),
  remote: {
    clearModes: q.remote.clearModes,
    reset: q.remote.reset,
    source: 'SLMP reference manual 5.6; where it tells its state is not in the manuals at hand',
  },
  files: noFileFacts,
  notes: [
    'Clear Error is certain for this module only, when it is the connected station.',
    'The table of commands and targets (5.1) is damaged in the edition at hand: what is uncertain is sent when asked for, and the module says whether it has it.',
    'Its buffer memory is reached with Memory (0613, 1613).',
  ],
  sources: { ...q.sources, absentDevices: 'long devices need 0002/0003, which the table prints as not available' },
}
