import type { Count, CountField, EachField, Field, IntegerField, RestField, Shape } from './field'
import { boundsOf, isVisible, WIDTH } from './field'

/**
 * Checks at load that every name a declaration refers to exists and says what it must, so that a typing mistake in a
 * declaration is found by the first test that imports it and not by a customer's PLC.
 * `asked` is the request the response refers to.
 * @throws TypeError naming the command and the field.
 */
export function checkShapes(title: string, request: Shape, response: Shape, asked: Shape = request): void {
  checkShape(`${title} request`, request, undefined)
  checkShape(`${title} response`, response, asked)
}

function checkShape(title: string, shape: Shape, request: Shape | undefined): void {
  for (const [name, field] of Object.entries(shape)) {
    const problem = problemOf(name, field, shape, request)
    if (problem !== undefined) throw new TypeError(`${title}: ${name} ${problem}`)
    if (field.kind === 'list') checkShape(`${title}.${name}`, field.item, request)
  }
}

function problemOf(name: string, field: Field, shape: Shape, request: Shape | undefined): string | undefined {
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      return integerProblem(field)
    case 'fixed':
      return field.value >= 0 && field.value <= last(field.width) ? undefined : 'is fixed to what its width cannot hold'
    case 'spare':
      return Number.isInteger(field.size) && field.size > 0 ? undefined : 'has no size'
    case 'count':
      return boundsProblem(field, field.width) ?? derivedProblem(name, field, shape) ?? mostProblem(field, request)
    case 'echo':
      return echoProblem(fieldIn(request, field.of), field.of)
    case 'rest':
      return restProblem(name, field, shape)
    case 'each':
      return eachProblem(field, fieldIn(request, field.of))
    case 'repeat':
      return repeatProblem(field.of, field.item, fieldIn(request, field.of))
    case 'words':
    case 'doubleWords':
    case 'bits':
    case 'bytes':
    case 'text':
    case 'list':
      return countProblem(name, field.count, shape, request)
    case 'value':
      return undefined
    default:
      return field satisfies never
  }
}

function fieldIn(shape: Shape | undefined, name: string): Field | undefined {
  return shape !== undefined && Object.hasOwn(shape, name) ? shape[name] : undefined
}

function last(width: number): number {
  return 2 ** (8 * width) - 1
}

function integerProblem(field: IntegerField): string | undefined {
  const problem = boundsProblem(field, WIDTH[field.kind])
  if (problem !== undefined) return problem
  const { oneOf, multipleOf = 1 } = field
  const [min, max] = boundsOf(field)
  const allowed = (number: number) =>
    number >= min && number <= max && number % multipleOf === 0 && oneOf?.includes(number) !== false
  if (oneOf?.every(allowed) === false) return 'has numbers in oneOf that its range excludes'
  if (field.bcd === true && max >= 10 ** (2 * WIDTH[field.kind]))
    return `goes up to ${max}, which its digits cannot say`
  if (field.default !== undefined && !allowed(field.default))
    return `has the default ${field.default}, which it refuses`
  return undefined
}

/** `zeroMeans` stands for one number only: 0 itself must not be possible, and nothing else may be too wide. */
function boundsProblem(field: IntegerField | CountField, width: number): string | undefined {
  const { min = 0, max, zeroMeans } = field
  const highest = max ?? last(width)
  if (min < 0 || min > highest) return `has the range ${min} to ${highest}`
  const uneven = multipleProblem(field, highest)
  if (uneven !== undefined) return uneven
  if (zeroMeans !== undefined && (min === 0 || zeroMeans < min || zeroMeans > highest)) {
    return `writes ${zeroMeans} as 0, which is possible itself or the other is not`
  }
  const widest = zeroMeans === highest ? highest - 1 : highest
  return widest > last(width) ? `goes up to ${highest}, which its width cannot hold` : undefined
}

