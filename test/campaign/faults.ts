/** What can go wrong between a PLC and its client. Each fault is about one request and its answer. */
import type { Random } from '../fuzz/random'
import type { Changes } from './answers'
import { type Configuration, TIMEOUT } from './configurations'
import type { Turn } from './plc'
import { onDemandFrame } from './slmp'

export interface Fault {
  readonly name: string
  /** Whether it can be there at all, and whether the protocol leaves a client any chance to see it. */
  readonly on: (configuration: Configuration) => boolean
  /** `random` is asked now, when the fault is made, so that the same seed makes the same fault. */
  readonly make: (random: Random) => (turn: Turn) => void
}

const everywhere = (): boolean => true
const tcp = ({ transport }: Configuration): boolean => transport === 'tcp'
const udp = ({ transport }: Configuration): boolean => transport === 'udp'
const serial = (configuration: Configuration): boolean => configuration.serial
const slmp = ({ frame }: Configuration): boolean => frame !== '1E'
const ascii = ({ code }: Configuration): boolean => code === 'ascii'
/**
 * An answer too many is told apart by its serial number or by the port it comes to. On a connection, and on a fixed
 * port, of a frame without serial number nothing tells it apart: no client can see it, so it is not tried there.
 */
const toldApart = ({ serial: number, transport, fixedPort }: Configuration): boolean =>
  number || (transport === 'udp' && !fixedPort)

function fault(name: string, on: Fault['on'], make: Fault['make']): Fault {
  return { name, on, make }
}

function simple(name: string, on: Fault['on'], run: (turn: Turn) => void): Fault {
  return fault(name, on, () => run)
}

/** Carried out at once, and the answer is not what it should be. */
function changed(name: string, on: Fault['on'], changes: (random: Random) => Changes): Fault {
  return fault(name, on, (random) => {
    const made = changes(random)
    return (turn) => turn.send(turn.carryOut(made))
  })
}

function cut(bytes: Buffer, part: number): [Buffer, Buffer] {
  const at = 1 + (part % Math.max(1, bytes.length - 1))
  return [bytes.subarray(0, at), bytes.subarray(at)]
}

const END_CODES = [0xc056, 0xc059, 0x4031, 0xc05c, 0x4030, 0x0055] as const
const END_CODES_1E = [0x50, 0x56, 0x57, 0x5b] as const

function endCodeOf(turn: Turn, place: number): number {
  const codes = turn.request.frame === '1E' ? END_CODES_1E : END_CODES
  return codes[place % codes.length] ?? codes[0]
}

/** Bytes that begin as no answer does. */
function junk(random: Random, longest: number): Buffer {
  const bytes = Buffer.from(Array.from({ length: 1 + random.below(longest) }, () => random.below(256)))
  bytes[0] = 0xff
  return bytes
}

const late = (random: Random): number => TIMEOUT + 1 + random.below(25)
const veryLate = (random: Random): number => 2 * TIMEOUT + random.below(3 * TIMEOUT)

