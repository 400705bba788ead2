import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import type { StateChange } from '../../src/simulator/cpu'
import { join } from './support'

const REMOTE = 0x408b
const NOT_IN_STOP = 0x4013

function twoDevices(options: Parameters<typeof join>[0] = {}) {
  const joined = join(options, { connect: { device: 'line computer' } })
  const other = joined.connect({ connect: { device: 'laptop' } })
  const does = (who: typeof other) => ({
    run: () => who.endCode(commands.remoteRun, { mode: 1 }),
    forceRun: () => who.endCode(commands.remoteRun, { mode: 3 }),
    stop: () => who.endCode(commands.remoteStop, {}),
    pause: () => who.endCode(commands.remotePause, { mode: 1 }),
    forcePause: () => who.endCode(commands.remotePause, { mode: 3 }),
    latchClear: () => who.endCode(commands.remoteLatchClear, {}),
    reset: () => who.endCode(commands.remoteReset, {}),
  })
  return { ...joined, a: does(joined.asker), b: does(other), bAsker: other }
}

type Action = 'run' | 'forceRun' | 'stop' | 'pause' | 'forcePause' | 'latchClear'

describe('who may do what: the device that stopped or paused the CPU, and others by force', () => {
  const rows: readonly (readonly [before: 'stop' | 'pause' | 'nothing', who: 'a' | 'b', Action, number, string])[] = [
    ['nothing', 'b', 'run', 0, 'RUN'],
    ['nothing', 'b', 'stop', 0, 'STOP'],
    ['nothing', 'b', 'pause', 0, 'PAUSE'],
    ['nothing', 'b', 'latchClear', NOT_IN_STOP, 'RUN'],
    ['stop', 'a', 'run', 0, 'RUN'],
    ['stop', 'a', 'forceRun', 0, 'RUN'],
    ['stop', 'a', 'stop', 0, 'STOP'],
    ['stop', 'a', 'pause', 0, 'PAUSE'],
    ['stop', 'a', 'latchClear', 0, 'STOP'],
    ['stop', 'b', 'run', REMOTE, 'STOP'],
    ['stop', 'b', 'forceRun', 0, 'RUN'],
    ['stop', 'b', 'stop', 0, 'STOP'],
    ['stop', 'b', 'pause', REMOTE, 'STOP'],
    ['stop', 'b', 'forcePause', 0, 'PAUSE'],
    ['stop', 'b', 'latchClear', REMOTE, 'STOP'],
    ['pause', 'a', 'run', 0, 'RUN'],
    ['pause', 'a', 'pause', 0, 'PAUSE'],
    ['pause', 'a', 'latchClear', NOT_IN_STOP, 'PAUSE'],
    ['pause', 'b', 'run', REMOTE, 'PAUSE'],
    ['pause', 'b', 'forceRun', 0, 'RUN'],
    ['pause', 'b', 'pause', REMOTE, 'PAUSE'],
    ['pause', 'b', 'stop', 0, 'STOP'],
  ]
  test.each(rows)('after a has done %s, %s does %s: %i, %s', (before, who, action, endCode, state) => {
    const both = twoDevices()
    if (before !== 'nothing') both.a[before]()
    expect([both[who][action](), both.plc.cpu.state]).toEqual([endCode, state])
  })

  test('a second STOP does not make its device the owner', () => {
    const { a, b, plc } = twoDevices()
    a.stop()
    b.stop()
    expect([plc.cpu.hold, b.run(), a.run()]).toEqual([{ state: 'STOP', owner: 'line computer' }, REMOTE, 0])
  })

  test('two connections of one device are one owner', () => {
    const { a, connect } = twoDevices()
    a.stop()
    const again = connect({ connect: { device: 'line computer' } })
    expect(again.endCode(commands.remoteRun, { mode: 1 })).toBe(0)
  })
})

describe('switch at STOP', () => {
  test('Remote RUN completes normally and the CPU stays in STOP until the switch goes to RUN', () => {
    const { a, plc } = twoDevices()
    plc.cpu.switch = 'STOP'
    expect([a.run(), plc.cpu.state]).toEqual([0, 'STOP'])
    plc.cpu.switch = 'RUN'
    expect(plc.cpu.state).toBe('RUN')
  })

  test('Remote PAUSE completes normally and changes nothing', () => {
    const { a, plc } = twoDevices()
    plc.cpu.switch = 'STOP'
    expect([a.pause(), plc.cpu.state]).toEqual([0, 'STOP'])
    plc.cpu.switch = 'RUN'
    expect(plc.cpu.state).toBe('RUN')
  })

  test('a remote STOP outlasts the switch', () => {
    const { a, plc } = twoDevices()
    a.stop()
    plc.cpu.switch = 'STOP'
    plc.cpu.switch = 'RUN'
    expect(plc.cpu.state).toBe('STOP')
  })

  test('latch clear is allowed when nobody holds the CPU remotely', () => {
    const { a, b, plc } = twoDevices()
    plc.cpu.switch = 'STOP'
    expect(b.latchClear()).toBe(0)
    a.stop()
    expect([a.latchClear(), b.latchClear()]).toEqual([0, REMOTE])
  })

  test('another position is refused', () => {
    const { plc } = join()
    // A JavaScript program could do it.
    const position = JSON.parse('"PAUSE"')
    expect(() => {
      plc.cpu.switch = position
    }).toThrow(RequestError)
  })
})

