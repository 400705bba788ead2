import { type DeviceName, devicesOfGroup } from '../device/device'

/**
 * Points by device. Timers and counters have one number for contact, coil and current value, given by the name the
 * device table groups them under: `T`, `ST`, `C`, `LT`, `LST`, `LC`.
 */
export function pointsOf(
  single: Readonly<Partial<Record<DeviceName, number>>>,
  groups: Readonly<Record<string, number>>,
): Readonly<Partial<Record<DeviceName, number>>> {
  const points: Partial<Record<DeviceName, number>> = { ...single }
  for (const [group, count] of Object.entries(groups)) {
    for (const { name } of devicesOfGroup(group)) points[name] = count
  }
  return points
}
