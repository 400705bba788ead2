/** Items of a Sharp JW: what is read and written by which requests, and what becomes of each item. */
import { afterEach, describe, expect, test } from '@jest/globals'
import type { JwClient } from '../../../src/client/jw/client'
import type { JwClientOptions } from '../../../src/client/jw/options'
import type { PlcClient, ReadValue } from '../../../src/index'
import { assumedJwAreas } from '../../../src/jw/operand/area'
import { brief, failureOf, until } from '../line'
import { inMemory, SmallJw } from './small-jw'

let client: JwClient
let plc: SmallJw

function start(options: JwClientOptions = {}, made?: SmallJw): void {
  const joined = inMemory(options, made)
  client = joined.client
  plc = joined.plc
}

afterEach(async () => {
  await client.close()
})

/** Requests of a plan, without what they are for. */
function texts(plan: { describe(): { requests: readonly { text: string }[] } }): string[] {
  return plan.describe().requests.map(({ text }) => text)
}

describe('reading', () => {
  test('values of all kinds, with their types', async () => {
    start({ areas: assumedJwAreas })
    plc.files.get(0)?.set([0x34, 0x12, 0x00, 0x00, 0x48, 0x42, 0x59], 0o4000)
    plc.files.get(0)?.set([0b1010], 0o403)
    plc.files.get(2)?.set(Buffer.from('HELLO'), 0o12345)
    plc.system.set([5], 0o201)
    plc.timers.set(0o12, { word: 0x9234, attribute: 0x08 })
    const word: number = await client.read('09000:WORD')
    const bit: boolean = await client.read('004033')
    const bits: boolean[] = await client.read('004030[5]')
    const text: string = await client.read('F2:012345:STRING(5)')
    expect([word, bit, bits, text]).toEqual([0x1234, true, [false, true, false, true, false], 'HELLO'])
    expect(await client.read('09002:REAL')).toBe(50)
    expect(await client.read('09006:BCD8')).toBe(59)
    expect(await client.read('#0201')).toBe(5)
    expect(await client.read('TMR0012')).toBe(1234)
    expect(await client.read('TMR0012:WORD')).toBe(0x9234)
    expect(await client.read('T-C0000')).toBe(false)
  })

  test('a client of any family takes it, and knows nothing of the values', async () => {
    start()
    const any: PlcClient = client
    const value: ReadValue = await any.read('09000')
    expect(value).toBe(0)
  })

  test('a timer that is a counter in the PLC is no value, and the others are', async () => {
    start()
    plc.timers.set(0, { word: 0x0001, attribute: 0x0e })
    plc.timers.set(1, { word: 0x0012, attribute: 0x09 })
    const results = await client.read(['TMR0000', 'TMR0001', 'CNT0000'])
    expect(results.map(brief)).toEqual(['BAD_FIELD', 0x12, 1])
    expect(client.state.name).toBe('connected')
    expect(plc.asked).toEqual(['monitorTimersCounters'])
  })

  test('near operands share a request, relays are read as their bytes, and no gap is wider than allowed', () => {
    start({ gap: 8, lists: false })
    expect(texts(client.plan(['09000', '09010', '09004:INT', '09022', '004033', '004041']))).toEqual([
      'Read data memory (24H): file 0, 004000 to 004010, 9 bytes',
      'Read data memory (24H): file 0, 004022, 1 byte',
      'Read data memory (24H): file 0, 000403 to 000404, 2 bytes',
    ])
  })

  test('scattered operands share a list', async () => {
    start()
    plc.files.get(0)?.set([9], 0o4000)
    plc.files.get(2)?.set([0xff, 0xff], 0)
    const plan = client.plan(['F2:0:INT', '09000', '004033', 'F1:00100000'])
    expect(texts(plan)).toEqual([
      'Monitor registers (27H): file 2, 000000 to 000001, file 1, 100000, file 0, 000403, file 0, 004000, 5 bytes',
    ])
    expect((await plan.run()).map(brief)).toEqual([-1, 9, false, 0])
  })

  test('an array larger than a request is cut between values and marked torn; a value never is', async () => {
    start()
    plc.files.get(1)?.set(Buffer.alloc(3000, 7), 0)
    const [result] = await client.read(['F1:0:DINT[600]'])
    expect(result).toMatchObject({ ok: true, torn: true })
    expect(result.ok && new Set(result.value)).toEqual(new Set([0x07070707]))
    expect(client.plan(['F1:0:DINT[600]']).describe()).toMatchObject({
      requests: [{ points: 1024 }, { points: 1024 }, { points: 352 }],
      notes: ['F1:0:DINT[600] is read by 3 requests: its values may be of different moments.'],
    })
    expect(await failureOf(client.read('F1:0:STRING(1100)'))).toMatchObject({ code: 'LIMIT_EXCEEDED' })
  })

  test.each([
    [{ transport: 'tcp' }, 1024],
    [{ transport: 'udp' }, 1011],
    [{ transport: 'udp', header: 'zero40' }, 971],
    [{ transport: 'udp', header: 'zero40', model: 'jw30h' }, 974],
    [{ transport: 'tcp', header: { pda: 1, psa: 2, slot: 3, station: 4 } }, 256],
    [{ transport: 'tcp', maxData: 100 }, 100],
  ] as const)('%j: a request reads %i bytes', (options, bytes) => {
    start(options, new SmallJw(options.transport === 'udp' ? 'datagram' : 'stream'))
    expect(client.plan(['F1:0[1024]']).describe().requests[0]).toMatchObject({ points: bytes })
  })

  test('an array across 64 KiB of the file registers is read in extended addresses', async () => {
    start()
    plc.files.get(1)?.set([1, 2], 0xfffe)
    plc.files.get(2)?.set([3, 4], 0)
    expect(await client.read('F1:177776[4]')).toEqual([1, 2, 3, 4])
    expect(plc.messages).toEqual([{ head: { file: 1, address: 0xfffe, extended: true }, length: 4 }])
    expect(await client.read('F1:200001')).toBe(4)
    expect(plc.messages.at(-1)).toEqual({ head: { file: 2, address: 1 }, length: 1 })
  })

  test('a model without extended addresses has neither them nor lists', async () => {
    start({ model: 'jw30h' })
    expect((await client.read(['F1:200000', '09000', '004033'])).map(brief)).toEqual(['UNSUPPORTED', 0, false])
    expect(plc.asked).toEqual(['readDataMemory', 'readDataMemory'])
  })

  test('the program memory of a JW30H is not taken for data, nor the others with it', async () => {
    start({ model: 'jw30h' })
    expect((await client.read(['F8:0', '09000', 'F9:7.1'])).map(brief)).toEqual(['OUT_OF_RANGE', 0, 'OUT_OF_RANGE'])
    const written = await client.writeEach([
      { item: 'F8:0', value: 1 },
      { item: 'F9:7.1', value: true },
      { item: '09000', value: 1 },
    ])
    expect(written.map(({ ok }) => ok)).toEqual([false, false, true])
    expect(plc.asked).toEqual(['readDataMemory', 'writeDataMemory'])
  })

  test('one item that does not exist does not take the others with it, and is asked for apart later on', async () => {
    start()
    const items = ['09000', 'F9:0', '004033', 'F2:0', 'F3:17'] as const
    const plan = client.plan(items)
    for (let run = 0; run < 3; run++) {
      const results = await plan.run()
      expect(results.map(brief)).toEqual([0, 'END_CODE', false, 0, 0])
      expect(results[1]).toMatchObject({ error: { endCode: 0x08 } })
    }
    expect(plan.describe().notes[0]).toContain('F9:0 is read apart from the others.')
    plc.asked.length = 0
    await plan.run()
    expect(plc.asked.sort()).toEqual(['monitorRegisters', 'readDataMemory'])
  })

  test('a PLC that takes no lists is read without them, from then on by every plan', async () => {
    start()
    plc.refusals.set('monitorRegisters', 0x01)
    const items = ['09000', 'F2:0', '004033']
    expect((await client.read(items)).map(brief)).toEqual([0, 0, false])
    expect(plc.asked).toEqual(['monitorRegisters', 'readDataMemory', 'readDataMemory', 'readDataMemory'])
    const later = client.plan(['09000', 'F3:0'])
    expect(texts(later)).toHaveLength(2)
    expect(later.describe().notes.join()).toContain('Lists of scattered operands are not used')
  })

  test('an error about the PLC is given to all items, and nothing more is asked', async () => {
    start()
    plc.refusals.set('monitorRegisters', 0x0f)
    const results = await client.read(['09000', 'F2:0', '004033'])
    expect(results.map(brief)).toEqual(['END_CODE', 'END_CODE', 'END_CODE'])
    expect(plc.asked).toEqual(['monitorRegisters'])
  })

  test('what is no item, or only written, has its own error', async () => {
    start()
    const results = await client.readEach({ a: '09000', b: 'D100', c: 'TMR0000:BOOL', d: 5 as never, e: '016000' })
    expect(Object.values(results).map(brief)).toEqual([0, 'BAD_ADDRESS', 'UNSUPPORTED', 'BAD_ADDRESS', 'OUT_OF_RANGE'])
  })

  test('the marker before each address is understood by a PLC that writes it so', async () => {
    start({ marker: 'each' }, new SmallJw('stream', { marker: 'each' }))
    plc.files.get(2)?.set([3], 0)
    expect(await client.readValues(['09000', 'F2:0'])).toEqual([0, 3])
    expect(plc.asked).toEqual(['monitorRegisters'])
  })
})

