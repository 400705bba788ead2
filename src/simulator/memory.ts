// Device memory of the simulated PLC, with the ranges of its profile.
import { type DeviceAddress, type DeviceExtension, type DeviceName, deviceInfo, devices } from '../melsec/device/device'
import type { Profile } from '../melsec/profiles/profile'
import { DeviceAddresses } from './device-addresses'
import { Refusal } from './refusal'
import {
  devicesOfDoubleWord,
  devicesOfWords,
  makeCells,
  type Place,
  type Region,
  readDoubleWord,
  readWord,
  writeDoubleWord,
  writeWord,
} from './region'

/** Memory outside the CPU's own devices. Without it, such addresses are refused as on a PLC without the module. */
export interface ExtensionMemory {
  /** Modules with buffer memory: `{ unit: 3, points: 4096 }` is `U3\G0` to `U3\G4095` (start I/O number 0030). */
  readonly modules?: readonly {
    readonly unit: number
    readonly points: number
    /** Model of a MELSEC-Q module, e.g. `Q62DA`: Extend Unit (0601, 1601) reaches it, too. */
    readonly model?: string
    /** Module No. on slot 0, where the manual does not say it. */
    readonly slot0?: number
  }[]
  /** Networks: `{ network: 1, points: { W: 8192 } }` is `J1\W0` to `J1\W1FFF`. */
  readonly networks?: readonly {
    readonly network: number
    readonly points: Readonly<Partial<Record<DeviceName, number>>>
  }[]
  /** Buffer memory of the CPUs: `G`, and `HG` of the fixed scan communication area (iQ-R). */
  readonly cpus?: readonly {
    readonly cpu: 1 | 2 | 3 | 4
    readonly points: Readonly<Partial<Record<'G' | 'HG', number>>>
  }[]
}

/** Devices that show another's cells: direct access. */
const ALIASES: Readonly<Partial<Record<DeviceName, DeviceName>>> = { DX: 'X', DY: 'Y' }

/** What a device is counted in when a range is checked. */
export type AccessUnit = 'bit' | 'word' | 'doubleWord'

/**
 * The wire's side of the memory: addresses as the commands carry them. Everything is checked before anything is
 * written; what cannot be throws a `Refusal` with the end code of the profile.
 */
export class DeviceMemory {
  readonly #profile: Profile
  readonly #regions = new Map<string, Region>()
  readonly #addresses = new DeviceAddresses()

  constructor(profile: Profile, latch: readonly DeviceName[], extensions: ExtensionMemory = {}) {
    this.#profile = profile
    this.#addDevices(latch)
    this.#addExtensions(extensions)
  }

  readBits(head: DeviceAddress, points: number): boolean[] {
    const { region, start } = this.place(head, 'bit', points)
    const values = new Array<boolean>(points)
    for (let i = 0; i < points; i++) values[i] = region.cells[start + i] === 1
    return values
  }

  writeBits(head: DeviceAddress, values: ArrayLike<boolean>): void {
    const { region, start } = this.place(head, 'bit', values.length)
    for (let i = 0; i < values.length; i++) region.cells[start + i] = values[i] === true ? 1 : 0
  }

  readWords(head: DeviceAddress, points: number): number[] {
    const place = this.place(head, 'word', points)
    const values = new Array<number>(points)
    for (let i = 0; i < points; i++) values[i] = readWord(place, i)
    return values
  }

  writeWords(head: DeviceAddress, values: ArrayLike<number>): void {
    const place = this.place(head, 'word', values.length)
    for (let i = 0; i < values.length; i++) writeWord(place, i, values[i] ?? 0)
  }

  readDoubleWord(address: DeviceAddress): number {
    return readDoubleWord(this.place(address, 'doubleWord', 1))
  }

  writeDoubleWord(address: DeviceAddress, value: number): void {
    writeDoubleWord(this.place(address, 'doubleWord', 1), value)
  }

  /**
   * The address by which indirect specification reaches a device.
   * @throws Refusal when it is not there
   */
  addressOf(address: DeviceAddress): number {
    const { region, start } = this.place(address, 'word', 1)
    return this.#addresses.of(region.info.name, start)
  }

