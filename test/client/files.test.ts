/** Files of the CPU by name: through sockets, against the drives of the simulated PLC, in every form there is. */
import { afterEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/entry/simulator'
import {
  ClosedError,
  ConnectionError,
  createMelsecClient,
  EndCodeError,
  type FileProgress,
  fileTimeOf,
  type MelsecClient,
  type MelsecOptions,
  type NetworkPlc,
  RequestError,
} from '../../src/index'

const closing: (() => Promise<void>)[] = []
afterEach(async () => {
  for (const close of closing.splice(0).reverse()) await close()
})

interface Joined {
  readonly plc: MelsecClient
  readonly simulator: PlcSimulator
}

async function join(
  profile: 'iq-r' | 'q' | 'l' | 'iq-f',
  client: Partial<MelsecOptions & NetworkPlc> = {},
  options: Partial<PlcSimulatorOptions> = {},
): Promise<Joined> {
  const code = client.code ?? 'binary'
  const simulator = createPlcSimulator({ profile, code, ...options })
  await simulator.listen()
  closing.push(() => simulator.close())
  const port = (client.transport === 'udp' ? simulator.udp?.port : simulator.tcp?.port) ?? 0
  const plc = createMelsecClient({ host: '127.0.0.1', port, profile, allowWrites: true, ...client })
  closing.push(() => plc.close())
  return { plc, simulator }
}

/** Bytes that show it when two chunks change places. */
function bytes(size: number): Buffer {
  return Buffer.from(Array.from({ length: size }, (_, i) => (i * 7 + (i >> 8)) & 0xff))
}

/** True from the request on that so many have gone before. */
function fromThe(requests: number): () => boolean {
  let seen = 0
  return () => seen++ >= requests
}

function thrown<T>(run: Promise<T>): Promise<unknown> {
  return run.then(
    () => undefined,
    (error: unknown) => error,
  )
}

const forms = [
  { title: 'iQ-R, binary', profile: 'iq-r', client: {} },
  { title: 'iQ-R, ASCII', profile: 'iq-r', client: { code: 'ascii' } },
  { title: 'Q, binary', profile: 'q', client: {} },
  { title: 'Q, ASCII', profile: 'q', client: { code: 'ascii' } },
  { title: 'L, binary', profile: 'l', client: {} },
  { title: 'iQ-R, UDP with serial numbers', profile: 'iq-r', client: { transport: 'udp', frame: '4E' } },
] as const

describe.each(forms)('$title', ({ profile, client }) => {
  test('content of every size comes and goes as it is', async () => {
    const { plc, simulator } = await join(profile, client)
    for (const size of [0, 1, 2, 1919, 1920, 1921, 3841]) {
      const content = bytes(size)
      await plc.files.write('4:A.CSV', content, { mode: 'replace' })
      expect(simulator.files.read(4, 'A.CSV')).toEqual(content)
      expect(await plc.files.read('4:/A.CSV')).toEqual(content)
    }
    expect(simulator.files.open).toEqual([])
    const names = (await plc.files.list('4:')).map(({ name }) => name)
    expect(names).toContain('A.CSV')
    expect(names.filter((name) => name.endsWith('.TMP'))).toEqual([])
  })

  test('lists more than one request can carry, and every entry once', async () => {
    const { plc, simulator } = await join(profile, client, { drives: { 4: { files: {} } } })
    const names = Array.from({ length: 100 }, (_, i) => `F${String(i).padStart(3, '0')}.CSV`)
    for (const name of names) simulator.files.write(4, name, name)
    const entries = await plc.files.list('4:')
    expect(entries.map(({ name }) => name).sort()).toEqual(names)
    expect(entries[0]).toMatchObject({ kind: 'file', readOnly: false, size: 8, path: `4:\\${entries[0]?.name}` })
  })

  test('stat, attribute, date, copy and remove', async () => {
    const { plc, simulator } = await join(profile, client)
    const date = { year: 2010, month: 4, day: 1, hour: 20, minute: 50, second: 58 }
    await plc.files.write('4:A.CSV', bytes(10))
    await plc.files.setDate('4:A.CSV', date)
    await plc.files.setAttribute('4:A.CSV', 'readOnly')
    expect(await plc.files.stat('4:A.CSV')).toMatchObject({ readOnly: true, size: 10, modified: date, kind: 'file' })
    expect(await thrown(plc.files.remove('4:A.CSV'))).toBeInstanceOf(EndCodeError)
    await plc.files.setAttribute('4:A.CSV', 'readWrite')
    await plc.files.copy('4:A.CSV', '2:B.CSV')
    expect(simulator.files.read(2, 'B.CSV')).toEqual(bytes(10))
    await plc.files.remove('4:A.CSV')
    expect(await plc.files.stat('4:A.CSV')).toBeUndefined()
  })

  test('reports progress, and a stream gives the same bytes', async () => {
    const { plc, simulator } = await join(profile, client)
    simulator.files.write(4, 'A.CSV', bytes(5000))
    const told: FileProgress[] = []
    const chunks: Buffer[] = []
    for await (const chunk of plc.files.readStream('4:A.CSV', { onProgress: (at) => told.push(at) })) chunks.push(chunk)
    expect(Buffer.concat(chunks)).toEqual(bytes(5000))
    expect(told).toEqual([1920, 3840, 5000].map((done) => ({ done, total: 5000 })))
    expect(simulator.files.open).toEqual([])
  })
})

describe('names', () => {
  test('Shift-JIS on Q, UTF-16 with directories on iQ-R', async () => {
    const q = await join('q')
    await q.plc.files.write('2:運転.CSV', bytes(4))
    expect(q.simulator.files.read(2, '運転.CSV')).toEqual(bytes(4))
    expect((await q.plc.files.list('2:')).map(({ name }) => name)).toContain('運転.CSV')
    const r = await join('iq-r')
    await r.plc.files.write('4:/ARCHIVE/運転記録2026年.CSV', bytes(4))
    expect(r.simulator.files.read(4, 'ARCHIVE\\運転記録2026年.CSV')).toEqual(bytes(4))
    const [entry] = (await r.plc.files.list('4:/ARCHIVE/')).filter(({ name }) => name.startsWith('運転'))
    expect(entry?.path).toBe('4:\\ARCHIVE\\運転記録2026年.CSV')
    expect(await r.plc.files.read(entry?.path ?? '')).toEqual(bytes(4))
    expect(await r.plc.files.stat('4:/ARCHIVE')).toMatchObject({ kind: 'directory', size: 0 })
  })

  test.each([
    ['no drive', 'A.CSV', /number of its drive/],
    ['no number', { drive: '4', path: 'A.CSV' }, /number of its drive/],
    ['a drive that is not there', '9:A.CSV', /no drive 9; it has 1 \(device\/label memory\)/],
    ['the root', '4:/', /root of a drive/],
    ['a forbidden character', '4:A?.CSV', /no file name can have/],
    ['a way out of the drive', '4:../A.CSV', /path from the root/],
    ['a long name', `4:${'A'.repeat(65)}`, /65 characters, at most 64/],
  ])('%s is refused before anything is sent', async (_, file, message) => {
    const { plc } = await join('iq-r')
    const error = await thrown(plc.files.read(file as string))
    expect(error).toBeInstanceOf(RequestError)
    expect(String(error)).toMatch(message)
    expect(plc.statistics.requests).toBeLessThanOrEqual(1)
    expect(plc.statistics.answered).toBe(0)
  })

  test('a name that 0000 cannot say is refused on Q', async () => {
    const { plc } = await join('q')
    expect(String(await thrown(plc.files.read('4:TOOLONGNAME.CSV')))).toMatch(/1 to 8 characters/)
    expect(String(await thrown(plc.files.read('4:DIR/A.CSV')))).toMatch(/no directories/)
  })

  test('a family without files says so', async () => {
    const { plc } = await join('iq-f')
    expect(plc.files.drives).toEqual([])
    const error = await thrown(plc.files.list('4:'))
    expect(error).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
  })
})

describe('writing', () => {
  test('needs allowWrites, and nothing is sent without it', async () => {
    const { plc, simulator } = await join('iq-r', { allowWrites: false })
    const { files } = plc
    const calls = [
      files.write('4:A.CSV', bytes(1)),
      files.copy('4:LINE.CSV', '4:A.CSV'),
      files.remove('4:LINE.CSV'),
      files.setAttribute('4:LINE.CSV', 'readOnly'),
      files.setDate('4:LINE.CSV', fileTimeOf(new Date())),
    ]
    for (const call of calls) expect(await thrown(call)).toMatchObject({ code: 'NOT_PERMITTED', outcome: 'notSent' })
    expect(plc.statistics.bytesSent).toBe(0)
    expect(await files.read('4:LINE.CSV')).toEqual(simulator.files.read(4, 'LINE.CSV'))
  })

  test('never takes the place of a file unasked', async () => {
    const { plc, simulator } = await join('iq-r')
    const before = simulator.files.read(4, 'LINE.CSV')
    const error = await thrown(plc.files.write('4:LINE.CSV', bytes(3)))
    expect(error).toMatchObject({ code: 'BAD_OPTION', field: 'mode' })
    expect(simulator.files.read(4, 'LINE.CSV')).toEqual(before)
  })

  test('a replacement that fails leaves the old file, and nothing else', async () => {
    const { plc, simulator } = await join('iq-r')
    const before = simulator.files.read(4, 'LINE.CSV')
    const names = (await plc.files.list('4:')).map(({ name }) => name)
    simulator.faults.add({ kind: 'endCode', commands: ['writeFile'], endCode: 0x41e4, times: 1, when: fromThe(1) })
    const error = await thrown(plc.files.write('4:LINE.CSV', bytes(4000), { mode: 'replace' }))
    expect(error).toMatchObject({ endCode: 0x41e4 })
    expect(simulator.files.read(4, 'LINE.CSV')).toEqual(before)
    expect((await plc.files.list('4:')).map(({ name }) => name)).toEqual(names)
    expect(simulator.files.open).toEqual([])
  })

  test('overwriting needs the same size', async () => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, 'A.CSV', bytes(3000))
    const other = Buffer.alloc(3000, 1)
    await plc.files.write('4:A.CSV', other, { mode: 'overwrite' })
    expect(simulator.files.read(4, 'A.CSV')).toEqual(other)
    const error = await thrown(plc.files.write('4:A.CSV', bytes(2999), { mode: 'overwrite' }))
    expect(error).toMatchObject({ code: 'BAD_OPTION', field: 'mode' })
    expect(simulator.files.read(4, 'A.CSV')).toEqual(other)
  })

  test.each(['MAIN.PRG', 'FB1.pfb'])('%s is never overwritten, but replaced', async (name) => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, name, bytes(100))
    const other = Buffer.alloc(100, 1)
    const { requests } = simulator.statistics
    const error = await thrown(plc.files.write(`4:${name}`, other, { mode: 'overwrite' }))
    expect(error).toMatchObject({ code: 'BAD_OPTION', field: 'mode', outcome: 'notSent' })
    expect(simulator.statistics.requests).toBe(requests)
    await plc.files.write(`4:${name}`, other, { mode: 'replace' })
    expect(simulator.files.read(4, name)).toEqual(other)
  })

  test('files of a project are made by way of another name', async () => {
    const { plc, simulator } = await join('q')
    await plc.files.write('4:MAIN.QPG', bytes(2500))
    expect(simulator.files.read(4, 'MAIN.QPG')).toEqual(bytes(2500))
    expect((await plc.files.list('4:')).map(({ name }) => name)).not.toContain('MJW00.TMP')
  })

  test('a stream, in parts of any size', async () => {
    const { plc, simulator } = await join('iq-r')
    const content = bytes(6001)
    async function* parts() {
      for (let at = 0; at < content.length; at += 37) yield content.subarray(at, at + 37)
    }
    await plc.files.write('4:A.CSV', parts(), { size: content.length })
    expect(simulator.files.read(4, 'A.CSV')).toEqual(content)
  })

  test.each([
    ['too few bytes', [bytes(100)], 200],
    ['too many bytes', [bytes(100), bytes(200)], 200],
  ])('a stream with %s fails and leaves no file', async (_, parts, size) => {
    const { plc, simulator } = await join('iq-r')
    const error = await thrown(plc.files.write('4:A.CSV', parts, { size }))
    expect(error).toMatchObject({ code: 'BAD_VALUE', field: 'size' })
    expect(simulator.files.read(4, 'A.CSV')).toBeUndefined()
    expect(simulator.files.open).toEqual([])
  })

  test('a stream that fails takes its unfinished file with it', async () => {
    const { plc, simulator } = await join('iq-r')
    async function* broken() {
      yield bytes(5000)
      throw new Error('disk on fire')
    }
    expect(String(await thrown(plc.files.write('4:A.CSV', broken(), { size: 9000 })))).toMatch(/disk on fire/)
    expect(simulator.files.read(4, 'A.CSV')).toBeUndefined()
    expect(simulator.files.open).toEqual([])
  })

  test.each([
    ['a stream without size', [bytes(1)], {}, 'size'],
    ['a size that is not that of the data', bytes(2), { size: 3 }, 'size'],
    ['text', 'abc', {}, 'data'],
    ['another mode', bytes(2), { mode: 'append' }, 'mode'],
    ['a password that is none', bytes(2), { password: 5 }, 'password'],
  ])('%s is refused before anything is sent', async (_, data, options, field) => {
    const { plc } = await join('iq-r')
    const error = await thrown(plc.files.write('4:A.CSV', data as Buffer, options as object))
    expect(error).toBeInstanceOf(RequestError)
    expect(error).toMatchObject({ field })
    expect(plc.statistics.bytesSent).toBe(0)
  })
})

