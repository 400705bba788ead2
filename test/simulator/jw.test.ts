import { describe, expect, test } from '@jest/globals'
import * as fc from 'fast-check'
import type { JwCommandName, JwCommands } from '../../src/jw/commands/commands'
import { jwFrame } from '../../src/jw/frame'
import type { NamedCommand } from '../../src/link/link'
import {
  createJwSimulator,
  faultKinds,
  type JwFaultAction,
  type JwRequestEvent,
  type JwSimulatorOptions,
} from '../../src/simulator/simulator'
import { tcpTransport } from '../../src/transport/tcp'
import { udpTransport } from '../../src/transport/udp'
import { type FrameVector, vectorsOfKind } from '../vectors/vectors'
import { exchanged, JwAsker, joinJw, jwCommands } from './jw-support'

const bytes = (text: string) => Buffer.from(text.replaceAll(' ', ''), 'hex')
const READ_09012 = bytes('47 00 24 00 0A 08 02 00')
const ANSWER = bytes('45 00 24 00 00 0A 08 02 00 05 00')
const ZERO40 = '00'.repeat(40)

describe('a simulated JW is reached', () => {
  test.each(['tcp', 'udp', 'memory'] as const)('over %s', async (protocol) => {
    const plc = createJwSimulator({ writeMode: 1 })
    await plc.listen()
    plc.write('09012', 5)
    const { tcp, udp } = plc
    if (tcp === undefined || udp === undefined) throw new Error('it does not listen')
    const open = { tcp: tcpTransport(tcp), udp: udpTransport(udp), memory: plc.connect() }[protocol]
    expect(await exchanged(open, READ_09012, ANSWER.length)).toEqual(ANSWER)
    const write = bytes('47 00 34 00 0A 08 02 00 06 01')
    const again = { tcp: tcpTransport(tcp), udp: udpTransport(udp), memory: plc.connect() }[protocol]
    expect(await exchanged(again, write, 9)).toEqual(bytes('45 00 34 00 00 0A 08 02 00'))
    expect(plc.read('09012:INT')).toBe(0x106)
    await plc.close()
    expect([plc.tcp, plc.udp, plc.connections]).toEqual([undefined, undefined, []])
  })

  test('byte by byte over a stream, several requests at once, and one datagram for each', () => {
    const { plc, asker } = joinJw()
    plc.write('09012', 5)
    for (const byte of READ_09012.subarray(0, -1)) expect(asker.raw(Buffer.of(byte))).toHaveLength(0)
    expect(asker.raw(READ_09012.subarray(-1))).toEqual(ANSWER)
    expect(asker.raw(Buffer.concat([READ_09012, READ_09012]))).toEqual(Buffer.concat([ANSWER, ANSWER]))
    const datagrams = new JwAsker(plc, {}, { kind: 'datagram' })
    expect(datagrams.raw(READ_09012)).toEqual(ANSWER)
    // One message is one datagram: too short and too long are format errors.
    expect(datagrams.hex('47 00 24 00 0A 08 02')).toBe('45002401')
    expect(datagrams.raw(Buffer.concat([READ_09012, READ_09012])).toString('hex')).toBe('45002401')
  })
})

/** What makes a simulated JW answer as the manual prints it. */
const prepared: Readonly<Record<string, (joined: ReturnType<typeof joinJw>) => void>> = {
  readDataMemory: ({ plc }) => plc.write('09000:UDINT', 0x01324f00),
  monitorRelay: ({ plc }) => plc.write('004033', true),
  monitorTimersCounters({ plc }) {
    plc.write('TMR0000:WORD', 0x9234)
    plc.write('TMR0001:WORD', 0xd678)
  },
  writeSystemMemory: ({ plc }) => plc.cpu.stop(),
  readDate: ({ asker }) => void asker.ask(jwCommands.setDate, { year: 96, month: 4, day: 25, dayOfWeek: 3 }),
}

const isData = (name: string, value: unknown) => ['data', 'attributes'].includes(name) && Array.isArray(value)
const messageOf = (message: FrameVector['message']) =>
  Object.fromEntries(
    Object.entries(message ?? {}).map(([name, value]) => [
      name,
      isData(name, value) ? Buffer.from(value as number[]) : value,
    ]),
  )
const commandOf = (name: string): NamedCommand => jwCommands[name as keyof JwCommands]

