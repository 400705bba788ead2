import type { Count, Field, Shape } from './field'

/**
 * Checks at load that every name a declaration refers to exists, so that a typing mistake in a declaration is found
 * by the first test that imports it and not by a customer's PLC. `asked` is the request the response refers to.
 * @throws TypeError naming the command and the field.
 */
export function checkShapes(title: string, request: Shape, response: Shape, asked: Shape = request): void {
  checkShape(`${title} request`, request, undefined)
  checkShape(`${title} response`, response, asked)
}

function checkShape(title: string, shape: Shape, request: Shape | undefined): void {
  for (const [name, field] of Object.entries(shape)) {
    for (const problem of problems(field, shape, request)) throw new TypeError(`${title}: ${name} ${problem}`)
    if (field.kind === 'list') checkShape(`${title}.${name}`, { ...field.item }, request ?? shape)
  }
}

function problems(field: Field, shape: Shape, request: Shape | undefined): string[] {
  switch (field.kind) {
    case 'count':
      return field.of in shape ? [] : [`counts ${field.of}, which is not beside it`]
    case 'echo':
      return request !== undefined && field.of in request ? [] : [`repeats ${field.of}, which the request lacks`]
    case 'each':
      return request?.[field.of]?.kind === 'list' ? [] : [`goes over ${field.of}, which is no list of the request`]
    case 'words':
    case 'doubleWords':
    case 'bits':
    case 'bytes':
    case 'text':
    case 'list':
      return countProblems(field.count, shape, request)
    default:
      return []
  }
}

function countProblems(count: Count, shape: Shape, request: Shape | undefined): string[] {
  if (typeof count === 'number' || count in shape || (request !== undefined && count in request)) return []
  return [`is counted by ${count}, which neither this message nor the request has`]
}
