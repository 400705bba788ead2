/** Explanations held against the bytes and the messages that they explain. */
import { expect } from '@jest/globals'
import type { AnnotatedRow } from '../../src/codec/annotate'
import { explainFrame, type FrameExplanation } from '../../src/melsec/explain/frame'
import type { ExplainFrameOptions } from '../../src/melsec/explain/options'

export function uncovered({ rows, rest }: FrameExplanation, bytes: Buffer): string | undefined {
  let next = 0
  for (const { offset, length, name } of rows) {
    if (offset !== next) return `${name} starts at ${offset}, expected ${next}`
    next += length
  }
  return next === bytes.length - rest ? undefined : `the rows end at ${next} of ${bytes.length - rest}`
}

/** The values of a field; long ones stand in several rows. */
function valueAt(rows: readonly AnnotatedRow[], path: string): unknown {
  const own = rows.find(({ name }) => name === path)
  if (own !== undefined) return own.value
  const parts = rows.filter(
    ({ name }) => name.startsWith(`${path}.`) && /^\d+(\.\.\d+)?$/.test(name.slice(path.length + 1)),
  )
  return parts.length === 0 ? undefined : parts.flatMap(({ value }) => value)
}

/** Paths and values of everything in a message that is one field. */
function leavesOf(value: unknown, path = ''): [string, unknown][] {
  const isLeaf =
    typeof value !== 'object' ||
    value === null ||
    ('device' in value && typeof value.device === 'string') ||
    (Array.isArray(value) && value.some((element) => typeof element !== 'object'))
  if (isLeaf) return [[path, value]]
  return Object.entries(value).flatMap(([name, part]) => leavesOf(part, path === '' ? name : `${path}.${name}`))
}

export function expectMessage(explanation: FrameExplanation, message: unknown): void {
  const leaves = leavesOf(message).filter(([, value]) => !Array.isArray(value) || value.length > 0)
  // A password is shown as asterisks only.
  const shown = leaves.map(([path, value]) => [path, path === 'password' ? '********' : value])
  const found = leaves.map(([path]) => {
    const value = valueAt(explanation.rows, path)
    return [path, value instanceof Uint8Array ? [...value] : value]
  })
  expect(found).toEqual(shown)
}

export function explained(bytes: Buffer, options: ExplainFrameOptions = {}): FrameExplanation {
  const explanation = explainFrame(bytes, options)
  expect(explanation.fault).toBeUndefined()
  expect(explanation.rest).toBe(0)
  expect(uncovered(explanation, bytes)).toBeUndefined()
  return explanation
}

/** Rows as `name: text`. */
export function lines({ rows }: FrameExplanation): string[] {
  return rows.map(({ name, text }) => `${name}: ${text}`)
}
