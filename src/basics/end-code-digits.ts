import type { EndCodeFamily } from '../errors'
import { hex } from './hex'

/** An end code as the manuals of its family print it: four hexadecimal digits, of 1E, 1C and Sharp JW two. */
export function endCodeDigits(endCode: number, family: EndCodeFamily = 'slmp'): string {
  return hex(endCode, family === 'slmp' ? 4 : 2)
}
