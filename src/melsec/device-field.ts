import type { Field } from '../codec/codec'
import { aCompatibleDevice } from './a-compatible/device'
import { deviceAddress } from './device/codec'
import { longDevice, shortDevice } from './one-c/device'

/** The codecs of an address: one of SLMP, one of 1E, two of 1C. */
const codecs: readonly unknown[] = [deviceAddress, aCompatibleDevice, shortDevice, longDevice]

/** Whether a field is the address of a device. */
export function isDevice(field: Field | undefined): boolean {
  return field?.kind === 'value' && codecs.includes(field.codec)
}
