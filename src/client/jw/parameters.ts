// Parameters of option units and of special I/O units, with the procedure of the start switch.

import { hex } from '../../basics/hex'
import { checkNames, type OptionNames, wholeNumber } from '../../basics/option-checks'
import { PlcError, RequestError, UnfinishedError, VerifyError } from '../../errors'
import { jwCommands } from '../../jw/commands/commands'
import {
  checkBlocks,
  type ParameterBlock,
  type ParameterStep,
  parameterArea,
  parameterText,
  startProcedure,
  startSwitch,
} from '../../jw/parameters/parameter-area'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { Deadline } from '../connection/deadline'
import { WriteTurns } from '../plan/write-turns'
import { type JwCallParts, sharing, within } from './control'
import type { JwLimits } from './limits'
import type { SendJwCommand } from './send-command'

/** A unit by its place. */
export interface JwUnitPlace {
  /** Rack, 0 to 7. */
  readonly rack: number
  /** Unit in it, 0 to 7. */
  readonly unit: number
}

/** What an option unit says after it has taken its parameters over. */
export interface JwStarted {
  /** What it made of them; a manual calls it a sum check code. */
  readonly checkCode: number
}

/** The parameters 0000 to 3777 octal of one option unit. */
export interface JwOptionParameters {
  /** Parameters from an address on (02H), in as few requests as carry them. */
  read(address: number, length: number, options?: CallOptions): Promise<Uint8Array>
  /**
   * Brings parameters into the unit: start switch to 0, the parameters (12H), start switch to 1, check code read back. Needs
   * `allowParameters`.
   * @param blocks without check code and start switch (3776, 3777)
   * @throws UnfinishedError when it stops half-way: its message says what is in the unit
   * @throws VerifyError when the unit does not show the start switch at 1 afterwards
   */
  write(blocks: readonly ParameterBlock[], options?: CallOptions): Promise<JwStarted>
}

/** The parameters 000 to 177 octal of one special I/O unit. */
export interface JwSpecialIoParameters {
  /** Parameters from an address on (03H). */
  read(address: number, length: number, options?: CallOptions): Promise<Uint8Array>
  /** Parameters from an address on (13H). Needs `allowParameters`. */
  write(address: number, data: Uint8Array, options?: CallOptions): Promise<void>
}

/** Parameters of units. */
export interface JwParameters {
  /** Of an option unit (JW-20FL5, JW-22CM and so on). @throws RequestError BAD_OPTION */
  optionUnit(place: JwUnitPlace): JwOptionParameters
  /** Of a special I/O unit. @throws RequestError BAD_OPTION */
  specialIo(place: JwUnitPlace): JwSpecialIoParameters
}

export function jwParameters(parts: JwCallParts, limits: JwLimits): JwParameters {
  // One procedure at a time: the start of one must not find what another has half written.
  const turns = new WriteTurns()
  return {
    optionUnit: (place) => optionUnit(parts, limits, checkedPlace(place), turns),
    specialIo: (place) => {
      const unit = checkedPlace(place)
      return {
        read: async (address, length, options) =>
          (await parts.send(jwCommands.readSpecialIoParameters, { ...unit, address, length }, options)).data,
        write: async (address, data, options) => {
          await parts.send(jwCommands.writeSpecialIoParameters, { ...unit, address, data }, options)
        },
      }
    },
  }
}

const LAST = 7

function checkedPlace(place: JwUnitPlace): JwUnitPlace {
  checkNames('place.', place, { rack: true, unit: true } satisfies OptionNames<JwUnitPlace>)
  const { rack, unit } = place
  return { rack: wholeNumber('rack', rack, 0, LAST), unit: wholeNumber('unit', unit, 0, LAST) }
}

