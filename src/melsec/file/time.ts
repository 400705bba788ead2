// Dates of files: two packed words, in steps of two seconds (SLMP reference manual 5.8, Read Directory/File and Change
// File Date).
import type { Reader, ValueCodec, Writer } from '../../codec/codec'
import { RequestError } from '../../errors'

/**
 * Date and time of a file, in the PLC's own time zone. Read from a PLC whose clock was never set, it may be no date:
 * the numbers are then as they stand in the PLC, e.g. month 0. See {@link isFileTime}.
 */
export interface FileTime {
  /** 1980 to 2107 */
  readonly year: number
  /** 1 to 12 */
  readonly month: number
  /** 1 to 31 */
  readonly day: number
  /** 0 to 23 */
  readonly hour: number
  /** 0 to 59 */
  readonly minute: number
  /** 0 to 58, even: files keep steps of 2 seconds. */
  readonly second: number
}

const FIRST_YEAR = 1980
const LAST_YEAR = FIRST_YEAR + 127

function daysIn(year: number, month: number): number {
  if (month === 2) return year % 4 === 0 && (year % 100 !== 0 || year % 400 === 0) ? 29 : 28
  return [4, 6, 9, 11].includes(month) ? 30 : 31
}

/** What is wrong with a date; `undefined` when it is one. */
function problemOf(time: FileTime): { readonly field: string; readonly message: string } | undefined {
  const { year, month, second } = time
  const bounds = [
    ['year', FIRST_YEAR, LAST_YEAR],
    ['month', 1, 12],
    ['day', 1, daysIn(year, month)],
    ['hour', 0, 23],
    ['minute', 0, 59],
    ['second', 0, 58],
  ] as const
  for (const [field, min, max] of bounds) {
    const found = time[field]
    if (Number.isInteger(found) && found >= min && found <= max) continue
    return { field, message: `is ${String(found)}, must be a whole number from ${min} to ${max}` }
  }
  if (second % 2 === 0) return undefined
  return { field: 'second', message: `is ${second}, must be even: files keep steps of 2 seconds` }
}

/**
 * Whether it is a date that exists: what was read from a PLC may be none.
 * @example isFileTime({ year: 1980, month: 0, day: 0, hour: 0, minute: 0, second: 0 }) // false
 */
export function isFileTime(time: FileTime): boolean {
  return problemOf(time) === undefined
}

/**
 * As people write it.
 * @example formatFileTime({ year: 2010, month: 4, day: 1, hour: 20, minute: 50, second: 58 }) // '2010-04-01 20:50:58'
 */
export function formatFileTime({ year, month, day, hour, minute, second }: FileTime): string {
  const two = (number: number) => String(number).padStart(2, '0')
  return `${year}-${two(month)}-${two(day)} ${two(hour)}:${two(minute)}:${two(second)}`
}

/**
 * A `Date` in the time zone of this computer, with the second even, rounded down: files keep steps of 2 seconds.
 * @throws RequestError OUT_OF_RANGE before 1980 and after 2107
 * @example await plc.files.setDate('4:/LINE.CSV', fileTimeOf(new Date()))
 */
export function fileTimeOf(date: Date): FileTime {
  const time = {
    year: date.getFullYear(),
    month: date.getMonth() + 1,
    day: date.getDate(),
    hour: date.getHours(),
    minute: date.getMinutes(),
    second: 2 * Math.floor(date.getSeconds() / 2),
  }
  const problem = problemOf(time)
  if (problem === undefined) return time
  throw new RequestError('OUT_OF_RANGE', `${problem.field} ${problem.message}.`, problem.field)
}

/** The words: date bits 15-9 year since 1980, 8-5 month, 4-0 day; time bits 15-11 hour, 10-5 minute, 4-0 second / 2. */
function packed(time: FileTime): { readonly date: number; readonly time: number } {
  if (typeof time !== 'object' || time === null) {
    throw new RequestError('BAD_MESSAGE', 'must be an object with year, month, day, hour, minute, second')
  }
  const problem = problemOf(time)
  if (problem !== undefined) {
    throw new RequestError('BAD_MESSAGE', `${problem.field}: ${problem.message}`, problem.field)
  }
  const { year, month, day, hour, minute, second } = time
  return { date: ((year - FIRST_YEAR) << 9) | (month << 5) | day, time: (hour << 11) | (minute << 5) | (second / 2) }
}

function unpacked(date: number, time: number): FileTime {
  return {
    year: FIRST_YEAR + (date >> 9),
    month: (date >> 5) & 0x0f,
    day: date & 0x1f,
    hour: time >> 11,
    minute: (time >> 5) & 0x3f,
    second: 2 * (time & 0x1f),
  }
}

function codecOf(name: string, first: 'date' | 'time'): ValueCodec<FileTime> {
  return {
    name,
    takes: 'an object with year, month, day, hour, minute and second (even)',
    example: { year: 2026, month: 4, day: 1, hour: 12, minute: 30, second: 0 },
    write(writer: Writer, value) {
      const { date, time } = packed(value)
      for (const word of first === 'date' ? [date, time] : [time, date]) writer.uint(word, 2)
    },
    read(reader: Reader) {
      const [one, two] = [reader.uint(2), reader.uint(2)]
      return first === 'date' ? unpacked(one, two) : unpacked(two, one)
    },
    size: (ascii) => (ascii ? 8 : 4),
  }
}

/** Date, then time: Change File Date. */
export const changedTime = codecOf('date and time', 'date')
/** Time, then date: Read Directory/File. */
export const modifiedTime = codecOf('time and date', 'time')
