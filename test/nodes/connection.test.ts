/** The connection node: shared, in the background, through deploys, failures and wrong settings. */
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { profileIds, profiles } from '../../src/index'
import { type FlowNode, type Message, type NodeRed, startNodeRed } from '../support/node-red'
import {
  type CaughtError,
  catchNode,
  connectionTo,
  controlNode,
  portOf,
  readNode,
  startPlc,
  variable,
  writeNode,
} from './flow'

let red: NodeRed
let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc()
  plc.write('D100', 42)
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
})

afterEach(async () => {
  plc.faults.clear()
  await red.deploy([])
  red.forget()
})

const read = (more: object = {}) => readNode(['D100'], { output: 'value', ...more })

async function value(): Promise<unknown> {
  await red.receive('read', {})
  const { payload } = await red.next('read')
  expect(await red.completed('read')).not.toHaveProperty('error')
  return payload
}

async function caught(): Promise<CaughtError> {
  await red.receive('read', {})
  expect(await red.completed('read')).toHaveProperty('error')
  return ((await red.next('catch')) as Message & { error: CaughtError }).error
}

/** Resolves when the simulated PLC has as many connections. */
function connections(count: number): Promise<void> {
  return new Promise((resolve) => {
    const look = (): void => {
      if (plc.connections.length !== count) return
      ended()
      resolve()
    }
    const ended = plc.on('connection', look)
    look()
  })
}

describe('one connection', () => {
  test('is made in the background and shared by its users', async () => {
    await red.deploy([connectionTo(plc), read(), writeNode(), controlNode()])
    for (const id of ['read', 'write', 'control']) {
      await red.status(id, { fill: 'green', shape: 'dot', text: 'connected' })
    }
    expect(plc.connections).toHaveLength(1)
    expect(red.log.filter(({ id }) => id !== undefined)).toEqual([])
  })

  test('is not made without users, and given back when the last one goes', async () => {
    await red.deploy([connectionTo(plc)])
    expect(plc.connections).toHaveLength(0)
    await red.deploy([connectionTo(plc), read()], 'nodes')
    await connections(1)
    expect(await value()).toBe(42)
    await red.deploy([connectionTo(plc)], 'nodes')
    await connections(0)
    await red.deploy([connectionTo(plc), read()], 'nodes')
    expect(await value()).toBe(42)
  })

  test('lives through a deploy that does not touch it', async () => {
    await red.deploy([connectionTo(plc), read()])
    expect(await value()).toBe(42)
    const made = plc.statistics.connections
    for (const property of ['payload', 'value', 'payload']) {
      await red.deploy([connectionTo(plc), read({ property })], 'nodes')
      await red.receive('read', {})
      expect(await red.next('read')).toMatchObject({ [property]: 42 })
      await red.completed('read')
    }
    await red.deploy([connectionTo(plc), read(), writeNode()], 'flows')
    await red.status('write', { fill: 'green' })
    expect(plc.statistics.connections).toBe(made)
  })

  test('follows its settings', async () => {
    const other = await startPlc({ profile: 'iq-f' })
    other.write('D100', 7)
    await red.deploy([connectionTo(plc), read()])
    expect(await value()).toBe(42)
    await red.deploy([connectionTo(other), read()], 'nodes')
    expect(await value()).toBe(7)
    await connections(0)
    await red.deploy([])
    await other.close()
  })

  test.each([
    ['tcp', 'binary'],
    ['tcp', 'ascii'],
    ['udp', 'binary'],
    ['udp', 'ascii'],
  ] as const)('over %s in %s code', async (transport, code) => {
    const other = await startPlc({ code })
    other.write('D100', 8)
    const port = String(other[transport]?.port)
    await red.deploy([connectionTo(other, { transport, code, port }), read()])
    await red.status('read', { fill: 'green' })
    expect(await value()).toBe(8)
    await red.deploy([])
    await other.close()
  })

  test('takes host and port from the environment of its flow', async () => {
    const env = [
      { name: 'PLC_HOST', value: '127.0.0.1', type: 'str' },
      { name: 'PLC_PORT', value: portOf(plc), type: 'str' },
      { name: 'LAST', value: '1', type: 'num' },
    ]
    const tab = { id: 'tab', type: 'tab', label: 'Line 1', env }
    const settings = { z: 'tab', port: variable('PLC_PORT') }
    await red.deploy([tab, connectionTo(plc, { ...settings, host: variable('PLC_HOST') }), { ...read(), z: 'tab' }])
    expect(await value()).toBe(42)
    await red.deploy([
      tab,
      connectionTo(plc, { ...settings, host: `127.0.0.${variable('LAST')}` }),
      { ...read(), z: 'tab' },
    ])
    expect(await value()).toBe(42)
  })
})

