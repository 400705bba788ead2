/**
 * The way to a station: the four request destination fields of a 3E or 4E frame (SLMP reference manual p. 20-22).
 */
import { RequestError } from '../errors'

/** Request destination network, station, module I/O and multidrop station numbers. */
export interface Route {
  /** 0 = the network of the connected station, 1 to 239 another one. */
  readonly network: number
  /** 255 (FFH) = the connected station, 1 to 120 another one, 125 and 126 the control or master station. */
  readonly station: number
  /** 0x3ff = the CPU of the station; see `moduleIoNumbers`; 0 to 0x1ff a serial module with multidrop stations. */
  readonly moduleIo: number
  /** 0 to 31; 0 unless `moduleIo` is a serial module. */
  readonly multidrop: number
}

/** The station the connection goes to, and its CPU. */
export const ownStation: Route = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0 }

/** Request destination module I/O numbers that have a name (SLMP p. 21). `name` is what `parseRoute` takes. */
export const moduleIoNumbers = [
  { name: 'own', title: 'own station, control CPU', number: 0x3ff },
  { name: 'cpu1', title: 'multiple CPU No. 1, remote head No. 1', number: 0x3e0 },
  { name: 'cpu2', title: 'multiple CPU No. 2, remote head No. 2', number: 0x3e1 },
  { name: 'cpu3', title: 'multiple CPU No. 3', number: 0x3e2 },
  { name: 'cpu4', title: 'multiple CPU No. 4', number: 0x3e3 },
  { name: 'control', title: 'control system CPU', number: 0x3d0 },
  { name: 'standby', title: 'standby system CPU', number: 0x3d1 },
  { name: 'systemA', title: 'system A CPU', number: 0x3d2 },
  { name: 'systemB', title: 'system B CPU', number: 0x3d3 },
] as const

/** Last start I/O number / 16 of a serial module that multidrop stations hang on. */
const LAST_MULTIDROP_MODULE = 0x1ff
const LAST_MULTIDROP = 0x1f
const LAST_NETWORK = 239
const LAST_STATION = 120
/** 7DH designated, 7EH present control or master station. */
const MASTER_STATIONS: readonly number[] = [0x7d, 0x7e]
/** 7CH: the station number follows in the extension field, which 3E and 4E frames do not have. */
const STATION_IN_EXTENSION = 0x7c

/**
 * A whole route: what is left out is the connected station's.
 * @throws RequestError OUT_OF_RANGE naming the field (`route.network`, ...) and the numbers it takes.
 * @example completeRoute({ network: 1, station: 3 })   // CPU of station 3 on network 1
 */
export function completeRoute(part: Partial<Route> = {}): Route {
  const route: Route = { ...ownStation, ...definedOf(part) }
  checkNetwork(route)
  checkStation(route)
  checkModuleIo(route)
  checkMultidrop(route)
  return route
}

function definedOf(part: Partial<Route>): Partial<Route> {
  for (const name of Object.keys(part)) {
    if (!(name in ownStation)) {
      const known = Object.keys(ownStation).join(', ')
      throw new RequestError('BAD_OPTION', `A route has no ${JSON.stringify(name)}: it has ${known}.`, `route.${name}`)
    }
  }
  return Object.fromEntries(Object.entries(part).filter(([, value]) => value !== undefined))
}

function checkNetwork({ network, station }: Route): void {
  if (!isWhole(network, 0, LAST_NETWORK)) {
    refuse('network', `Network ${network} cannot be reached: 0 is the connected station's, others are 1 to 239.`)
  }
  if (network === 0 && station !== ownStation.station) {
    refuse('network', `Station ${station} needs the number of its network (1 to 239): network 0 has station 255 only.`)
  }
}

function checkStation({ network, station }: Route): void {
  if (station === ownStation.station && network !== 0) {
    refuse('station', `Station 255 is the connected one, in network 0; network ${network} has stations 1 to 120.`)
  }
  if (station === ownStation.station || isWhole(station, 1, LAST_STATION) || MASTER_STATIONS.includes(station)) return
  const hint =
    station === STATION_IN_EXTENSION || isWhole(station, LAST_STATION + 1, 0xfffe)
      ? ' Stations above 120 need the station extension frame.'
      : ''
  refuse(
    'station',
    `Station ${station} cannot be addressed: 255 is the connected one, others are 1 to 120, 125 (designated) and 126 (present control or master station).${hint}`,
  )
}

