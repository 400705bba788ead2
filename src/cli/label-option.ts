// `--label` and `--labels`: global labels of the simulated PLC as they are typed, or in a file.
import { readFile } from 'node:fs/promises'
import type { SimulatedLabel, SimulatedLabels } from '../entry/simulator'
import { RequestError } from '../index'
import { typedValue } from './typed-value'

/**
 * `name:type`, `name:type=value`; an array is `name:type[10]` or `name:type[2,3]` with its first elements between commas.
 * The simulator checks names and types.
 * @throws RequestError BAD_OPTION when it is no such text, BAD_VALUE for the value
 * @example labelOf('Line1.Speed:REAL=12.5')   // ['Line1.Speed', { type: 'REAL', value: 12.5 }]
 * @example labelOf('Line1.Values:INT[10]')    // ['Line1.Values', { type: 'INT', dimensions: [10] }]
 */
export function labelOf(text: string): readonly [name: string, label: SimulatedLabel] {
  const [, name, declared = '', value] = /^([^:=]+):([^=]+)(?:=(.*))?$/s.exec(text.trim()) ?? []
  const [, type = '', counts] = /^(.*?)(?:\[\s*(\d+(?:\s*,\s*\d+)*)\s*\])?$/s.exec(declared.trim()) ?? []
  if (name === undefined || type === '') {
    const message = `${JSON.stringify(text)} is no label: write name:type=value, e.g. Line1.Speed:REAL=12.5.`
    throw new RequestError('BAD_OPTION', message, 'label')
  }
  const dimensions = counts?.split(',').map(Number)
  const count = value === undefined || dimensions === undefined ? undefined : value.split(',').length
  const wanted = { text: name.trim(), type: type.trim(), ...(count === undefined ? {} : { count }) }
  const label: SimulatedLabel = {
    type: wanted.type,
    ...(dimensions === undefined ? {} : { dimensions }),
    ...(value === undefined ? {} : { value: typedValue(wanted, value) }),
  }
  return [wanted.text, label]
}

/**
 * The labels of a file and of `--label`, which comes last and wins.
 * @param file a JSON object by name, of `{ type, dimensions, value }`
 * @throws RequestError BAD_OPTION for a file that cannot be read or holds something else
 */
export async function labelsOf(file: string | undefined, texts: readonly string[]): Promise<SimulatedLabels> {
  return { ...(file === undefined ? {} : await labelsIn(file)), ...Object.fromEntries(texts.map(labelOf)) }
}

async function labelsIn(file: string): Promise<SimulatedLabels> {
  const bad = (reason: string) => new RequestError('BAD_OPTION', `--labels ${file}: ${reason}`, 'labels')
  let found: unknown
  try {
    found = JSON.parse(await readFile(file, 'utf8'))
  } catch (error) {
    throw bad(error instanceof Error ? error.message : String(error))
  }
  if (!isObject(found)) throw bad('it holds no object of labels by name, as in {"Line1.Speed": {"type": "REAL"}}.')
  return Object.fromEntries(
    Object.entries(found).map(([name, label]) => {
      const problem = labelProblem(label)
      if (problem !== undefined) throw bad(`${name}: ${problem}`)
      return [name, label as SimulatedLabel]
    }),
  )
}

function isObject(value: unknown): value is Readonly<Record<string, unknown>> {
  return typeof value === 'object' && value !== null && !Array.isArray(value)
}

const FIELDS = { type: true, dimensions: true, value: true } as const satisfies Record<keyof SimulatedLabel, true>

/** The simulator checks what types and values say; here only that they are some. */
function labelProblem(label: unknown): string | undefined {
  if (!isObject(label)) return 'a label is an object with its type.'
  const unknown = Object.keys(label).find((name) => !Object.hasOwn(FIELDS, name))
  if (unknown !== undefined)
    return `a label has no ${JSON.stringify(unknown)}; it has ${Object.keys(FIELDS).join(', ')}.`
  const { type, dimensions, value } = label
  if (typeof type !== 'string') return 'its type is missing, e.g. "REAL".'
  if (dimensions !== undefined && !isListOf(dimensions, isNumber)) return 'dimensions are a list of numbers.'
  if (value === undefined || isScalar(value) || isListOf(value, isScalar)) return undefined
  return 'its value is a number, a text, true or false, or a list of them.'
}

function isListOf<T>(value: unknown, isOne: (one: unknown) => one is T): value is T[] {
  return Array.isArray(value) && value.every(isOne)
}

function isNumber(value: unknown): value is number {
  return typeof value === 'number'
}

function isScalar(value: unknown): value is string | number | boolean {
  return ['string', 'number', 'boolean'].includes(typeof value)
}