describe('passwords', () => {
  test('open a protected file, and are in no error and no trace', async () => {
    const { plc, simulator } = await join('q')
    const traced: string[] = []
    plc.on('trace', (entry) => traced.push(JSON.stringify(entry)))
    await plc.files.write('4:S.CSV', bytes(20), { password: 'Kx7q' })
    expect(simulator.files.read(4, 'S.CSV')).toEqual(bytes(20))
    const error = await thrown(plc.files.read('4:S.CSV', { password: 'Zz9w' }))
    expect(error).toBeInstanceOf(EndCodeError)
    expect(await plc.files.read('4:S.CSV', { password: 'Kx7q' })).toEqual(bytes(20))
    await plc.files.copy('4:S.CSV', '4:T.CSV', { password: 'Kx7q' })
    expect(await plc.files.read('4:T.CSV', { password: 'Kx7q' })).toEqual(bytes(20))
    const secrets = ['Kx7q', 'Zz9w'].flatMap((text) => [text, Buffer.from(text).toString('hex')])
    for (const secret of secrets)
      expect(`${traced.join()}${String(error)}`.toLowerCase()).not.toContain(secret.toLowerCase())
  })
})

describe('whatever happens, the file is closed', () => {
  test('when reading is refused', async () => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, 'A.CSV', bytes(5000))
    simulator.faults.add({ kind: 'endCode', commands: ['readFile'], endCode: 0x41e4, times: 1, when: fromThe(1) })
    expect(await thrown(plc.files.read('4:A.CSV'))).toMatchObject({ endCode: 0x41e4 })
    expect(simulator.files.open).toEqual([])
  })

  test('when the caller has enough', async () => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, 'A.CSV', bytes(50_000))
    const stream = plc.files.readStream('4:A.CSV')
    const closed = new Promise((resolve) => stream.once('close', resolve))
    for await (const chunk of stream) {
      expect(chunk.length).toBeGreaterThan(0)
      expect(simulator.files.open).toHaveLength(1)
      break
    }
    await closed
    expect(simulator.files.open).toEqual([])
  })

  test('when the client is closed', async () => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, 'A.CSV', bytes(50_000))
    let closed: Promise<void> | undefined
    const error = await thrown(plc.files.read('4:A.CSV', { onProgress: () => (closed ??= plc.close()) }))
    expect(error).toMatchObject({ code: 'CLOSED' })
    await closed
    expect(simulator.files.open).toEqual([])
  })

  test('when it is aborted while it is being opened', async () => {
    const { plc, simulator } = await join('iq-r')
    const controller = new AbortController()
    plc.on('trace', ({ direction }) => {
      if (direction === 'sent' && plc.statistics.requests === 1) controller.abort()
    })
    const error = await thrown(plc.files.read('4:LINE.CSV', { signal: controller.signal }))
    expect(error).toMatchObject({ code: 'ABORTED' })
    expect(simulator.files.open).toEqual([])
    expect(plc.statistics.answered).toBeGreaterThanOrEqual(2)
  })

  test.each(['4E', '3E'] as const)('when it is aborted, also in the middle of a request (%s)', async (frame) => {
    const { plc, simulator } = await join('iq-r', { frame })
    simulator.files.write(4, 'A.CSV', bytes(50_000))
    const controller = new AbortController()
    let reads = 0
    plc.on('trace', ({ direction, text }) => {
      if (direction === 'sent' && text.includes('Read File') && ++reads === 2) controller.abort()
    })
    expect(await thrown(plc.files.read('4:A.CSV', { signal: controller.signal }))).toMatchObject({ code: 'ABORTED' })
    expect(reads).toBe(2)
    expect(simulator.files.open).toEqual([])
    expect(plc.statistics.disconnects).toBe(0)
  })

  test('when it is aborted', async () => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, 'A.CSV', bytes(50_000))
    const controller = new AbortController()
    const onProgress = () => controller.abort()
    const error = await thrown(plc.files.read('4:A.CSV', { signal: controller.signal, onProgress }))
    expect(error).toBeInstanceOf(ClosedError)
    expect(simulator.files.open).toEqual([])
  })

  test('and says so when it cannot be: nobody may think that nothing is left behind', async () => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, 'A.CSV', bytes(50_000))
    simulator.faults.add({ kind: 'endCode', endCode: 0xc056, commands: ['closeFile'] })
    const controller = new AbortController()
    const onProgress = () => controller.abort()
    const error = await thrown(plc.files.read('4:A.CSV', { signal: controller.signal, onProgress }))
    expect(error).toMatchObject({ code: 'UNFINISHED', outcome: 'unknown', cause: { code: 'ABORTED' } })
    expect(String(error)).toMatch(
      /A\.CSV could not be closed, and may be locked in the PLC.* What failed first: .*aborted/,
    )
    expect(simulator.files.open).toHaveLength(1)
  })

  test('when it is larger than the limit', async () => {
    const { plc, simulator } = await join('iq-r')
    simulator.files.write(4, 'A.CSV', bytes(5000))
    expect(await thrown(plc.files.read('4:A.CSV', { limit: 4999 }))).toMatchObject({ code: 'LIMIT_EXCEEDED' })
    expect(simulator.files.open).toEqual([])
    expect(await plc.files.read('4:A.CSV', { limit: 5000 })).toEqual(bytes(5000))
  })
})

