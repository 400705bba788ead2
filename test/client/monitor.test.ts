/** Monitors through sockets: what is registered, what is read instead, and that no monitor reads another's devices. */
import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import { createPlcSimulator, type RequestEvent } from '../../src/entry/simulator'
import { createMelsecClient, type Monitor } from '../../src/index'
import { ample, brief, clientOptions, kind, type Line, links, nextState, until, withLine } from './line'

const registering = [
  'tcp 4E binary iq-r',
  'tcp 3E ascii iq-r',
  'udp 4E binary iq-r',
  'tcp 3E binary q',
  'udp 4E ascii l',
]

/** Names of the commands the PLC has got since. */
function watch({ plc }: Pick<Line, 'plc'>): { take(): string[] } {
  let seen: string[] = []
  plc.on('request', ({ command }: RequestEvent) => seen.push(command ?? '?'))
  return {
    take: () => {
      const taken = seen.filter((command) => command !== 'readTypeName')
      seen = []
      return taken
    },
  }
}

async function values(monitor: Monitor): Promise<unknown[]> {
  return (await monitor.read(ample)).map(brief)
}

describe.each(registering)('registered over %s', (text) => {
  test('all kinds of items come by one request that names none of them', () =>
    withLine(text, {}, async (line) => {
      const { plc, client } = line
      plc.memory.setWord('D', 0, 0xffff)
      plc.write('D10:REAL', 1.5)
      plc.write('D20:LINT', -5n)
      plc.write('D30:STRING(5)', 'abcde')
      plc.write('M3', true)
      plc.write('M20', true)
      plc.write('W1F', 31)
      plc.write('TN4', 44)
      plc.write('D40.F', true)
      plc.write('K4M48', 0x1234)
      plc.write('R5', 55)
      const items = [
        'D0',
        'D10:REAL',
        'D20:LINT',
        'D30:STRING(5)',
        'M3',
        'M16[6]',
        'W1F',
        'TN4',
        'D40.F',
        'K4M48',
        'R5',
        'D0:UINT',
      ]
      const expected = [
        -1,
        1.5,
        -5n,
        'abcde',
        true,
        [false, false, false, false, true, false],
        31,
        44,
        true,
        0x1234,
        55,
        65535,
      ]
      const monitor = client.monitor(items)
      expect([monitor.mode, monitor.note]).toEqual(['monitor', undefined])
      const seen = watch(line)
      expect(await values(monitor)).toEqual(expected)
      expect(seen.take()).toEqual(['entryMonitorDevice', 'executeMonitor'])
      plc.write('D10:REAL', 2.5)
      expect(await values(monitor)).toEqual(expected.map((value, i) => (i === 1 ? 2.5 : value)))
      expect(seen.take()).toEqual(['executeMonitor'])
    }))

  test('items by name have results by name, and errors that call them so', () =>
    withLine(text, {}, async ({ plc, client }) => {
      plc.write('D1', 7)
      const monitor = client.monitor({ level: 'D1', wrong: 'D1:NONE' })
      const { level, wrong } = await monitor.read(ample)
      expect([monitor.mode, brief(level), brief(wrong)]).toEqual(['monitor', 7, 'BAD_TYPE'])
      expect(wrong.ok ? '' : wrong.error.message).toMatch(/^wrong \(D1:NONE\)/)
    }))

  test('results have the item, the time and their own errors; what is no item keeps its error', () =>
    withLine(text, {}, async ({ plc, client }) => {
      plc.write('D1', 7)
      plc.memory.setWord('D', 2, 0xabcd)
      const results = await client.monitor(['D1', 'T5', 'D2:BCD16']).read()
      expect(results.map(({ item }) => item)).toEqual(['D1', 'T5', 'D2:BCD16'])
      expect(results.map(brief)).toEqual([7, 'BAD_ADDRESS', 'BAD_FIELD'])
      for (const { timestamp } of results) expect(Math.abs(Date.now() - timestamp)).toBeLessThan(60_000)
    }))

  test('items are registered again after the PLC has started again', () =>
    withLine(text, {}, async (line) => {
      const { plc, client } = line
      const monitor = client.monitor(['D0', 'M0'])
      expect(await values(monitor)).toEqual([0, false])
      const restarted = new Promise<void>((resolve) => {
        const stop = plc.on('restart', () => {
          stop()
          resolve()
        })
      })
      plc.restart(0)
      await restarted
      if (line.transport === 'tcp') {
        await nextState(client, 'waiting')
        await nextState(client, 'connected')
      }
      plc.write('D0', 9)
      const seen = watch(line)
      expect(await values(monitor)).toEqual([9, false])
      // Over UDP nothing tells of the restart but the refusal of what the PLC has forgotten.
      const forgotten = line.transport === 'udp' ? ['executeMonitor'] : []
      expect(seen.take()).toEqual([...forgotten, 'entryMonitorDevice', 'executeMonitor'])
      expect(monitor.mode).toBe('monitor')
    }))

  test('a lost answer costs that reading only', () =>
    withLine(text, { client: { timeout: 150 } }, async ({ plc, client }) => {
      plc.write('D0', 5)
      const monitor = client.monitor(['D0', 'D1'])
      await client.connect()
      for (const command of ['entryMonitorDevice', 'executeMonitor', 'executeMonitor'] as const) {
        plc.faults.add({ kind: 'drop', commands: [command], times: 1 })
        const results = await monitor.read()
        expect(results.map(brief)).toEqual(['TIMEOUT', 'TIMEOUT'])
        await nextState(client, 'connected')
        expect(await values(monitor)).toEqual([5, 0])
      }
    }))
})

