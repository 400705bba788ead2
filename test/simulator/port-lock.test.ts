// The remote password of the simulated port: who is locked out, when, and with which end code.
import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/melsec/commands/commands'
import type { PlcSimulatorOptions } from '../../src/simulator/server'
import { join } from './support'

const RIGHT = { password: 'Secret-1' }
const WRONG = { password: 'Secret-2' }
const D0 = { head: { device: 'D', number: 0 }, points: 1 } as const

function locked(options: PlcSimulatorOptions = {}) {
  const joined = join({ profile: 'iq-r', ...RIGHT, ...options })
  return { ...joined, read: () => joined.asker.endCode(commands.readWords, D0) }
}

describe('a locked port', () => {
  test('answers C201 to everything but unlock and lock, also to what it does not know', () => {
    const { asker, plc } = locked()
    expect(asker.endCode(commands.readWords, D0)).toBe(0xc201)
    expect(asker.endCode(commands.readTypeName, {})).toBe(0xc201)
    expect(asker.endCode(commands.remoteStop, {})).toBe(0xc201)
    expect(asker.rawEndCode(Buffer.from('99990000', 'hex'))).toBe(0xc201)
    expect(asker.endCode(commands.lock, WRONG)).toBe(0)
    expect(plc.cpu.state).toBe('RUN')
  })

  test('is opened by its password for this connection only', () => {
    const { asker, read, connect } = locked()
    expect(asker.endCode(commands.unlock, RIGHT)).toBe(0)
    expect(read()).toBe(0)
    expect(connect().endCode(commands.readWords, D0)).toBe(0xc201)
  })

  test('does not look at a password while it is open', () => {
    const { asker, read } = locked()
    asker.ask(commands.unlock, RIGHT)
    expect(asker.endCode(commands.unlock, WRONG)).toBe(0)
    expect(read()).toBe(0)
  })

  test('is locked by its password, and by the end of the connection', () => {
    const { asker, read, connect } = locked()
    asker.ask(commands.unlock, RIGHT)
    expect(asker.endCode(commands.lock, WRONG)).toBe(0xc810)
    expect(read()).toBe(0)
    expect(asker.endCode(commands.lock, RIGHT)).toBe(0)
    expect(read()).toBe(0xc201)
    asker.ask(commands.unlock, RIGHT)
    asker.close()
    expect(connect().endCode(commands.readWords, D0)).toBe(0xc201)
  })

  test('of an iQ-F is locked without looking at the password', () => {
    const { asker, read } = locked({ profile: 'iq-f' })
    asker.ask(commands.unlock, RIGHT)
    expect(asker.endCode(commands.lock, WRONG)).toBe(0)
    expect(read()).toBe(0xc201)
  })

  test('over UDP locks itself after ten minutes without traffic, over TCP never', () => {
    const clock = locked().clock
    const { plc, read: readTcp, asker } = locked({ clock })
    const udp = join({ profile: 'iq-r', clock, ...RIGHT }, { connect: { kind: 'datagram' } }).asker
    asker.ask(commands.unlock, RIGHT)
    udp.ask(commands.unlock, RIGHT)
    clock.advance(599_999)
    expect(udp.endCode(commands.readWords, D0)).toBe(0)
    clock.advance(600_000)
    expect(udp.endCode(commands.readWords, D0)).toBe(0xc201)
    expect(readTcp()).toBe(0)
    expect(plc.errors.entries).toEqual([])
  })
})

describe('wrong passwords', () => {
  test('lock out after so many in a row, for a time, also for the right one', () => {
    const { asker, clock, read } = locked({ passwordAttempts: 3, lockOutTime: 60_000 })
    const wrong = () => asker.endCode(commands.unlock, WRONG)
    expect([wrong(), wrong(), wrong(), wrong()]).toEqual([0xc810, 0xc810, 0xc815, 0xc816])
    expect(asker.endCode(commands.unlock, RIGHT)).toBe(0xc816)
    clock.advance(59_999)
    expect(asker.endCode(commands.unlock, RIGHT)).toBe(0xc816)
    clock.advance(1)
    expect(asker.endCode(commands.unlock, RIGHT)).toBe(0)
    expect(read()).toBe(0)
  })

  test('are counted over connections, and forgotten after the right one', () => {
    const { asker, connect } = locked({ passwordAttempts: 2 })
    expect(asker.endCode(commands.unlock, WRONG)).toBe(0xc810)
    expect(asker.endCode(commands.unlock, RIGHT)).toBe(0)
    expect(connect().endCode(commands.unlock, WRONG)).toBe(0xc810)
    expect(connect().endCode(commands.unlock, WRONG)).toBe(0xc815)
  })

  test('of Q and L are C200, of a wrong length too', () => {
    const { asker } = locked({ profile: 'q', password: 'abcd' })
    expect(asker.endCode(commands.unlock, { password: 'abce' })).toBe(0xc200)
    expect(asker.endCode(commands.unlock, { password: 'abcdef' })).toBe(0xc200)
    expect(asker.endCode(commands.unlock, { password: 'abcd' })).toBe(0)
  })

  test('never appear in events and logs', () => {
    const { asker, plc } = locked()
    const events: string[] = []
    plc.on('request', (event) => void events.push(JSON.stringify(event)))
    asker.endCode(commands.unlock, WRONG)
    asker.endCode(commands.unlock, RIGHT)
    expect(events).toHaveLength(2)
    expect(`${events.join()} ${JSON.stringify(plc.errors.entries)}`).not.toContain('Secret')
    expect(events[0]).toContain('********')
  })
})

test.each([
  ['iq-r', 'abcde'],
  ['iq-f', 'a'.repeat(33)],
  ['q', 'abcde'],
  ['l', 'abc'],
  ['generic', 'abc'],
  ['iq-r', 'pässword'],
] as const)('%s cannot have the password %s, and the error does not show it', (profile, password) => {
  expect(() => locked({ profile, password })).toThrow(
    expect.objectContaining({ code: 'BAD_OPTION', field: 'password' }),
  )
  expect(() => locked({ profile, password })).not.toThrow(new RegExp(password))
})
