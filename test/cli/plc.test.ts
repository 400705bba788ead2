/** The commands that talk to a PLC, against a simulated one on the loopback interface. */
import { afterAll, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/entry/simulator'
import { build, type Ended, run, runWith } from './cli'
import { runHere } from './in-process'

let plc: PlcSimulator

beforeAll(async () => {
  build()
  plc = createPlcSimulator({ profile: 'iq-r', resetAllowed: true, restartTime: 0 })
  await plc.listen()
}, 120_000)

afterAll(() => plc.close())

beforeEach(() => {
  plc.faults.clear()
  plc.memory.clear()
  plc.cpu.switch = 'RUN'
})

const peer = (simulator: PlcSimulator = plc) => `--plc=127.0.0.1:${simulator.tcp?.port}`
const at = (...args: readonly string[]) => run(...args, peer(), '--profile', 'iq-r')
const here = (...args: readonly string[]) => runHere([...args, peer(), '--profile', 'iq-r'])

function parsed({ out }: Ended): unknown {
  return JSON.parse(out)
}

/** No error of a PLC is shown as a failure of the program. */
function expectNoStack({ out, err }: Ended): void {
  expect(`${out}${err}`).not.toMatch(/^\s+at /m)
}

/** A simulated PLC with other settings. */
async function other<T>(options: PlcSimulatorOptions, use: (simulator: PlcSimulator) => Promise<T>): Promise<T> {
  const simulator = createPlcSimulator(options)
  await simulator.listen()
  try {
    return await use(simulator)
  } finally {
    await simulator.close()
  }
}

describe('identify', () => {
  test('says model, series, profile and round trip', async () => {
    const { code, out, err } = await at('identify')
    expect([code, err]).toEqual([0, ''])
    expect(out).toMatch(/^PLC +tcp 127\.0\.0\.1:\d+, 4E frame, binary code$/m)
    expect(out).toMatch(/^Model +R08CPU$/m)
    expect(out).toMatch(/^Model code +4801H \(R08CPU\)$/m)
    expect(out).toMatch(/^Series +iQ-R$/m)
    expect(out).toMatch(/^Round trip +\d+\.\d ms$/m)
  })

  test('as JSON', async () => {
    const ended = await at('identify', '--json')
    expect(ended.code).toBe(0)
    expect(parsed(ended)).toMatchObject({ model: 'R08CPU', modelCode: 0x4801, series: 'iQ-R', profile: 'iq-r' })
  })

  test('says which profile fits better', async () => {
    const { out } = await run('identify', peer())
    expect(out).toContain('iq-r (this was asked as generic: use --profile iq-r)')
  })

  test('warns of an inverter that is said to number W in decimal, unless it is asked so', async () => {
    const inverter = createPlcSimulator({ profile: 'generic', model: { name: 'FR-E800-E', code: 0x054f } })
    await inverter.listen()
    inverter.memory.setWord('W', 902, 7)
    const plain = ['--plc', `127.0.0.1:${inverter.tcp?.port}`]
    const warned = await run('identify', ...plain)
    expect([warned.code, warned.err]).toEqual([0, expect.stringMatching(/^Warning: FR-E800-E .*--w-radix 10/)])
    expect(parsed(await run('identify', ...plain, '--json'))).toMatchObject({ warning: { code: 'W_RADIX' } })
    const decimal = [...plain, '--w-radix', '10']
    expect((await run('identify', ...decimal)).err).toBe('')
    expect((await run('read', 'W902', ...decimal)).out).toContain('7')
    expect((await run('read', 'W902', ...plain)).out).not.toContain('7')
    await inverter.close()
  })

  test('a 1E frame tells the code of the CPU and not its name', async () => {
    const fx3 = createPlcSimulator({ profile: 'fx3' })
    await fx3.listen()
    const { out } = await run('identify', '--plc', `127.0.0.1:${fx3.tcp?.port}`, '--profile', 'fx3')
    expect(out).toMatch(/^Model +not told$/m)
    expect(out).toMatch(/^Model code +00F3H/m)
    await fx3.close()
  })

  test('takes a refusal for what it is, an answer', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0xc059, commands: ['readTypeName'] })
    const ended = await at('identify')
    expect(ended.code).toBe(3)
    expect(ended.out).toMatch(/^Model +not told$/m)
    expect(ended.err).toMatch(/The PLC answers.*C059/)
    const asJson = await at('identify', '--json')
    expect(asJson.code).toBe(3)
    expect(parsed(asJson)).toMatchObject({ error: { code: 'END_CODE', endCode: 0xc059 } })
  })

  test.each([
    [
      'UDP',
      { profile: 'iq-r' },
      (simulator: PlcSimulator) => ['--host', '127.0.0.1', '--port', `${simulator.udp?.port}`, '--udp'],
    ],
    ['ASCII code', { profile: 'iq-r', code: 'ascii' }, (simulator: PlcSimulator) => [peer(simulator), '--ascii']],
    [
      'the 3E frame',
      { profile: 'iq-r', frames: ['3E'] },
      (simulator: PlcSimulator) => [peer(simulator), '--frame', '3e'],
    ],
    [
      'the station extension frame, its own station in the extension field',
      { profile: 'iq-r', frames: ['ext'] },
      (simulator: PlcSimulator) => [
        peer(simulator),
        ...['--profile', 'iq-r', '--frame', 'ext', '--station', '124', '--extension-station', '65535'],
      ],
    ],
    ['an iQ-F', { profile: 'iq-f' }, (simulator: PlcSimulator) => [peer(simulator), '--profile', 'IQ-F']],
  ] as const)('over %s', async (_what, options, args) => {
    await other(options as PlcSimulatorOptions, async (simulator) => {
      const { code, err } = await run('identify', ...args(simulator))
      expect([code, err]).toEqual([0, ''])
    })
  })

  test('the PLC may stand in the environment', async () => {
    const env = { MELSEC_JW_PLC: `127.0.0.1:${plc.tcp?.port}` }
    expect((await runWith({ env }, 'identify')).code).toBe(0)
    // Half of it is never taken: the other half would be another PLC's.
    expect((await runWith({ env }, 'identify', '--host', '127.0.0.1')).err).toMatch(/Which port of 127\.0\.0\.1\?/)
  })
})

