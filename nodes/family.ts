// What of the families of PLCs differs for the nodes, in one table. A node that does something each family does in its own
// way says it for all of them (`ForFamily`); nothing else asks which one it is.
import { byteTypes, typeNames } from '../src/entry/address'
import {
  createJwClient,
  createMelsecClient,
  type Effect,
  type Item,
  type ItemExplanation,
  type JwClient,
  type JwClientOptions,
  type JwItemExplanation,
  jwModels,
  type MelsecClient,
  type MelsecClientOptions,
  type PlcClient,
} from '../src/index'

export const familyNames = ['melsec', 'jw'] as const
export type FamilyName = (typeof familyNames)[number]

/** What read and write nodes need of a client, whatever its family. */
export interface NodeClient extends PlcClient {
  explain(item: Item): ItemExplanation | JwItemExplanation
}

/** What a client is made of. */
export type FamilyOptions =
  | { readonly family: 'melsec'; readonly options: MelsecClientOptions }
  | { readonly family: 'jw'; readonly options: JwClientOptions }

/** A client of a family. */
export type AnyPlc =
  | { readonly family: 'melsec'; readonly client: MelsecClient }
  | { readonly family: 'jw'; readonly client: JwClient }

/** Something that each family does in its own way. */
export interface ForFamily<T> {
  readonly melsec: (client: MelsecClient) => T
  readonly jw: (client: JwClient) => T
}

export function forFamily<T>(plc: AnyPlc, of: ForFamily<T>): T {
  return plc.family === 'melsec' ? of.melsec(plc.client) : of.jw(plc.client)
}

export function clientOf(given: FamilyOptions): AnyPlc {
  return given.family === 'melsec'
    ? { family: 'melsec', client: createMelsecClient(given.options) }
    : { family: 'jw', client: createJwClient(given.options) }
}

/** What is done to a PLC. */
export type NodeEffect = Effect

/** What the owner of a connection must have allowed, and what is said when it is not. Reading needs no permission. */
export const permissions: Readonly<Partial<Record<NodeEffect, { readonly option: string; readonly refusal: string }>>> =
  {
    write: { option: 'allowWrites', refusal: 'error.writesOff' },
    control: { option: 'allowControl', refusal: 'error.controlOff' },
    configure: { option: 'allowParameters', refusal: 'error.parametersOff' },
  }

/** What the editor knows of a family. */
export interface FamilyFacts {
  /** Types of items. */
  readonly types: readonly string[]
  /** Types of nodes that it has nothing for. */
  readonly lacks: readonly string[]
  /** An item, as an example. */
  readonly example: string
  /** Models to choose from. */
  readonly models?: readonly string[]
}

export const families: Readonly<Record<FamilyName, FamilyFacts>> = {
  melsec: { types: typeNames, lacks: [], example: 'D100' },
  jw: {
    types: [...typeNames, ...Object.keys(byteTypes)],
    lacks: ['melsec-jw-ondemand', 'melsec-jw-file'],
    example: '09012',
    models: jwModels,
  },
}
