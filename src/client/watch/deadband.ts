// The deadbands of a watch: as those of tags, but for the range of percent, which no table says.
import { badOption } from '../../basics/option-checks'
import { deadbandProblem, thresholdOf } from '../../tags/table/deadband'
import type { Deadband } from '../../tags/table/tag'

/** The deadband in units of the value. @throws RequestError BAD_OPTION */
export function reachOf(field: string, given: Deadband): number {
  const problem = deadbandProblem(given)
  if (problem !== undefined) badOption(field, `${field}: ${problem}`)
  if (given.kind === 'percent' && given.of === undefined) {
    badOption(`${field}.of`, `${field}.of is missing: percent of which range, e.g. [0, 250].`)
  }
  return thresholdOf({ deadband: given })
}
