/** The simulated iQ-F as a 1E client sees it: in memory, over loopback TCP and UDP, in both codes. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { Declaration, Message, Named } from '../../src/codec/codec'
import { EndCodeError } from '../../src/errors'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { type ACompatibleOptions, aCompatibleProtocol } from '../../src/melsec/a-compatible/protocol'
import type { DeviceName } from '../../src/melsec/device/device'
import { frame1e } from '../../src/melsec/frame/frame-1e'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/simulator/server'
import { manualClock } from '../support/manual-clock'
import { readD, withClient, word } from './wire'

type Code = 'binary' | 'ascii'
const CODES = ['binary', 'ascii'] as const
const at = (device: DeviceName, number: number) => ({ device, number })

function plcOf(options: PlcSimulatorOptions = {}): PlcSimulator {
  return createPlcSimulator({ profile: 'iq-f', clock: manualClock(), ...options })
}

/** Sends bytes over a connection in memory and gives what came back. */
function exchangeBytes(plc: PlcSimulator, ...chunks: readonly Buffer[]): Buffer {
  const answers: Buffer[] = []
  const transport = plc.connect({ delivery: 'synchronous' })()
  transport.open({ opened() {}, received: (answer) => void answers.push(answer), closed() {} })
  for (const chunk of chunks) transport.send(chunk)
  transport.close()
  return Buffer.concat(answers)
}

function commandOf(name: string): Named<Declaration, string> {
  const found = Object.values<Named<Declaration, string>>(aCompatibleCommands).find((entry) => entry.name === name)
  if (found === undefined) throw new Error(`no command ${name}`)
  return found
}

/** Asks as a client does; throws what the client would throw. */
function asker(plc: PlcSimulator, options: ACompatibleOptions) {
  const protocol = aCompatibleProtocol({ asciiXy: 'octal', oddBits: 'exact', ...options })
  return (name: string, message: Message = {}): Message => {
    const asked = protocol.exchange(commandOf(name), message)
    const answer = exchangeBytes(plc, asked.write(0))
    const scanned = protocol.framing.response.scan(answer, asked.responseLength)
    expect(scanned?.used).toBe(answer.length)
    if (scanned === undefined) throw new Error('no whole answer')
    return asked.decode(scanned.frame)
  }
}

describe.each(CODES)('1E, %s', (code) => {
  test('every command, on the devices as a program in the PLC sees them', () => {
    const plc = plcOf({ code })
    const ask = asker(plc, { code })
    plc.write('D100', 4660)
    plc.write('M101', true)
    plc.write('LCN3', 1_234_567)
    plc.write('SM8000', true)
    expect(ask('readWords', { head: at('D', 100), points: 2 })).toEqual({ values: [4660, 0] })
    expect(ask('readBits', { head: at('M', 100), points: 3 })).toEqual({ values: [false, true, false] })
    expect(ask('readWords', { head: at('M', 96), points: 1 })).toEqual({ values: [0b100000] })
    expect(ask('readWords', { head: at('LCN', 3), points: 2 })).toEqual({ values: [1_234_567 & 0xffff, 18] })
    expect(ask('readBits', { head: at('SM', 8000), points: 1 })).toEqual({ values: [true] })
    expect(ask('writeWords', { head: at('D', 7998), values: [1, 0xffff] })).toEqual({})
    expect(ask('writeWords', { head: at('LCN', 55), values: [2, 1] })).toEqual({})
    expect(ask('writeWords', { head: at('Y', 0o20), values: [0x8001] })).toEqual({})
    expect(ask('writeBits', { head: at('M', 7), values: [true, false, true] })).toEqual({})
    expect(
      ask('writeRandomBits', {
        bits: [
          { device: at('LCS', 2), value: true },
          { device: at('S', 38), value: true },
        ],
      }),
    ).toEqual({})
    expect(
      ask('writeRandomWords', {
        words: [
          { device: at('R', 26), value: 9 },
          { device: at('X', 0), value: 3 },
        ],
      }),
    ).toEqual({})
    const shown = ['D7999', 'LCN55', 'Y20', 'Y37', 'M7', 'M8', 'M9', 'LCS2', 'S38', 'R26', 'X1', 'X2'].map((item) =>
      plc.read(item),
    )
    expect(shown).toEqual([-1, 65538, true, true, true, false, true, true, true, 9, true, false])
    expect(ask('readPcType')).toEqual({ typeCode: 0xf3 })
    expect(ask('loopback', { data: '0123456789ABCDEF' })).toEqual({ data: '0123456789ABCDEF' })
    expect([plc.cpu.state, ask('remoteStop'), plc.cpu.state]).toEqual(['RUN', {}, 'STOP'])
  })

  test('256 points of bits, and 254 characters back', () => {
    const plc = plcOf({ code })
    const ask = asker(plc, { code })
    for (let i = 0; i < 256; i += 5) plc.memory.setBit('M', i, true)
    const expected = Array.from({ length: 256 }, (_, i) => i % 5 === 0)
    expect(ask('readBits', { head: at('M', 0), points: 256 })).toEqual({ values: expected })
    expect(ask('loopback', { data: 'A'.repeat(254) })).toEqual({ data: 'A'.repeat(254) })
  })

  test('who stopped the CPU is the one to start it', () => {
    const plc = plcOf({ code })
    const [mine, other] = [asker(plc, { code }), asker(plc, { code })]
    mine('remoteStop')
    let refusal: unknown
    try {
      other('remoteRun')
    } catch (error) {
      refusal = error
    }
    // Every connection in memory is another device.
    expect(refusal).toBeInstanceOf(EndCodeError)
    expect(refusal).toMatchObject({ endCode: 0x5b, message: expect.stringContaining('abnormal code 18H') })
    expect(plc.cpu.state).toBe('STOP')
  })
})