describe('read instead', () => {
  const unregistered: readonly (readonly [why: string, text: string, items: string[], note: string])[] = [
    ['an iQ-F', 'tcp 3E binary iq-f', ['D0', 'M0'], 'no monitor registration'],
    ['3E over UDP', 'udp 3E binary iq-r', ['D0', 'M0'], 'changes the local port'],
    ['more than one registration takes', 'tcp 4E binary iq-r', Array.from({ length: 97 }, (_, i) => `D${i * 3}`), '96'],
    ['contacts of timers', 'tcp 4E binary iq-r', ['D0', 'TS0', 'LTS3'], 'cannot be'],
    ['nothing', 'tcp 4E binary iq-r', [], ''],
    ['nothing that is an item', 'tcp 4E binary iq-r', ['Q1'], ''],
  ]
  test.each(unregistered)('%s', (_why, text, items, note) =>
    withLine(text, {}, async (line) => {
      const { plc, client } = line
      plc.write('D0', 3)
      const monitor = client.monitor(items)
      expect(monitor.mode).toBe('read')
      expect(monitor.note).toContain('The items are read without monitor commands.')
      expect(monitor.note).toContain(note)
      const seen = watch(line)
      for (let i = 0; i < 2; i++) {
        expect(await monitor.read()).toEqual(
          (await client.read(items)).map((result) => ({ ...result, timestamp: expect.any(Number) })),
        )
      }
      expect(seen.take().filter((command) => command.includes('onitor'))).toEqual([])
    }),
  )

  test('what a PLC of unknown family refuses to register, and it says so', async () => {
    const plc = createPlcSimulator({ profile: 'iq-f' })
    await plc.listen()
    const line = kind('tcp 3E binary generic')
    await withLine(
      'tcp 3E binary generic',
      { client: { port: clientOptions(line, plc).port ?? 0 } },
      async ({ client }) => {
        plc.write('D0', 3)
        plc.write('M5', true)
        const monitor = client.monitor(['D0', 'M5'])
        expect(monitor.mode).toBe('monitor')
        const seen = watch({ plc })
        expect(await values(monitor)).toEqual([3, true])
        expect(monitor.mode).toBe('read')
        expect(monitor.note).toContain('C059')
        expect(seen.take()[0]).toBe('entryMonitorDevice')
        expect(await values(monitor)).toEqual([3, true])
        expect(seen.take()).not.toContain('entryMonitorDevice')
      },
    )
    await plc.close()
  })

  test.each(['tcp 4E binary iq-r', 'udp 4E binary iq-r'])(
    'when one device does not exist over %s, and only that item fails',
    (text) =>
      withLine(text, {}, async ({ plc, client }) => {
        plc.write('D0', 3)
        plc.write('W5', 4)
        const monitor = client.monitor(['D0', 'D99999', 'W5'])
        expect(await values(monitor)).toEqual([3, 'END_CODE', 4])
        expect([monitor.mode, monitor.note]).toEqual(['read', expect.stringContaining('4031')])
        expect(await values(monitor)).toEqual([3, 'END_CODE', 4])
      }),
  )

  test('is tried anew on a new connection', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client }) => {
      const monitor = client.monitor(['D0'])
      plc.faults.add({ kind: 'endCode', endCode: 0xc059, commands: ['entryMonitorDevice'], times: 1 })
      expect(await values(monitor)).toEqual([0])
      expect(monitor.mode).toBe('read')
      plc.restart(0)
      await nextState(client, 'waiting')
      await nextState(client, 'connected')
      expect(await values(monitor)).toEqual([0])
      expect([monitor.mode, monitor.note]).toEqual(['monitor', undefined])
    }))

  test('a second monitor over UDP, where a registration could arrive twice', () =>
    withLine('udp 4E binary iq-r', {}, async ({ plc, client }) => {
      plc.write('D0', 3)
      plc.write('D1', 4)
      const [first, second] = [client.monitor(['D0']), client.monitor(['D1'])]
      expect([first.mode, second.mode]).toEqual(['monitor', 'read'])
      expect(second.note).toContain('Over UDP')
      expect([await values(first), await values(second)]).toEqual([[3], [4]])
    }))
})

