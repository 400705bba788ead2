// Messages between a Node-RED process and the test that started it, as JSON: what JSON has no word for is tagged.
// Plain CommonJS, because Node-RED loads it as it is.

/** A JSON value that says the same as `value`; errors keep their own and inherited fields, functions only their name. */
function encode(value, seen = new Set()) {
  if (value === undefined) return { $: 'undefined' }
  if (typeof value === 'bigint') return { $: 'bigint', value: String(value) }
  if (typeof value === 'number' && (!Number.isFinite(value) || Object.is(value, -0))) {
    return { $: 'number', value: Object.is(value, -0) ? '-0' : String(value) }
  }
  if (typeof value === 'function' || typeof value === 'symbol') return { $: typeof value, value: String(value.name) }
  if (typeof value !== 'object' || value === null) return value
  if (Buffer.isBuffer(value)) return { $: 'buffer', value: value.toString('hex') }
  if (value instanceof Date) return { $: 'date', value: value.getTime() }
  if (seen.has(value)) return { $: 'circular' }
  const inside = new Set(seen).add(value)
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return Array.from(value, (item) => encode(item, inside))
  const names = value instanceof Error ? errorFields(value) : Object.keys(value)
  const fields = Object.fromEntries(names.map((name) => [name, encode(value[name], inside)]))
  return '$' in fields ? { $: 'object', value: fields } : fields
}

function errorFields(error) {
  const names = new Set(['name', 'message'])
  for (let level = error; level && level !== Error.prototype; level = Object.getPrototypeOf(level)) {
    for (const name of Object.getOwnPropertyNames(level)) names.add(name)
  }
  names.delete('constructor')
  names.delete('stack')
  return [...names]
}

/** The inverse of `encode`; what cannot be carried (a function, a circle) becomes a string that says so. */
function decode(value) {
  if (typeof value !== 'object' || value === null) return value
  if (Array.isArray(value)) return value.map(decode)
  switch (value.$) {
    case 'undefined':
      return undefined
    case 'bigint':
      return BigInt(value.value)
    case 'number':
      return Number(value.value)
    case 'buffer':
      return Buffer.from(value.value, 'hex')
    case 'date':
      return new Date(value.value)
    case 'circular':
      return '[circular]'
    case 'function':
    case 'symbol':
      return `[${value.$} ${value.value}]`
    default: {
      const fields = value.$ === 'object' ? value.value : value
      return Object.fromEntries(Object.entries(fields).map(([name, item]) => [name, decode(item)]))
    }
  }
}

module.exports = { encode, decode }