function optionUnit(parts: JwCallParts, limits: JwLimits, unit: JwUnitPlace, turns: WriteTurns): JwOptionParameters {
  return {
    read: async (address, length, options = {}) => {
      checkBlocks([{ address, bytes: new Uint8Array(wholeNumber('length', length, 1, parameterArea.last + 1)) }])
      const send = sharing(parts, callOptionsOf(options))
      const pieces: Uint8Array[] = []
      for (const at of starts(address, length, limits.readParameters)) {
        const most = Math.min(limits.readParameters, address + length - at)
        pieces.push((await send(jwCommands.readOptionParameters, { ...unit, address: at, length: most })).data)
      }
      return Buffer.concat(pieces)
    },
    write: async (blocks, options = {}) => {
      checkBlocks(blocks)
      // Stop and start alone would interrupt the unit for nothing.
      if (blocks.length === 0) throw new RequestError('BAD_VALUE', 'There are no parameters to write.', 'blocks')
      const steps = startProcedure(blocks.flatMap((block) => cut(block, limits.writeParameters)))
      parts.permit('configure', jwCommands.writeOptionParameters.title)
      const deadline = new Deadline(parts.clock, callOptionsOf(options), parts.timeout)
      const { title } = jwCommands.writeOptionParameters
      return turns.exclusive(deadline, title, () => procedure(steps, unit, within(deadline, parts)))
    },
  }
}

function starts(from: number, length: number, step: number): number[] {
  return Array.from({ length: Math.ceil(length / step) }, (_, i) => from + i * step)
}

function cut({ address, bytes }: ParameterBlock, most: number): ParameterBlock[] {
  return starts(address, bytes.length, most).map((at) => ({
    address: at,
    bytes: bytes.subarray(at - address, at - address + most),
  }))
}

async function procedure(steps: readonly ParameterStep[], unit: JwUnitPlace, send: SendJwCommand): Promise<JwStarted> {
  const done: ParameterStep[] = []
  for (const step of steps) {
    try {
      if (step.kind === 'write') {
        const { address, bytes } = step.block
        await send(jwCommands.writeOptionParameters, { ...unit, address, data: bytes })
        done.push(step)
      } else {
        const { address, length } = step
        return started((await send(jwCommands.readOptionParameters, { ...unit, address, length })).data)
      }
    } catch (error) {
      if (!(error instanceof PlcError) || error instanceof VerifyError || isUntouched(done, error)) throw error
      throw new UnfinishedError(`${stateOf(done, step)} ${error.message}`, error)
    }
  }
  throw new Error('a procedure that does not read back')
}

/** Nothing was written: the unit is as it was. */
function isUntouched(done: readonly ParameterStep[], { outcome }: PlcError): boolean {
  return done.length === 0 && outcome !== 'unknown'
}

function started(bytes: Uint8Array): JwStarted {
  const { checkCode, startSwitch: at } = parameterArea
  const [code = 0, position = 0] = [bytes[0], bytes[at - checkCode]]
  if (position === startSwitch.start) return { checkCode: code }
  const message = `The parameters were written and the unit was started, but its start switch reads ${hex(position, 2)}H, not 01H: it may not have taken them over. Look at the error of the unit.`
  throw new VerifyError(message, `start switch ${hex(position, 2)}H`)
}

/** What is in the unit, when the procedure ends before its end. */
function stateOf(done: readonly ParameterStep[], failed: ParameterStep): string {
  const written = done.flatMap((step) => (step.kind === 'write' && step.purpose === 'parameters' ? [step.block] : []))
  const ranges = written.map(({ address, bytes }) => {
    const last = address + bytes.length - 1
    return bytes.length === 1 ? parameterText(address) : `${parameterText(address)} to ${parameterText(last)}`
  })
  const there =
    ranges.length === 0 ? 'None of the new parameters is known to be' : `The new parameters ${ranges.join(', ')} are`
  switch (failed.purpose) {
    case 'stop':
      return 'Whether the start switch of the unit was set to 0 is not known; no parameter was written.'
    case 'parameters':
      return `The start switch of the unit is 0, so that it does not take over what is half written. ${there} in it. Write all of them again.`
    case 'start':
      return `${there} in the unit, and all of them are written. Whether its start switch was set to 1, so that it takes them over, is not known to have worked.`
    default:
      return 'All parameters are written and the unit was started; its check code could not be read back.'
  }
}
