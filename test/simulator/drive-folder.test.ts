// A folder as a drive: what clients do in it happens in it, and nothing leads out of it.
import * as fs from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { afterEach, beforeEach, describe, expect, test } from '@jest/globals'
import { writerOf } from '../../src/codec/codec'
import { commands } from '../../src/melsec/commands/commands'
import { pathOf } from '../../src/simulator/drive'
import { FolderDrive } from '../../src/simulator/drive-folder'
import { createPlcSimulator } from '../../src/simulator/server'
import { type Asker, join as joined } from './support'

let above = ''
let folder = ''

beforeEach(() => {
  above = fs.mkdtempSync(join(tmpdir(), 'plc-drive-'))
  folder = join(above, 'card')
  fs.mkdirSync(join(folder, 'LOG'), { recursive: true })
  fs.writeFileSync(join(folder, 'Line.csv'), 'A,15\r\n')
  fs.writeFileSync(join(folder, 'LOG', 'DAY.CSV'), 'log')
  fs.writeFileSync(join(above, 'secret.txt'), 'not theirs')
})

afterEach(() => fs.rmSync(above, { recursive: true }))

const plcWith = () => joined({ drives: { 2: { folder, capacity: 1000 } } })

describe('what clients do', () => {
  test('is done to the files of the folder', () => {
    const { asker, plc } = plcWith()
    const name = { drive: 2, name: 'LOG\\NEW.CSV' }
    asker.ask(commands.newFile, { ...name, size: 4 })
    const { pointer = -1 } = asker.ask(commands.openFile, { ...name, mode: 0x100 }) ?? {}
    asker.ask(commands.writeFile, { pointer, offset: 2, data: Buffer.from('ab') })
    asker.ask(commands.closeFile, { pointer })
    const date = { year: 2020, month: 2, day: 29, hour: 1, minute: 2, second: 4 }
    asker.ask(commands.changeFileDate, { ...name, date })
    asker.ask(commands.changeFileState, { ...name, attribute: 1 })
    const host = join(folder, 'LOG', 'NEW.CSV')
    expect(fs.readFileSync(host).toString('latin1')).toBe('\0\0ab')
    expect(fs.statSync(host).mode & 0o222).toBe(0)
    expect(fs.statSync(host).mtime).toEqual(new Date(2020, 1, 29, 1, 2, 4))
    expect(asker.endCode(commands.deleteFile, name)).toBe(0x41ce)
    asker.ask(commands.changeFileState, { ...name, attribute: 0x20 })
    asker.ask(commands.deleteFile, name)
    expect(fs.existsSync(host)).toBe(false)
    expect(plc.files.read(2, 'line.CSV')?.toString()).toBe('A,15\r\n')
  })

  test('is listed in an order that stays, with sizes and directories', () => {
    const { asker } = plcWith()
    const { files } = asker.ask(commands.readDirectory, { drive: 2, start: 1, count: 36 }) ?? { files: [] }
    expect(files.map(({ name, attribute, size }) => [name, attribute, size])).toEqual([
      ['LOG', 0x30, 0],
      ['Line.csv', 0x20, 6],
    ])
  })

  test('finds what others delete in the meantime gone', () => {
    const { asker } = plcWith()
    const { pointer = -1 } = asker.ask(commands.openFile, { drive: 2, name: 'LINE.CSV', mode: 0 }) ?? {}
    fs.rmSync(join(folder, 'Line.csv'))
    expect(asker.endCode(commands.readFile, { pointer, offset: 0, byteCount: 2 })).toBe(0x41c5)
  })

  test('has no more room than its capacity', () => {
    const { asker } = plcWith()
    expect(asker.endCode(commands.newFile, { drive: 2, name: 'BIG.CSV', size: 992 })).toBe(0x41cf)
    expect(asker.endCode(commands.newFile, { drive: 2, name: 'FITS.CSV', size: 991 })).toBe(0)
    expect(fs.statSync(join(folder, 'FITS.CSV')).size).toBe(991)
  })
})

/** A name as no client of ours would send it. */
function rawName(
  asker: Asker,
  command: 'searchFile' | 'newFile' | 'openFile' | 'deleteFile',
  name: string,
): number | undefined {
  const writer = writerOf(asker.protocol.code)
  writer.uint(commands[command].code, 2)
  writer.uint(0x40, 2)
  if (command === 'openFile' || command === 'deleteFile') writer.uint(0, 2)
  else writer.text('\0\0\0\0')
  if (command === 'openFile') writer.uint(0, 2)
  writer.uint(2, 2)
  if (command === 'searchFile') writer.uint(0, 2)
  if (command === 'newFile') writer.uint(4, 4)
  writer.uint(name.length, 2)
  writer.words(Array.from({ length: name.length }, (_, i) => name.charCodeAt(i)))
  return asker.rawEndCode(writer.take())
}

const escapes = [
  '..\\secret.txt',
  '\\..\\secret.txt',
  'LOG\\..\\..\\secret.txt',
  '../secret.txt',
  '..',
  '.',
  'LOG\\.',
  '\\\\secret.txt',
  'C:\\secret.txt',
  '/etc/passwd',
  '\\etc\\passwd',
  'LOG/../../secret.txt',
  'secret.txt\0.CSV',
  'NUL',
  'CON.CSV',
  'Line.csv:stream',
  'Line.csv.',
  'Line.csv ',
  '\ud800',
  '\ufffd',
  '',
]

