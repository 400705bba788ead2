/** What an import changes of a table, and the table that is made of both. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { diffTags, mergeTags } from '../../src/tags/diff'
import { problemsOfTags } from '../../src/tags/table/check'
import type { Tag } from '../../src/tags/table/tag'
import { anyTable, readItem } from './support'

const scaling = { kind: 'linear', raw: [0, 4000], engineering: [0, 10] } as const
const table: readonly Tag[] = [
  { name: 'level', address: 'D100', type: 'INT', unit: 'm', scaling, access: 'readWrite', min: 0, max: 10 },
  { name: 'pump', address: 'M0', description: 'pump' },
  { name: 'own', address: 'D900', description: 'added by people' },
]

describe('the difference', () => {
  test('is what is new, changed field by field, gone, and the same', () => {
    const imported: readonly Tag[] = [
      { name: 'level', address: 'D110', type: 'INT', description: 'level of tank 1' },
      { name: 'pump', address: 'M0', type: 'BOOL', description: 'pump' },
      { name: 'new', address: 'D5' },
    ]
    expect(diffTags(table, imported, { readItem })).toEqual({
      added: [{ name: 'new', address: 'D5' }],
      changed: [
        {
          name: 'level',
          before: table[0],
          after: { ...table[0], address: 'D110', description: 'level of tank 1' },
          fields: [
            { field: 'address', before: 'D100', after: 'D110' },
            { field: 'description', before: undefined, after: 'level of tank 1' },
          ],
        },
      ],
      gone: [table[2]],
      conflicts: [],
      // M0 is BOOL, whether that is said or not.
      same: 1,
    })
    expect(diffTags(table, imported).changed.map(({ name }) => name)).toEqual(['level', 'pump'])
  })

  test.each([
    [
      { name: 'level', address: 'D100', type: 'REAL' },
      /^Its type was INT and is REAL now, but its scaling, min, max were made for the old one\.$/,
    ],
    [
      { name: 'Level', address: 'D100', type: 'INT' },
      /^The import calls it 'Level', which people take for the same name\.$/,
    ],
    [{ name: 'pump', address: 'DD1' }, /DD1/],
  ])('is in conflict for %j', (imported, reason) => {
    const { conflicts, changed, added } = diffTags(table, [imported], { readItem })
    expect({ changed, added }).toEqual({ changed: [], added: [] })
    expect(conflicts).toEqual([
      { name: expect.any(String), before: expect.anything(), imported, reason: expect.stringMatching(reason) },
    ])
  })

  test('is a conflict when the type of an address is lost', () => {
    const typed = [{ name: 'a', address: 'D0:REAL' }]
    expect(diffTags(typed, [{ name: 'a', address: 'D1' }]).conflicts[0]?.reason).toBe(
      'Its address was D0:REAL and is D1 now, without a type.',
    )
    expect(diffTags(typed, [{ name: 'a', address: 'D0', description: 'x' }]).changed[0]?.after).toEqual({
      name: 'a',
      address: 'D0:REAL',
      description: 'x',
    })
  })

  test('is none between two spellings of the same device', () => {
    const imported = [{ name: 'a', address: 'D0', type: 'REAL', count: 2 }]
    expect(diffTags([{ name: 'a', address: 'd00:REAL[2]' }], imported, { readItem }).same).toBe(1)
  })
})

describe('merged', () => {
  const imported: readonly Tag[] = [
    { name: 'level', address: 'D100', type: 'REAL' },
    { name: 'pump', address: 'M1', type: 'BOOL' },
    { name: 'new', address: 'D5' },
  ]

  test('keep what people added, what the import lacks, and rows in conflict', () => {
    expect(mergeTags(table, imported, { readItem })).toEqual([
      table[0],
      { name: 'pump', address: 'M1', type: 'BOOL', description: 'pump' },
      table[2],
      { name: 'new', address: 'D5' },
    ])
  })

  test('lose what is gone, and take rows in conflict from the import, when that is said', () => {
    expect(mergeTags(table, imported, { readItem, gone: 'remove', conflicts: 'replace' })).toEqual([
      { name: 'level', address: 'D100', type: 'REAL' },
      { name: 'pump', address: 'M1', type: 'BOOL', description: 'pump' },
      { name: 'new', address: 'D5' },
    ])
    expect(() => mergeTags(table, imported, { gone: 'delete' as never })).toThrow(
      /gone is 'delete'; it is keep or remove/,
    )
    expect(() => mergeTags(table, imported, { conflicts: 'no' as never })).toThrow(/conflicts is 'no'/)
    expect(() => mergeTags(table, [{ name: '', address: 'D0' }])).toThrow(/The table cannot be used/)
  })

  const options = fc.record(
    {
      gone: fc.constantFrom('keep', 'remove'),
      conflicts: fc.constantFrom('keep', 'replace'),
      readItem: fc.constant(readItem),
    },
    { requiredKeys: [] },
  )
  /** Two tables with names in common, of which some differ in case. */
  const pairs = fc
    .tuple(anyTable, anyTable, fc.array(fc.boolean(), { minLength: 6, maxLength: 6 }))
    .map(([old, other, same]) => {
      const renamed = other.map((tag, at) =>
        same[at] === true && old[at] !== undefined ? { ...tag, name: old[at].name } : tag,
      )
      const names = new Set<string>()
      const unique = renamed.filter(({ name }) => {
        const key = name.normalize('NFKC').toLowerCase()
        return names.has(key) ? false : names.add(key)
      })
      return [old, unique] as const
    })

  test('a second time they do not change', () => {
    fc.assert(
      fc.property(pairs, options, ([old, imported], how) => {
        const once = mergeTags(old, imported, how)
        expect(mergeTags(once, imported, how)).toEqual(once)
        expect(diffTags(once, imported, how).changed).toEqual([])
        expect(diffTags(once, imported, how).added).toEqual([])
        expect(problemsOfTags(once)).toEqual([])
      }),
      { numRuns: 500 },
    )
  })

  test('a table with itself is itself', () => {
    fc.assert(
      fc.property(anyTable, options, (tags, how) => {
        expect(mergeTags(tags, tags, how)).toEqual(tags)
        expect(diffTags(tags, tags, how)).toEqual({
          added: [],
          changed: [],
          gone: [],
          conflicts: [],
          same: tags.length,
        })
      }),
    )
  })

  test('nothing that people added is lost but where the import says so', () => {
    const people = ['unit', 'scaling', 'deadband', 'scanClass', 'access', 'min', 'max', 'format'] as const
    fc.assert(
      fc.property(pairs, ([old, imported]) => {
        const merged = new Map(mergeTags(old, imported).map((tag) => [tag.name, tag]))
        const found = new Map(imported.map((tag) => [tag.name, tag]))
        for (const tag of old)
          for (const field of people)
            if (tag[field] !== undefined && found.get(tag.name)?.[field] === undefined)
              expect(merged.get(tag.name)?.[field]).toEqual(tag[field])
      }),
    )
  })

  test('of 10,000 tags are made at once', () => {
    const many = Array.from({ length: 10_000 }, (_, at): Tag => ({ name: `t${at}`, address: `D${at}`, unit: 'm' }))
    const others = many.map(({ name, address }): Tag => ({ name, address, type: 'INT', description: name }))
    const start = performance.now()
    expect(mergeTags(many, others, { readItem })[9999]).toEqual({
      name: 't9999',
      address: 'D9999',
      unit: 'm',
      description: 't9999',
    })
    expect(performance.now() - start).toBeLessThan(5000)
  })
})
