/** Tables of tags on the command line, with files by hand. */
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { afterEach, beforeEach, describe, expect, test } from '@jest/globals'
import { gxText, utf16 } from '../tags/support'
import { runHere } from './in-process'

let folder: string
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'melsec-jw-tags-'))
})
afterEach(() => rmSync(folder, { recursive: true, force: true }))

const at = (name: string) => join(folder, name)
const put = (name: string, content: string | Buffer) => {
  writeFileSync(at(name), content)
  return at(name)
}
const jsonIn = (name: string): unknown => JSON.parse(readFileSync(at(name), 'utf8'))
const tags = (...args: readonly string[]) => runHere(['tags', ...args, '--profile', 'iq-r'])

const labels = () =>
  put(
    'labels.csv',
    utf16(
      gxText(
        ['Plant'],
        ['Class', 'Label Name', 'Data Type', 'Assign (Device/Label)', 'Comment', 'Access from External Device'],
        ['VAR_GLOBAL', 'Level', 'Word [Signed]', 'D100', 'level of tank 1', '0'],
        ['VAR_GLOBAL', 'Pump', 'Bit', 'M10', '', '0'],
        ['VAR_GLOBAL', 'Speed', 'FLOAT [Single Precision]', '', '', '1'],
        ['VAR_GLOBAL', 'Delay', 'Timer', 'T0', '', '0'],
      ),
    ),
  )

const imported = [
  { name: 'Level', address: 'D100', type: 'INT', description: 'level of tank 1' },
  { name: 'Pump', address: 'M10', type: 'BOOL' },
  { name: 'Speed', address: 'label:Speed', type: 'REAL' },
]

describe('import', () => {
  test('makes a new table without a question, and tells what has become no tag', async () => {
    const { code, out, err, questions } = await tags('import', labels(), at('plant.json'))
    expect([code, questions]).toEqual([6, []])
    expect(out).toBe(`${at('plant.json')}: 3 tags.\n`)
    expect(err).toMatch(/labels\.csv:6: Delay: Timer is three devices, contact, coil and current value/)
    expect(jsonIn('plant.json')).toEqual({ tags: imported })
  })

  test('into a table asks, keeps what people added, and changes nothing a second time', async () => {
    const own = { ...imported[0], description: 'old', unit: 'm', min: 0, max: 10, access: 'readWrite' }
    put('plant.json', JSON.stringify([own, { name: 'Own', address: 'D5' }]))
    const args = ['tags', 'import', labels(), at('plant.json'), '--profile', 'iq-r']
    const refused = await runHere(args, 'n')
    expect([refused.code, refused.err]).toEqual([2, expect.stringContaining('Nothing was changed. Not confirmed.')])
    expect(jsonIn('plant.json')).toHaveLength(2)
    const { code, questions } = await runHere(args, 'y')
    expect(code).toBe(6)
    expect(questions[0]).toBe(
      [
        `Change ${at('plant.json')}:`,
        '+  Pump   M10 BOOL',
        '+  Speed  label:Speed REAL',
        '~  Level  description: old -> level of tank 1',
        '-  Own    D5',
        '2 new, 1 changed, 1 gone, 0 in conflict, 0 the same',
        'What is gone is kept.',
        'Go on? [y/N] ',
      ].join('\n'),
    )
    const merged = [{ ...own, description: 'level of tank 1' }, { name: 'Own', address: 'D5' }, ...imported.slice(1)]
    expect(jsonIn('plant.json')).toEqual({ tags: merged })
    const again = await runHere(args)
    expect([again.code, again.out]).toEqual([6, `${at('plant.json')}: nothing changes.\n`])
    expect(existsSync(at('plant.json.part'))).toBe(false)
  })

  test('removes what is gone and replaces what is in conflict when that is said', async () => {
    put(
      'plant.json',
      JSON.stringify([
        { name: 'Level', address: 'D100', type: 'REAL', max: 5 },
        { name: 'Own', address: 'D5' },
      ]),
    )
    const kept = await tags('import', labels(), at('plant.json'), '--yes', '--json')
    expect(JSON.parse(kept.out).conflicts).toHaveLength(1)
    expect(jsonIn('plant.json')).toMatchObject({
      tags: [{ name: 'Level', type: 'REAL', max: 5 }, { name: 'Own' }, {}, {}],
    })
    await tags('import', labels(), at('plant.json'), '--yes', '--remove-gone', '--replace-conflicts')
    expect(jsonIn('plant.json')).toEqual({ tags: imported })
  })

  test('does not write over a table that it cannot read as a whole', async () => {
    const table = put('plant.csv', 'Name,Address,Remark\nLevel,D100,keep me\n')
    const { code, err } = await tags('import', labels(), table, '--yes')
    expect([code, err]).toEqual([
      2,
      expect.stringMatching(/The table cannot be used\.\n.*plant\.csv:1: The column 'Remark'/),
    ])
    expect(readFileSync(table, 'utf8')).toBe('Name,Address,Remark\nLevel,D100,keep me\n')
  })

  test('needs a table that is one', async () => {
    expect((await tags('import', labels(), at('plant.xlsx'))).err).toMatch(
      /is a table when it ends with \.json or \.csv/,
    )
    expect((await tags('import', labels())).err).toMatch(/import takes two files; the second is the table/)
    expect((await tags('import', at('none.csv'), at('plant.json'))).err).toMatch(/There is no file .*none\.csv/)
    expect((await tags('import', folder, at('plant.json'))).code).toBe(2)
  })
})