/** Bounds that are no multiples themselves would say what cannot be. */
function multipleProblem({ min = 0, max, zeroMeans, multipleOf }: IntegerField | CountField, highest: number) {
  if (multipleOf === undefined) return undefined
  if (!Number.isInteger(multipleOf) || multipleOf < 2 || multipleOf > highest) return `is a multiple of ${multipleOf}`
  const odd = [min, max, zeroMeans].find((bound) => bound !== undefined && bound % multipleOf !== 0)
  return odd === undefined ? undefined : `has the bound ${odd}, which is no multiple of ${multipleOf}`
}

/** A derived count and what it counts must name each other; that the count comes first is seen at what it counts. */
function derivedProblem(name: string, { of }: CountField, shape: Shape): string | undefined {
  const counted = fieldIn(shape, of)
  if (counted === undefined) return `counts ${of}, which is not beside it`
  return 'count' in counted && counted.count === name ? undefined : `counts ${of}, which is not counted by it`
}

function mostProblem({ atMost }: CountField, request: Shape | undefined): string | undefined {
  if (atMost === undefined) return undefined
  const most = fieldIn(request, atMost)
  return most !== undefined && most.kind in WIDTH
    ? undefined
    : `is at most ${atMost}, which is no number of the request`
}

function echoProblem(repeated: Field | undefined, of: string): string | undefined {
  if (repeated === undefined) return `repeats ${of}, which the request lacks`
  return isNumber(repeated) || repeated.kind === 'value' || repeated.kind === 'rest'
    ? undefined
    : `repeats ${of}, which is no single value`
}

/** It ends where the message ends, so nothing can stand behind it. */
function restProblem(name: string, { min, max }: RestField, shape: Shape): string | undefined {
  if (min < 0 || min > max) return `has the range ${min} to ${max}`
  return Object.keys(shape).at(-1) === name ? undefined : 'takes the rest, and is not the last field'
}

function repeatProblem(of: string, item: Shape, list: Field | undefined): string | undefined {
  if (list?.kind !== 'list') return `goes over ${of}, which is no list of the request`
  for (const [name, field] of Object.entries(item)) {
    if (isVisible(field)) return `repeats an element of ${of}, and ${name} is its own`
    const problem = problemOf(name, field, item, list.item)
    if (problem !== undefined) return `has ${name}, which ${problem}`
  }
  return undefined
}

function eachProblem({ of, item, front = {} }: EachField, list: Field | undefined): string | undefined {
  const repeated = repeatProblem(of, front, list)
  if (repeated !== undefined || list?.kind !== 'list') return repeated
  if (!('count' in item)) return integerProblem(item)
  const { count } = item
  if (typeof count === 'number' || isCountable(fieldIn(list.item, count))) return undefined
  return `is counted by ${count}, which an element of ${of} lacks`
}

function countProblem(name: string, count: Count, shape: Shape, request: Shape | undefined): string | undefined {
  if (typeof count === 'number') return undefined
  const beside = count === name ? undefined : fieldIn(shape, count)
  // What is repeated of the request is not in the message: the request's own is meant.
  const here = beside?.kind === 'echo' ? undefined : beside
  if (here === undefined) {
    if (isCountable(fieldIn(request, count))) return undefined
    return `is counted by ${count}, which neither this message nor the request has`
  }
  if (!isCountable(here)) return `is counted by ${count}, which is no number`
  return isBefore(shape, count, name) ? undefined : `is counted by ${count}, which stands behind it`
}

function isBefore(shape: Shape, first: string, second: string): boolean {
  const names = Object.keys(shape)
  return names.indexOf(first) < names.indexOf(second)
}

function isNumber(field: Field): boolean {
  return field.kind in WIDTH || field.kind === 'count'
}

/** A number, or something whose length is one. */
function isCountable(field: Field | undefined): boolean {
  return field !== undefined && (isNumber(field) || 'count' in field || field.kind === 'rest')
}
