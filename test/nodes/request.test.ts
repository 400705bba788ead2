/** The request node in a real Node-RED, against a simulated PLC: any command, and buffer memory of modules. */
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import { commands, jwCommands } from '../../src/entry/codec'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { readText } from '../support/syntax'
import { type CaughtError, catchNode, connectionTo, requestNode, startPlc } from './flow'

let red: NodeRed
let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc({
    bufferMemory: 1024,
    extensions: { modules: [{ unit: 3, points: 1024, model: 'Q62DA' }] },
  })
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

afterEach(() => {
  plc.memory.clear()
  red.forget()
})

type Settings = Readonly<Record<string, unknown>>

const command = (name: string, message: unknown, more: Settings = {}) =>
  requestNode({ mode: 'command', command: name, message: JSON.stringify(message), messageType: 'json', ...more })

async function send(message: Settings = {}): Promise<Message> {
  await red.receive('request', message)
  const answer = await red.next('request')
  expect(await red.completed('request')).not.toHaveProperty('error')
  return answer
}

async function caught(message: Settings = {}): Promise<Message & { error: CaughtError }> {
  await red.receive('request', message)
  expect(await red.completed('request')).toHaveProperty('error')
  return (await red.next('catch')) as Message & { error: CaughtError }
}

describe('any command', () => {
  test('the payload becomes the answer, the rest of the message stays', async () => {
    plc.write('D100', 7)
    await red.deploy([connectionTo(plc), command('readWords', { head: 'D100', points: 2 })])
    expect(await send({ _msgid: 'a', topic: 'level', payload: 'x' })).toEqual({
      _msgid: 'a',
      topic: 'level',
      payload: { values: [7, 0] },
    })
  })

  test('the message of the command comes out of the message of the flow', async () => {
    plc.write('D5', 55)
    await red.deploy([connectionTo(plc), command('readWords', '', { message: 'payload', messageType: 'msg' })])
    expect((await send({ payload: { head: 'D5', points: 1 } })).payload).toEqual({ values: [55] })
    expect((await send({ payload: { head: { device: 'D', number: 5 }, points: 1 } })).payload).toEqual({ values: [55] })
  })

  test('a registration is read in one go', async () => {
    plc.write('D5', 55)
    const message = { entryMonitorDevice: { words: [{ device: 'D5' }], doubleWords: [] } }
    await red.deploy([connectionTo(plc), command('executeMonitor', message)])
    expect((await send()).payload).toEqual({ words: [55], doubleWords: [] })
  })

  test('bytes are a Buffer', async () => {
    const message = { address: 0x1008, byteCount: 2, moduleNumber: 3 }
    await red.deploy([connectionTo(plc), command('readExtendUnit', message)])
    expect((await send()).payload).toEqual({ data: Buffer.from([0, 0]) })
  })

  test.each([
    ['writeWords', { head: 'D0', values: [5] }, 'allowWrites'],
    ['remoteStop', {}, 'allowControl'],
  ])('%s needs the tick of the connection', async (name, message, tick) => {
    await red.deploy([connectionTo(plc), command(name, message), catchNode()])
    expect((await caught()).error).toMatchObject({ code: 'NOT_PERMITTED', cause: { outcome: 'notSent' } })
    await red.deploy([connectionTo(plc, { [tick]: true }), command(name, message)])
    expect((await send()).payload).toEqual({})
  })

  test('what the PLC refuses has its end code', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0xc059, commands: ['clearError'] })
    await red.deploy([connectionTo(plc, { allowControl: true }), command('clearError', {}), catchNode()])
    expect((await caught()).error).toMatchObject({ code: 'END_CODE', cause: { endCode: 0xc059, outcome: 'refused' } })
    plc.faults.clear()
  })

  test.each([
    [{ points: 1 }, /head: is missing; it takes a device/],
    [{ head: 'D0', points: 1, extra: 1 }, /extra: is not a field/],
    [5, /is an object with head, points/],
  ])('a wrong message %j is refused at the deploy and for each message', async (message, says) => {
    await red.deploy([connectionTo(plc), command('readWords', message), catchNode()])
    const { error } = await caught()
    expect(error.message).toMatch(says)
    expect(error).toMatchObject({ code: 'BAD_MESSAGE', cause: { outcome: 'notSent' } })
  })

  test('a wrong message out of the flow is refused, and the next one works', async () => {
    const node = command('readWords', '', { message: 'payload', messageType: 'msg' })
    await red.deploy([connectionTo(plc), node, catchNode()])
    for (const payload of [undefined, null, 'D0', [1], { head: 'D0' }]) {
      expect((await caught({ payload })).error).toMatchObject({ code: 'BAD_MESSAGE', cause: { outcome: 'notSent' } })
    }
    expect((await send({ payload: { head: 'D0', points: 1 } })).payload).toEqual({ values: [0] })
  })

  test('what is no JSON and an unknown command are refused', async () => {
    await red.deploy([connectionTo(plc), command('readWords', '', { message: '{"password":"hush' }), catchNode()])
    const { error } = await caught()
    expect(error.code).toBe('NOT_CONFIGURED')
    expect(JSON.stringify(error)).not.toContain('hush')
    await red.deploy([connectionTo(plc), command('readWord', {}), catchNode()])
    expect((await caught()).error.message).toContain('There is no command "readWord"')
  })
})

