import { badMessage, declare, field, type ValueCodec } from '../../codec/codec'

const { value } = field

/** Bytes of data at most: 960 words. */
const MOST = 1920

/**
 * The data of On-demand: all that the frame still holds, low byte of each word first. Nothing counts them.
 *
 * The manual shows none of the data in ASCII code. Assumed are four digits per word, high digit first, as every other
 * word of the command set has them; so an odd number of bytes can be sent in binary code only.
 */
export const onDemandData: ValueCodec<Uint8Array> = {
  name: 'on-demand data',
  variable: true,
  write(writer, given) {
    if (!(given instanceof Uint8Array) && !Array.isArray(given)) badMessage('must be bytes')
    if (given.length > MOST) badMessage(`has ${given.length} bytes, must have at most ${MOST} (${MOST / 2} words)`)
    const wrong = Array.from<number>(given).find((byte) => !isByte(byte))
    if (wrong !== undefined) badMessage(`has ${String(wrong)}, must have bytes from 0 to 255`)
    if (!writer.ascii) writer.bytes(given)
    else
      writer.words(
        wordsOfBytes(given) ?? badMessage(`has ${given.length} bytes; ASCII code carries whole words: add one`),
      )
  },
  read(reader) {
    const bytes = reader.ascii ? reader.remaining / 2 : reader.remaining
    if (bytes > MOST) reader.fail('BAD_FIELD', `${bytes} bytes of data, at most ${MOST} can be`)
    if (!reader.ascii) return Buffer.from(reader.bytes(bytes))
    if (bytes % 2 !== 0) reader.fail('TRUNCATED', `${reader.remaining} digits of data are no whole words of four`)
    return bytesOfWords(reader.words(bytes / 2))
  },
  size: (ascii, _form, given) => (ascii ? 2 : 1) * (given?.length ?? 0),
}

function isByte(given: number): boolean {
  return Number.isInteger(given) && given >= 0 && given <= 0xff
}

/** Two bytes as one word, low byte first; `undefined` when they are no whole words. */
export function wordsOfBytes(bytes: ArrayLike<number>): number[] | undefined {
  if (bytes.length % 2 !== 0) return undefined
  return Array.from({ length: bytes.length / 2 }, (_, i) => (bytes[2 * i] ?? 0) | ((bytes[2 * i + 1] ?? 0) << 8))
}

/** Each word as two bytes, low byte first. */
export function bytesOfWords(words: readonly number[]): Buffer {
  const bytes = Buffer.alloc(2 * words.length)
  for (const [i, word] of words.entries()) bytes.writeUInt16LE(word, 2 * i)
  return bytes
}

/**
 * What a PLC sends of its own accord, in the form of a request. Nobody answers it. It is no request of a client, so it is
 * not in `commands`, which lists what can be asked.
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export const unsolicitedCommands = declare({
  onDemand: {
    title: 'On-demand',
    code: 0x2101,
    unit: 'none',
    effect: 'read',
    manual: 'SLMP reference manual 5.11',
    sender: 'plc',
    answered: 'no',
    request: { data: value(onDemandData, 'to the end of the frame') },
    response: {},
  },
})
