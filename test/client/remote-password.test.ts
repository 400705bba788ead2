// The remote password of a client: unlocked before everything else, locked at the end, a wrong one sent once, never shown.
import { inspect } from 'node:util'
import { afterEach, describe, expect, test } from '@jest/globals'
import type { MelsecClient } from '../../src/client/melsec/client'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { MelsecOptions, NetworkPlc } from '../../src/client/melsec/options'
import { ConnectionError, EndCodeError, PlcError, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/simulator/server'
import { manualClock } from '../support/manual-clock'
import { freePort, settle } from '../transport/recorder'

const PASSWORD = 'Secret-1'
const WRONG = 'Secret-2'
const ended: (() => Promise<void>)[] = []
afterEach(async () => {
  for (const end of ended.splice(0)) await end()
})

interface Pair {
  readonly plc: PlcSimulator
  readonly client: MelsecClient
  /** Command and end code of each request that arrived. */
  readonly seen: string[]
}

/** A client and a PLC on loopback. */
async function pair(
  given: Partial<MelsecOptions & NetworkPlc> = {},
  plcGiven: PlcSimulatorOptions = {},
): Promise<Pair> {
  const { transport = 'tcp' } = given
  const plc = createPlcSimulator({ profile: 'iq-r', password: PASSWORD, ...plcGiven })
  await plc.listen()
  const seen: string[] = []
  plc.on('request', ({ command, endCode }) => void seen.push(`${command} ${endCode?.toString(16).toUpperCase()}`))
  const { host, port } = plc[transport === 'udp' ? 'udp' : 'tcp'] ?? { host: '', port: 0 }
  const options = { host, port, profile: 'iq-r', password: PASSWORD, settleGap: 0, ...given } as const
  const client = createMelsecClient(options)
  ended.push(
    () => client.close(),
    () => plc.close(),
  )
  return { plc, client, seen }
}

async function rejection(promise: Promise<unknown>): Promise<PlcError> {
  const error = await promise.then(
    () => undefined,
    (reason: unknown) => reason,
  )
  if (error instanceof PlcError) return error
  throw new Error(`no PlcError: ${String(error)}`)
}

const MOST_TURNS = 20_000
async function until(condition: () => boolean): Promise<void> {
  for (let turn = 0; !condition(); turn++) {
    if (turn >= MOST_TURNS) throw new Error(`never: ${condition}`)
    await settle()
  }
}

describe.each(['binary', 'ascii'] as const)('over TCP in %s code', (code) => {
  test('it is unlocked before everything else and locked at the end', async () => {
    const { plc, client, seen } = await pair({ code }, { code })
    plc.write('D100', 7)
    expect(await client.read('D100')).toBe(7)
    await client.close()
    expect(seen).toEqual(['unlock 0', 'readTypeName 0', 'readWords 0', 'lock 0'])
    expect(client.state.name).toBe('closed')
  })

  test('it is unlocked anew on each connection', async () => {
    const { plc, client, seen } = await pair({ code, reconnect: { first: 1 } }, { code })
    await client.connect()
    plc.restart(0)
    await until(() => seen.length >= 4 && client.state.name === 'connected')
    expect(seen).toEqual(['unlock 0', 'readTypeName 0', 'unlock 0', 'readTypeName 0'])
    expect(await client.read('D100')).toBe(0)
  })
})

test('4 characters on a Q', async () => {
  const { client, seen } = await pair({ profile: 'q', password: 'abcd' }, { profile: 'q', password: 'abcd' })
  await client.connect()
  await client.close()
  expect(seen).toEqual(['unlock 0', 'readTypeName 0', 'lock 0'])
})

test('it goes to the connected station, also when the client speaks to another one', async () => {
  const { client, seen } = await pair({ route: { network: 1, station: 2 } })
  const error = await rejection(client.read('D100'))
  expect(error).toBeInstanceOf(EndCodeError)
  expect(seen.slice(0, 1)).toEqual(['unlock 0'])
})

test('without a password a locked PLC says so', async () => {
  const { plc } = await pair()
  const { host, port } = plc.tcp ?? { host: '', port: 0 }
  const client = createMelsecClient({ host, port, profile: 'iq-r' })
  ended.push(() => client.close())
  expect(await rejection(client.read('D100'))).toMatchObject({ endCode: 0xc201, outcome: 'refused' })
})

describe('a wrong password', () => {
  test('is sent once, and everything fails at once until it is changed', async () => {
    const { client, seen } = await pair({ password: WRONG, reconnect: { first: 1, longest: 1 } })
    const first = await rejection(client.connect())
    expect(first).toMatchObject({ code: 'END_CODE', endCode: 0xc810 })
    for (let i = 0; i < 3; i++) {
      const error = await rejection(client.read('D100'))
      expect(error).toBeInstanceOf(ConnectionError)
      expect(error).toMatchObject({ code: 'OFFLINE', outcome: 'notSent', cause: first })
      expect(error.message).toContain('setPassword()')
    }
    expect(client.state).toMatchObject({ name: 'waiting', error: first })
    expect(client.state.nextAttempt).toBeUndefined()
    for (let turn = 0; turn < 50; turn++) await settle()
    expect(seen).toEqual(['unlock C810'])

    client.setPassword(PASSWORD)
    expect(await client.read('D100')).toBe(0)
    expect(seen.slice(1)).toEqual(['unlock 0', 'readTypeName 0', 'readWords 0'])
  })

  test('never locks the PLC out, however often the program asks and however long it runs', async () => {
    const clock = manualClock()
    const plc = createPlcSimulator({ profile: 'iq-r', password: PASSWORD, passwordAttempts: 2, clock })
    const client = createMelsecClient({
      host: 'memory',
      port: 1,
      profile: 'iq-r',
      password: WRONG,
      clock,
      openTransport: plc.connect(),
    })
    ended.push(
      () => client.close(),
      () => plc.close(),
    )
    for (let hour = 0; hour < 24; hour++) {
      await rejection(client.read('D100'))
      clock.advance(3_600_000)
      await settle()
    }
    expect(plc.errors.entries.map(({ endCode }) => endCode)).toEqual([0xc810])
  })

  test('corrected while it is just being refused is tried again by itself', async () => {
    const { client, plc } = await pair({ password: WRONG, reconnect: { first: 1 } })
    plc.on('request', ({ endCode }) => {
      if (endCode === 0xc810) client.setPassword(PASSWORD)
    })
    await rejection(client.connect())
    await until(() => client.state.name === 'connected')
    expect(await client.read('D100')).toBe(0)
  })

  test('is tried again after a refusal that is not about it', async () => {
    const { plc, client, seen } = await pair({ reconnect: { first: 1 } })
    plc.faults.add({ kind: 'endCode', endCode: 0x4005, commands: ['unlock'], times: 1 })
    await rejection(client.connect())
    await until(() => client.state.name === 'connected')
    expect(seen).toEqual(['unlock 4005', 'unlock 0', 'readTypeName 0'])
  })
})

describe('a port that is locked in between', () => {
  test('is unlocked by a new connection; the request that found out is refused, not repeated', async () => {
    const { client, plc, seen } = await pair({ allowWrites: true, reconnect: { first: 1 } })
    await client.connect()
    plc.faults.add({ kind: 'endCode', endCode: 0xc201, commands: ['writeWords'], times: 1 })
    expect(await rejection(client.write('D100', 5))).toMatchObject({ endCode: 0xc201, outcome: 'refused' })
    await until(() => client.state.name === 'connected')
    expect(await client.read('D100')).toBe(0)
    expect(seen.filter((entry) => entry.startsWith('unlock'))).toHaveLength(2)
  })

  test('over UDP it is unlocked again before the first request after a long pause', async () => {
    const clock = manualClock()
    const plc = createPlcSimulator({ profile: 'iq-r', password: PASSWORD, clock })
    const seen: string[] = []
    plc.on('request', ({ command, endCode }) => void seen.push(`${command} ${endCode}`))
    const client = createMelsecClient({
      host: 'memory',
      port: 1,
      profile: 'iq-r',
      transport: 'udp',
      password: PASSWORD,
      clock,
      openTransport: plc.connect({ kind: 'datagram' }),
    })
    ended.push(
      () => client.close(),
      () => plc.close(),
    )
    await client.read('D100')
    clock.advance(11 * 60_000)
    const read = client.read('D100')
    clock.advance(100)
    await settle()
    expect(await read).toBe(0)
    expect(seen.filter((entry) => !entry.endsWith(' 0'))).toEqual([])
    expect(seen.filter((entry) => entry.startsWith('unlock'))).toHaveLength(2)
  })
})

describe('over UDP', () => {
  test('it is unlocked and, because nothing else would, locked at the end', async () => {
    const { client, seen } = await pair({ transport: 'udp', frame: '3E', localPort: await freePort() })
    await client.connect()
    expect(await client.read('D100')).toBe(0)
    await client.close()
    // The self tests prove the fixed port; a locked PLC returns none, so unlocking goes without.
    const requests = ['readTypeName 0', 'readWords 0', 'lock 0'].flatMap((request) => ['selfTest 0', request])
    expect(seen).toEqual(['unlock 0', ...requests])
  })

  test('with the 3E frame it needs a fixed port, because the PLC unlocks one peer', () => {
    const given = { host: 'plc', port: 1, profile: 'iq-f', transport: 'udp', password: PASSWORD } as const
    expect(() => createMelsecClient(given)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field: 'localPort' }))
    expect(() => createMelsecClient({ ...given, localPort: 5000 })).not.toThrow()
    expect(() => createMelsecClient({ ...given, profile: 'iq-r', frame: '4E' })).not.toThrow()
  })
})

