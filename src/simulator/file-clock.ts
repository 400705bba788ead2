// The clock of the simulated PLC as files keep it: local time, in steps of two seconds, from 1980 to 2107.
import { type FileTime, fileTimeOf } from '../melsec/file/time'

/** What a clock outside of these years shows. @param ms since 1970 */
export function fileClock(ms: number): FileTime {
  const date = new Date(ms)
  const year = date.getFullYear()
  if (!(year >= 1980)) return { year: 1980, month: 1, day: 1, hour: 0, minute: 0, second: 0 }
  if (year > 2107) return { year: 2107, month: 12, day: 31, hour: 23, minute: 59, second: 58 }
  return fileTimeOf(date)
}

/** ms since 1970 */
export function msOf({ year, month, day, hour, minute, second }: FileTime): number {
  return new Date(year, month - 1, day, hour, minute, second).getTime()
}
