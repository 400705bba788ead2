/** The commands about files, against the drives of a simulated PLC, with files of a temporary directory. */
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { runHere } from './in-process'

let plc: PlcSimulator
let folder: string

beforeAll(async () => {
  plc = createPlcSimulator({ profile: 'iq-r' })
  await plc.listen()
})
afterAll(() => plc.close())
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'melsec-jw-'))
  plc.faults.clear()
})
afterEach(() => rmSync(folder, { recursive: true, force: true }))

const here = (args: readonly string[], answer?: string) =>
  runHere([...args, `--plc=127.0.0.1:${plc.tcp?.port}`, '--profile', 'iq-r'], answer)
const local = (name: string) => join(folder, name)
const content = Buffer.from(Array.from({ length: 5000 }, (_, i) => (i * 11) & 0xff))

describe('ls', () => {
  test('lists the drives without a PLC', async () => {
    const { code, out } = await runHere(['ls', '--plc=127.0.0.1:1', '--profile', 'iq-r'])
    expect(code).toBe(0)
    expect(out).toMatch(/^4: +data memory$/m)
    for (const json of [[], ['--json']]) {
      const none = await runHere(['ls', '--plc=127.0.0.1:1', '--profile', 'iq-f', ...json])
      expect(none).toMatchObject({ code: 2, err: expect.stringMatching(/cannot be reached/) })
    }
  })

  test('lists a directory, as text and as JSON', async () => {
    const text = await here(['ls', '4:/'])
    expect(text.code).toBe(0)
    expect(text.out).toMatch(/^-rw +\d+ {2}2026-01-15 08:30:00 {2}LINE\.CSV$/m)
    expect(text.out).toMatch(/^drw +0 {2}.* {2}ARCHIVE$/m)
    const { out } = await here(['ls', '4:/ARCHIVE', '--json'])
    expect(JSON.parse(out)).toMatchObject({
      directory: '4:/ARCHIVE',
      entries: [{ name: 'LINE2025.CSV', path: '4:\\ARCHIVE\\LINE2025.CSV', readOnly: true, kind: 'file' }],
    })
  })

  test('says what is wrong with a path, and what the PLC refuses', async () => {
    expect((await here(['ls', 'ARCHIVE'])).code).toBe(2)
    const { code, err } = await here(['ls', '4:/NOTHERE'])
    expect(code).toBe(3)
    expect(err).toMatch(/end code 41CC/)
  })
})

describe('get', () => {
  test('copies a file under its own name, and replaces only when told so', async () => {
    plc.files.write(4, 'BIG.BIN', content)
    const first = await here(['get', '4:/BIG.BIN', folder])
    expect(first).toMatchObject({ code: 0, err: '' })
    expect(first.out).toMatch(/5000 bytes/)
    expect(readFileSync(local('BIG.BIN'))).toEqual(content)
    plc.files.write(4, 'BIG.BIN', 'other')
    expect(await here(['get', '4:/BIG.BIN', folder])).toMatchObject({ code: 2 })
    expect(readFileSync(local('BIG.BIN'))).toEqual(content)
    expect(await here(['get', '4:/BIG.BIN', local('BIG.BIN'), '--force', '--json'])).toMatchObject({ code: 0 })
    expect(readFileSync(local('BIG.BIN'), 'utf8')).toBe('other')
  })

  test('leaves nothing when it fails on the way', async () => {
    plc.files.write(4, 'BIG.BIN', content)
    let reads = 0
    plc.faults.add({ kind: 'endCode', endCode: 0x41e4, commands: ['readFile'], when: () => ++reads > 1 })
    expect(await here(['get', '4:/BIG.BIN', local('B')])).toMatchObject({ code: 3 })
    expect(existsSync(local('B'))).toBe(false)
    expect(existsSync(local('B.part'))).toBe(false)
    expect(plc.files.open).toEqual([])
  })

  test('says what this computer refuses', async () => {
    const { code, err } = await here(['get', '4:/LINE.CSV', local('not/there.csv')])
    expect([code, err]).toEqual([2, expect.stringMatching(/no such file or directory/)])
    expect(plc.files.open).toEqual([])
  })
})