describe('closing', () => {
  test('does not wait long for a PLC that does not answer, and takes nothing more', async () => {
    const { client, plc } = await pair()
    await client.connect()
    plc.faults.add({ kind: 'silence', commands: ['lock'] })
    const closing = client.close()
    expect(await rejection(client.read('D100'))).toMatchObject({ code: 'CLOSED', outcome: 'notSent' })
    await Promise.all([closing, client.close()])
    expect(client.state.name).toBe('closed')
  })

  test('without a connection sends nothing', async () => {
    const { client, seen } = await pair()
    await client.close()
    expect([client.state.name, seen]).toEqual(['closed', []])
  })
})

describe('a password that cannot be', () => {
  test.each([
    ['iq-r', 'abcde', 'has 5 characters; MELSEC iQ-R takes 6 to 32'],
    ['iq-f', 'a'.repeat(33), 'has 33 characters; MELSEC iQ-F takes 6 to 32'],
    ['q', 'abcdef', 'has 6 characters; MELSEC-Q takes 4'],
    ['generic', 'abc', 'takes 4 to 32'],
    ['iq-r', 'pässword', 'characters from 20H to 7EH'],
    ['iq-r', 123456 as unknown as string, 'must be a text'],
  ] as const)('of %s: %s', (profile, password, says) => {
    const make = () => createMelsecClient({ host: 'plc', port: 1, profile, password })
    expect(make).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field: 'password' }))
    expect(make).toThrow(says)
    expect(make).not.toThrow(new RegExp(String(password)))
  })

  test('with 1E frames, which have no command for it', () => {
    const given = { host: 'plc', port: 1, profile: 'iq-f', frame: '1E', password: PASSWORD } as const
    expect(() => createMelsecClient(given)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field: 'password' }))
  })

  test('leaves the one before in place', async () => {
    const { client } = await pair()
    expect(() => client.setPassword('x')).toThrow(RequestError)
    await client.connect()
  })
})

