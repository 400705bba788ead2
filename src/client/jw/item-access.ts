// Typed items of one client: what becomes of a plan.
import { hex } from '../../basics/hex'
import { octal } from '../../basics/octal'
import type { OptionNames } from '../../basics/option-checks'
import { checkBooleans, checkNames } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import type { JwPlace } from '../../jw/operand/place'
import type { Exchange } from '../../link/link'
import { formatByteType } from '../../value/byte-type'
import type { CallOptions } from '../connection/call'
import { callOptionsOf } from '../connection/call'
import { isItem, listOf } from '../item/input-checks'
import type { WriteEntry } from '../item/item-value'
import type { Item } from '../item/parts'
import { asPlainValue } from '../item/plain-values'
import { checkAllWritten } from '../item/write-outcome'
import type { ItemSource } from '../plan/item-calls'
import { PlannedRead } from '../plan/planned-read'
import type { ReadPlan, WritePlan } from '../plan/plans'
import { PreparedPlans } from '../plan/prepared-plans'
import { rejecting } from '../plan/rejecting'
import type { WriteCallOptions, WriteOptions, WriteResult } from '../plan/write'
import type { OpenCall } from '../plan/write-turns'
import { formatJwItem, parseJwItem } from './item'
import { type JwCells, type JwReadStep, type JwValuePlace, jwValueAt } from './read-request'
import { type AnyJwItem, type JwPlanParts, JwReadShape } from './read-shape'
import type { JwSettings } from './settings'
import { JwWrite } from './write'

const WRITE_OPTIONS: OptionNames<WriteOptions> = { readModifyWrite: true, allOrNothing: true }

/** What the client lends to its items. */
export interface JwItemParts extends JwPlanParts {
  readonly settings: JwSettings
  /** One call: all its requests share one deadline. @throws RequestError BAD_OPTION */
  readonly call: (options: CallOptions | undefined) => OpenCall
  /** @throws RequestError NOT_PERMITTED */
  readonly permit: (effect: Exchange<unknown>['effect'], title: string) => void
}

/** What reading an item will touch, for people and editors. */
export interface JwItemExplanation {
  /** The item in the notation of JW, e.g. `09012:INT[4]`. */
  readonly text: string
  /** Of its values, e.g. `INT`. */
  readonly type: string
  /** Values of an array; missing: one value. */
  readonly count?: number
  /** Where it lies: a byte of a file or of the system memory, or the number of a timer. */
  readonly place: string
}

export class JwItemAccess implements ItemSource {
  readonly #parts: JwItemParts
  readonly #prepared = new PreparedPlans((items) => this.plan(items))

  constructor(parts: JwItemParts) {
    this.#parts = parts
  }

  prepare(items: readonly Item[]): Pick<ReadPlan, 'run'> {
    return this.#prepared.prepare(items)
  }

  plan(items: readonly Item[]): ReadPlan {
    const { call, settings } = this.#parts
    const parsed = listOf(items, 'items').map((item, index) => this.#listed(item, `items[${index}]`))
    const texts = parsed.map(({ text }) => text)
    const shape = new JwReadShape(parsed, this.#parts)
    const plan = new PlannedRead<JwCells, JwValuePlace, JwReadStep>(texts, shape, jwValueAt)
    return {
      run: (options) => rejecting(() => plan.run(call(options).send, () => settings.clock.time())),
      describe: () => plan.describe(),
      toString: () => plan.toString(),
    }
  }

  /** A result for each entry, in their order. */
  async write(entries: readonly WriteEntry[], options: WriteCallOptions | undefined): Promise<WriteResult[]> {
    const call = callOptionsOf(options, WRITE_OPTIONS)
    const { readModifyWrite, allOrNothing } = options ?? {}
    const how = {
      ...(readModifyWrite === undefined ? {} : { readModifyWrite }),
      ...(allOrNothing === undefined ? {} : { allOrNothing }),
    }
    return this.planWrite(entries, how).runEach(call)
  }

  planWrite(entries: readonly WriteEntry[], options: WriteOptions = {}): WritePlan {
    checkNames('', options, { ...WRITE_OPTIONS })
    checkBooleans(options, ['readModifyWrite', 'allOrNothing'])
    // An entry that is none is an item that is none.
    const planned = listOf(entries, 'entries').map((entry, index) => ({
      item: this.#listed(entry?.item, `entries[${index}].item`),
      value: asPlainValue(entry?.value),
    }))
    const plan = new JwWrite(planned, this.#parts, options)
    const runEach = async (callOptions?: CallOptions) => {
      // Before anything is sent, also what is read before it is written.
      if (plan.writes('write') || !plan.writes('configure')) this.#parts.permit('write', 'Writing')
      if (plan.writes('configure')) this.#parts.permit('configure', 'Writing the system memory')
      const opened = this.#parts.call(callOptions)
      return plan.changesBits ? opened.alone((send) => plan.run(send)) : plan.run(opened.send)
    }
    return {
      run: async (callOptions) => checkAllWritten(await runEach(callOptions)),
      runEach,
      describe: () => plan.describe(),
      toString: () => plan.toString(),
    }
  }

  /** @throws RequestError when it is not an item */
  explain(item: Item): JwItemExplanation {
    const { operand, place, type, count } = parseJwItem(item, this.#options)
    return {
      text: formatJwItem({ operand, type, ...(count === undefined ? {} : { count }) }),
      type: formatByteType(type),
      ...(count === undefined ? {} : { count }),
      place: placeText(place),
    }
  }

  get #options() {
    const { areas, format } = this.#parts.settings
    return areas === undefined ? { format } : { format, areas }
  }

  /** An item of a list. What is none has no text to be called by, so its place names it. */
  #listed(item: Item, place: string): AnyJwItem {
    if (!isItem(item)) return { text: place, error: noItem(item, place) }
    try {
      return parseJwItem(item, this.#options)
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      return { text: typeof item === 'string' ? item : item.address, error }
    }
  }
}

function placeText(place: JwPlace): string {
  if (place.in === 'timer') return `timer, counter or MD ${octal(place.number, 4)}`
  const bit = place.bit === undefined ? '' : `, bit ${place.bit}`
  const byte = `byte ${octal(place.address, 6)}${bit}`
  return place.in === 'system' ? `system memory, ${byte}` : `file ${hex(place.file)}, ${byte}`
}

function noItem(given: unknown, place: string): RequestError {
  const isObject = typeof given === 'object' && given !== null && 'address' in given
  const what = isObject ? `${place}.address is ${shown(given.address)}` : `${place} is ${shown(given)}`
  const message = `${what}: an item is a text such as 09012:INT, or an object with such an address.`
  return new RequestError('BAD_ADDRESS', message, isObject ? 'address' : place)
}
