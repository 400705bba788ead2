/** The lists in docs/tags.md are those of the code. */
import { expect, test } from '@jest/globals'
import { columnNames, columnOf } from '../../src/tags/files/columns'
import { tagFileKinds } from '../../src/tags/files/result'
import { tagFields } from '../../src/tags/table/tag'
import { codeOf, codeSpansOf, tableAfter } from './markdown'

const page = 'docs/tags.md'
const namesIn = (mark: string) => tableAfter(page, mark).map(([cell]) => codeOf(cell))

test('the fields of a tag', () => {
  expect(namesIn('tag fields')).toEqual(tagFields)
})

test('the kinds of files', () => {
  expect(namesIn('tag files')).toEqual(tagFileKinds)
})

test('the columns of CSV, with their other names', () => {
  const shown = tableAfter(page, 'csv columns').map(([name, aliases = '']) => [codeOf(name), codeSpansOf(aliases)])
  expect(shown).toEqual(columnNames.map(columnOf).map(({ header, aliases = [] }) => [header, aliases]))
})
