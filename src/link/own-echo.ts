// The own request that a line gives back (converters with two wires) in front of the answer. It is counted away, also when
// the line has damaged it: a damaged one may look like an answer (ENQ and NAK differ in one bit).
//
// Whether a line does so is known from its first request on, whose echo or answer is looked at as a whole: until as many
// bytes have come as were sent, or nothing comes any more. So only the first answer on a line is a little late.

/** `auto`: the first request shows it. `always`: what comes first is the echo. `never`: nothing is taken for one. */
export type Echoing = 'auto' | 'always' | 'never'

/** Bytes at the front that are the echo; `part`: more must come to tell; `unlike`: there must be one, and this is none. */
export type EchoFound = number | 'part' | 'unlike'

/** Bytes of an echo that may be others than those sent. */
const MOST_DAMAGED = 3
/** The least share of the bytes that must be those sent. */
const LEAST_ALIKE = 3 / 4

const EMPTY = Buffer.alloc(0)

export class OwnEcho {
  readonly #mode: Echoing
  /** `undefined`: not known yet. */
  #isThere: boolean | undefined
  /** What was sent and may come back. */
  #expected: Buffer = EMPTY

  constructor(mode: Echoing) {
    this.#mode = mode
    this.#isThere = mode === 'auto' ? undefined : mode === 'always'
  }

  sent(bytes: Buffer): void {
    if (this.#mode !== 'never') this.#expected = bytes
  }

  /** Nothing of it comes any more. */
  forget(): void {
    this.#expected = EMPTY
  }

  /** @param isAll nothing more comes for now */
  find(bytes: Buffer, isAll: boolean): EchoFound {
    const expected = this.#expected
    if (expected.length === 0 || bytes.length === 0) return 0
    const same = sameAtFront(expected, bytes)
    if (same === expected.length) return this.#found(same)
    if (same === bytes.length) return isAll ? this.#cutOff(same) : 'part'
    if (this.#isThere === false) return this.#none()
    if (!isAll && bytes.length < expected.length) return 'part'
    const length = damagedEcho(expected, bytes, same)
    if (length > 0) return this.#found(length)
    return this.#isThere === true ? this.#unlike() : this.#none()
  }

  #found(length: number): number {
    this.forget()
    this.#isThere = true
    return length
  }

  /** What comes of it later is noise. */
  #cutOff(length: number): number {
    this.forget()
    return length
  }

  #none(): number {
    this.forget()
    this.#isThere = false
    return 0
  }

  #unlike(): 'unlike' {
    this.forget()
    // Somebody may have switched it off.
    if (this.#mode === 'auto') this.#isThere = undefined
    return 'unlike'
  }
}

/** How many bytes at the front are the same. */
function sameAtFront(a: Buffer, b: Buffer): number {
  const most = Math.min(a.length, b.length)
  let same = 0
  while (same < most && a[same] === b[same]) same++
  return same
}

/**
 * Length of an echo of which a byte was lost, changed or came twice; 0 when it is too unlike. Bytes of it that are left over
 * are noise in front of the answer.
 * @param same how many bytes at the front are the same
 */
function damagedEcho(sent: Buffer, bytes: Buffer, same: number): number {
  let best = { length: 0, alike: 0 }
  // The fewest bytes first: with as many alike, a byte too few is noise, one too many would be the answer's.
  for (const length of [sent.length - 1, sent.length, sent.length + 1]) {
    const alike = same + alikeFrom(sent, bytes, same, length - sent.length)
    if (length <= bytes.length + 1 && alike > best.alike) best = { length: Math.min(length, bytes.length), alike }
  }
  const isAlike = best.alike >= sent.length - MOST_DAMAGED && best.alike >= sent.length * LEAST_ALIKE
  return isAlike ? best.length : 0
}

/** How many bytes from there on are those sent, if so many more have come than were sent. */
function alikeFrom(sent: Buffer, bytes: Buffer, from: number, more: number): number {
  let alike = 0
  for (let at = from; at < sent.length && at + more < bytes.length; at++) if (sent[at] === bytes[at + more]) alike += 1
  return alike
}
