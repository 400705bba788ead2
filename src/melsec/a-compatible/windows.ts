// Which devices the frames with device names of the A series (1E, and 1C of serial lines) reach, and under which names, as
// data (FX5 communication manual 39.2 and 44.4: the same tables).
import type { DeviceAddress, DeviceName } from '../device/device'

/** Devices in a row that a frame of this kind reaches: `points` from `device` `number` on are `as` `from` on in the frame. */
export interface DeviceWindow {
  readonly device: DeviceName
  readonly number: number
  readonly points: number
  readonly as: DeviceName
  readonly from: number
}

function plain(device: DeviceName, points: number, number = 0): DeviceWindow {
  return { device, number, points, as: device, from: number }
}

const ordinary: readonly DeviceWindow[] = [
  plain('X', 0o400),
  plain('Y', 0o400),
  plain('M', 7680),
  plain('S', 4096),
  plain('D', 8000),
  plain('R', 32768),
  plain('TS', 512),
  plain('TN', 512),
  plain('CS', 200),
  plain('CN', 200),
]

const renamed: readonly DeviceWindow[] = [
  { device: 'SM', number: 8000, points: 512, as: 'M', from: 8000 },
  { device: 'SD', number: 8000, points: 512, as: 'D', from: 8000 },
  { device: 'LCS', number: 0, points: 56, as: 'CS', from: 200 },
  { device: 'LCN', number: 0, points: 56, as: 'CN', from: 200 },
]

/** FX5: M8000 is a special relay in the frame and may be an internal relay in the PLC, so only SM8000 is taken. */
export const fx5Windows: readonly DeviceWindow[] = [...ordinary, ...renamed]

/** FX3: special relays and registers are called M8000 and D8000; SM8000 and SD8000 mean the same. */
export const fx3Windows: readonly DeviceWindow[] = [
  ...ordinary,
  plain('M', 512, 8000),
  plain('D', 512, 8000),
  plain('CS', 56, 200),
  ...renamed,
]

/** The window an address is in. */
export function windowOf(
  windows: readonly DeviceWindow[],
  { device, number }: DeviceAddress,
): DeviceWindow | undefined {
  return windows.find((row) => row.device === device && number >= row.number && number < row.number + row.points)
}

/** Address in the frame of a device that `windowOf` has found. */
export function toFrame({ number, as, from }: DeviceWindow, address: DeviceAddress): DeviceAddress {
  return { device: as, number: from + address.number - number }
}

/** The device of the PLC behind an address in a frame; `undefined` when there is none. */
export function fromFrame(
  windows: readonly DeviceWindow[],
  { device, number }: DeviceAddress,
): DeviceAddress | undefined {
  const row = windows.find((entry) => entry.as === device && number >= entry.from && number < entry.from + entry.points)
  return row === undefined ? undefined : { device: row.device, number: row.number + number - row.from }
}

/**
 * What an FX3 user calls M8000, D8000 or CS200 under the names the device table has for it: SM8000, SD8000, LCS0. Not
 * CN200: it has 32 bits here, and who writes it means one word.
 */
export function namedAsFx5(address: DeviceAddress): DeviceAddress {
  if (windowOf(fx5Windows, address) !== undefined || address.device === 'CN') return address
  const { device, number, ...rest } = address
  const named = fromFrame(fx5Windows, { device, number })
  return named === undefined ? address : { ...rest, ...named }
}

/**
 * What to write for a counter of 32 bits by its number in GX Works2, `C220`; `undefined` for anything else.
 * @example longCounterHint('C220')   // C200 to C255 are counters of 32 bits: write LCN20 (current value) or LCS20 (contact).
 */
export function longCounterHint(text: string): string | undefined {
  const [, digits] = /^\s*C[NC]?0*(\d+)(?!\d)/i.exec(text) ?? []
  if (digits === undefined) return undefined
  const named = (device: 'CN' | 'CS') => fromFrame(renamed, { device, number: Number(digits) })
  const [value, contact] = [named('CN'), named('CS')]
  if (value === undefined || contact === undefined) return undefined
  const names = `${value.device}${value.number} (current value) or ${contact.device}${contact.number} (contact)`
  return `C200 to C255 are counters of 32 bits: write ${names}.`
}
