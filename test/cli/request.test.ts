// Any command, and the buffer memory of modules, from the command line.
import { afterAll, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { type Answered, runHere } from './in-process'

let plc: PlcSimulator
let withModules: PlcSimulator

beforeAll(async () => {
  plc = createPlcSimulator({ profile: 'iq-r' })
  withModules = createPlcSimulator({
    profile: 'q',
    bufferMemory: 1024,
    extensions: { modules: [{ unit: 3, points: 1024, model: 'Q62DA' }] },
  })
  await Promise.all([plc.listen(), withModules.listen()])
})

afterAll(async () => {
  await Promise.all([plc.close(), withModules.close()])
})

beforeEach(() => {
  plc.memory.clear()
  plc.cpu.switch = 'RUN'
})

const at = (simulator: PlcSimulator) => [`--plc=127.0.0.1:${simulator.tcp?.port}`, '--profile', simulator.profile.id]
const request = (args: readonly string[], answer?: string, input?: string): Promise<Answered> =>
  runHere(['request', ...args, ...at(plc)], answer, input)

function parsed({ code, out, err }: Answered): unknown {
  expect([code, err]).toEqual([0, ''])
  return JSON.parse(out)
}

describe('request', () => {
  test('sends a command by name, with addresses as texts, and prints the answer', async () => {
    plc.write('D100', 7)
    expect(parsed(await request(['readWords', '{"head":"D100","points":2}']))).toEqual({ values: [7, 0] })
    const random = '{"words":[{"device":"D100"}],"doubleWords":[{"device":{"device":"D","number":100}}]}'
    expect(parsed(await request(['readRandom', random]))).toEqual({ words: [7], doubleWords: [7] })
  })

  test('sends a command by its code, and without a message', async () => {
    expect(parsed(await request(['0101']))).toEqual({ model: 'R08CPU          ', modelCode: 0x4801 })
    expect(parsed(await request(['0619', '{"data":"ABC0"}']))).toEqual({ data: 'ABC0' })
  })

  test('reads the message from the standard input', async () => {
    expect(parsed(await request(['readBits', '-'], undefined, '{"head":"X10","points":1}'))).toEqual({
      values: [false],
    })
  })

  test('registers and asks in one go', async () => {
    plc.write('D5', 55)
    const message = { entryMonitorDevice: { words: [{ device: 'D5' }], doubleWords: [] } }
    const answer = await request(['executeMonitor', JSON.stringify(message)])
    expect(parsed(answer)).toEqual({ words: [55], doubleWords: [] })
    const missing = await request(['executeMonitor'])
    expect(missing.code).toBe(2)
    expect(missing.err).toContain('entryMonitorDevice: is missing; Execute Monitor reads what a registration names')
    const wrong = await request([
      'executeMonitor',
      '{"entryMonitorDevice":{"words":[{"device":"Q0"}],"doubleWords":[]}}',
    ])
    expect(wrong.err).toMatch(/^entryMonitorDevice\.words\.0\.device: /)
    const overUdp = await request(['executeMonitor', JSON.stringify(message), '--udp'])
    expect([overUdp.code, overUdp.err]).toEqual([2, expect.stringContaining('over UDP is not safe')])
  })

  const write = ['writeWords', '{"head":"D0","values":[1,"0xFF"]}'] as const

  test('what is for the connected station goes there, whatever the route', async () => {
    const route = ['--network', '1', '--station', '3']
    expect(parsed(await request(['selfTest', '{"data":"AB"}', ...route]))).toEqual({ data: 'AB' })
    expect(parsed(await request(['clearError', '--yes', ...route]))).toEqual({})
    expect((await runHere(['memory', 'read', '0', '1', ...at(withModules), ...route])).code).toBe(0)
    expect((await runHere(['control', 'self-test', ...at(plc), ...route])).code).toBe(0)
    expect((await request(['readWords', '{"head":"D0","points":1}', ...route])).code).not.toBe(0)
    expect((await runHere(['commands', 'clearError'])).out).toMatch(/^Goes to +the connected station only/m)
  })

  test('asks before it writes', async () => {
    const refused = await request(write, 'n')
    expect(refused.code).toBe(2)
    expect(refused.questions).toEqual([
      expect.stringMatching(/^Write \(word units\) to tcp 127.*: \{"head":"D0","values":\[1,255\]\}/),
    ])
    expect(plc.read('D1')).toBe(0)
    expect(parsed(await request(write, 'y'))).toEqual({})
    expect([plc.read('D0'), plc.read('D1')]).toEqual([1, 255])
  })

  test('writes and controls nothing in a script without --yes', async () => {
    for (const args of [write, ['remoteStop'], ['clearError'], ['writeMemory', '{"address":0,"values":[1]}']]) {
      const { code, err, questions } = await request(args)
      expect([args[0], code, questions]).toEqual([args[0], 2, []])
      expect(err).toContain('Nothing was sent')
    }
    expect(plc.cpu.state).toBe('RUN')
    expect(parsed(await request(['remoteStop', '--yes']))).toEqual({})
    expect(plc.cpu.state).toBe('STOP')
  })

  test.each([
    [['nothing'], 'There is no command "nothing"'],
    [['0401', '{}'], '"0401" is readBits, readWords: say which'],
    [['readWords', '{'], 'The message is no JSON'],
    [['readWords', '5'], 'an object with head, points'],
    [['readWords', '{"head":"D0"}'], 'points: is missing; it takes a whole number from 1 to 65535'],
    [['readWords', '{"head":"D0","points":1,"typo":1}'], 'typo: is not a field of this message; it has head, points'],
    [['readWords', '{"head":"D0","points":961}'], '961'],
    [['readBits', '{"head":"D0","points":1}'], 'is not a bit device'],
  ])('%j is refused before anything is connected', async (args, says) => {
    const before = plc.connections.length
    const { code, err, out } = await request(args)
    expect([code, out]).toEqual([2, ''])
    expect(err).toContain(says)
    expect(plc.connections.length).toBe(before)
  })

  test('errors are JSON too', async () => {
    const { out } = await request(['readWords', '{"head":"D0"}', '--json'])
    expect(JSON.parse(out)).toMatchObject({ error: { code: 'BAD_MESSAGE', field: 'points', outcome: 'notSent' } })
  })

  test('a password is no argument, and is shown nowhere', async () => {
    const message = '{"password":"hush-hush"}'
    const argument = await request(['lock', message, '--yes'])
    expect(argument.code).toBe(2)
    expect(argument.err).toContain('must not be an argument')
    const broken = await request(['lock', '-'], 'y', '{"password":"hush-hush"')
    const asked = await request(['lock', '-', '--trace'], 'y', message)
    expect(asked.questions).toEqual([expect.stringMatching(/^Lock .*: \{\}/)])
    for (const { out, err, questions } of [argument, broken, asked]) {
      expect(`${out}${err}${questions}`).not.toMatch(/hush|68 ?75 ?73 ?68/)
    }
  })
})

describe('commands', () => {
  test('lists every declared command', async () => {
    const { code, out } = await runHere(['commands'])
    expect(code).toBe(0)
    for (const { name } of Object.values(commands)) expect(out).toMatch(new RegExp(`^${name} .*`, 'm'))
    for (const { title } of Object.values(commands)) expect(out).toContain(title)
    const asJson = JSON.parse((await runHere(['commands', '--json'])).out) as { commands: { name: string }[] }
    expect(asJson.commands.map(({ name }) => name)).toEqual(Object.keys(commands))
  })

  test('tells what the message of one holds', async () => {
    const { out } = await runHere(['commands', 'writeRandomBits'])
    expect(out).toMatch(/^Code +1402$/m)
    expect(out).toMatch(/^ {2}bits +an array of objects with device, value, 1 to 255 elements$/m)
    expect(out).toMatch(/^ {2}bits\[\]\.device +a device such as "D100"/m)
    expect(out).toContain(`melsec-jw request writeRandomBits '{"bits":[{"device":"M100","value":true}]}'`)
    expect((await runHere(['commands', 'remoteRun'])).out).toMatch(
      /clearMode +a whole number .* \(may be left out\) +0 keep/,
    )
    expect((await runHere(['commands', 'readW'])).code).toBe(2)
    expect(JSON.parse((await runHere(['commands', '1617', '--json'])).out)).toMatchObject({ name: 'clearError' })
  })
})

describe('buffer memory', () => {
  const here = (args: readonly string[], answer?: string) => runHere([...args, ...at(withModules)], answer)
  const unit = ['--model', 'q62da', '--start-io', '0030']

  test('of the connected module is written, after asking, and read', async () => {
    const written = await here(['memory', 'write', '0x10', '1', '0xFFFF'], 'y')
    expect(written.questions).toEqual([expect.stringMatching(/connected module.*\n +16 +\(0010H\) += +1 +\(0001H\)\n/)])
    expect(written.code).toBe(0)
    const { out } = await here(['memory', 'read', '16', '3'])
    expect(out).toBe('16  (0010H)  =  1      (0001H)\n17  (0011H)  =  65535  (FFFFH)\n18  (0012H)  =  0      (0000H)\n')
  })

  test('of a module by its name', async () => {
    expect((await here(['module', 'write', '0x18', '1000', ...unit, '--yes'])).code).toBe(0)
    const { out } = await here(['module', 'read', '0x18', '1', ...unit, '--json'])
    expect(JSON.parse(out)).toEqual({ address: 24, values: [1000] })
  })

  test.each([
    [['module', 'read', '0', '1', '--model', 'Q99', '--start-io', '0030'], /does not know the module "Q99"/],
    [['module', 'read', '0', '1', '--model', 'Q62DA', '--start-io', '0031'], /multiple of 16/],
    [['module', 'read', '0', '1', '--model', 'Q62DA'], /required option '--start-io/],
    [['module', 'read', '0', '1', '--model', 'QD62', '--start-io', '30'], /not legible/],
    [['module', 'read', '0', '1', '--model', 'Q62DA', '--start-io', '30', '--slot0', '2'], /It is 0 or 1/],
    [['memory', 'look', '0', '1'], /choose read or write/],
    [['memory', 'read', '0', '1', '2'], /an address and how many words/],
    [['memory', 'read', '0', '481'], /481/],
    [['memory', 'read', 'D0', '1'], /"D0" is no whole number/],
    [['memory', 'write', '0', '65536', '--yes'], /65536 is no word/],
    [['memory', 'write', '0', '1'], /Nothing was written/],
  ])('%j is refused', async (args, says) => {
    const { code, err } = await here(args)
    expect(code).toBe(2)
    expect(err).toMatch(says)
  })
})
