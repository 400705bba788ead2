// The file commands over loopback TCP, as clients send them: procedures and refusals of the manual.
import { afterEach, describe, expect, test } from '@jest/globals'
import type { MelsecClient } from '../../src/client/melsec/client'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { MelsecOptions, NetworkPlc } from '../../src/client/melsec/options'
import { EndCodeError, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/simulator/server'

const open: { close(): Promise<void> }[] = []
afterEach(async () => {
  for (const one of open.splice(0).reverse()) await one.close()
})

interface Pair {
  readonly plc: PlcSimulator
  readonly client: MelsecClient
  /** Another client of the same PLC. */
  readonly another: () => MelsecClient
}

async function pair(
  options: PlcSimulatorOptions = {},
  clientOptions: Partial<MelsecOptions & NetworkPlc> = {},
): Promise<Pair> {
  const plc = createPlcSimulator({ profile: 'iq-r', remoteOwner: 'connection', udp: false, ...options })
  open.push(plc)
  await plc.listen()
  const { host, port } = plc.tcp ?? { host: '', port: 0 }
  const another = () => {
    const settings = { profile: plc.profile.id, code: options.code ?? 'binary', allowWrites: true, allowControl: true }
    const client = createMelsecClient({ host, port, ...settings, ...clientOptions })
    open.push(client)
    return client
  }
  return { plc, client: another(), another }
}

/** End code of a refusal; 0 when it was carried out. */
async function endCode(answer: Promise<unknown>): Promise<number> {
  try {
    await answer
    return 0
  } catch (error) {
    if (error instanceof EndCodeError) return error.endCode
    throw error
  }
}

const csv = { drive: 4, name: 'NEW.CSV' }
const READ = 0
const WRITE = 0x100

const families = (['iq-r', 'q', 'l', 'generic'] as const).flatMap((profile) =>
  (['binary', 'ascii'] as const).map((code) => ({ profile, code })),
)

describe.each(families)('$profile in $code code', ({ profile, code }) => {
  test('a file is made, written in parts, listed, read in parts, copied, dated, protected and deleted', async () => {
    const { plc, client } = await pair({ profile, code })
    const data = Buffer.from(Array.from({ length: 3000 }, (_, i) => i & 0xff))
    await client.request(commands.newFile, { ...csv, size: data.length })
    const { pointer } = await client.request(commands.openFile, { ...csv, mode: WRITE })
    for (let offset = 0; offset < data.length; offset += 1920) {
      const part = data.subarray(offset, offset + 1920)
      expect(await client.request(commands.writeFile, { pointer, offset, data: part })).toEqual({
        written: part.length,
      })
    }
    await client.request(commands.closeFile, { pointer })
    expect(plc.files.read(4, 'NEW.CSV')).toEqual(data)

    const date = { year: 2026, month: 2, day: 28, hour: 23, minute: 59, second: 58 }
    await client.request(commands.changeFileDate, { ...csv, date })
    await client.request(commands.changeFileState, { ...csv, attribute: 0x01 })
    const { fileNumber } = await client.request(commands.searchFile, csv)
    const { files } = await client.request(commands.readDirectory, { drive: 4, start: fileNumber, count: 1 })
    expect(files).toEqual([{ name: 'NEW.CSV', attribute: 0x01, modified: date, size: 3000 }])

    const copy = { drive: 2, name: 'COPY.CSV' }
    const sides = { sourceDrive: 4, sourceName: 'NEW.CSV', destinationDrive: 2, destinationName: 'COPY.CSV' }
    await client.request(commands.copyFile, sides)
    const opened = await client.request(commands.openFile, { ...copy, mode: READ })
    const parts: Buffer[] = []
    for (const [offset, byteCount] of [
      [0, 1920],
      [1920, 1080],
    ] as const) {
      const part = await client.request(commands.readFile, { ...opened, offset, byteCount })
      parts.push(Buffer.from(part.data))
    }
    expect(Buffer.concat(parts)).toEqual(data)
    await client.request(commands.closeFile, opened)
    await client.request(commands.deleteFile, copy)
    expect(plc.files.read(2, 'COPY.CSV')).toBeUndefined()
  })

  test('names of Japanese characters come back as they went', async () => {
    const { client } = await pair({ profile, code })
    const name = '生産表.CSV'
    await client.request(commands.newFile, { drive: 4, name, size: 2 })
    const { fileNumber } = await client.request(commands.searchFile, { drive: 4, name })
    const { files } = await client.request(commands.readDirectory, { drive: 4, start: fileNumber, count: 1 })
    expect(files[0]?.name).toBe(name)
  })
})

describe('lists of files', () => {
  test('directories of iQ-R have . and .., the root has not; reading goes on behind the last file number', async () => {
    const { client } = await pair()
    const path = 'ARCHIVE'
    const first = await client.request(commands.readDirectory, { drive: 4, start: 1, count: 2, path })
    expect(first.files.map(({ name, attribute, size }) => [name, attribute, size])).toEqual([
      ['.', 0x30, 0],
      ['..', 0x30, 0],
    ])
    const start = first.lastFileNumber + 1
    const rest = await client.request(commands.readDirectory, { drive: 4, start, count: 36, path })
    expect(rest.files.map(({ name }) => name)).toEqual(['LINE2025.CSV'])
    const behind = { drive: 4, start: rest.lastFileNumber + 1, count: 36, path }
    expect((await client.request(commands.readDirectory, behind)).files).toEqual([])
    const root = await client.request(commands.readDirectory, { drive: 4, start: 1, count: 36 })
    expect(root.files.map(({ name }) => name)).toEqual(['README.TXT', 'LINE.CSV', 'ARCHIVE'])
    expect(await client.request(commands.searchFile, { drive: 4, name: '\\ARCHIVE\\LINE2025.CSV' })).toEqual({
      fileNumber: 3,
    })
  })

  test('long names make an answer shorter than was asked for', async () => {
    const names = Array.from({ length: 30 }, (_, i) => `${String(i).padStart(2, '0')}${'N'.repeat(56)}.CSV`)
    const { client } = await pair({ drives: { 4: { files: Object.fromEntries(names.map((name) => [name, 'x'])) } } })
    const found: string[] = []
    for (let start = 1; found.length < 30; ) {
      const answer = await client.request(commands.readDirectory, { drive: 4, start, count: 36 })
      expect(answer.files.length).toBeGreaterThan(0)
      expect(answer.files.length).toBeLessThan(30)
      found.push(...answer.files.map(({ name }) => name))
      start = answer.lastFileNumber + 1
    }
    expect(found).toEqual(names)
  })

  test('drive 1 of iQ-R is drive 3', async () => {
    const { client } = await pair()
    const list = (drive: number) => client.request(commands.readDirectory, { drive, start: 1, count: 36 })
    expect(await list(1)).toEqual(await list(3))
  })

  test('Q lists only what its names can say', async () => {
    const files = { 'LONGERNAME.CSV': 'x', 'A.CSV': 'y', 'LOG\\B.CSV': 'z' }
    const { client } = await pair({ profile: 'q', drives: { 4: { files } } })
    const answer = await client.request(commands.readDirectory, { drive: 4, start: 1, count: 36 })
    expect(answer).toMatchObject({ lastFileNumber: 0, files: [{ name: 'A.CSV' }, { name: 'LOG', attribute: 0x30 }] })
  })
})

describe('locks', () => {
  test('many read, whoever writes is alone', async () => {
    const { client, another } = await pair()
    const line = { drive: 4, name: 'LINE.CSV' }
    const other = another()
    await client.request(commands.openFile, { ...line, mode: READ })
    expect(await endCode(other.request(commands.openFile, { ...line, mode: READ }))).toBe(0)
    expect(await endCode(other.request(commands.openFile, { ...line, mode: WRITE }))).toBe(0x41d8)
    const alone = { drive: 4, name: 'README.TXT' }
    await client.request(commands.openFile, { ...alone, mode: WRITE })
    expect(await endCode(other.request(commands.openFile, { ...alone, mode: READ }))).toBe(0x41d8)
  })

  test('what is open is neither deleted nor changed, and not copied while it is written', async () => {
    const { client, another } = await pair()
    const line = { drive: 4, name: 'LINE.CSV' }
    const other = another()
    const { pointer } = await client.request(commands.openFile, { ...line, mode: WRITE })
    const copy = { sourceDrive: 4, sourceName: 'LINE.CSV', destinationDrive: 2, destinationName: 'L.CSV' }
    expect(await endCode(other.request(commands.deleteFile, line))).toBe(0x41d8)
    expect(await endCode(other.request(commands.changeFileState, { ...line, attribute: 1 }))).toBe(0x41d8)
    expect(await endCode(other.request(commands.copyFile, copy))).toBe(0x41d8)
    await client.request(commands.closeFile, { pointer })
    expect(await endCode(other.request(commands.copyFile, copy))).toBe(0)
    expect(await endCode(other.request(commands.deleteFile, line))).toBe(0)
  })

  test("a file pointer is its owner's; close type 1 and 2 close all of his", async () => {
    const { plc, client, another } = await pair()
    const other = another()
    const { pointer } = await client.request(commands.openFile, { drive: 4, name: 'LINE.CSV', mode: READ })
    await client.request(commands.openFile, { drive: 4, name: 'README.TXT', mode: READ })
    const read = { pointer, offset: 0, byteCount: 2 }
    expect(await endCode(other.request(commands.readFile, read))).toBe(0x41d8)
    expect(await endCode(other.request(commands.closeFile, { pointer }))).toBe(0x41d8)
    await other.request(commands.closeFile, { pointer, closeType: 2 })
    expect(plc.files.open).toHaveLength(2)
    await client.request(commands.closeFile, { pointer: 9, closeType: 1 })
    expect(plc.files.open).toEqual([])
    expect(await endCode(client.request(commands.closeFile, { pointer }))).toBe(0x4022)
    expect(await endCode(client.request(commands.readFile, read))).toBe(0x4022)
  })

  test.each([
    ['kept', 1],
    ['released', 0],
  ] as const)('%s when the connection ends', async (fileLocks, left) => {
    const { plc, client } = await pair({ fileLocks })
    await client.request(commands.openFile, { drive: 4, name: 'LINE.CSV', mode: READ })
    const gone = new Promise<void>((resolve) => {
      plc.on('connection', ({ change }) => change === 'closed' && resolve())
    })
    await client.close()
    await gone
    expect(plc.files.open).toHaveLength(left)
    plc.restart()
    expect(plc.files.open).toEqual([])
  })

  test('only so many files are open at the same time', async () => {
    const { client } = await pair({ maxOpenFiles: 2 })
    const line = { drive: 4, name: 'LINE.CSV', mode: READ }
    expect(await client.request(commands.openFile, line)).toEqual({ pointer: 0 })
    expect(await client.request(commands.openFile, line)).toEqual({ pointer: 1 })
    expect(await endCode(client.request(commands.openFile, line))).toBe(0x402c)
    await client.request(commands.closeFile, { pointer: 0 })
    expect(await client.request(commands.openFile, line)).toEqual({ pointer: 0 })
  })
})

describe('refusals', () => {
  const drives = {
    2: false,
    4: {
      files: {
        'FIXED.CSV': { data: 'ab', readOnly: true },
        'SECRET.CSV': { data: 'ab', password: 'A-Z26' },
        'A.CSV': 'abcd',
        'DIR\\B.CSV': 'x',
      },
      capacity: 100,
    },
    3: { writeProtected: true, files: { 'P.CSV': 'ab' } },
  } as const

  const refused: readonly (readonly [what: string, code: number, ask: (client: MelsecClient) => Promise<unknown>])[] = [
    ['no such file', 0x41c5, (c) => c.request(commands.openFile, { drive: 4, name: 'NONE.CSV', mode: READ })],
    ['no card', 0x41c7, (c) => c.request(commands.searchFile, { drive: 2, name: 'A.CSV' })],
    ['no directory', 0x41cc, (c) => c.request(commands.readDirectory, { drive: 4, start: 1, count: 1, path: 'X' })],
    ['a file is no directory', 0x41cc, (c) => c.request(commands.newFile, { drive: 4, size: 1, name: 'A.CSV\\B' })],
    ['a directory is no file', 0x41c5, (c) => c.request(commands.openFile, { drive: 4, name: 'DIR', mode: READ })],
    ['is there already', 0x4028, (c) => c.request(commands.newFile, { drive: 4, size: 1, name: 'a.csv' })],
    ['no room', 0x41cf, (c) => c.request(commands.newFile, { drive: 4, size: 99, name: 'BIG.CSV' })],
    ['project file', 0x41cd, (c) => c.request(commands.newFile, { drive: 4, size: 1, name: 'MAIN.PRG' })],
    ['read-only', 0x41ce, (c) => c.request(commands.openFile, { drive: 4, name: 'FIXED.CSV', mode: WRITE })],
    ['read-only, deleted', 0x41ce, (c) => c.request(commands.deleteFile, { drive: 4, name: 'FIXED.CSV' })],
    ['no password', 0x4026, (c) => c.request(commands.openFile, { drive: 4, name: 'SECRET.CSV', mode: READ })],
    [
      'wrong password',
      0x4026,
      (c) => c.request(commands.deleteFile, { drive: 4, name: 'SECRET.CSV', password: 'other' }),
    ],
    ['protected drive, made', 0x41df, (c) => c.request(commands.newFile, { drive: 3, size: 1, name: 'N.CSV' })],
    ['protected drive, opened', 0x41df, (c) => c.request(commands.openFile, { drive: 3, name: 'P.CSV', mode: WRITE })],
    ['protected drive, deleted', 0x41df, (c) => c.request(commands.deleteFile, { drive: 3, name: 'P.CSV' })],
  ]

  test.each(refused)('%s: %i', async (_what, code, ask) => {
    const { client } = await pair({ drives })
    expect(await endCode(ask(client))).toBe(code)
  })

  test('the right password opens', async () => {
    const { client } = await pair({ drives })
    const secret = { drive: 4, name: 'SECRET.CSV', password: 'A-Z26' }
    expect(await client.request(commands.openFile, { ...secret, mode: READ })).toEqual({ pointer: 0 })
  })

  test('nothing beyond the end, nothing through a pointer for reading', async () => {
    const { plc, client } = await pair({ drives })
    const name = { drive: 4, name: 'A.CSV' }
    const { pointer } = await client.request(commands.openFile, { ...name, mode: READ })
    const data = Buffer.from('xy')
    expect(await endCode(client.request(commands.writeFile, { pointer, offset: 0, data }))).toBe(0x402c)
    expect(await endCode(client.request(commands.readFile, { pointer, offset: 2, byteCount: 3 }))).toBe(0x4027)
    expect(await client.request(commands.readFile, { pointer, offset: 4, byteCount: 0 })).toEqual({
      data: Buffer.alloc(0),
    })
    await client.request(commands.closeFile, { pointer })
    const writing = await client.request(commands.openFile, { ...name, mode: WRITE })
    expect(await endCode(client.request(commands.writeFile, { ...writing, offset: 4, data }))).toBe(0x4027)
    expect(plc.files.read(4, 'A.CSV')?.toString()).toBe('abcd')
  })

  test.each(['A.PRG', 'a.pfb'])('a program in its place: %s', async (name) => {
    const { plc, client } = await pair({ profile: 'iq-r' })
    plc.files.write(4, name, 'abcd')
    const { pointer } = await client.request(commands.openFile, { drive: 4, name, mode: WRITE })
    const data = Buffer.from('efgh')
    expect(await endCode(client.request(commands.writeFile, { pointer, offset: 0, data }))).toBe(0x41cd)
    expect(plc.files.read(4, name)?.toString()).toBe('abcd')
  })

  test('Q keeps parameter files and running programs in RUN, and takes multiples of 4 in program memory', async () => {
    const { plc, client } = await pair({ profile: 'q' })
    const program = { drive: 0, name: 'MAIN.QPG' }
    const copy = { sourceDrive: 0, sourceName: 'MAIN.QPG', destinationDrive: 4, destinationName: 'MAIN.QPG' }
    const date = { year: 2026, month: 1, day: 1, hour: 0, minute: 0, second: 0 }
    const asks = [
      () => client.request(commands.deleteFile, program),
      () => client.request(commands.changeFileState, { ...program, attribute: 1 }),
      () => client.request(commands.changeFileDate, { ...program, date }),
      () => client.request(commands.copyFile, copy),
      () => client.request(commands.changeFileDate, { drive: 0, name: 'PARAM.QPA', date }),
    ]
    for (const ask of asks) expect(await endCode(ask())).toBe(0x4010)
    const { pointer } = await client.request(commands.openFile, { ...program, mode: WRITE })
    const data = Buffer.alloc(4)
    expect(await endCode(client.request(commands.writeFile, { pointer, offset: 0, data }))).toBe(0x4010)
    plc.cpu.switch = 'STOP'
    expect(await endCode(client.request(commands.writeFile, { pointer, offset: 2, data }))).toBe(0xc05c)
    expect(await endCode(client.request(commands.writeFile, { pointer, offset: 4, data }))).toBe(0)
    await client.request(commands.closeFile, { pointer })
    expect(await endCode(client.request(commands.copyFile, copy))).toBe(0)
    expect(await endCode(client.request(commands.deleteFile, program))).toBe(0)
  })

  test('Q has 4 characters for a password, which New File gives the file', async () => {
    const { client } = await pair({ profile: 'q' })
    await client.request(commands.newFile, { ...csv, size: 2, password: '1234' })
    expect(await endCode(client.request(commands.deleteFile, csv))).toBe(0x4026)
    expect(await endCode(client.request(commands.deleteFile, { ...csv, password: '1234' }))).toBe(0)
  })

  test('a subcommand of another family is none here; 0004 is one of L', async () => {
    const { client } = await pair({ profile: 'q' }, { profile: 'generic' })
    const ask = { drive: 4, name: 'LINE.CSV', mode: READ }
    expect(await endCode(client.request(commands.openFile, ask, { subcommand: 0x40 }))).toBe(0xc059)
    expect(await endCode(client.request(commands.openFile, ask, { subcommand: 0x04 }))).toBe(0xc059)
    const l = await pair({ profile: 'l' })
    expect(await l.client.request(commands.openFile, ask, { subcommand: 0x04 })).toEqual({ pointer: 0 })
  })
})

describe('what is not sent', () => {
  const bad: readonly (readonly [what: string, field: RegExp, ask: (client: MelsecClient) => Promise<unknown>])[] = [
    [
      'an odd offset',
      /offset.*multiple of 2/,
      (c) => c.request(commands.readFile, { pointer: 0, offset: 1, byteCount: 2 }),
    ],
    [
      'too many bytes',
      /byteCount.*1920/,
      (c) => c.request(commands.readFile, { pointer: 0, offset: 0, byteCount: 1921 }),
    ],
    [
      'too many bytes to write',
      /1920/,
      (c) => c.request(commands.writeFile, { pointer: 0, offset: 0, data: Buffer.alloc(1921) }),
    ],
    ['too many files', /count.*1 to 36/, (c) => c.request(commands.readDirectory, { drive: 4, start: 1, count: 37 })],
    [
      'another drive',
      /has no drive 0.*2 \(SD memory card\)/,
      (c) => c.request(commands.searchFile, { drive: 0, name: 'A' }),
    ],
    ['another attribute', /attribute.*1, 32/, (c) => c.request(commands.changeFileState, { ...csv, attribute: 0x10 })],
    [
      'no directory separator',
      /name.*DIR\\FILE\.CSV/,
      (c) => c.request(commands.searchFile, { drive: 4, name: 'A/B' }),
    ],
    ['a way up', /from the root/, (c) => c.request(commands.searchFile, { drive: 4, name: '..\\A' })],
    [
      'a long name',
      /65 characters, at most 64/,
      (c) => c.request(commands.searchFile, { drive: 4, name: 'N'.repeat(65) }),
    ],
    [
      'a long path',
      /at most 252/,
      (c) => c.request(commands.searchFile, { drive: 4, name: Array(5).fill('N'.repeat(60)).join('\\') }),
    ],
    [
      'an odd second',
      /second.*even/,
      (c) => c.request(commands.changeFileDate, { ...csv, date: { ...date, second: 1 } }),
    ],
    ['no such day', /day.*1 to 28/, (c) => c.request(commands.changeFileDate, { ...csv, date: { ...date, day: 29 } })],
    [
      'a password where iQ-R takes none',
      /password.*leave it out/,
      (c) => c.request(commands.newFile, { ...csv, size: 1, password: 'secret' }),
    ],
    [
      'another subcommand',
      /takes subcommand 0040, not 0000/,
      (c) => c.request(commands.openFile, { ...csv, mode: READ }, { subcommand: 0 }),
    ],
  ]
  const date = { year: 2026, month: 2, day: 1, hour: 0, minute: 0, second: 0 }

  test.each(bad)('%s', async (_what, text, ask) => {
    const { plc, client } = await pair()
    const error = await ask(client).catch((reason: unknown) => reason)
    expect(error).toBeInstanceOf(RequestError)
    expect(String(error)).toMatch(text)
    expect(plc.statistics.requests).toBe(0)
  })

  test.each([
    ['iq-r', 0x3d0],
    ['q', 0x3d1],
    ['remote-head', 0x3d0],
    ['remote-head', 0x3e2],
  ] as const)('to another module: %s, %i', async (profile, moduleIo) => {
    const { plc, client } = await pair({ profile }, { route: { moduleIo } })
    for (const ask of [
      () => client.request(commands.closeFile, { pointer: 0 }),
      () => client.request(commands.searchFile, { drive: 4, name: 'A.CSV' }),
    ]) {
      await expect(ask()).rejects.toThrow(/cannot go to module I\/O 03[DE]\d.*take 03FF/)
    }
    expect(plc.statistics.requests).toBe(0)
  })

  // 4.1 does not name them for file commands, appendix 3 lists every file command for them.
  test.each(['iq-r', 'q', 'l', 'generic'] as const)('not to a CPU of a multiple CPU system: %s', async (profile) => {
    for (const moduleIo of [0x3e0, 0x3e1, 0x3e2, 0x3e3]) {
      const { plc, client } = await pair({ profile }, { route: { moduleIo } })
      const asked = client.request(commands.searchFile, { drive: 4, name: 'A.CSV' })
      expect(await asked.catch((error: unknown) => error)).toBeInstanceOf(EndCodeError)
      expect(plc.statistics.requests).toBe(2)
    }
  })

  test.each(['TOOLONGNAME.CSV', 'A.LONG', 'A.B.C', 'DIR\\A.CSV', 'Ω€.CSV', ' A.CSV', 'A.'])('Q: %s', async (name) => {
    const { plc, client } = await pair({ profile: 'q' })
    await expect(client.request(commands.searchFile, { drive: 4, name })).rejects.toThrow(/name/)
    expect(plc.statistics.requests).toBe(0)
  })

  test('Q: a password of another length, without saying it', async () => {
    const { client } = await pair({ profile: 'q' })
    const error = await client
      .request(commands.deleteFile, { ...csv, password: 'xyzzy' })
      .catch((reason: unknown) => String(reason))
    expect(error).toMatch(/password.*5 characters/)
    expect(error).not.toContain('xyzzy')
  })
})

describe('passwords', () => {
  test.each([
    ['iq-r', 'binary', 'Hidden-12'],
    ['iq-r', 'ascii', 'Hidden-12'],
    ['q', 'binary', 'Hid1'],
    ['q', 'ascii', 'Hid1'],
  ] as const)('of %s in %s code are in no trace, explanation and event', async (profile, code, password) => {
    const { plc, client } = await pair({ profile, code })
    const entries: string[] = []
    client.on('trace', ({ text, bytes }) => void entries.push(text, bytes.toString('latin1')))
    plc.on('request', ({ message }) => void entries.push(JSON.stringify(message)))
    const side = { drive: 4, name: 'LINE.CSV', password }
    await client.request(commands.openFile, { ...side, mode: READ })
    await endCode(client.request(commands.deleteFile, side))
    const all = entries.join('\n')
    expect(all).toContain('4:LINE.CSV')
    expect(all).not.toMatch(/Hid|48 69 64|486964/i)
  })
})
