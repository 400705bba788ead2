/**
 * The way to a station: the request destination fields of a frame (SLMP reference manual p. 20-23).
 */
import { hex } from '../../basics/hex'
import { RequestError } from '../../errors'
import { type EthernetFrameName, frameFacts } from './frames'

/** Request destination network, station, module I/O, multidrop station and extension station numbers. */
export type Route = {
  /** 0 = the network of the connected station, 1 to 239 another one. */
  readonly network: number
  /**
   * 255 (FFH) = the connected station, 1 to 120 another one, 125 and 126 the control or master station.
   * Given to `completeRoute`, also 121 to 65534: station 124 with that extension station.
   */
  readonly station: number
  /** 0x3ff = the CPU of the station; see `moduleIoNumbers`; 0 to 0x1ff a serial module with multidrop stations. */
  readonly moduleIo: number
  /** 0 to 31; 0 unless `moduleIo` is a serial module. */
  readonly multidrop: number
  /**
   * Station extension frame only. With station 124: 121 to 65534 = the station of that number, 0 = the designated master
   * station, 65535 = the connected station. With every other station 0.
   */
  readonly extensionStation?: number
}

/** The fields that say which station. */
export type RouteToStation = Pick<Route, 'network' | 'station' | 'extensionStation'>

/** The station the connection goes to, and its CPU. */
export const ownStation: Route = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0 }

/** A module I/O number with a name. */
export interface ModuleIoNumber {
  /** What the command line takes, e.g. `cpu1`. */
  readonly name: string
  /** What it is, in English. */
  readonly title: string
  /** The number, for `route.moduleIo`. */
  readonly number: number
}

/** Request destination module I/O numbers that have a name (SLMP p. 21). */
export const moduleIoNumbers: readonly ModuleIoNumber[] = [
  { name: 'own', title: 'own station, control CPU', number: 0x3ff },
  { name: 'cpu1', title: 'multiple CPU No. 1, remote head No. 1', number: 0x3e0 },
  { name: 'cpu2', title: 'multiple CPU No. 2, remote head No. 2', number: 0x3e1 },
  { name: 'cpu3', title: 'multiple CPU No. 3', number: 0x3e2 },
  { name: 'cpu4', title: 'multiple CPU No. 4', number: 0x3e3 },
  { name: 'control', title: 'control system CPU', number: 0x3d0 },
  { name: 'standby', title: 'standby system CPU', number: 0x3d1 },
  { name: 'systemA', title: 'system A CPU', number: 0x3d2 },
  { name: 'systemB', title: 'system B CPU', number: 0x3d3 },
]

/** Last start I/O number / 16 of a serial module that multidrop stations hang on. */
const LAST_MULTIDROP_MODULE = 0x1ff
const LAST_MULTIDROP = 0x1f
const LAST_NETWORK = 239
const LAST_STATION = 120
/** 7DH designated, 7EH present control or master station. */
const MASTER_STATIONS: readonly number[] = [0x7d, 0x7e]
/** 7CH: the station number follows in the extension field, which only the station extension frame has. */
const STATION_IN_EXTENSION = 0x7c
const LAST_EXTENSION = 0xfffe
const EXTENSION_OWN = 0xffff
/** Numbers of stations that mean something else in the station field. */
const AMBIGUOUS: readonly number[] = [STATION_IN_EXTENSION, ...MASTER_STATIONS, ownStation.station]
const FIELDS = [...Object.keys(ownStation), 'extensionStation']

/**
 * A whole route: what is left out is the connected station's.
 * @throws RequestError OUT_OF_RANGE naming the field (`route.network`, ...) and the numbers it takes.
 * @example completeRoute({ network: 1, station: 3 })   // CPU of station 3 on network 1
 * @example completeRoute({ network: 1, station: 300 }) // station 124 with extension station 300
 */
export function completeRoute(part: Partial<Route> = {}): Route {
  const route = withExtension({ ...ownStation, ...definedOf(part) })
  checkExtension(route)
  checkNetwork(route)
  checkStation(route)
  checkModuleIo(route)
  checkMultidrop(route)
  return route
}

function definedOf(part: Partial<Route>): Partial<Route> {
  for (const name of Object.keys(part)) {
    if (!FIELDS.includes(name)) {
      const known = FIELDS.join(', ')
      throw new RequestError('BAD_OPTION', `A route has no ${JSON.stringify(name)}: it has ${known}.`, `route.${name}`)
    }
  }
  return Object.fromEntries(Object.entries(part).filter(([, value]) => value !== undefined))
}

/** A number of a station that the station field cannot hold, in the field that can. */
function withExtension(route: Route): Route {
  const { station, extensionStation } = route
  if (!isExtensionNumber(station) || AMBIGUOUS.includes(station)) return route
  if (extensionStation !== undefined) {
    const explicit = `{ station: ${STATION_IN_EXTENSION}, extensionStation: ${station} }`
    refuse('station', `Station ${station} is given without an extensionStation, or as ${explicit}.`)
  }
  return { ...route, station: STATION_IN_EXTENSION, extensionStation: station }
}

function isExtensionNumber(station: number): boolean {
  return isWhole(station, LAST_STATION + 1, LAST_EXTENSION)
}

function checkNetwork(route: Route): void {
  const { network } = route
  if (!isWhole(network, 0, LAST_NETWORK)) {
    refuse('network', `Network ${network} cannot be reached: 0 is the connected station's, others are 1 to 239.`)
  }
  if (network === 0 && !isConnectedStation(route)) {
    const station = stationText(route)
    refuse('network', `${station} needs the number of its network (1 to 239): network 0 has station 255 only.`)
  }
}

