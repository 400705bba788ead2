import { checkShapes } from './check'
import type { Shape } from './field'

/**
 * What a command does to the PLC. Only `read` and `diagnose` may ever be repeated when the outcome is unknown.
 * `lock`: changes nothing but what other devices may do meanwhile, as opening a file does; it needs no permission.
 * `configure`: changes what a PLC is set up as: parameters, passwords (Sharp JW).
 */
export const effects = ['read', 'write', 'control', 'configure', 'diagnose', 'lock'] as const
/** What a command does to the PLC. */
export type Effect = (typeof effects)[number]

/** A command as plain data: what every protocol family declares of its commands. */
export interface Declaration {
  /** The manual's name, English edition. */
  readonly title: string
  /** The number that says which command it is, where the frame carries it. */
  readonly code: number
  /** What it does to the PLC: permissions look at it. */
  readonly effect: Effect
  /** Where it is described, e.g. `SLMP reference manual 5.2`. */
  readonly manual: string
  /** Fields of its request. */
  readonly request: Shape
  /** Fields of its answer. */
  readonly response: Shape
  /** Name of the command whose request a response refers to, when it is not this one's (Execute Monitor). */
  readonly context?: string
  /** `no`: a success is not answered (Remote Reset). */
  readonly answered?: 'no'
  /** Who sends the request; without it a client does. */
  readonly sender?: 'plc'
}

/** A declaration with the name it has in its family's list. */
export type Named<D extends Declaration, N extends string> = D & { readonly name: N }

/**
 * Names a family's declarations by their keys and checks that every field they refer to exists.
 * @throws TypeError at load when a declaration is wrong.
 * @example const commands = declare({ readWords: { title: 'Read', code: 0x0401, ... } }); commands.readWords.name
 */
export function declare<const T extends Readonly<Record<string, Declaration>>>(
  declarations: T,
): { readonly [K in keyof T & string]: Named<T[K], K> } {
  const named = Object.entries(declarations).map(([name, declaration]) => {
    const { context } = declaration
    const asked = context === undefined ? declaration.request : declarations[context]?.request
    if (asked === undefined) throw new TypeError(`${name}: there is no command ${context}`)
    checkShapes(declaration.title, declaration.request, declaration.response, asked)
    return [name, Object.freeze({ ...declaration, name })]
  })
  return Object.fromEntries(named)
}
