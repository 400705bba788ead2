/** The write and control nodes in a real Node-RED, against a simulated PLC. */
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { type CaughtError, catchNode, connectionTo, controlNode, startPlc, writeNode } from './flow'

let red: NodeRed
let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc({ resetAllowed: true, restartTime: 100 })
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

afterEach(() => {
  plc.faults.clear()
  red.forget()
})

const writable = () => connectionTo(plc, { allowWrites: true })
const controllable = () => connectionTo(plc, { allowControl: true })

async function send(id: string, message: Readonly<Record<string, unknown>>): Promise<Message> {
  await red.receive(id, message)
  const answer = await red.next(id)
  expect(await red.completed(id)).not.toHaveProperty('error')
  return answer
}

async function caught(
  id: string,
  message: Readonly<Record<string, unknown>>,
): Promise<Message & { error: CaughtError }> {
  await red.receive(id, message)
  expect(await red.completed(id)).toHaveProperty('error')
  return (await red.next('catch')) as Message & { error: CaughtError }
}

const row = (address: string, value: string, valueType: string, name = '') => ({
  name,
  address,
  type: '',
  value,
  valueType,
})

describe('writing', () => {
  test('values by address out of the message, which is passed on as it was', async () => {
    await red.deploy([writable(), writeNode()])
    const payload = { 'D110:REAL': 71.5, M0: true, 'D130:STRING(20)': 'Tea', 'D150[2]': [1, -1] }
    expect(await send('write', { _msgid: 'abc', topic: 'set', payload })).toEqual({
      _msgid: 'abc',
      topic: 'set',
      payload,
    })
    expect(plc.read('D110:REAL')).toBe(71.5)
    expect(plc.read('M0')).toBe(true)
    expect(plc.read('D130:STRING(20)')).toBe('Tea')
    expect([plc.read('D150'), plc.read('D151')]).toEqual([1, -1])
  })

  test('values by the names of the rows', async () => {
    const items = [{ name: 'setpoint', address: 'D112', type: 'REAL' }]
    await red.deploy([writable(), writeNode({ items })])
    await send('write', { payload: { setpoint: 40.25, D114: 9 } })
    expect([plc.read('D112:REAL'), plc.read('D114')]).toEqual([40.25, 9])
  })

  test('the values of the rows: typed, from the message, from JSONata', async () => {
    const items = [
      row('D160', '-5', 'num'),
      row('M20', 'true', 'bool'),
      row('D162:STRING(4)', '12', 'str'),
      row('D170', 'payload.count', 'msg'),
      row('D171', 'payload.count * 2', 'jsonata'),
      row('D172[2]', '[3, 4]', 'json'),
      row('D180:LINT', '9007199254740993', 'num'),
    ]
    await red.deploy([writable(), writeNode({ valuesType: 'rows', items })])
    await send('write', { payload: { count: 21 } })
    expect([plc.read('D160'), plc.read('M20'), plc.read('D162:STRING(4)')]).toEqual([-5, true, '12'])
    expect([plc.read('D170'), plc.read('D171'), plc.read('D172'), plc.read('D173')]).toEqual([21, 42, 3, 4])
    expect(plc.read('D180:LINT')).toBe(9007199254740993n)
  })

  test('is refused while the connection does not allow it: nothing is sent', async () => {
    plc.write('D114', 1)
    await red.deploy([connectionTo(plc), writeNode(), catchNode()])
    await red.status('write', { fill: 'green' })
    const before = plc.statistics.requests
    expect((await caught('write', { payload: { D114: 2 } })).error).toMatchObject({
      code: 'NOT_PERMITTED',
      message: expect.stringContaining('tick'),
      cause: { outcome: 'notSent' },
    })
    await red.status('write', { fill: 'red', text: 'not allowed' })
    expect(plc.statistics.requests).toBe(before)
    expect(plc.read('D114')).toBe(1)
    expect(red.pending('write')).toEqual([])
  })

  test.each([
    ['a number', 5],
    ['nothing', undefined],
    ['an array', [1]],
    ['no values', {}],
  ])('%s instead of values by name is refused', async (_what, payload) => {
    await red.deploy([writable(), writeNode(), catchNode()])
    expect((await caught('write', { payload })).error).toMatchObject({ code: 'BAD_INPUT' })
  })

  test.each([
    ['a value that does not fit', { D160: 11, D161: 70000 }, 'BAD_VALUE'],
    ['an address that is none', { D160: 11, Q7: 1 }, 'BAD_ADDRESS'],
    ['an object as value', { D160: 11, D161: { value: 1 } }, 'BAD_VALUE'],
    ['undefined as value', { D160: 11, D161: undefined }, 'BAD_VALUE'],
  ])('%s: nothing is written, not even the good ones', async (_what, payload, code) => {
    plc.write('D160', 10)
    await red.deploy([writable(), writeNode(), catchNode()])
    expect((await caught('write', { payload })).error).toMatchObject({ code, cause: { outcome: 'notSent' } })
    expect(plc.read('D160')).toBe(10)
  })

  test('one bit of a word needs its tick', async () => {
    plc.write('D190', 0b1001)
    await red.deploy([writable(), writeNode(), catchNode()])
    await caught('write', { payload: { 'D190.1': true } })
    expect(plc.read('D190')).toBe(0b1001)
    await red.deploy([writable(), writeNode({ readModifyWrite: true })])
    await send('write', { payload: { 'D190.1': true } })
    expect(plc.read('D190')).toBe(0b1011)
  })

  test('refused by the PLC: Catch gets the end code and which item it was', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0x4031, commands: ['writeWords', 'writeRandomWords'] })
    await red.deploy([writable(), writeNode(), catchNode()])
    const { error } = await caught('write', { payload: { D114: 2 } })
    expect(error).toMatchObject({
      code: 'END_CODE',
      cause: { endCode: 0x4031, outcome: 'refused', items: [{ name: 'D114', written: false }] },
    })
    await red.status('write', { text: 'end code 4031' })
  })

  test('refused together: the rows are named, the one that is beyond the devices of the CPU first', async () => {
    const rows = [
      { name: 'ok', address: 'D114' },
      { name: 'beyond', address: 'D99999' },
    ]
    await red.deploy([writable(), writeNode({ items: rows }), catchNode()])
    const { error } = await caught('write', { payload: { ok: 1, beyond: 2 } })
    expect(error.message).toMatch(/^PlcError: beyond \(D99999\), ok \(D114\), written together/)
    expect((await caught('write', { payload: { beyond: 70000 } })).error.message).toMatch(
      /^PlcError: beyond \(D99999\): /,
    )
  })

  test('of unknown outcome is said so and never repeated', async () => {
    let writes = 0
    const ended = plc.on('write', () => {
      writes += 1
    })
    plc.faults.add({ kind: 'drop', commands: ['writeWords', 'writeRandomWords'] })
    await red.deploy([connectionTo(plc, { allowWrites: true, timeout: '1000' }), writeNode(), catchNode()])
    const { error } = await caught('write', { payload: { D114: 3 } })
    expect(error.cause).toMatchObject({ outcome: 'unknown' })
    expect(error.cause.items).toMatchObject([{ name: 'D114', written: false, outcome: 'unknown' }])
    await red.status('write', { text: 'timeout' })
    plc.faults.clear()
    await send('write', { payload: { D115: 1 } })
    expect(plc.read('D114')).toBe(3)
    expect(writes).toBe(2)
    ended()
  })
})

