// The clock of a Sharp JW.
import type { JwAdjustOptions, JwClient, JwClockTime } from '../../index'
import { RequestError } from '../../index'
import { type MakeCommand, newCommand, perform } from '../command'
import { exitCodes } from '../exit-code'
import { onlyOf } from '../family'
import { given } from '../option'
import { json } from '../output'
import type { Plc } from '../session'
import { refusalOf, type Terminal } from '../terminal'
import { addJwConnectionOptions, type JwConnectionOptions, jwPlc } from './connection'

const examples = [
  'clock read --plc 192.168.3.60:4000',
  'clock set now --plc 192.168.3.60:4000',
  'clock set 2026-12-01T06:30:00 --plc 192.168.3.60:4000',
  'clock adjust --round --plc 192.168.3.60:4000',
]

const NO_CLOCK = {
  what: 'request for its clock',
  instead: 'The clock of a MELSEC is in its special registers, e.g. read SD210..SD216 --profile iq-r.',
}

interface ClockOptions extends JwConnectionOptions {
  readonly yes?: boolean
  readonly round?: boolean
  readonly resetFraction?: boolean
  readonly stop?: boolean
}

const ADJUSTMENTS = ['round', 'resetFraction', 'stop'] as const satisfies readonly (keyof JwAdjustOptions)[]

/** `melsec-jw clock` */
export const clockCommand: MakeCommand = (run) => {
  const command = newCommand('clock', 'clock of a Sharp JW (asks before it is set)', examples)
    .description(
      'Reads, sets or adjusts the clock of a Sharp JW. Setting takes the local time as 2026-12-01T06:30:00, or now; the PLC must be ' +
        'in write mode data or all (control write-mode).',
    )
    .argument('<action>', 'read, set or adjust')
    .argument('[time]', 'set: date and time, or now')
    .optionsGroup('Setting:')
    .option('-y, --yes', 'do not ask')
    .option('--round', 'adjust: to the nearer whole minute (what it does when nothing is said)')
    .option('--reset-fraction', 'adjust: what is below a second becomes 0')
    .option('--stop', 'adjust: stops the clock; any other setting lets it go on')
  addJwConnectionOptions(command)
  return command.action((action: string, time: string | undefined, options: ClockOptions) =>
    perform(run, options, () => onlyOf('jw', NO_CLOCK, options, () => clock(run.terminal, action, time, options))),
  )
}

async function clock(
  terminal: Terminal,
  action: string,
  time: string | undefined,
  options: ClockOptions,
): Promise<number> {
  const plc = jwPlc(terminal, options)
  const adjustments = given(options, ADJUSTMENTS)
  if (action !== 'adjust' && Object.keys(adjustments).length > 0) {
    throw new RequestError('BAD_OPTION', '--round, --reset-fraction and --stop are of clock adjust.', 'adjust')
  }
  if (action !== 'set' && time !== undefined) {
    throw new RequestError('BAD_OPTION', `clock ${action} takes no time: clock set ${time}.`, 'time')
  }
  switch (action) {
    case 'read':
      return read(terminal, options, plc)
    case 'set':
      return set(terminal, timeOf(time), options, plc)
    case 'adjust':
      return adjust(terminal, adjustments, options, plc)
    default:
      throw new RequestError(
        'BAD_OPTION',
        `There is no ${JSON.stringify(action)}: choose read, set or adjust.`,
        'action',
      )
  }
}

async function read(terminal: Terminal, options: ClockOptions, plc: Plc<JwClient>): Promise<number> {
  const time = await plc.with('reading', (client) => client.clock.read())
  terminal.out(options.json === true ? json({ plc: plc.text, ...time }) : clockText(time))
  return exitCodes.ok.code
}

async function set(
  terminal: Terminal,
  time: Date | undefined,
  options: ClockOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  const shown = time === undefined ? 'the time of this computer' : dateText(time)
  await plc.unsent('control', (client) => client.clock.set(time ?? new Date()))
  await confirm(terminal, options, `Set the clock of ${plc.text} to ${shown}.`)
  // The time of now is taken when it is sent, not when somebody was asked.
  const sent = await plc.with('control', async (client) => {
    const at = time ?? new Date()
    await client.clock.set(at)
    return at
  })
  if (options.json === true) terminal.out(json({ plc: plc.text, set: dateText(sent), ok: true }))
  else terminal.out(`Set to ${dateText(sent)}.`)
  return exitCodes.ok.code
}

async function adjust(
  terminal: Terminal,
  adjustments: JwAdjustOptions,
  options: ClockOptions,
  plc: Plc<JwClient>,
): Promise<number> {
  await plc.unsent('control', (client) => client.clock.adjust(adjustments))
  const names = Object.keys(adjustments)
  const what = names.length === 0 ? 'to the nearer whole minute' : names.map((name) => WHAT[name] ?? name).join(', ')
  await confirm(terminal, options, `Adjust the clock of ${plc.text}: ${what}.`)
  await plc.with('control', (client) => client.clock.adjust(adjustments))
  if (options.json === true) terminal.out(json({ plc: plc.text, ...adjustments, ok: true }))
  else terminal.out(`Adjusted: ${what}.`)
  return exitCodes.ok.code
}

/** What each adjustment does. */
const WHAT: Readonly<Record<string, string>> = {
  round: 'to the nearer whole minute',
  resetFraction: 'what is below a second becomes 0',
  stop: 'it stops',
}

async function confirm(terminal: Terminal, { yes = false }: ClockOptions, question: string): Promise<void> {
  const refusal = await refusalOf(terminal, yes, question)
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was sent. ${refusal}`, '--yes')
}

/** `undefined`: now. @throws RequestError BAD_VALUE */
function timeOf(text = ''): Date | undefined {
  if (text.toLowerCase() === 'now') return undefined
  const match = /^(20\d\d)-(\d\d)-(\d\d)[T ](\d\d):(\d\d)(?::(\d\d))?$/.exec(text.trim())
  const [year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0] = (match ?? [])
    .slice(1)
    .map((part) => Number(part ?? 0))
  const date = new Date(year, month - 1, day, hour, minute, second)
  // 30 February would be a day of March.
  const isSame =
    date.getMonth() === month - 1 && date.getDate() === day && date.getHours() === hour && date.getMinutes() === minute
  if (match !== null && isSame && second < 60) return date
  const what = text === '' ? 'The time is missing' : `${JSON.stringify(text)} is no time`
  throw new RequestError('BAD_VALUE', `${what}: write it as 2026-12-01T06:30:00 (local time), or now.`, 'time')
}

const DAYS = ['Sunday', 'Monday', 'Tuesday', 'Wednesday', 'Thursday', 'Friday', 'Saturday']
const two = (number: number) => String(number).padStart(2, '0')

/** e.g. `26-12-01 06:30:00 Tuesday`: the PLC knows two digits of the year. */
export function clockText({ year, month, day, dayOfWeek, hour, minute, second }: JwClockTime): string {
  const weekday = DAYS[dayOfWeek] ?? `day ${dayOfWeek} of the week`
  return `${two(year)}-${two(month)}-${two(day)} ${two(hour)}:${two(minute)}:${two(second)} ${weekday}`
}

function dateText(date: Date): string {
  const day = `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`
  return `${day} ${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`
}
