// Address and port of a PLC, whatever its family.
import { type Command, Option } from 'commander'
import { RequestError } from '../index'
import type { Family } from './family'
import { whole } from './option'

/** As commander gives them. */
export interface PeerOptions {
  readonly plc?: string
  readonly host?: string
  readonly port?: number
  readonly udp?: boolean
}

/** Names the PLC when no option does. */
const VARIABLE = 'MELSEC_JW_PLC'

/** Where the port of a PLC is set, and one as an example. */
const PORTS: Readonly<Record<Family, { readonly what: string; readonly example: string }>> = {
  melsec: { what: 'its SLMP (MC protocol) entry', example: '5010' },
  jw: { what: 'its Ethernet unit', example: '4000' },
}

/** Adds the options that say where the PLC is. */
export function addPeerOptions(command: Command): Command {
  return command
    .option(
      '--plc <host:port>',
      `address and port of the PLC, e.g. 192.168.3.39:5010; else ${VARIABLE} in the environment`,
    )
    .addOption(new Option('--host <host>', 'address of the PLC'))
    .addOption(
      new Option(
        '--port <number>',
        'port of an SLMP (MC protocol) entry of the PLC, or of its Ethernet unit, decimal',
      ).argParser(whole(1, 65535)),
    )
    .addOption(new Option('--udp', 'UDP; without it TCP'))
}

/** Address and port: both from the options, or both from the environment, never one from each. */
export function peerOf(
  { plc, host, port }: PeerOptions,
  family: Family,
): { readonly host: string; readonly port: number } {
  if (plc !== undefined && host !== undefined) throw badPeer('Give --plc or --host, not both.', 'plc')
  const text = plc ?? (host === undefined && port === undefined ? process.env[VARIABLE] : undefined)
  const given = text === undefined ? {} : splitPeer(text)
  if (given.port !== undefined && port !== undefined) {
    throw badPeer(`The port is given twice, as ${given.port} and as ${port}.`, 'port')
  }
  const found = { host: host ?? given.host, port: port ?? given.port }
  const { what, example } = PORTS[family]
  if (found.host === undefined || found.host === '') {
    throw badPeer(`Which PLC? Give its address and port, e.g. --plc 192.168.3.39:${example}.`, 'host')
  }
  if (found.port === undefined) {
    const whole = `--plc ${found.host}:${example}`
    throw badPeer(`Which port of ${found.host}? Give the port of ${what}, e.g. ${whole}.`, 'port')
  }
  return { host: found.host, port: found.port }
}

export function badPeer(message: string, option: string): RequestError {
  return new RequestError('BAD_OPTION', message, option)
}

/** `host`, `host:port`, `[IPv6]:port`, IPv6. */
function splitPeer(text: string): { readonly host?: string; readonly port?: number } {
  const [, bracketed, plain, digits] = /^(?:\[([^\]]*)\]|([^:]*))(?::(\d+))?$/.exec(text.trim()) ?? []
  const host = bracketed ?? plain ?? text.trim()
  if (digits === undefined) return { host }
  const port = Number(digits)
  if (port >= 1 && port <= 65535) return { host, port }
  throw badPeer(`${digits} is not a port: 1 to 65535.`, 'port')
}

/** e.g. `tcp 192.168.3.39:5010` */
export function networkText(options: PeerOptions, family: Family): string {
  const { host, port } = peerOf(options, family)
  return `${options.udp === true ? 'udp' : 'tcp'} ${host.includes(':') ? `[${host}]` : host}:${port}`
}
