/** Rows, cells and numbers of files. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { delimiters, guarded, rowsOf, textOfRows, unguarded } from '../../src/tags/files/cells'
import { cellOfNumber, decimalSignOf, numberOfCell } from '../../src/tags/files/numbers'

describe('rows', () => {
  test('know the line where they begin', () => {
    expect(rowsOf('a,b\r\n\r\n"c\r\nd",e\nf', ',')).toEqual([
      { line: 1, cells: ['a', 'b'] },
      { line: 3, cells: ['c\r\nd', 'e'] },
      { line: 5, cells: ['f'] },
    ])
  })

  test('have quotes doubled in quotes, and delimiters', () => {
    expect(rowsOf('"a ""x"" ;b";c;', ';')).toEqual([{ line: 1, cells: ['a "x" ;b', 'c', ''] }])
  })

  test('say what is wrong with their quotes', () => {
    expect(rowsOf('"a,b\nc', ',')).toEqual([{ line: 1, cells: ['a,b\nc'], fault: 'a quotation mark is not closed' }])
    expect(rowsOf('"a"b,c', ',')[0]?.fault).toBe('behind the quotes of cell 1 stands "b"')
  })

  test('are read as they were written', () => {
    const cell = fc.oneof(fc.string(), fc.constantFrom('"', '""', 'a\r\nb', '\n', '\r', '\t', ' a', ';', ',', "'"))
    const rows = fc.array(fc.array(cell, { minLength: 1 }).filter((row) => row.some((one) => one !== '')))
    fc.assert(
      fc.property(rows, fc.constantFrom(...delimiters), fc.boolean(), (given, delimiter, all) => {
        expect(rowsOf(textOfRows(given, delimiter, all), delimiter).map(({ cells }) => cells)).toEqual(given)
      }),
    )
  })
})

describe('formulas', () => {
  test.each(['=1+1', '+1', '-1', '@SUM(A1)', '\t=1', '\r=1', '＝１', "'=1", "''@"])('%j are guarded', (text) => {
    expect(guarded(text)).toBe(`'${text}`)
    expect(unguarded(guarded(text))).toBe(text)
  })

  test('what is none stays, and every text comes back', () => {
    for (const text of ['', 'level', "'", "it's", "'a", '1-1']) expect(guarded(text)).toBe(text)
    fc.assert(
      fc.property(fc.array(fc.constantFrom("'", '=', '+', '-', '@', 'a', '\t')), (signs) => {
        expect(unguarded(guarded(signs.join('')))).toBe(signs.join(''))
        expect(guarded(signs.join(''))).not.toMatch(/^[=+\-@\t]/)
      }),
    )
  })
})

describe('numbers', () => {
  test.each([
    [['0,5', '10'], '\t', ','],
    [['0.5', '1.234'], ';', '.'],
    [['1,234'], ';', ','],
    [['1,234'], ',', '.'],
    [['10', ''], ';', ','],
    [['10', ''], ',', '.'],
    [['0,5', '0.5'], '\t', '.'],
    [['0,5', '0.5'], ';', ','],
    [['1,5e3'], ',', ','],
  ] as const)('of %j with %j between the cells have %j', (cells, delimiter, sign) => {
    expect(decimalSignOf(cells, delimiter)).toBe(sign)
  })

  test.each([
    ['0,5', ',', 0.5],
    [' -12 ', ',', -12],
    ['+1.5e-3', '.', 0.0015],
    ['.5', '.', 0.5],
    ['5.', '.', 5],
  ] as const)('%j with %j is %d', (cell, sign, number) => {
    expect(numberOfCell(cell, sign)).toBe(number)
  })

  test.each([
    ['1,234', '.', "'1,234' has a comma, but the decimal sign of this file is the point; thousands are not separated"],
    [
      '1.234,5',
      ',',
      "'1.234,5' has a point, but the decimal sign of this file is the comma; thousands are not separated",
    ],
    ['1.2.3', '.', "'1.2.3' is no number"],
    ['1e999', '.', "'1e999' is no number"],
    ['0x10', '.', "'0x10' is no number"],
    ['', '.', "'' is no number"],
    ['NaN', '.', "'NaN' is no number"],
    ['１', '.', "'１' is no number"],
  ] as const)('%j with %j is none', (cell, sign, message) => {
    expect(() => numberOfCell(cell, sign)).toThrow(message)
  })

  test('are read as they were written', () => {
    fc.assert(
      fc.property(fc.double({ noNaN: true, noDefaultInfinity: true }), fc.constantFrom('.', ','), (number, sign) => {
        expect(numberOfCell(cellOfNumber(number, sign), sign)).toBe(number + 0)
      }),
    )
  })
})
