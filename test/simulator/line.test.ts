/** A simulated serial line in memory: what each station answers, and when none does. */
import { describe, expect, test } from '@jest/globals'
import { createLineSimulator } from '../../src/simulator/line'
import { demoPlantTags, startDemoPlant } from '../../src/simulator/plant'
import { aLine, frameFormats, shown } from './line-support'

const FORMAT_4 = { messageFormat: 4, stations: { 0: {}, 5: {} } } as const

describe('a station', () => {
  test.each([
    ['WR', 'WR0D000002', '<STX>05FF12340000<ETX>7E'],
    ['QR', 'QR0D00000001', '<STX>05FF1234<ETX>BE'],
    ['BR', 'BR0M000003', '<STX>05FF010<ETX>85'],
    ['BW', 'BW0M001001' + '1', '<ACK>05FF'],
    ['WW', 'WW0D010001ABCD', '<ACK>05FF'],
    ['BT', 'BT002M00101M00111', '<ACK>05FF'],
    ['WT', 'WT001D01100001', '<ACK>05FF'],
    ['RS', 'RS0', '<ACK>05FF'],
    ['RR', 'RR0', '<ACK>05FF'],
    ['PC', 'PC0', '<STX>05FFF3<ETX>6D'],
    ['TT', 'TT005ABCDE', '<STX>05FF05ABCDE<ETX>A8'],
  ])('answers %s of 1C', (_name, body, answer) => {
    const { line, host } = aLine({ stations: { 0: {}, 5: {} } })
    line.station(5).write('D0', 0x1234)
    line.station(5).write('M1', true)
    expect(host.ask('1C', 5, body)).toBe(answer)
  })

  test.each(frameFormats)('reads and writes in $frame, format $messageFormat', ({ frame, messageFormat }) => {
    const { line, host } = aLine({ messageFormat, stations: { 3: {} } })
    const [write, read] =
      frame === '1C'
        ? ['WW0D010001ABCD', 'WR0D010001']
        : messageFormat === 5
          ? [Buffer.from('01140000640000a80100cdab', 'hex'), Buffer.from('01040000640000a80100', 'hex')]
          : ['14010000D*0001000001ABCD', '04010000D*0001000001']
    const done = host.ask(frame, 3, write)
    expect(line.station(3).read('D100:WORD')).toBe(0xabcd)
    expect(done).toMatch(messageFormat === 5 ? /<ff><ff><00><00><DLE><ETX>..$/ : /^<ACK>/)
    expect(host.ask(frame, 3, read)).toMatch(messageFormat === 5 ? /<cd><ab>/ : /ABCD<ETX>/)
  })

  test('has memory and a state of its own', () => {
    const { line, host } = aLine(FORMAT_4)
    host.ask('3C', 5, '14010000D*0000000001ABCD')
    host.ask('1C', 5, 'RS0')
    expect([0, 5].map((station) => line.station(station).read('D0:WORD'))).toEqual([0, 0xabcd])
    expect([0, 5].map((station) => line.station(station).cpu.state)).toEqual(['RUN', 'STOP'])
  })

  test('answers to its number alone', () => {
    const { host, line } = aLine(FORMAT_4)
    expect(host.ask('1C', 6, 'PC0')).toBe('')
    expect(line.statistics.requests).toBe(0)
    expect(() => line.station(6)).toThrow(/no station 6 on this line: it has 0, 5/)
  })

  test('of another family answers in the frames that it knows', () => {
    const { host } = aLine({ messageFormat: 4, stations: { 0: {}, 1: { profile: 'fx3-serial' } } })
    expect(host.ask('1C', 1, 'PC0')).toMatch(/^<STX>01FFF3<ETX>/)
    expect(host.ask('3C', 1, '01010000')).toBe('')
    expect(host.ask('3C', 0, '01010000')).toMatch(/FX5U/)
  })

  test('waits before its answer as the request says in 1C, as its parameter says in 3C', () => {
    const { host, clock, request } = aLine({ messageFormat: 4, messageWait: 30 })
    const times = [request('1C', 0, 'PC0'), request('1C', 0, 'PCF'), request('3C', 0, '01010000')].map((bytes) => {
      host.bytes()
      host.send(bytes)
      let ms = 0
      for (; host.bytes().length === 0 && ms < 1000; ms++) clock.advance(1)
      return ms
    })
    expect(times).toEqual([0, 150, 30])
  })

  test('in RUN answers at the end of its scan', () => {
    const { host, clock, request } = aLine({ messageFormat: 4, stations: { 0: { scanTime: 20 } } })
    host.send(request('1C', 0, 'PC1'))
    clock.advance(19)
    expect(host.heard()).toBe('')
    clock.advance(1)
    expect(host.heard()).toMatch(/^<STX>/)
  })

  test('runs the demo plant', () => {
    const { line, host, clock } = aLine(FORMAT_4)
    const plant = startDemoPlant(line.station(5))
    const [level] = demoPlantTags['iq-f'].filter(({ name }) => name === 'level')
    expect(level?.address).toBe('D100:REAL')
    clock.advance(5000)
    expect(Number(line.station(5).read('D100:REAL'))).toBeGreaterThan(0)
    expect(host.ask('1C', 5, 'WR0D010002')).not.toMatch(/FF00000000/)
    expect(line.station(0).read('D100:REAL')).toBe(0)
    plant.stop()
  })

  test('answers nobody while it starts again, and has lost what is not latched then', () => {
    const { line, host, clock } = aLine({ messageFormat: 4, stations: { 0: { restartTime: 1000 } } })
    line.station(0).write('D0', 1)
    const told: string[] = []
    line.station(0).on('restart', () => told.push('restart'))
    line.station(0).restart()
    expect(host.ask('1C', 0, 'PC0')).toBe('')
    clock.advance(1000)
    expect([host.ask('1C', 0, 'WR0D000001'), told]).toEqual(['<STX>00FF0000<ETX>AF<CR><LF>', ['restart']])
  })
})