describe('end codes', () => {
  const rows: readonly (readonly [string, string, string])[] = [
    ['unknown command', '17ff0000', '9750'],
    ['unknown device', '01ff00000000000020570100', '8156'],
    ['a device code FX5 does not let through', '01ff000000000000435401 00'.replace(' ', ''), '8156'],
    ['M7680', '00ff0000001e0000204d0100', '8056'],
    ['a bit device not at a multiple of 16', '01ff000008000000204d0100', '8158'],
    ['bits of a word device', '00ff00000000000020440100', '8058'],
    ['over C200', '01ff0000c70000004e430200', '8157'],
    ['65 words', '01ff00000000000020444100', '8157'],
    ['33 words of bits', '01ff000000000000204d2100', '8157'],
    ['161 bits of a write', `02ff000000000000204da100${'00'.repeat(81)}`, '8257'],
    ['half a long counter', '01ff0000c80000004e430100', '8157'],
    ['a long counter at random', '05ff00000100c80000004e430100', '8556'],
    ['11 words at random', `05ff00000b00${'0000000020440000'.repeat(11)}`, '8557'],
    ['another PC number', '15010000', '955b10'],
    ['a reserved byte that is not 0', '01ff00006400000020440301', '8157'],
  ]
  test.each(rows)('%s', (_what, request, answer) => {
    const plc = plcOf()
    expect(exchangeBytes(plc, Buffer.from(request, 'hex')).toString('hex')).toBe(answer)
    expect(plc.errors.entries).toHaveLength(1)
  })

  test('ASCII digits that are none, and another command than there is', () => {
    const ask = (text: string) =>
      exchangeBytes(plcOf({ code: 'ascii' }), Buffer.from(text, 'latin1')).toString('latin1')
    expect(ask('01FF000044200000006x0300')).toBe('8154')
    expect(ask('1AFF0000')).toBe('9A50')
    expect(ask('x1FF0000442000000064')).toBe('')
  })

  test('nothing is written when one of the devices is wrong', () => {
    const plc = plcOf()
    const request = '04ff00000200000000002 04d01001e0000204d01'.replaceAll(' ', '')
    expect(exchangeBytes(plc, Buffer.from(request, 'hex')).toString('hex')).toBe('8456')
    expect(plc.read('M0')).toBe(false)
  })
})

