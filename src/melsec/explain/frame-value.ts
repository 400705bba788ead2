// Values of 1E and 1C frames in words: there some devices go by other names than those of the PLC.
import type { Declaration, Message, Named, Shape } from '../../codec/codec'
import type { Explainer, Leaf } from '../../codec/explanation'
import { aCompatibleCommands } from '../a-compatible/commands'
import { pcTypeCodes } from '../a-compatible/type-code'
import { fromFrame, fx5Windows } from '../a-compatible/windows'
import { formatDevice } from '../device/address'
import { FORM_XY_OCTAL } from '../device/codec'
import type { DeviceAddress } from '../device/device'
import { isDevice } from '../device-field'
import { oneCCommands } from '../one-c/commands'
import type { ExplainSettings } from './body'
import { describeValue, devicesOf, splitRow, type WordsFor } from './values'

/** A command of a set of its own. */
export type FrameCommand = Named<Declaration, string>

/** A request that an answer refers to. */
export interface FrameRequest {
  readonly command: FrameCommand
  readonly message: Message
}

const typeCodes: readonly unknown[] = [
  aCompatibleCommands.readPcType.response.typeCode,
  oneCCommands.PC.response.typeCode,
]

export function describeFrameValue(leaf: Leaf, settings: WordsFor): string | undefined {
  const { field, value } = leaf
  if (typeCodes.includes(field) && typeof value === 'number') {
    return `${value.toString(16).toUpperCase()}H (${pcTypeCodes.get(value)?.join(' or ') ?? 'not a type code of the manual'})`
  }
  const text = describeValue(leaf, settings)
  if (!isDevice(field)) return text
  const address = value as DeviceAddress
  const real = fromFrame(fx5Windows, address)
  return real === undefined || real.device === address.device
    ? text
    : `${text}, on iQ-F ${formatDevice(real, settings)}`
}

/** Digits of X and Y in ASCII code: as the port is set, else as the profile numbers them. */
export function frameForm({ code, profile, asciiXy }: ExplainSettings): number {
  const octal = asciiXy === undefined ? profile.xyRadix === 8 : asciiXy === 'octal'
  return code === 'ascii' && octal ? FORM_XY_OCTAL : 0
}

/** Data of a request, or of the answer to `request`. */
export function readFrameData(
  explainer: Explainer,
  settings: ExplainSettings,
  command: FrameCommand,
  shape: Shape,
  request?: Message,
): Message {
  const context = request === undefined ? {} : { context: { shape: command.request, message: request } }
  return explainer.read(
    shape,
    (leaf) => describeFrameValue(leaf, settings),
    { form: frameForm(settings), ...context },
    (row, bytes, message) =>
      splitRow(row, bytes, settings, devicesOf(row.name, { shape, message, ...context }, settings)),
  )
}