describe('nothing leads out of the folder', () => {
  test.each(escapes)('%j', (name) => {
    const { asker } = plcWith()
    const before = fs.readdirSync(above)
    for (const command of ['searchFile', 'openFile', 'deleteFile', 'newFile'] as const) {
      expect(`${command} ${rawName(asker, command, name)}`).not.toBe(`${command} 0`)
    }
    expect(fs.readdirSync(above)).toEqual(before)
    expect(fs.readdirSync(folder).sort()).toEqual(['LOG', 'Line.csv'])
  })

  test('the requests of these tests are right where the name is', () => {
    const { asker } = plcWith()
    expect(rawName(asker, 'searchFile', 'LOG\\DAY.CSV')).toBe(0)
    expect(rawName(asker, 'openFile', '\\LOG\\DAY.CSV')).toBe(0)
    expect(rawName(asker, 'newFile', 'N.CSV')).toBe(0)
    expect(rawName(asker, 'deleteFile', 'n.csv')).toBe(0)
  })

  test('links are not there, to files and to directories', () => {
    fs.symlinkSync(join(above, 'secret.txt'), join(folder, 'LINK.TXT'))
    fs.symlinkSync(above, join(folder, 'UP'))
    const { asker } = plcWith()
    const { files } = asker.ask(commands.readDirectory, { drive: 2, start: 1, count: 36 }) ?? { files: [] }
    expect(files.map(({ name }) => name)).toEqual(['LOG', 'Line.csv'])
    for (const name of ['LINK.TXT', 'UP', 'UP\\secret.txt']) {
      expect(asker.endCode(commands.searchFile, { drive: 2, name })).toBe(0x41c5)
      expect(asker.endCode(commands.openFile, { drive: 2, name, mode: 0x100 })).toBe(0x41c5)
      expect(asker.endCode(commands.deleteFile, { drive: 2, name })).toBe(0x41c5)
    }
    expect(asker.endCode(commands.newFile, { drive: 2, name: 'UP\\NEW.TXT', size: 1 })).toBe(0x41cc)
    // In place of a link nothing is made, and nothing is written through it.
    expect(asker.endCode(commands.newFile, { drive: 2, name: 'LINK.TXT', size: 1 })).not.toBe(0)
    expect(fs.readFileSync(join(above, 'secret.txt'), 'utf8')).toBe('not theirs')
    expect(fs.readdirSync(above).sort()).toEqual(['card', 'secret.txt'])
  })

  test('a file that becomes a link while it is open is not followed', () => {
    const { asker } = plcWith()
    const { pointer = -1 } = asker.ask(commands.openFile, { drive: 2, name: 'LINE.CSV', mode: 0x100 }) ?? {}
    fs.rmSync(join(folder, 'Line.csv'))
    fs.symlinkSync(join(above, 'secret.txt'), join(folder, 'Line.csv'))
    expect(asker.endCode(commands.readFile, { pointer, offset: 0, byteCount: 2 })).toBe(0x41c5)
    const data = Buffer.from('xx')
    expect(asker.endCode(commands.writeFile, { pointer, offset: 0, data })).toBe(0x41c5)
    expect(fs.readFileSync(join(above, 'secret.txt'), 'utf8')).toBe('not theirs')
  })
})

test('a path has plain names only', () => {
  expect(pathOf('\\A\\B.C')).toEqual(['A', 'B.C'])
  // Below the root of the drive it is a path like others.
  for (const text of escapes.filter((name) => name !== '\\etc\\passwd')) expect(pathOf(text)).toBeUndefined()
})

test('a folder that is not there, or a file, is no drive', () => {
  expect(() => new FolderDrive(join(above, 'none'))).toThrow(/cannot be a drive/)
  expect(() => new FolderDrive(join(above, 'secret.txt'))).toThrow(/no folder/)
  expect(() => createPlcSimulator({ drives: { 2: { folder: join(above, 'none') } } })).toThrow(/cannot be a drive/)
})

describe('drives that cannot be', () => {
  test.each([
    [{ 0: {} }, /no drive 0; its drives are/],
    [{ 1: {} }, /Drive 1 is drive 3/],
    [{ 4: { capacity: -1 } }, /number of bytes/],
    [{ 4: { capacity: 1, files: { A: 'ab' } } }, /more than its capacity/],
    [{ 4: { files: { '..': 'a' } } }, /no file name/],
    [{ 4: { files: { A: 'a', a: 'b' } } }, /twice/],
    [{ 4: { files: { A: 'a', 'A\\B': 'b' } } }, /part of its path is a file/],
    [{ 4: { folder: '.', files: {} } }, /not both/],
    [{ 4: { size: 1 } }, /has no size/],
  ])('%j', (drives, text) => {
    expect(() => createPlcSimulator({ drives: drives as never })).toThrow(text)
  })

  test('of a family without files', () => {
    expect(() => createPlcSimulator({ profile: 'iq-f', drives: { 2: {} } })).toThrow(/no drive 2/)
  })
})
