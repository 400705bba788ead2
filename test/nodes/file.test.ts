/** The file node in a real Node-RED, against the drives of a simulated PLC. */
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import type { PlcSimulator } from '../../src/entry/simulator'
import type { FileEntry } from '../../src/index'
import { until } from '../client/line'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { type CaughtError, catchNode, connectionTo, fileNode, readNode, startPlc, variable } from './flow'

type Settings = Readonly<Record<string, unknown>>

let red: NodeRed
let plc: PlcSimulator

const modified = { year: 2026, month: 1, day: 15, hour: 8, minute: 30, second: 0 }

beforeAll(async () => {
  red = await startNodeRed()
}, 60_000)

afterAll(() => red.stop())

beforeEach(async () => {
  plc = await startPlc({
    drives: {
      2: false,
      4: {
        files: {
          'LINE.CSV': { data: 'A,1\r\n', modified },
          'SJIS.CSV': Buffer.from('89b793780d0a', 'hex'),
          'LOG\\DAY.CSV': { data: 'x', readOnly: true, modified },
          'SECRET.CSV': { data: 'hidden', password: 'Sesame-1' },
        },
      },
    },
  })
})

afterEach(async () => {
  await red.deploy([])
  await plc.close()
  red.forget()
})

const writable = (more: Settings = {}) => connectionTo(plc, { allowWrites: true, ...more })

async function send(message: Settings = {}): Promise<Message> {
  await red.receive('file', message)
  const answer = await red.next('file')
  expect(await red.completed('file')).not.toHaveProperty('error')
  return answer
}

async function caught(message: Settings = {}): Promise<Message & { error: CaughtError }> {
  await red.receive('file', message)
  expect(await red.completed('file')).toHaveProperty('error')
  return (await red.next('catch')) as Message & { error: CaughtError }
}

/** Deploys a node and sends it one message. */
async function once(settings: Settings, message: Settings = {}): Promise<Message> {
  await red.deploy([writable(), fileNode(settings)])
  return send(message)
}

async function failing(settings: Settings, message: Settings = {}): Promise<CaughtError> {
  await red.deploy([writable(), fileNode(settings), catchNode()])
  return (await caught(message)).error
}

const content = (name: string) => plc.files.read(4, name)

describe('looking', () => {
  test('at a directory: its entries, and the rest of the message stays', async () => {
    const message = await once({ action: 'list', file: '4:/' }, { _msgid: 'a', topic: 'files', payload: 'x' })
    const entries = message.payload as FileEntry[]
    expect(message).toEqual({ _msgid: 'a', topic: 'files', payload: entries })
    expect(entries.map(({ name }) => name).sort()).toEqual(['LINE.CSV', 'LOG', 'SECRET.CSV', 'SJIS.CSV'])
    const line = { name: 'LINE.CSV', path: '4:\\LINE.CSV', kind: 'file', readOnly: false, size: 5, modified }
    expect(entries).toContainEqual(expect.objectContaining(line))
  })

  test('at one file, out of the message; null when there is none', async () => {
    await red.deploy([connectionTo(plc), fileNode({ action: 'stat', file: 'file', fileType: 'msg' })])
    expect((await send({ file: '4:/LOG/DAY.CSV' })).payload).toMatchObject({ readOnly: true, size: 1, kind: 'file' })
    expect((await send({ file: { drive: 4, path: 'LOG' } })).payload).toMatchObject({ kind: 'directory', size: 0 })
    expect((await send({ file: '4:/NONE.CSV', payload: 5 })).payload).toBeNull()
  })
})