describe('read', () => {
  beforeEach(() => {
    plc.write('D0', -5)
    plc.write('D100:REAL', 71.3)
    plc.write('D200:LINT', 9007199254740993n)
    plc.write('M3', true)
    plc.write('D300:STRING(20)', 'Apple juice')
  })

  test('shows a line for each item', async () => {
    const { code, out, err } = await at(
      'read',
      'D0',
      'D100:REAL',
      'D200:LINT',
      'M3',
      'D300:STRING(20)',
      'M0..M3',
      'D0.1',
    )
    expect([code, err]).toEqual([0, ''])
    expect(
      out
        .trimEnd()
        .split('\n')
        .map((line) => line.split(/ {2,}/)),
    ).toEqual([
      ['D0', '-5'],
      ['D100:REAL', '71.3'],
      ['D200:LINT', '9007199254740993'],
      ['M3', 'ON'],
      ['D300:STRING(20)', 'Apple juice'],
      ['M0..M3', 'OFF, OFF, OFF, ON'],
      ['D0.1', 'ON'],
    ])
  })

  test('as JSON, 64-bit integers as texts', async () => {
    const ended = await at('read', 'D100:REAL', 'D200:LINT', 'M2[2]', '--json')
    expect(ended.code).toBe(0)
    expect(parsed(ended)).toMatchObject({
      results: [
        { item: 'D100:REAL', ok: true, value: Math.fround(71.3) },
        { item: 'D200:LINT', ok: true, value: '9007199254740993' },
        { item: 'M2[2]', ok: true, value: [false, true] },
      ],
    })
  })

  test('of several items one that fails does not hide the others', async () => {
    const ended = await at('read', 'D0', 'Q7', 'D99999')
    expect(ended.code).toBe(6)
    expect(ended.out).toMatch(/^D0 +-5$/m)
    expect(ended.err).toMatch(/"Q7": there is no device Q/)
    expect(ended.err).toMatch(/D99999.*4031/)
    expectNoStack(ended)
    const asJson = await at('read', 'D0', 'D99999', '--json')
    expect(asJson.code).toBe(6)
    expect(parsed(asJson)).toMatchObject({ results: [{ ok: true }, { ok: false, error: { endCode: 0x4031 } }] })
  })

  test('ends with the code of what went wrong when nothing could be read', async () => {
    expect((await at('read', 'D99999')).code).toBe(3)
    expect((await at('read', 'Q7', 'D100:FOO')).code).toBe(2)
  })

  test('word order and encoding', async () => {
    plc.write('D400:REAL', 1.5, { wordOrder: 'high-first' })
    plc.write('D410:STRING(20)', '緑茶', { encoding: 'shift-jis' })
    expect((await at('read', 'D400:REAL', '--word-order', 'high-first')).out).toMatch(/ 1\.5$/m)
    expect((await at('read', 'D410:STRING(20)', '--encoding', 'shift-jis')).out).toMatch(/ 緑茶$/m)
  })

  test('--trace shows the frames on the error output', async () => {
    const { out, err } = await at('read', 'D0', '--trace')
    expect(out).toMatch(/^D0 +-5$/m)
    expect(err).toMatch(/sent\n4E request, binary code: Read \(word units\), D0, 1 point\n/)
    expect(err).toMatch(/received\n4E response, .*\n(.*\n)*.*D0: -5 \(FFFBH\)/)
  })
})

