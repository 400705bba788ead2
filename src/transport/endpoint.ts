/** Addresses and ports: what the options may say, how they are shown, and how a name becomes one address. */
import { promises as dns } from 'node:dns'
import { isIP, isIPv6 } from 'node:net'
import { RequestError } from '../errors'

/** Resolves a name to its addresses, best first. */
export type ResolveName = (host: string) => Promise<readonly string[]>

/** Options that TCP and UDP share. */
export interface EndpointOptions {
  /** IPv4 or IPv6 address, or a name. Of a name's addresses the first IPv4 one is used, or else the first. */
  readonly host: string
  /** 1 to 65535. */
  readonly port: number
  /** IP address of the network interface to use. Default: the system chooses. */
  readonly localAddress?: string | undefined
  /** 1 to 65535, for a PLC that accepts only a registered port. 0 or absent: any free one, which is better. */
  readonly localPort?: number | undefined
  /** Default: the system's resolver. */
  readonly resolve?: ResolveName | undefined
}

/** Throws a `RequestError` for what cannot be connected to, before anything is tried. */
export function checkEndpoint(options: EndpointOptions): void {
  const { host, port, localAddress, localPort } = options
  if (typeof host !== 'string' || host.trim() === '') {
    throw new RequestError('BAD_OPTION', `host is empty: give the IP address or the name of the PLC`, 'host')
  }
  checkPort('port', port, 1)
  if (localPort !== undefined) checkPort('localPort', localPort, 0)
  if (localAddress === undefined) return
  if (isIP(localAddress) === 0) {
    const message = `localAddress '${localAddress}' is not an IP address: give the address of a network interface`
    throw new RequestError('BAD_OPTION', message, 'localAddress')
  }
  if (isIP(host) !== 0 && isIP(host) !== isIP(localAddress)) {
    const message = `localAddress '${localAddress}' and host '${host}' must both be IPv4 or both be IPv6`
    throw new RequestError('BAD_OPTION', message, 'localAddress')
  }
}

/** Throws a `RequestError` unless the port is a whole number from `min` to 65535. */
export function checkPort(field: string, port: number, min: 0 | 1): void {
  if (Number.isInteger(port) && port >= min && port <= 65535) return
  throw new RequestError('BAD_OPTION', `${field} ${String(port)} is not a port: give ${min} to 65535`, field)
}

/** `192.168.3.39:5007`, `[::1]:5007`. */
export function formatEndpoint(host: string, port: number): string {
  return isIPv6(host) ? `[${host}]:${port}` : `${host}:${port}`
}

/**
 * The one address to use. One and not a race between several (as browsers do): a second attempt on the same PLC takes
 * a second of its few connections. IPv4 first, because that is what PLCs speak, whatever `localhost` resolves to.
 */
export async function resolveAddress(options: EndpointOptions): Promise<string> {
  const { host, localAddress, resolve = systemResolve } = options
  if (isIP(host) !== 0) return host
  const addresses = await resolve(host)
  const family = localAddress === undefined ? undefined : isIP(localAddress)
  const address =
    family === undefined
      ? (addresses.find((a) => isIP(a) === 4) ?? addresses[0])
      : addresses.find((a) => isIP(a) === family)
  if (address !== undefined) return address
  const wanted = family === undefined ? '' : `IPv${family} `
  throw Object.assign(new Error(`no ${wanted}address for ${host}`), { code: 'ENOTFOUND', syscall: 'resolve' })
}

async function systemResolve(host: string): Promise<readonly string[]> {
  const found = await dns.lookup(host, { all: true, verbatim: true })
  return found.map((entry) => entry.address)
}

/** `192.168.3.39:5007`, with the name in front when it was resolved: `plc1 (192.168.3.39:5007)`. */
export function describeTarget(options: EndpointOptions, address: string): string {
  const endpoint = formatEndpoint(address, options.port)
  return address === options.host ? endpoint : `${options.host} (${endpoint})`
}

/** What the user fixed of the local side, undefined when nothing. */
export function describeLocal(options: EndpointOptions): string | undefined {
  const { localAddress, localPort } = options
  if (localPort)
    return localAddress === undefined ? `local port ${localPort}` : `local ${formatEndpoint(localAddress, localPort)}`
  return localAddress === undefined ? undefined : `local address ${localAddress}`
}

/**
 * For sockets that are only given IP addresses: answers at once, where Node's own lookup takes a turn of the event loop
 * for each bind, connect and send.
 */
export function literalLookup(
  address: string,
  _options: unknown,
  done: (error: NodeJS.ErrnoException | null, address: string, family: number) => void,
): void {
  done(null, address, isIP(address))
}
