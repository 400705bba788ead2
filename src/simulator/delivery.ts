// Answers of a simulated PLC on their way to the wire, through the fault switches.
import type { CommandName } from '../melsec/commands/commands'
import { type Damage, damaged, noiseOf } from './damage'
import type { FaultSubject, Faults } from './faults'
import type { Step } from './sequence'

/** Where the switches are looked up. */
export type FaultSource<Name extends string = CommandName> = Pick<Faults<Name>, 'none' | 'take' | 'peek'>

/** Answers that the fault `late` holds back. Over UDP one box for the port: the next request may come from another. */
export type HeldAnswers = { readonly until: 'request' | 'answer'; readonly send: () => void }[]

/** A request whose answer is delivered. */
export interface Delivered<Name extends string = CommandName> extends FaultSubject<Name> {
  /** Its answer is on the wire: too late to take it back. */
  sending: boolean
}

export interface DeliveryParts<Name extends string> {
  readonly faults: FaultSource<Name>
  readonly held: HeldAnswers
  /** Bytes in front of or behind an answer come in one piece with it. */
  readonly joined: boolean
  readonly send: (bytes: Buffer) => void
  /** Ends the connection of the request. */
  readonly end: (how: 'close' | 'reset', work: Delivered<Name>) => void
  /** An answer begins to go out in pieces, or has gone. */
  readonly inPieces?: (going: boolean) => void
  /** Bytes of noise, some time from now. */
  readonly noise: (bytes: Buffer, ms: number) => void
}

export const NOTHING: readonly Step[] = []
/** ms for bytes to arrive before a reset, which would lose them. */
const ARRIVAL = 5

export class Delivery<Name extends string = CommandName> {
  readonly #parts: DeliveryParts<Name>
  #merging: Buffer[] = []

  constructor(parts: DeliveryParts<Name>) {
    this.#parts = parts
  }

  /** Another request has come: what was held back for it goes out now; what is returned follows its answer. */
  letGo(): readonly Step[] {
    const late = this.#parts.held.splice(0)
    for (const { until, send } of late) if (until === 'request') send()
    return late.filter(({ until }) => until === 'answer').map(({ send }) => acting(send))
  }

  deliver(whole: Buffer, work: Delivered<Name>): readonly Step[] {
    const { faults, held, send: out } = this.#parts
    if (faults.none && this.#merging.length === 0) {
      out(whole)
      return NOTHING
    }
    if (faults.take('drop', work) !== undefined) return NOTHING
    this.#makeNoise(work)
    const answer = this.#damaged(whole, work)
    const pieces = this.#withGarbage(this.#copies(answer, work), work)
    const late = faults.take('late', work)
    if (late !== undefined) {
      const send = () => {
        for (const piece of pieces) this.#send(piece)
      }
      held.push({ until: late.until, send })
      return NOTHING
    }
    const merged = this.#merge(pieces, work)
    const delay = faults.take('delay', work)
    const sending = { act: () => this.#sending(merged, work) }
    return merged.length === 0 ? NOTHING : [{ wait: delay?.ms ?? 0 }, sending]
  }

  #makeNoise(work: Delivered<Name>): void {
    const noise = this.#parts.faults.take('noise', work)
    if (noise !== undefined) this.#parts.noise(noiseOf(noise), noise.ms)
  }

  #damaged(answer: Buffer, work: Delivered<Name>): Buffer {
    const damage: Damage | undefined = this.#parts.faults.take('damaged', work)
    return damage === undefined ? answer : damaged(answer, damage)
  }

  #copies(answer: Buffer, work: Delivered<Name>): Buffer[] {
    const duplicate = this.#parts.faults.take('duplicate', work)
    return new Array<Buffer>(1 + (duplicate?.copies ?? 0)).fill(answer)
  }

  #withGarbage(pieces: Buffer[], work: Delivered<Name>): Buffer[] {
    const garbage = this.#parts.faults.take('garbage', work)
    if (garbage === undefined) return pieces
    // Never the subheader of an answer in either code, nor the start code of a serial frame.
    const bytes = Buffer.alloc(garbage.bytes, Buffer.from([0xff, 0x00, 0xa5, 0x5a]))
    if (garbage.place === 'instead') return [bytes]
    const all = garbage.place === 'before' ? [bytes, ...pieces] : [...pieces, bytes]
    return this.#parts.joined ? [Buffer.concat(all)] : all
  }

  /** Holds a single answer until there is another one to merge it with. */
  #merge(pieces: readonly Buffer[], work: Delivered<Name>): readonly Buffer[] {
    const merge = this.#parts.faults.take('merge', work) !== undefined
    if (!merge && this.#merging.length === 0) return pieces
    const all = [...this.#merging, ...pieces]
    this.#merging = merge && all.length < 2 ? all : []
    return this.#merging.length > 0 ? [] : [Buffer.concat(all)]
  }

  #sending(pieces: readonly Buffer[], work: Delivered<Name>): readonly Step[] {
    work.sending = true
    this.#parts.inPieces?.(true)
    return [...this.#piecesOf(pieces, work), acting(() => this.#parts.inPieces?.(false))]
  }

  #piecesOf(pieces: readonly Buffer[], work: Delivered<Name>): readonly Step[] {
    const { faults } = this.#parts
    const [first = Buffer.alloc(0), ...rest] = pieces
    const end = faults.take('disconnect', work)
    if (end !== undefined)
      return [this.#step(first.subarray(0, end.at)), { wait: ARRIVAL }, this.#ending(end.how, work)]
    const cut = faults.take('cut', work)
    if (cut !== undefined) return [this.#step(first.subarray(0, cut.at))]
    const split = faults.take('split', work)
    if (split !== undefined) {
      const halves = [first.subarray(0, split.at), first.subarray(split.at)]
      return this.#spaced([...halves, ...rest], split.pause)
    }
    const dribble = faults.take('dribble', work)
    if (dribble !== undefined)
      return this.#spaced(
        pieces.flatMap((piece) => drops(piece, dribble.size)),
        dribble.pause,
      )
    return pieces.map((piece) => this.#step(piece))
  }

  #spaced(pieces: readonly Buffer[], pause: number): readonly Step[] {
    return pieces.flatMap((piece, i) => [...(i === 0 ? [] : [{ wait: pause }]), this.#step(piece)])
  }

  #step(bytes: Buffer): Step {
    return acting(() => this.#send(bytes))
  }

  #ending(how: 'close' | 'reset', work: Delivered<Name>): Step {
    return acting(() => this.#parts.end(how, work))
  }

  #send(bytes: Buffer): void {
    if (bytes.length > 0) this.#parts.send(bytes)
  }
}

function acting(act: () => void): Step {
  return {
    act() {
      act()
      return NOTHING
    },
  }
}

function drops(piece: Buffer, size: number): Buffer[] {
  return Array.from({ length: Math.ceil(piece.length / size) }, (_, i) => piece.subarray(i * size, (i + 1) * size))
}
