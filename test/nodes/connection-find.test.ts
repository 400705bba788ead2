/** What the dialog of a connection finds out where the test of it fails: other lines, foreign ports, locked ports. */
import { createServer, type Server, type Socket } from 'node:net'
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import { answeringLines } from '../../nodes/connection-find'
import type { PlcSimulator, PlcSimulatorOptions } from '../../src/entry/simulator'
import { type NodeRed, startNodeRed } from '../support/node-red'
import { connectionTo, portOf, readNode, startPlc, variable } from './flow'

let red: NodeRed
const BOTH_FRAMES = [
  { frame: '3E', code: 'binary' },
  { frame: '4E', code: 'binary' },
] as const
const never = new AbortController().signal
const open: { close(): unknown }[] = []

beforeAll(async () => {
  red = await startNodeRed()
}, 60_000)

afterAll(() => red.stop())

afterEach(async () => {
  await red.deploy([])
  red.forget()
  for (const each of open.splice(0)) await each.close()
})

async function plcWith(options: PlcSimulatorOptions): Promise<PlcSimulator> {
  const plc = await startPlc(options)
  open.push(plc)
  return plc
}

/** Something that is no PLC. @param answer what it does with what it gets */
async function foreign(answer: (socket: Socket, received: Buffer) => void): Promise<string> {
  const sockets = new Set<Socket>()
  const server: Server = createServer((socket) => {
    sockets.add(socket)
    socket.on('error', () => undefined).on('data', (received) => answer(socket, received))
  })
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve))
  open.push({
    close: () => {
      for (const socket of sockets) socket.destroy()
      return new Promise((resolve) => server.close(resolve))
    },
  })
  const address = server.address()
  if (address === null || typeof address === 'string') throw new Error('no port')
  return String(address.port)
}

const settings = (port: string, more: object = {}) => ({ host: '127.0.0.1', port, profile: 'iq-r', ...more })

async function ask(path: 'test' | 'find', body: object): Promise<{ status: number; body: Record<string, unknown> }> {
  const answer = await red.http('POST', `melsec-jw/connection/${path}`, body)
  return { status: answer.status, body: answer.json() as Record<string, unknown> }
}

/** Each takes seconds of waiting for what is not answered, so they run side by side. */
const ANSWERING = [
  [
    { profile: 'iq-f' },
    [
      { frame: '3E', code: 'binary', profile: 'iq-f', model: 'FX5U-32MR/ES' },
      { frame: '1E', code: 'binary', profile: 'iq-f' },
    ],
  ],
  [{ profile: 'fx3', code: 'ascii' }, [{ frame: '1E', code: 'ascii', profile: 'fx3' }]],
  [
    { profile: 'iq-r', code: 'ascii', maxConnections: 1 },
    [
      { frame: '3E', code: 'ascii', profile: 'iq-r', model: 'R08CPU' },
      { frame: '4E', code: 'ascii', profile: 'iq-r', model: 'R08CPU' },
    ],
  ],
  // It does not say who it is, and a locked one tells nobody.
  [{ profile: 'q-built-in' }, BOTH_FRAMES],
  [{ profile: 'iq-r', password: 'Secret-1' }, BOTH_FRAMES],
] as const

