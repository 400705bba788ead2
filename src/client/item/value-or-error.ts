// What may fail with a PlcError, as a value: for lists in which one bad entry must not spoil the others.
import { PlcError, RequestError } from '../../errors'
import { about } from './about'

/** The value, or the error that it turned out to be. */
export function attempt<T>(run: () => T): T | PlcError {
  try {
    return run()
  } catch (error) {
    if (error instanceof PlcError) return error
    throw error
  }
}

export function isFine<T>(outcome: T | PlcError): outcome is T {
  return !(outcome instanceof PlcError)
}

/** As `attempt`; a bad value or option says what it is about. */
export function attemptFor<T>(name: string, run: () => T): T | PlcError {
  const outcome = attempt(run)
  return outcome instanceof RequestError ? about(outcome, [{ item: name }]) : outcome
}