  /**
   * Where the devices are.
   * @throws Refusal when one of them is not there
   */
  place(address: DeviceAddress, unit: AccessUnit, points: number): Place {
    if (address.indirect === true) return this.place(this.#indirect(address), unit, points)
    const region = this.#regionOf(address)
    const start = address.number + (address.index === undefined ? 0 : this.#indexValue(address.index))
    const count =
      unit === 'bit' ? points : unit === 'word' ? devicesOfWords(region, points) : devicesOfDoubleWord(region)
    if (start < 0 || start + count > region.cells.length) {
      const { kind = 'link' } = address.extension ?? {}
      const { deviceNumber, bufferMemory } = this.#profile.refusals
      const endCode = kind === 'link' ? deviceNumber : bufferMemory
      throw new Refusal(
        endCode,
        `${address.device}${start} to ${start + count - 1} is beyond the range of ${region.cells.length} points`,
      )
    }
    return { region, start }
  }

  /** Sets devices to 0: those that are not latched, or all. Special relays and registers are the system's. */
  clear(scope: 'unlatched' | 'all'): void {
    for (const region of this.#regions.values()) {
      if (region.info.name === 'SM' || region.info.name === 'SD') continue
      if (scope === 'all' || !region.latched) region.cells.fill(0)
    }
  }

  #regionOf(address: DeviceAddress): Region {
    const { device, extension } = address
    const region = this.#regions.get(
      extension === undefined ? device : keyOf(device, this.#indexed(address, extension)),
    )
    if (region !== undefined) return region
    const { deviceName, extension: notThere } = this.#profile.refusals
    throw extension === undefined
      ? new Refusal(deviceName, `there is no device ${device}`)
      : new Refusal(notThere, `there is no ${device} behind ${JSON.stringify(extension)}`)
  }

  /** `@D0`: D0 and D1 hold the address, low word first; `@(D0)Z4`: the two words behind D0 by Z4. */
  #indirect({ indirect: _, ...holder }: DeviceAddress): DeviceAddress {
    return this.#addresses.deviceAt(this.readDoubleWord(holder))
  }

  /** `J1Z0\W0`, `U3Z0\G0`: the register is added to the network or the upper digits of the start I/O number. */
  #indexed({ extensionIndex }: DeviceAddress, extension: DeviceExtension): DeviceExtension {
    if (extensionIndex === undefined) return extension
    const added = this.#indexValue(extensionIndex)
    if (extension.kind === 'link') return { kind: 'link', network: extension.network + added }
    return extension.kind === 'module' ? { kind: 'module', unit: extension.unit + added } : extension
  }

  #indexValue({ register, number }: { readonly register: 'Z' | 'LZ'; readonly number: number }): number {
    const at: DeviceAddress = { device: register, number }
    if (register === 'LZ') return this.readDoubleWord(at) | 0
    return ((this.readWords(at, 1)[0] ?? 0) << 16) >> 16
  }

  #addDevices(latch: readonly DeviceName[]): void {
    const { ranges } = this.#profile
    const points = { ...ranges.simulated, ...ranges.points }
    for (const info of devices) {
      const count = points[info.name] ?? 0
      if (info.extensionOnly === true || count === 0 || this.#profile.absentDevices.includes(info.name)) continue
      const alias = this.#regions.get(ALIASES[info.name] ?? '')
      const cells = alias === undefined ? makeCells(info, count) : alias.cells.subarray(0, count)
      this.#regions.set(info.name, { info, cells, latched: latch.includes(info.name) })
    }
    this.#shareFileRegisters(points, latch)
    this.#joinLongTimers()
  }

  /** R is the first block of ZR; either may be the longer one here. */
  #shareFileRegisters(points: Readonly<Partial<Record<DeviceName, number>>>, latch: readonly DeviceName[]): void {
    if (!this.#regions.has('R') || !this.#regions.has('ZR')) return
    const cells = new Uint16Array(Math.max(points.R ?? 0, points.ZR ?? 0))
    for (const name of ['R', 'ZR'] as const) {
      const latched = latch.includes('R') || latch.includes('ZR')
      this.#regions.set(name, { info: deviceInfo(name), cells: cells.subarray(0, points[name]), latched })
    }
  }

  #joinLongTimers(): void {
    for (const group of ['LT', 'LST'] as const) {
      const region = this.#regions.get(`${group}N`)
      if (region === undefined) continue
      const coil = this.#regions.get(`${group}C`)
      this.#regions.set(`${group}N`, { ...region, coil, contact: this.#regions.get(`${group}S`) })
    }
  }

  #addExtensions({ modules = [], networks = [], cpus = [] }: ExtensionMemory): void {
    for (const { unit, points } of modules) this.#addExtension({ kind: 'module', unit }, 'G', points)
    for (const { network, points } of networks)
      for (const { name } of devices) this.#addExtension({ kind: 'link', network }, name, points[name])
    for (const { cpu, points } of cpus)
      for (const name of ['G', 'HG'] as const) this.#addExtension({ kind: 'cpu', cpu }, name, points[name])
  }

  #addExtension(extension: DeviceExtension, device: DeviceName, points: number | undefined): void {
    if (points === undefined || !this.#profile.extensions.includes(extension.kind)) return
    const info = deviceInfo(device)
    this.#regions.set(keyOf(device, extension), { info, cells: makeCells(info, points), latched: false })
  }
}

function keyOf(device: DeviceName, extension: DeviceExtension): string {
  switch (extension.kind) {
    case 'link':
      return `J${extension.network}\\${device}`
    case 'module':
      return `U${extension.unit}\\${device}`
    case 'cpu':
      return `CPU${extension.cpu}\\${device}`
    default:
      return extension satisfies never
  }
}
