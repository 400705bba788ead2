import { RequestError } from '../../errors'

/** What an entry writes, in bits or cells of one place. */
export interface WrittenSpan {
  readonly entry: number
  /** Of its item. */
  readonly text: string
  readonly from: number
  readonly to: number
}

/** Entries that write the same, each with its error. `places`: what lies in one place, by place. */
export function refuseOverlaps(places: readonly WrittenSpan[][]): Map<number, RequestError> {
  const errors = new Map<number, RequestError>()
  for (const spans of places) {
    spans.sort((a, b) => a.from - b.from)
    let furthest: WrittenSpan | undefined
    for (const span of spans) {
      if (furthest !== undefined && span.from < furthest.to) refuseBoth(errors, furthest, span)
      if (furthest === undefined || span.to > furthest.to) furthest = span
    }
  }
  return errors
}

function refuseBoth(errors: Map<number, RequestError>, a: WrittenSpan, b: WrittenSpan): void {
  const message = `${a.text} and ${b.text}: the same device is written twice in one call. Leave one of them out, or write them in two calls.`
  for (const { entry, text } of [a, b]) {
    if (!errors.has(entry)) errors.set(entry, new RequestError('BAD_VALUE', message, text))
  }
}
