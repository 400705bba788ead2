// MELSEC-Q when it is known by which port: the CPU's own one, or an Ethernet module.
import type { CommandName } from '../commands/commands'
import { fileCommandNames } from './files'
import { qAndLLimits } from './limits'
import type { Lack, Profile } from './profile'
import { notOnBuiltInPorts, q } from './q'
import { connectedStation, networks } from './reach'
import { doubtfulClearError } from './shared-lacks'

const list = 'list of MC protocol commands of the QnUCPU manual (communication via built-in Ethernet port), 5.1.2'

/** Not measured, so only doubtful. */
const notListed: readonly CommandName[] = [
  'remoteRun',
  'remoteStop',
  'remotePause',
  'remoteLatchClear',
  'remoteReset',
  'selfTest',
  'clearError',
  'readMemory',
  'writeMemory',
  'readExtendUnit',
  'writeExtendUnit',
  ...fileCommandNames,
]

function doubtful(command: CommandName): Lack {
  return {
    command,
    endCode: 0xc059,
    reason: 'The manual of the built-in Ethernet port does not list it.',
    instead: 'Use an Ethernet module (QJ71E71-100), or GX Works.',
    source: list,
  }
}

/** Universal model CPUs by their own Ethernet port. */
export const qBuiltIn: Profile = {
  ...q,
  id: 'q-built-in',
  title: 'MELSEC-Q built-in Ethernet port',
  series: 'QnUDE, QnUDV and QnUDPV CPUs by their own Ethernet port',
  lacks: [...q.lacks, ...notOnBuiltInPorts],
  doubtful: notListed.map(doubtful),
  extensions: ['link'],
  // High Performance model QCPUs, which count ZR twice, have no such port.
  limits: qAndLLimits,
  inFlight: {
    tcp: 1,
    udpBuffer: 576,
    ports: [{ port: 'built-in Ethernet port of QnUDV and QnUDPV', buffer: 576 }],
    source: '3.3: Q03UDV to Q26UDV, Q04UDPV to Q26UDPV; QnUDE is not in the list. TCP: one at a time',
  },
  reach: connectedStation('2.3: an external device at the built-in port of a CPU reaches the connected station only'),
  notes: [
    'PLC Parameter, Built-in Ethernet Port Setting, Open Setting, "MC Protocol", with the port number; tick "Enable online change" for writing in RUN, otherwise the CPU answers 0055.',
    'Read, Write, Read Random, Write Random, the monitor and the remote password are what its manual lists. Others are sent when asked for, and the CPU says whether it has them.',
    'Module access (U\\G) is refused by it with C070 (measured by others).',
    'QnUDV and QnUDPV take 4E frames, QnUDE 3E frames only: 3E is the default.',
  ],
  sources: {
    ...q.sources,
    frames: `${list}: 4E and 3E of QnUDV; the manual of QnUDE has 3E`,
    extensions: 'measured by others',
  },
}

/** Every QCPU by an Ethernet module. */
export const qE71: Profile = {
  ...q,
  id: 'q-e71',
  title: 'MELSEC-Q Ethernet module',
  series: 'QCPU by QJ71E71-100 (QJ71E71-B2 and -B5 too)',
  doubtful: [doubtfulClearError],
  // Q06HCPU
  model: { code: 0x0042 },
  inFlight: {
    tcp: 1,
    udpBuffer: 57,
    ports: [{ port: 'QJ71E71-100', buffer: 57 }],
    source: '3.3: QJ71E71-100 1 + 57 / connections. TCP: one at a time, so that no PLC can merge two requests',
  },
  reach: networks('2.3: other stations of its network, and of other networks by up to 7 relay stations'),
  notes: [
    'UDP port 5000 is open without a setting ("Auto open UDP port"), as long as it is not assigned otherwise.',
    'Other stations and the CPUs of a multiple CPU system are reached with a route.',
    'Read Random and Entry Monitor Device count ZR double on High Performance model QCPUs. It is counted so here, which is safe on every QCPU; zrCountsDouble: false ends it.',
    'Write Random over its limit is answered with 4080 (measured by others).',
  ],
}