describe('it answers', () => {
  const printed = vectorsOfKind('jw-printed', 'frame').filter(({ side }) => side === 'response')
  test.each(printed)('$id byte for byte as the manual prints it', ({ command, request, header, hex }) => {
    const joined = joinJw(
      { timers: { TMR0000: {}, TMR0001: { direction: 'up' } } },
      header === undefined ? {} : { header: 'zero40' },
    )
    prepared[command]?.(joined)
    const { asker } = joined
    const asked = asker.protocol.exchange(commandOf(command), messageOf(request)).write(0)
    expect(asker.raw(asked).toString('hex')).toBe(hex)
  })

  const requests = vectorsOfKind('jw', 'frame').filter(({ side }) => side === 'request')
  test.each(requests)('$id by a message that its client takes', ({ command, message, marker, hex }) => {
    const model = command === 'setMemorySize' ? 'jw30h' : 'jw300'
    const options = marker === undefined ? ({ model } as const) : ({ model, marker } as const)
    const { plc, asker } = joinJw(options, options)
    plc.cpu.stop()
    const answer = asker.raw(bytes(hex))
    const exchange = asker.protocol.exchange(commandOf(command), messageOf(message))
    const scanned = jwFrame().response.scan(answer, exchange.responseLength)
    expect(scanned?.used).toBe(answer.length)
    // What is not there in this PLC: timers that run, buffers, a password.
    expect([0, 0x13, 0x30, 0x40, 0x48]).toContain(scanned?.frame.endCode)
  })

  const negatives = vectorsOfKind('jw', 'refused')
  test.each(negatives)('$id by a refusal', ({ hex }) => {
    const { plc } = joinJw()
    // Over a stream 80H ends where what has arrived ends, after 1024 bytes at the latest.
    const answer = new JwAsker(plc, {}, { kind: 'datagram' }).raw(bytes(hex))
    expect(answer).toHaveLength(4)
    expect([0x01, 0x08, 0x32]).toContain(answer[3])
    expect(plc.statistics).toMatchObject({ requests: 1, refusals: 1 })
  })
})

describe('what stands in front of a message', () => {
  const relay = { pda: 1, psa: 2, slot: 3, station: 4 } as const
  const RELAY = `00 00 00 00 01 02 60 03 04 40${'00'.repeat(30)}`
  const TURNED = `${'00 00 00 00 02 01 60 03 04 40'.replaceAll(' ', '')}${'00'.repeat(30)}`
  const E9 = '47 00 E9'
  const OK = '4500E90002'

  test.each([
    ['any', '', OK],
    ['any', ZERO40, ZERO40 + OK],
    ['any', RELAY, TURNED + OK],
    ['none', '', OK],
    ['none', ZERO40, ''],
    ['zero40', ZERO40, ZERO40 + OK],
    ['zero40', '', ''],
    ['zero40', RELAY, ''],
    [relay, RELAY, TURNED + OK],
    [relay, ZERO40, ''],
    [bytes('01 02 03'), '01 02 03', `010203${OK}`],
    [bytes('01 02 03'), '01 02 04', ''],
    [bytes('01 02 03'), '', ''],
  ] as const)('header %p, asked with %p', (header, front, answer) => {
    const { plc, asker } = joinJw({ header })
    const events: JwRequestEvent[] = []
    plc.on('request', (event) => events.push(event))
    expect(asker.hex(front + E9)).toBe(answer)
    expect(plc.statistics).toMatchObject({ requests: answer === '' ? 0 : 1, unreadable: answer === '' ? 1 : 0 })
    if (header === 'any')
      expect(events).toMatchObject([{ header: bytes(front).length, command: 'readWriteMode', endCode: 0 }])
  })
})

