// Values that the editor's typed inputs stand for.
import type { Node, NodeAPI, NodeMessage } from 'node-red'

/** A value of a typed input as a flow stores it. */
export interface TypedValue {
  readonly value: string
  /** `msg`, `flow`, `global`, `env`, `jsonata`, `json`, `str`, `num`, `bool`, ... */
  readonly type: string
}

/**
 * What the input stands for now.
 * @throws Error when the expression or the JSON is wrong.
 */
export function evaluate(RED: NodeAPI, node: Node, message: NodeMessage, input: TypedValue): Promise<unknown> {
  return new Promise((resolve, reject) => {
    RED.util.evaluateNodeProperty(input.value, input.type, node, message, (error: Error | null, result: unknown) => {
      if (error) reject(error)
      else resolve(result)
    })
  })
}

const VARIABLE = /\$\{([^}]+)\}/g

/**
 * The text with its `${NAME}`s replaced by environment variables of the flow, its groups, Node-RED or the system.
 * Node-RED itself replaces only settings that are nothing but one variable, and leaves an unknown one as it is.
 * @throws Error naming the variable that is not set.
 */
export function withVariables(RED: NodeAPI, node: Node, text: string, missing: (name: string) => Error): string {
  return text.replace(VARIABLE, (_whole, name: string) => {
    const value: unknown = RED.util.getSetting(node, name)
    if (value === '' || value === undefined || value === null) throw missing(name)
    return String(value)
  })
}