describe('check', () => {
  test('says what a file is and what is wrong in it', async () => {
    const { code, out, err } = await tags('check', labels())
    expect(code).toBe(6)
    expect(out).toBe(`${at('labels.csv')}: gxWorks3Labels, utf-16le: 3 tags.\n`)
    expect(err.split('\n')).toHaveLength(2)
  })

  test('knows the addresses of the PLC', async () => {
    const table = put('plant.csv', 'Name;Address;Type\na;D0;REAL\nb;X8;\nc;D1;BOOL\n')
    expect(await runHere(['tags', 'check', table, '--profile', 'iq-r'])).toMatchObject({
      code: 6,
      err: /plant\.csv:4: /,
    })
    const octal = await runHere(['tags', 'check', table, '--profile', 'iq-f'])
    expect(octal.err).toMatch(/plant\.csv:3: b: .*octal/)
    expect((await runHere(['tags', 'check', table, '--profile', 'iq-f', '--xy-radix', '16'])).err).not.toMatch(/octal/)
    const label = put('label.csv', 'Name,Address\na,Line1.Speed\n')
    expect((await runHere(['tags', 'check', label, '--profile', 'iq-r'])).code).toBe(0)
    expect((await runHere(['tags', 'check', label, '--profile', 'q'])).code).toBe(6)
  })

  test('knows the operands of a Sharp JW', async () => {
    const table = put('jw.csv', 'Name,Address,Type,Count\na,09012,INT,\nb,004033,,\nc,F1:00001234,BYTE,4\nd,D100,,\n')
    const { code, err, out } = await runHere(['tags', 'check', table, '--family', 'jw'])
    expect([code, err]).toEqual([6, expect.stringMatching(/^.*jw\.csv:5: d: .*D100.*\n$/)])
    expect(out).toMatch(/: csv, utf-8: 3 tags\./)
    const other = put('other.json', JSON.stringify([{ name: 'c', address: 'F1:00001234:BYTE[4]' }]))
    expect((await runHere(['tags', 'diff', table, other, '--family', 'jw'])).out).toMatch(/ 1 the same$/m)
    expect((await runHere(['tags', 'check', table, '--family', 'jw', '--profile', 'iq-r'])).err).toMatch(
      /--profile is of MELSEC only\. A Sharp JW has one notation/,
    )
    const refused = await runHere(['tags', 'export', other, at('x.csv'), '--family', 'jw', '--kind', 'gxWorks3Labels'])
    expect([refused.code, refused.err]).toEqual([2, 'GX Works knows no Sharp JW: export csv or json.\n'])
  })

  test('takes a template', async () => {
    const table = put('plant.csv', 'Name,Address\nm{station}.level,D{station}00\n')
    expect((await tags('check', table)).code).toBe(6)
    expect((await tags('check', table, '--template')).code).toBe(0)
  })

  test('takes the encoding, delimiter and kind that are said', async () => {
    const table = put(
      'plant.txt',
      Buffer.from([...Buffer.from('Name\tAddress\n'), 0x90, 0x85, ...Buffer.from('\tD0\n')]),
    )
    const { out } = await tags(
      'check',
      table,
      '--file-encoding',
      'shift-jis',
      '--delimiter',
      'tab',
      '--kind',
      'csv',
      '--json',
    )
    expect(JSON.parse(out)).toMatchObject({
      encoding: 'shift-jis',
      delimiter: '\t',
      tags: [{ name: '水', address: 'D0' }],
    })
  })
})

test('diff shows what import would change, and changes nothing', async () => {
  const table = put('plant.json', JSON.stringify([{ name: 'Level', address: 'D99', type: 'INT', unit: 'm' }]))
  const { code, out } = await tags('diff', labels(), table)
  expect(code).toBe(6)
  expect(out).toMatch(/^~ {2}Level {2}address: D99 -> D100$/m)
  expect(out).toMatch(/^~ {2}Level {2}description: \(none\) -> level of tank 1$/m)
  expect(out).toMatch(/^2 new, 1 changed, 0 gone, 0 in conflict, 0 the same$/m)
  expect(jsonIn('plant.json')).toEqual([{ name: 'Level', address: 'D99', type: 'INT', unit: 'm' }])
  expect((await tags('diff', labels(), at('none.json'))).err).toMatch(/There is no table/)
})

describe('export', () => {
  test('writes a table as another file, and none over one that is there', async () => {
    const table = put('plant.json', JSON.stringify(imported))
    expect(await tags('export', table, at('plant.csv'))).toMatchObject({ code: 0, err: '' })
    expect(readFileSync(at('plant.csv'), 'utf8')).toMatch(
      /^\ufeffName,Address,Type,Count,Description,Unit\r\nLevel,D100,INT,,level of tank 1,\r\n/,
    )
    expect((await tags('export', table, at('plant.csv'))).err).toMatch(/plant\.csv exists: say --force to replace it/)
    expect((await tags('export', table, at('plant.csv'), '--force', '--delimiter', 'semicolon')).code).toBe(0)
    expect(readFileSync(at('plant.csv'), 'utf8')).toContain('Level;D100;INT;')
  })

  test('for GX Works tells what is not in the file', async () => {
    const table = put('plant.json', JSON.stringify(imported))
    const { code, err } = await tags('export', table, at('out.csv'), '--kind', 'gxWorks3Labels')
    expect([code, err]).toEqual([6, 'Speed: It is a label of the PLC already.\n'])
    const back = await tags('import', at('out.csv'), at('back.json'))
    expect([back.code, back.err]).toEqual([0, ''])
    expect(jsonIn('back.json')).toEqual({ tags: imported.slice(0, 2) })
  })
})