describe('reading', () => {
  test('a Buffer, without permission to write', async () => {
    await red.deploy([connectionTo(plc), fileNode({ action: 'read', file: '4:/LINE.CSV' })])
    expect((await send()).payload).toEqual(Buffer.from('A,1\r\n'))
    expect(plc.files.open).toEqual([])
  })

  test('text in the chosen encoding', async () => {
    const text = { action: 'read', output: 'text' }
    expect((await once({ ...text, file: '4:/LINE.CSV' })).payload).toBe('A,1\r\n')
    expect((await once({ ...text, file: '4:/SJIS.CSV', encoding: 'shift-jis' })).payload).toBe('温度\r\n')
  })

  test.each(['utf8', 'ascii'])('what is no text in %s is an error, not question marks', async (encoding) => {
    const error = await failing({ action: 'read', output: 'text', file: '4:/SJIS.CSV', encoding })
    expect(error).toMatchObject({ code: 'BAD_FIELD', message: expect.stringContaining('set the encoding') })
  })

  test('a file over the limit is refused, and closed', async () => {
    expect(await failing({ action: 'read', file: '4:/LINE.CSV', limit: '4' })).toMatchObject({
      code: 'LIMIT_EXCEEDED',
      message: expect.stringContaining('5 bytes'),
    })
    expect(plc.files.open).toEqual([])
    expect((await once({ action: 'read', file: '4:/LINE.CSV', limit: '5' })).payload).toHaveLength(5)
  })

  test('what is not there has its end code', async () => {
    const error = await failing({ action: 'read', file: '4:/NONE.CSV' })
    expect(error).toMatchObject({ code: 'END_CODE', cause: { endCode: 0x41c5, outcome: 'refused' } })
    await red.status('file', { fill: 'red', text: 'end code 41C5' })
  })
})

describe('writing', () => {
  test('a Buffer and text; the message is passed on as it was', async () => {
    const write = { action: 'write', file: '4:/NEW.CSV', mode: 'replace', encoding: 'shift-jis' }
    const payload = Buffer.from([0, 1, 255])
    expect(await once(write, { _msgid: 'a', topic: 't', payload })).toEqual({ _msgid: 'a', topic: 't', payload })
    expect(content('NEW.CSV')).toEqual(payload)
    expect((await send({ payload: '温度\r\n' })).payload).toBe('温度\r\n')
    expect(content('NEW.CSV')?.toString('hex')).toBe('89b793780d0a')
    await send({ payload: '' })
    expect(content('NEW.CSV')).toHaveLength(0)
    expect(plc.files.open).toEqual([])
  })

  test('bytes and dates that a function node has made', async () => {
    const func =
      'msg.payload = new Uint8Array([1, 2, 3]).subarray(1); msg.when = new Date(2024, 1, 29, 12, 30, 15); return msg'
    await red.deploy([
      writable(),
      { id: 'make', type: 'function', func, outputs: 1, wires: [['file']] },
      fileNode({ action: 'write', file: '4:/NEW.BIN', wires: [['date']] }),
      { ...fileNode({ action: 'setDate', file: '4:/NEW.BIN', date: 'when', dateType: 'msg' }), id: 'date' },
    ])
    await red.receive('make', {})
    await red.next('date')
    await red.next('file')
    await red.completed('file')
    expect(content('NEW.BIN')).toEqual(Buffer.from([2, 3]))
    expect((await once({ action: 'stat', file: '4:/NEW.BIN' })).payload).toMatchObject({
      modified: { year: 2024, month: 2, day: 29, hour: 12, minute: 30, second: 14 },
    })
  })

  test('what is there is refused, replaced or overwritten', async () => {
    const write = { action: 'write', file: '4:/LINE.CSV' }
    expect(await failing(write, { payload: 'B,2\r\n' })).toMatchObject({ cause: { outcome: 'notSent' } })
    expect(content('LINE.CSV')?.toString()).toBe('A,1\r\n')
    expect(await failing({ ...write, mode: 'overwrite' }, { payload: 'longer' })).toMatchObject({ code: 'BAD_OPTION' })
    await once({ ...write, mode: 'overwrite' }, { payload: 'C,3\r\n' })
    expect(content('LINE.CSV')?.toString()).toBe('C,3\r\n')
    await once({ ...write, mode: 'replace' }, { payload: 'longer' })
    expect(content('LINE.CSV')?.toString()).toBe('longer')
  })

  test.each([[5], [{ a: 1 }], [['A', 'B']], [true], [null], [undefined], [new Date(0)]])(
    '%j is no content',
    async (payload) => {
      const error = await failing({ action: 'write', file: '4:/NEW.CSV' }, { payload })
      expect(error).toMatchObject({ code: 'BAD_INPUT', cause: { outcome: 'notSent', field: 'data' } })
      expect(content('NEW.CSV')).toBeUndefined()
    },
  )

  test('a character that the encoding does not have is not replaced by another', async () => {
    const error = await failing({ action: 'write', file: '4:/NEW.CSV', encoding: 'ascii' }, { payload: '20 °C' })
    expect(error).toMatchObject({ code: 'BAD_VALUE', message: expect.stringContaining('U+00B0') })
    expect(content('NEW.CSV')).toBeUndefined()
  })
})

