// Fields of a configuration as the editor stores them: texts, which become numbers and choices. Nothing is taken for granted.
import type { Node, NodeAPI } from 'node-red'
import { type NodeFailure, refusal } from './failure'
import type { Texts } from './texts'
import { withVariables } from './typed-input'

/** Turns `${NAME}` into its value. */
export type Resolve = (text: string) => string

/** How settings are read: the texts of refusals, and the environment. */
export interface SettingsContext {
  readonly texts: Texts
  readonly resolve: Resolve
}

/** Longer than any host name, port or number: what is longer is no setting. */
const LONGEST = 255

/** @param node whose settings they are, for the variables of its flow; `null` when it is not deployed */
export function resolverOf(RED: NodeAPI, node: Node, texts: Texts): Resolve {
  return (text) =>
    withVariables(RED, node, text, (name) => refusal('NOT_CONFIGURED', texts('error.variable', { name })))
}

type Stored<F extends string> = Readonly<Record<F, string>>

/** Reads fields and says what is wrong with them, by the labels that the dialog has. */
export class Fields<F extends string> {
  constructor(
    private readonly texts: Texts,
    /** What the dialog calls the field. */
    private readonly labelOf: (field: string) => string,
    /** Of a field that must be filled in. */
    private readonly missingKey: string,
  ) {}

  /** The texts of these fields, with variables replaced. @throws NodeFailure NOT_CONFIGURED naming the field that is no text. */
  textsOf(given: Readonly<Record<string, unknown>>, fields: readonly F[], resolve: Resolve): Record<F, string> {
    const entries = fields.map((field): [F, string] => [field, this.#textOf(given[field], field, resolve)])
    return Object.fromEntries(entries) as Record<F, string>
  }

  #textOf(value: unknown, field: F, resolve: Resolve): string {
    if (value === undefined || value === null) return ''
    const plain = typeof value === 'number' ? String(value) : value
    if (typeof plain !== 'string' || plain.length > LONGEST) throw this.bad(field, 'error.notText')
    return resolve(plain).trim()
  }

  bad(field: string, key: string, values: Readonly<Record<string, string>> = {}): NodeFailure {
    return refusal('NOT_CONFIGURED', this.texts(key, { ...values, field: this.labelOf(field) }), { field })
  }

  missing(field: F): never {
    throw this.bad(field, this.missingKey)
  }

  choice<T extends string>(settings: Stored<F>, field: F, choices: readonly T[]): T | undefined {
    const text: string = settings[field]
    const chosen = choices.find((candidate) => candidate === text)
    if (chosen !== undefined || text === '') return chosen
    throw this.bad(field, 'error.notChoice', { value: text, choices: choices.join(', ') })
  }

  /** One of several numbers. */
  numberOf<T extends number>(settings: Stored<F>, field: F, choices: readonly T[]): T | undefined {
    const text = this.choice(settings, field, choices.map(String))
    return choices.find((candidate) => String(candidate) === text)
  }

  wholeNumber(settings: Stored<F>, field: F): number | undefined {
    const text = settings[field]
    if (text === '') return undefined
    if (/^[0-9]{1,9}$/.test(text)) return Number(text)
    throw this.bad(field, 'error.notNumber', { value: text })
  }

  hexNumber(settings: Stored<F>, field: F): number | undefined {
    const text = settings[field].replace(/h$/i, '')
    if (text === '') return undefined
    if (/^[0-9a-f]{1,4}$/i.test(text)) return Number.parseInt(text, 16)
    throw this.bad(field, 'error.notHex', { value: text })
  }

  /** `true`, `false`, or left to the library. */
  switch(settings: Stored<F>, field: F): boolean | undefined {
    const text = this.choice(settings, field, ['true', 'false'])
    return text === undefined ? undefined : text === 'true'
  }
}

type Present<T> = { [K in keyof T]?: Exclude<T[K], undefined> }

/** Without the fields that are undefined: an option that is there must have a value. */
export function present<T extends object>(fields: T): Present<T> {
  return Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== undefined)) as Present<T>
}
