// What a PLC refuses before it carries a request out: commands it lacks, limits, devices. From the profile's data.
import type { DataCode } from '../codec/codec'
import { accessProblem } from '../melsec/device/access'
import { deviceInfo } from '../melsec/device/device'
import { brokenLimit } from '../melsec/device/limit'
import { devicesOf, type FoundDevice } from '../melsec/device/uses'
import { isConnectedStation, type Route, stationText } from '../melsec/frame/route'
import { exclusionOf, lackOf, type Profile } from '../melsec/profiles/profile'
import type { ReceivedRequest } from '../melsec/protocol'
import { Refusal, requestErrors } from './refusal'

/** @throws Refusal with the end code a PLC of this family gives. */
export function checkRequest(profile: Profile, code: DataCode, request: ReceivedRequest): void {
  const { name, command, form, message } = request
  const lack = lackOf(profile, name)
  if (lack !== undefined) throw new Refusal(lack.endCode, `${command.title}: ${lack.reason}`)
  if (command.unit !== 'none' && !profile.forms.includes(form)) {
    throw new Refusal(profile.refusals.command, `${command.title}: no such subcommand on this family`)
  }
  const broken = brokenLimit(profile, name, form, code, message)
  if (broken !== undefined) {
    const { limit, measured } = broken
    throw new Refusal(
      limit.endCode,
      `${command.title}: ${measured} ${limit.unit}, allowed are ${limit.min} to ${limit.max}`,
    )
  }
  for (const found of devicesOf(command, message)) checkDevice(profile, request, found)
}

function checkDevice(profile: Profile, { name, command }: ReceivedRequest, { address, use }: FoundDevice): void {
  const info = deviceInfo(address.device)
  if (profile.absentDevices.includes(info.name)) {
    throw new Refusal(profile.refusals.deviceName, `there is no device ${info.name}`)
  }
  if (command.unit === 'bit' && info.unit !== 'bit') {
    throw new Refusal(profile.refusals.bitUnitsOfWordDevice, `${command.title}: ${info.name} is no bit device`)
  }
  const exclusion = exclusionOf(profile, name, info.name)
  if (exclusion !== undefined) throw new Refusal(exclusion.endCode, `${command.title}: ${exclusion.reason}`)
  const problem = accessProblem(address, use)
  if (problem !== undefined) throw new Refusal(accessEndCode(profile, { address, use }), problem.message)
}

/** Which of the manual's restrictions on devices it is. */
function accessEndCode(profile: Profile, { address, use }: Pick<FoundDevice, 'address' | 'use'>): number {
  const info = deviceInfo(address.device)
  const { monitoredContact, device, wholeDevices } = profile.refusals
  if (info.notIn?.includes(use.command) === true) {
    return info.bitBlocksOnly === true ? monitoredContact : device
  }
  if (info.wholeDevices?.includes(use.command) === true) return wholeDevices
  const modified = address.index ?? address.extensionIndex ?? address.indirect
  return modified === undefined ? device : requestErrors.content
}

/** Why a request is not for this PLC, or undefined when it is. */
export function routeRefusal(profile: Profile, route: Route): Refusal | undefined {
  const { station, module } = profile.refusals
  if (!isConnectedStation(route) || route.multidrop !== 0) {
    return new Refusal(station, `no way to network ${route.network}, ${stationText(route).toLowerCase()}`)
  }
  return profile.reach.ownModuleIo.includes(route.moduleIo)
    ? undefined
    : new Refusal(module, `module I/O ${route.moduleIo.toString(16).toUpperCase()} is no CPU here`)
}