describe('changing', () => {
  test('copies and deletes', async () => {
    await once({ action: 'copy', file: '4:/LINE.CSV', to: '4:/LOG/COPY.CSV' }, { payload: 7 })
    expect(content('LOG\\COPY.CSV')?.toString()).toBe('A,1\r\n')
    expect((await once({ action: 'remove', file: '4:/LINE.CSV' }, { payload: 7 })).payload).toBe(7)
    expect(content('LINE.CSV')).toBeUndefined()
  })

  const stat = async () => (await once({ action: 'stat', file: '4:/LINE.CSV' })).payload as FileEntry

  test('sets and takes away write protection', async () => {
    await once({ action: 'setAttribute', file: '4:/LINE.CSV', attribute: 'readOnly' })
    expect(await stat()).toMatchObject({ readOnly: true })
    expect(await failing({ action: 'remove', file: '4:/LINE.CSV' })).toMatchObject({ code: 'END_CODE' })
    await once({ action: 'setAttribute', file: '4:/LINE.CSV', attribute: 'readWrite' })
    expect(await stat()).toMatchObject({ readOnly: false })
  })

  test('sets the date: milliseconds, a Date, its parts, or now', async () => {
    const dated = { action: 'setDate', file: '4:/LINE.CSV' }
    const moment = new Date(2025, 11, 31, 23, 59, 59)
    const parts = { year: 2025, month: 12, day: 31, hour: 23, minute: 59, second: 58 }
    for (const payload of [moment, moment.getTime(), parts]) {
      await once({ action: 'setDate', file: '4:/LINE.CSV', date: '', dateType: 'date' })
      const { year, ...rest } = (await stat()).modified
      expect(Math.abs(new Date().getFullYear() - year)).toBeLessThanOrEqual(1)
      expect(rest).not.toEqual(parts)
      await once({ ...dated, date: 'payload', dateType: 'msg' }, { payload })
      expect((await stat()).modified).toEqual(parts)
    }
  })

  test.each([['2025-12-31'], [{ year: 2025 }], [null], [Number.NaN], [{ ...modified, month: 13 }], [0]])(
    'the date %j is refused',
    async (payload) => {
      const error = await failing(
        { action: 'setDate', file: '4:/LINE.CSV', date: 'payload', dateType: 'msg' },
        { payload },
      )
      expect(error.cause).toMatchObject({ outcome: 'notSent' })
      expect((await stat()).modified).toEqual(modified)
    },
  )

  test.each([
    [{ action: 'write', file: '4:/NEW.CSV' }],
    [{ action: 'copy', file: '4:/LINE.CSV', to: '4:/NEW.CSV' }],
    [{ action: 'remove', file: '4:/LINE.CSV' }],
    [{ action: 'setAttribute', file: '4:/LINE.CSV' }],
    [{ action: 'setDate', file: '4:/LINE.CSV' }],
  ])('%j needs the tick of the connection', async (settings) => {
    await red.deploy([connectionTo(plc), fileNode(settings), catchNode()])
    const { error } = await caught({ payload: 'x' })
    expect(error).toMatchObject({ code: 'NOT_PERMITTED', cause: { outcome: 'notSent' } })
    expect(content('NEW.CSV')).toBeUndefined()
    expect(content('LINE.CSV')?.toString()).toBe('A,1\r\n')
  })

  test('what a lost connection has left open is closed', async () => {
    plc.faults.add({ kind: 'disconnect', commands: ['readFile'], times: 1 })
    expect(await failing({ action: 'read', file: '4:/LINE.CSV' })).toMatchObject({
      cause: { outcome: 'unknown' },
      message: expect.stringContaining('may be locked'),
    })
    expect(plc.files.open).toHaveLength(1)
    await red.deploy([connectionTo(plc), fileNode({ action: 'closeAll', file: '' })])
    await red.status('file', { fill: 'green' })
    expect((await send({ payload: 1 })).payload).toBe(1)
    expect(plc.files.open).toEqual([])
  })
})

