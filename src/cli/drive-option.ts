// `--drive`: a folder of this computer as a drive of the simulated PLC.
import type { SimulatedDrives } from '../entry/simulator'
import { RequestError } from '../index'

/**
 * Drives by their numbers, each written `number=folder`.
 * @throws RequestError BAD_OPTION when it is no such text; the simulator checks the rest.
 * @example drivesOf(['2=./card'])
 */
export function drivesOf(texts: readonly string[]): SimulatedDrives {
  const drives: Record<number, { readonly folder: string }> = {}
  for (const text of texts) {
    const [, number = '', folder = ''] = /^(\d+)=(.+)$/s.exec(text.trim()) ?? []
    if (folder === '') bad(text, 'write the number of the drive and a folder, e.g. 2=./card.')
    if (drives[Number(number)] !== undefined) bad(text, `drive ${number} has a folder already.`)
    drives[Number(number)] = { folder }
  }
  return drives
}

function bad(text: string, reason: string): never {
  throw new RequestError('BAD_OPTION', `${JSON.stringify(text)}: ${reason}`, 'drive')
}
