import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/melsec/commands/commands'
import type { ProfileId } from '../../src/melsec/profiles/profile'
import { join, rawBody } from './support'

const M0 = { device: 'M', number: 0 } as const
const D0 = { device: 'D', number: 0 } as const
const TS0 = { device: 'TS', number: 0 } as const
const hex = (text: string) => Buffer.from(text.replaceAll(' ', ''), 'hex')

describe('end codes for what a client can send', () => {
  const rows: readonly (readonly [string, ProfileId, Buffer, number])[] = [
    ['unknown command', 'iq-r', hex('9999 0000'), 0xc059],
    ['unknown subcommand', 'iq-r', hex('0104 0400'), 0xc059],
    ['body without a subcommand', 'iq-r', hex('0104'), 0xc061],
    ['empty body', 'iq-f', hex(''), 0xc061],
    ['long form on iQ-F', 'iq-f', hex('0104 0200 00000000 a800 0100'), 0xc059],
    ['long form on Q', 'q', hex('0104 0200 00000000 a800 0100'), 0xc059],
    ['data too short', 'iq-r', hex('0104 0000 000000 a8 01'), 0xc061],
    ['data too long', 'iq-r', hex('0104 0000 000000 a8 0100 00'), 0xc061],
    ['fewer values than points', 'iq-r', hex('0114 0000 000000 a8 0200 0100'), 0xc061],
    ['unknown device code on iQ-R', 'iq-r', hex('0104 0000 000000 99 0100'), 0x4030],
    // Measured by others on an R120PCPU: an extension specification in the wrong order.
    ['unknown device code with 0080 on iQ-R', 'iq-r', hex('0104 8000 000000000000 640000 a8 0100'), 0xc05b],
    ['unknown device code with 0082 on iQ-R', 'iq-r', hex('0104 8200 0000 00000000 9900 0000 0000 00 0100'), 0xc05b],
    ['the right order of the same', 'iq-r', hex('0104 8000 0000 640000 a8 0000 0000 00 0100'), 0],
    [
      '97 points of Read Random with 0080',
      'iq-r',
      hex(`0304 8000 61 00 ${'0000 000000 a8 0000 0000 00'.repeat(97)}`),
      0xc054,
    ],
    ['unknown device code on iQ-F', 'iq-f', hex('0104 0000 000000 99 0100'), 0xc05c],
    ['unknown device code on L', 'l', hex('0104 0000 000000 99 0100'), 0xc05b],
    ['set/reset that is neither', 'iq-r', hex('0214 0100 01 000000 90 02'), 0xc060],
    ['unknown device code among random bits', 'iq-r', hex('0214 0100 01 000000 99 01'), 0x4030],
    ['0 points in a block', 'iq-r', hex('0604 0000 01 00 000000 a8 0000'), 0xc051],
    ['remote RUN in another mode', 'iq-r', hex('0110 0000 0200 00 00'), 0xc05c],
    ['remote RUN clearing on iQ-F', 'iq-f', hex('0110 0000 0100 01 00'), 0xc05c],
    ['self test with other characters', 'iq-r', hex('1906 0000 0100 67'), 0xc05c],
    ['self test without data', 'iq-r', hex('1906 0000 0000'), 0xc05c],
    ['self test with another count', 'iq-r', hex('1906 0000 0500 41 42'), 0xc061],
    ['bit units of a word device', 'iq-r', hex('0104 0100 000000 a8 0100'), 0xc05c],
    ['random bits of a word device', 'iq-f', hex('0214 0100 01 000000 a8 01'), 0xc05c],
    ['monitor on iQ-F', 'iq-f', hex('0108 0000 01 00 000000 a8'), 0xc059],
    ['contact in a word block', 'iq-r', hex('0604 0000 01 00 000000 c1 0100'), 0x4030],
    ['contact in Entry Monitor Device', 'iq-r', hex('0108 0000 01 00 000000 c1'), 0x4032],
    ['long timer contact in Read', 'iq-r', hex('0104 0300 00000000 5100 0100'), 0x4030],
    ['LTN as one word of Read Random', 'iq-r', hex('0304 0200 01 00 00000000 5200'), 0x4030],
    ['LCN not in whole counters', 'iq-r', hex('0114 0200 00000000 5600 0100 0100'), 0xc051],
    ['timer contact in Read Random on iQ-F', 'iq-f', hex('0304 0000 01 00 000000 c1'), 0xc05b],
    ['step relay written on iQ-R', 'iq-r', hex('0114 0100 000000 98 0100 10'), 0x4030],
    ['index register in Read', 'iq-r', hex('0104 8000 0240 000000 a8 0000 0000 00 0100'), 0xc05c],
    ['indirect address', 'iq-r', hex('0304 8000 01 00 0008 000000 a8 0000 0000 00'), 0xc05c],
  ]
  test.each(rows)('%s', (_, profile, body, endCode) => {
    expect(join({ profile }).asker.rawEndCode(body)).toBe(endCode)
  })

  test('ASCII digits that are none', () => {
    const { asker } = join({ code: 'ascii' })
    expect(asker.rawEndCode(Buffer.from('04010000D*0000x00001'))).toBe(0xc050)
    expect(asker.rawEndCode(Buffer.from('04x10000D*0000000001'))).toBe(0xc050)
  })

  test('octal digits of X in ASCII code on iQ-F; hexadecimal ones when the port is set so', () => {
    const octal = join({ profile: 'iq-f', code: 'ascii' })
    octal.plc.memory.set('X20', 'BOOL', true)
    const read = (joined: typeof octal, number: string) =>
      joined.asker.rawEndCode(Buffer.from(`04010001X*${number}0001`))
    expect([read(octal, '000020'), read(octal, '00001F')]).toEqual([0, 0xc050])
    const hexadecimal = join({ profile: 'iq-f', code: 'ascii', asciiXy: 'hexadecimal' })
    expect(read(hexadecimal, '00001F')).toBe(0)
  })

  test('monitor that was never registered', () => {
    const { asker } = join()
    expect(asker.rawEndCode(hex('0208 0000'))).toBe(0xc05d)
  })

  test('a refused registration leaves the old one in force', () => {
    const { asker } = join()
    const context = { words: [{ device: D0 }], doubleWords: [] }
    asker.ask(commands.entryMonitorDevice, context)
    asker.rawEndCode(rawBody(commands.entryMonitorDevice, 0, 'short', { words: [{ device: TS0 }], doubleWords: [] }))
    expect(asker.ask(commands.executeMonitor, {}, { context })).toEqual({ words: [0], doubleWords: [] })
  })

  test('profile overrides: a command set as lacking, a smaller limit, a shorter range', () => {
    const { asker } = join({
      profileOverrides: { lacks: { selfTest: true }, limits: { readWords: 10 }, ranges: { D: 100 } },
    })
    expect([
      asker.endCode(commands.selfTest, { data: 'A' }),
      asker.endCode(commands.readWords, { head: D0, points: 11 }),
      asker.endCode(commands.readWords, { head: { device: 'D', number: 100 }, points: 1 }),
      asker.endCode(commands.readBits, { head: M0, points: 11 }),
    ]).toEqual([0xc059, 0xc051, 0x4031, 0])
  })
})

