import { RequestError } from '../../../src/errors'
import type { ParameterProblem } from '../../../src/jw/parameters/parameter-map'

/** What a call is refused with; fails when it is not, or with another code. */
export function refusal(run: () => unknown): { readonly field: string | undefined; readonly message: string } {
  try {
    run()
  } catch (error) {
    if (error instanceof RequestError && error.code === 'BAD_VALUE')
      return { field: error.field, message: error.message }
    throw error
  }
  throw new Error('It was not refused')
}

export function messagesOf(problems: readonly ParameterProblem[]): string[] {
  return problems.map(({ severity, setting, message }) => `${severity} ${setting}: ${message}`)
}
