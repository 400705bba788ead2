/** The client of this package and a simulated Sharp JW: made of the same declarations, joined as users join them. */
import { afterEach, describe, expect, test } from '@jest/globals'
import {
  createJwSimulator,
  type JwFaultAction,
  type JwSimulator,
  type JwSimulatorOptions,
  startDemoBottling,
} from '../../src/entry/simulator'
import { createJwClient, findJwHeader, type JwClient, type JwClientOptions } from '../../src/index'

const open: { close(): Promise<void> }[] = []
afterEach(async () => {
  for (const one of open.splice(0).reverse()) await one.close()
})

const KINDS = ['tcp', 'udp', 'memory', 'memory udp'] as const
type Kind = (typeof KINDS)[number]

async function joined(
  kind: Kind,
  options: JwSimulatorOptions = {},
  client: JwClientOptions = {},
): Promise<{ plc: JwSimulator; client: JwClient }> {
  const plc = createJwSimulator({ writeMode: 2, ...options })
  open.push(plc)
  await plc.listen()
  const transport = kind.endsWith('udp') ? 'udp' : 'tcp'
  const port = plc[transport]?.port ?? 0
  const memory = plc.connect({ kind: transport === 'udp' ? 'datagram' : 'stream' })
  const made = createJwClient({
    host: '127.0.0.1',
    port,
    transport,
    allowWrites: true,
    allowControl: true,
    allowParameters: true,
    ...(kind.startsWith('memory') ? { openTransport: memory } : {}),
    ...client,
  })
  open.push(made)
  return { plc, client: made }
}

/** After a fault the client makes a new connection by itself. */
function connected(client: JwClient): Promise<void> {
  return new Promise((resolve) => {
    if (client.state.name === 'connected') return resolve()
    const end = client.on('state', ({ name }) => {
      if (name !== 'connected') return
      end()
      resolve()
    })
  })
}

describe.each(KINDS)('over %s', (kind) => {
  test('items of every sort are read and written, alone, together and across 1024 bytes', async () => {
    const { plc, client } = await joined(kind, {
      timers: { TMR0000: { flag: true }, CNT0001: { direction: 'up', coding: 'binary' } },
    })
    await client.write('09012:INT', -5)
    await client.write('004033', true)
    await client.write('09020:STRING(5)', 'hello')
    await client.write('F1:00177776:DINT', 0x12345678)
    expect(['09012:INT', '004033', '09020:STRING(5)', 'F1:00177776:DINT'].map((item) => plc.read(item))).toEqual([
      -5,
      true,
      'hello',
      0x12345678,
    ])
    plc.write('TMR0000', 1234)
    plc.write('CNT0001', 300)
    plc.write('#0201', 7)
    const read = await client.readValues({
      a: '09012:INT',
      b: '004033',
      c: 'TMR0000',
      d: 'CNT0001',
      e: '#0201',
      f: 'F1:00177776:DINT',
    })
    expect(read).toEqual({ a: -5, b: true, c: 1234, d: 300, e: 7, f: 0x12345678 })
    const many = Array.from({ length: 3000 }, (_, i) => i % 256)
    await client.write('F1:00000000[3000]', many)
    expect(await client.read('F1:00000000[3000]')).toEqual(many)
  })
})