describe.each(registering)('two monitors of one client over %s', (text) => {
  test.each([1, 8])(
    'asked at the same time never read the devices of the other one (inFlight %i)',
    async (inFlight) => {
      if (inFlight > 1 && !text.startsWith('udp 4E')) return
      await withLine(text, { client: { inFlight } }, async ({ plc, client }) => {
        for (let i = 0; i < 400; i++) plc.memory.setWord('D', i, i)
        // The same number of words each, so that the answer to one fits the other.
        const lists = [0, 100, 200, 300].map((first) => Array.from({ length: 10 }, (_, i) => first + 7 * i))
        const monitors = lists.map((list) => client.monitor(list.map((number) => `D${number}`)))
        const readings = Array.from({ length: 40 }, (_, i) => i % 4)
        const all = await Promise.all(readings.map(async (i) => [i, await values(monitors[i] as Monitor)] as const))
        for (const [i, read] of all) expect(read).toEqual(lists[i])
      })
    },
  )

  test('with reads, plans and registrations of the program in between', () =>
    withLine(text, {}, async ({ plc, client }) => {
      for (let i = 0; i < 300; i++) plc.memory.setWord('D', i, i)
      const monitors = [client.monitor(['D1', 'D11']), client.monitor(['D2', 'D12'])]
      const own = {
        words: [{ device: { device: 'D', number: 3 } }, { device: { device: 'D', number: 13 } }],
        doubleWords: [],
      } as const
      const jobs = Array.from({ length: 60 }, async (_, i) => {
        if (i % 4 < 2) expect(await values(monitors[i % 4] as Monitor)).toEqual([1 + (i % 4), 11 + (i % 4)])
        else if (i % 4 === 2) expect(await client.request(commands.entryMonitorDevice, own)).toEqual({})
        else expect(await client.readValues(['D5', 'D250'])).toEqual([5, 250])
      })
      await Promise.all(jobs)
    }))

  test('under lost answers and broken connections', () =>
    withLine(
      text,
      { client: { timeout: 100, reconnect: { first: 1, longest: 5 } } },
      async ({ plc, client, transport }) => {
        for (let i = 0; i < 300; i++) plc.memory.setWord('D', i, i)
        const monitors = [client.monitor(['D1', 'D11', 'D21']), client.monitor(['D2', 'D12', 'D22'])]
        await client.connect()
        for (let round = 0; round < 12; round++) {
          await nextState(client, 'connected')
          const commandsOf = round % 2 === 0 ? (['entryMonitorDevice'] as const) : (['executeMonitor'] as const)
          const kinds = ['drop', 'silence', transport === 'tcp' ? 'disconnect' : 'duplicate'] as const
          const fault = plc.faults.add({ kind: kinds[round % 3] ?? 'drop', commands: commandsOf, times: 1 })
          const results = await Promise.all([0, 1, 0, 1].map((i) => (monitors[i] as Monitor).read()))
          results.forEach((read, i) => {
            const expected = [1, 11, 21].map((number) => number + (i % 2))
            for (const [at, result] of read.entries()) if (result.ok) expect(result.value).toBe(expected[at])
          })
          fault.remove()
        }
        await nextState(client, 'connected')
        expect(await values(monitors[0] as Monitor)).toEqual([1, 11, 21])
      },
    ))
})

