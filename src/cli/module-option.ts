// `--module`: a module of the simulated PLC as it is typed.
import { InvalidArgumentError } from 'commander'
import type { ExtensionMemory } from '../entry/simulator'

type SimulatedModule = NonNullable<ExtensionMemory['modules']>[number]

/** Words of its buffer memory: more than any module of the manuals has. */
const POINTS = 0x10000

/**
 * A start I/O number, or a model of MELSEC-Q at one.
 * @example moduleOf('Q62DA@0030')   // { unit: 3, points: 65536, model: 'Q62DA' }
 */
export function moduleOf(text: string): SimulatedModule {
  const [, model, digits = ''] = /^(?:(.+)@)?(?:0x)?([0-9a-f]{1,4})h?$/i.exec(text.trim()) ?? []
  const startIo = Number.parseInt(digits, 16)
  if (!(startIo % 16 === 0)) {
    throw new InvalidArgumentError('It is a start I/O number (hexadecimal) or a model at one, e.g. Q62DA@0030.')
  }
  return { unit: startIo / 16, points: POINTS, ...(model === undefined ? {} : { model: model.trim() }) }
}
