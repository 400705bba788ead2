/** What the compiler infers of tags: it fails to compile when it is wrong. */
import { expect, test } from '@jest/globals'
import type { MelsecItems } from '../../../src/client/item/item-typing'
import type { JwItemTypes } from '../../../src/client/jw/client'
import type { TagInputIn, TagValueIn } from '../../../src/index'
import {
  createJwClient,
  createMelsecClient,
  defineTags,
  type PlcTags,
  type ReadValue,
  type TagDefinitions,
  type TagName,
  tagTable,
  type WritableTagName,
  type WriteValue,
} from '../../../src/index'

type Same<A, B> = (<T>() => T extends A ? 1 : 2) extends <T>() => T extends B ? 1 : 2 ? true : false
const is = <_T extends true>() => true

const scaling = { kind: 'linear', raw: [0, 4000], engineering: [0, 10] } as const
const table = defineTags({
  level: { address: 'D100', scaling, access: 'readWrite' },
  total: { address: 'D104', type: 'LINT', access: 'readWrite' },
  scaled: { address: 'D104:LINT[2]', scaling },
  pump: 'M10',
  text: { address: 'D110:STRING(4)', access: 'read', unit: '' },
  label: 'label:Speed',
})
type Table = typeof table extends { definitions: infer D extends TagDefinitions } ? D : never
type Value<N extends TagName<Table>> = TagValueIn<MelsecItems, Table[N]>

test('values of tags follow their addresses, types and scalings', () => {
  expect([
    is<Same<Value<'level'>, number>>(),
    is<Same<Value<'total'>, bigint>>(),
    is<Same<Value<'scaled'>, number[]>>(),
    is<Same<Value<'pump'>, boolean>>(),
    is<Same<Value<'text'>, string>>(),
    is<Same<TagValueIn<JwItemTypes, '09012:INT'>, number>>(),
    is<Same<TagValueIn<JwItemTypes, { address: '04033'; unit: 'x' }>, boolean>>(),
    is<Same<TagInputIn<MelsecItems, Table['level']>, number>>(),
    is<Same<TagInputIn<MelsecItems, { address: 'M0'; access: 'readWrite' }>, boolean>>(),
  ]).not.toContain(false)
})

test('only tags that may be written are', () => {
  expect([is<Same<WritableTagName<Table>, 'level' | 'total'>>()]).toEqual([true])
})

test('of rows that a file has brought nothing is known', () => {
  expect([
    is<Same<TagValueIn<MelsecItems, TagDefinitions[string]>, ReadValue>>(),
    is<Same<TagInputIn<MelsecItems, TagDefinitions[string]>, WriteValue>>(),
    is<Same<WritableTagName<TagDefinitions>, string>>(),
  ]).not.toContain(false)
})

test('calls are typed by their names', async () => {
  const plc = createMelsecClient({ host: '127.0.0.1', port: 1, profile: 'iq-r' })
  const jw = createJwClient({ host: '127.0.0.1', port: 1 })
  const tags = plc.tags(table)
  const calls = (all: PlcTags<MelsecItems, TagDefinitions>) => [
    async () => {
      const { level, pump } = await tags.read()
      const one: number = level
      const other: boolean = pump
      return [one, other, (await tags.read('text')).length]
    },
    async () => {
      const some = await tags.read(['level'])
      // @ts-expect-error: it was not asked for
      return some.pump
    },
    () => tags.write({ level: 1.5, total: 3n }),
    // @ts-expect-error: it is only read
    () => tags.write({ pump: true }),
    // @ts-expect-error: a level is a number
    () => tags.write('level', true),
    // @ts-expect-error: there is no such tag
    () => tags.read('levle'),
    async () => {
      for await (const { values, changed } of tags.watch(['level', 'pump'], { every: 100 })) {
        const value: number | undefined = values.level.value
        return [value, changed satisfies readonly ('level' | 'pump')[]]
      }
      return undefined
    },
    () => all.write({ anything: 1 }),
    () => jw.tags(tagTable([])).read('anything'),
  ]
  expect(calls(plc.tags(tagTable([])))).toHaveLength(9)
  await plc.close()
  await jw.close()
})