describe('error information', () => {
  test('names this station and the command as it was asked', () => {
    const { asker } = join()
    asker.rawEndCode(hex('0104 0200 00000000 9900 0100'))
    const answer = asker.received.at(-1)
    expect(answer?.subarray(-11).toString('hex')).toBe('304000ffff030001040200')
  })

  test('has twice the characters in ASCII code', () => {
    const { asker } = join({ code: 'ascii' }, { frame: '3E' })
    asker.rawEndCode(Buffer.from('04010000D*9999990001'))
    expect(asker.received.at(-1)?.toString()).toBe('D00000FF03FF000016403100FF03FF0004010000')
  })
})

describe('other stations', () => {
  const read = { head: D0, points: 1 }

  test.each([
    ['iq-r', { network: 1, station: 2 }, 0x4b00],
    ['iq-r', { moduleIo: 0x3e1 }, 0x4b02],
    ['iq-r', { moduleIo: 0x3e0 }, 0],
    ['q', { moduleIo: 0, multidrop: 1 }, 0x4b00],
    ['iq-f', { network: 1, station: 2 }, 0xc05f],
    ['iq-f', { moduleIo: 0x3e0 }, 0xc05f],
    ['iq-f', {}, 0],
  ] as const)('%s asked by %j', (profile, route, endCode) => {
    expect(join({ profile }, { route }).asker.endCode(commands.readWords, read)).toBe(endCode)
  })

  test('are silent when that is how the network is', () => {
    const { asker, plc } = join({ otherStations: 'silence' }, { route: { network: 1, station: 2 } })
    expect(asker.endCode(commands.writeWords, { head: D0, values: [1] })).toBeUndefined()
    expect(plc.memory.word('D', 0)).toBe(0)
  })
})

describe('error LED and log', () => {
  test('a refusal lights the LED and is logged with the client; a restart forgets it', () => {
    const { asker, plc, clock } = join()
    asker.rawEndCode(hex('9999 0000'))
    expect(plc.errors).toMatchObject({ led: true, entries: [{ endCode: 0xc059, time: clock.time() }] })
    expect(plc.errors.entries[0]?.remote).toBe(plc.connections[0]?.remote)
    plc.restart()
    expect(plc.errors).toMatchObject({ led: false, entries: [] })
  })

  test('keeps the latest 64', () => {
    const { asker, plc } = join()
    for (let i = 0; i < 100; i++) asker.rawEndCode(hex('9999 0000'))
    expect(plc.errors.entries).toHaveLength(64)
  })
})
