/** On-demand on the command line: `melsec-jw listen`, and what `simulate` sends. */
import { afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import { runProgram } from '../../src/cli/program'
import type { Terminal } from '../../src/cli/terminal'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/entry/simulator'
import { until } from '../client/line'
import { build, type Running, start, startTyping } from './cli'
import { runHere } from './in-process'

beforeAll(build, 120_000)

const running: Running[] = []
const plcs: PlcSimulator[] = []
const silent: Terminal = {
  out: () => {},
  error: () => {},
  interactive: false,
  ask: async () => '',
  input: async () => '',
}

afterEach(async () => {
  await Promise.all(running.splice(0).map((program) => program.interrupt()))
  await Promise.all(plcs.splice(0).map((plc) => plc.close()))
})

function kept(program: Running): Running {
  running.push(program)
  return program
}

async function simulated(options: PlcSimulatorOptions = {}): Promise<{ plc: PlcSimulator; address: string }> {
  const plc = createPlcSimulator({ profile: 'iq-r', ...options })
  plcs.push(plc)
  await plc.listen()
  return { plc, address: `127.0.0.1:${plc.tcp?.port}` }
}

/** Sends as soon as there is a client that has asked something. */
async function send(plc: PlcSimulator, ...data: Parameters<PlcSimulator['sendOnDemand']>[0][]): Promise<void> {
  const [first = [], ...more] = data
  await until(() => plc.sendOnDemand(first) > 0)
  for (const one of more) plc.sendOnDemand(one)
}

describe('listen', () => {
  test('prints a line for each On-demand, and ends at Ctrl-C', async () => {
    const { plc, address } = await simulated()
    const program = kept(start('listen', '--plc', address, '--profile', 'iq-r'))
    await send(plc, [1, 2, 65535], Buffer.from([1, 2, 3]), [])
    await program.says(/ 0 words:\n/)
    // It takes Ctrl-C from then on; what the PLC sends may come before.
    await program.says(/Connected to /)
    const { code, out, err } = await program.interrupt()
    expect(code).toBe(0)
    const time = String.raw`\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z`
    expect(out).toMatch(new RegExp(`^${time}  3 words: 1 2 65535\n${time}  3 bytes: 01 02 03\n${time}  0 words:\n$`))
    expect(err).toBe(`Connected to tcp ${address}. Ctrl-C ends it.\n`)
  })

  test('catches Ctrl-C before it says so', async () => {
    const { address } = await simulated()
    const before = process.listenerCount('SIGINT')
    const caught: number[] = []
    const code = await runProgram(['listen', '--plc', address, '--profile', 'iq-r'], '1.2.3', {
      ...silent,
      error: () => {
        caught.push(process.listenerCount('SIGINT'))
        process.emit('SIGINT')
      },
    })
    expect([code, ...caught]).toEqual([0, before + 1])
    expect(process.listenerCount('SIGINT')).toBe(before)
  })

  test('as JSON: a document in each line', async () => {
    const { plc, address } = await simulated()
    const program = kept(start('listen', '--plc', address, '--profile', 'iq-r', '--json', '--count', '2'))
    await send(plc, [258], Buffer.from([1]), [5])
    const { code, out } = await program.ended()
    expect(code).toBe(0)
    const lines = out
      .trim()
      .split('\n')
      .map((line): unknown => JSON.parse(line))
    const route = { network: 0, station: 255, moduleIo: 0x3ff, multidrop: 0 }
    expect(lines).toEqual([
      { time: expect.any(String), timestamp: expect.any(Number), route, data: '0201', words: [258] },
      { time: expect.any(String), timestamp: expect.any(Number), route, data: '01' },
    ])
  })

  test('connects again by itself, and says so', async () => {
    const { plc, address } = await simulated({ restartTime: 0 })
    const program = kept(start('listen', '--plc', address, '--profile', 'iq-r', '--as', 'hex'))
    await program.says(/Connected to /)
    plc.restart()
    await program.says(/No connection: /)
    await program.says(/Connected again\./)
    await send(plc, [0x1234])
    await program.says(/ 2 bytes: 34 12\n/)
  })

  test.each([
    [['--as', 'text'], Buffer.from('abc'), / "abc"\n$/, ''],
    [['--as', 'text', '--encoding', 'shift-jis'], Buffer.from([0x83, 0x65]), / "テ"\n$/, ''],
    [['--as', 'text'], Buffer.from([0xff, 0xfe]), / 2 bytes: FF FE\n$/, 'no ASCII text'],
    [['--as', 'text'], [], / ""\n$/, ''],
    [['--as', 'hex'], [1], / 2 bytes: 01 00\n$/, ''],
    [[], [7], / 1 word: 7\n$/, ''],
  ] as const)('%j', async (options, data, printed, complaint) => {
    const { plc, address } = await simulated()
    const ended = runHere(['listen', '--plc', address, '--profile', 'iq-r', '--count', '1', ...options])
    await send(plc, data)
    const { code, out, err } = await ended
    expect(code).toBe(0)
    expect(out).toMatch(printed)
    expect(err).toContain(complaint)
  })

  test.each([
    [['--profile', 'iq-f', '--frame', '1E'], 2, /1E frame has no On-demand/],
    [['--profile', 'iq-r', '--udp'], 2, /needs localPort/],
    [['--profile', 'iq-r', '--as', 'numbers'], 2, /Choose one of words, hex, text/],
    [['--profile', 'iq-r', '--count', '0'], 2, /1 to 1000000000/],
  ])('%j is wrong use', async (args, code, message) => {
    const answered = await runHere(['listen', '--plc', '127.0.0.1:1', ...args])
    expect([answered.code, answered.out]).toEqual([code, ''])
    expect(answered.err).toMatch(message)
  })

  test('without a PLC it says why, and ends', async () => {
    const { plc, address } = await simulated()
    await plc.close()
    const { code, err } = await runHere(['listen', '--plc', address, '--profile', 'iq-r'])
    expect(code).toBe(4)
    expect(err).toMatch(/Possible causes/)
  })
})

describe('simulate', () => {
  test('catches Ctrl-C before it says where it listens', async () => {
    const caught: number[] = []
    const before = process.listenerCount('SIGINT')
    const tell = () => {
      caught.push(process.listenerCount('SIGINT'))
      process.emit('SIGINT')
    }
    const code = await runProgram(['simulate', '--port', '0'], '1.2.3', { ...silent, out: tell, error: tell })
    expect([code, caught[0]]).toEqual([0, before + 1])
  })

  async function simulate(program: Running): Promise<string> {
    kept(program)
    const [, port] = await program.says(/TCP +127\.0\.0\.1:(\d+)/)
    return `127.0.0.1:${port}`
  }

  test('sends words again and again', async () => {
    const address = await simulate(
      start('simulate', '--port', '0', '--on-demand', '1,-1,0x1F', '--on-demand-every', '20'),
    )
    const { out } = await runHere(['listen', '--plc', address, '--profile', 'iq-r', '--count', '3'])
    expect(out.split('\n').map((line) => line.slice(26))).toEqual([...Array(3).fill('3 words: 1 65535 31'), ''])
  })

  test('sends what somebody types, and says what it does not understand', async () => {
    const program = startTyping('simulate', '--port', '0', '--interactive')
    const address = await simulate(program)
    program.type('ondemand 1 2')
    await program.says(/Sent to 0 clients\./)
    const ended = runHere(['listen', '--plc', address, '--profile', 'iq-r', '--count', '3', '--as', 'hex'])
    const listener = kept(start('listen', '--plc', address, '--profile', 'iq-r', '--as', 'hex', '--count', '3'))
    await listener.says(/Connected/)
    program.type('ondemand 1 0xFFFF')
    await program.says(/Sent to 2 clients\./)
    program.type("on-demand 'AB C'")
    program.type('ONDEMAND')
    for (const wrong of ['ondemand 65536', 'ondemand 1.5', 'ondemand "ä"', 'send 1', 'ondemands', ''])
      program.type(wrong)
    await program.says(/-32768 to 65535, not 65536/)
    await program.says(/takes a whole number .*not "1\.5"/)
    await program.says(/20H to 7EH/)
    await program.says(/Type "ondemand 1 2 0xFFFF".*\n.*Type "ondemand/)
    const lines = ['4 bytes: 01 00 FF FF', '4 bytes: 41 42 20 43', '0 bytes:', '']
    expect((await ended).out.split('\n').map((line) => line.slice(26))).toEqual(lines)
    expect((await listener.ended()).out.split('\n').map((line) => line.slice(26))).toEqual(lines)
    expect((await program.interrupt()).code).toBe(0)
  })

  test('goes on when its standard input ends', async () => {
    const program = start('simulate', '--port', '0', '--interactive')
    const address = await simulate(program)
    const { code } = await runHere(['identify', '--plc', address, '--profile', 'iq-r'])
    expect(code).toBe(0)
  })

  test.each([
    [['--on-demand', '1,x'], /takes a whole number/],
    [['--on-demand', '70000'], /-32768 to 65535/],
    [['--on-demand', '1', '--on-demand-every', '5'], /10 to 3600000/],
  ])('%j is wrong use', async (args, message) => {
    const { code, out, err } = await runHere(['simulate', ...args])
    expect([code, out]).toEqual([2, ''])
    expect(err).toMatch(message)
  })
})