test('50 deploys of every kind leave no connection, socket, timer or listener', async () => {
  const flow = (round: number): FlowNode[] => [
    connectionTo(plc, { timeout: String(8000 + (round % 3)) }),
    read({ name: `round ${round}` }),
    writeNode({ name: `round ${round}` }),
    controlNode(),
  ]
  await red.deploy(flow(0))
  expect(await value()).toBe(42)
  const before = await red.resources()
  for (let round = 1; round <= 50; round++) {
    await red.deploy(flow(round), (['full', 'flows', 'nodes'] as const)[round % 3])
    expect(await value()).toBe(42)
  }
  await connections(1)
  const after = await red.resources()
  expect(after.listeners).toBe(before.listeners)
  expect(after.active.TCPSocketWrap ?? 0).toBeLessThanOrEqual(before.active.TCPSocketWrap ?? 0)
  expect(after.active.Timeout ?? 0).toBeLessThanOrEqual((before.active.Timeout ?? 0) + 1)
  await red.deploy([])
  await connections(0)
}, 120_000)

describe('a PLC', () => {
  test('that goes and comes back is read again without a deploy', async () => {
    await red.deploy([connectionTo(plc), read(), catchNode()])
    expect(await value()).toBe(42)
    // Longer than the first pause: a read may wait for one attempt, and only when that fails it is told so.
    plc.restart(1500)
    await red.status('read', { fill: 'red' })
    const { code, cause } = await caught()
    expect(['OFFLINE', 'DISCONNECTED', 'CONNECT_FAILED', 'ENTRY_BUSY']).toContain(code)
    expect(cause.outcome).toMatch(/notSent|unknown/)
    await red.status('read', { fill: 'green' })
    plc.write('D100', 43)
    expect(await value()).toBe(43)
    plc.write('D100', 42)
  })

  test('that is silent is an error with ranked causes, and shown', async () => {
    plc.faults.add({ kind: 'silence' })
    await red.deploy([connectionTo(plc, { timeout: '1000' }), read(), catchNode()])
    const { code, cause } = await caught()
    expect(['SILENT', 'TIMEOUT', 'OFFLINE']).toContain(code)
    expect(cause.causes).toEqual(expect.arrayContaining([expect.stringContaining('ASCII')]))
    await red.status('read', { fill: 'red' })
    plc.faults.clear()
    await red.status('read', { fill: 'green' })
    expect(await value()).toBe(42)
  })

  test('whose entries are all taken is shown as such', async () => {
    const fault = plc.faults.add({ kind: 'closeOnAccept' })
    await red.deploy([connectionTo(plc), read()])
    await red.status('read', { fill: 'red', text: 'PLC port is in use' })
    fault.remove()
    await red.status('read', { fill: 'green' })
  })

  test('that is not there does not fill the log', async () => {
    await red.deploy([connectionTo(plc, { port: '1' }), read(), catchNode()])
    await red.status('read', { fill: 'red', text: 'not reached' })
    for (let round = 0; round < 5; round++) await caught()
    expect(red.log.filter(({ level }) => level === 'warn')).toHaveLength(1)
    expect(red.log.filter(({ level }) => level === 'error')).toEqual([])
  })

  test('a deploy waits for a write that is under way', async () => {
    plc.faults.add({ kind: 'delay', ms: 300, commands: ['writeWords', 'writeRandomWords'] })
    const flow = (timeout: string) => [connectionTo(plc, { allowWrites: true, timeout }), writeNode(), catchNode()]
    await red.deploy(flow('8000'))
    await red.status('write', { fill: 'green' })
    const written = new Promise((resolve) => plc.on('write', resolve))
    await red.receive('write', { payload: { D110: 5 } })
    await written
    await red.deploy(flow('8001'))
    expect(await red.completed('write')).not.toHaveProperty('error')
    expect(plc.read('D110')).toBe(5)
  })

  test('that never answers a write does not hold a deploy up, and its outcome is told', async () => {
    await red.deploy([connectionTo(plc, { allowWrites: true, timeout: '60000' }), writeNode(), catchNode()])
    await red.status('write', { fill: 'green' })
    plc.faults.add({ kind: 'drop', commands: ['writeWords', 'writeRandomWords'] })
    const written = new Promise((resolve) => plc.on('write', resolve))
    await red.receive('write', { payload: { D110: 6 } })
    await written
    await red.deploy([])
    const { error } = await red.completed('write')
    expect(error).toMatchObject({ code: 'CLOSED', outcome: 'unknown' })
  }, 30_000)

  test('a deploy ends reads that are under way, without an error', async () => {
    await red.deploy([connectionTo(plc), read(), catchNode()])
    expect(await value()).toBe(42)
    plc.faults.add({ kind: 'silence' })
    await red.receive('read', {})
    await red.deploy([connectionTo(plc, { timeout: '8001' }), read(), catchNode()])
    expect(await red.completed('read')).not.toHaveProperty('error')
    expect(red.pending('catch')).toEqual([])
  })
})