describe('put', () => {
  test('asks, writes, and never replaces unasked', async () => {
    writeFileSync(local('NEW.BIN'), content)
    const { code, questions } = await here(['put', local('NEW.BIN'), '4:/'], 'n')
    expect(code).toBe(2)
    expect(questions.join()).toMatch(/NEW\.BIN \(5000 bytes\) -> 4:\/NEW\.BIN, new/)
    expect(plc.files.read(4, 'NEW.BIN')).toBeUndefined()
    expect(await here(['put', local('NEW.BIN'), '4:/'], 'y')).toMatchObject({ code: 0 })
    expect(plc.files.read(4, 'NEW.BIN')).toEqual(content)
    expect(await here(['put', local('NEW.BIN'), '4:/NEW.BIN', '--yes'])).toMatchObject({ code: 2 })
    writeFileSync(local('NEW.BIN'), 'shorter')
    expect(await here(['put', local('NEW.BIN'), '4:/NEW.BIN', '--yes', '--mode', 'replace'])).toMatchObject({ code: 0 })
    expect(plc.files.read(4, 'NEW.BIN')?.toString()).toBe('shorter')
  })

  test('says what is no file here', async () => {
    const missing = await here(['put', local('NONE'), '4:/N.BIN', '--yes'])
    expect(missing.code).toBe(2)
    expect(missing.err).toMatch(/There is no .*NONE on this computer/)
    expect(await here(['put', folder, '4:/N.BIN', '--yes'])).toMatchObject({ code: 2 })
  })

  test('shows how far it is to somebody who waits', async () => {
    writeFileSync(local('P.BIN'), content)
    const { err } = await here(['put', local('P.BIN'), '4:/P.BIN', '--yes'], '')
    expect(err).toBe('30 %\n70 %\n100 %\n')
  })
})

describe('cp and rm', () => {
  test('copy within the PLC and delete, after asking', async () => {
    plc.files.write(4, 'C.BIN', content)
    expect(await here(['cp', '4:/C.BIN', '2:/D.BIN'])).toMatchObject({ code: 2 })
    expect(await here(['cp', '4:/C.BIN', '2:/D.BIN', '-y'])).toMatchObject({ code: 0 })
    expect(plc.files.read(2, 'D.BIN')).toEqual(content)
    expect(await here(['rm', '4:/C.BIN', '2:/D.BIN'], 'n')).toMatchObject({ code: 2 })
    const removed = await here(['rm', '4:/C.BIN', '2:/D.BIN', '--yes', '--json'])
    expect(JSON.parse(removed.out)).toMatchObject({ deleted: ['4:/C.BIN', '2:/D.BIN'] })
    expect(plc.files.read(4, 'C.BIN')).toBeUndefined()
    expect(await here(['rm', '4:/C.BIN', '--yes'])).toMatchObject({ code: 3 })
  })
})

test('the password of a file comes from the environment or the keyboard, and is never shown', async () => {
  const q = createPlcSimulator({ profile: 'q' })
  await q.listen()
  const at = (args: readonly string[], answer?: string) =>
    runHere([...args, `--plc=127.0.0.1:${q.tcp?.port}`, '--profile', 'q', '--trace'], answer)
  writeFileSync(local('S.CSV'), 'secret')
  process.env.MELSEC_JW_FILE_PASSWORD = 'Kx7q'
  try {
    const written = await at(['put', local('S.CSV'), '4:S.CSV', '--yes'])
    expect(written.code).toBe(0)
    expect(await at(['get', '4:S.CSV', local('T.CSV')])).toMatchObject({ code: 0 })
    expect(`${written.out}${written.err}`).not.toContain('Kx7q')
  } finally {
    delete process.env.MELSEC_JW_FILE_PASSWORD
    expect(await at(['get', '4:S.CSV', local('U.CSV')])).toMatchObject({ code: 3 })
    expect(await at(['get', '4:S.CSV', local('U.CSV'), '--file-password'], 'Kx7q')).toMatchObject({ code: 0 })
    expect(await at(['get', '4:S.CSV', local('V.CSV'), '--file-password'])).toMatchObject({ code: 2 })
    await q.close()
  }
})

describe('what the profile lacks is said before anything is connected or asked', () => {
  const nobody = '--plc=127.0.0.1:1'

  test.each([
    ['ls', '4:/'],
    ['get', '4:/LINE.CSV', 'LINE.CSV'],
    ['put', 'NEW.BIN', '4:/NEW.BIN'],
    ['cp', '4:/A.CSV', '4:/B.CSV'],
    ['rm', '4:/A.CSV'],
  ])('%s with a PLC without files', async (name, ...args) => {
    writeFileSync(local('NEW.BIN'), content)
    const paths = args.map((path) => (path.includes(':') ? path : local(path)))
    const ended = await runHere([name, ...paths, nobody, '--profile', 'iq-f'], 'y')
    expect(ended).toMatchObject({ code: 2, questions: [], out: '', err: expect.stringMatching(/MELSEC iQ-F/) })
    expect(existsSync(local('LINE.CSV'))).toBe(false)
  })

  test('and so is a path that is none, or a drive that the PLC has not', async () => {
    for (const args of [
      ['ls', 'ARCHIVE'],
      ['get', '9:/A.CSV', local('A')],
      ['rm', '4:/A.CSV', 'B.CSV'],
    ]) {
      expect(await runHere([...args, nobody, '--profile', 'iq-r'], 'y')).toMatchObject({ code: 2, questions: [] })
    }
  })

  test('what it has is asked and tried', async () => {
    const ended = await runHere(['rm', '4:/A.CSV', nobody, '--profile', 'iq-r', '--timeout', '500'], 'y')
    expect([ended.code, ended.questions.length]).toEqual([4, 1])
  })
})
