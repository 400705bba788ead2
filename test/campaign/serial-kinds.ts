/** The lines that the serial campaign tries. */
import type { SerialKind } from './serial-lane'

const FORMATS = [
  ['1C', 1],
  ['1C', 4],
  ['3C', 1],
  ['3C', 4],
  ['4C', 1],
  ['4C', 4],
  ['4C', 5],
] as const

type Speed = SerialKind['baudRate']
const SPEEDS: readonly Speed[] = [9600, 115_200]

function kindOf(
  [frame, messageFormat]: (typeof FORMATS)[number],
  baudRate: Speed,
  noise: boolean,
  { sumCheck = true, pace = false, echo = false } = {},
): SerialKind {
  const more = [noise ? 'noise' : 'quiet', sumCheck ? '' : 'no sum', pace ? 'paced' : '', echo ? 'echo' : '']
  const name = [`${frame} format ${messageFormat}`, baudRate, ...more.filter((text) => text !== '')].join(' ')
  return { name, frame, messageFormat, baudRate, noise, sumCheck, pace, echo }
}

/** Every frame in every format at both speeds, without noise and with it; characters take no time there. */
export const serialKinds: readonly SerialKind[] = [false, true].flatMap((noise) =>
  SPEEDS.flatMap((baudRate) => FORMATS.map((format) => kindOf(format, baudRate, noise))),
)

/** Others: as slow as a line is, with an echo, without the sum check. */
export const otherSerialKinds: readonly SerialKind[] = [
  kindOf(['3C', 4], 115_200, false, { pace: true }),
  kindOf(['4C', 5], 115_200, true, { pace: true }),
  kindOf(['1C', 1], 9600, false, { pace: true }),
  kindOf(['1C', 4], 9600, true, { pace: true }),
  kindOf(['3C', 1], 115_200, true, { echo: true }),
  kindOf(['4C', 5], 115_200, true, { echo: true }),
  kindOf(['1C', 1], 115_200, true, { echo: true }),
  kindOf(['3C', 4], 9600, false, { echo: true }),
  kindOf(['1C', 1], 115_200, true, { sumCheck: false }),
  kindOf(['3C', 4], 115_200, true, { sumCheck: false }),
  kindOf(['4C', 5], 115_200, true, { sumCheck: false }),
]