describe('a remote password', () => {
  let locked: PlcSimulator

  beforeAll(async () => {
    locked = createPlcSimulator({ profile: 'iq-r', password: 'Secret-1' })
    await locked.listen()
    locked.write('D100', 43)
  })
  afterAll(() => locked.close())

  test('is a credential: it unlocks the PLC and is not in the flow', async () => {
    await red.deploy([connectionTo(locked, { credentials: { password: 'Secret-1' } }), read(), catchNode()])
    expect(await value()).toBe(43)
    expect((await red.http('GET', 'flows')).text).not.toContain('Secret')
    expect((await red.http('GET', 'credentials/melsec-jw-connection/plc')).json()).toEqual({ has_password: true })
  })

  test('that is wrong is sent once', async () => {
    const before = locked.statistics.refusals
    await red.deploy([connectionTo(locked, { credentials: { password: 'Secret-2' } }), read(), catchNode()])
    for (let i = 0; i < 3; i++) {
      const error = await caught()
      expect(error.message).toContain('C810')
      expect(JSON.stringify(error)).not.toContain('Secret')
    }
    expect(locked.statistics.refusals - before).toBe(1)
  })
})

describe('wrong settings', () => {
  test.each([
    ['no host', { host: '' }, 'Host'],
    ['a port that is no number', { port: 'x' }, 'Port'],
    ['a port beyond the last', { port: '70000' }, 'port'],
    ['no series', { profile: '' }, 'series'],
    ['an unknown series', { profile: 'fx' }, 'series'],
    ['a variable that is not set', { host: variable('NOT_SET') }, 'NOT_SET'],
    ['a frame that the series lacks', { profile: 'iq-f', frame: '4E' }, '3E'],
    ['a timer that is no multiple of 250', { monitoringTimer: '100' }, '250'],
    ['a route that does not exist', { network: '240' }, '240'],
    ['a station that the frame cannot say', { network: '1', station: '300' }, 'station extension frame'],
    ['a module number that is not hexadecimal', { moduleIo: 'xyz' }, 'hexadecimal'],
    ['pipelining over TCP', { inFlight: '2' }, 'UDP'],
    ['a host that is no text', { host: { name: 'plc' } }, 'Host'],
  ])('%s: told by status, log and Catch, and Node-RED lives', async (_what, settings, told) => {
    await red.deploy([connectionTo(plc, settings), read(), catchNode()])
    await red.status('read', { fill: 'red', text: 'bad settings' })
    const error = await caught()
    expect(error.message.toLowerCase()).toContain(told.toLowerCase())
    expect(error.cause).toMatchObject({ outcome: 'notSent' })
    expect(red.log).toContainEqual(expect.objectContaining({ level: 'error', id: 'plc' }))
    expect(red.completions.filter(({ id }) => id === 'read')).toHaveLength(1)
  })

  test.each([
    ['no connection', { connection: '' }],
    ['a connection that is something else', { connection: 'catch' }],
    ['no rows', { items: [] }],
    ['a row without an address', { items: [{ name: 'level', address: '', type: '' }] }],
    ['two rows of one name', { items: [1, 2].map((n) => ({ name: 'level', address: `D${n}`, type: '' })) }],
    ['rows that are no list', { items: 'D100' }],
    ['an unknown output', { output: 'table' }],
    ['a version of the future', { version: 99 }],
  ])('of the node, %s: told by status, log and Catch', async (_what, settings) => {
    await red.deploy([connectionTo(plc), read(settings), catchNode()])
    await red.status('read', { fill: 'red', text: 'bad settings' })
    expect(await caught()).toMatchObject({ code: 'NOT_CONFIGURED', cause: { outcome: 'notSent' } })
    expect(red.log).toContainEqual(expect.objectContaining({ level: 'error', id: 'read' }))
  })

  test('are gone with the next deploy', async () => {
    await red.deploy([connectionTo(plc, { host: '' }), read()])
    await red.status('read', { fill: 'red' })
    await red.deploy([connectionTo(plc), read()])
    expect(await value()).toBe(42)
  })
})