test('closeAll() that cannot be sent ends no transfer', async () => {
  const { plc, simulator } = await join('iq-r')
  simulator.files.write(4, 'A.CSV', bytes(5000))
  const refused: Promise<unknown>[] = []
  const onProgress = () => refused.push(thrown(plc.files.closeAll({ timeout: -1 })))
  expect(await plc.files.read('4:A.CSV', { onProgress })).toEqual(bytes(5000))
  expect(await refused[0]).toMatchObject({ code: 'BAD_OPTION', field: 'timeout' })
})

describe('a connection that is lost', () => {
  test('ends the transfer: its pointer is not used on the next one', async () => {
    const { plc, simulator } = await join('iq-r', { settleGap: 1, reconnect: { first: 1 } })
    simulator.files.write(4, 'A.CSV', bytes(9000))
    simulator.faults.add({ kind: 'disconnect', commands: ['readFile'], times: 1, when: fromThe(2) })
    const error = await thrown(plc.files.read('4:A.CSV'))
    expect(error).toBeInstanceOf(ConnectionError)
    expect(String(error)).toMatch(/could not be closed, and may be locked in the PLC until closeAll\(\)/)
    expect(simulator.files.open).toHaveLength(1)
    await plc.connect()
    const answered = plc.statistics.answered
    await plc.files.closeAll()
    expect(plc.statistics.answered).toBe(answered + 1)
    expect(simulator.files.open).toEqual([])
    expect(await plc.files.read('4:A.CSV')).toEqual(bytes(9000))
  })

  test('never writes into another file', async () => {
    const { plc, simulator } = await join('iq-r', { settleGap: 1, reconnect: { first: 1 } })
    simulator.faults.add({ kind: 'disconnect', commands: ['writeFile'], times: 1, when: fromThe(1) })
    const error = await thrown(plc.files.write('4:A.CSV', bytes(9000)))
    expect(error).toMatchObject({ outcome: 'unknown' })
    await plc.connect()
    expect(simulator.files.open).toHaveLength(1)
    expect(simulator.files.read(4, 'A.CSV')?.subarray(3840)).toEqual(Buffer.alloc(9000 - 3840))
  })
})

test('over UDP without serial numbers an open file would not be found again', async () => {
  const { plc } = await join('iq-r', { transport: 'udp', frame: '3E' })
  expect(await thrown(plc.files.read('4:LINE.CSV'))).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
  expect((await plc.files.list('4:')).length).toBeGreaterThan(0)
})

test('a file that is being read is refused to others by the PLC, until it has been read', async () => {
  const { plc, simulator } = await join('iq-r')
  const port = simulator.tcp?.port ?? 0
  const other = createMelsecClient({ host: '127.0.0.1', port, profile: 'iq-r', allowWrites: true })
  closing.push(() => other.close())
  // More than a stream reads ahead.
  simulator.files.write(4, 'A.CSV', bytes(300_000))
  const stream = plc.files.readStream('4:A.CSV')
  const closed = new Promise((resolve) => stream.once('close', resolve))
  const chunks = stream[Symbol.asyncIterator]()
  await chunks.next()
  expect(await thrown(other.files.remove('4:A.CSV'))).toBeInstanceOf(EndCodeError)
  while ((await chunks.next()).done !== true);
  await closed
  await other.files.remove('4:A.CSV')
  expect(simulator.files.read(4, 'A.CSV')).toBeUndefined()
})
