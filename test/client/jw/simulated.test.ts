/** A client of a Sharp JW and the simulated one, over real sockets: each is made of the same declarations, and of nothing else in common. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { JwClientOptions } from '../../../src/client/jw/options'
import { createJwSimulator, type JwSimulator, type JwSimulatorOptions } from '../../../src/entry/simulator'
import { createJwClient, type JwClient } from '../../../src/index'
import { brief, failureOf } from '../line'
import { free } from './small-jw'

async function joined(
  transport: 'tcp' | 'udp',
  options: Partial<JwClientOptions>,
  simulated: JwSimulatorOptions,
  run: (client: JwClient, plc: JwSimulator) => Promise<void>,
): Promise<void> {
  const plc = createJwSimulator({ writeMode: 2, ...simulated })
  await plc.listen()
  const port = plc[transport]?.port ?? 0
  const client = createJwClient({ host: '127.0.0.1', port, transport, ...free, ...options })
  try {
    await run(client, plc)
  } finally {
    await client.close()
    await plc.close()
  }
}

describe.each([
  ['tcp', 'none'],
  ['tcp', 'zero40'],
  ['udp', 'none'],
  ['udp', 'zero40'],
  ['udp', { pda: 1, psa: 2, slot: 3, station: 4 }],
] as const)('over %s with header %j', (transport, header) => {
  test('what a client writes is there, and what is there is read', async () => {
    await joined(transport, { header }, { header }, async (client, plc) => {
      await client.write({ '09012:INT': -5, '004033': true, 'F3:000100:REAL': 1.5, 'F1:177776[4]': [1, 2, 3, 4] })
      expect([plc.read('09012:INT'), plc.read('004033'), plc.read('F3:000100:REAL')]).toEqual([-5, true, 1.5])
      plc.write('09500:DINT', 123456)
      expect(await client.readValues(['09500:DINT', 'F1:177776[4]', '004033'])).toEqual([123456, [1, 2, 3, 4], true])
    })
  })

  test('random items come back as they were written, and nothing beside them changes', async () => {
    const byte = fc.record({
      file: fc.constantFrom(0, 2, 5),
      at: fc.integer({ min: 0o4000, max: 0o4100 }),
      value: fc.nat(255),
    })
    await joined(transport, { header }, { header }, async (client, plc) => {
      const model = new Map<string, number>()
      await fc.assert(
        fc.asyncProperty(
          fc.uniqueArray(byte, { minLength: 1, maxLength: 20, selector: ({ file, at }) => file * 65536 + at }),
          async (bytes) => {
            const entries = bytes.map(({ file, at, value }) => ({ item: `F${file}:${at.toString(8)}`, value }))
            await client.write(entries)
            for (const { item, value } of entries) model.set(item, value)
            const items = [0, 2, 5].flatMap((file) =>
              Array.from({ length: 0o101 }, (_, i) => `F${file}:${(0o4000 + i).toString(8)}`),
            )
            expect(await client.readValues(items)).toEqual(items.map((item) => model.get(item) ?? 0))
          },
        ),
        { numRuns: 15 },
      )
      expect(plc.connections.length).toBeGreaterThan(0)
    })
  })
})

test('a PLC whose write mode forbids it refuses, and the client does not change the mode by itself', async () => {
  await joined('tcp', {}, { writeMode: 0 }, async (client, plc) => {
    expect(await failureOf(client.write('09000', 1))).toMatchObject({ endCode: 0x10, outcome: 'refused' })
    expect(plc.cpu.writeMode).toBe(0)
    expect(await client.control.setWriteMode('data')).toBe('none')
    await client.write('09000', 1)
    expect(plc.read('09000')).toBe(1)
  })
})

test('items of files that do not exist have their errors, and the others their values', async () => {
  await joined('tcp', {}, { files: { 0: 65536, 2: 256 } }, async (client) => {
    const results = await client.read(['09000', 'F3:0', 'F2:377', 'F2:400', '004033'])
    expect(results.map(brief)).toEqual([0, 'END_CODE', 0, 'END_CODE', false])
  })
})

test('a PLC that starts again is found again, and a model without lists is read without', async () => {
  await joined('tcp', {}, { model: 'jw30h', restartTime: 20 }, async (client, plc) => {
    expect((await client.read(['09000', 'F2:0'])).map(brief)).toEqual([0, 0])
    plc.restart()
    const connected = new Promise<void>((resolve) => {
      client.on('state', ({ name }) => name === 'connected' && resolve())
    })
    await connected
    expect(await client.read('09000')).toBe(0)
  })
})

test('parameters of an option unit are taken over with the start switch', async () => {
  await joined('tcp', {}, { optionUnits: [] }, async (client, plc) => {
    const bytes = Uint8Array.from({ length: 300 }, (_, i) => i & 0xff)
    const unit = client.parameters.optionUnit({ rack: 0, unit: 3 })
    await unit.write([{ address: 0, bytes }])
    expect(await unit.read(0, 300)).toEqual(Buffer.from(bytes))
    expect(plc.optionUnit(0, 3)).toBeDefined()
  })
})
