import { controlCodes, type SerialFormat } from '../melsec/frame/serial-frames'

const { ACK, NAK } = controlCodes
const CR_LF = 2

/** Where the last character of an answer's sum check code is; `undefined`: it has none. */
export function sumAt(
  answer: Buffer,
  {
    format,
    sumCheck,
    sumOfAck,
  }: { readonly format: SerialFormat; readonly sumCheck: boolean; readonly sumOfAck: boolean },
): number | undefined {
  const [start] = answer
  if (!sumCheck || ((start === ACK || start === NAK) && !sumOfAck)) return undefined
  return answer.length - 1 - (format === 4 ? CR_LF : 0)
}

/** The answer with another digit in its sum check code. */
export function withWrongSum(answer: Buffer, at: number): Buffer {
  const wrong = Buffer.from(answer)
  const digit = Number.parseInt(String.fromCharCode(answer[at] ?? 0), 16)
  wrong.write(((digit + 1) % 16).toString(16).toUpperCase(), at, 'latin1')
  return wrong
}