test('unlock and lock by request() need allowControl, and their length is checked', async () => {
  const { client } = await pair()
  const password = PASSWORD
  expect(await rejection(client.request(commands.unlock, { password }))).toMatchObject({ code: 'NOT_PERMITTED' })
  const allowed = (await pair({ allowControl: true })).client
  expect(await allowed.request(commands.unlock, { password })).toEqual({})
  const error = await rejection(allowed.request(commands.lock, { password: 'short' }))
  expect(error).toMatchObject({ code: 'OUT_OF_RANGE', outcome: 'notSent' })
  expect(error.message).not.toContain('short')
  const number = await rejection(allowed.request(commands.unlock, { password: 12345678 as never }))
  expect(number).toMatchObject({ code: 'BAD_MESSAGE', outcome: 'notSent' })
  expect(number.message).not.toContain('12345678')
})

test('it is nowhere to be seen: options, errors, states, traces', async () => {
  const { client } = await pair({ password: WRONG })
  const shown: unknown[] = [client, client.options]
  client.on('state', (state) => void shown.push(state, state.error?.stack))
  client.on('trace', (entry) => void shown.push(entry, entry.text, entry.bytes.toString('latin1'), entry.frames))
  shown.push(await rejection(client.connect()), await rejection(client.read('D100')))
  client.setPassword(PASSWORD)
  await client.connect()
  await client.close()
  const text = shown.map((value) => `${inspect(value, { depth: 9, showHidden: true })} ${JSON.stringify(value)}`).join()
  expect(text).toContain('Unlock (remote password)')
  expect(text).not.toMatch(/Secret/)
  expect(text).not.toContain(Buffer.from('Secret').toString('hex'))
  expect(text).not.toContain('83,101,99,114,101,116')
})

describe('a PLC that says nothing to Read Type Name', () => {
  test('is unlocked on each connection, before its probe', async () => {
    const { plc, client, seen } = await pair({ timeout: 400 })
    plc.faults.add({ kind: 'silence', commands: ['readTypeName'] })
    plc.write('D100', 7)
    expect(await client.read('D100', { timeout: 5000 })).toBe(7)
    expect(seen.filter((entry) => !entry.startsWith('readTypeName'))).toEqual([
      'unlock 0',
      'unlock 0',
      'readWords 0',
      'readWords 0',
    ])
    expect(client.statistics).toMatchObject({ connects: 2, disconnects: 1 })
  })

  test('needs no probe behind the password: the first request is sent once', async () => {
    const { client, seen } = await pair({ probe: 'none', allowWrites: true })
    await client.write('D100', 7)
    expect(seen).toEqual(['unlock 0', 'writeWords 0'])
  })

  test('a wrong password is sent once, whatever the probe', async () => {
    for (const probe of ['auto', 'read', 'none'] as const) {
      const { client, seen } = await pair({ probe, password: WRONG })
      expect(await rejection(client.read('D100'))).toMatchObject({ outcome: 'notSent' })
      expect(await rejection(client.read('D100'))).toMatchObject({ outcome: 'notSent' })
      expect(seen).toHaveLength(1)
    }
  })
})
