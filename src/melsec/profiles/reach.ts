// Ports of the SLMP reference manual: where they reach, and how long they wait.
import type { MonitoringTimer, Reach } from './profile'

/** Of a simulated PLC; what a real port has depends on its open settings. */
export const openSettings = 'background: 16 open settings'

export const ownStationTimer: MonitoringTimer = {
  default: 4000,
  zeroOnly: false,
  recommended: { from: 250, to: 10_000 },
  source: '4.1 monitoring timer: 01H to 28H for the own station',
}

const own = [0x3ff, 0x3e0, 0x3d0] as const

/** CPU No. 2 to 4. The control CPU has 03FF too, and CPU No. 1 mostly is it. */
const others = [0x3e1, 0x3e2, 0x3e3] as const

/** A port by which other stations may be reached. 03FF own station, 03E0 CPU No. 1, 03D0 control system CPU. */
export function networks(source: string, nonControlCpus: readonly number[] = others): Reach {
  return { stations: 'networks', ownModuleIo: own, nonControlCpus, ownModuleIoOnly: false, source }
}

/** A port that reaches nothing but the connected station, with the CPUs of a multiple CPU system. */
export function connectedStation(source: string): Reach {
  return { stations: 'connected', ownModuleIo: own, nonControlCpus: others, ownModuleIoOnly: false, source }
}