/** Whether it is the station the connection goes to, whichever of its CPUs. */
export function isConnectedStation({ network, station, extensionStation = 0 }: RouteToStation): boolean {
  if (network !== ownStation.network) return false
  if (station === STATION_IN_EXTENSION) return extensionStation === EXTENSION_OWN
  return station === ownStation.station && extensionStation === 0
}

function checkStation({ network, station, extensionStation }: Route): void {
  if (station === ownStation.station && network !== 0) {
    refuse(
      'station',
      `Station 255 is the connected one, in network 0; network ${network} has stations 1 to 120.${numbered(station)}`,
    )
  }
  if (station === STATION_IN_EXTENSION) {
    if (extensionStation !== undefined) return
    refuse(
      'station',
      `Station 124 (7CH) of a station extension frame says that the station is in extensionStation, which is missing.${numbered(station)}`,
    )
  }
  if (station === ownStation.station || isWhole(station, 1, LAST_STATION) || MASTER_STATIONS.includes(station)) return
  refuse(
    'station',
    `Station ${station} cannot be addressed: 255 is the connected one, others are 1 to 120, 125 (designated) and 126 (present control or master station), and with the station extension frame 121 to 65534.`,
  )
}

/** How to say the station that has this number. */
function numbered(station: number): string {
  const fields = `station: ${STATION_IN_EXTENSION}, extensionStation: ${station}`
  return ` The station with the number ${station} is { ${fields} } in a station extension frame.`
}

/**
 * SLMP reference manual p. 23. It prints 0001H to FFFEH for the stations 121 to 65534; the others stand in the station
 * field, so 1 to 120 are refused here.
 */
function checkExtension({ station, extensionStation }: Route): void {
  if (extensionStation === undefined) return
  if (station === STATION_IN_EXTENSION) {
    if (extensionStation === 0 || extensionStation === EXTENSION_OWN || isExtensionNumber(extensionStation)) return
    refuse(
      'extensionStation',
      `Extension station ${extensionStation} does not exist: 121 to 65534, 0 (designated master station) or 65535 (connected station). Stations 1 to 120 stand in station.`,
    )
  }
  if (extensionStation === 0) return
  refuse('extensionStation', `Extension station ${extensionStation} needs station 124, not ${station}.`)
}

/**
 * Whether the frame can say the route.
 * @throws RequestError OUT_OF_RANGE
 */
export function checkRouteOf(frame: EthernetFrameName, route: Route): void {
  const { station, extensionStation } = route
  if (frame !== 'ext') {
    if (extensionStation === undefined) return
    const field = station === STATION_IN_EXTENSION ? 'station' : 'extensionStation'
    refuse(
      field,
      `A ${frameFacts[frame].title} frame cannot say ${stationText(route).toLowerCase()}: stations above 120 need the station extension frame (frame 'ext', by an RJ71GN11-T2).`,
    )
  }
  if (!MASTER_STATIONS.includes(station) || extensionStation !== undefined) return
  const which = station === MASTER_STATIONS[0] ? 'designated' : 'present'
  refuse(
    'station',
    `Station ${station} can be two stations in a station extension frame. Add extensionStation: 0 for the ${which} control or master station.${numbered(station)}`,
  )
}

function checkModuleIo({ moduleIo }: Route): void {
  if (isWhole(moduleIo, 0, LAST_MULTIDROP_MODULE) || moduleIoNumbers.some(({ number }) => number === moduleIo)) return
  const named = moduleIoNumbers.map(({ number, title }) => `${hex(number, 4)} ${title}`).join('; ')
  refuse('moduleIo', `Module I/O ${show(moduleIo)} does not exist: ${named}; 0000 to 01FF serial module for multidrop.`)
}

function checkMultidrop({ moduleIo, multidrop }: Route): void {
  if (!isWhole(multidrop, 0, LAST_MULTIDROP)) {
    refuse('multidrop', `Multidrop station ${multidrop} does not exist: 0 to 31.`)
  }
  if (multidrop !== 0 && moduleIo > LAST_MULTIDROP_MODULE) {
    refuse(
      'multidrop',
      `Multidrop station ${multidrop} needs the module I/O number of its serial module (0000 to 01FF), not ${hex(moduleIo, 4)}.`,
    )
  }
}

/** The number that says the station without an extension, if one does. */
function plainStation({ station, extensionStation }: Omit<RouteToStation, 'network'>): number | undefined {
  if (extensionStation === undefined) return station
  const isNumber = station === STATION_IN_EXTENSION && isExtensionNumber(extensionStation)
  return isNumber && !AMBIGUOUS.includes(extensionStation) ? extensionStation : undefined
}

/** For people, e.g. `network 0, station 255, module I/O 03FF, multidrop 0`. Takes any numbers, also a PLC's. */
export function describeRoute(route: Route): string {
  const { network, moduleIo, multidrop } = route
  return `network ${network}, ${stationText(route).toLowerCase()}, module I/O ${hex(moduleIo, 4)}, multidrop ${multidrop}`
}

/** e.g. `Station 3`, `Station 300`, `Station 124, extension station 125`. */
export function stationText(route: Omit<RouteToStation, 'network'>): string {
  const { station, extensionStation } = route
  const plain = extensionStation === 0 && station !== STATION_IN_EXTENSION ? station : plainStation(route)
  return plain === undefined ? `Station ${station}, extension station ${extensionStation}` : `Station ${plain}`
}

function isWhole(value: number, first: number, last: number): boolean {
  return Number.isInteger(value) && value >= first && value <= last
}

function show(moduleIo: number): string {
  return isWhole(moduleIo, 0, 0xffff) ? hex(moduleIo, 4) : String(moduleIo)
}

function refuse(field: keyof Route, message: string): never {
  throw new RequestError('OUT_OF_RANGE', message, `route.${field}`)
}
