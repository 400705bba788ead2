// Which requests a read plan consists of, and what refusals taught about them.
import { type EndCodeAbout, type EndCodeError, RequestError } from '../../errors'
import { about } from '../item/about'
import type { LeafOf, PlanShape } from '../plan/planned-read'
import type { RequestDescription } from '../plan/request'
import type { ParsedJwItem } from './item'
import { type JwPiece, JwSpaces, jwPiecesOf } from './layout'
import type { JwLimits } from './limits'
import { type ListProof, OF_LISTS } from './list-proof'
import { jwCapacity, jwPacked } from './read-pack'
import { describeJw, type JwReadStep, jwReadStep } from './read-request'
import type { JwProtocol } from './send-command'
import type { JwSettings } from './settings'

/** An item whose text is none. */
export interface RefusedJwItem {
  readonly text: string
  readonly error: RequestError
}

/** An item of a list, as far as it could be understood. */
export type AnyJwItem = ParsedJwItem | RefusedJwItem

/** What plans are made with. */
export interface JwPlanParts {
  readonly settings: Pick<JwSettings, 'model' | 'gap'>
  readonly protocol: JwProtocol
  readonly limits: JwLimits
  readonly lists: ListProof
}

/** What a smaller request may escape. A code nobody knows may be about a single item. */
const MAY_HELP: ReadonlySet<EndCodeAbout> = new Set(['item', 'size', 'unknown', 'request'])
/** After so many runs, items that were refused are tried once more. */
const TRY_AGAIN = 32

export class JwReadShape implements PlanShape<JwReadStep> {
  readonly errors = new Map<number, RequestError>()
  readonly #items: readonly AnyJwItem[]
  readonly #parsed: readonly (ParsedJwItem | undefined)[]
  readonly #parts: JwPlanParts
  readonly #pieces = new Map<number, number>()
  readonly #hopeless = new WeakMap<JwReadStep, { readonly endCode: number; runs: number }>()
  readonly #refusals = new Map<number, string>()
  #steps: readonly JwReadStep[]

  constructor(items: readonly AnyJwItem[], parts: JwPlanParts) {
    this.#items = items
    this.#parsed = items.map((item) => ('error' in item ? undefined : item))
    this.#parts = parts
    const spaces = new JwSpaces(parts.settings.model)
    const pieces = items.flatMap((item, index) => this.#piecesOf(spaces, item, index))
    this.#steps = this.#built(pieces, parts.settings.gap)
  }

  get steps(): readonly JwReadStep[] {
    if (!this.#parts.lists.mayBeUsed && this.#steps.some(({ draft }) => draft.kind === 'list')) {
      this.#steps = this.#steps.flatMap((step) =>
        step.draft.kind === 'list' ? this.#built(step.pieces, this.#parts.settings.gap) : [step],
      )
    }
    return this.#steps
  }

  partsOf(item: number): number {
    return this.#pieces.get(item) ?? 0
  }

  #piecesOf(spaces: JwSpaces, item: AnyJwItem, index: number): JwPiece[] {
    if ('error' in item) {
      this.errors.set(index, item.error)
      return []
    }
    try {
      if (item.place.in === 'timer' && item.type.name === 'BOOL') throw onlyWritten(item)
      const layout = spaces.layoutOf(item)
      const pieces = jwPiecesOf(layout, item, index, jwCapacity(this.#parts.limits, layout.space))
      this.#pieces.set(index, pieces.length)
      return pieces
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      this.errors.set(index, about(error, [{ item: item.text }]))
      return []
    }
  }

  #built(pieces: readonly JwPiece[], gap: number): JwReadStep[] {
    const { limits, lists, protocol } = this.#parts
    const drafts = jwPacked(pieces, { limits, gap, lists: lists.mayBeUsed })
    return drafts.map((draft) => jwReadStep(protocol, draft, this.#parsed, lists))
  }

  mayHelp(refusal: EndCodeError): boolean {
    return MAY_HELP.has(refusal.about)
  }

  /** Of a list that is refused as such its rows; else its halves without gaps. */
  divided({ pieces, draft }: JwReadStep, refusal: EndCodeError): readonly JwReadStep[] {
    if (draft.kind === 'list' && OF_LISTS.has(refusal.about)) {
      this.#parts.lists.refusedBy(refusal)
      if (!this.#parts.lists.mayBeUsed) return this.#built(pieces, this.#parts.settings.gap)
    }
    const half = Math.ceil(pieces.length / 2)
    if (half >= pieces.length) return []
    return [pieces.slice(0, half), pieces.slice(half)].flatMap((part) => this.#built(part, 0))
  }

  isHopeless(step: JwReadStep, { endCode }: EndCodeError): boolean {
    const known = this.#hopeless.get(step)
    if (known?.endCode !== endCode) return false
    known.runs++
    return known.runs % TRY_AGAIN !== 0
  }

  answered(step: JwReadStep): void {
    if (this.#refusals.size === 0) return
    this.#hopeless.delete(step)
    for (const { item } of step.pieces) this.#refusals.delete(item)
  }

  /** What could be read is merged again without gaps; what was refused stands alone. */
  learn(step: JwReadStep, refusal: EndCodeError, leaves: readonly LeafOf<JwReadStep>[]): void {
    // Another run of the same plan may have learnt it already.
    if (!this.#steps.includes(step)) return
    const read = leaves.flatMap((leaf) => (leaf.outcome === 'read' ? leaf.step.pieces : []))
    const refused = leaves.flatMap(({ step: part, outcome }) => {
      if (typeof outcome === 'string') return []
      this.#hopeless.set(part, { endCode: outcome.endCode, runs: 0 })
      for (const { item } of part.pieces) {
        this.#refusals.set(item, `${this.#text(item)} is read apart from the others. ${outcome.message}`)
      }
      return [part]
    })
    const gap = OF_LISTS.has(refusal.about) ? this.#parts.settings.gap : 0
    const steps = [...this.#built(read, gap), ...refused]
    this.#steps = this.#steps.flatMap((old) => (old === step ? steps : [old]))
  }

  describe({ prepared }: JwReadStep, items: readonly string[]): RequestDescription {
    return describeJw(prepared, items)
  }

  #text(item: number): string {
    return this.#items[item]?.text ?? ''
  }

  notes(): string[] {
    const torn = [...this.#pieces].flatMap(([item, parts]) =>
      parts < 2 ? [] : [`${this.#text(item)} is read by ${parts} requests: its values may be of different moments.`],
    )
    const bad = [...this.errors].map(([item, error]) => `${this.#text(item)} is not read. ${error.message}`)
    const { note } = this.#parts.lists
    return [...torn, ...bad, ...(note === undefined ? [] : [note]), ...this.#refusals.values()]
  }
}

function onlyWritten({ text }: ParsedJwItem): RequestError {
  const message = `${JSON.stringify(text)}: BOOL sets and resets a timer or counter and is written only: read its current value, or the relay of its contact.`
  return new RequestError('UNSUPPORTED', message, text)
}
