// Addresses as people type them: what every family of PLCs looks at before it reads one.
import { RequestError } from '../errors'

/** Long texts are cut in messages. */
export function shortened(text: string): string {
  return text.length <= 64 ? text : `${text.slice(0, 64)}...`
}

/**
 * The text of an address in upper case, without the spaces around it.
 * @param foreign what no address of this family has
 * @throws RequestError BAD_ADDRESS for what is no text, and for spaces, full-width and foreign characters in it
 */
export function typedAddress(text: unknown, example: string, foreign = /[^\x21-\x7e]/): string {
  if (typeof text !== 'string') {
    throw new RequestError(
      'BAD_ADDRESS',
      `An address is a text such as ${example}, not ${JSON.stringify(text) ?? typeof text}.`,
    )
  }
  if (/[\u3000\uff01-\uffee]/.test(text)) {
    const half = shortened(text.normalize('NFKC').trim())
    throw new RequestError(
      'BAD_ADDRESS',
      `${JSON.stringify(shortened(text))} has full-width characters: write ${half} in half-width ones.`,
    )
  }
  const trimmed = text.trim()
  // Before upper-casing: some letters of other scripts turn into ASCII ones by it.
  if (foreign.test(trimmed)) {
    throw new RequestError(
      'BAD_ADDRESS',
      `${JSON.stringify(shortened(text))} has a space or a letter that is not of an address.`,
    )
  }
  return trimmed.toUpperCase()
}
