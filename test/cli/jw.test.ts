/** The command line with a Sharp JW, against a simulated one on the loopback interface. */
import { afterAll, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import { createJwSimulator, type JwSimulator } from '../../src/entry/simulator'
import { runHere } from './in-process'

let plc: JwSimulator

beforeAll(async () => {
  plc = createJwSimulator({
    writeMode: 2,
    optionUnits: [{ rack: 0, unit: 3, kind: 'dl1' }],
    specifiedBuffers: { 1: { file: 1, address: 0o20000, length: 256 } },
    ringBuffers: { 0: { file: 1, address: 0o40000, length: 8 } },
  })
  await plc.listen()
})

afterAll(() => plc.close())

beforeEach(() => plc.faults.clear())

const at = (simulator: JwSimulator = plc) => ['--plc', `127.0.0.1:${simulator.tcp?.port}`]
/** With nobody to answer. */
const here = (...args: readonly string[]) => runHere([...args, ...at(), '--family', 'jw'])
/** With somebody who answers. */
const asked = (answer: string, ...args: readonly string[]) => runHere([...args, ...at(), '--family', 'jw'], answer)

describe('identify', () => {
  test('says what the PLC tells of itself', async () => {
    const { code, out, err } = await here('identify')
    expect([code, err]).toEqual([0, ''])
    expect(out).toMatch(/^PLC +tcp 127\.0\.0\.1:\d+, header none$/m)
    expect(out).toMatch(/^Program memory +64 K words \(07H\)$/m)
    expect(out).toMatch(/^Run state +it runs$/m)
    expect(out).toMatch(/^Write mode +all: all memory may be written$/m)
    expect(out).toMatch(/^Clock +\d\d-\d\d-\d\d \d\d:\d\d:\d\d \w+day$/m)
  })

  test('what it refuses to tell is said to be so', async () => {
    const old = createJwSimulator({ hasClock: false })
    await old.listen()
    const { code, out } = await runHere(['identify', ...at(old), '--family', 'jw'])
    expect([code, out]).toEqual([0, expect.stringMatching(/^Clock +not told$/m)])
    await old.close()
  })
})

describe('read and write', () => {
  test('operands are octal, and types of bytes are those of a Sharp JW', async () => {
    plc.write('09012:INT', -5)
    plc.write('004033', true)
    const { code, out } = await here('read', '09012:INT', '004033', '09012', '09013:SINT', 'F0:004012')
    expect(code).toBe(0)
    expect(
      out
        .trimEnd()
        .split('\n')
        .map((line) => line.split(/ {2,}/)),
    ).toEqual([
      ['09012:INT', '-5'],
      ['004033', 'ON'],
      ['09012', '251'],
      ['09013:SINT', '-1'],
      ['F0:004012', '251'],
    ])
  })

  test('what is no operand is said, and the others are read', async () => {
    const { code, out, err } = await here('read', '09018', '09000', 'D100')
    expect(code).toBe(6)
    expect(out).toMatch(/^09000 +\d+$/m)
    expect(err).toMatch(/09018.*octal/)
    expect(err).toMatch(/D100.*MELSEC/)
  })

  test('what will be written is shown with its place, and written after y only', async () => {
    plc.write('09020:INT', 0)
    const no = await asked('n', 'write', '09020:INT=0x1F', '09022=7', '004034=ON')
    expect(no.code).toBe(2)
    expect(no.questions[0]?.split('\n')).toEqual([
      `Write to tcp 127.0.0.1:${plc.tcp?.port}:`,
      expect.stringMatching(/^ {2}09020:INT +.*004020.* +INT +=\s31$/),
      expect.stringMatching(/^ {2}09022 +.*004022.* +BYTE +=\s7$/),
      expect.stringMatching(/^ {2}004034 +.*000403.* +BOOL +=\sON$/),
      expect.anything(),
    ])
    expect(plc.read('09020:INT')).toBe(0)
    expect((await asked('y', 'write', '09020:INT=0x1F', '09022=7', '004034=ON')).code).toBe(0)
    expect([plc.read('09020:INT'), plc.read('09022'), plc.read('004034')]).toEqual([31, 7, true])
  })

  test('a value that does not fit is refused before anybody is asked or connected', async () => {
    const { code, err, questions } = await runHere(
      ['write', '09020=ON', '--plc', '192.0.2.1:4000', '--family', 'jw'],
      'y',
    )
    expect([code, questions]).toEqual([2, []])
    expect(err).toMatch(/09020 takes a whole number \(BYTE\)/)
  })

  test('places that are only assumed, and those of the user', async () => {
    expect((await here('read', 'KO1600')).err).toMatch(/no source says/)
    expect((await here('read', 'KO1600', '--area', '016000..017777@F0:020000')).code).toBe(0)
    plc.write('F0:020000', 9)
    expect((await here('read', 'KO1600', '--area', '016000..017777@F0:020000', '--json')).out).toContain('"value": 9')
    expect((await here('read', '09000', '--area', 'nonsense')).code).toBe(2)
  })

  test('--trace explains messages', async () => {
    const { err } = await here('read', '09000', '--trace')
    expect(err).toMatch(/JW request: /)
    expect(err).toMatch(/JW response: /)
  })
})

describe('headers', () => {
  test.each([
    ['none', 'none'],
    ['zero40', 'zero40'],
    ['relay:1,2,3,4', { pda: 1, psa: 2, slot: 3, station: 4 }],
  ] as const)('%s', async (text, header) => {
    const simulator = createJwSimulator({ header })
    await simulator.listen()
    const { code } = await runHere(['read', '09000', ...at(simulator), '--family', 'jw', '--header', text])
    expect(code).toBe(0)
    await simulator.close()
  })

  test('find-header tries one after the other, and says which one answers', async () => {
    const simulator = createJwSimulator({ header: 'none' })
    await simulator.listen()
    const tried = ['find-header', ...at(simulator), '--timeout', '300', '--connect-timeout', '300']
    const { code, out } = await runHere(tried)
    expect(code).toBe(0)
    expect(out).toMatch(/^zero40 +\S/m)
    expect(out).toMatch(/^none +answered$/m)
    expect(out).toMatch(/^Say --header none\.$/m)
    const json = JSON.parse((await runHere([...tried, '--try', 'none', '--json'])).out) as unknown
    expect(json).toMatchObject({ header: 'none', tried: [{ header: 'none' }] })
    await simulator.close()
  })
})

describe('control', () => {
  test('stops after y, and releases', async () => {
    const no = await asked('n', 'control', 'stop')
    expect([no.code, no.questions[0]]).toEqual([
      2,
      expect.stringMatching(/^Stop of tcp .*: it stops its program\.\nGo on/),
    ])
    expect((await here('control', 'state')).out).toBe('Run state: it runs\n')
    expect((await asked('y', 'control', 'stop', '--verify')).out).toBe('Stop: Carried out, and the PLC is stopped.\n')
    expect((await here('control', 'state', '--json')).out).toContain('"state": "stopped"')
    expect((await asked('y', 'control', 'release', '--verify')).out).toBe('Release: Carried out, and the PLC runs.\n')
  })

  test('a block of the program, by its octal number', async () => {
    const { questions, code } = await asked('y', 'control', 'stop', '--block', '012')
    expect([code, questions[0]]).toEqual([0, expect.stringMatching(/: block 012 of its program stops\./)])
    expect((await here('control', 'state', '--block', '012')).out).toBe('Run state: block 012 is stopped\n')
    expect((await here('control', 'state')).out).toBe('Run state: it runs\n')
    expect((await here('control', 'release', '--block', '012', '--yes')).code).toBe(0)
    expect((await here('control', 'state', '--block', '12')).out).toBe('Run state: block 012 is running\n')
    expect((await here('control', 'state', '--block', '8')).err).toMatch(/octal number from 0 to 777/)
  })

  test('the write mode is read without asking, and set after it', async () => {
    expect((await here('control', 'write-mode')).out).toBe('Write mode: all memory may be written\n')
    expect((await here('control', 'write-mode', '--mode', 'data')).err).toMatch(/^Nothing was sent\./)
    const { out, questions } = await asked('y', 'control', 'write-mode', '--mode', 'data')
    expect(questions[0]).toMatch(/it is set to data, the data memory may be written/)
    expect(out).toBe('Write mode: Carried out; it was all: the data memory may be written.\n')
    expect(plc.cpu.writeMode).toBe(1)
    expect((await here('control', 'write-mode', '--mode', 'all', '--yes')).code).toBe(0)
  })

  test('self test', async () => {
    expect((await here('control', 'self-test')).out).toBe('Self test: What was sent came back.\n')
    const { code, err } = await here('control', 'self-test', '--model', 'jw30h')
    expect([code, err]).toEqual([2, expect.stringMatching(/jw30h/i)])
  })
})

describe('request and commands', () => {
  test('addresses are operands, bytes hexadecimal digits', async () => {
    plc.write('09030:WORD', 0xab12)
    const { code, out } = await here('request', 'readDataMemory', '{"head":"09030","length":2}')
    expect([code, JSON.parse(out)]).toEqual([0, { data: '12ab' }])
    expect((await here('request', '24', '{"head":"F0:004030","length":2}')).out).toBe(out)
  })

  test.each([
    ['fillDataMemory', '{"head":"09040","length":2,"value":7}'],
    ['setRunState', '{"state":1}'],
    ['setSecretFunction', '{"function":1}'],
    ['readRingBuffer', '{"buffer":0,"function":1,"length":1}'],
  ])('%s is asked about', async (name, message) => {
    const { code, questions } = await asked('n', 'request', name, message)
    expect([code, questions]).toEqual([2, [expect.stringMatching(/^[A-Z].* to tcp .*: \{/)]])
  })

  test('a password is no argument', async () => {
    const message = '{"function":0,"password":"AB12"}'
    const { code, err } = await here('request', 'secretPassword', message)
    expect([code, err]).toEqual([2, expect.stringMatching(/must not be an argument/)])
    const piped = await runHere(['request', 'secretPassword', '-', ...at(), '--family', 'jw'], 'n', message)
    expect(piped.questions[0]).not.toContain('AB12')
  })

  test('what the model does not have is refused before anything is connected', async () => {
    const away = ['--plc', '192.0.2.1:4000', '--family', 'jw', '--model', 'jw30h']
    const { code, err } = await runHere(['request', 'loopback', '{"data":"41"}', ...away])
    expect([code, err]).toEqual([2, expect.stringMatching(/jw30h/i)])
  })

  test('commands are described with what confirms them', async () => {
    const { out } = await runHere(['commands', 'monitorRegisters', '--family', 'jw'])
    expect(out).toMatch(/^Confirmed +assumed$/m)
    expect(out).toMatch(/^Only +jw300$/m)
    expect(out).toContain('--family jw')
    const all = JSON.parse((await runHere(['commands', '--family', 'jw', '--json'])).out) as { commands: unknown[] }
    expect(all.commands).toHaveLength(42)
  })
})

describe('clock', () => {
  const clock = (answer: string | undefined, ...args: readonly string[]) => runHere(['clock', ...args, ...at()], answer)

  test('is set after y, and read', async () => {
    expect((await clock('n', 'set', '2026-12-01T06:30:00')).code).toBe(2)
    const { questions, out } = await clock('y', 'set', '2026-12-01 06:30')
    expect(questions[0]).toMatch(/^Set the clock of tcp .* to 2026-12-01 06:30:00\.\n/)
    expect(out).toBe('Set to 2026-12-01 06:30:00.\n')
    expect((await clock(undefined, 'read')).out).toMatch(/^26-12-01 06:30:0\d Tuesday$/m)
  })

  test('is adjusted', async () => {
    await clock('y', 'set', '2026-12-01T06:30:40')
    const { questions } = await clock('y', 'adjust', '--round')
    expect(questions[0]).toMatch(/^Adjust the clock of tcp .*: to the nearer whole minute\./)
    expect(JSON.parse((await clock(undefined, 'read', '--json')).out)).toMatchObject({ hour: 6, minute: 31 })
  })

  test.each([
    [['set'], /The time is missing/],
    [['set', '2026-02-30T00:00:00'], /is no time/],
    [['set', '06:30'], /is no time/],
    [['read', 'now'], /takes no time/],
    [['read', '--stop'], /are of clock adjust/],
    [['wind'], /choose read, set or adjust/],
  ])('%j is refused', async (args, message) => {
    const { code, err, questions } = await clock('y', ...args)
    expect([code, err, questions]).toEqual([2, expect.stringMatching(message), []])
  })
})

describe('parameters', () => {
  const parameters = (answer: string | undefined, ...args: readonly string[]) =>
    runHere(['parameters', ...args, '--unit', '3', ...at()], answer)
  const settings = '{"stations":[{"bytes":8},{"bytes":4}]}'

  test('are written as settings after y, with the start switch, and read as settings', async () => {
    const no = await parameters('n', 'write', settings, '--map', 'dl1')
    expect(no.code).toBe(2)
    expect(no.questions[0]).toMatch(
      /^Write parameters of the option unit, which is stopped and started for it \(rack 0, unit 3 of tcp/,
    )
    expect(no.questions[0]).toMatch(/^ {2}0100 +08 +stations\.0\.bytes +station 00: 8 bytes$/m)
    const { code, out } = await parameters('y', 'write', settings, '--map', 'dl1')
    expect([code, out]).toEqual([
      0,
      expect.stringMatching(/^Written\. The unit was started; its check code is \d+\.$/m),
    ])
    expect((await parameters(undefined, 'read', '--map', 'dl1')).out).toMatch(
      /^0101 +04 +stations\.1\.bytes +station 01: 4 bytes$/m,
    )
    const json = JSON.parse((await parameters(undefined, 'read', '--map', 'dl1', '--json')).out) as unknown
    expect(json).toMatchObject({ settings: JSON.parse(settings) as object })
  })

  test('are bytes from an octal address on without a map', async () => {
    expect((await parameters('y', 'write', '0100', '09 05', '--yes')).code).toBe(0)
    expect((await parameters(undefined, 'read', '100', '2')).out).toBe('0100  09 05\n')
  })

  test('of a special I/O unit', async () => {
    const special = ['--special-io', '--yes']
    expect((await parameters(undefined, 'write', '010', 'AA55', ...special)).out).toBe('Written.\n')
    expect((await parameters(undefined, 'read', '010', '2', '--special-io')).out).toBe('0010  AA 55\n')
  })

  test.each([
    [['write', '{"stations":[{"bytes":64}]}', '--map', 'dl1'], /1 to 63/],
    [['write', '{"station":[]}', '--map', 'dl1'], /no setting station/],
    [['write', 'bytes=8', '--map', 'dl1'], /no JSON object/],
    [['read', '--map', 'dl9'], /needs --unit-number/],
    [['read', '--map', 'dl1', '--unit-number', '1'], /is of --map dl9/],
    [['read', '--map', 'dl1', '--special-io'], /option units/],
    [['read', '0108', '2'], /no octal number/],
    [['read', '0100'], /How many bytes/],
    [['write', '3776', '00 01'], /3776|start/],
    [['erase'], /choose read or write/],
  ])('%j is refused before anybody is asked', async (args, message) => {
    const { code, err, questions } = await parameters('y', ...args)
    expect([code, err, questions]).toEqual([2, expect.stringMatching(message), []])
  })
})

describe('buffers', () => {
  const buffer = (answer: string | undefined, ...args: readonly string[]) =>
    runHere(['buffer', ...args, ...at()], answer)

  test('where one is: the file hexadecimal, the address octal', async () => {
    const { code, out } = await buffer(undefined, 'info', '1')
    expect([code, out]).toEqual([0, expect.stringMatching(/^file: 01H\naddress: 020000 octal\nlength: 256$/m)])
    expect((await buffer(undefined, 'info', '0', '--ring')).out).toMatch(/^address: 040000 octal$/m)
  })

  test('a specified buffer is read without asking, and written after y', async () => {
    const no = await buffer('n', 'write', '1', '16', 'AA', '55')
    expect([no.code, no.questions]).toEqual([
      2,
      [expect.stringMatching(/^Write AA 55 to specified buffer 1 from byte 16 on/)],
    ])
    expect((await buffer('y', 'write', '1', '16', 'AA', '55')).out).toBe('written: 2\n')
    const { out, questions } = await buffer('n', 'read', '1', '15', '4')
    expect([out, questions]).toEqual(['data: 00 AA 55 00\n', []])
  })

  test('a ring buffer is asked about in both directions: reading takes out', async () => {
    expect((await buffer('n', 'read', '0', '4', '--ring')).questions[0]).toMatch(
      /^Take up to 4 bytes out of ring buffer 0/,
    )
    expect((await buffer('y', 'write', '0', '01 02 03', '--ring')).out).toMatch(/^written: 3$/m)
    expect((await buffer('y', 'read', '0', '4', '--ring')).out).toMatch(/^data: 01 02 03$/m)
    expect(JSON.parse((await buffer('y', 'read', '0', '4', '--ring', '--json')).out)).toMatchObject({
      data: '',
      more: false,
    })
  })

  test.each([
    [['read', '1', '0'], /takes the buffer, the first byte/],
    [['read', '0', '0', '4', '--ring'], /how many bytes at most/],
    [['read', 'A', '0', '4'], /no decimal number/],
    [['read', '32', '0', '4'], /buffer/],
    [['write', '1', '0'], /no bytes/],
    [['info', '1', '2'], /info takes/],
    [['erase', '1'], /choose info, read or write/],
  ])('%j is refused before anybody is asked', async (args, message) => {
    const { code, err, questions } = await buffer('y', ...args)
    expect([code, err, questions]).toEqual([2, expect.stringMatching(message), []])
  })
})

describe('what the family does not have is refused, with what to do', () => {
  const away = ['--plc', '192.0.2.1:4000']

  test.each([
    ['ls', '--family', 'jw'],
    ['get', '4:/A.CSV', '--family', 'jw'],
    ['put', 'a.csv', '4:/A.CSV', '--family', 'jw'],
    ['cp', '4:/A.CSV', '4:/B.CSV', '--family', 'jw'],
    ['rm', '4:/A.CSV', '--family', 'jw'],
    ['listen', '--family', 'jw'],
    ['memory', 'read', '0', '1', '--family', 'jw'],
    ['clock', 'read', '--family', 'melsec'],
    ['find-header', '--family', 'melsec'],
    ['buffer', 'info', '1', '--family', 'melsec'],
    ['parameters', 'read', '--unit', '1', '--family', 'melsec'],
  ])('%s %s', async (...args) => {
    const { code, err } = await runHere([...args, ...away])
    expect([code, err]).toEqual([2, expect.stringMatching(/^A (Sharp JW|MELSEC) has no .*\. [A-Z]/)])
  })

  test('profiles', async () => {
    expect((await runHere(['profiles', '--family', 'jw'])).err).toMatch(/--model/)
  })

  test.each([
    [['--profile', 'iq-r'], /--profile is of MELSEC only.*--model/],
    [['--frame', '4E'], /--frame is of MELSEC only.*--header/],
    [['--ascii'], /--ascii is of MELSEC only/],
    [['--station', '3'], /--station is of MELSEC only.*--header relay/],
    [['--serial', 'COM3'], /--serial is of MELSEC only.*Ethernet unit/],
    [['--no-sum-check'], /-sum-check is of MELSEC only/],
    [['--monitoring-timer', '1000'], /--monitoring-timer is of MELSEC only.*--timeout/],
    [['--probe', 'typeName'], /--probe typeName is of another family/],
  ])('read --family jw %j', async (options, message) => {
    const { code, err } = await runHere(['read', '09000', '--family', 'jw', ...away, ...options])
    expect([code, err]).toEqual([2, expect.stringMatching(message)])
  })

  test.each([
    [['--header', 'zero40'], /--header is of Sharp JW only.*--family jw/],
    [['--model', 'jw300'], /--model is of Sharp JW only/],
    [['--no-lists'], /-lists is of Sharp JW only/],
    [['--probe', 'writeMode'], /--probe writeMode is of another family/],
  ])('read of a MELSEC %j', async (options, message) => {
    const { code, err } = await runHere(['read', 'D100', ...away, ...options])
    expect([code, err]).toEqual([2, expect.stringMatching(message)])
  })

  test('decode', async () => {
    const message = '4700240000080400'
    const explained = (await runHere(['decode', message, '--family', 'jw'])).out
    expect(explained).toMatch(/004000 octal/)
    expect((await runHere(['decode', message, '--frame', 'JW'])).out).toBe(explained)
    expect((await runHere(['decode', message, '--family', 'jw', '--frame', '4E'])).err).toMatch(
      /no frame of a Sharp JW/,
    )
    expect((await runHere(['decode', message, '--marker', 'each'])).err).toMatch(/--marker is of Sharp JW only/)
  })

  test('decode reads lists as their marker stands', async () => {
    const list = '47 00 27 02 FF 00 00 08 00 00 FF 00 01 08 00 00'
    expect((await runHere(['decode', list, '--family', 'jw'])).code).toBe(5)
    expect((await runHere(['decode', list, '--family', 'jw', '--marker', 'each'])).code).toBe(0)
  })
})
