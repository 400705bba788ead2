// Indirect specification through sockets: what stands in two words says which device is meant.
import { afterEach, describe, expect, test } from '@jest/globals'
import type { MelsecClient } from '../../src/client/melsec/client'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import { PlcError, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import type { ProfileId } from '../../src/melsec/profiles/profile'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { createPlcSimulator, type PlcSimulator } from '../../src/simulator/server'

const ended: (() => Promise<void>)[] = []
afterEach(async () => {
  for (const end of ended.splice(0)) await end()
})

async function pair(
  profile: ProfileId,
  code: 'binary' | 'ascii',
): Promise<{ plc: PlcSimulator; client: MelsecClient }> {
  const plc = createPlcSimulator({ profile, code })
  await plc.listen()
  const { host, port } = plc.tcp ?? { host: '', port: 0 }
  const client = createMelsecClient({ host, port, profile, code, allowWrites: true })
  ended.push(
    () => client.close(),
    () => plc.close(),
  )
  return { plc, client }
}

async function rejection(promise: Promise<unknown>): Promise<PlcError> {
  const error = await promise.then(
    () => undefined,
    (reason: unknown) => reason,
  )
  if (error instanceof PlcError) return error
  throw new Error(`no PlcError: ${String(error)}`)
}

const D0 = { device: 'D', number: 0, indirect: true } as const

/** iQ-R takes the long form by itself (0082), Q the short one (0080). */
describe.each(['iq-r', 'q', 'iq-f'] as const)('%s', (profile) => {
  describe.each(['binary', 'ascii'] as const)('%s', (code) => {
    test('@D0 reads and writes the device whose address ADRSET stored', async () => {
      const { plc, client } = await pair(profile, code)
      plc.write('D100', -7)
      plc.adrset('D100', 'D0')
      expect(await client.read('@D0')).toBe(-7)
      await client.write('@D0', 1234)
      expect(plc.read('D100')).toBe(1234)
      await client.write('@D0:REAL', 1.5)
      expect([plc.read('D100:REAL'), await client.read('@D0:REAL')]).toEqual([1.5, 1.5])
      // Another device without a word to the client.
      plc.write('W1F', 0x55)
      plc.adrset('W1F', 'D0')
      expect(await client.read('@D0')).toBe(0x55)
    })

    test('@D0Z4: the words behind D0 by Z4 hold the address', async () => {
      const { plc, client } = await pair(profile, code)
      plc.write('D200', 21)
      plc.write('Z4', 6)
      plc.adrset('D200', 'D6')
      expect(await client.read('@D0Z4')).toBe(21)
      await client.write('@D0Z4', 22)
      expect(plc.read('D200')).toBe(22)
    })

    test('an address that was never stored is refused, and nothing is written', async () => {
      const { plc, client } = await pair(profile, code)
      for (const number of [0, 100, plc.addressOf('D100') + 1, 0xffffffff]) {
        plc.write('D0:UDINT', number)
        for (const call of [client.read('@D0'), client.write('@D0', 1)]) {
          expect(await rejection(call)).toMatchObject({ code: 'END_CODE', endCode: 0xc05c, outcome: 'refused' })
        }
      }
      expect(plc.read('D100')).toBe(0)
    })

    test('in Read Random and Write Random beside other devices', async () => {
      const { plc, client } = await pair(profile, code)
      plc.adrset('D100', 'D0')
      plc.write('D100:UDINT', 0x20001)
      plc.write('D300', 3)
      const D300 = { device: 'D', number: 300 } as const
      const asked = { words: [{ device: D0 }, { device: D300 }], doubleWords: [{ device: D0 }] }
      expect(await client.request(commands.readRandom, asked)).toEqual({ words: [1, 3], doubleWords: [0x20001] })
      await client.request(commands.writeRandomWords, {
        words: [{ device: D300, value: 4 }],
        doubleWords: [{ device: D0, value: 0x70006 }],
      })
      expect(plc.read('D100:UDINT')).toBe(0x70006)
      expect(plc.read('D300')).toBe(4)
    })

    test('the last device is the end: no double word behind it', async () => {
      const { plc, client } = await pair(profile, code)
      const last = resolveProfile(plc.profile).ranges.points.D ?? 0
      plc.adrset(`D${last - 1}`, 'D0')
      expect(await client.read('@D0')).toBe(0)
      expect(await rejection(client.read('@D0:DINT'))).toMatchObject({ code: 'END_CODE', outcome: 'refused' })
    })
  })
})

describe('addresses', () => {
  test('are 32 bits, one for each device, low word first', () => {
    const plc = createPlcSimulator({ profile: 'iq-r' })
    const address = plc.addressOf('D100')
    expect(plc.addressOf('d0100')).toBe(address)
    expect(plc.addressOf('D101')).not.toBe(address)
    expect([Number.isInteger(address), address > 0xffff, address <= 0xffffffff]).toEqual([true, true, true])
    plc.adrset('D100', 'D0')
    expect([plc.read('D0:WORD'), plc.read('D1:WORD')]).toEqual([address & 0xffff, address >>> 16])
    expect(plc.memory.addressOf('W0')).toBe(plc.addressOf('W0'))
  })

  test.each(['M0', 'D0.3', 'K4M0', '@D0', 'D0Z1', 'LZ0', 'U3\\G0', 'D99999999', 'nonsense'])(
    '%s has none',
    (source) => {
      const plc = createPlcSimulator({ profile: 'iq-r' })
      expect(() => plc.addressOf(source)).toThrow(RequestError)
      expect(() => plc.adrset('D0', source)).toThrow(RequestError)
      expect(() => plc.adrset(source, 'D0')).toThrow(RequestError)
      expect(plc.read('D0:UDINT')).toBe(0)
    },
  )
})