describe('a PLC that writes the marker otherwise and says nothing to the first list', () => {
  test('is read without lists from then on, also by plans that were made before', async () => {
    start({ timeout: 100 }, new SmallJw('stream', { marker: 'each' }))
    const plan = client.plan(['09000', 'F2:0'])
    const before = client.plan(['F2:1', 'F3:0'])
    expect((await plan.run()).map(brief)).toEqual(['TIMEOUT', 'TIMEOUT'])
    await until(() => client.state.name === 'connected')
    expect((await plan.run({ timeout: 5000 })).map(brief)).toEqual([0, 0])
    expect((await before.run({ timeout: 5000 })).map(brief)).toEqual([0, 0])
    expect(plan.describe().notes.join()).toContain('try the other marker')
  })

  test('is written without lists from then on, and nothing was sent before', async () => {
    start({ timeout: 100 }, new SmallJw('stream', { marker: 'each' }))
    const values = { '09000': 1, 'F2:0': 2 }
    const before = client.planWrite([
      { item: '09001', value: 3 },
      { item: 'F2:1', value: 4 },
    ])
    expect(await failureOf(client.write(values))).toMatchObject({ outcome: 'notSent' })
    await until(() => client.state.name === 'connected')
    await client.write(values, { timeout: 5000 })
    await before.run({ timeout: 5000 })
    expect([plc.byte(0, 0o4000), plc.byte(2, 0), plc.byte(0, 0o4001), plc.byte(2, 1)]).toEqual([1, 2, 3, 4])
  })
})