describe('write', () => {
  test('types the values by their items', async () => {
    const values = [
      'D0=-7',
      'D1:WORD=0xFF00',
      'D2:UINT=H10',
      'D10:LINT=9007199254740993',
      'D20:REAL=1.5e3',
      'M5=on',
      'D30:STRING(10)=a=b c',
      'D40:INT[3]=1, 2,K-3',
      'M8[2]=1,0',
    ]
    const { code, out, err } = await at('write', ...values, '--yes')
    expect([code, err]).toEqual([0, ''])
    expect(out).toMatch(/^D20:REAL += 1500$/m)
    const items = [
      'D0',
      'D1:WORD',
      'D2:UINT',
      'D10:LINT',
      'D20:REAL',
      'M5',
      'D30:STRING(10)',
      'D40',
      'D41',
      'D42',
      'M8',
      'M9',
    ]
    expect(items.map((item) => plc.read(item))).toEqual([
      -7,
      0xff00,
      16,
      9007199254740993n,
      1500,
      true,
      'a=b c',
      1,
      2,
      -3,
      true,
      false,
    ])
  })

  test('as JSON', async () => {
    const ended = await at('write', 'D0=1', '--yes', '--json')
    expect(parsed(ended)).toEqual({ results: [{ item: 'D0', ok: true }] })
  })

  test('refuses without --yes where nobody can be asked, and sends nothing', async () => {
    const ended = await at('write', 'D0=1')
    expect(ended).toMatchObject({ code: 2, out: '' })
    expect(ended.err).toMatch(/Nothing was written.*--yes/)
    expect(plc.read('D0')).toBe(0)
  })

  test.each([
    ['no value', ['D0'], /D0=value/],
    ['a text for a number', ['D0=abc'], /D0 takes a whole number \(INT\).*"abc"/],
    ['too large', ['D0=70000'], /70000.*-32768 to 32767/],
    ['no bit', ['M0=2'], /ON or OFF/],
    ['no real', ['D0:REAL=1,5'], /a number \(REAL\)/],
    ['too few values', ['D0:INT[3]=1,2'], /takes 3 values/],
    ['no device', ['Q0=1'], /there is no device Q/],
    ['a bit of a word, unasked', ['D0.3=1'], /read-?modify-?write/i],
    ['one bad of two', ['D1=1', 'D0=70000'], /70000/],
  ])('%s: refused, and nothing is written', async (_what, args, message) => {
    const ended = await here('write', ...args, '--yes')
    expect(ended.err).toMatch(message)
    expect([2, 6]).toContain(ended.code)
    expectNoStack(ended)
    expect([plc.read('D0'), plc.read('D1'), plc.read('M0')]).toEqual([0, 0, false])
  })

  test('a bit of a word when it is allowed', async () => {
    plc.write('D0', 1)
    expect((await at('write', 'D0.3=1', '--read-modify-write', '--yes')).code).toBe(0)
    expect(plc.read('D0')).toBe(9)
  })

  test('what the PLC refuses', async () => {
    const ended = await at('write', 'D99999=1', '--yes')
    expect(ended.code).toBe(3)
    expect(ended.err).toMatch(/4031/)
    expectNoStack(ended)
  })

  test('what the PLC refuses together: no item is said to be the wrong one', async () => {
    const ended = await at('write', 'D0=1', 'D99999=2', '--yes')
    expect(ended).toMatchObject({ code: 3, out: '' })
    const lines = ended.err.trim().split('\n')
    expect(lines).toEqual([
      'D0: not written: sent together with D99999, and the PLC does not say which it refuses.',
      expect.stringMatching(/: Write Random .* 4031: /),
      'D99999: not written: sent together with D0, and the PLC does not say which it refuses.',
    ])
    expect(plc.read('D0')).toBe(0)
    expect(parsed(await at('write', 'D0=1', 'D99999=2', '--yes', '--json'))).toMatchObject({
      results: [
        { item: 'D0', ok: false, error: { endCode: 0x4031 }, together: ['D99999'] },
        { item: 'D99999', ok: false, error: { endCode: 0x4031 }, together: ['D0'] },
      ],
    })
    // Sent by itself, it is told by itself.
    const apart = await at('write', 'D0=1', 'M99999999=ON', '--yes')
    expect(apart.out).toMatch(/^D0 += 1$/m)
    expect(apart.err).not.toMatch(/together/)
    expect(apart.err).toMatch(/M99999999/)
  })
})

