/** Tables of tags: checked as a whole, found by name, reused for many machines. */
import { describe, expect, test } from '@jest/globals'
import { parseItem } from '../../src/client/item/item'
import { parseJwItem } from '../../src/client/jw/item'
import { RequestError } from '../../src/errors'
import { problemsOfTags, type ReadTagItem, textOfProblem } from '../../src/tags/table/check'
import { type MoveAddress, tagsOfMachine } from '../../src/tags/table/machine'
import { defineTags, tagTable } from '../../src/tags/table/table'
import { itemOfTag, type Tag } from '../../src/tags/table/tag'
import { rawValueOf } from '../../src/tags/table/write'
import { parseByteType } from '../../src/value/byte-type'

/** As a client of an iQ-R would hand it in. */
const readItem: ReadTagItem = (item) => parseItem(item, { xyRadix: 16 })

const problem = (row: unknown, options = {}) => {
  const [found, ...more] = problemsOfTags([row], options)
  expect(more).toEqual([])
  return found?.message
}
const tag = (fields: object) => ({ name: 'level', address: 'D100', ...fields })

describe('a row is', () => {
  test('good when it says all that a tag can', () => {
    const row: Tag = {
      name: 'Line 1/水位',
      address: 'D100',
      type: 'REAL',
      count: 2,
      description: 'level of tank 1',
      unit: 'm',
      scaling: { kind: 'linear', raw: [0, 4000], engineering: [0, 10], clamp: true },
      deadband: { kind: 'percent', value: 0.5 },
      scanClass: 'fast',
      access: 'readWrite',
      min: 0,
      max: 10,
      format: { wordOrder: 'high-first' },
    }
    expect(problemsOfTags([row], { readItem })).toEqual([])
    expect(itemOfTag(row)).toEqual({ address: 'D100', type: 'REAL', count: 2, wordOrder: 'high-first' })
  })

  test.each([
    [{ address: 'D1' }, 'A tag needs a name, not undefined.'],
    [{ name: '', address: 'D1' }, "A tag needs a name, not ''."],
    [{ name: ' a', address: 'D1' }, "The name ' a' has spaces around it."],
    [{ name: 'a\tb', address: 'D1' }, 'The name has a control character, such as a tab or a new line.'],
    [{ name: 'a'.repeat(257), address: 'D1' }, 'The name has 257 characters; 256 is the most.'],
    [{ name: 'a' }, 'It needs an address, not undefined.'],
    [{ name: 'a', address: '  ' }, "It needs an address, not '  '."],
    [tag({ units: 'm' }), /A tag has no 'units'; it has name, address, .*, format\./],
    [tag({ type: 'REEL' }), /'REEL' is not a type.*\.$/],
    [tag({ type: 5 }), 'The type is a text such as REAL, not 5.'],
    [tag({ count: 0 }), 'The count is a whole number from 1, not 0.'],
    [tag({ unit: 5 }), 'unit is a text, not 5.'],
    [tag({ access: 'write' }), "The access is read or readWrite, not 'write'."],
    [tag({ min: 5, max: 4 }), 'min (5) is above max (4).'],
    [tag({ min: Number.NaN }), 'min is a finite number, not NaN.'],
    [tag({ max: '5' }), "max is a finite number, not '5'."],
    [tag({ scaling: { kind: 'cubic' } }), /A scaling is an object whose kind is linear or squareRoot/],
    [tag({ scaling: { kind: 'linear', raw: [0, 0], engineering: [0, 1] } }), /two different numbers, not twice 0/],
    [tag({ scaling: { kind: 'linear', raw: [0], engineering: [0, 1] } }), /raw limits of a scaling are two finite/],
    [
      tag({ scaling: { kind: 'linear', raw: [0, 1], engineering: [0, 1], clamps: true } }),
      /There is no 'clamps' in it/,
    ],
    [tag({ scaling: { kind: 'linear', raw: [0, 1], engineering: [0, 1], clamp: 1 } }), /clamp of a scaling is true/],
    [tag({ deadband: 5 }), /A deadband is \{ kind: absolute or percent/],
    [tag({ deadband: { kind: 'absolute', value: -1 } }), /a number from 0/],
    [
      tag({ deadband: { kind: 'percent', value: 1 } }),
      'A deadband in percent needs a range: a scaling, or min and max.',
    ],
    [
      tag({ deadband: { kind: 'percent', value: 1, of: [0, 5] }, min: 0, max: 1 }),
      'The range of percent of a tag is that of its scaling, else from min to max: leave of out.',
    ],
    [tag({ deadband: { kind: 'absolute', value: 1, of: [0, 5] } }), /A range belongs to a deadband in percent/],
    [tag({ deadband: { kind: 'absolute', value: 1, values: 2 } }), /There is no 'values' in it/],
    [tag({ deadband: { kind: 'percent', value: 101 }, min: 0, max: 1 }), 'A deadband has at most 100 percent.'],
    [tag({ format: { wordOrder: 'big' } }), /wordOrder is low-first or high-first/],
    [tag({ format: 5 }), /a value format is an object/],
    [tag({ type: 'BOOL', min: 0 }), 'BOOL is no number: leave min out.'],
    [tag({ type: 'STRING(4)', deadband: { kind: 'absolute', value: 1 } }), 'STRING is no number: leave deadband out.'],
    [tag({ address: 'D{station}00' }), '{station} in its address has no value: tagsOfMachine() puts one in.'],
    [
      tag({ min: 11, scaling: { kind: 'linear', raw: [0, 1], engineering: [0, 10], clamp: true } }),
      'min (11) is above 10, where its scale ends.',
    ],
    [5, 'A row is an object with name and address, not 5.'],
    [null, 'A row is an object with name and address, not null.'],
  ])('bad: %j', (row, message) => {
    if (typeof message === 'string') expect(problem(row)).toBe(message)
    else expect(problem(row)).toMatch(message)
  })

  test('held against the addresses of its PLC', () => {
    expect(problem(tag({ address: 'DD100' }), { readItem })).toMatch(/DD100/)
    expect(problem(tag({ address: 'M0', type: 'INT' }), { readItem })).toMatch(/M .* is a bit device/)
    expect(problemsOfTags([tag({ address: 'M0', type: 'INT' })], { readItem })[0]?.fields).toEqual(['type'])
    expect(problem(tag({ address: 'M0', max: 4 }), { readItem })).toBe('BOOL is no number: leave max out.')
    const input: ReadTagItem = (item) => ({ ...readItem(item), readOnly: 'X is an input: it can only be read.' })
    expect(problem(tag({ address: 'X0', access: 'readWrite' }), { readItem: input })).toMatch(/^X is an input/)
  })
})

describe('of another family', () => {
  const readJw: ReadTagItem = (item) => parseJwItem(item, {})

  test('types of one byte are types, with their limits', () => {
    const row = { name: 'a', address: '09000', type: 'BYTE', access: 'readWrite', max: 300 } as const
    expect(problemsOfTags([row], { readItem: readJw })).toEqual([])
    expect(problemsOfTags([row])).toEqual([])
    expect(rawValueOf(row, parseByteType('BYTE'), undefined, 255)).toEqual({ raw: 255, value: 255 })
    expect(() => rawValueOf(row, parseByteType('BYTE'), undefined, 256)).toThrow(/256 is not from 0 to 255, as BYTE is/)
    expect(problem({ ...row, address: 'D100' }, { readItem: readJw })).toMatch(/D100/)
  })
})

describe('a table', () => {
  test('has one message for each bad row, with all that is wrong with it', () => {
    const rows = [tag({ min: 5, max: 4, units: 'm' }), tag({ name: 'good' }), tag({ name: 'Ｌevel', count: -1 })]
    expect(problemsOfTags(rows)).toEqual([
      {
        row: 0,
        name: 'level',
        fields: ['min'],
        message: expect.stringMatching(/^A tag has no 'units'.*min \(5\) is above max/),
      },
      {
        row: 2,
        name: 'Ｌevel',
        fields: ['name', 'count'],
        message: "The name 'Ｌevel' is that of row 1 already. The count is a whole number from 1, not -1.",
      },
    ])
    expect(problemsOfTags(rows).map(textOfProblem)[1]).toMatch(/^Row 3 \(Ｌevel\): The name/)
  })

  test('that is bad is refused with these messages', () => {
    const rows = Array.from({ length: 12 }, (_, at) => ({ name: `t${at}`, address: '' }))
    expect(() => tagTable(rows)).toThrow(
      /^The table cannot be used\.\nRow 1 \(t0\): It needs an address.*And 2 more rows\.$/s,
    )
    expect(() => tagTable(5 as never)).toThrow(/A table of tags is a list of rows, not 5/)
    expect(() => tagTable(rows)).toThrow(RequestError)
  })

  test('is written by names', () => {
    const table = defineTags({ level: 'D100:REAL', pump: { address: 'M0', access: 'readWrite' } }, { readItem })
    expect(table.tags).toEqual([
      { name: 'level', address: 'D100:REAL' },
      { name: 'pump', address: 'M0', access: 'readWrite' },
    ])
    expect(table.tag('pump').access).toBe('readWrite')
    // The compiler knows the very texts: values are typed by them.
    const address: 'D100:REAL' = table.definitions.level
    expect(address).toBe('D100:REAL')
    // @ts-expect-error: there is no such name
    expect(() => table.tag('Level')).toThrow("There is no tag 'Level'. It has 'level'.")
  })

  test.each([
    [{ level: 5 }, /It needs an address, not 5/],
    [{ level: null }, /It needs an address, not null/],
    [5, /Tags are an object of addresses by name/],
    [['D100'], /Tags are an object of addresses by name/],
  ])('is refused: %j', (definitions, message) => {
    expect(() => defineTags(definitions as never)).toThrow(message)
  })

  test('does not change with the rows it was made of', () => {
    const row = { name: 'a', address: 'D0', scaling: { kind: 'linear', raw: [0, 1], engineering: [0, 1] } } as const
    const table = tagTable([row])
    ;(row.scaling.raw as unknown as number[])[0] = 5
    expect(table.tag('a').scaling?.raw).toEqual([0, 1])
  })

  test('of 10,000 tags is checked at once', () => {
    const rows = Array.from({ length: 10_000 }, (_, at) => ({ name: `t${at}`, address: `D${at}`, type: 'INT' }))
    const start = performance.now()
    expect(tagTable(rows, { readItem }).tags).toHaveLength(10_000)
    expect(performance.now() - start).toBeLessThan(5000)
  })
})

describe('for many machines', () => {
  const rows: readonly Tag[] = [
    { name: 'm{station}.level', address: 'D{station}00:REAL', description: 'level of {station}', unit: 'm' },
    { name: 'm{station}.speed', address: 'Line{station}.Speed', scanClass: 'fast' },
  ]

  test('placeholders are filled in', () => {
    expect(tagsOfMachine(rows, { parameters: { station: 3 } })).toEqual([
      { name: 'm3.level', address: 'D300:REAL', description: 'level of 3', unit: 'm' },
      { name: 'm3.speed', address: 'Line3.Speed', scanClass: 'fast' },
    ])
    expect(problemsOfTags(rows, { template: true, readItem })).toEqual([])
    expect(problem({ ...rows[0], type: 'REEL' }, { template: true })).toMatch(/'REEL' is not a type/)
  })

  test('addresses move as their family says', () => {
    const move: MoveAddress<{ readonly D: number }> = (address, { D }) =>
      address.replace(/^D(\d+)/, (_, number) => `D${Number(number) + D}`)
    expect(tagsOfMachine([{ name: 'a', address: 'D10:INT' }], { offset: { D: 50 } }, move)).toEqual([
      { name: 'a', address: 'D60:INT' },
    ])
    expect(() => tagsOfMachine([{ name: 'a', address: 'D10' }], { offset: 5 })).toThrow(/needs the function that moves/)
  })

  test('what is missing, left over or wrong is refused', () => {
    expect(() => tagsOfMachine(rows, {})).toThrow('{station} has no value: give it in parameters')
    expect(() => tagsOfMachine(rows, { parameters: { station: 1, line: 2 } })).toThrow('No tag has {line}')
    expect(() => tagsOfMachine(rows, { parameters: { station: 1.5 } })).toThrow(/is a text or a whole number, not 1.5/)
    expect(() => tagsOfMachine([{ name: 'a{toString}', address: 'D0' }], {})).toThrow('{toString} has no value')
    expect(() => tagsOfMachine(rows, { parameters: { station: '{station}' } })).toThrow(/\{station\} in its name has/)
    const twins = [rows[0], { ...rows[0], name: 'm1.level' }] as Tag[]
    expect(() => tagsOfMachine(twins, { parameters: { station: 1 } })).toThrow(/is that of row 1 already/)
  })
})