describe('reading back', () => {
  const checked = () => writeNode({ readBack: true })

  test('passes what the PLC holds now: REAL to its 32 bits, text, BigInt', async () => {
    await red.deploy([writable(), checked()])
    await send('write', {
      payload: { 'D110:REAL': 0.1, 'D130:STRING(9)': 'Tea', 'D180:LINT': 5, 'M0[2]': [true, false] },
    })
    expect(plc.read('D110:REAL')).toBeCloseTo(0.1)
  })

  test('reports what the PLC has changed since', async () => {
    const ended = plc.on('write', () => plc.write('D114', 99))
    await red.deploy([writable(), checked(), catchNode()])
    const { error } = await caught('write', { payload: { D114: 5, D160: 1 } })
    ended()
    expect(error).toMatchObject({
      code: 'READ_BACK',
      cause: { outcome: 'unknown', differences: [{ name: 'D114', written: 5, read: 99 }] },
    })
    expect(red.pending('write')).toEqual([])
  })

  test('reports when it could not be read back', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0xc056, commands: ['readWords', 'readRandom', 'readBlock'] })
    await red.deploy([writable(), checked(), catchNode()])
    const { error } = await caught('write', { payload: { D114: 5 } })
    expect(error).toMatchObject({
      code: 'READ_BACK',
      cause: { differences: [{ name: 'D114', error: { endCode: 0xc056 } }] },
    })
    expect(plc.read('D114')).toBe(5)
  })
})

