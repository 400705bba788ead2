// Serial interface unit JW-22SU (JW300 option unit manual, "JW-22SU"): what it has new in a JW300. Its other parameters are in its own manual.
import { shown } from '../../basics/show'
import { checkBlocks, type ParameterBlock, parameterText } from './parameter-area'
import type { ParameterProblem } from './parameter-map'

/** Upper address of the control relays: reserved, 0. */
const CONTROL_RELAY_UPPER = 0o0042

/**
 * What the manual refuses of the parameters of a JW-22SU, as far as it prints them: 0042 must be 0.
 * @throws RequestError BAD_VALUE for blocks that are none
 */
export function serialInterfaceProblems(blocks: readonly ParameterBlock[]): readonly ParameterProblem[] {
  checkBlocks(blocks)
  return blocks.flatMap(({ address, bytes }) => {
    const byte = bytes[CONTROL_RELAY_UPPER - address]
    if (byte === undefined || byte === 0) return []
    const at = parameterText(CONTROL_RELAY_UPPER)
    const message = `Parameter ${at} is ${shown(byte)}, must be 0 (error 3CH): control relays cannot be in file registers.`
    return [{ severity: 'error', setting: at, message } as const]
  })
}