describe('faults', () => {
  const withFault = (
    fault: JwFaultAction & { readonly times?: number; readonly commands?: readonly JwCommandName[] },
  ) => {
    const joined = joinJw()
    joined.plc.write('09012', 5)
    joined.plc.faults.add(fault)
    const ask = () => joined.asker.raw(READ_09012).toString('hex').toUpperCase()
    return { ...joined, ask }
  }
  const whole = ANSWER.toString('hex').toUpperCase()

  test.each([
    [{ kind: 'silence' }, ''],
    [{ kind: 'drop' }, ''],
    [{ kind: 'late' }, ''],
    [{ kind: 'merge' }, ''],
    [{ kind: 'duplicate' }, whole + whole],
    [{ kind: 'cut', at: 5 }, whole.slice(0, 10)],
    [{ kind: 'split', at: 5, pause: 0 }, whole],
    [{ kind: 'dribble', pause: 0 }, whole],
    [{ kind: 'garbage', bytes: 4 }, `FF00A55A${whole}`],
    [{ kind: 'endCode', endCode: 0x0f }, '4500240F'],
    [{ kind: 'damaged', at: 2, mask: 0x10 }, whole.replace('450024', '450034')],
    [{ kind: 'otherHeader' }, ZERO40 + whole],
  ] as const satisfies readonly (readonly [JwFaultAction, string])[])('%o', (fault, heard) => {
    expect(withFault(fault).ask()).toBe(heard)
  })

  test('otherHeader takes the header away where there is one', () => {
    const { asker } = withFault({ kind: 'otherHeader' })
    expect(asker.hex(ZERO40 + READ_09012.toString('hex'))).toBe(whole)
  })

  test('late: the answer comes with the next request', () => {
    const { ask } = withFault({ kind: 'late', times: 1 })
    expect([ask(), ask()]).toEqual(['', whole + whole])
  })

  test('delay, noise and scanTime take their time', () => {
    const { plc, asker, clock, ask } = withFault({ kind: 'delay', ms: 50, times: 1 })
    expect(ask()).toBe('')
    clock.advance(49)
    expect(asker.received).toEqual([])
    clock.advance(1)
    expect(Buffer.concat(asker.received)).toEqual(ANSWER)
    plc.faults.add({ kind: 'noise', ms: 5, bytes: 3, times: 1 })
    expect(ask()).toBe(whole)
    clock.advance(5)
    expect(Buffer.concat(asker.received)).toHaveLength(ANSWER.length + 3)
  })

  test('scanTime counts while the PLC runs', () => {
    const { plc, asker, clock } = joinJw({ scanTime: 20 })
    expect(asker.raw(READ_09012)).toHaveLength(0)
    clock.advance(20)
    expect(asker.received).toHaveLength(1)
    plc.cpu.stop()
    expect(asker.raw(READ_09012)).toHaveLength(ANSWER.length)
  })

  test('coalesce: of requests that arrive together the last is answered', () => {
    const { asker, clock, plc } = withFault({ kind: 'coalesce', window: 5 })
    asker.raw(Buffer.concat([bytes('47 00 E9'), READ_09012]))
    clock.advance(5)
    expect(Buffer.concat(asker.received)).toEqual(ANSWER)
    expect(plc.statistics.discarded).toBe(1)
  })

  test('disconnect and closeOnAccept end connections', () => {
    const { plc, asker, clock, ask } = withFault({ kind: 'disconnect', at: 4 })
    expect(ask()).toBe('45002400')
    clock.advance(10)
    expect(asker.closed).toBe(true)
    plc.faults.add({ kind: 'closeOnAccept' })
    expect(new JwAsker(plc).closed).toBe(true)
  })

  test('the tests above are of every kind that a JW has', () => {
    const absent = ['wrongSerial', 'wrongRoute', 'shortError', 'misheard', 'wrongSum']
    const { plc } = joinJw()
    const usual: Readonly<Record<string, object>> = {
      delay: { ms: 1 },
      split: { at: 1 },
      cut: { at: 1 },
      endCode: { endCode: 1 },
    }
    for (const kind of Object.keys(faultKinds)) {
      const add = () => plc.faults.add({ kind, ...usual[kind] } as JwFaultAction)
      if (absent.includes(kind)) expect(add).toThrow(`There is no fault "${kind}"`)
      else expect(add).not.toThrow()
    }
    expect(() => plc.faults.add({ kind: 'endCode', endCode: 0x100 })).toThrow('from 1 to 255')
    expect(() => plc.faults.add({ kind: 'silence', commands: ['readWords' as JwCommandName] })).toThrow(
      'no command readWords',
    )
  })

  test('commands: only those', () => {
    const { asker, ask } = withFault({ kind: 'silence', commands: ['readWriteMode'] })
    expect([ask(), asker.hex('47 00 E9')]).toEqual([whole, ''])
  })
})

