/**
 * What the example flows must do, as steps: for the tests here and for the matrix of installed packages.
 *
 * test/matrix/expectations.json: one entry for each file of examples/.
 * - `simulate`: options for `melsec-jw simulate`, e.g. `["--profile", "iq-f"]`; default none
 * - `connection`: settings put into the flow's connections besides `host` and `port`, e.g. `{ "allowWrites": true }`
 * - `steps`, in this order: `press` an inject node by its id, or hand `message` to the node `receive`; then the next
 *   message from output `output` (default 0) of the node `from` must contain `is`. In `is`, `{ "$any": "number" }`
 *   (or string, boolean, object, array) stands for any value of that kind.
 * Every node of ours that has outputs must be the `from` of some step.
 */
import { expect } from '@jest/globals'
import type { FlowNode, NodeRed } from './node-red'

export interface Step {
  readonly press?: string
  readonly receive?: string
  readonly message?: Readonly<Record<string, unknown>>
  readonly from?: string
  readonly output?: number
  readonly is?: unknown
}

export interface Expectation {
  readonly simulate?: readonly string[]
  readonly connection?: Readonly<Record<string, unknown>>
  readonly steps: readonly Step[]
}

const KINDS: Readonly<Record<string, unknown>> = {
  number: expect.any(Number),
  string: expect.any(String),
  boolean: expect.any(Boolean),
  object: expect.any(Object),
  array: expect.any(Array),
}

function withKinds(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(withKinds)
  if (typeof value !== 'object' || value === null) return value
  if ('$any' in value) {
    const kind = KINDS[String(value.$any)]
    if (kind === undefined) throw new Error(`expectations.json: there is no kind ${String(value.$any)}`)
    return kind
  }
  return Object.fromEntries(Object.entries(value).map(([name, item]) => [name, withKinds(item)]))
}

/** The words that `melsec-jw simulate` sends unasked with these options. */
export function onDemandOf({ simulate = [] }: Expectation): readonly number[] | undefined {
  const at = simulate.indexOf('--on-demand')
  return at < 0 ? undefined : (simulate[at + 1] ?? '').split(',').map(Number)
}

export function isOurs(node: FlowNode): boolean {
  return node.type.startsWith('melsec-jw-')
}

/** The flow with its connections, or its serial line, led to what is simulated. */
export function connectedTo(flow: readonly FlowNode[], port: number, settings: Expectation['connection']): FlowNode[] {
  const place = { host: '127.0.0.1', port }
  return flow.map((node) => {
    if (node.type === 'melsec-jw-line') return { ...node, transport: 'tcp', ...place }
    return node.type === 'melsec-jw-connection' ? { ...node, ...place, ...settings } : node
  })
}

/** Whether a simulated Sharp JW is needed. */
export function isOfJw(flow: readonly FlowNode[]): boolean {
  return flow.some(({ type, family }) => type === 'melsec-jw-connection' && family === 'jw')
}

/** Whether a simulated serial line is needed instead of a PLC. */
export function isOnLine(flow: readonly FlowNode[]): boolean {
  return flow.some(({ type }) => type === 'melsec-jw-line')
}

export async function take(red: NodeRed, step: Step): Promise<void> {
  if (step.press !== undefined) {
    expect(await red.http('POST', `inject/${step.press}`)).toMatchObject({ status: 200 })
  }
  if (step.receive !== undefined) await red.receive(step.receive, step.message ?? {})
  if (step.from !== undefined) {
    const message = await red.next(step.from, step.output ?? 0)
    expect({ from: step.from, message }).toMatchObject({ from: step.from, message: withKinds(step.is ?? {}) })
  }
}
