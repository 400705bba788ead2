/** How a message shows a value: short, and so that a text is not taken for a number. */
export function show(value: unknown): string {
  if (typeof value === 'string') return value.length > 40 ? `'${value.slice(0, 40)}…'` : `'${value}'`
  if (typeof value === 'bigint') return `${value}n`
  if (typeof value === 'number' || typeof value === 'boolean' || value === null || value === undefined)
    return Object.is(value, -0) ? '-0' : String(value)
  if (Array.isArray(value)) return `an array of ${value.length}`
  return `a value of type ${typeof value}`
}

/** As `show`, where a text can be nothing else: without quotes. */
export function shown(value: unknown): string {
  return typeof value === 'string' ? value.slice(0, 40) : show(value)
}
