// Operands as users type them: read, and looked up in the map, with what they may have meant when they are none.
import { RequestError } from '../../errors'
import { hintFor, otherSpelling } from './hint'
import type { JwOperandOptions } from './map'
import { formatJwOperand, type JwOperand, readOperand } from './notation'
import { placeOfJw } from './place'

/**
 * @param text e.g. `004033`, `KO0403`, `09012`, `b0012`, `TMR0012`, `#0201`, `F1:00001234.3`
 * @throws RequestError BAD_ADDRESS when it is no operand, OUT_OF_RANGE when a number in it cannot be or no source says where it
 *   lies; the message says what was understood and what to write. BAD_OPTION for areas that are none.
 * @example parseJwOperand('004033') // { kind: 'relay', number: 0o4033 }
 */
export function parseJwOperand(text: string, options: JwOperandOptions = {}): JwOperand {
  try {
    return placedOperand(text, options)
  } catch (error) {
    if (!(error instanceof RequestError) || typeof text !== 'string') throw error
    const meant = meantBy(text, options)
    if (meant === undefined) throw error
    throw new RequestError(error.code, `${JSON.stringify(text.trim())}: ${meant}`)
  }
}

function placedOperand(text: string, options: JwOperandOptions): JwOperand {
  const operand = readOperand(text, hintFor)
  placeOfJw(operand, options)
  return operand
}

/** The operand in our spelling, when it has another one. */
function meantBy(text: string, options: JwOperandOptions): string | undefined {
  const { because, readings = [] } = otherSpelling(text.trim().toUpperCase()) ?? {}
  const meant = readings.flatMap((reading) => {
    try {
      return [formatJwOperand(placedOperand(reading, options))]
    } catch (error) {
      if (error instanceof RequestError) return []
      throw error
    }
  })
  const others = meant.filter((reading) => reading !== text.trim())
  return others.length === 0 ? undefined : `${because}: write ${others.join(' or ')}.`
}
