/** Labels beside devices, wherever items are taken. */
import { afterEach, beforeEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, type MelsecClient } from '../../src/index'

let plc: PlcSimulator
let client: MelsecClient
let asked: string[]

beforeEach(async () => {
  plc = createPlcSimulator({
    profile: 'iq-r',
    labels: {
      'Line1.Speed': { type: 'REAL', value: 12.5 },
      'Line1.Values': { type: 'INT', dimensions: [5], value: [1, 2, 3, 4, 5] },
      'Line1.Ready': { type: 'BOOL' },
      'Line1.Name': { type: 'STRING(20)', value: 'Apple ' },
      'Line1.Mask': { type: 'WORD', value: 65535 },
      Motor_1: { type: 'DINT', value: 7 },
      速度: { type: 'INT', value: 1500 },
      DD100: { type: 'INT', value: 99 },
      'LINE1.MASK': { type: 'WORD', value: 0 },
      'DD1.Speed': { type: 'REAL', value: 0.25 },
    },
  })
  client = createMelsecClient({
    host: 'in memory',
    port: 1,
    profile: 'iq-r',
    allowWrites: true,
    openTransport: plc.connect(),
    timeout: 5000,
  })
  await client.connect()
  asked = []
  plc.on('request', ({ command }) => void asked.push(String(command)))
  plc.write('D100:REAL', -1)
})
afterEach(async () => {
  await client.close()
  await plc.close()
})

