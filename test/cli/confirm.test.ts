/** What only happens when somebody is there to answer; and how values are typed. In process, with a terminal of our own. */
import { afterAll, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import { typedValue } from '../../src/cli/typed-value'
import { typeNames } from '../../src/entry/address'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { RequestError } from '../../src/index'
import { runHere } from './in-process'

let plc: PlcSimulator

beforeAll(async () => {
  plc = createPlcSimulator({ profile: 'iq-r' })
  await plc.listen()
})

afterAll(() => plc.close())

beforeEach(() => {
  plc.memory.clear()
  plc.cpu.switch = 'RUN'
})

/** Runs the program with somebody who answers. */
const asked = (answer: string, ...args: readonly string[]) =>
  runHere([...args, '--plc', `127.0.0.1:${plc.tcp?.port}`, '--profile', 'iq-r'], answer)

describe('write', () => {
  test.each(['y', 'Y', ' yes '])('%j: writes what was shown', async (answer) => {
    const { code, questions, out } = await asked(answer, 'write', 'D10:REAL=1.5', 'M0[2]=1,0')
    expect(code).toBe(0)
    expect(questions).toHaveLength(1)
    expect(questions[0]?.split('\n')).toEqual([
      `Write to tcp 127.0.0.1:${plc.tcp?.port}:`,
      '  D10:REAL  data register D10 to D11  REAL  = 1.5',
      '  M0[2]     internal relay M0 to M1   BOOL  = ON, OFF',
      'Go on? [y/N] ',
    ])
    expect(out).toContain('= 1.5')
    expect([plc.read('D10:REAL'), plc.read('M0')]).toEqual([1.5, true])
  })

  test.each(['', 'n', 'no', 'yellow', 'j'])('%j: writes nothing', async (answer) => {
    const { code, err } = await asked(answer, 'write', 'D10=5')
    expect(code).toBe(2)
    expect(err).toMatch(/Nothing was written. Not confirmed./)
    expect(plc.read('D10')).toBe(0)
  })

  test('says beforehand what else the write does, and what will not be written', async () => {
    const { questions } = await asked('n', 'write', 'D10.3=1', '--read-modify-write')
    expect(questions[0]).toMatch(/whole word, read just before/)
    const bad = await asked('n', 'write', 'D10=70000')
    expect(bad.questions[0]).toMatch(/D10 is not written/)
  })

  test('--yes asks nothing', async () => {
    expect((await asked('n', 'write', 'D10=5', '-y')).questions).toEqual([])
    expect(plc.read('D10')).toBe(5)
  })
})

describe('control', () => {
  test('says what it does to the plant, and does it after y only', async () => {
    const no = await asked('n', 'control', 'stop')
    expect(no.code).toBe(2)
    expect(no.questions[0]).toMatch(
      /^Remote STOP of tcp 127\.0\.0\.1:\d+: the CPU stops its program, and its outputs go OFF\.\nGo on/,
    )
    expect(plc.cpu.state).toBe('RUN')
    expect((await asked('y', 'control', 'stop')).code).toBe(0)
    expect(plc.cpu.state).toBe('STOP')
  })
})

describe('values as they are typed', () => {
  const wanted = (type: string, count?: number) => ({
    text: `D0:${type}`,
    type,
    ...(count === undefined ? {} : { count }),
  })

  test.each([
    ['BOOL', 'ON', true],
    ['BOOL', 'false', false],
    ['INT', '-5', -5],
    ['INT', '+5', 5],
    ['INT', 'K100', 100],
    ['UINT', 'HFF', 255],
    ['WORD', '0xff', 255],
    ['DWORD', '16#DEADBEEF', 0xdeadbeef],
    ['BCD16', '1234', 1234],
    ['TIME', ' 1500 ', 1500],
    ['LINT', '-9223372036854775808', -(2n ** 63n)],
    ['ULINT', '0xFFFFFFFFFFFFFFFF', 2n ** 64n - 1n],
    ['REAL', '.5', 0.5],
    ['LREAL', '-1.5E-3', -0.0015],
    ['STRING(8)', ' a=1 ', ' a=1 '],
    ['WSTRING(8)', '山田', '山田'],
  ])('%s %j', (type, text, value) => {
    expect(typedValue(wanted(type), text)).toEqual(value)
  })

  test('arrays', () => {
    expect(typedValue(wanted('INT', 3), '1, 2,0x3')).toEqual([1, 2, 3])
    expect(typedValue(wanted('STRING(8)', 2), 'a,b c')).toEqual(['a', 'b c'])
  })

  test.each([
    ['BOOL', '2'],
    ['BOOL', ''],
    ['INT', ''],
    ['INT', '1.5'],
    ['INT', '1e3'],
    ['INT', '5 5'],
    ['INT', '0x'],
    ['REAL', ''],
    ['REAL', 'NaN'],
    ['REAL', '1e999'],
    ['REAL', '1,5'],
    ['LINT', '1.0'],
  ])('%s refuses %j, naming item, text and what it takes', (type, text) => {
    const refuse = () => typedValue(wanted(type), text)
    expect(refuse).toThrow(RequestError)
    expect(refuse).toThrow(`D0:${type} takes`)
    expect(refuse).toThrow(JSON.stringify(text))
  })

  test('every type can be typed', () => {
    for (const name of typeNames) {
      const type = name === 'STRING' || name === 'WSTRING' ? `${name}(4)` : name
      expect(typedValue(wanted(type), '1')).not.toBeUndefined()
    }
  })
})

describe('control with --verify', () => {
  test('says that the CPU got there', async () => {
    const { code, out } = await asked('y', 'control', 'stop', '--verify')
    expect([code, out]).toEqual([0, 'Remote STOP: Carried out, and the CPU is in STOP.\n'])
    expect((await asked('y', 'control', 'run', '--verify')).out).toContain('the CPU is in RUN')
  })

  test('the switch at STOP is exit code 7, and says why', async () => {
    plc.cpu.switch = 'STOP'
    const { code, err } = await asked('y', 'control', 'run', '--verify', '--timeout', '300')
    expect(code).toBe(7)
    expect(err).toContain('in STOP, not in RUN (SD203 = 0002H): its RUN/STOP switch is at STOP')
  })
})

describe('control of what the profile lacks', () => {
  const nobody = ['--plc', '127.0.0.1:1', '--timeout', '500']

  test.each([
    ['fx3', 'pause'],
    ['fx3', 'clear-error'],
    ['fx5-enet', 'clear-error'],
    ['iq-f', 'run', '--clear', 'all'],
    ['generic', 'stop', '--verify'],
  ])('%s: %s %s %s is refused before anything is connected or asked', async (profile, ...args) => {
    const ended = await runHere(['control', ...args, ...nobody, '--profile', profile], 'y')
    expect([ended.code, ended.questions, ended.out]).toEqual([2, [], ''])
  })

  test.each([
    [['XFF'], 2],
    [['X8', 'label:Speed'], 2],
    [['D0'], 4],
    [['X8', 'D0'], 4],
  ])('read %j of an iQ-F that cannot be reached: exit code %d', async (items, code) => {
    const ended = await runHere(['read', ...items, ...nobody, '--profile', 'iq-f'])
    expect([ended.code, ended.out]).toEqual([code, ''])
  })

  test('what it has is asked and tried', async () => {
    const ended = await runHere(['control', 'stop', ...nobody, '--profile', 'fx3'], 'y')
    expect([ended.code, ended.questions.length]).toEqual([4, 1])
  })

  test.each([
    ['memory', 'read', '0', '1'],
    ['memory', 'write', '0', '1'],
    ['module', 'read', '0', '1', '--model', 'Q62DA', '--start-io', '0030'],
  ])('%s %s of an iQ-F, too', async (...args) => {
    const ended = await runHere([...args, ...nobody, '--profile', 'iq-f'], 'y')
    expect([ended.code, ended.questions, ended.out]).toEqual([2, [], ''])
  })
})

describe('control of the module', () => {
  test('clear error asks, self test does not', async () => {
    const cleared = await asked('n', 'control', 'clear-error')
    expect([cleared.code, cleared.questions.length]).toEqual([2, 1])
    expect((await asked('y', 'control', 'clear-error')).code).toBe(0)
    const tested = await asked('n', 'control', 'self-test')
    expect([tested.code, tested.questions]).toEqual([0, []])
    expect(tested.out).toContain('What was sent came back.')
  })
})

describe('identify', () => {
  test('by a port without the command connects, and says that nobody was asked: exit code 2', async () => {
    const builtIn = createPlcSimulator({ profile: 'q-built-in' })
    await builtIn.listen()
    try {
      const { code, out, err } = await runHere(
        ['identify', '--plc', `127.0.0.1:${builtIn.tcp?.port}`, '--profile', 'q-built-in'],
        'n',
      )
      expect(code).toBe(2)
      expect(out).toMatch(/Model +not told/)
      expect(err).toContain('The PLC answers, so the connection works.')
      expect(err).toContain('Built-in Ethernet ports do not have it')
      expect(builtIn.errors.led).toBe(false)
    } finally {
      await builtIn.close()
    }
  })

  test('by a port where nobody listens fails as ever', async () => {
    const closed = createPlcSimulator({ profile: 'q-built-in' })
    await closed.listen()
    const { port } = closed.tcp ?? {}
    await closed.close()
    const { code } = await runHere(
      ['identify', '--plc', `127.0.0.1:${port}`, '--profile', 'q-built-in', '--timeout', '500'],
      'n',
    )
    expect(code).toBe(4)
  })
})
