// Arrays of labels: cut into pieces whose answers are not longer than requests may be, and put together again.
import { PlcError, ProtocolError, RequestError } from '../../errors'
import { labelDataType } from '../../melsec/label/label'
import type { PlcValue } from '../../value/value'
import type { AskedLabel, LabelFormat } from './item'
import type { ArrayRead, LabelAnswerArea, LabelRequests } from './request'
import { decodeLabelArray, extentOf, type LabelType } from './value'

/** The manual bounds what is sent, not what is answered; an answer is kept as short. In ASCII code half of it. */
const ANSWER_BYTES = 1920

interface Piece extends ArrayRead {
  readonly asked: AskedLabel
  readonly type: LabelType
  readonly count: number
}

export interface ArrayValue {
  readonly value: PlcValue[]
  readonly type: string
  readonly torn?: true
}

export class ArrayParts {
  readonly #requests: LabelRequests
  readonly #pieces: Piece[] = []

  constructor(requests: LabelRequests) {
    this.#requests = requests
  }

  get #most(): number {
    return this.#requests.protocol.code === 'ascii' ? ANSWER_BYTES / 2 : ANSWER_BYTES
  }

  /** @throws RequestError LIMIT_EXCEEDED when the array is too long and has more than one dimension */
  add(asked: AskedLabel, type: LabelType): void {
    const { address, count = 1 } = asked
    const elements = type.isBit ? this.#most * 8 : Math.max(1, Math.floor(this.#most / (2 * type.size)))
    const [first = 0] = address.index ?? []
    if (count > elements && address.index?.length !== 1) {
      const message = `${address.name}: at most ${elements} elements at a time; read an array of several dimensions in parts.`
      throw new RequestError('LIMIT_EXCEEDED', message, 'count')
    }
    for (let from = 0; from < count; from += elements) {
      const part = Math.min(elements, count - from)
      const name = from === 0 ? address.name : `${address.stem}[${first + from}]`
      this.#pieces.push({ asked, type, count: part, name, extent: extentOf(type, part) })
    }
  }

  /** The requests that read all pieces, as names and elements. */
  get requests(): readonly (readonly ArrayRead[])[] {
    return this.#requests.arrayRequests(this.#pieces, this.#most)
  }

  /** Reads all pieces. */
  async read(format: LabelFormat): Promise<Map<AskedLabel, ArrayValue | PlcError>> {
    const answers = await this.#requests.arrays(this.#pieces, this.#most)
    const values = new Map<AskedLabel, ArrayValue | PlcError>()
    for (const piece of this.#pieces) {
      const before = values.get(piece.asked)
      if (before instanceof PlcError) continue
      const read = this.#valueOf(piece, answers.get(piece), { ...format, ...piece.asked.format })
      if (read instanceof PlcError) values.set(piece.asked, read)
      else if (before === undefined) values.set(piece.asked, { value: read, type: piece.type.text })
      else values.set(piece.asked, { ...before, value: [...before.value, ...read], torn: true })
    }
    return values
  }

  #valueOf(
    { type, count, name }: Piece,
    answer: LabelAnswerArea | PlcError | undefined,
    format: LabelFormat,
  ): PlcValue[] | PlcError {
    if (answer === undefined || answer instanceof PlcError) {
      return answer ?? new ProtocolError('TRUNCATED', `${name}: the PLC did not answer it.`)
    }
    if (labelDataType(answer.typeId)?.id !== type.typeId) {
      return new ProtocolError('BAD_FIELD', `${name}: its data type changed while it was read.`)
    }
    try {
      return decodeLabelArray(type, answer.area, count, this.#requests.protocol.code, format)
    } catch (error) {
      if (error instanceof PlcError) return error
      throw error
    }
  }
}
