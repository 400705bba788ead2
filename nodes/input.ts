// Values of a node's typed inputs: the setting, and beside it where the value comes from.
import type { NodeMessageInFlow } from 'node-red'
import type { StoredSettings } from './migration'
import type { Tools } from './node'
import { textIn, wordIn } from './stored'
import { evaluate } from './typed-input'

export type Input<T> = (message: NodeMessageInFlow) => Promise<T>

/**
 * The value of a setting for a message; its type is stored under the name with `Type` behind it.
 * @throws NodeFailure when the settings are not understood
 * @example inputIn(settings, 'address', ['num', 'msg'], tools)
 */
export function inputIn<const T extends string>(
  settings: StoredSettings,
  field: string,
  types: readonly [T, ...T[]],
  { RED, node, texts }: Tools,
): Input<unknown> {
  const input = { value: textIn(settings, field, texts), type: wordIn(settings, `${field}Type`, types, texts) }
  return (message) => evaluate(RED, node, message, input)
}
