// Something that is asked of a CPU, after asking the user: the same for PLCs of every family.
import { RequestError } from '../index'
import { exitCodes } from './exit-code'
import { json } from './output'
import type { ItemClient, Plc } from './session'
import { refusalOf, type Terminal } from './terminal'

/** What an action found out: as text, and as data. */
export interface Found {
  readonly text: string
  readonly data: Readonly<Record<string, unknown>>
}

export interface Action<C, O> {
  readonly title: string
  /** What it does to the plant. */
  readonly effect: string
  /** Options that it takes, beside those of all. */
  readonly takes: readonly (keyof O & string)[]
  /** The same with these options, for the question. */
  readonly asks?: (options: O) => string
  /** It changes nothing in the CPU: nobody is asked. */
  readonly harmless?: true | ((options: O) => boolean)
  readonly done: string
  /** The same with --verify. */
  readonly verified?: string
  run(client: C, options: O): Promise<Found | undefined>
}

export type Actions<C, O> = Readonly<Record<string, Action<C, O>>>

/** As commander gives them. */
export interface ActionOptions {
  readonly yes?: boolean
  readonly verify?: boolean
  readonly json?: boolean
}

/** Does the action of a name. `extras`: the options that only some actions take. */
export async function act<C extends ItemClient, O extends ActionOptions>(
  terminal: Terminal,
  name: string,
  actions: Actions<C, O>,
  extras: readonly (keyof O & string)[],
  options: O,
  plc: Plc<C>,
): Promise<number> {
  const action = actionOf(name, actions, extras, options)
  await plc.unsent('control', (client) => action.run(client, options))
  const { title, effect, asks, harmless = false } = action
  const question = `${title} of ${plc.text}: ${asks?.(options) ?? effect}.`
  const isHarmless = harmless === true || (harmless !== false && harmless(options))
  const refusal = await refusalOf(terminal, options.yes === true || isHarmless, question)
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was sent. ${refusal}`, '--yes')
  const found = await plc.with('control', (client) => action.run(client, options))
  const done = options.verify === true ? (action.verified ?? action.done) : action.done
  if (options.json === true) terminal.out(json({ plc: plc.text, action: name, ok: true, ...found?.data }))
  else terminal.out(`${title}: ${found?.text ?? done}`)
  return exitCodes.ok.code
}

function actionOf<C, O extends ActionOptions>(
  name: string,
  actions: Actions<C, O>,
  extras: readonly (keyof O & string)[],
  options: O,
): Action<C, O> {
  const action = Object.hasOwn(actions, name) ? actions[name] : undefined
  if (action === undefined) {
    throw new RequestError(
      'BAD_OPTION',
      `There is no ${JSON.stringify(name)}: choose ${Object.keys(actions).join(', ')}.`,
      'action',
    )
  }
  for (const option of extras) {
    if (options[option] !== undefined && !action.takes.includes(option)) {
      throw new RequestError('BAD_OPTION', `${action.title} takes no --${option}.`, option)
    }
  }
  return action
}

/** For the help. */
export function actionHelp<C, O>(title: string, actions: Actions<C, O>): string {
  const list = Object.entries(actions).map(([name, action]) => `  ${name.padEnd(12)} ${action.title}: ${action.effect}`)
  return `\n${title}\n${list.join('\n')}`
}
