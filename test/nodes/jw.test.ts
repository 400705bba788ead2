/** The nodes with a connection to a Sharp JW, in a real Node-RED, against a simulated one. */
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import type { JwSimulator } from '../../src/entry/simulator'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import {
  type CaughtError,
  catchNode,
  controlNode,
  fileNode,
  ondemandNode,
  readNode,
  requestNode,
  writeNode,
} from './flow'
import { jwConnection, jwSettings, startJw } from './jw-flow'

let red: NodeRed
let plc: JwSimulator

beforeAll(async () => {
  plc = await startJw()
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

const everything = { allowWrites: true, allowControl: true, allowParameters: true }

async function send(id: string, payload: unknown): Promise<Message> {
  await red.receive(id, { payload })
  const answer = await red.next(id)
  expect(await red.completed(id)).not.toHaveProperty('error')
  return answer
}

async function caught(id: string, payload: unknown): Promise<CaughtError> {
  await red.receive(id, { payload })
  expect(await red.completed(id)).toHaveProperty('error')
  const { error } = (await red.next('catch')) as Message & { error: CaughtError }
  return error
}

describe('reading', () => {
  test('relays, registers, timers and raw addresses, by name', async () => {
    plc.write('09012:INT', -25)
    plc.write('004033', true)
    plc.write('09020:BCD16', 1234)
    plc.write('F1:00001234:BYTE', 200)
    await red.deploy([
      jwConnection(plc),
      readNode({ level: '09012:INT', running: '004033', batch: '09020:BCD16', raw: 'F1:00001234:BYTE' }),
      catchNode(),
    ])
    expect((await send('read', '')).payload).toEqual({ level: -25, running: true, batch: 1234, raw: 200 })
  })

  test('with quality, and an address out of the message', async () => {
    plc.write('09030:REAL', 1.5)
    await red.deploy([
      jwConnection(plc),
      readNode([], { addressesType: 'msg', addresses: 'payload', output: 'value', quality: true }),
      catchNode(),
    ])
    expect((await send('read', '09030:REAL')).payload).toEqual({
      value: 1.5,
      quality: 'good',
      timestamp: expect.any(Number),
    })
  })

  test('a device of MELSEC is refused with what a JW has', async () => {
    await red.deploy([jwConnection(plc), readNode(['D100']), catchNode()])
    expect(await caught('read', '')).toMatchObject({ code: 'BAD_ADDRESS', cause: { outcome: 'notSent' } })
  })

  test('with 40 bytes in front of each message, where the unit wants them', async () => {
    const unit = await startJw({ header: 'zero40' })
    try {
      unit.write('09012:INT', 7)
      await red.deploy([jwConnection(unit, { header: 'zero40' }), readNode(['09012:INT'], { output: 'value' })])
      expect((await send('read', '')).payload).toBe(7)
    } finally {
      await red.deploy([])
      await unit.close()
    }
  })
})

describe('writing', () => {
  test('needs the permission of the connection', async () => {
    plc.write('09100:INT', 1)
    await red.deploy([jwConnection(plc), writeNode(), catchNode()])
    expect(await caught('write', { '09100:INT': 5 })).toMatchObject({ code: 'NOT_PERMITTED' })
    expect(plc.read('09100:INT')).toBe(1)
  })

  test('values by address, read back', async () => {
    await red.deploy([jwConnection(plc, everything), writeNode({ readBack: true, convert: true }), catchNode()])
    await send('write', { '09100:INT': -5, '004100': 1, '09110:USINT': '250', '09112:REAL': 0.5 })
    const items = ['09100:INT', '004100', '09110:USINT', '09112:REAL']
    expect(items.map((item) => plc.read(item))).toEqual([-5, true, 250, 0.5])
  })

  test('whole numbers as names are refused where JavaScript would change their order', async () => {
    await red.deploy([jwConnection(plc, everything), writeNode(), catchNode()])
    expect(await caught('write', { '004100': true, '19000': 3 })).toMatchObject({
      code: 'BAD_INPUT',
      message: expect.stringContaining('"19000:BYTE"'),
    })
    await send('write', { '004100': true, '19000:BYTE': 3 })
    expect(plc.read('19000:BYTE')).toBe(3)
    await send('write', { '19000': 4 })
    expect(plc.read('19000:BYTE')).toBe(4)
  })

  test('what the write mode of the PLC forbids is told with its result code', async () => {
    const unit = await startJw({ writeMode: 0 })
    try {
      await red.deploy([jwConnection(unit, everything), writeNode(), catchNode()])
      expect(await caught('write', { '09100:INT': 5 })).toMatchObject({
        code: 'END_CODE',
        cause: { endCode: 0x10, family: 'jw', meaning: expect.any(String) },
      })
    } finally {
      await red.deploy([])
      await unit.close()
    }
  })
})

describe('control', () => {
  const flow = (more = {}, node = {}) => [jwConnection(plc, more), controlNode({ version: 2, ...node }), catchNode()]

  test('stops and releases the PLC, verified', async () => {
    await red.deploy(flow(everything, { verify: true }))
    expect((await send('control', 'stop')).payload).toEqual({ command: 'stop', verified: true })
    expect((await send('control', 'runState')).payload).toEqual({ command: 'runState', state: 'stopped' })
    expect((await send('control', { command: 'release', verify: false })).payload).toEqual({ command: 'release' })
    expect((await send('control', 'runState')).payload).toEqual({ command: 'runState', state: 'running' })
  })

  test('stops and releases a block, by its octal number', async () => {
    await red.deploy(flow(everything, { commandType: 'command', command: 'stopBlock', block: '12' }))
    expect((await send('control', '')).payload).toEqual({ command: 'stopBlock', block: 0o12 })
    await red.deploy(flow(everything))
    const state = (block: unknown) => send('control', { command: 'blockState', block })
    expect((await state('12')).payload).toEqual({ command: 'blockState', block: 0o12, state: 'stopped' })
    await send('control', { command: 'releaseBlock', block: '12' })
    expect((await state(0o12)).payload).toEqual({ command: 'blockState', block: 0o12, state: 'running' })
    expect(await caught('control', { command: 'stopBlock', block: '8' })).toMatchObject({ code: 'BAD_INPUT' })
    expect(await caught('control', 'stopBlock')).toMatchObject({ code: 'BAD_INPUT', cause: { field: 'block' } })
  })

  test('sets write mode and clock', async () => {
    const time = new Date(2026, 0, 31, 12, 30, 5)
    await red.deploy(flow(everything))
    const mode = await send('control', { command: 'setWriteMode', writeMode: 'data' })
    expect(mode.payload).toEqual({ command: 'setWriteMode', writeMode: 'data', before: 'all' })
    await send('control', { command: 'setClock', time: time.getTime() })
    expect((await send('control', 'readClock')).payload).toMatchObject({
      time: { year: 26, month: 1, day: 31, dayOfWeek: 6, hour: 12, minute: 30 },
    })
    expect(await caught('control', { command: 'setClock', time: 'tomorrow' })).toMatchObject({ code: 'BAD_INPUT' })
    await send('control', 'adjustClock')
    await send('control', { command: 'setWriteMode', writeMode: 'all' })
  })

  test('tells what the PLC says of itself without any permission, and changes nothing without it', async () => {
    await red.deploy(flow())
    expect((await send('control', 'identify')).payload).toMatchObject({
      command: 'identify',
      memorySize: { kiloWords: expect.any(Number) },
      runState: 'running',
      writeMode: 'all',
    })
    expect((await send('control', 'selfTest')).payload).toMatchObject({ roundTrip: expect.any(Number) })
    for (const command of ['stop', 'release', 'setWriteMode', 'setClock', 'adjustClock']) {
      expect(await caught('control', command)).toMatchObject({ code: 'NOT_PERMITTED', cause: { outcome: 'notSent' } })
    }
  })

  test.each(['run', 'pause', 'reset', 'latchClear', 'toString'])('has no %s', async (command) => {
    await red.deploy(flow(everything))
    expect(await caught('control', command)).toMatchObject({
      code: 'BAD_INPUT',
      message: expect.stringContaining('releaseBlock'),
    })
  })
})

describe('requests', () => {
  const asked = (command: string, message: object, more = {}) => [
    jwConnection(plc, more),
    requestNode({ mode: 'command', command, messageType: 'json', message: JSON.stringify(message) }),
    catchNode(),
  ]

  test('any command by name, with operands as addresses', async () => {
    plc.write('09000:BYTE', 1)
    plc.write('09001:BYTE', 0xab)
    await red.deploy(asked('readDataMemory', { head: '09000', length: 2 }))
    expect((await send('request', '')).payload).toEqual({ data: Buffer.from([1, 0xab]) })
  })

  test.each([
    ['fillDataMemory', { head: '09000', length: 4, value: 1 }, 'Allow writing'],
    ['setRunState', { state: 1 }, 'Allow remote control'],
    ['setSecretFunction', { function: 1 }, 'Allow parameters'],
  ])('%s needs its permission', async (command, message, what) => {
    await red.deploy(asked(command, message))
    expect(await caught('request', '')).toMatchObject({
      code: 'NOT_PERMITTED',
      message: expect.stringContaining(what),
    })
    expect(plc.cpu.state).toBe('RUN')
  })

  test('a message that the command does not take is refused at the deploy', async () => {
    await red.deploy(asked('readDataMemory', { head: 'D100', length: 2 }))
    expect(await caught('request', '')).toMatchObject({ code: 'BAD_ADDRESS' })
  })
})

describe('what a JW does not have', () => {
  test.each([
    ['ondemand', ondemandNode(), 'On-demand'],
    ['file', fileNode({ action: 'read' }), 'files'],
    ['request', requestNode({ mode: 'memory' }), 'buffer memory'],
  ])('the %s node says so when it is deployed', async (id, node, what) => {
    await red.deploy([jwConnection(plc), node])
    expect(await red.status(id, { fill: 'red' })).toMatchObject({ code: 'UNSUPPORTED' })
    const said = red.log.filter(({ level }) => level === 'error').map(({ text }) => JSON.stringify(text))
    expect(said.join()).toContain(`A Sharp JW has no ${what}`)
  })
})

describe('the editor asks', () => {
  const post = async (path: string, body: object) => (await red.http('POST', path, body)).json()

  test('what items are, in octal, before anything is deployed', async () => {
    const settings = { family: 'jw', model: 'jw300' }
    const items = ['09012:INT', '004033', '09018', 'E0000', 'D100', 'TMR0012:BOOL'].map((address) => ({
      address,
      type: '',
    }))
    expect(await post('melsec-jw/address/check', { settings, items })).toEqual({
      results: [
        { ok: true, text: '09012:INT', type: 'INT', place: expect.any(String), where: expect.any(Object) },
        expect.objectContaining({ ok: true, type: 'BOOL', where: { in: 'file', file: '0', at: '000403', bit: 3 } }),
        { ok: false, message: expect.stringContaining('octal') },
        { ok: false, message: expect.any(String) },
        { ok: false, message: expect.any(String) },
        expect.objectContaining({ ok: true, where: { in: 'timer', at: '0012' } }),
      ],
    })
    const assumed = { ...settings, areas: 'assumed' }
    expect(
      await post('melsec-jw/address/check', { settings: assumed, items: [{ address: 'E0000', type: '' }] }),
    ).toEqual({ results: [expect.objectContaining({ ok: true })] })
    const own = { ...settings, areas: 'own', ownAreas: '[{"first":"E0000","last":"E0777","file":1,"address":0}]' }
    expect(await post('melsec-jw/address/check', { settings: own, items: [{ address: 'E0000', type: '' }] })).toEqual({
      results: [expect.objectContaining({ where: expect.objectContaining({ file: '1' }) })],
    })
  })

  test('whether a command takes a message', async () => {
    const settings = { family: 'jw' }
    const check = (command: string, message: string) => post('melsec-jw/request/check', { settings, command, message })
    expect(await check('readDataMemory', '{"head":"09000","length":4}')).toEqual({ ok: true })
    expect(await check('readDataMemory', '{"head":"09000","length":5000}')).toMatchObject({ ok: false })
    expect(await check('readWords', '{}')).toMatchObject({ ok: false })
    const older = { settings: { family: 'jw', model: 'jw30h' }, command: 'monitorRegisters', message: '{"items":[]}' }
    expect(await post('melsec-jw/request/check', older)).toEqual({
      ok: false,
      message: 'Monitor registers (27H) does not exist on JW30H, only on JW300.',
    })
  })

  test('for a test: what the PLC says of itself and how fast it answers', async () => {
    const settings = jwSettings(plc)
    expect(await post('melsec-jw/connection/test', { id: 'new', settings })).toMatchObject({
      ok: true,
      jw: { memorySize: { kiloWords: expect.any(Number) }, runState: 'running', writeMode: 'all' },
      roundTrip: { count: 10, mean: expect.any(Number) },
    })
  })

  test('for the header, when the wrong one is answered by silence', async () => {
    const unit = await startJw({ header: 'zero40' })
    try {
      const settings = jwSettings(unit, { timeout: '300' })
      const failed = (await post('melsec-jw/connection/test', { id: 'new', settings })) as { causes: string[] }
      expect(failed).toMatchObject({ ok: false, code: 'SILENT', mayFind: true })
      expect(failed.causes[0]).toContain('another header')
      expect(await post('melsec-jw/connection/find', { id: 'new', settings })).toEqual({
        ok: true,
        headers: [{ header: 'zero40' }],
      })
    } finally {
      await unit.close()
    }
  })

  test('what is wrong with settings of a JW, and nothing of MELSEC', async () => {
    const failing = async (more: Readonly<Record<string, unknown>>) =>
      post('melsec-jw/connection/test', { id: 'new', settings: jwSettings(plc, more) })
    expect(await failing({ header: 'relay' })).toMatchObject({
      code: 'NOT_CONFIGURED',
      message: expect.stringMatching(/PDA/),
    })
    expect(await failing({ header: 'bytes', headerBytes: '0G' })).toMatchObject({ code: 'NOT_CONFIGURED' })
    expect(await failing({ areas: 'own', ownAreas: '{' })).toMatchObject({ code: 'NOT_CONFIGURED' })
    expect(await failing({ family: 'omron' })).toMatchObject({ code: 'NOT_CONFIGURED' })
    // What is left of MELSEC in the dialog is not looked at.
    expect(await failing({ profile: 'no such', way: 'serial', frame: 'xy', code: '?' })).toMatchObject({ ok: true })
  })
})