describe('read', () => {
  test('one label', async () => {
    await expect(client.read('label:Line1.Speed')).resolves.toBe(12.5)
    await expect(client.read({ address: 'LABEL: Line1.Values[1]', count: 3 })).resolves.toEqual([2, 3, 4])
    await expect(client.read('label:Line1.Nothing')).rejects.toMatchObject({ code: 'END_CODE' })
  })

  test('labels and devices in one call, in the order given', async () => {
    const items = ['D100:REAL', 'label:Line1.Speed', 'Q1', 'label:A.1', 'label:Line1.Ready', 'M0'] as const
    const results = await client.read(items)
    expect(results.map(({ item }) => item)).toEqual([...items])
    expect(results.map((result) => (result.ok ? result.value : result.error.code))).toEqual([
      -1,
      12.5,
      'BAD_ADDRESS',
      'BAD_ADDRESS',
      false,
      false,
    ])
    expect(results.every(({ timestamp }) => timestamp > 0)).toBe(true)
    await expect(client.readValues({ level: 'D100:REAL', speed: 'label:Line1.Speed' })).resolves.toEqual({
      level: -1,
      speed: 12.5,
    })
    const named = await client.read({ speed: 'label:Line1.Speed' })
    expect(named.speed).toMatchObject({ ok: true, value: 12.5, item: 'label:Line1.Speed' })
  })

  test('a name that cannot be an address needs no prefix', async () => {
    const items = [
      'Line1.Speed',
      'Line1.Values[1]',
      'Motor_1',
      '速度',
      'Line1.Values[0]:INT[3]',
      'DD1.Speed:REAL',
    ] as const
    const results = await client.read(items)
    expect(results.map((result) => (result.ok ? [result.value, result.type] : result.error.code))).toEqual([
      [12.5, 'REAL'],
      [2, 'INT'],
      [7, 'DINT'],
      [1500, 'INT'],
      [[1, 2, 3], 'INT'],
      [0.25, 'REAL'],
    ])
    expect(results.map(({ item }) => item)).toEqual([...items])
  })

  test('what may be a mistyped address is refused before anything is sent, and says what to write', async () => {
    for (const text of ['DD100', 'Q5', 'Line1.F', 'D10O', 'DD100[16]', 'DD100:REAL']) {
      const refused = client.read(text)
      await expect(refused).rejects.toMatchObject({ code: 'BAD_ADDRESS', outcome: 'notSent' })
      await expect(refused).rejects.toThrow(`If it is a label, write label:${text}.`)
    }
    await expect(client.read('T5')).rejects.not.toThrow('label:')
    await expect(client.read('D100:REALL')).rejects.toMatchObject({ code: 'BAD_TYPE' })
    expect(asked).toEqual([])
    await expect(client.read('label:DD100')).resolves.toBe(99)
  })

  test('where there are no labels, or perhaps none, a name says so', async () => {
    const other = (profile: 'iq-f' | 'generic') =>
      createMelsecClient({ host: 'in memory', port: 1, profile, openTransport: plc.connect() })
    const f = other('iq-f')
    await expect(f.read('Line1.Speed')).rejects.toMatchObject({ code: 'BAD_ADDRESS' })
    await expect(f.read('Line1.Speed')).rejects.toThrow('Labels are reached by name on iQ-R only')
    await expect(f.read('label:Line1.Speed')).rejects.toMatchObject({ code: 'UNSUPPORTED' })
    expect(() => f.explain('label:Line1.Speed')).toThrow('label:Line1.Speed')
    await f.close()
    const generic = other('generic')
    await expect(generic.read('Line1.Speed')).rejects.toThrow('If it is a label, write label:Line1.Speed.')
    expect(asked).toEqual([])
    await expect(generic.read('label:Line1.Speed')).resolves.toBe(12.5)
    await generic.close()
  })

  test('a type is held against the one of the PLC', async () => {
    const right = [
      'Line1.Speed:REAL',
      'label:Line1.Name:STRING(20)',
      'Line1.Name:STRING(21)',
      'Motor_1:FLOAT',
      'Line1.Mask:UINT',
    ]
    const results = await client.read(right)
    expect(results.map((result) => (result.ok ? result.value : result.error.code))).toEqual([
      12.5,
      'Apple ',
      'Apple ',
      'BAD_TYPE',
      65535,
    ])
    await expect(client.read('Line1.Speed:DINT')).rejects.toThrow('Line1.Speed is REAL in the PLC, not DINT')
    await expect(client.read('Line1.Name:STRING(10)')).rejects.toMatchObject({ code: 'BAD_TYPE', field: 'type' })
    await expect(client.read('Line1.Values[0]:REAL[2]')).rejects.toMatchObject({ code: 'BAD_TYPE' })
    await expect(client.read('Line1.Speed:FOO')).rejects.toMatchObject({ code: 'BAD_TYPE', outcome: 'notSent' })
    plc.labels.set('Line1.Speed', 1)
    await expect(client.write('Line1.Speed:DINT', 5)).rejects.toMatchObject({ code: 'BAD_TYPE' })
    expect(plc.labels.get('Line1.Speed')).toBe(1)
  })

  test('options of an item: count, type, encoding and trimSpaces, but no order', async () => {
    await expect(client.read({ address: 'Line1.Values[1]', count: 3, type: 'INT' })).resolves.toEqual([2, 3, 4])
    await expect(client.read({ address: 'Line1.Name', trimSpaces: true })).resolves.toBe('Apple')
    const japanese = { address: 'Line1.Name', encoding: 'shift-jis' } as const
    await client.write(japanese, '林檎')
    await expect(client.read(japanese)).resolves.toBe('林檎')
    await expect(client.read('Line1.Name')).rejects.toMatchObject({ code: 'BAD_FIELD' })
    const before = asked.length
    const order = client.read({ address: 'Line1.Speed', wordOrder: 'high-first' })
    await expect(order).rejects.toMatchObject({ code: 'BAD_OPTION', field: 'wordOrder' })
    const twice = client.read({ address: 'Line1.Values[0]:INT[2]', count: 3 })
    await expect(twice).rejects.toMatchObject({ code: 'BAD_OPTION', field: 'count' })
    const encoding = { address: 'Line1.Name', encoding: 'ebcdic' } as unknown as { address: string }
    await expect(client.read(encoding)).rejects.toMatchObject({ code: 'BAD_OPTION', field: 'encoding' })
    await expect(client.read({ address: 'Line1.Values', count: 2 })).rejects.toMatchObject({ code: 'BAD_ADDRESS' })
    expect(asked).toHaveLength(before)
  })

  test('the types of values are those of the texts, and an index is no count', async () => {
    const numbers: number[] = await client.read('label:Line1.Values[0]:INT[2]')
    const speed: number = await client.read('Line1.Speed:REAL')
    const unknown = await client.read('label:Line1.Values[1]')
    // @ts-expect-error One element is no list.
    const list: readonly unknown[] = unknown
    expect([numbers, speed, list]).toEqual([[1, 2], 12.5, 2])
  })

  test('a list is looked at once: read again, only its requests are made', async () => {
    const items = ['D100:REAL', 'Line1.Speed', 'Q5']
    const first = await client.read(items)
    plc.labels.set('Line1.Speed', 3)
    const second = await client.read(items)
    const errors = [first[2], second[2]].map((result) => (result?.ok === false ? result.error : undefined))
    expect(errors[0]).toBe(errors[1])
    expect(second[1]).toMatchObject({ ok: true, value: 3 })
  })
})

