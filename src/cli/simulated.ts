// How simulated PLCs show themselves, whatever they are at.
import type { Endpoint, PlantTag, RequestEvent } from '../entry/simulator'
import type { EndCodeFamily } from '../index'
import { endCodeText } from './end-code'
import { table } from './output'

export function isLoopback(host: string): boolean {
  return host === 'localhost' || host === '::1' || host.startsWith('127.')
}

export function addressRow(name: string, endpoint: Endpoint | undefined): readonly (readonly string[])[] {
  return endpoint === undefined ? [] : [[name, addressText(endpoint)]]
}

export function addressText({ host, port }: Endpoint): string {
  return `${host.includes(':') ? `[${host}]` : host}:${port}`
}

export function plantTable(tags: readonly PlantTag<string>[]): string {
  return table(
    tags.map(({ name, address, title, unit, writable }) => [
      address,
      name,
      unit === undefined ? title : `${title} (${unit})`,
      ...(writable ? ['may be written'] : []),
    ]),
    '  ',
  )
}

/** What became of a request, in words. */
export function outcomeText({ command, endCode, frame }: RequestEvent): string {
  return outcomeIn(frame === '1E' || frame === '1C' ? frame : 'slmp', command, endCode)
}

/** The same for any family of end codes. */
export function outcomeIn(family: EndCodeFamily, command: string | undefined, endCode: number | undefined): string {
  const answer =
    endCode === undefined ? 'not answered' : endCode === 0 ? 'carried out' : `refused ${endCodeText(endCode, family)}`
  return `${command ?? 'unknown command'}: ${answer}`
}
