/**
 * Commands for the connected station only go there, whatever the route of the client. The simulator is that station and
 * refuses everything for another one: what it carries out was sent to it.
 */
import { afterEach, describe, expect, test } from '@jest/globals'
import type { MelsecClient } from '../../src/client/melsec/client'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { MelsecOptions, NetworkPlc } from '../../src/client/melsec/options'
import { EndCodeError } from '../../src/errors'
import type { Command } from '../../src/melsec/commands/command'
import { describeCommand } from '../../src/melsec/commands/command-name'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { createPlcSimulator, type PlcSimulator } from '../../src/simulator/server'

const ended: (() => Promise<void>)[] = []
afterEach(async () => {
  for (const end of ended.splice(0)) await end()
})

const ELSEWHERE = { route: { network: 1, station: 3 } } as const
const PASSWORD = 'Secret-1'

async function pair(
  given: Partial<MelsecOptions & NetworkPlc> = {},
): Promise<{ plc: PlcSimulator; client: MelsecClient }> {
  const { code = 'binary', transport = 'tcp' } = given
  const plc = createPlcSimulator({ profile: 'generic', bufferMemory: 1024, code, password: PASSWORD })
  await plc.listen()
  const { host, port } = plc[transport === 'udp' ? 'udp' : 'tcp'] ?? { host: '', port: 0 }
  const permitted = { allowWrites: true, allowControl: true } as const
  const client = createMelsecClient({ host, port, profile: 'generic', ...ELSEWHERE, ...permitted, ...given })
  ended.push(
    () => client.close(),
    () => plc.close(),
  )
  return { plc, client }
}

/** As the manual says of each: SLMP reference manual 5.4, 5.7, 5.9, 5.10. */
const CONNECTED = ['selfTest', 'clearError', 'unlock', 'readMemory', 'writeMemory', 'lock']

test("the manual's commands for the connected station are declared so, and no others", () => {
  const declared = Object.values<Command>(commands).filter(({ to }) => to === 'connected')
  expect(declared.map(({ name }) => name).sort()).toEqual([...CONNECTED].sort())
})

const ways = [
  ['3E', 'binary', 'tcp', {}],
  ['4E', 'ascii', 'tcp', {}],
  ['4E', 'binary', 'udp', {}],
  ['ext', 'binary', 'tcp', { route: { network: 1, station: 300 } }],
  ['3E', 'binary', 'tcp', { route: { moduleIo: 0x3e1 } }],
] as const

describe.each(ways)('%s, %s code, %s, %j', (frame, code, transport, more) => {
  const options = { frame, code, transport, password: PASSWORD, ...more } as const

  test('by their methods', async () => {
    const { client } = await pair(options)
    expect(await client.selfTest()).toEqual({ roundTrip: expect.any(Number) })
    await client.clearError()
    await client.memory.write(5, [1234])
    expect(await client.memory.read(5, 1)).toEqual([1234])
  })

  test('by request and by name', async () => {
    const { plc, client } = await pair(options)
    expect(await client.request(commands.selfTest, { data: 'AB' })).toEqual({ data: 'AB' })
    const messages: Readonly<Record<string, unknown>> = {
      ...Object.fromEntries(CONNECTED.map((name) => [name, exampleOf(name)])),
      unlock: { password: PASSWORD },
      lock: { password: PASSWORD },
    }
    const seen: string[] = []
    plc.on('request', ({ command, endCode }) => void seen.push(`${command} ${endCode}`))
    for (const [name, message] of Object.entries(messages)) await client.requestByName(name, message)
    expect(seen).toEqual(Object.keys(messages).map((name) => `${name} 0`))
  })

  test('and nothing else: reading goes to the station of the route', async () => {
    const { client } = await pair(options)
    const calls = [
      client.read('D0'),
      client.requestByName('readWords', { head: 'D0', points: 1 }),
      client.control.run(),
    ]
    for (const ended of await Promise.allSettled(calls)) {
      expect(ended).toMatchObject({ status: 'rejected', reason: expect.any(EndCodeError) })
    }
  })
})

function exampleOf(name: string): unknown {
  return describeCommand(commands[name as CommandName]).example
}

test('the description of a command says so', () => {
  expect(describeCommand(commands.unlock).to).toBe('connected')
  expect(describeCommand(commands.readWords)).not.toHaveProperty('to')
})
