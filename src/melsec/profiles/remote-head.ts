import type { CommandName } from '../commands/commands'
import { remoteHeadFiles } from './files'
import { iqR } from './iq-r'
import { labelCommandNames } from './no-labels'
import type { Lack, Profile } from './profile'
import { networks } from './reach'

const table = 'SLMP reference manual 5.1, table of commands and targets, damaged in the edition at hand'

function doubtful(command: CommandName, reason: string, instead: string): Lack {
  return { command, endCode: 0xc059, reason, instead, source: table }
}

const noProgram = 'The head module executes no program; the printed table leaves open whether it takes the command.'

/** The remote head module of iQ-R on CC-Link IE Field: a target with the device commands of iQ-R, and without a program. */
export const remoteHead: Profile = {
  ...iqR,
  id: 'remote-head',
  title: 'CC-Link IE Field remote head module',
  series: 'RJ72GF15-T2, by an Ethernet module or through the master station of its network',
  cpu: 'remote-head',
  // A station extension frame reaches RJ71GN11-T2 only (2.3).
  frames: ['4E', '3E'],
  doubtful: [
    ...iqR.doubtful,
    ...labelCommandNames.map((name) =>
      doubtful(name, 'Labels belong to CPUs; the printed table leaves open whether it has any.', 'Use devices.'),
    ),
    doubtful('remotePause', noProgram, 'Use Remote STOP.'),
    doubtful('remoteLatchClear', noProgram, 'Clear devices by writing 0.'),
    doubtful('unlock', 'The remote password belongs to the connected station.', 'Give it for the connected station.'),
    doubtful('lock', 'The remote password belongs to the connected station.', 'Give it for the connected station.'),
  ],
  exclusions: [],
  files: remoteHeadFiles,
  ranges: {
    points: {},
    simulated: iqR.ranges.points,
    source: 'not in the manuals at hand: no device number is checked',
  },
  // RJ72GF15-T2
  model: { code: 0x4860 },
  inFlight: {
    tcp: 1,
    udpBuffer: 32,
    ports: [],
    source: '3.3 has no row for it: that of RCPU. TCP: one at a time, so that no PLC can merge two requests',
  },
  reach: networks(
    '4.1 module I/O numbers: 03FF own station, 03E0 and 03E1 head module No. 1 and No. 2, 03D0 and 03D1 systems',
    [],
  ),
  remote: {
    clearModes: iqR.remote.clearModes,
    reset: 'only in STOP, and only if the parameter "Remote Reset" is enabled; no answer when it succeeds',
    source: 'SLMP reference manual 5.6; where it tells its state is not in the manuals at hand',
  },
  notes: [
    'The table of commands and targets (5.1) is damaged in the edition at hand: what is uncertain is sent when asked for, and the module says whether it has it.',
    'In a redundant system choose the head module by the route: module I/O 03E0 (No. 1) or 03E1 (No. 2), 03D0 control and 03D1 standby system. File commands take 03FF, 03E0 and 03E1 only.',
    'Through a connected station that is not iQ-R it calls itself RCPU, with code 0360.',
  ],
  sources: { ...iqR.sources, frames: '4.1; 4E as default for its serial number; no station extension frame (2.3)' },
}
