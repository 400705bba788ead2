/** docs/jw-addresses.md against the code: operands, areas and types. */
import { describe, expect, test } from '@jest/globals'
import { octal } from '../../src/basics/octal'
import { parseJwItem } from '../../src/client/jw/item'
import { RequestError } from '../../src/errors'
import { assumedJwAreas, type JwArea, jwAreas } from '../../src/jw/operand/area'
import { byteTypes } from '../../src/value/byte-type'
import { codeOf, codeSpansOf, tableAfter, tablesAfter } from './markdown'

const PAGE = 'docs/jw-addresses.md'

function placesShown(mark: string): (readonly (string | undefined)[])[] {
  return tableAfter(PAGE, mark).map(([operands = '', address]) => [...codeSpansOf(operands), address])
}

function placesOf(areas: readonly JwArea[]): (readonly string[])[] {
  return areas.map(({ first, last, address }) => [first, last, octal(address, 6)])
}

describe('operands of a Sharp JW', () => {
  test('that are said to be accepted are accepted', () => {
    const texts = tablesAfter(PAGE, 'jw: accepted')
      .flat()
      .map(([text]) => codeOf(text) ?? '')
    expect(texts.length).toBeGreaterThan(20)
    for (const text of texts) expect(() => parseJwItem(text)).not.toThrow()
  })

  test('that are said to be refused are refused, and what is named instead is accepted', () => {
    const rows = tableAfter(PAGE, 'jw: refused')
    expect(rows.length).toBeGreaterThan(10)
    for (const [text, why = ''] of rows) {
      expect(() => parseJwItem(codeOf(text) ?? '')).toThrow(RequestError)
      const instead = codeSpansOf(why).filter((span) => /\d/.test(span))
      for (const span of instead) expect(() => parseJwItem(span)).not.toThrow()
    }
  })

  test('lie where the page says', () => {
    expect(placesShown('jw: areas')).toEqual(placesOf(jwAreas))
    expect(tableAfter(PAGE, 'jw: areas').map(([, , sure]) => sure)).toEqual(jwAreas.map(({ confidence }) => confidence))
    expect(placesShown('jw: assumed')).toEqual(placesOf(assumedJwAreas))
    expect([...jwAreas, ...assumedJwAreas].every(({ file }) => file === 0)).toBe(true)
  })

  test('have the types of one byte on the page', () => {
    const shown = tableAfter(PAGE, 'jw: types').map(([type, , , range = '']) => [
      codeOf(type),
      range.replace(/,.*/, ''),
    ])
    expect(shown).toEqual(Object.entries(byteTypes).map(([name, { min, max }]) => [name, `${min} to ${max}`]))
  })
})
