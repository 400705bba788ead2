// What the command line ends with: for scripts, and printed in the help.
import {
  ClosedError,
  ConnectionError,
  EndCodeError,
  type PlanDescription,
  PlcError,
  ProtocolError,
  RequestError,
  TimeoutError,
  UnfinishedError,
  VerifyError,
  WriteError,
} from '../index'

/** Exit codes with their meaning. */
export const exitCodes = {
  ok: { code: 0, meaning: 'done' },
  bug: { code: 1, meaning: 'unexpected failure: please report it' },
  usage: { code: 2, meaning: 'wrong use or bad request; nothing was sent' },
  refused: { code: 3, meaning: 'the PLC answered with an end code' },
  unreachable: { code: 4, meaning: 'no connection, or no answer in time' },
  protocol: { code: 5, meaning: 'what was received breaks the protocol; of decode: the frame is wrong' },
  partly: { code: 6, meaning: 'some items failed, others did not; or a file was begun and not finished' },
  notVerified: { code: 7, meaning: 'carried out, but the CPU is not in the state it was to be in, or does not tell' },
} as const

/** The exit code of an error that ended a command. */
export function exitOf(error: PlcError): number {
  // Given up because of another one: that one counts.
  if (error instanceof ClosedError && error.cause instanceof PlcError) return exitOf(error.cause)
  if (error instanceof RequestError) return exitCodes.usage.code
  if (error instanceof EndCodeError) return exitCodes.refused.code
  if (error instanceof UnfinishedError || error instanceof WriteError) return exitCodes.partly.code
  if (error instanceof VerifyError) return exitCodes.notVerified.code
  if (error instanceof ProtocolError) return exitCodes.protocol.code
  if (error instanceof ConnectionError || error instanceof TimeoutError || error instanceof ClosedError) {
    return exitCodes.unreachable.code
  }
  return exitCodes.bug.code
}

/** The exit code of results that each are good or bad. */
export function exitOfResults(
  results: readonly ({ readonly ok: true } | { readonly ok: false; readonly error: PlcError })[],
): number {
  const errors = results.flatMap((result) => (result.ok ? [] : [result.error]))
  const [first] = errors
  if (first === undefined) return exitCodes.ok.code
  return errors.length < results.length ? exitCodes.partly.code : exitOf(first)
}

/** The exit code of a plan that is only shown: nothing is sent, and an item of no request would not be either. */
export function exitOfPlan({ requests }: PlanDescription, items: readonly string[]): number {
  const planned = new Set(requests.flatMap((request) => request.items))
  return items.every((item) => planned.has(item)) ? exitCodes.ok.code : exitCodes.usage.code
}

/** For the help. */
export function exitCodeHelp(): string {
  return `\nExit codes:\n${Object.values(exitCodes)
    .map(({ code, meaning }) => `  ${code}  ${meaning}`)
    .join('\n')}`
}