describe('the address check of the editor', () => {
  const check = async (settings: object, items: readonly object[]) => {
    const answer = await red.http('POST', 'melsec-jw/address/check', { settings, items })
    return { status: answer.status, body: answer.json() as { results?: readonly Record<string, unknown>[] } }
  }

  test('tells range, words and radix, or what to write instead', async () => {
    const { body } = await check({ profile: 'iq-r' }, [
      { address: 'D100', type: 'REAL' },
      { address: 'X1F', type: '' },
      { address: 'Q5', type: '' },
    ])
    expect(body.results?.[0]).toMatchObject({ ok: true, first: 'D100', last: 'D101', size: { count: 2, unit: 'word' } })
    expect(body.results?.[1]).toMatchObject({ ok: true, device: 'X', radix: 16 })
    expect(body.results?.[2]).toMatchObject({ ok: false, message: expect.stringContaining('Q5') })
  })

  test('numbers X and Y as the connection does', async () => {
    const octal = (
      await check({ profile: 'iq-f' }, [
        { address: 'X17', type: '' },
        { address: 'X8', type: '' },
      ])
    ).body
    expect(octal.results).toMatchObject([{ ok: true, radix: 8 }, { ok: false }])
    const overridden = (await check({ profile: 'iq-f', xyRadix: '16' }, [{ address: 'X8', type: '' }])).body
    expect(overridden.results).toMatchObject([{ ok: true, radix: 16 }])
  })

  test('numbers W as the connection does', async () => {
    const items = [
      { address: 'W902', type: '' },
      { address: 'W1F', type: '' },
    ]
    const usual = (await check({ profile: 'generic' }, items)).body
    expect(usual.results).toMatchObject([{ ok: true, radix: 16 }, { ok: true }])
    const decimal = (await check({ profile: 'generic', wRadix: '10' }, items)).body
    expect(decimal.results).toMatchObject([{ ok: true, radix: 10, first: 'W902' }, { ok: false }])
  })

  test('takes labels where the series has them, and says what to write for one that looks like a device', async () => {
    const items = ['Line1.Speed', 'Line1.Values[0]:INT[10]', 'label:DD100', 'DD100'].map((address) => ({
      address,
      type: '',
    }))
    const typed = { address: 'Line1.Speed', type: 'REAL' }
    const { results } = (await check({ profile: 'iq-r' }, [...items, typed])).body
    expect(results).toMatchObject([
      { ok: true, label: 'Line1.Speed' },
      { ok: true, label: 'Line1.Values[0]', type: 'INT', count: 10 },
      { ok: true, label: 'DD100' },
      { ok: false, message: expect.stringContaining('label:DD100') },
      { ok: true, label: 'Line1.Speed', type: 'REAL' },
    ])
    const other = (await check({ profile: 'iq-f' }, items)).body.results
    expect(other?.map(({ ok }) => ok)).toEqual([false, false, false, false])
    expect(other?.[0]).toMatchObject({ message: expect.stringContaining('iQ-R only') })
  })

  test.each([
    ['no items', {}],
    ['rubbish', { items: 5 }],
    ['too many', { items: Array.from({ length: 1001 }, () => ({})) }],
  ])('%s is a bad request', async (_what, body) => {
    expect((await red.http('POST', 'melsec-jw/address/check', body)).status).toBe(400)
  })

  test('odd items and settings are answered, not thrown', async () => {
    const { status, body } = await check({ profile: 'nonsense' }, [{ address: 5 }, { address: 'D1' }])
    expect(status).toBe(200)
    expect(body.results).toMatchObject([{ ok: false }, { ok: false }])
    expect((await check({}, [{ address: 5 }])).body.results).toMatchObject([{ ok: false }])
    expect((await check({}, [{ address: 'D'.repeat(600) }])).body.results).toMatchObject([{ ok: false }])
  })
})