export const faults: readonly Fault[] = [
  fault('slow', everywhere, (random) => {
    const ms = 1 + random.below(TIMEOUT / 3)
    return (turn) => turn.send(turn.carryOut(), ms)
  }),
  fault('late', everywhere, (random) => {
    const ms = late(random)
    return (turn) => turn.send(turn.carryOut(), ms)
  }),
  fault('very late', everywhere, (random) => {
    const ms = veryLate(random)
    return (turn) => turn.send(turn.carryOut(), ms)
  }),
  fault('about at the deadline', everywhere, (random) => {
    const ms = TIMEOUT - 4 + random.below(6)
    return (turn) => turn.send(turn.carryOut(), ms)
  }),
  fault('carried out slowly', everywhere, (random) => {
    const ms = 1 + random.below(TIMEOUT / 3)
    return (turn) => turn.send(() => turn.carryOut(), ms)
  }),
  fault('carried out late', everywhere, (random) => {
    const ms = late(random)
    return (turn) => turn.send(() => turn.carryOut(), ms)
  }),
  simple('request lost', everywhere, () => {}),
  simple('answer lost', everywhere, (turn) => {
    turn.carryOut()
  }),
  // In one chunk: of a frame without serial number nothing else would tell the second one apart.
  simple(
    'doubled',
    (configuration) => tcp(configuration) || toldApart(configuration),
    (turn) => {
      const answer = turn.carryOut()
      if (turn.peer.name.startsWith('port')) {
        turn.send(answer)
        turn.send(answer)
      } else turn.send(Buffer.concat([answer, answer]))
    },
  ),
  fault('doubled, the second late', toldApart, (random) => {
    const ms = late(random)
    return (turn) => {
      const answer = turn.carryOut()
      turn.send(answer)
      turn.send(answer, ms)
    }
  }),
  simple('swapped with the next', toldApart, (turn) => {
    turn.plc.held = { peer: turn.peer, bytes: turn.carryOut(), joined: false }
  }),
  simple(
    'joined with the next',
    (configuration) => serial(configuration) && tcp(configuration),
    (turn) => {
      turn.plc.held = { peer: turn.peer, bytes: turn.carryOut(), joined: true }
    },
  ),
  simple('the one before again', serial, (turn) => {
    const before = turn.plc.lastAnswer
    if (before.length > 0) turn.send(before)
    turn.send(turn.carryOut())
  }),
  fault('in two chunks', tcp, (random) => {
    const [part, ms] = [random.next(), random.below(6)]
    return (turn) => turn.sendCut(cut(turn.carryOut(), part), ms)
  }),
  simple('byte by byte', tcp, (turn) => turn.trickle(turn.carryOut())),
  fault('cut', everywhere, (random) => {
    const part = random.next()
    return (turn) => {
      const pieces = cut(turn.carryOut(), part)
      if (turn.peer.name.startsWith('port')) turn.send(pieces[0])
      else turn.sendCut(pieces)
    }
  }),
  fault('cut, the rest late', tcp, (random) => {
    const [part, ms] = [random.next(), late(random)]
    return (turn) => turn.sendCut(cut(turn.carryOut(), part), ms)
  }),
  fault('cut and closed', tcp, (random) => {
    const part = random.next()
    return (turn) => {
      turn.sendCut(cut(turn.carryOut(), part))
      turn.peer.end()
    }
  }),
  fault('cut and reset', tcp, (random) => {
    const part = random.next()
    return (turn) => {
      turn.sendCut(cut(turn.carryOut(), part))
      turn.peer.reset()
    }
  }),
  fault('garbage behind it', everywhere, (random) => {
    const bytes = junk(random, 20)
    return (turn) => turn.send(Buffer.concat([turn.carryOut(), bytes]))
  }),
  fault('garbage before it', everywhere, (random) => {
    const [bytes, together] = [junk(random, 20), random.oneIn(2)]
    return (turn) => {
      if (!together) turn.send(bytes)
      turn.send(together ? Buffer.concat([bytes, turn.carryOut()]) : turn.carryOut())
    }
  }),
  fault('garbage instead of it', everywhere, (random) => {
    const bytes = junk(random, 60)
    return (turn) => {
      turn.carryOut()
      turn.send(bytes)
    }
  }),
  simple('empty datagram', udp, (turn) => {
    turn.send(Buffer.alloc(0))
    turn.send(turn.carryOut())
  }),
  simple('closed', tcp, (turn) => turn.peer.end()),
  simple('carried out and closed', tcp, (turn) => {
    turn.carryOut()
    turn.peer.end()
  }),
  simple('reset', tcp, (turn) => turn.peer.reset()),
  simple('carried out and reset', tcp, (turn) => {
    turn.carryOut()
    turn.peer.reset()
  }),
  simple('answered and closed', tcp, (turn) => {
    turn.send(turn.carryOut())
    turn.peer.end()
  }),
  simple('answered and reset', tcp, (turn) => {
    turn.send(turn.carryOut())
    turn.after(0, () => turn.peer.reset())
  }),
  simple('half open', tcp, (turn) => {
    turn.peer.forgotten = true
  }),
  simple('carried out and half open', tcp, (turn) => {
    turn.carryOut()
    turn.peer.forgotten = true
  }),
  fault('closed, and accepts to close', tcp, (random) => {
    const times = 1 + random.below(3)
    return (turn) => {
      turn.plc.closeNext = times
      turn.peer.end()
    }
  }),
  fault('off and on', everywhere, (random) => {
    const [ms, carriedOut] = [1 + random.below(12), random.oneIn(2)]
    return (turn) => {
      if (carriedOut) turn.carryOut()
      turn.plc.reboot(ms)
    }
  }),
  fault('off and on, unnoticed', everywhere, (random) => {
    const ms = 1 + random.below(20)
    return (turn) => {
      turn.plc.deaf = true
      turn.plc.forgetAll()
      turn.after(ms, () => {
        turn.plc.deaf = false
      })
    }
  }),
  changed('wrong network', slmp, () => ({ route: (route) => flipped(route, 0) })),
  changed('wrong station', slmp, () => ({ route: (route) => flipped(route, route.length > 8 ? 3 : 1) })),
  changed('wrong module I/O', slmp, () => ({ route: (route) => flipped(route, route.length > 8 ? 7 : 3) })),
  changed('wrong serial number', serial, () => ({ serial: (number) => number ^ 0x4000 })),
  changed(
    'wrong command',
    ({ frame }) => frame === '1E' || frame === 'ext',
    () => ({ command: (code) => code ^ 2 }),
  ),
  changed('wrong subheader', slmp, () => ({ subheader: (number) => number + 1 })),
  changed('length too long', slmp, (random) => ({ lengthBy: 1 + random.below(8) })),
  changed('length too short', slmp, () => ({ lengthBy: -1 })),
  changed('a word too many', everywhere, () => ({ data: (data) => Buffer.concat([data, Buffer.from('0000')]) })),
  changed('a byte too few', everywhere, () => ({ data: (data) => data.subarray(0, Math.max(0, data.length - 1)) })),
  changed('a character that is no digit', ascii, (random) => {
    const place = random.next()
    return { data: (data) => spoilt(data, place) }
  }),
  fault('refused', everywhere, (random) => {
    const place = random.next()
    return (turn) => turn.send(turn.refuse(endCodeOf(turn, place)))
  }),
  fault('refused slowly', everywhere, (random) => {
    const [place, ms] = [random.next(), 1 + random.below(TIMEOUT / 3)]
    return (turn) => turn.send(turn.refuse(endCodeOf(turn, place)), ms)
  }),
  fault('refused twice', toldApart, (random) => {
    const place = random.next()
    return (turn) => {
      const refusal = turn.refuse(endCodeOf(turn, place))
      turn.send(refusal)
      turn.send(refusal)
    }
  }),
  fault('refused and closed', tcp, (random) => {
    const place = random.next()
    return (turn) => {
      turn.send(turn.refuse(endCodeOf(turn, place)))
      turn.peer.end()
    }
  }),
  fault('refused late', everywhere, (random) => {
    const [place, ms] = [random.next(), late(random)]
    return (turn) => turn.send(turn.refuse(endCodeOf(turn, place)), ms)
  }),
  fault('refused without error information', slmp, (random) => {
    const place = random.next()
    return (turn) => turn.send(turn.refuse(endCodeOf(turn, place), { data: () => Buffer.alloc(0) }))
  }),
  fault('answer of a stranger', udp, (random) => {
    const place = random.next()
    return (turn) => {
      turn.plc.sendAsStranger(turn.peer, turn.strangersAnswer(endCodeOf(turn, place)))
      turn.send(turn.carryOut(), 1)
    }
  }),
  fault('On-demand before it', slmp, (random) => {
    const words = Array.from({ length: random.below(4) }, () => random.below(0x10000))
    return (turn) => {
      turn.send(onDemandFrame(turn.request, words))
      turn.send(turn.carryOut())
    }
  }),
]

/** How often it is taken. What nothing but the order tells apart is where late answers do harm. */
export function weightOf({ name }: Fault, { fixedPort, serial: number }: Configuration): number {
  if (fixedPort && !number && / late$/.test(` ${name}`)) return 6
  return name.startsWith('refused') ? 2 : 1
}

/** Another digit or byte there. */
function flipped(route: Buffer, at: number): Buffer {
  const copy = Buffer.from(route)
  const before = copy[at] ?? 0
  copy[at] = route.length > 8 ? (before === 0x31 ? 0x32 : 0x31) : before ^ 1
  return copy
}

function spoilt(data: Buffer, place: number): Buffer {
  const copy = Buffer.from(data)
  if (copy.length > 0) copy[place % copy.length] = 0x47
  return copy
}
