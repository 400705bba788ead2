// What the drives of a simulated PLC hold when nothing else is said: enough to look at, and nothing that is real.
import type { Profile } from '../melsec/profiles/profile'
import type { SimulatedFile } from './simulated-drive'

type Files = Readonly<Record<string, SimulatedFile>>

const modified = { year: 2026, month: 1, day: 15, hour: 8, minute: 30, second: 0 } as const

function file(data: string, readOnly = false): SimulatedFile {
  return { data, readOnly, modified }
}

const recipe = 'Product,Temperature,Minutes\r\nA,72.5,15\r\nB,68.0,20\r\nC,75.0,12\r\n'
const note = 'These are files of a simulated PLC.\r\nRead them, change them, delete them.\r\n'
/** Stands for content that only an engineering tool can read. */
const opaque = '\u0001\u0002\u0003\u0004'.repeat(64)

function log(day: number): string {
  const rows = Array.from({ length: 200 }, (_, i) => `2026-01-${day} 08:${String(i % 60).padStart(2, '0')},${i},OK\r\n`)
  return ['Time,Count,Result\r\n', ...rows].join('')
}

const ofIqR: Readonly<Record<number, Files>> = {
  2: { 'LOGGING\\LOG01.CSV': file(log(14)), 'LOGGING\\LOG02.CSV': file(log(15)) },
  3: { '$MELPRJ$\\PARAM.PRM': file(opaque, true), '$MELPRJ$\\MAIN.PRG': file(opaque, true) },
  4: { 'README.TXT': file(note), 'LINE.CSV': file(recipe), 'ARCHIVE\\LINE2025.CSV': file(recipe, true) },
}

const ofQAndL: Readonly<Record<number, Files>> = {
  0: { 'PARAM.QPA': file(opaque), 'MAIN.QPG': file(opaque) },
  2: { 'LOG01.CSV': file(log(14)), 'LOG02.CSV': file(log(15)) },
  4: { 'README.TXT': file(note), 'LINE.CSV': file(recipe) },
}

/** The files of one drive. */
export function usualFiles({ files }: Profile, drive: number): Files {
  const long = files.subcommands[0] === 0x0040
  return (long ? ofIqR : ofQAndL)[drive] ?? {}
}