describe('a connection with a route to another station', () => {
  const elsewhere = (more: Settings = {}) => connectionTo(plc, { network: '1', station: '3', ...more })

  test('what is for the connected station goes there', async () => {
    await red.deploy([elsewhere(), command('selfTest', { data: 'AB' })])
    expect((await send()).payload).toEqual({ data: 'AB' })
    await red.deploy([
      elsewhere(),
      requestNode({ mode: 'memory', access: 'read', addressType: 'num', pointsType: 'num', address: '5', points: '1' }),
    ])
    expect((await send()).payload).toEqual([0])
  })

  test('everything else does not', async () => {
    await red.deploy([elsewhere(), command('readWords', { head: 'D0', points: 1 }), catchNode()])
    expect((await caught()).error).toMatchObject({ code: 'END_CODE', cause: { outcome: 'refused' } })
  })
})

describe('buffer memory', () => {
  const memory = (more: Settings) => requestNode({ mode: 'memory', addressType: 'num', pointsType: 'num', ...more })
  const q62da = { mode: 'module', model: 'Q62DA', startIo: '0030' }

  test('of the connected module is written and read', async () => {
    const node = memory({ access: 'write', address: '0x10', values: 'payload', valuesType: 'msg' })
    await red.deploy([connectionTo(plc, { allowWrites: true }), node])
    expect((await send({ payload: [1, 2] })).payload).toEqual([1, 2])
    expect((await send({ payload: 3 })).payload).toBe(3)
    await red.deploy([connectionTo(plc), memory({ access: 'read', address: '16', points: '2' })])
    expect((await send({ payload: 0 })).payload).toEqual([3, 2])
  })

  test('of a module is read by its name, its address out of the message', async () => {
    plc.write('U3\\G1', 100)
    plc.write('U3\\G2', 200)
    const node = memory({ ...q62da, access: 'read', address: 'from', addressType: 'msg', points: '2' })
    await red.deploy([connectionTo(plc), node])
    expect((await send({ from: 1 })).payload).toEqual([100, 200])
  })

  test('writing needs the tick of the connection', async () => {
    const node = memory({ ...q62da, access: 'write', address: '1', values: '[1]', valuesType: 'json' })
    await red.deploy([connectionTo(plc), node, catchNode()])
    expect((await caught()).error.code).toBe('NOT_PERMITTED')
    expect(plc.read('U3\\G1')).toBe(0)
  })

  test.each([
    [{ ...q62da, model: '' }, 'does not know the module'],
    [{ ...q62da, model: 'QD62' }, 'not legible'],
    [{ ...q62da, startIo: 'xyz' }, 'hexadecimal'],
    [{ ...q62da, startIo: '31' }, 'multiple of 16'],
    [{ access: 'read', address: 'x', addressType: 'msg', points: '1' }, 'address'],
    [{ access: 'read', address: '0', points: '1.5' }, 'points'],
    [{ access: 'read', address: '0', points: '481' }, '481'],
  ])('%j is refused', async (more, says) => {
    await red.deploy([connectionTo(plc), memory(more), catchNode()])
    const { error } = await caught({ payload: 1 })
    expect(error.message).toContain(says)
    expect(error.cause).toMatchObject({ outcome: 'notSent' })
  })

  test.each([[{ a: 1 }], ['12'], [[]], [[1, '2']], [undefined], [[65536]], [-1]])(
    '%j is not written',
    async (payload) => {
      const node = memory({ access: 'write', address: '0', values: 'payload', valuesType: 'msg' })
      await red.deploy([connectionTo(plc, { allowWrites: true }), node, catchNode()])
      expect((await caught({ payload })).error.cause).toMatchObject({ outcome: 'notSent' })
    },
  )
})

describe('in the editor', () => {
  test('the commands and modules are those of the library', async () => {
    const settings = (await red.http('GET', 'settings')).json() as {
      melsecJwRequestCommands: Record<'melsec' | 'jw', { name: string }[]>
      melsecJwRequestModules: { model: string; known: boolean }[]
    }
    const names = (family: 'melsec' | 'jw') => settings.melsecJwRequestCommands[family].map(({ name }) => name)
    expect(names('melsec')).toEqual(Object.keys(commands))
    expect(names('jw')).toEqual(Object.keys(jwCommands))
    expect(settings.melsecJwRequestModules).toContainEqual({ model: 'Q62DA', known: true })
    expect(settings.melsecJwRequestModules).toContainEqual({ model: 'QD62', known: false })
  })

  test.each(['en-US', 'ja', 'zh-CN', 'zh-TW'])('every effect of a command has its text in %s', (language) => {
    const catalogue = JSON.parse(readText(`nodes/locales/${language}/melsec-jw-request.json`)) as {
      effect: Record<string, string>
    }
    const effects = new Set([...Object.values(commands), ...Object.values(jwCommands)].map(({ effect }) => effect))
    expect(Object.keys(catalogue.effect).sort()).toEqual([...effects].sort())
  })

  const check = async (body: unknown) => red.http('POST', 'melsec-jw/request/check', body)

  test('a message is checked while it is typed, for the PLC of the connection', async () => {
    const head = (text: string) => JSON.stringify({ head: text, points: 1 })
    const asked = async (profile: string, text: string) =>
      (await check({ settings: { profile }, command: 'readBits', message: head(text) })).json()
    expect(await asked('iq-f', 'X17')).toEqual({ ok: true })
    expect(await asked('iq-f', 'X18')).toMatchObject({ ok: false, message: expect.stringContaining('octal') })
    expect(await asked('', 'X17')).toMatchObject({ ok: false, message: expect.stringContaining('X and Y') })
    expect((await check({ settings: {}, command: 'readBits', message: '{' })).json()).toMatchObject({ ok: false })
    expect((await check({ settings: {}, command: 'nothing', message: '{}' })).json()).toMatchObject({ ok: false })
  })

  test('what is no such question is refused', async () => {
    for (const body of [{}, { command: 5, message: '{}' }, { command: 'readBits', message: {} }]) {
      expect((await check(body)).status).toBe(400)
    }
  })
})
