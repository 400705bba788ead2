// The clock of the PLC.
import { checkBooleans, isPlainObject, type OptionNames } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { encode, type Shape, writerOf } from '../../codec/codec'
import { PlcError, RequestError, UnfinishedError, VerifyError } from '../../errors'
import { jwCommands } from '../../jw/commands/commands'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { type JwCallParts, sharing } from './control'
import type { JwRequestOf, SendJwCommand } from './send-command'

/** What the clock of a PLC says. */
export interface JwClockTime {
  /** Of the century, 0 to 99. */
  readonly year: number
  /** 1 to 12. */
  readonly month: number
  /** 1 to 31. */
  readonly day: number
  /** 0 Sunday to 6 Saturday. */
  readonly dayOfWeek: number
  /** 0 to 23. */
  readonly hour: number
  /** 0 to 59. */
  readonly minute: number
  /** 0 to 59. */
  readonly second: number
}

/** What correcting the clock does. At least one. */
export interface JwAdjustOptions extends CallOptions {
  /** To the nearer whole minute. */
  readonly round?: boolean
  /** What is below a second becomes 0. */
  readonly resetFraction?: boolean
  /** Stops the clock; without it, it goes on. */
  readonly stop?: boolean
}

const ADJUST_OPTIONS: OptionNames<Omit<JwAdjustOptions, keyof CallOptions>> = {
  round: true,
  resetFraction: true,
  stop: true,
}

/** The clock of the PLC. Setting needs `allowControl`, and write mode `data` or `all` in the PLC. */
export interface JwClock {
  /** Date and time of one moment (A2H, A3H). */
  read(options?: CallOptions): Promise<JwClockTime>
  /**
   * Sets date and time (B2H, B3H) and reads them back, because midnight in the PLC may come between the two.
   * @throws UnfinishedError when only the date was set @throws VerifyError when the PLC shows another day
   * @param time of a `Date` the local time of this computer
   */
  set(time: Date | JwClockTime, options?: CallOptions): Promise<void>
  /** Corrects the time (B4H). Default: to the nearer whole minute. @example await plc.clock.adjust({ round: true }) */
  adjust(options?: JwAdjustOptions): Promise<void>
}

/** Bits of CTRL: 0000A0RS. */
const CONTROL = { stop: 1, resetFraction: 2, round: 8 } as const

export function jwClock(parts: JwCallParts): JwClock {
  return {
    read: async (options = {}) => momentOf(sharing(parts, callOptionsOf(options))),
    set: async (given, options = {}) => {
      const { hour, minute, second, ...date } = timeOf(given)
      const time = { hour, minute, second, control: 0 }
      checkFields(date, time)
      parts.permit('control', jwCommands.setDate.title)
      const send = sharing(parts, callOptionsOf(options))
      await send(jwCommands.setDate, date)
      await behind('The date was set, and then not the time', () => send(jwCommands.setTime, time))
      await behind('Date and time were set, but whether its midnight came in between is not known', () =>
        checkDay(send, date, hour),
      )
    },
    adjust: async (options = {}) => {
      const call = callOptionsOf(options, ADJUST_OPTIONS)
      checkBooleans(options, ['round', 'resetFraction', 'stop'])
      const { stop = false, resetFraction = false, round = !stop && !resetFraction } = options
      const control =
        (stop ? CONTROL.stop : 0) + (resetFraction ? CONTROL.resetFraction : 0) + (round ? CONTROL.round : 0)
      const message: JwRequestOf<typeof jwCommands.correctTime> = { control }
      await parts.send(jwCommands.correctTime, message, call)
    },
  }
}

async function momentOf(send: SendJwCommand): Promise<JwClockTime> {
  const before = await send(jwCommands.readDate, {})
  const time = await send(jwCommands.readTime, {})
  const date = await send(jwCommands.readDate, {})
  // At midnight the time may be of either day.
  if (date.day === before.day) return { ...date, ...time }
  return { ...date, ...(await send(jwCommands.readTime, {})) }
}

/** @throws UnfinishedError for what fails when something was set already */
async function behind(what: string, act: () => Promise<unknown>): Promise<void> {
  try {
    await act()
  } catch (error) {
    if (!(error instanceof PlcError) || error instanceof VerifyError) throw error
    throw new UnfinishedError(`${what}: ${error.message}`, error)
  }
}

type SetDate = JwRequestOf<typeof jwCommands.setDate>
type SetTime = JwRequestOf<typeof jwCommands.setTime>

/** Both, before the first is sent. @throws RequestError BAD_MESSAGE, or BAD_VALUE for a day that does not exist */
function checkFields(date: SetDate, time: SetTime): void {
  encode<Shape>(jwCommands.setDate.request, date, writerOf('binary'))
  encode<Shape>(jwCommands.setTime.request, time, writerOf('binary'))
  const { year, month, day } = date
  const last = new Date(Date.UTC(CENTURY + year, month, 0)).getUTCDate()
  if (day > last)
    throw new RequestError('BAD_VALUE', `day is ${day}; month ${month} of year ${year} has ${last}.`, 'day')
}

/** Two digits of a year are taken to be of this one. */
const CENTURY = 2000

/**
 * Date and time are two requests: where the clock of the PLC reaches midnight between them, it is a day ahead behind them.
 * @throws VerifyError
 */
async function checkDay(send: SendJwCommand, date: SetDate, hour: number): Promise<void> {
  const isRight = async () => {
    const shown = await momentOf(send)
    // What was set just before midnight may have become the next day since.
    return (shown.day === date.day) === shown.hour >= hour
  }
  if (await isRight()) return
  await send(jwCommands.setDate, date)
  if (await isRight()) return
  throw new VerifyError(
    'Date and time were set, but the PLC shows another day. Read its clock, and set it again.',
    undefined,
  )
}

/** @throws RequestError BAD_VALUE for what is no time */
function timeOf(given: Date | JwClockTime): JwClockTime {
  if (!(given instanceof Date)) {
    if (isPlainObject(given)) return given
    throw new RequestError(
      'BAD_VALUE',
      `The time is a Date or an object with year, month and so on, not ${shown(given)}.`,
    )
  }
  if (Number.isNaN(given.getTime())) throw new RequestError('BAD_VALUE', 'The date is an invalid Date.')
  return {
    year: given.getFullYear() % 100,
    month: given.getMonth() + 1,
    day: given.getDate(),
    dayOfWeek: given.getDay(),
    hour: given.getHours(),
    minute: given.getMinutes(),
    second: given.getSeconds(),
  }
}