describe('all that the client has, against the simulated PLC', () => {
  test('control, clock and information', async () => {
    const { plc, client } = await joined('tcp')
    await client.control.stop({ verify: true })
    expect([await client.control.runState(), plc.cpu.state]).toEqual([expect.anything(), 'STOP'])
    await client.control.release({ verify: true })
    await client.control.stopBlock(3)
    expect([await client.control.blockState(3), await client.control.blockState(4)]).toEqual(['stopped', 'running'])
    expect(await client.control.setWriteMode('data')).toBe('all')
    expect(plc.cpu.writeMode).toBe(1)
    const time = { year: 26, month: 2, day: 28, dayOfWeek: 6, hour: 12, minute: 30, second: 15 }
    await client.clock.set(time)
    expect(await client.clock.read()).toMatchObject({ year: 26, month: 2, day: 28, dayOfWeek: 6, hour: 12, minute: 30 })
    await client.clock.adjust({ stop: true, resetFraction: true })
    expect(await client.clock.read()).toEqual(await client.clock.read())
    expect(await client.selfTest()).toEqual({ roundTrip: expect.any(Number) })
    expect(await client.info()).toBeDefined()
  })

  test('parameters go into a unit by the start switch, and the check code comes back', async () => {
    const { plc, client } = await joined('tcp', {
      optionUnits: [{ rack: 0, unit: 2, kind: 'dl1', parameters: Buffer.alloc(0o200, 1) }],
    })
    const unit = client.parameters.optionUnit({ rack: 0, unit: 2 })
    const { checkCode } = await unit.write([{ address: 0o100, bytes: Buffer.alloc(16, 4) }])
    expect(plc.optionUnit(0, 2)).toMatchObject({ started: true, error: undefined })
    expect(checkCode).toBe((0o100 + 16 * 4 + 0o60) % 256)
    expect(Buffer.from(await unit.read(0o76, 4))).toEqual(Buffer.of(1, 1, 4, 4))
    const io = client.parameters.specialIo({ rack: 0, unit: 3 })
    await io.write(0, Buffer.of(1, 2))
    expect(Buffer.from(await io.read(0, 3))).toEqual(Buffer.of(1, 2, 0))
  })

  test('secret function and buffers', async () => {
    const { plc, client } = await joined('tcp', {
      ringBuffers: { 0: { file: 1, address: 0, length: 16 } },
      specifiedBuffers: { 0: { file: 2, address: 0, length: 16 } },
    })
    const { secret } = client
    await secret.register('Ab12', false)
    await secret.register('Ab12', true)
    await secret.enable()
    expect(await secret.isEnabled()).toBe(true)
    await expect(secret.release('ab12')).rejects.toMatchObject({ endCode: 0x33 })
    await secret.release('Ab12')
    await secret.erasePassword()
    expect(plc.secret).toEqual({ enabled: false, hasPassword: false })

    const { ring, specified } = client.buffers
    expect(await ring.write(0, Buffer.from('hello'))).toMatchObject({ written: 5, free: 10 })
    expect(plc.ringBuffers.take(0, 2)).toEqual(Buffer.from('he'))
    const first = await ring.read(0, 2, { confirmed: true })
    expect([Buffer.from(first.data).toString(), first.more]).toEqual(['ll', true])
    const next = await ring.read(0, 2, { confirmed: true, acknowledge: true })
    expect([Buffer.from(next.data).toString(), next.more]).toEqual(['o', false])
    await specified.write(0, 3, Buffer.of(9))
    expect(Buffer.from(await specified.read(0, 2, 3))).toEqual(Buffer.of(0, 9, 0))
    expect(await specified.info(0)).toMatchObject({ file: 2, length: 16 })
  })

  test.each(['none', 'zero40', { pda: 1, psa: 2, slot: 3, station: 4 }, Buffer.of(1, 2, 3)] as const)(
    'the header %p',
    async (header) => {
      const { plc, client } = await joined('tcp', { header }, { header })
      await client.write('09012', 5)
      expect(plc.read('09012')).toBe(5)
    },
  )

  test.each(['none', 'zero40'] as const)('the header %s is found', async (header) => {
    const { plc } = await joined('tcp', { header })
    const found = await findJwHeader({ host: '127.0.0.1', port: plc.tcp?.port ?? 0, timeout: 500, connectTimeout: 500 })
    expect(found.header).toBe(header)
  })

  test.each(['once', 'each'] as const)('scattered items with FFH %s', async (marker) => {
    const { plc, client } = await joined('tcp', { marker }, { marker, gap: 0 })
    plc.write('09012', 5)
    plc.write('F1:00200000', 6)
    expect(await client.readValues(['09012', '59777', 'F1:00200000', '007777'])).toEqual([5, 0, 6, false])
  })

  test('a PLC of the family JW30H, which has no lists', async () => {
    const { plc, client } = await joined('tcp', { model: 'jw30h' }, { model: 'jw30h' })
    plc.write('09012', 5)
    expect(await client.readValues(['09012', '59777', 'F2:000000'])).toEqual([5, 0, 0])
  })

  test('writes without write mode are refused with the reason', async () => {
    const { plc, client } = await joined('tcp', { writeMode: 0 })
    await expect(client.write('09012', 5)).rejects.toThrow('10H')
    await client.control.setWriteMode('data')
    await client.write('09012', 5)
    expect(plc.read('09012')).toBe(5)
  })

  test('faults: what is lost is not believed, and what is late is not taken for another answer', async () => {
    const { plc, client } = await joined('tcp', {}, { timeout: 300, reconnect: { first: 10 }, settleGap: 0 })
    plc.write('09012', 5)
    expect(await client.read('09012')).toBe(5)
    const strikes: readonly JwFaultAction[] = [
      { kind: 'cut', at: 6 },
      { kind: 'damaged', at: 2, mask: 0x10 },
      { kind: 'late' },
      { kind: 'silence' },
    ]
    for (const fault of strikes) {
      plc.faults.add({ ...fault, times: 1, commands: ['readDataMemory'] })
      await expect(client.read('09012')).rejects.toMatchObject({ code: expect.stringMatching(/TIMEOUT|ECHO_MISMATCH/) })
      await connected(client)
    }
    plc.write('19012', 9)
    expect(await client.read('19012')).toBe(9)
  })

  test('the other header in an answer is taken, as it is detected', async () => {
    const { plc, client } = await joined('udp')
    plc.faults.add({ kind: 'otherHeader' })
    plc.write('09012', 5)
    expect(await client.read('09012')).toBe(5)
  })

  test('the bottling line is watched and its recipe written', async () => {
    const { plc, client } = await joined('memory')
    startDemoBottling(plc, { interval: 5 })
    await client.writeValues({ '19000:UINT': 300, '19010:STRING(16)': 'Green tea' })
    expect(await client.readValues(['19000:UINT', '19010:STRING(16)', '004010'])).toEqual([300, 'Green tea', true])
  })
})
