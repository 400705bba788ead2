/** The tables of docs/jw-parameters.md are those of the declarations. */
import { describe, expect, test } from '@jest/globals'
import { dl1Parameters } from '../../../src/jw/parameters/dl1'
import { dl9Areas, dl9Parameters } from '../../../src/jw/parameters/dl9'
import { flNetParameters } from '../../../src/jw/parameters/fl-net'
import { leavesOf } from '../../../src/jw/parameters/layout'
import { tableAfter } from '../../docs/markdown'
import { readText } from '../../support/syntax'

const page = 'docs/jw-parameters.md'
const maps = { 'fl-net': flNetParameters, dl1: dl1Parameters, dl9: dl9Parameters }

describe.each(Object.entries(maps))('%s', (name, map) => {
  test('has its parameters in a table', () => {
    const rows = map.table().map(({ address, setting, takes, doc }) => {
      return [address, setting === '' ? '' : `\`${setting}\``, takes, doc]
    })
    expect(tableAfter(page, `parameters: ${name}`)).toEqual(rows)
  })

  test('has every setting in words, each byte in one parameter', () => {
    const bytes = map.leaves.flatMap(({ address, length }) => Array.from({ length }, (_, i) => address + i))
    expect(new Set(bytes).size).toBe(bytes.length)
    expect(map.table().filter(({ setting, takes, doc }) => setting !== '' && (takes === '' || doc === ''))).toEqual([])
    const length = map.areas.reduce((sum, area) => sum + area.length, 0)
    expect(bytes).toHaveLength(length)
  })

  test('says when the unit uses them', () => {
    if (map.when.startsWith('SW0')) expect(readText(page)).toContain(map.when)
  })
})

test('the areas of DL9', () => {
  const rows = tableAfter(page, 'areas: dl9')
  expect(rows.map(([number, , bytes]) => [Number(number), Number(bytes)])).toEqual(
    dl9Areas.map(({ first, last }, number) => [number, last - first + 1]),
  )
})

test('a list of one parameter after the other is told by its step', () => {
  expect(dl1Parameters.table()[0]?.address).toBe('0100 + n')
  expect(dl9Parameters.table()[0]?.address).toBe('1000-1001 + 4n')
  expect(leavesOf({ address: 8, shape: {} })).toEqual([])
})