function checkModuleIo({ moduleIo }: Route): void {
  if (isWhole(moduleIo, 0, LAST_MULTIDROP_MODULE) || moduleIoNumbers.some(({ number }) => number === moduleIo)) return
  const named = moduleIoNumbers.map(({ number, title }) => `${hex4(number)} ${title}`).join('; ')
  refuse('moduleIo', `Module I/O ${show(moduleIo)} does not exist: ${named}; 0000 to 01FF serial module for multidrop.`)
}

function checkMultidrop({ moduleIo, multidrop }: Route): void {
  if (!isWhole(multidrop, 0, LAST_MULTIDROP)) {
    refuse('multidrop', `Multidrop station ${multidrop} does not exist: 0 to 31.`)
  }
  if (multidrop !== 0 && moduleIo > LAST_MULTIDROP_MODULE) {
    refuse(
      'multidrop',
      `Multidrop station ${multidrop} needs the module I/O number of its serial module (0000 to 01FF), not ${hex4(moduleIo)}.`,
    )
  }
}

/**
 * Reads `network/station`, `network/station/module I/O` or `network/station/module I/O/multidrop`, or `own`.
 * Numbers are decimal, the module I/O number is hexadecimal or a name of `moduleIoNumbers`.
 * @throws RequestError BAD_OPTION when it is not a route, OUT_OF_RANGE when a number does not exist.
 * @example parseRoute('1/3')         // station 3 on network 1
 * @example parseRoute('0/255/cpu2')  // CPU No. 2 of the connected station
 */
export function parseRoute(text: string): Route {
  const parts = text.trim().split('/')
  if (parts.length === 1 && parts[0]?.toLowerCase() === 'own') return ownStation
  const [network = '', station = '', moduleIo, multidrop] = parts
  if (parts.length < 2 || parts.length > 4) {
    throw new RequestError('BAD_OPTION', `${JSON.stringify(text)} is not a route: ${ROUTE_SYNTAX}`, 'route')
  }
  return completeRoute({
    network: parseNumber('network', network),
    station: parseNumber('station', station),
    ...(moduleIo === undefined ? {} : { moduleIo: parseModuleIo(moduleIo) }),
    ...(multidrop === undefined ? {} : { multidrop: parseNumber('multidrop', multidrop) }),
  })
}

const ROUTE_SYNTAX = 'write own, or network/station[/module I/O[/multidrop]], e.g. 1/3 or 0/255/03E1.'

function parseNumber(field: keyof Route, text: string): number {
  const digits = text.trim()
  if (/^[0-9]{1,5}$/.test(digits)) return Number(digits)
  throw new RequestError(
    'BAD_OPTION',
    `The ${field} ${JSON.stringify(text)} of a route is not a decimal number.`,
    `route.${field}`,
  )
}

function parseModuleIo(text: string): number {
  const wanted = text.trim().toLowerCase()
  const named = moduleIoNumbers.find(({ name }) => name.toLowerCase() === wanted)
  if (named !== undefined) return named.number
  if (/^[0-9a-f]{1,4}$/.test(wanted)) return Number.parseInt(wanted, 16)
  const names = moduleIoNumbers.map(({ name }) => name).join(', ')
  throw new RequestError(
    'BAD_OPTION',
    `The module I/O number ${JSON.stringify(text)} of a route is not hexadecimal and none of ${names}.`,
    'route.moduleIo',
  )
}

/** Text that `parseRoute` reads back, e.g. `1/3/03FF/0`. */
export function formatRoute({ network, station, moduleIo, multidrop }: Route): string {
  return `${network}/${station}/${hex4(moduleIo)}/${multidrop}`
}

/** For people, e.g. `network 0, station 255, module I/O 03FF, multidrop 0`. Takes any numbers, also a PLC's. */
export function describeRoute({ network, station, moduleIo, multidrop }: Route): string {
  return `network ${network}, station ${station}, module I/O ${hex4(moduleIo)}, multidrop ${multidrop}`
}

function isWhole(value: number, first: number, last: number): boolean {
  return Number.isInteger(value) && value >= first && value <= last
}

function show(moduleIo: number): string {
  return isWhole(moduleIo, 0, 0xffff) ? hex4(moduleIo) : String(moduleIo)
}

function hex4(value: number): string {
  return value.toString(16).toUpperCase().padStart(4, '0')
}

function refuse(field: keyof Route, message: string): never {
  throw new RequestError('OUT_OF_RANGE', message, `route.${field}`)
}
