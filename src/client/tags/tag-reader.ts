// What a client knows of the items of tags, without asking the PLC.
import type { ReadTagItem, TagFacts } from '../../tags/table/check'
import type { TagItem } from '../../tags/table/tag'
import { parseByteType } from '../../value/byte-type'

/** What the clients of all families say of an item. */
export interface ExplainedItem {
  /** The item in its usual spelling. */
  readonly text: string
  /** Of a label its name. */
  readonly label?: string
  /** Type of one value; of a label it may be missing. */
  readonly type?: string
  /** Values of an array. */
  readonly count?: number
}

/**
 * Checks addresses and types of tags as this client does; nothing is sent for it.
 * @example problemsOfTags(rows, { readItem: tagReaderOf(plc) })
 */
export function tagReaderOf(client: { explain(item: TagItem): ExplainedItem }): ReadTagItem {
  return (item) => factsOf(client.explain(item))
}

function factsOf({ text, label, type, count }: ExplainedItem): TagFacts {
  const facts = {
    ...(type === undefined ? {} : { type: parseByteType(type) }),
    ...(count === undefined ? {} : { count }),
  }
  if (label !== undefined) return facts
  const one = count === undefined ? text : text.replace(/\[\d+\]$/, '')
  const behind = `:${type}`
  return { ...facts, device: one.endsWith(behind) ? one.slice(0, -behind.length) : one }
}