describe('writing', () => {
  test('values of all kinds', async () => {
    start()
    plc.timers.set(0o12, { word: 0x1234, attribute: 0x08 })
    await client.write({
      '09000:INT': -2,
      '09002:REAL': 50,
      '004033': true,
      'F2:012345:STRING(5)': 'HELLO',
      '#0201': 5,
      'TMR0012:BOOL': true,
      'F1:0:BCD16[2]': [1234, 99],
    })
    expect(Buffer.from(plc.files.get(0)?.subarray(0o4000, 0o4006) ?? []).toString('hex')).toBe('feff00004842')
    expect(plc.byte(0, 0o403)).toBe(0b1000)
    expect(Buffer.from(plc.files.get(2)?.subarray(0o12345, 0o12352) ?? []).toString()).toBe('HELLO')
    expect(plc.system[0o201]).toBe(5)
    expect(plc.timers.get(0o12)?.word).toBe(0)
    expect(Buffer.from(plc.files.get(1)?.subarray(0, 4) ?? []).toString('hex')).toBe('34129900')
  })

  const plans: readonly (readonly [string, Readonly<Record<string, unknown>>, readonly string[], JwClientOptions?])[] =
    [
      [
        'bytes in a row, in whatever order',
        { '09002': 3, '09000:INT': 0x0201 },
        ['Write data memory (34H): file 0, 004000 to 004002, 3 bytes'],
      ],
      [
        'bytes that are all the same',
        { '09000[8]': [7, 7, 7, 7, 7, 7, 7, 7] },
        ['Fill data memory (35H): file 0, 004000 to 004007, 8 bytes'],
      ],
      [
        'scattered bytes',
        { '09000': 1, '09002': 2, 'F2:0:INT': 3 },
        ['Write registers (37H): file 0, 004000, file 0, 004002, file 2, 000000 to 000001, 4 bytes'],
      ],
      [
        'scattered bytes without lists',
        { '09000': 1, '09002': 2 },
        ['Write data memory (34H): file 0, 004000, 1 byte', 'Write data memory (34H): file 0, 004002, 1 byte'],
        { lists: false },
      ],
      ['one relay', { '004033': true }, ['Set/reset relay (30H): set file 0, 000403.3']],
      [
        'relays',
        { '004033': true, '004100': false },
        ['Set/reset relays (31H): file 0, 000403.3, file 0, 000410.0, 2 relays'],
      ],
      [
        'relays that fill bytes',
        { '004030[8]': [true, false, false, false, false, false, false, true] },
        ['Write data memory (34H): file 0, 000403, 1 byte'],
      ],
      [
        'some relays of two bytes',
        { '004036[4]': [true, false, true, true] },
        ['Set/reset relays (31H): file 0, 000403.6, file 0, 000403.7, file 0, 000404.0, file 0, 000404.1, 4 relays'],
      ],
      [
        'data before the relay that says they are there',
        { '09000': 1, '004033': true, '09001': 2 },
        [
          'Write data memory (34H): file 0, 004000, 1 byte',
          'Set/reset relay (30H): set file 0, 000403.3',
          'Write data memory (34H): file 0, 004001, 1 byte',
        ],
      ],
      ['a timer', { 'CNT0012:BOOL': false }, ['Set/reset timer or counter (32H): reset numbers 0012']],
      ['system memory', { '#0201': 1, '#0202': 2 }, ['Write system memory (54H): system memory 0201 to 0202, 2 bytes']],
    ]

  test.each(plans.map(([name, values, expected, options = {}]) => [name, values, expected, options] as const))(
    '%s',
    (_name, values, expected, options) => {
      start(options)
      const entries = Object.entries(values).map(([item, value]) => ({ item, value: value as number }))
      expect(texts(client.planWrite(entries))).toEqual(expected)
    },
  )

  test('before a list is written for the first time, one is read; what it would change is what it reads', async () => {
    start()
    await client.write({ '09000': 1, 'F2:0': 2 })
    await client.write({ '004033': true, 'F2:1.0': true })
    expect(plc.asked).toEqual(['monitorRegisters', 'writeRegisters', 'setRelays'])
    expect([plc.byte(0, 0o4000), plc.byte(2, 0), plc.byte(0, 0o403), plc.byte(2, 1)]).toEqual([1, 2, 8, 1])
  })

  test('a PLC that reads no list is written without them, and each item has its own result', async () => {
    start()
    plc.refusals.set('monitorRegisters', 0x01)
    const results = await client.writeEach({ '09000': 1, 'F2:0': 2, 'F2:1': 3 })
    expect(Object.values(results).map(({ ok }) => ok)).toEqual([true, true, true])
    expect(plc.asked).toEqual(['monitorRegisters', 'writeDataMemory', 'writeDataMemory', 'writeDataMemory'])
    await client.write('004036[4]', [true, false, true, true])
    expect(plc.asked.slice(4)).toEqual(['setRelay', 'setRelay', 'setRelay', 'setRelay'])
    expect([plc.byte(0, 0o403), plc.byte(0, 0o404)]).toEqual([0b0100_0000, 0b11])
  })

  test('an item that does not exist is found by the list that is read before, and the others are written', async () => {
    start()
    const results = await client.writeEach({ '09000': 1, 'F9:0': 2 })
    expect(results['09000'].ok).toBe(true)
    expect(results['F9:0']).toMatchObject({ ok: false, error: { endCode: 0x08 } })
    expect(plc.byte(0, 0o4000)).toBe(1)
  })

  test('a refused byte or relay was not written, so that what follows it is', async () => {
    start()
    const results = await client.writeEach({ 'F9:0': 1, '09000': 2, 'F9:1.0': true, 'TMR7777:BOOL': true, '09001': 3 })
    expect(Object.values(results).map((result) => (result.ok ? 'written' : result.error.outcome))).toEqual([
      'refused',
      'written',
      'refused',
      'refused',
      'written',
    ])
    expect([plc.byte(0, 0o4000), plc.byte(0, 0o4001)]).toEqual([2, 3])
  })

  test('of a refused number of several bytes nobody knows, and nothing behind it is sent', async () => {
    start({ lists: false })
    const results = await client.writeEach({ 'F9:0:INT': 1, '09000': 2 })
    expect(Object.values(results)).toMatchObject([{ error: { outcome: 'unknown' } }, { error: { outcome: 'notSent' } }])
  })

  test('bits of the system memory need readModifyWrite', async () => {
    start()
    plc.system[0o201] = 0b1000_0001
    expect(await failureOf(client.write('#0201.1', true))).toMatchObject({ code: 'UNSUPPORTED' })
    await client.write('#0201.1', true, { readModifyWrite: true })
    expect(plc.system[0o201]).toBe(0b1000_0011)
  })

  test.each([
    ['a byte that is too large', '09000', 256, 'BAD_VALUE'],
    ['a relay that is no boolean', '004033', 1, 'BAD_VALUE'],
    ['a current value', 'TMR0012', 5, 'UNSUPPORTED'],
    ['an array for one value', '09000', [1], 'BAD_VALUE'],
    ['too few values', '09000[2]', [1], 'BAD_VALUE'],
    ['one value for an array', '09000[2]', 1, 'BAD_VALUE'],
    ['what no source places', '016000', true, 'OUT_OF_RANGE'],
    ['an MD, which nothing sets or resets', 'MD0012:BOOL', true, 'BAD_TYPE'],
  ])('%s is refused before anything is sent', async (_name, item, value, code) => {
    start()
    expect(await failureOf(client.write(item, value as number))).toMatchObject({ code, outcome: 'notSent' })
    expect(plc.asked).toEqual([])
  })

  test('the same byte twice in one call is refused, also by another name', async () => {
    start()
    const results = await client.writeEach({ '09000:INT': 1, 'F0:004001': 2, '09010': 3 })
    expect(Object.values(results).map(({ ok }) => ok)).toEqual([false, false, true])
    const crossing = await client.writeEach({ 'F1:177777[2]': [1, 2], 'F2:0': 3 })
    expect(Object.values(crossing).map(({ ok }) => ok)).toEqual([false, false])
    expect(plc.byte(0, 0o4001)).toBe(0)
  })

  test('an object whose order JavaScript does not keep is refused: it moves whole numbers to the front', async () => {
    start()
    const error = await failureOf(client.write({ '004033': true, '19000': 1 }))
    expect(error).toMatchObject({ code: 'BAD_OPTION', outcome: 'notSent' })
    await client.write([
      { item: '09000', value: 5 },
      { item: '19000', value: 1 },
    ])
    await client.write({ '19000': 2 })
    expect([plc.byte(0, 0o4000), plc.byte(0, 0o5000)]).toEqual([5, 2])
  })

  test('all or nothing: one bad value keeps the others from being sent', async () => {
    start()
    const writing = client.write({ '09000': 1, '09010': 256 }, { allOrNothing: true })
    expect(await failureOf(writing)).toMatchObject({ code: 'NOT_ALL_WRITTEN', outcome: 'notSent' })
    expect(plc.asked).toEqual([])
  })

  test('a large array is written in parts, and a failure between them says how far it came', async () => {
    start()
    let writes = 0
    plc.script = (asked) => {
      writes += 1
      if (writes === 2) asked.peer.send(asked.refuse(0x10))
      else asked.reply()
    }
    const values = Array.from({ length: 1500 }, (_, i) => i % 256)
    const error = await failureOf(client.write('F1:0[1500]', values))
    expect(error).toMatchObject({ outcome: 'unknown' })
    expect(error.message).toContain('the first 1024 values were written')
    expect(plc.asked).toHaveLength(2)
  })

  test('behind a write of unknown outcome nothing more is sent', async () => {
    start({ timeout: 80, lists: false })
    await client.connect()
    plc.script = () => {}
    const results = await client.writeEach({ '09000': 1, '09010': 2 })
    expect(Object.values(results)).toMatchObject([{ error: { outcome: 'unknown' } }, { error: { outcome: 'notSent' } }])
    expect(plc.asked).toEqual(['writeDataMemory'])
  })
})

test('explain says where an item lies', () => {
  start()
  expect(client.explain('09012:INT[4]')).toEqual({
    text: '09012:INT[4]',
    type: 'INT',
    count: 4,
    place: 'file 0, byte 004012',
  })
  expect(client.explain('04033').place).toBe('file 0, byte 000403, bit 3')
  expect(client.explain('TMR0012').place).toBe('timer, counter or MD 0012')
})
