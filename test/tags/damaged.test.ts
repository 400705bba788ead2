/** Files that were damaged or cut: tags, messages or a clear refusal, and nothing else. */
import { expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../src/errors'
import { exportTags } from '../../src/tags/files/export'
import { importTags } from '../../src/tags/files/import'
import { problemsOfTags } from '../../src/tags/table/check'
import type { Tag } from '../../src/tags/table/tag'
import { gxText, utf16 } from './support'

const tags = [
  { name: 'level', address: 'D0', unit: '°C', scaling: { kind: 'linear', raw: [0, 1], engineering: [0, 1] } },
  { name: '水位', address: 'D1', description: '=1' },
] as const
const label = ['Label Name', 'Data Type', 'Assign (Device/Label)', 'Comment']
const files: readonly Uint8Array[] = [
  exportTags(tags, { kind: 'csv' }).bytes,
  exportTags(tags, { kind: 'csv', delimiter: ';', encoding: 'shift-jis' }).bytes,
  exportTags(tags, { kind: 'json' }).bytes,
  utf16(gxText(['Plant'], label, ['A', 'Bit(0..3)', 'M0', 'x'], ['B', 'Word [Signed]', 'D0', 'y'])),
  Buffer.from('Device Name\tComment\r\nD0\tlevel\r\nM0\tpump\r\n'),
]

/** Bytes in place of others. */
const damage = fc.record({
  at: fc.nat({ max: 400 }),
  away: fc.nat({ max: 4 }),
  instead: fc.oneof(
    fc.uint8Array({ maxLength: 3 }),
    fc.constantFrom('"', '\t', ';', '\r\n', '{', "'=").map(Buffer.from),
  ),
})

function readOrRefused(bytes: Uint8Array): readonly Tag[] | undefined {
  try {
    return importTags(bytes).tags
  } catch (error) {
    if (error instanceof RequestError) return undefined
    throw error
  }
}

test('whatever happens to a file, what comes of it is a table, or it is refused', () => {
  fc.assert(
    fc.property(fc.constantFrom(...files), fc.array(damage, { maxLength: 5 }), (file, damages) => {
      const bytes = damages.reduce(
        (now, { at, away, instead }) => Buffer.concat([now.subarray(0, at), instead, now.subarray(at + away)]),
        Buffer.from(file),
      )
      const found = readOrRefused(bytes)
      if (found === undefined) return
      expect(problemsOfTags(found)).toEqual([])
      expect(importTags(exportTags(found, { kind: 'csv' }).bytes).tags).toEqual(found)
    }),
    { numRuns: 2000 },
  )
})

test('every row of a file is a tag or has a message', () => {
  const cell = fc.constantFrom('', 'a', 'b', 'D0', 'Bit', 'Word [Signed](0..2)', 'Timer', 'M0', '\n', '"', 'x\ty', ';')
  const row = fc.array(cell, { minLength: 4, maxLength: 6 }).filter((cells) => cells.some((one) => one !== ''))
  fc.assert(
    fc.property(fc.array(row, { maxLength: 8 }), (rows) => {
      const { tags: found, messages } = importTags(utf16(gxText(['Plant'], label, ...rows)))
      const refused = new Set(messages.filter(({ about }) => about === 'row').map(({ line }) => line))
      expect(found.length + refused.size).toBe(rows.length)
    }),
    { numRuns: 500 },
  )
})