describe('the global signal', () => {
  test('goes to one station, which answers', () => {
    const { line, host } = aLine(FORMAT_4)
    expect(host.ask('1C', 5, 'GW01')).toBe('<ACK>05FF<CR><LF>')
    expect([0, 5].map((station) => line.station(station).read('SM8680'))).toEqual([false, true])
  })

  test('goes to all, and nobody answers', () => {
    const { line, host } = aLine({ ...FORMAT_4, stations: { 0: { channel: 3 }, 5: {}, 6: { profile: 'fx3-serial' } } })
    expect(host.ask('1C', 0xff, 'GW01')).toBe('')
    expect(line.station(0).read('SM8700')).toBe(true)
    expect(line.station(5).read('SM8680')).toBe(true)
    expect(line.station(6).read('SM8126')).toBe(true)
    expect(host.ask('1C', 0xff, 'GW00')).toBe('')
    expect(line.station(5).read('SM8680')).toBe(false)
  })

  test('is the only command for all', () => {
    const { line, host } = aLine(FORMAT_4)
    expect(host.ask('1C', 0xff, 'RS0')).toBe('')
    expect([0, 5].map((station) => line.station(station).cpu.state)).toEqual(['RUN', 'RUN'])
  })
})

describe('a request that cannot be carried out', () => {
  test.each([
    ['unknown command', '1C', 'XX0', '03'],
    ['message wait', '1C', 'WRGD000001', '03'],
    ['device', '1C', 'WR0Z000001', '06'],
    ['number', '1C', 'WR0D999901', '06'],
    ['digits of a number', '1C', 'WR0D00X001', '06'],
    ['points', '1C', 'WR0D000041', '06'],
    ['head of a bit device', '1C', 'WR0M000102', '06'],
    ['points of BT', '1C', `BT0${'15'}${'M00001'.repeat(21)}`, '06'],
    ['data', '1C', 'WW0D000001ABCX', '07'],
    ['unknown command', '3C', '09990000D*0000000001', '7E40'],
    ['unknown subcommand', '3C', '04010077D*0000000001', '7E40'],
    ['device', '3C', '04010000??0000000001', '7E43'],
    ['number', '3C', '04010000D*9999990001', '7143'],
    ['points', '3C', '04010000D*0000001000', '7E42'],
    ['random points', '3C', `04030000FF00${'D*000000'.repeat(255)}`, '7E41'],
    ['digits', '3C', '04010000D*00000000ZZ', '7F21'],
    ['password', '3C', '1630000000041234', '7E40'],
  ] as const)('%s in %s: NAK', (_what, frame, body, code) => {
    for (const messageFormat of [1, 4] as const) {
      for (const sumCheck of [true, false]) {
        const { host } = aLine({ messageFormat, sumCheck })
        const route = frame === '1C' ? '00FF' : 'F90000FF00'
        const end = messageFormat === 4 ? '<CR><LF>' : ''
        expect(host.ask(frame, 0, body)).toBe(`<NAK>${route}${code}${end}`)
      }
    }
  })

  test('PC number: NAK 10 in 1C', () => {
    const { host } = aLine()
    expect(host.ask('1C', 0, 'WR0D000001', { pc: 1 })).toBe('<NAK>000110')
  })

  test('a route to another module: an error code, or silence where the line is set so', () => {
    const refusing = aLine()
    expect(refusing.host.ask('3C', 0, '04010000D*0000000001', { network: 1 })).toBe('<NAK>F90001FF007164')
    const silent = aLine({ stations: { 0: { otherStations: 'silence' } } })
    expect(silent.host.ask('3C', 0, '04010000D*0000000001', { network: 1 })).toBe('')
  })

  test('format 5: the error code stands behind the response ID, with error information where the line is set so', () => {
    const body = Buffer.from('99090000640000a80100', 'hex')
    const plain = aLine({ messageFormat: 5 })
    expect(plain.host.ask('4C', 0, body)).toBe(
      '<DLE><STX><CL><00><f8><00><00><ff><ff><ETX><00><00><ff><ff>@~<DLE><ETX>C1',
    )
    const informed = aLine({ messageFormat: 5, serialFrame: { errorInformation: true } })
    expect(informed.host.ask('4C', 0, body).length).toBeGreaterThan(plain.host.ask('4C', 0, body).length)
  })

  test('remote STOP of another keeps the CPU: NAK 18', () => {
    const { line, host } = aLine()
    line.station(0).cpu.stop('GX Works3')
    expect(host.ask('1C', 0, 'RR0')).toBe('<NAK>00FF18')
  })
})