describe('control', () => {
  test.each([
    ['stop', 'STOP'],
    ['pause', 'PAUSE'],
  ] as const)('%s and run', async (action, state) => {
    expect((await at('control', action, '--yes')).code).toBe(0)
    expect(plc.cpu.state).toBe(state)
    const { code, out } = await at('control', 'run', '--yes')
    expect([code, plc.cpu.state]).toEqual([0, 'RUN'])
    expect(out).toMatch(/^Remote RUN: /)
  })

  test('latch clear and reset need STOP', async () => {
    const refused = await at('control', 'latch-clear', '--yes')
    expect(refused.code).toBe(3)
    expectNoStack(refused)
    await at('control', 'stop', '--yes')
    plc.write('L0', true)
    expect((await at('control', 'latch-clear', '--yes')).code).toBe(0)
    expect(plc.read('L0')).toBe(false)
    const reset = await at('control', 'reset', '--yes', '--json')
    expect(reset.code).toBe(0)
    expect(parsed(reset)).toMatchObject({ action: 'reset', ok: true })
  })

  test('clears what is said before it runs', async () => {
    plc.write('D0', 5)
    await at('control', 'stop', '--yes')
    expect((await at('control', 'run', '--clear', 'all', '--yes')).code).toBe(0)
    expect(plc.read('D0')).toBe(0)
  })

  test('refuses without --yes where nobody can be asked', async () => {
    const ended = await at('control', 'stop')
    expect(ended.code).toBe(2)
    expect(ended.err).toMatch(/Nothing was sent/)
    expect(plc.cpu.state).toBe('RUN')
  })

  test.each([
    [
      ['control', 'explode', '--yes'],
      /choose run, stop, pause, latch-clear, reset, global-on, global-off, clear-error, self-test/,
    ],
    [['control', 'stop', '--force', '--yes'], /takes no --force/],
    [['control', 'reset', '--verify', '--yes'], /takes no --verify/],
    [['control', 'run', '--clear', 'some', '--yes'], /keep, exceptLatched, all/],
  ])('%j is wrong use', async (args, message) => {
    const ended = await here(...args)
    expect(ended.code).toBe(2)
    expect(ended.err).toMatch(message)
    expect(plc.cpu.state).toBe('RUN')
  })
})

