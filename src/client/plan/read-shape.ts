// Which requests a read plan consists of, and what refusals taught about them.
import { type EndCodeAbout, type EndCodeError, RequestError } from '../../errors'
import type { CommandName } from '../../melsec/commands/commands'
import { commands } from '../../melsec/commands/commands'
import type { AddressOptions } from '../../melsec/device/address'
import type { Notation } from '../../melsec/device/json'
import { addressOptionsOf } from '../../melsec/profiles/profile'
import { about } from '../item/about'
import type { ParsedItem, RefusedItem } from '../item/item'
import type { Stretch } from './chunk'
import type { PackOptions } from './draft'
import { Areas, type Piece, pieceOf, piecesOf, readLayout } from './layout'
import type { PlanProtocol } from './limit'
import { packed } from './pack'
import type { LeafOf, PlanShape } from './planned-read'
import {
  bodyBytes,
  checkCells,
  describePrepared,
  type PreparedRead,
  prepareRead,
  type RequestDescription,
} from './request'
import { type Place, placeOf } from './value'

/** The notation is that of descriptions; default: the profile's. */
export interface ReadShapeOptions extends Notation {
  /** Words that may be read in vain to merge near items into one request. */
  readonly gap: number
}

/** One request of the plan and where its values go. */
export interface ReadStep {
  readonly prepared: PreparedRead
  readonly pieces: readonly Piece[]
  readonly places: readonly Place[]
  /** How much was learnt: `planned` as drawn up, `merged` again after a refusal, `settled` as it was once answered. */
  readonly stage: 'planned' | 'merged' | 'settled'
  readonly without: PackOptions['without']
}

/** A part of a divided request and how it ended. */
type Leaf = LeafOf<ReadStep>

/** What a smaller request may escape. A code nobody knows may be about a single item. */
const MAY_HELP: ReadonlySet<EndCodeAbout> = new Set(['item', 'size', 'unknown'])

/** After so many runs, items that were refused together are tried one by one again: the PLC may have been changed. */
const TRY_AGAIN = 32

export class ReadShape implements PlanShape<ReadStep> {
  /** Items that cannot be asked for. */
  readonly errors = new Map<number, RequestError>()
  readonly #items: readonly (ParsedItem | RefusedItem)[]
  readonly #protocol: PlanProtocol
  readonly #areas: Areas
  readonly #gap: number
  readonly #address: AddressOptions
  readonly #parts = new Map<number, number>()
  #steps: readonly ReadStep[]
  /** Requests all of whose items were refused one by one, with this end code. */
  readonly #hopeless = new WeakMap<ReadStep, { readonly endCode: number; runs: number }>()
  readonly #refusals = new Map<number, string>()
  readonly #commandNotes = new Set<string>()

