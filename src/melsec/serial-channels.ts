// The serial channels of FX5 CPUs and what they keep in special relays and registers, as data (FX5 communication manual 18.3,
// 18.6 and 18.8). All are read only, but for the station number where it is latched.

/** A special device by its number. */
export interface SpecialDevice {
  /** Relay or register. */
  readonly device: 'SM' | 'SD'
  /** Its number. */
  readonly number: number
}

const sm = (number: number): SpecialDevice => ({ device: 'SM', number })
const sd = (number: number): SpecialDevice => ({ device: 'SD', number })

/** Number of a serial channel. */
export type ChannelNumber = 1 | 2 | 3 | 4

/** What a channel tells of itself. */
export interface ChannelDevices {
  /** Is set by an error, and reset by STOP to RUN, power, reset or SM50 only, even when communication is right again. */
  readonly error: SpecialDevice
  /** Code of the last error, as 7001H and 7010H; kept as long as `error` is. */
  readonly errorCode: SpecialDevice
  /** The channel is set to MC protocol. */
  readonly mcProtocol: SpecialDevice
  /** The global signal, by GW of 1C. */
  readonly globalSignal: SpecialDevice
  /** Function of the channel, as it runs. */
  readonly mode: SpecialDevice
}

/** Beside them on FX5 itself. */
export interface Fx5ChannelDevices extends ChannelDevices {
  /** Parameters: b0 data length, b1 and b2 parity, b3 stop bit, b4 to b7 speed, b13 sum check. */
  readonly settings: SpecialDevice
  /** The station number in `station` counts, not the parameter. */
  readonly stationLatched: SpecialDevice
  /** The station number that counts then. */
  readonly station: SpecialDevice
  /** Message format: 0 and 3 formats 1 and 4 with X and Y octal, 4 format 5, 5 and 6 formats 1 and 4 with them hexadecimal. */
  readonly format: SpecialDevice
  /** ms between characters until a message counts as broken off. */
  readonly timeout: SpecialDevice
}

function devicesOf(channel: ChannelNumber): Fx5ChannelDevices {
  const behind = 10 * (channel - 1)
  return {
    error: sm(8500 + behind),
    errorCode: sd(8500 + behind),
    settings: sd(8502 + behind),
    mcProtocol: sm(8503 + behind),
    mode: sd(8503 + behind),
    globalSignal: sm(8680 + behind),
    stationLatched: sm(8740 + behind),
    station: sd(8740 + behind),
    format: sd(8741 + behind),
    timeout: sd(8742 + behind),
  }
}

/** 18.8, devices for FX5. */
const channelDevices: Readonly<Record<ChannelNumber, Fx5ChannelDevices>> = {
  1: devicesOf(1),
  2: devicesOf(2),
  3: devicesOf(3),
  4: devicesOf(4),
}

/** Names that programs of an FX3 know, of one of its two channels. */
export interface Fx3Aliases {
  /** By the channel numbers of an FX3. */
  readonly channels: Readonly<Record<1 | 2, ChannelDevices>>
  /** Where they work. */
  readonly condition: string
  /** Where it is written. */
  readonly source: string
}

/** 18.8, devices compatible with FX3: they show one channel, which the parameter of the channel chooses. */
const fx3Aliases: Fx3Aliases = {
  channels: {
    1: { error: sm(8063), errorCode: sd(8063), mcProtocol: sm(8419), globalSignal: sm(8126), mode: sd(8419) },
    2: { error: sm(8438), errorCode: sd(8438), mcProtocol: sm(8439), globalSignal: sm(8426), mode: sd(8439) },
  },
  condition: 'On the one channel whose "SM/SD for FX3 compatibility" is set, and with 1C frames only.',
  source: 'FX5 communication manual 18.6, footnote *6, and 18.8',
}

/** Which channels a CPU can have. */
export interface CpuChannels {
  /** Name of the CPU module. */
  readonly cpu: string
  /** Those it can have. */
  readonly channels: readonly ChannelNumber[]
  /** So many at the same time. */
  readonly most: number
  /** Where it is written. */
  readonly source: string
}

const source = 'FX5 communication manual 18.3, system configuration'

/** Channel 1 is the built-in RS-485 port, 2 the expansion board, 3 and 4 the adapters from the CPU outwards. */
const cpuChannels: readonly CpuChannels[] = [
  { cpu: 'FX5S', channels: [2, 3, 4], most: 2, source },
  { cpu: 'FX5UJ', channels: [2, 3, 4], most: 2, source },
  { cpu: 'FX5U', channels: [1, 2, 3, 4], most: 4, source },
  { cpu: 'FX5UC', channels: [1, 3, 4], most: 3, source },
]

/** Serial channels and what is known of them. */
export interface SerialChannels {
  /** By CPU module. */
  readonly cpus: readonly CpuChannels[]
  /** What each channel tells of itself. */
  readonly devices: Readonly<Record<ChannelNumber, Fx5ChannelDevices>>
  /** What programs of an FX3 know instead. */
  readonly fx3: Fx3Aliases
  /** Codes in the error register that no NAK carries: the parameters set a channel up twice; parity, overrun or framing. */
  readonly errorCodes: { readonly setUpTwice: number; readonly line: number; readonly source: string }
}

export const fx5Channels: SerialChannels = {
  cpus: cpuChannels,
  devices: channelDevices,
  fx3: fx3Aliases,
  errorCodes: {
    setUpTwice: 0x7001,
    line: 0x7010,
    source: 'FX5 communication manual 47.2, error codes of the CPU module with 1C frames',
  },
}
