// Results and errors as text for people and as JSON for programs.
import {
  ConnectionError,
  EndCodeError,
  isPortLocked,
  type PlanDescription,
  type PlcError,
  type ReadValue,
  TimeoutError,
} from '../index'
import type { Terminal } from './terminal'

/** Rows as aligned columns. */
export function table(rows: readonly (readonly string[])[], indent = ''): string {
  const widths: number[] = []
  for (const row of rows) {
    for (const [i, cell] of row.entries()) widths[i] = Math.max(widths[i] ?? 0, cell.length)
  }
  return rows
    .map((row) => `${indent}${row.map((cell, i) => cell.padEnd(widths[i] ?? 0)).join('  ')}`.trimEnd())
    .join('\n')
}

/** One JSON document: 64-bit integers as texts, bytes as hexadecimal digits. */
export function json(value: unknown): string {
  return JSON.stringify(value, replace, 2)
}

function replace(this: unknown, key: string, value: unknown): unknown {
  // A Buffer has turned itself into something else before it gets here.
  const original: unknown = typeof this === 'object' && this !== null ? Reflect.get(this, key) : value
  if (original instanceof Uint8Array) return Buffer.from(original).toString('hex')
  if (typeof value === 'bigint') return value.toString()
  // JSON has no such numbers, and null would look like a missing value.
  if (typeof value === 'number' && !Number.isFinite(value)) return String(value)
  return value
}

/** A value as an engineer reads it: bits ON and OFF, texts as they are (quoted in an array). */
export function valueText(value: ReadValue, type?: string): string {
  if (Array.isArray(value)) {
    return value
      .map((element) => (typeof element === 'string' ? JSON.stringify(element) : valueText(element, type)))
      .join(', ')
  }
  if (typeof value === 'boolean') return value ? 'ON' : 'OFF'
  return typeof value === 'number' && type === 'REAL' ? realText(value) : String(value)
}

/** The shortest digits that are this single-precision number: 71.3, and not 71.30000305175781. */
function realText(value: number): string {
  for (let digits = 6; digits < 9; digits++) {
    const short = Number(value.toPrecision(digits))
    if (Math.fround(short) === value) return String(short)
  }
  return String(value)
}

/** The requests of a plan, one a line, and then what one should know. */
export function planText(description: PlanDescription, asJson: boolean): string {
  if (asJson) return json(description)
  const lines = description.requests.map(({ text, requestBytes = '?', responseBytes = '?', items }) => [
    text,
    `${requestBytes} bytes out, ${responseBytes} in`,
    `for ${items.join(', ')}`,
  ])
  return [...(lines.length === 0 ? [] : [table(lines)]), ...description.notes].join('\n')
}

const PASSWORD_HINT = ' Say --password, or put it into the environment variable MELSEC_JW_PASSWORD.'

/** The port waits for its remote password: what to do here the text of the end code cannot know. */
function isLocked(error: PlcError): boolean {
  return error instanceof EndCodeError && isPortLocked(error)
}

function causesOf(error: PlcError): readonly string[] {
  return error instanceof ConnectionError || error instanceof TimeoutError ? error.causes : []
}

/** An error with its ranked causes, one per line. */
export function errorText(error: PlcError): string {
  const causes = causesOf(error)
  if (causes.length === 0) return `${error.message}${isLocked(error) ? PASSWORD_HINT : ''}`
  // For programs that print one line, messages end with their causes; here these get lines of their own.
  const message = error.message.replace(/\s*(Possible causes|Most likely|Likely): .*$/s, '')
  const ranked = causes.map((cause, i) => `  ${i + 1}. ${cause}`)
  return [message, 'Possible causes, the most likely first:', ...ranked].join('\n')
}

/** The error of one item among others. */
export function itemErrorText(item: string, error: PlcError): string {
  const text = errorText(error)
  return text.startsWith(item) || text.startsWith(JSON.stringify(item)) ? text : `${item}: ${text}`
}

/** Prints an error that ended a command. */
export function printError(terminal: Terminal, error: PlcError, asJson: boolean): void {
  terminal.error(errorText(error))
  if (asJson) terminal.out(json({ error: error.toJSON() }))
}
