// Options as commander takes them: numbers, choices, and those that were given.
import { Argument, InvalidArgumentError, Option } from 'commander'
import { RequestError } from '../index'

export const jsonOption = () => new Option('--json', 'print one JSON document instead of text')

/** A whole number of an option. */
export function whole(min: number, max: number): (text: string) => number {
  return (text) => {
    const value = /^\d+$/.test(text) ? Number(text) : Number.NaN
    if (value >= min && value <= max) return value
    throw new InvalidArgumentError(`It is a whole number from ${min} to ${max}.`)
  }
}

/** A choice that is taken in upper and lower case. */
export function choice<T extends string>(flags: string, description: string, values: readonly T[]): Option {
  return new Option(flags, description).choices(values).argParser(oneOf(values))
}

/** As `choice`, for an argument. */
export function choiceArgument<T extends string>(name: string, description: string, values: readonly T[]): Argument {
  return new Argument(name, description).choices(values).argParser(oneOf(values))
}

function oneOf<T extends string>(values: readonly T[]): (text: string) => T {
  return (text) => {
    const found = values.find((value) => value.toLowerCase() === text.toLowerCase())
    if (found !== undefined) return found
    throw new InvalidArgumentError(`Choose one of ${values.join(', ')}.`)
  }
}

type Given<T> = { [K in keyof T]?: Exclude<T[K], undefined> }

/** Those of the named options that were given. */
export function given<T extends object, K extends keyof T>(options: T, names: readonly K[]): Given<Pick<T, K>> {
  const entries = names.map((name) => [name, options[name]] as const).filter(([, value]) => value !== undefined)
  return Object.fromEntries(entries) as Given<Pick<T, K>>
}

/** The name among those that one family takes. @throws RequestError BAD_OPTION */
export function named<T extends string>(option: string, name: string, names: readonly T[]): T {
  const found = names.find((one) => one === name)
  if (found !== undefined) return found
  throw new RequestError(
    'BAD_OPTION',
    `--${option} ${name} is of another family: choose one of ${names.join(', ')}.`,
    option,
  )
}