describe('a damaged request', () => {
  test.each([
    ['1C', 4, '02'],
    ['3C', 4, '7F24'],
    ['4C', 1, '7F24'],
  ] as const)('%s, format %d: a wrong sum is told by NAK at once', (frame, messageFormat, code) => {
    const { line, host, request } = aLine({ messageFormat })
    const bytes = request(frame, 0, frame === '1C' ? 'WW0D000001ABCD' : '14010000D*0000000001ABCD')
    const at = bytes.indexOf('ABCD')
    bytes[at] = (bytes[at] ?? 0) ^ 3
    host.send(bytes)
    expect(host.heard()).toMatch(new RegExp(`^<NAK>.*${code}(<CR><LF>)?$`))
    expect([line.station(0).read('D0'), line.station(0).errors.led]).toEqual([0, true])
  })

  test('format 5: a wrong sum', () => {
    const { host, request } = aLine({ messageFormat: 5 })
    const bytes = request('4C', 0, Buffer.from('01040000100000a80100', 'hex'))
    bytes.write('00', bytes.length - 2)
    host.send(bytes)
    expect(host.heard()).toMatch(/<ff><ff>\$<7f><DLE><ETX>..$/)
  })

  test.each([
    ['1C', 1, ''],
    ['3C', 1, '<NAK>F90000FF007F40'],
    ['3C', 4, '<NAK>F90000FF007F40<CR><LF>'],
  ] as const)(
    '%s, format %d: one that breaks off ends after the reception time-out',
    (frame, messageFormat, answer) => {
      const { host, clock, request } = aLine({ messageFormat, timeout: 50 })
      host.send(request(frame, 0, frame === '1C' ? 'WR0D000001' : '04010000D*0000000001').subarray(0, -3))
      clock.advance(49)
      expect(host.heard()).toBe('')
      clock.advance(1)
      expect(host.heard()).toBe(answer)
      expect(host.ask('1C', 0, 'PC0')).toMatch(/^<STX>/)
    },
  )

  test('is told by special devices of the channel, until the CPU goes to RUN again', () => {
    const { line, host } = aLine({ messageFormat: 4, stations: { 0: { channel: 2 } } })
    const told = () => ['SM8513', 'SM8510', 'SD8510:WORD'].map((item) => line.station(0).read(item))
    expect(told()).toEqual([true, false, 0])
    host.ask('3C', 0, '09990000')
    expect(told()).toEqual([true, true, 0x7e40])
    host.ask('1C', 0, 'RS0')
    host.ask('1C', 0, 'RR0')
    expect(told()).toEqual([true, false, 0])
  })

  test('where NAK has two digits in 3C, too, they are the last ones of the code', () => {
    const { host } = aLine({ serialFrame: { errorDigits: 2 } })
    expect(host.ask('3C', 0, '09990000')).toBe('<NAK>F90000FF0040')
    const four = aLine({ serialFrame: { errorDigits: 4 } })
    expect(four.host.ask('1C', 0, 'XX0')).toBe('<NAK>00FF0003')
  })

  test('another start code begins anew, and nobody answers what went before', () => {
    const { host, request } = aLine()
    host.send(Buffer.concat([request('1C', 0, 'WR0D000001').subarray(0, 9), request('1C', 0, 'PC0')]))
    expect(host.heard()).toBe('<STX>00FFF3<ETX>68')
  })

  test('another form than the line has is a wrong end', () => {
    const four = aLine({ messageFormat: 4 })
    four.host.send('<ENQ>00FFPC0<CR>x')
    four.clock.advance(100)
    expect(four.host.heard()).toBe('<NAK>00FF03<CR><LF>')
    const { host, clock } = aLine({ messageFormat: 1, sumCheck: false })
    host.send('<ENQ>F90000FF0001010000FF')
    clock.advance(100)
    expect(host.heard()).toBe('<NAK>F90000FF007F23')
  })

  test('in format 1 what cannot be measured ends when nothing more comes, and is answered', () => {
    const { host, clock } = aLine({ sumCheck: false, timeout: 40 })
    host.send('<ENQ>00FFZZ0')
    clock.advance(39)
    host.send('12')
    clock.advance(39)
    expect(host.heard()).toBe('')
    clock.advance(1)
    expect(host.heard()).toBe('<NAK>00FF03')
  })
})

