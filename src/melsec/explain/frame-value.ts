// Values of 1E and 1C frames in words: there some devices go by other names than those of the PLC.
import type { Leaf } from '../../codec/explanation'
import { aCompatibleCommands } from '../a-compatible/commands'
import { pcTypeCodes } from '../a-compatible/type-code'
import { fromFrame, fx5Windows } from '../a-compatible/windows'
import { formatDevice } from '../device/address'
import type { DeviceAddress } from '../device/device'
import { isDevice } from '../device-field'
import { oneCCommands } from '../one-c/commands'
import { describeValue, type WordsFor } from './values'

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