describe.each(links)('over %s', (text) => {
  test('a monitor that another client of the PLC registers does no harm', () =>
    withLine(text, {}, async ({ plc, client, another }) => {
      plc.write('D0', 1)
      plc.write('D1', 2)
      const other = another()
      const monitors = [client.monitor(['D0']), other.monitor(['D1'])]
      for (let i = 0; i < 5; i++) {
        expect(await Promise.all(monitors.map(values))).toEqual([[1], [2]])
      }
    }))

  test('a monitor may be made before the PLC is there', () =>
    withLine(text, {}, async ({ client, plc }) => {
      const monitor = client.monitor(['D0'])
      expect(plc.statistics.requests).toBe(0)
      expect(await values(monitor)).toEqual([0])
      await until(() => plc.statistics.requests > 0)
    }))
})

// Appendix 3: "cannot access the non-control CPUs".
describe('a CPU that is not the control CPU registers nothing', () => {
  const peer = { host: '127.0.0.1', port: 1 } as const
  const registration = { words: [{ device: { device: 'D', number: 0 } }], doubleWords: [] } as const

  test.each([
    ['iq-r', 0x3e1],
    ['q', 0x3e3],
    ['generic', 0x3e2],
  ] as const)('%s, %i', async (profile, moduleIo) => {
    const client = createMelsecClient({ ...peer, profile, route: { moduleIo } })
    const monitor = client.monitor(['D0'])
    expect(monitor.mode).toBe('read')
    expect(monitor.note).toMatch(/only the control CPU registers a monitor/)
    const refused = { code: 'UNSUPPORTED', outcome: 'notSent', field: 'moduleIo' }
    await expect(client.request(commands.entryMonitorDevice, registration)).rejects.toMatchObject(refused)
    const named = { entryMonitorDevice: { words: [{ device: 'D0' }], doubleWords: [] } }
    await expect(client.requestByName('executeMonitor', named)).rejects.toMatchObject(refused)
    await client.close()
  })

  test('the control CPU does, and so does a remote head', async () => {
    for (const [profile, moduleIo] of [
      ['iq-r', 0x3ff],
      ['iq-r', 0x3e0],
      ['remote-head', 0x3e1],
    ] as const) {
      const client = createMelsecClient({ ...peer, profile, route: { moduleIo } })
      expect(client.monitor(['D0']).mode).toBe('monitor')
      await client.close()
    }
  })
})