describe('EOT and CL', () => {
  test.each(['EOT', 'CL'])('%s: what was asked is not answered any more, a write is done', (code) => {
    for (const messageFormat of [1, 4] as const) {
      const { line, host, clock, request } = aLine({ messageFormat })
      host.send(request('1C', 0, 'WWFD000001ABCD'))
      host.send(messageFormat === 4 ? `<${code}><CR><LF>` : `<${code}>`)
      clock.advance(1000)
      expect([host.heard(), line.station(0).read('D0:WORD')]).toEqual(['', 0])
      expect(host.ask('1C', 0, 'PC0')).toMatch(/^<STX>/)
    }
  })

  test('also within a request', () => {
    const { host, clock, request } = aLine()
    host.send('<ENQ>00FFWR0')
    host.send('<EOT>')
    clock.advance(1000)
    expect(host.heard()).toBe('')
    host.send(request('1C', 0, 'PC0'))
    expect(host.heard()).toMatch(/^<STX>/)
  })
})

describe('the line', () => {
  test('is heard by all hosts, and echoes where it has one pair', () => {
    const { host, another, request } = aLine({ echo: true })
    const other = another()
    const bytes = request('1C', 0, 'PC0')
    host.send(bytes)
    const all = `${shown(bytes)}<STX>00FFF3<ETX>68`
    expect([host.heard(), other.heard()]).toEqual([all, all])
  })

  test('says who is at it', () => {
    const { line, host } = aLine()
    const told: string[] = []
    line.on('host', ({ change, host: { id } }) => told.push(`${id} ${change}`))
    expect(line.hosts).toEqual([{ id: 1, remote: 'memory:1' }])
    host.close()
    expect([line.hosts, told]).toEqual([[], ['1 closed']])
  })

  test('tells of requests with station and frame', () => {
    const { line, host } = aLine(FORMAT_4)
    const told: unknown[] = []
    line.on('request', ({ station, frame, command, endCode }) => told.push([station, frame, command, endCode]))
    line.station(5).on('write', ({ command }) => told.push(command))
    host.ask('3C', 5, '14010000D*0000000001ABCD')
    host.ask('1C', 0, 'XX0')
    expect(told).toEqual(['writeWords', [5, '3C', 'writeWords', 0], [0, '1C', undefined, 3]])
  })

  test('takes the time of its characters in both directions', () => {
    const { host, clock, request } = aLine({ pace: { baudRate: 9600, dataLength: 7, parity: 'odd', stopBits: 1 } })
    const bytes = request('1C', 0, 'WR0D000001')
    host.send(bytes)
    const character = (10 * 1000) / 9600
    const answer = '<STX>00FF0000<ETX>AF'.replace(/<\w+>/g, '.').length
    const [first, all] = [bytes.length + 1, bytes.length + answer].map((count) => count * character)
    clock.advance((first ?? 0) - 0.01)
    expect(host.heard()).toBe('')
    clock.advance(0.02)
    expect(host.heard()).toBe('<STX>')
    clock.advance((all ?? 0) - (first ?? 0) - 0.02)
    expect(host.heard()).toBe('00FF0000<ETX>A')
    clock.advance(0.02)
    expect(host.heard()).toBe('F')
  })

  test('can be disturbed from outside', () => {
    const { line, host } = aLine()
    line.noise(Buffer.from([0xff, 0x02]))
    expect(host.heard()).toBe('<ff><STX>')
  })

  test('lets nothing go on after its end', async () => {
    const { line, host, clock, request } = aLine({ pace: true })
    host.send(request('1C', 0, 'PCF'))
    await line.close()
    expect(clock.pending).toBe(0)
    expect(() => line.connect()).toThrow(/closed/)
  })
})