describe('plan', () => {
  test('reads devices and labels, and tells their requests', async () => {
    const plan = client.plan(['D100:REAL', 'Line1.Speed', 'Line1.Values[0]', 'Line1.Ready', 'label:Q5', 'Q5'])
    const before = plan.describe()
    expect(before.requests.map(({ command }) => command)).toEqual(['readWords', 'readRandomLabels'])
    const [, labels] = before.requests
    // 4E: 15 bytes, command and subcommand 4, numbers of labels and abbreviations 4, Line1 12, four names of 30 letters 68.
    expect(labels).toMatchObject({ points: 4, subcommand: 0, requestBytes: 15 + 4 + 4 + 12 + 68 })
    expect(labels?.text).toBe('Label Read Random: 4 labels, %1 for Line1')
    expect(labels).not.toHaveProperty('responseBytes')
    expect(labels).not.toHaveProperty('form')
    expect(before.notes.join(' ')).toContain('types of labels')
    const results = await plan.run()
    expect(results.map((result) => (result.ok ? result.value : result.error.code))).toEqual([
      -1,
      12.5,
      1,
      false,
      'END_CODE',
      'BAD_ADDRESS',
    ])
  })

  test('knows the sizes of the answers when the PLC has said the types', async () => {
    const sizes: number[] = []
    client.on('trace', ({ direction, bytes }) => void (direction === 'received' && sizes.push(bytes.length)))
    const plan = client.plan(['Line1.Speed', 'Line1.Ready', 'Line1.Values[0]:INT[5]', 'Line1.Name'])
    expect(plan.toString()).toContain('unknown in')
    expect(plan.describe().notes.join(' ')).toContain(
      'Line1.Values[0]:INT[5]: its elements are read by Array Label Read',
    )
    await plan.run()
    const { requests, notes } = plan.describe()
    expect(requests.map(({ command }) => command)).toEqual(['readRandomLabels', 'readArrayLabels'])
    expect(requests.map(({ responseBytes }) => responseBytes)).toEqual(sizes)
    expect(notes).toEqual([])
  })

  test('one deadline holds for all', async () => {
    plc.faults.add({ kind: 'silence', commands: ['readRandomLabels'], times: 1 })
    const results = await client.plan(['D100:REAL', 'Line1.Speed']).run({ timeout: 200 })
    expect(results.map(({ ok }) => ok)).toEqual([true, false])
    expect(results[1]).toMatchObject({ error: { code: 'TIMEOUT' } })
  })
})

describe('monitor and explain', () => {
  test('devices are registered, labels are read each time, and the note says so', async () => {
    const monitor = client.monitor(['D100:REAL', 'Line1.Speed', 'Q5'])
    expect(monitor.mode).toBe('monitor')
    expect(monitor.note).toContain('Line1.Speed is read anew each time')
    for (const value of [1, 2]) {
      plc.labels.set('Line1.Speed', value)
      const results = await monitor.read()
      expect(results.map((result) => (result.ok ? result.value : result.error.code))).toEqual([
        -1,
        value,
        'BAD_ADDRESS',
      ])
    }
    expect(asked.filter((command) => command === 'entryMonitorDevice')).toHaveLength(1)
    expect(asked.filter((command) => command === 'readRandomLabels')).toHaveLength(2)
  })

  test('labels alone are read', async () => {
    const monitor = client.monitor(['Line1.Speed', 'Motor_1'])
    expect([monitor.mode, monitor.note]).toEqual(['read', expect.stringContaining('are read anew')])
    expect(await monitor.read()).toMatchObject([{ value: 12.5 }, { value: 7 }])
    expect(asked).toEqual(['readRandomLabels'])
  })

  test('what is known of a label without the PLC', () => {
    expect(client.explain('Line1.Values[2, 0]')).toMatchObject({
      label: 'Line1.Values[2,0]',
      index: [2, 0],
      requests: 1,
    })
    expect(client.explain('Line1.Speed')).not.toHaveProperty('type')
    const explained = client.explain('label:DD100[0]:float[3]')
    expect(explained).toMatchObject({ text: 'label:DD100[0]:float[3]', label: 'DD100[0]', type: 'REAL', count: 3 })
    expect(explained.notes.join(' ')).toContain('Access from External Device')
    expect(client.explain('D100')).not.toHaveProperty('label')
    expect(() => client.explain('label:A.3')).toThrow('bit of a label')
    expect(() => client.explain(`label:${'a'.repeat(990)}`)).toThrow('bytes')
    expect(() => client.explain(`label:${'a'.repeat(5000)}`)).toThrow('5000 characters')
    expect(asked).toEqual([])
  })
})

