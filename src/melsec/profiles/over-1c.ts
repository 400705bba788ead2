// What is left of a profile when its PLC is spoken to in 1C frames.
import type { PointLimit } from '../a-compatible/device-rules'
import { isSaid, type SaidName } from '../a-compatible/names'
import { over1c } from '../one-c/names'
import { oneCLimitSource, oneCLimits, oneCRules } from '../one-c/rules'
import { contactsInWords, narrowed } from './over-other-set'
import type { Profile, Refusals } from './profile'

/** Error codes of NAK (FX5 communication manual 47.2). */
const PROTOCOL = 0x03
const CHARACTERS = 0x06
const PC_NUMBER = 0x10
const REMOTE = 0x18
const source = oneCLimitSource

/** The limits by the names of the SLMP set. The commands with more digits have those of their brothers. */
const limits = Object.entries(over1c).flatMap(([name, [first]]): PointLimit<SaidName>[] =>
  isSaid(name)
    ? oneCLimits.flatMap(({ command, of, max }) => (command === first ? [{ command: name, of, max }] : []))
    : [],
)

const refusals: Refusals = {
  deviceNumber: CHARACTERS,
  deviceName: CHARACTERS,
  extendedDeviceName: CHARACTERS,
  bitUnitsOfWordDevice: CHARACTERS,
  extension: CHARACTERS,
  command: PROTOCOL,
  monitorNotRegistered: PROTOCOL,
  length: CHARACTERS,
  notInStop: REMOTE,
  remote: REMOTE,
  device: CHARACTERS,
  monitoredContact: CHARACTERS,
  wholeDevices: CHARACTERS,
  bufferMemory: CHARACTERS,
  station: PC_NUMBER,
  module: PC_NUMBER,
  source: 'FX5 communication manual 47.2, NAK codes of the 1C frame',
}

/** The windows of 1E and 1C are the same (44.4 and 39.2). */
export function windowsOver1c({ aCompatible }: Profile) {
  return aCompatible?.windows ?? []
}

/** The profile of the same PLC over 1C. */
export function profileOver1c(serial: Profile): Profile {
  return {
    ...narrowed(serial, {
      frame: '1C',
      instead: 'Use a 3C or 4C frame if the PLC takes it.',
      windows: windowsOver1c(serial),
      limits,
      exclusions: [
        ...contactsInWords(CHARACTERS, source),
        {
          commands: ['readWords', 'writeWords', 'writeRandomWords'],
          devices: ['LCN'],
          endCode: CHARACTERS,
          reason: `LCN ${oneCRules.noPairs}`,
          instead: 'Its contact LCS is there.',
          source: `${source}: each is two words, in an order that is not printed`,
        },
      ],
      endCodes: { command: PROTOCOL, points: CHARACTERS },
      source,
    }),
    title: `${serial.title} in a 1C frame`,
    codes: ['ascii'],
    code: 'ascii',
    refusals,
  }
}