describe('the password of a file', () => {
  const secret = (password: string) => ({ action: 'read', file: '4:/SECRET.CSV', credentials: { password } })

  test('opens it, and stays apart from the flow', async () => {
    expect((await once(secret('Sesame-1'))).payload).toEqual(Buffer.from('hidden'))
    const flows = await red.http('GET', 'flows')
    expect(flows.text).not.toContain('Sesame-1')
    expect((await red.http('GET', 'credentials/melsec-jw-file/file')).json()).toEqual({ has_password: true })
  })

  test.each(['Sesame-2', 'much too long for a password of a file'.repeat(3), '温度'])(
    'a wrong one is refused and not repeated: %s',
    async (password) => {
      const error = await failing(secret(password))
      expect(['END_CODE', 'BAD_MESSAGE']).toContain(error.code)
      expect(JSON.stringify([error, red.log])).not.toContain(password)
    },
  )

  test('may be an environment variable; one that is not set is named', async () => {
    const env = [{ name: 'FILE_PASSWORD', value: 'Sesame-1', type: 'str' }]
    const tab = { id: 'own-tab', type: 'tab', label: 'own', env }
    const node = (name: string) => ({ ...fileNode(secret(variable(name))), z: 'own-tab', x: 200, y: 100 })
    await red.deploy([tab, writable(), node('FILE_PASSWORD'), { ...catchNode(), z: 'own-tab', x: 200, y: 200 }])
    expect((await send()).payload).toEqual(Buffer.from('hidden'))
    await red.deploy([tab, writable(), node('NOT_SET'), { ...catchNode(), z: 'own-tab', x: 200, y: 200 }])
    expect((await caught()).error).toMatchObject({
      code: 'NOT_CONFIGURED',
      message: expect.stringContaining('NOT_SET'),
    })
  })

  test('without it the file is not read', async () => {
    expect(await failing({ action: 'read', file: '4:/SECRET.CSV' })).toMatchObject({ code: 'END_CODE' })
  })
})