describe('control', () => {
  test('tells who the CPU is and how long an answer takes, without any permission', async () => {
    await red.deploy([connectionTo(plc), controlNode()])
    expect((await send('control', { payload: 'identify', own: 1 })).payload).toMatchObject({
      command: 'identify',
      model: 'R08CPU',
      modelCode: 0x4801,
      profile: 'iq-r',
    })
    expect((await send('control', { payload: 'selfTest' })).payload).toEqual({
      command: 'selfTest',
      roundTrip: expect.any(Number),
    })
  })

  test('stops, pauses and runs the CPU', async () => {
    await red.deploy([controllable(), controlNode()])
    expect(await send('control', { payload: 'stop', own: 1 })).toMatchObject({ payload: { command: 'stop' }, own: 1 })
    expect(plc.cpu.state).toBe('STOP')
    await send('control', { payload: 'latchClear' })
    await send('control', { payload: { command: 'run', clear: 'exceptLatched', force: true } })
    expect(plc.cpu.state).toBe('RUN')
    await send('control', { payload: 'pause' })
    expect(plc.cpu.state).toBe('PAUSE')
    await send('control', { payload: 'run' })
    await send('control', { payload: 'clearError' })
  })

  test('does the command that was chosen in the node', async () => {
    await red.deploy([controllable(), controlNode({ commandType: 'command', command: 'stop' })])
    await send('control', { payload: 'run' })
    expect(plc.cpu.state).toBe('STOP')
    await red.deploy([controllable(), controlNode({ commandType: 'command', command: 'run', clear: 'keep' })])
    expect((await send('control', {})).payload).toEqual({ command: 'run', force: false, clear: 'keep' })
    expect(plc.cpu.state).toBe('RUN')
  })

  test('verifies what the CPU does, when it is told to', async () => {
    const verifying = { commandType: 'command', command: 'run', clear: 'keep', version: 2, verify: true }
    const slow = connectionTo(plc, { allowControl: true, timeout: '700' })
    await red.deploy([slow, controlNode(verifying), catchNode()])
    expect((await send('control', {})).payload).toEqual({ command: 'run', force: false, clear: 'keep', verified: true })
    plc.cpu.switch = 'STOP'
    const { error } = await caught('control', {})
    plc.cpu.switch = 'RUN'
    expect(error).toMatchObject({ code: 'NOT_VERIFIED', cause: { outcome: 'unknown' } })
    expect(error.message).toContain('its RUN/STOP switch is at STOP')
  })

  test.each([
    ['1E frames', { profile: 'fx3' }, {}],
    ['a profile that does not tell', {}, { profile: 'generic' }],
  ] as const)('a STOP is never refused because its effect cannot be seen: %s', async (_, simulated, settings) => {
    const other = await startPlc(simulated)
    try {
      await red.deploy([
        connectionTo(other, { allowControl: true, ...settings }),
        controlNode({ version: 2, verify: true }),
      ])
      for (const payload of ['stop', { command: 'stop', verify: true }]) {
        expect((await send('control', { payload })).payload).toEqual({ command: 'stop', verified: false })
        expect(other.cpu.state).toBe('STOP')
      }
      const text = 'not verified'
      await red.status('control', { fill: 'yellow', text })
      // Without being asked for nothing is said of it.
      const { payload } = await send('control', { payload: { command: 'run', verify: false } })
      expect(payload).toEqual({ command: 'run', force: false, clear: 'keep' })
      await red.status('control', { fill: 'green' })
    } finally {
      await other.close()
    }
  })

  test('a flow from before there was verify goes on without; the message may ask for it', async () => {
    await red.deploy([
      controllable(),
      controlNode({ commandType: 'command', command: 'run', clear: 'keep', version: 1 }),
    ])
    plc.cpu.switch = 'STOP'
    expect((await send('control', {})).payload).toEqual({ command: 'run', force: false, clear: 'keep' })
    plc.cpu.switch = 'RUN'
    await red.deploy([controllable(), controlNode()])
    expect((await send('control', { payload: { command: 'stop', verify: true } })).payload).toEqual({
      command: 'stop',
      verified: true,
    })
    await send('control', { payload: 'run' })
  })

  test.each(['run', 'stop', 'pause', 'latchClear', 'reset', 'clearError'])(
    '%s is refused while the connection does not allow it',
    async (payload) => {
      await red.deploy([connectionTo(plc, { allowWrites: true }), controlNode(), catchNode()])
      await red.status('control', { fill: 'green' })
      const before = plc.statistics.requests
      expect((await caught('control', { payload })).error).toMatchObject({ code: 'NOT_PERMITTED' })
      expect(plc.statistics.requests).toBe(before)
      expect(plc.cpu.state).toBe('RUN')
    },
  )

  test.each([
    ['an unknown command', 'explode'],
    ['nothing', undefined],
    ['a force that is no boolean', { command: 'run', force: 'yes' }],
    ['a verify that is no boolean', { command: 'run', verify: 1 }],
    ['an unknown clear mode', { command: 'run', clear: 'everything' }],
    ['the name of something every object has', 'constructor'],
  ])('%s is refused', async (_what, payload) => {
    await red.deploy([controllable(), controlNode(), catchNode()])
    expect((await caught('control', { payload })).error).toMatchObject({ code: 'BAD_INPUT' })
    expect(plc.cpu.state).toBe('RUN')
  })

  test('reset succeeds by the silence of the CPU, and the connection comes back', async () => {
    await red.deploy([controllable(), controlNode()])
    await send('control', { payload: 'stop' })
    const restarted = new Promise((resolve) => plc.on('restart', resolve))
    expect((await send('control', { payload: 'reset' })).payload).toEqual({ command: 'reset' })
    await restarted
    await red.status('control', { fill: 'green' })
    expect((await send('control', { payload: 'identify' })).payload).toMatchObject({ model: 'R08CPU' })
  })
})