describe('it tells', () => {
  test('requests with their outcome, writes that were carried out, who comes and goes; no passwords', () => {
    const { plc, asker } = joinJw({ writeMode: 0 })
    const told: string[] = []
    plc.on('request', ({ command, endCode, message }) =>
      told.push(`${command} ${endCode} ${JSON.stringify(message?.password)}`),
    )
    plc.on('write', ({ command }) => told.push(`write ${command}`))
    plc.on('connection', ({ change }) => told.push(change))
    const other = new JwAsker(plc)
    asker.hex('47 00 30 00 00 00 00 01')
    plc.cpu.writeMode = 1
    asker.hex('47 00 30 00 00 00 00 01')
    other.hex('47 00 FC 00 41 62 31 32')
    other.hex('47 00 FF')
    expect(told).toEqual([
      'opened',
      'setRelay 16 undefined',
      'write setRelay',
      'setRelay 0 undefined',
      'secretPassword 48 "********"',
      'undefined 1 undefined',
    ])
    expect(plc.statistics).toMatchObject({
      connections: 2,
      requests: 4,
      answers: 4,
      refusals: 3,
      bytesReceived: 27,
      bytesSent: 20,
    })
    expect(plc.connections.map(({ id, requests }) => [id, requests])).toEqual([
      [1, 2],
      [2, 2],
    ])
  })

  test('that there is no room for another connection', () => {
    const { plc } = joinJw({ maxConnections: 1 })
    const told: string[] = []
    plc.on('connection', ({ change }) => told.push(change))
    expect([new JwAsker(plc).closed, told, plc.statistics.turnedAway]).toEqual([true, ['turnedAway'], 1])
    // Datagrams take no entry.
    expect(new JwAsker(plc, {}, { kind: 'datagram' }).hex('47 00 E9')).toBe('4500E90002')
  })

  test('restarts: everybody is disconnected, memory is kept, what clients have set is as at the beginning', () => {
    const { plc, asker, clock } = joinJw({ writeMode: 1, restartTime: 100 })
    plc.write('09012', 5)
    asker.hex('47 00 F8 01')
    asker.hex('47 00 F9 02')
    asker.hex('47 00 F4 00 00 01')
    plc.restart()
    expect([asker.closed, new JwAsker(plc).closed]).toEqual([true, true])
    clock.advance(100)
    expect([plc.cpu.state, plc.cpu.writeMode, plc.cpu.stoppedBlocks, plc.read('09012')]).toEqual(['RUN', 1, [], 5])
    expect(new JwAsker(plc).hex('47 00 E9')).toBe('4500E90001')
  })
})

describe('the program reads and writes', () => {
  const { plc } = joinJw({
    timers: { TMR0000: {}, CNT10000: { coding: 'binary' } },
    areas: [{ first: '016000', last: '017777', file: 0, address: 0o20000 }],
  })

  test.each([
    ['004033', true],
    ['09012.3', true],
    ['09012', 255],
    ['09012:INT', -2],
    ['09013:REAL', 1.5],
    ['09012:STRING(5)', 'hello'],
    ['99776:BCD16', 9876],
    ['b0012:WORD', 0x9234],
    ['TMR0000', 7999],
    ['TMR0000:WORD', 0x9234],
    ['CNT10000', 32_767],
    ['#2177', 1],
    ['#0001.7', true],
    ['016000', true],
    ['F80:177777', 3],
    ['F1:00177775:LREAL', -0.5],
  ] as const)('%s', (item, value) => {
    plc.write(item, value)
    expect(plc.read(item)).toBe(value)
  })

  test.each([
    ['04083', 1, 'BAD_ADDRESS'],
    ['E0000', 1, 'OUT_OF_RANGE'],
    ['004033', 1, 'BAD_VALUE'],
    ['004033:INT', 1, 'BAD_TYPE'],
    ['09012:BOOL', true, 'BAD_TYPE'],
    ['09012', 256, 'BAD_VALUE'],
    ['TMR0000:REAL', 1, 'BAD_TYPE'],
    ['TMR0000', 8000, 'BAD_VALUE'],
    ['TMR0001', 1, 'BAD_VALUE'],
    ['#2177:INT', 1, 'OUT_OF_RANGE'],
    ['F2:177777:INT', 1, 'OUT_OF_RANGE'],
  ] as const)('%s = %p: %s', (item, value, code) => {
    const small = joinJw({ files: { 0: 0x10000, 1: 0x10000, 2: 0x10000 }, timers: { TMR0000: {} } }).plc
    expect(() => small.write(item, value)).toThrow(expect.objectContaining({ code }))
  })

  test('a timer is no counter, as the client sees it too', () => {
    expect(() => plc.read('CNT0000')).toThrow('is DTMR (BCD), not CNT')
  })

  test('ring buffers that are not defined, or full, are said', () => {
    const ring = joinJw({ ringBuffers: { 0: { file: 1, address: 0, length: 4 } } }).plc.ringBuffers
    expect(() => ring.put(1, Buffer.of(1))).toThrow('ring buffer 1 is not defined')
    expect(() => ring.put(0, Buffer.of(1, 2, 3, 4))).toThrow('ring buffer 0 has 4 bytes')
    ring.put(0, Buffer.of(1, 2, 3))
    expect(() => ring.put(0, Buffer.of(4))).toThrow('has room for 0')
    expect(ring.take(0, 9)).toEqual(Buffer.of(1, 2, 3))
  })
})