describe('no answer', () => {
  test('a port on which nothing listens, with causes', async () => {
    const port = await other({ udp: false }, async (simulator) => simulator.tcp?.port)
    const ended = await run('identify', '--plc', `127.0.0.1:${port}`)
    expect(ended).toMatchObject({ code: 4, out: '' })
    expect(ended.err).toMatch(/refused.*\nPossible causes, the most likely first:\n {2}1\. /)
    expectNoStack(ended)
    const asJson = await run('read', 'D0', '--plc', `127.0.0.1:${port}`, '--json')
    expect(asJson.code).toBe(4)
    expect(parsed(asJson)).toMatchObject({
      error: { code: 'CONNECT_FAILED', outcome: 'notSent', causes: expect.any(Array) },
    })
  })

  test('a PLC with another data code is silent, and the first cause says so', async () => {
    const ended = await at('identify', '--ascii', '--timeout', '300')
    expect(ended.code).toBe(4)
    expect(ended.err).toMatch(
      /does not answer [^\n]*\.\nPossible causes, the most likely first:\n {2}1\. .*binary code and this connection to ASCII code/,
    )
    expectNoStack(ended)
  })

  test('a request that is never answered', async () => {
    plc.faults.add({ kind: 'silence', commands: ['readWords'] })
    const ended = await at('read', 'D0', '--timeout', '300')
    expect(ended.code).toBe(4)
    expect(ended.err).toMatch(/no answer .* before the deadline/)
    expectNoStack(ended)
  })

  test('all entries taken', async () => {
    plc.faults.add({ kind: 'closeOnAccept' })
    const ended = await at('identify')
    expect(ended.code).toBe(4)
    expect(ended.err).toMatch(/entries/)
  })

  test('an answer that breaks the protocol', async () => {
    plc.faults.add({ kind: 'garbage', place: 'instead', commands: ['readWords'] })
    const ended = await at('read', 'D0')
    expect(ended.code).toBe(5)
    expectNoStack(ended)
  })
})

describe('wrong use', () => {
  test.each([
    [['read', 'D0'], /Which PLC\?.*--plc 192\.168\.3\.39:5010/],
    [['read', 'D0', '--plc', '127.0.0.1'], /Which port of 127\.0\.0\.1\?/],
    [['read', 'D0', '--plc', '127.0.0.1:99999'], /99999 is not a port/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--host', '127.0.0.2'], /--plc or --host, not both/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--port', '2'], /given twice, as 1 and as 2/],
    [['read', 'D0', '--plc', '[::1]'], /Which port of ::1\?/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--port', 'x'], /whole number from 1 to 65535/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--profile', 'q9'], /iq-r, iq-f, fx5-enet, .*generic/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--profile', 'iq-f', '--frame', '4E'], /has no 4E frame/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--network', '1'], /network 1 has stations 1 to 120/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--network', '1', '--station', '300'], /need the station extension frame/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--frame', 'ext', '--ascii'], /binary code only/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--frame', 'ext', '--network', '1', '--station', '125'], /two stations/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--module-io', 'zz'], /hexadecimal/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--xy-radix', '10'], /8 \(octal\) or 16/],
    [['read', 'D0', '--plc', '127.0.0.1:1', '--w-radix', '8'], /10 \(decimal\) or 16/],
    [['read'], /missing required argument/],
    [['read', 'D0', '--frobnicate'], /unknown option/],
    [['frobnicate'], /unknown command/],
    [[], /Usage: melsec-jw/],
  ])('%j', async (args, message) => {
    const ended = await runHere(args)
    expect(ended).toMatchObject({ code: 2, out: '' })
    expect(ended.err).toMatch(message)
    expectNoStack(ended)
  })
})
