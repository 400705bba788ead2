// End codes of refusals that CPU modules of iQ-R, Q and L have in common.
import type { Refusals } from './profile'

/** Those of the devices and of what an extension names differ. */
export const cpuRefusals: Omit<Refusals, 'deviceName' | 'device' | 'extension' | 'source'> = {
  deviceNumber: 0x4031,
  extendedDeviceName: 0xc05b,
  bitUnitsOfWordDevice: 0xc05c,
  command: 0xc059,
  monitorNotRegistered: 0xc05d,
  length: 0xc061,
  notInStop: 0x4013,
  remote: 0x408b,
  monitoredContact: 0x4032,
  wholeDevices: 0xc051,
  bufferMemory: 0x4041,
  station: 0x4b00,
  module: 0x4b02,
}