describe('a long transfer', () => {
  const LONG = 1920 * 40
  const bytes = Buffer.from(Array.from({ length: LONG }, (_, at) => (at * 7 + (at >> 8)) & 0xff))
  const slow = (command: 'readFile' | 'writeFile', ms: number) =>
    plc.faults.add({ kind: 'delay', ms, commands: [command] })

  test('is told in the status, and lets other nodes have their turn', async () => {
    plc.files.write(4, 'LONG.BIN', bytes)
    plc.write('D100', 5)
    slow('readFile', 10)
    await red.deploy([connectionTo(plc), fileNode({ action: 'read', file: '4:/LONG.BIN' }), readNode(['D100'])])
    await red.receive('file', {})
    await red.status('file', { fill: 'blue', shape: 'dot', text: 'reading 20 %' })
    await red.receive('read', {})
    expect((await red.next('read')).payload).toEqual({ D100: 5 })
    expect(red.pending('file')).toEqual([])
    expect((await red.next('file')).payload).toEqual(bytes)
    await red.completed('file')
    await red.status('file', { fill: 'green' })
    const told = red.statuses('file').flatMap(({ fill, text }) => (fill === 'blue' ? [text] : []))
    expect(told).toEqual(Array.from({ length: 10 }, (_, tenth) => `reading ${tenth * 10} %`))
  })

  test('is done before the next message is', async () => {
    slow('writeFile', 5)
    await red.deploy([writable(), fileNode({ action: 'write', file: '4:/A.BIN', mode: 'replace' })])
    await red.receive('file', { payload: bytes })
    await red.receive('file', { payload: 'short' })
    await red.receive('file', { payload: 'last' })
    for (const payload of [bytes, 'short', 'last']) {
      expect((await red.next('file')).payload).toEqual(payload)
      expect(await red.completed('file')).not.toHaveProperty('error')
    }
    expect(content('A.BIN')?.toString()).toBe('last')
  })

  test.each(['nodes', 'full'] as const)('that is read ends with the node, without an error (%s)', async (type) => {
    plc.files.write(4, 'LONG.BIN', bytes)
    slow('readFile', 50)
    const connection = connectionTo(plc)
    await red.deploy([connection, fileNode({ action: 'read', file: '4:/LONG.BIN' }), catchNode()])
    await red.receive('file', {})
    await red.receive('file', {})
    await red.status('file', { fill: 'blue' })
    await red.deploy([connection, fileNode({ action: 'stat', file: '4:/LONG.BIN' }), catchNode()], type)
    expect(await red.completed('file')).not.toHaveProperty('error')
    expect(await red.completed('file')).not.toHaveProperty('error')
    await until(() => plc.files.open.length === 0)
    expect((await send()).payload).toMatchObject({ size: LONG })
    expect(red.log).toEqual([])
  })

  test('that is read and cannot be closed is an error all the same', async () => {
    plc.files.write(4, 'LONG.BIN', bytes)
    slow('readFile', 50)
    plc.faults.add({ kind: 'endCode', endCode: 0xc056, commands: ['closeFile'] })
    await red.deploy([connectionTo(plc), fileNode({ action: 'read', file: '4:/LONG.BIN' })])
    await red.receive('file', {})
    await red.status('file', { fill: 'blue' })
    await red.deploy([])
    expect(await red.completed('file')).toMatchObject({
      error: { code: 'UNFINISHED', message: expect.stringContaining('may be locked'), cause: { outcome: 'unknown' } },
    })
  })

  test('that is written is waited for', async () => {
    slow('writeFile', 20)
    await red.deploy([writable(), fileNode({ action: 'write', file: '4:/A.BIN' })])
    await red.receive('file', { payload: bytes })
    await red.status('file', { fill: 'blue', text: 'writing 10 %' })
    await red.deploy([])
    expect(await red.completed('file')).not.toHaveProperty('error')
    expect(content('A.BIN')).toEqual(bytes)
    expect(plc.files.open).toEqual([])
  })

  test('that takes too long is given up, and what is unfinished removed', async () => {
    slow('writeFile', 200)
    await red.deploy([writable(), fileNode({ action: 'write', file: '4:/A.BIN' })])
    await red.receive('file', { payload: bytes })
    await red.receive('file', { payload: 'next' })
    await red.status('file', { fill: 'blue' })
    await red.deploy([])
    expect(await red.completed('file')).toMatchObject({ error: { code: 'ABORTED' } })
    expect(await red.completed('file')).toMatchObject({ error: { code: 'CLOSED', cause: { outcome: 'notSent' } } })
    expect(content('A.BIN')).toBeUndefined()
    expect(plc.files.open).toEqual([])
  })

  test('that overwrites and takes too long is told as unfinished', async () => {
    plc.files.write(4, 'A.BIN', Buffer.alloc(LONG))
    slow('writeFile', 200)
    await red.deploy([writable(), fileNode({ action: 'write', file: '4:/A.BIN', mode: 'overwrite' })])
    await red.receive('file', { payload: bytes })
    await red.status('file', { fill: 'blue' })
    await red.deploy([])
    const { error } = await red.completed('file')
    expect(error).toMatchObject({ code: 'UNFINISHED', cause: { outcome: 'unknown' } })
    expect(error).toMatchObject({ message: expect.stringMatching(/A\.BIN: \d+ of its 76800 bytes are overwritten/) })
    expect(plc.files.open).toEqual([])
  })

  test('more messages than can wait are refused', async () => {
    slow('readFile', 200)
    await red.deploy([connectionTo(plc), fileNode({ action: 'read', file: '4:/LINE.CSV' }), catchNode()])
    for (let sent = 0; sent < 102; sent++) await red.receive('file', { sent })
    expect(await red.next('catch')).toMatchObject({ error: { code: 'QUEUE_FULL', cause: { outcome: 'notSent' } } })
    await red.deploy([])
  })
})