describe('write', () => {
  test('one label, and many with devices between them in the order given', async () => {
    await client.write('label:Line1.Speed', 3)
    expect(plc.labels.get('Line1.Speed')).toBe(3)
    asked.length = 0
    const results = await client.writeEach({
      'label:Line1.Values[3]': [9, 8],
      'D100:REAL': 2,
      'label:Line1.Ready': true,
    })
    expect(results).toEqual({
      'label:Line1.Values[3]': { item: 'label:Line1.Values[3]', ok: true },
      'D100:REAL': { item: 'D100:REAL', ok: true },
      'label:Line1.Ready': { item: 'label:Line1.Ready', ok: true },
    })
    expect(asked.filter((command) => command.startsWith('write'))).toEqual([
      'writeArrayLabels',
      'writeWords',
      'writeRandomLabels',
    ])
    expect([plc.labels.get('Line1.Values[4]'), plc.labels.get('Line1.Ready')]).toEqual([8, true])
  })

  test('nothing goes on behind an unknown outcome', async () => {
    plc.faults.add({ kind: 'silence', commands: ['writeWords'], times: 1 })
    const entries = [
      { item: 'D100:REAL', value: 5 },
      { item: 'label:Line1.Ready', value: true },
    ]
    const results = await client.writeEach(entries, { timeout: 300 })
    expect(results.map((result) => (result.ok ? 'ok' : result.error.outcome))).toEqual(['unknown', 'notSent'])
    expect(plc.labels.get('Line1.Ready')).toBe(false)
  })

  test('all or nothing: one bad value, and nothing is written', async () => {
    const values = { 'D100:REAL': 2, 'Line1.Ready': true, 'Line1.Mask': 70_000 }
    const results = await client.writeEach(values, { allOrNothing: true })
    expect(Object.values(results).map((result) => (result.ok ? 'ok' : result.error.code))).toEqual([
      'ABORTED',
      'ABORTED',
      'BAD_VALUE',
    ])
    expect(results['Line1.Mask']).toMatchObject({ error: { message: expect.stringContaining('Line1.Mask') } })
    expect(asked).toEqual(['readRandomLabels'])
    asked.length = 0
    const mistyped = await client.writeEach({ 'Line1.Ready': true, Q5: 1 }, { allOrNothing: true })
    expect(mistyped['Line1.Ready']).toMatchObject({ ok: false, error: { code: 'ABORTED', outcome: 'notSent' } })
    expect(asked).toEqual([])
    expect([plc.read('D100:REAL'), plc.labels.get('Line1.Ready')]).toEqual([-1, false])
    const good = await client.writeEach({ 'D100:REAL': 2, 'Line1.Ready': true }, { allOrNothing: true })
    expect(Object.values(good).every(({ ok }) => ok)).toBe(true)
  })

  test('all or nothing: nothing more after the first failure', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0x4080, commands: ['writeRandomLabels'], times: 1 })
    const entries = [
      { item: 'D100:REAL', value: 5 },
      { item: 'Line1.Ready', value: true },
      { item: 'D102', value: 6 },
    ]
    const results = await client.writeEach(entries, { allOrNothing: true })
    expect(results.map((result) => (result.ok ? 'ok' : result.error.code))).toEqual(['ok', 'END_CODE', 'ABORTED'])
    expect([plc.read('D100:REAL'), plc.read('D102')]).toEqual([5, 0])
  })

  test('a type that cannot be read is no write of unknown outcome', async () => {
    plc.faults.add({ kind: 'silence', commands: ['readRandomLabels'], times: 1 })
    const results = await client.writeEach({ 'Line1.Ready': true }, { timeout: 100 })
    expect(results['Line1.Ready']).toMatchObject({ ok: false, error: { code: 'ABORTED', outcome: 'notSent' } })
    expect(plc.labels.get('Line1.Ready')).toBe(false)
  })

  test('arrays: a list from the element that is named, with a count that agrees', async () => {
    await client.write('Line1.Values[1]:INT[2]', [8, 9])
    expect(plc.labels.get('Line1.Values[2]')).toBe(9)
    asked.length = 0
    const wrong = client.write({ address: 'label:Line1.Values[0]', count: 3 }, [1, 2])
    await expect(wrong).rejects.toMatchObject({ code: 'BAD_VALUE', outcome: 'notSent' })
    // @ts-expect-error: what a program without types may pass
    await expect(client.write('Line1.Values[0]:INT[2]', 1)).rejects.toMatchObject({ code: 'BAD_VALUE' })
    // @ts-expect-error: an array begins with the element that is named
    await expect(client.write('Line1.Values', [1, 2])).rejects.toMatchObject({ code: 'BAD_ADDRESS' })
    await expect(client.write('Line1.Values[0]', [])).rejects.toMatchObject({ code: 'OUT_OF_RANGE' })
    const none = client.write('Line1.Ready', null as unknown as boolean)
    await expect(none).rejects.toMatchObject({ code: 'BAD_VALUE' })
    expect(asked).toEqual(['readRandomLabels'])
  })

  test('a label that is written twice holds the last value, by requests of its own', async () => {
    const items = ['Line1.Mask', 'Motor_1', 'label:Line1.Mask']
    const results = await client.writeEach(items.map((item, at) => ({ item, value: at + 1 })))
    expect(results.every(({ ok }) => ok)).toBe(true)
    expect([plc.labels.get('Line1.Mask'), plc.labels.get('Motor_1')]).toEqual([3, 2])
    expect(asked).toEqual(['readRandomLabels', 'writeRandomLabels', 'writeRandomLabels'])
  })

  test('a label in other letters may be the same one: it goes out behind the first', async () => {
    const results = await client.writeEach({ 'Line1.Mask': 1, 'label:LINE1.MASK': 2 })
    expect(Object.values(results).every(({ ok }) => ok)).toBe(true)
    expect(asked).toEqual(['readRandomLabels', 'writeRandomLabels', 'writeRandomLabels'])
  })

  test('a device that is written twice is refused, also with a label between', async () => {
    const entries = ['D100', 'Line1.Ready', 'D100'].map((item) => ({ item, value: item === 'D100' ? 1 : true }))
    const results = await client.writeEach(entries)
    expect(results.map(({ ok }) => ok)).toEqual([false, true, false])
  })

  test('plans tell what they will send as far as it is known', async () => {
    const plan = client.planWrite([
      { item: 'Line1.Speed', value: 2 },
      { item: 'Line1.Values[0]', value: [1, 2] },
      { item: 'D100', value: 1 },
      { item: 'Q5', value: 1 },
    ])
    const { requests, notes } = plan.describe()
    expect(requests.map(({ command, requestBytes }) => [command, typeof requestBytes])).toEqual([
      ['readRandomLabels', 'number'],
      ['writeRandomLabels', 'undefined'],
      ['writeArrayLabels', 'undefined'],
      ['writeWords', 'number'],
    ])
    expect(notes.join(' ')).toMatch(/The PLC says the types of labels before they are written.*Q5 is not written/)
    expect(plan.toString()).toContain('unknown bytes out')
    const results = await plan.runEach()
    expect(results.map(({ ok }) => ok)).toEqual([true, true, true, false])
    expect(asked).toEqual(requests.map(({ command }) => command))
  })

  test('refused without allowWrites, before the types are read', async () => {
    const reader = createMelsecClient({ host: 'in memory', port: 1, profile: 'iq-r', openTransport: plc.connect() })
    await expect(reader.write('label:Line1.Ready', true)).rejects.toMatchObject({ code: 'NOT_PERMITTED' })
    await expect(reader.write({ 'label:Line1.Ready': true, M0: true })).rejects.toMatchObject({ code: 'NOT_PERMITTED' })
    await reader.close()
    expect(asked).toEqual([])
    expect(plc.labels.get('Line1.Ready')).toBe(false)
  })
})