  constructor(
    items: readonly (ParsedItem | RefusedItem)[],
    protocol: PlanProtocol,
    { gap, ...notation }: ReadShapeOptions,
  ) {
    if (!Number.isInteger(gap) || gap < 0) {
      throw new RequestError('BAD_OPTION', `gap is a whole number of words from 0, not ${String(gap)}.`, 'gap')
    }
    this.#items = items
    this.#protocol = protocol
    this.#areas = new Areas(protocol, 'read')
    this.#gap = gap
    this.#address = addressOptionsOf(protocol.profile, notation)
    const pieces = items.flatMap((item, index) => this.#piecesOf(item, index))
    this.#steps = this.#built(pieces, { gap, without: new Set() }, 'planned')
  }

  get steps(): readonly ReadStep[] {
    return this.#steps
  }

  /** Pieces an item is cut into, 1 unless it is larger than one Read; 0 when it cannot be asked for. */
  partsOf(item: number): number {
    return this.#parts.get(item) ?? 0
  }

  #piecesOf(item: ParsedItem | RefusedItem, index: number): Piece[] {
    if ('error' in item) {
      this.errors.set(index, item.error)
      return []
    }
    try {
      const pieces = piecesOf(this.#areas, readLayout(this.#areas, item), item, index)
      for (const piece of pieces) checkCells(this.#protocol, alone(piece))
      this.#parts.set(index, pieces.length)
      return pieces
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      this.errors.set(index, about(error, [{ item: item.text }]))
      return []
    }
  }

  #built(pieces: readonly Piece[], options: Omit<PackOptions, 'exact'>, stage: ReadStep['stage']): ReadStep[] {
    const all: PackOptions = { ...options, exact: (piece) => this.#exact(piece) }
    const drafts = packed(this.#areas, pieces, all, (draft) => bodyBytes(this.#protocol, draft))
    return drafts.map((draft) =>
      this.#stepOf(prepareRead(this.#protocol, draft, this.#address), options.without, stage),
    )
  }

  #stepOf(prepared: PreparedRead, without: PackOptions['without'], stage: ReadStep['stage']): ReadStep {
    const pieces: Piece[] = []
    const places: Place[] = []
    for (const [run, offset] of prepared.offsets) {
      for (const piece of run.members) {
        const item = this.#items[piece.item]
        pieces.push(piece)
        if (item !== undefined && !('error' in item)) places.push(placeOf(piece, item, offset, run.from))
      }
    }
    return { prepared, pieces, places, stage, without }
  }

  /** Whether a smaller request may be answered: the end code is about a device, or about the size of the request. */
  mayHelp(refusal: EndCodeError): boolean {
    return MAY_HELP.has(refusal.about)
  }

  /**
   * Smaller requests for what a refused one asked for: without the command when the refusal is about that, else its
   * halves without gaps, else bits in bit units instead of their words. Empty when there is nothing smaller.
   */
  divided(step: ReadStep, refusal: EndCodeError): readonly ReadStep[] {
    const { pieces, without, prepared } = step
    const { command } = prepared
    if ((command === 'readRandom' || command === 'readBlock') && !this.mayHelp(refusal)) {
      const parts = this.#built(pieces, { gap: this.#gap, without: new Set([...without, command]) }, 'settled')
      if (parts.every((part) => part.prepared.command !== command)) return parts
    }
    const half = Math.ceil(pieces.length / 2)
    if (half < pieces.length) {
      const halves = [pieces.slice(0, half), pieces.slice(half)]
      return halves.flatMap((part) => this.#built(part, { gap: 0, without }, 'settled'))
    }
    const exact = pieces[0] === undefined ? undefined : this.#exact(pieces[0])
    return exact === undefined ? [] : this.#built([exact], { gap: 0, without }, 'settled')
  }

  /** The same piece with nothing beside it read: `undefined` when it is so already, or cannot be. */
  #exact({ item: index, part, first, count, layout }: Piece): Piece | undefined {
    const item = this.#items[index]
    if (layout.area.kind === 'bit' || item === undefined || 'error' in item) return undefined
    try {
      const exact = readLayout(this.#areas, item, true)
      if (exact === undefined) return undefined
      const piece = pieceOf(exact, index, part, first, count)
      return piece.to - piece.from <= this.#areas.capacity(exact.area) ? piece : undefined
    } catch (error) {
      if (error instanceof RequestError) return undefined
      throw error
    }
  }

  /** Whether all items of this request were refused one by one with this code, so that dividing it is of no use. */
  isHopeless(step: ReadStep, { endCode }: EndCodeError): boolean {
    const known = this.#hopeless.get(step)
    if (known?.endCode !== endCode) return false
    known.runs++
    return known.runs % TRY_AGAIN !== 0
  }

  /** A request was answered: what was noted against its items no longer holds. */
  answered(step: ReadStep): void {
    if (this.#refusals.size === 0) return
    this.#hopeless.delete(step)
    for (const { item } of step.pieces) this.#refusals.delete(item)
  }

  /** Puts what was learnt from a refusal in the place of the refused request. */
  learn(step: ReadStep, refusal: EndCodeError, leaves: readonly Leaf[]): void {
    // Another run of the same plan may have learnt it already.
    if (!this.#steps.includes(step)) return
    const read = leaves.flatMap((leaf) => (leaf.outcome === 'read' ? [leaf.step] : []))
    const steps = [...this.#merged(step, refusal, read), ...this.#refusedSteps(leaves)]
    this.#steps = this.#steps.flatMap((old) => (old === step ? steps : [old]))
    this.#noteCommand(step, refusal, read)
  }

  /** Requests for what could be read: merged once more, or, when that was refused too, as they were answered. */
  #merged(step: ReadStep, refusal: EndCodeError, read: readonly ReadStep[]): readonly ReadStep[] {
    if (step.stage !== 'planned' || read.length < 2) return read
    const pieces = read.flatMap((leaf) => leaf.pieces)
    const without = new Set(read.flatMap((leaf) => [...leaf.without]))
    const gap = this.mayHelp(refusal) ? 0 : this.#gap
    return this.#built(pieces, { gap, without }, 'merged')
  }

  /** What was refused one by one is asked for together again: one request for each end code, not one for each item. */
  #refusedSteps(leaves: readonly Leaf[]): ReadStep[] {
    const byCode = new Map<number, ReadStep[]>()
    for (const { step, outcome } of leaves) {
      if (typeof outcome === 'string') continue
      for (const { item } of step.pieces) {
        this.#refusals.set(item, `${this.#text(item)} is read apart from the others. ${outcome.message}`)
      }
      byCode.set(outcome.endCode, [...(byCode.get(outcome.endCode) ?? []), step])
    }
    return [...byCode].flatMap(([endCode, refused]) => {
      const pieces = refused.flatMap((step) => step.pieces)
      const without = new Set(refused.flatMap((step) => [...step.without]))
      const steps = refused.length === 1 ? refused : this.#built(pieces, { gap: 0, without }, 'settled')
      for (const step of steps) this.#hopeless.set(step, { endCode, runs: 0 })
      return steps
    })
  }

  #noteCommand({ prepared: { command } }: ReadStep, refusal: EndCodeError, read: readonly ReadStep[]): void {
    if (!read.some(({ without }) => without.has(command))) return
    this.#commandNotes.add(`${titleOf(command)} is not used, because the PLC refused it. ${refusal.message}`)
  }

  describe({ prepared }: ReadStep, items: readonly string[]): RequestDescription {
    return describePrepared(this.#protocol, prepared, items)
  }

  #text(item: number): string {
    return this.#items[item]?.text ?? ''
  }

  #requestsOf(item: number): number {
    return this.#steps.filter(({ pieces }) => pieces.some((piece) => piece.item === item)).length
  }

  notes(): string[] {
    const torn = [...this.#parts].flatMap(([item, parts]) => {
      const requests = parts < 2 ? 1 : this.#requestsOf(item)
      if (requests < 2) return []
      return [`${this.#text(item)} is read by ${requests} requests: its values may be of different moments.`]
    })
    const bad = [...this.errors].map(([item, error]) => `${this.#text(item)} is not read. ${error.message}`)
    return [...torn, ...bad, ...this.#commandNotes, ...this.#refusals.values()]
  }
}

function titleOf(command: CommandName): string {
  return commands[command].title
}

/** A piece and nothing else. */
function alone(piece: Piece): Stretch {
  return { area: piece.layout.area, from: piece.from, to: piece.to, members: [piece] }
}