describe('the search offers what answered', () => {
  test.each(['tcp', 'udp'] as const)(
    'of every kind of PLC, over %s',
    async (transport) => {
      const answers = ANSWERING.map(async ([options, lines]) => {
        const plc = await plcWith(options)
        const port = plc[transport]?.port ?? 0
        const found = await answeringLines({ host: '127.0.0.1', port, transport, profile: 'iq-r' }, never)
        expect({ options, found }).toEqual({ options, found: lines })
        expect(plc.statistics.turnedAway).toBe(0)
      })
      await Promise.all(answers)
    },
    30_000,
  )

  test('of a device that says nothing to Read Type Name', async () => {
    const plc = await plcWith({ profile: 'iq-f' })
    plc.faults.add({ kind: 'drop', commands: ['readTypeName'] })
    const options = { host: '127.0.0.1', port: Number(portOf(plc)), profile: 'iq-r' } as const
    expect(await answeringLines(options, never)).toEqual([
      { frame: '3E', code: 'binary' },
      { frame: '1E', code: 'binary', profile: 'fx3' },
    ])
  }, 30_000)

  test('by the button, and the test then takes it', async () => {
    const plc = await plcWith({ profile: 'fx3', code: 'ascii' })
    const first = await ask('test', { settings: settings(portOf(plc)) })
    expect(first.body).toMatchObject({ ok: false, mayFind: true })
    const found = await ask('find', { settings: settings(portOf(plc)) })
    const line = { frame: '1E', code: 'ascii', profile: 'fx3' }
    expect(found.body).toEqual({ ok: true, lines: [line] })
    expect((await ask('test', { settings: settings(portOf(plc), line) })).body).toMatchObject({ ok: true })
  }, 30_000)

  test('only reads, and one at a time, as the test', async () => {
    const plc = await plcWith({ profile: 'iq-r' })
    const effects: unknown[] = []
    plc.on('write', (write) => effects.push(write))
    const running = ask('find', { settings: settings(portOf(plc)) })
    await new Promise<void>((resolve) => plc.on('connection', () => resolve()))
    expect((await ask('find', { settings: settings(portOf(plc)) })).status).toBe(409)
    expect((await ask('test', { settings: settings(portOf(plc)) })).status).toBe(409)
    expect((await running).body).toMatchObject({ ok: true })
    expect(effects).toEqual([])
  }, 30_000)

  test('nobody there, nothing known, and settings that cannot be', async () => {
    expect((await ask('find', { settings: settings('1') })).body).toMatchObject({
      ok: false,
      message: expect.stringContaining('127.0.0.1:1'),
      causes: expect.arrayContaining([expect.any(String)]),
    })
    const port = await foreign((socket) => socket.end())
    expect((await ask('find', { settings: settings(port) })).body).toEqual({
      ok: false,
      message: `tcp 127.0.0.1:${port} answers to no frame, neither in binary nor in ASCII code.`,
      causes: [],
    })
    expect((await ask('find', { settings: settings('') })).body).toMatchObject({ ok: false })
    expect((await ask('find', { settings: settings('1', { host: variable('NOT_SET') }) })).body).toMatchObject({
      ok: false,
    })
    expect((await red.http('POST', 'melsec-jw/connection/find', [])).status).toBe(400)
  }, 30_000)

  test('where the deployed connection holds the only entry it says so', async () => {
    const plc = await plcWith({ profile: 'iq-r', maxConnections: 1 })
    await red.deploy([connectionTo(plc), readNode(['D100'])])
    await red.status('read', { fill: 'green' })
    expect((await ask('find', { id: 'plc', settings: settings(portOf(plc)) })).body).toMatchObject({
      ok: false,
      causes: [expect.stringContaining('deployed')],
    })
    await red.status('read', { fill: 'green' })
  })
})

describe('the test names a cause', () => {
  test.each([
    ['a web server', (socket: Socket) => socket.end('HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n')],
    [
      'a Modbus server',
      // The exception of an illegal function, for the transaction number that it takes from the request.
      (socket: Socket, received: Buffer) =>
        socket.write(Buffer.concat([received.subarray(0, 4), Buffer.from([0, 3, 0xff, 0x81, 1])])),
    ],
  ])('for a port of %s', async (_what, answer) => {
    const port = await foreign(answer)
    const { body } = await ask('test', { settings: settings(port) })
    expect(body).toMatchObject({ ok: false, mayFind: true })
    expect((body.causes as string[])[0]).toContain(`port ${port}`)
    expect((body.causes as string[])[0]).toContain('SLMP')
  })

  test('among those of a silence for a port that sends back what it gets: a request is no answer', async () => {
    const port = await foreign((socket, received) => socket.write(received))
    const { body } = await ask('test', { settings: settings(port) })
    expect(body).toMatchObject({ ok: false, mayFind: true })
    expect(body.causes).toContainEqual(expect.stringContaining(`Port ${port} is open for something else`))
  })

  test('for a locked port: where to type the password that an exported flow lacks', async () => {
    const plc = await plcWith({ profile: 'iq-r', password: 'Secret-1' })
    const { body } = await ask('test', { settings: settings(portOf(plc)) })
    expect(body).toMatchObject({ ok: false, endCode: 0xc201 })
    expect(body.causes).toEqual([expect.stringContaining('page Communication')])
    expect(body.message).not.toContain('page Communication')
  })

  test('the true one first for an FX5U that was taken for an iQ-R, and each of them once', async () => {
    const plc = await plcWith({ profile: 'iq-f' })
    const { body } = await ask('test', { settings: settings(portOf(plc)) })
    const { message, causes } = body as { message: string; causes: string[] }
    expect(causes[0]).toContain('try 3E')
    expect(body).toMatchObject({ ok: false, code: 'SILENT', mayFind: true })
    for (const cause of causes) expect(message).not.toContain(cause)
    expect(new Set(causes).size).toBe(causes.length)
  })
})

test('a flow that was imported without its credentials says at its nodes where the password belongs', async () => {
  const plc = await plcWith({ profile: 'iq-r', password: 'Secret-1' })
  await red.deploy([connectionTo(plc), readNode(['D100'])])
  await red.status('read', { fill: 'green' })
  await red.receive('read', {})
  const { error } = await red.completed('read')
  // In the message, which the sidebar and the log show, and as data.
  expect((error as Error).message).toContain('page Communication')
  expect(error).toMatchObject({ code: 'END_CODE', cause: { causes: [expect.stringContaining('Communication')] } })
  expect(await red.status('read', { fill: 'red' })).toMatchObject({ text: 'end code C201', endCode: 0xc201 })
})