describe('the port', () => {
  const request = Buffer.from('01ff00006400000020440100', 'hex')

  test('takes 3E and 1E in turns, a request cut anywhere, and two in one chunk', () => {
    const plc = plcOf()
    plc.write('D100', 7)
    const three = readD(100)
    const answers = Buffer.concat([Buffer.from('81000700', 'hex'), word(7), Buffer.from('81000700', 'hex')])
    expect(exchangeBytes(plc, request, three, request).toString('hex')).toBe(answers.toString('hex'))
    expect(exchangeBytes(plc, Buffer.concat([request, three, request])).toString('hex')).toBe(answers.toString('hex'))
    for (let cut = 1; cut < request.length; cut++) {
      const bytes = exchangeBytes(plc, request.subarray(0, cut), request.subarray(cut))
      expect(bytes.toString('hex')).toBe('81000700')
    }
  })

  test('set to 3E only, or of another family, it does not answer 1E', () => {
    expect(exchangeBytes(plcOf({ frames: ['3E'] }), request)).toHaveLength(0)
    expect(exchangeBytes(createPlcSimulator({ profile: 'iq-r', clock: manualClock() }), request)).toHaveLength(0)
    expect(() => createPlcSimulator({ profile: 'q', frames: ['1E'] })).toThrow('frames is 1E; it must be 3E or 4E')
  })

  test('in the other data code it is silent', () => {
    const text = Buffer.from('01FF00004420000000640100', 'latin1')
    expect(exchangeBytes(plcOf(), text)).toHaveLength(0)
    expect(exchangeBytes(plcOf({ code: 'ascii' }), request)).toHaveLength(0)
    expect(exchangeBytes(plcOf({ code: 'ascii' }), text).toString('latin1')).toBe('81000000')
  })

  test('says what it was asked, and refuses by fault switch', () => {
    const plc = plcOf()
    const seen: unknown[] = []
    plc.on('request', ({ frame, command, endCode }) => seen.push([frame, command, endCode]))
    const written: unknown[] = []
    plc.on('write', ({ message }) => written.push(message))
    exchangeBytes(plc, request)
    plc.faults.add({ kind: 'endCode', endCode: 0x5b, times: 1 })
    expect(exchangeBytes(plc, request).toString('hex')).toBe('815b10')
    exchangeBytes(plc, Buffer.from('03ff0000401f0000204401000500', 'hex'))
    expect(seen).toEqual([
      ['1E', 'readWords', 0],
      ['1E', 'readWords', 0x5b],
      ['1E', 'writeWords', 0],
    ])
    expect(written).toEqual([{ head: at('SD', 8000), values: [5] }])
  })

  test('a dummy character behind an odd number of bits when it is set so', () => {
    const text = Buffer.from('00FF00004D20000000000300', 'latin1')
    expect(exchangeBytes(plcOf({ code: 'ascii' }), text).toString('latin1')).toBe('8000000')
    expect(exchangeBytes(plcOf({ code: 'ascii', oddBits: 'padded' }), text).toString('latin1')).toBe('80000000')
  })

  test.each(['tcp', 'udp'] as const)('over loopback %s', async (kind) => {
    await withClient(kind, { profile: 'iq-f', frames: ['1E'] }, async (plc, client) => {
      plc.write('D100', -2)
      client.transport.send(request)
      expect((await client.bytes(4)).toString('hex')).toBe('8100feff')
    })
  })

  test.each(CODES)('%s: any bytes are answered by frames or by silence', (code: Code) => {
    const framing = frame1e(code)
    const bytes = (max: number) => fc.uint8Array({ maxLength: max }).map((array) => Buffer.from(array))
    const ascii = (content: Buffer) => (code === 'ascii' ? Buffer.from(content.toString('hex').toUpperCase()) : content)
    const asked = fc
      .tuple(fc.integer({ min: 0, max: 0x20 }), bytes(20))
      .map(([command, body]) => framing.request.write({ command, pc: 0xff, timer: 0 }, 0, ascii(body)))
    fc.assert(
      fc.property(fc.array(fc.oneof(asked, bytes(30)), { maxLength: 5 }), (chunks) => {
        const plc = plcOf({ code, frames: ['1E'] })
        const answers = exchangeBytes(plc, ...chunks)
        if (answers.length > 0) expect(answers[0] ?? 0).toBeGreaterThanOrEqual(code === 'ascii' ? 0x38 : 0x80)
        const alive = code === 'ascii' ? Buffer.from('15FF0000') : Buffer.from('15ff0000', 'hex')
        expect(exchangeBytes(plc, alive).toString('hex')).toBe(code === 'ascii' ? '393530304633' : '9500f3')
      }),
      { numRuns: 200 },
    )
  })
})

test.each([
  ['iq-f', 'binary', '9500f3', '815b10'],
  ['iq-f', 'ascii', '9500F3', '815B10'],
  ['fx3', 'binary', '9500f300', '815b1000'],
  ['fx3', 'ascii', '9500F300', '815B1000'],
] as const)('%s %s: the answers behind which an FX3 has 00H', (profile, code, typeName, refused) => {
  const encoding = code === 'ascii' ? 'latin1' : 'hex'
  const plc = plcOf({ profile, code, frames: ['1E'] })
  expect(exchangeBytes(plc, Buffer.from('15FF0000', encoding)).toString(encoding)).toBe(typeName)
  plc.faults.add({ kind: 'endCode', endCode: 0x5b, times: 1 })
  const read = code === 'ascii' ? '01FF0000442000000000' + '0100' : '01ff00000000000020440100'
  expect(exchangeBytes(plc, Buffer.from(read, encoding)).toString(encoding)).toBe(refused)
})

describe('the Ethernet module, FX5 communication manual 39.1 and 39.2', () => {
  test.each([
    ['counters of 32 bits by 03H', '03ff0000c80000004e430200' + '05000000', 0x83],
    ['contacts of timers by 05H', '05ff00000100' + '000000005354' + '0100', 0x85],
  ])('refuses %s, which the CPU module takes', (_, request, subheader) => {
    const answerOf = (profile: 'iq-f' | 'fx5-enet') => [
      ...exchangeBytes(plcOf({ profile, frames: ['1E'] }), Buffer.from(request, 'hex')),
    ]
    expect(answerOf('fx5-enet')).toEqual([subheader, 0x56])
    expect(answerOf('iq-f')).toEqual([subheader, 0x00])
  })
})