describe('options', () => {
  test.each([
    ['messageFormat', { messageFormat: 2 }],
    ['frames', { frames: ['2C'] }],
    ['frames', { messageFormat: 5, frames: ['1C'] }],
    ['stations', { stations: {} }],
    ['stations.x', { stations: { x: {} } }],
    ['stations.16', { stations: { 16: {} } }],
    ['stations.0.speed', { stations: { 0: { speed: 1 } } }],
    ['stations.0.channel', { stations: { 0: { channel: 5 } } }],
    ['stations.0.profile', { stations: { 0: { profile: 'iq-f' } } }],
    ['serialFrame.sum', { serialFrame: { sum: true } }],
    ['serialFrame.errorDigits', { serialFrame: { errorDigits: 3 } }],
    ['messageWait', { messageWait: 15 }],
    ['messageWait', { messageWait: 160 }],
    ['timeout', { timeout: 0 }],
    ['echo', { echo: 'yes' }],
    ['sumCheck', { sumCheck: 1 }],
    ['baudRate', { pace: { baudRate: 1 } }],
    ['pace.dataLength', { pace: { dataLength: 7 }, messageFormat: 5 }],
    ['serial.dataLength', { serial: { path: 'COM1', dataLength: 7 }, messageFormat: 5 }],
    ['speed', { speed: 9600 }],
  ])('%s is refused', (field, options) => {
    // What a JavaScript program could give.
    expect(() => createLineSimulator(options as never)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field }))
  })
})