describe('the connection test of the editor', () => {
  const settings = (more: object = {}) => ({ host: '127.0.0.1', port: portOf(plc), profile: 'iq-r', ...more })
  const run = async (body: object) => {
    const answer = await red.http('POST', 'melsec-jw/connection/test', body)
    return { status: answer.status, body: answer.json() as Record<string, unknown> }
  }

  test('identifies the CPU and measures the round trip of settings that are not deployed', async () => {
    const { body } = await run({ id: 'nobody', settings: settings({ profile: '' }) })
    expect(body).toMatchObject({ ok: true, model: 'R08CPU', profile: 'iq-r', roundTrip: { count: 10 } })
    await connections(0)
  })

  test('warns of an inverter that may number W in decimal, unless that is set', async () => {
    const inverter = await startPlc({ profile: 'generic', model: { name: 'FR-E800-E', code: 0x054f } })
    const own = { ...connectionTo(inverter), profile: 'generic' }
    expect((await run({ settings: own })).body).toMatchObject({ ok: true, warning: { code: 'W_RADIX' } })
    expect((await run({ settings: { ...own, wRadix: '10' } })).body).not.toHaveProperty('warning')
    await inverter.close()
  })

  test('measures the round trip to the connected station, whatever the route', async () => {
    const { body } = await run({ settings: settings({ network: '1', station: '3' }) })
    expect(body).toMatchObject({ ok: true, unidentified: expect.any(String), roundTrip: { count: 10 } })
  })

  test('uses the running connection when that is what is tested', async () => {
    const taken = await startPlc({ maxConnections: 1 })
    await red.deploy([connectionTo(taken), read()])
    await red.status('read', { fill: 'green' })
    const own = connectionTo(taken)
    expect((await run({ id: 'plc', settings: own })).body).toMatchObject({ ok: true, model: 'R08CPU' })
    const ticked = { ...own, allowWrites: true, gap: '0' }
    expect((await run({ id: 'plc', settings: ticked })).body).toMatchObject({ ok: true, model: 'R08CPU' })
    expect((await run({ id: 'plc', settings: { ...own, frame: '3E' } })).body).toMatchObject({
      ok: false,
      code: 'ENTRY_BUSY',
      causes: [expect.stringContaining('deployed')],
    })
    await red.deploy([])
    await taken.close()
  })

  const byEthernet = profileIds.filter((id) => profiles[id].serial === undefined)

  test.each(byEthernet)('series %s answers', async (profile) => {
    const other = await startPlc({ profile })
    const { body } = await run({ settings: settings({ port: portOf(other), profile }) })
    expect(body).toMatchObject({ ok: true, roundTrip: { mean: expect.any(Number) } })
    await other.close()
  })

  test('a wrong data code is explained with ranked causes', async () => {
    const { body } = await run({ settings: settings({ code: 'ascii' }) })
    expect(body).toMatchObject({ ok: false, causes: expect.arrayContaining([expect.stringMatching(/binary/i)]) })
  })

  test('nobody there, and settings that cannot be', async () => {
    expect((await run({ settings: settings({ port: '1' }) })).body).toMatchObject({ ok: false, code: 'CONNECT_FAILED' })
    expect((await run({ settings: settings({ port: '' }) })).body).toMatchObject({ ok: false, code: 'NOT_CONFIGURED' })
    expect((await run({ settings: settings({ host: variable('NOT_SET') }) })).body).toMatchObject({ ok: false })
    expect((await run({})).body).toMatchObject({ ok: false })
    expect((await red.http('POST', 'melsec-jw/connection/test', [])).status).toBe(400)
    expect((await run({ settings: { host: 'x'.repeat(200_000) } })).status).toBe(413)
  })

  test('runs one at a time', async () => {
    plc.faults.add({ kind: 'delay', ms: 200 })
    const first = run({ settings: settings() })
    await connections(1)
    expect((await run({ settings: settings() })).status).toBe(409)
    expect((await first).body).toMatchObject({ ok: true })
    expect((await run({ settings: settings() })).status).toBe(200)
  }, 30_000)
})