describe('refused', () => {
  test.each([[undefined], [null], [''], ['  '], [5], [{ drive: '4', path: 'A' }], [['4:/A']]])(
    '%j is no file',
    async (file) => {
      const error = await failing({ action: 'stat', file: 'file', fileType: 'msg' }, { file })
      expect(error).toMatchObject({ code: 'BAD_INPUT', cause: { outcome: 'notSent', field: 'file' } })
    },
  )

  test.each([
    ['LINE.CSV', 'BAD_ADDRESS'],
    ['9:/LINE.CSV', 'OUT_OF_RANGE'],
    ['4:/', 'BAD_ADDRESS'],
    ['4:/A?.CSV', 'BAD_MESSAGE'],
    ['2:/A.CSV', 'END_CODE'],
  ])('%s: %s', async (file, code) => {
    expect(await failing({ action: 'read', file })).toMatchObject({ code })
  })

  test.each([
    [{ action: 'format' }],
    [{ action: 'write', mode: 'append' }],
    [{ action: 'read', output: 'json' }],
    [{ action: 'read', encoding: 'latin1' }],
    [{ action: 'read', limit: '1 MB' }],
    [{ action: 'setAttribute', attribute: 'hidden' }],
    [{ action: 'list', fileType: 'bin' }],
    [{ action: 'list', version: 99 }],
  ])('the settings %j', async (settings) => {
    const error = await failing({ file: '4:/LINE.CSV', ...settings }, { payload: 'x' })
    expect(error).toMatchObject({ code: 'NOT_CONFIGURED', cause: { outcome: 'notSent' } })
    await red.status('file', { fill: 'red', text: 'bad settings' })
  })

  test('a family without files', async () => {
    const other = await startPlc({ profile: 'iq-f' })
    await red.deploy([connectionTo(other), fileNode({ action: 'list', file: '4:/' }), catchNode()])
    expect((await caught()).error).toMatchObject({ code: 'UNSUPPORTED', cause: { outcome: 'notSent' } })
    await red.deploy([])
    await other.close()
  })
})

describe('browsing in the editor', () => {
  const browse = async (connection: unknown, directory: unknown) =>
    red.http('POST', 'melsec-jw/file/list', { connection, directory })

  test('shows the drives and directories of a connection that is deployed', async () => {
    await red.deploy([connectionTo(plc), fileNode({ action: 'list' })])
    expect((await browse('plc', '')).json()).toMatchObject({
      ok: true,
      drives: expect.arrayContaining([{ number: 4, title: 'data memory' }]),
    })
    const { entries } = (await browse('plc', '4:/LOG/')).json() as { entries: FileEntry[] }
    expect(entries.map(({ path, kind }) => ({ path, kind }))).toEqual([{ path: '4:\\LOG\\DAY.CSV', kind: 'file' }])
    expect((await browse('plc', '4:/NONE/')).json()).toMatchObject({
      ok: false,
      message: expect.stringMatching(/41CC/),
    })
    expect((await browse('plc', '2:/')).json()).toMatchObject({ ok: false })
  })

  test('leaves no connection behind that no node uses', async () => {
    await red.deploy([connectionTo(plc)])
    expect((await browse('plc', '4:/')).json()).toMatchObject({ ok: true })
    await until(() => plc.connections.length === 0)
  })

  test('asks nobody else', async () => {
    await red.deploy([connectionTo(plc), fileNode({ action: 'list' })])
    for (const id of ['', 'file', 'nothing', '__proto__']) {
      expect((await browse(id, '4:/')).json()).toEqual({ ok: false, message: expect.stringContaining('deployed') })
    }
    expect((await browse(undefined, '4:/')).status).toBe(400)
    expect((await browse('plc', undefined)).status).toBe(400)
    expect((await browse({ host: '127.0.0.1' }, '4:/')).status).toBe(400)
  })
})
