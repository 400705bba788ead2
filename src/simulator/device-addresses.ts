// The addresses that the instruction ADRSET stores for indirect specification (`@D0`). How a CPU codes a device into 32
// bits is in no manual, so these are the simulator's own: numbers without a meaning, valid for the one that gave them.
import { hex } from '../basics/hex'
import type { DeviceAddress, DeviceName } from '../melsec/device/device'
import { Refusal, requestErrors } from './refusal'

/** Neither 0, which a register holds before the program ran, nor a small number that a wrong program may leave there. */
const FIRST = 0x7a3c0001

export class DeviceAddresses {
  readonly #numbers = new Map<string, number>()
  readonly #devices: DeviceAddress[] = []

  /** The address of a device; always the same for the same device. 32 bits. */
  of(device: DeviceName, number: number): number {
    const key = `${device}${number}`
    const known = this.#numbers.get(key)
    if (known !== undefined) return known
    const address = FIRST + this.#devices.push({ device, number }) - 1
    this.#numbers.set(key, address)
    return address
  }

  /** @throws Refusal when this address was never given */
  deviceAt(address: number): DeviceAddress {
    const found = this.#devices[address - FIRST]
    if (found !== undefined) return found
    const shown = hex(address, 8)
    throw new Refusal(requestErrors.content, `indirect specification: ${shown}H is no address that ADRSET has stored`)
  }
}