describe('clearing devices', () => {
  function kept(clearMode: 0 | 1 | 2, stop = true) {
    const { plc, asker } = join()
    plc.memory.setWord('D', 0, 1)
    plc.memory.setBit('L', 0, true)
    plc.memory.setWord('ZR', 0, 1)
    if (stop) asker.ask(commands.remoteStop, {})
    asker.ask(commands.remoteRun, { mode: 1, clearMode })
    return [plc.memory.word('D', 0), plc.memory.bit('L', 0), plc.memory.word('ZR', 0)]
  }

  test('mode 0 nothing, 1 all but the latched, 2 all', () => {
    expect([kept(0), kept(1), kept(2)]).toEqual([
      [1, true, 1],
      [0, true, 1],
      [0, false, 0],
    ])
  })

  test('nothing is cleared when the CPU was in RUN already', () => {
    expect(kept(2, false)).toEqual([1, true, 1])
  })

  test('nothing is cleared while the switch is at STOP', () => {
    const { plc, asker } = join()
    plc.memory.setWord('D', 0, 1)
    plc.cpu.switch = 'STOP'
    asker.ask(commands.remoteRun, { mode: 1, clearMode: 2 })
    expect(plc.memory.word('D', 0)).toBe(1)
  })

  test('programs are told', () => {
    const { plc, asker } = join()
    const scopes: string[] = []
    plc.on('clear', ({ scope }) => void scopes.push(scope))
    asker.ask(commands.remoteStop, {})
    asker.ask(commands.remoteLatchClear, {})
    asker.ask(commands.remoteRun, { mode: 1, clearMode: 1 })
    expect(scopes).toEqual(['all', 'unlatched'])
  })
})

describe('reset', () => {
  test('is refused unless the parameter permits it', () => {
    const { a } = twoDevices()
    a.stop()
    expect(a.reset()).toBe(REMOTE)
  })

  test('is refused outside STOP', () => {
    const { a } = twoDevices({ resetAllowed: true })
    expect(a.reset()).toBe(NOT_IN_STOP)
    a.pause()
    expect(a.reset()).toBe(NOT_IN_STOP)
  })

  test('answers nothing, drops every connection, forgets registrations, remote state and what is not latched', () => {
    const { a, asker, bAsker, plc, clock, connect } = twoDevices({ resetAllowed: true })
    const D0 = { words: [{ device: { device: 'D', number: 0 } }], doubleWords: [] } as const
    bAsker.ask(commands.entryMonitorDevice, D0)
    plc.memory.setWord('D', 0, 1)
    plc.memory.setBit('L', 0, true)
    a.stop()
    expect(a.reset()).toBeUndefined()
    expect([asker.closed, bAsker.closed, plc.cpu.state, plc.connections]).toEqual([true, true, 'STOP', []])
    clock.advance(1000)
    const again = connect({ connect: { device: 'laptop' } })
    expect([plc.cpu.state, plc.cpu.hold]).toEqual(['RUN', undefined])
    expect([plc.memory.word('D', 0), plc.memory.bit('L', 0)]).toEqual([0, true])
    expect(again.endCode(commands.executeMonitor, {}, { context: D0 })).toBe(0xc05d)
  })

  test('nobody is answered until the PLC has started again', () => {
    const { a, clock, connect } = twoDevices({ resetAllowed: true, restartTime: 300 })
    a.stop()
    a.reset()
    expect(connect().closed).toBe(true)
    clock.advance(299)
    expect(connect().closed).toBe(true)
    clock.advance(1)
    expect(connect().endCode(commands.readTypeName, {})).toBe(0)
  })

  test('the switch decides the state after it', () => {
    const { a, plc, clock } = twoDevices({ resetAllowed: true })
    plc.cpu.switch = 'STOP'
    a.reset()
    clock.advance(1000)
    expect(plc.cpu.state).toBe('STOP')
  })
})

test('programs see every change of state and why', () => {
  const { plc, clock, asker } = join({ restartTime: 100 })
  const changes: string[] = []
  const end = plc.on('state', ({ previous, state, reason }: StateChange) => {
    changes.push(`${previous} ${state} ${reason}`)
  })
  asker.ask(commands.remoteStop, {})
  asker.ask(commands.remoteStop, {})
  asker.ask(commands.remotePause, { mode: 1 })
  plc.cpu.switch = 'STOP'
  plc.cpu.switch = 'RUN'
  asker.ask(commands.remoteRun, { mode: 1 })
  plc.restart()
  clock.advance(100)
  end()
  plc.cpu.switch = 'STOP'
  expect(changes).toEqual([
    'RUN STOP remote',
    'STOP PAUSE remote',
    'PAUSE STOP switch',
    'STOP PAUSE switch',
    'PAUSE RUN remote',
    'RUN STOP restart',
    'STOP RUN restart',
  ])
})