describe('in ASCII code', () => {
  test('a value of two words needs the order of its words, which the client can be told', async () => {
    const ascii = createPlcSimulator({
      profile: 'iq-r',
      code: 'ascii',
      labels: { Speed: { type: 'REAL', value: 2.5 } },
    })
    const open = (asciiWordOrder?: 'low-first') =>
      createMelsecClient({
        host: 'in memory',
        port: 1,
        profile: 'iq-r',
        code: 'ascii',
        allowWrites: true,
        openTransport: ascii.connect(),
        ...(asciiWordOrder === undefined ? {} : { asciiWordOrder }),
      })
    const unsure = open()
    await expect(unsure.read('Speed')).rejects.toMatchObject({ code: 'BAD_OPTION', field: 'asciiWordOrder' })
    await unsure.close()
    const sure = open('low-first')
    await expect(sure.read('Speed')).resolves.toBe(2.5)
    await sure.write('Speed', 1.5)
    await expect(sure.labels.read('Speed')).resolves.toBe(1.5)
    await sure.close()
    await ascii.close()
    const wrong = { host: 'x', port: 1, asciiWordOrder: 'up' } as unknown as Parameters<typeof createMelsecClient>[0]
    expect(() => createMelsecClient(wrong)).toThrow('asciiWordOrder')
  })
})