describe('option units', () => {
  test('DL9 with the worked example of the manual starts, and with bytes that leave the area has error 70H', () => {
    const { plc, asker } = joinJw({
      optionUnits: [
        { rack: 0, unit: 0, kind: 'dl9', unitNumber: 4 },
        { rack: 0, unit: 1, kind: 'jw-22su' },
      ],
    })
    const write = (unit: number, address: number, data: Buffer) =>
      asker.code(jwCommands.writeOptionParameters, { rack: 0, unit, address, data })
    expect([write(0, 0o1100, Buffer.of(65, 0)), write(0, 0o3777, Buffer.of(1))]).toEqual([0, 0])
    expect(plc.optionUnit(0, 0)).toMatchObject({ started: false, error: 0x70 })
    expect([
      write(0, 0o3777, Buffer.of(0)),
      write(0, 0o1100, Buffer.of(64, 0)),
      write(0, 0o3777, Buffer.of(1)),
    ]).toEqual([0, 0, 0])
    expect(plc.optionUnit(0, 0)).toMatchObject({ started: true, error: undefined })
    expect([write(1, 0o42, Buffer.of(1)), write(1, 0o3777, Buffer.of(1))]).toEqual([0, 0])
    expect(plc.optionUnit(0, 1)).toMatchObject({ started: false, error: 0x3c })
  })
})

describe('options that cannot be are refused', () => {
  test.each([
    [{ files: { 129: 1 } }, 'files.129'],
    [{ files: { 0: 0x10001 } }, 'files.0'],
    [{ timers: { '09012': {} } }, 'timers.09012'],
    [{ timers: { TMR0000: {}, CNT0000: {} } }, 'timers.CNT0000'],
    [{ timers: { TMR0000: { preset: 8000 } } }, 'timers.TMR0000.preset'],
    [{ writeMode: 3 }, 'writeMode'],
    [{ password: 'Ab1' }, 'password'],
    [{ header: bytes('47') }, 'header'],
    [{ memorySize: 16 }, 'memorySize'],
    [{ ringBuffers: { 16: { file: 0, address: 0, length: 4 } } }, 'ringBuffers.16'],
    [
      { specifiedBuffers: { 0: { file: 0, address: 0, length: 4, direction: 'read' } } },
      'specifiedBuffers.0.direction',
    ],
    [{ optionUnits: [{ rack: 8, unit: 0 }] }, 'optionUnits.0.rack'],
    [
      {
        optionUnits: [
          { rack: 0, unit: 0 },
          { rack: 0, unit: 0 },
        ],
      },
      'optionUnits.1',
    ],
    [{ optionUnits: [{ rack: 0, unit: 0, kind: 'dl9', unitNumber: 6 }] }, 'optionUnits.0.unitNumber'],
    [{ areas: [{ first: '016000', last: '09000', file: 0, address: 0 }] }, 'areas'],
    [{ scantime: 5 }, 'scantime'],
  ])('%o', (options, field) => {
    expect(() => createJwSimulator(options as JwSimulatorOptions)).toThrow(
      expect.objectContaining({ code: 'BAD_OPTION', field }),
    )
  })
})

test('any bytes are answered by messages or by silence, and it lives on', () => {
  const codes = Object.values(jwCommands).map(({ code }) => code)
  const some = (max: number) => fc.uint8Array({ maxLength: max }).map((array) => Buffer.from(array))
  const small = fc.array(fc.nat(3), { maxLength: 20 }).map((array) => Buffer.from(array))
  const message = fc
    .tuple(fc.constantFrom('', ZERO40), fc.constantFrom(...codes), fc.oneof(some(30), small))
    .map(([front, code, text]) => Buffer.concat([bytes(front), Buffer.of(0x47, 0, code), text]))
  void fc.assert(
    fc.property(fc.array(fc.oneof(message, some(60)), { maxLength: 8 }), (chunks) => {
      for (const kind of ['stream', 'datagram'] as const) {
        const { plc } = joinJw({ ringBuffers: { 0: { file: 0, address: 0, length: 4 } } })
        const asker = new JwAsker(plc, {}, { kind })
        for (const chunk of chunks) if (chunk.length > 0) asker.raw(chunk)
        expect(new JwAsker(plc).hex('47 00 FD')).toMatch(/^4500FD00/)
      }
    }),
    { numRuns: 300 },
  )
})

test('a client that never ends its message costs bounded memory', () => {
  const { plc, asker } = joinJw()
  asker.send(bytes('47 00 34 00 00 00 00 04'))
  for (let i = 0; i < 200; i++) asker.send(Buffer.alloc(1000, 0x47))
  // The first write has its 1024 bytes; what follows is no message and is thrown away.
  expect(plc.statistics).toMatchObject({ requests: 1, refusals: 0 })
  expect(asker.hex('47 00 E9')).toBe('4500E90002')
})
