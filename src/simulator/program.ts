// What a program has of a simulated PLC: the sides of its parts that are for users. A process that is simulated, or a test,
// reads and writes by them. Nothing is sent.
import type { CommandName } from '../melsec/commands/commands'
import type { DeviceName } from '../melsec/device/device'
import type { PlcValue, ValueFormat, ValueOf } from '../value/value'
import type { CpuState, Hold, SwitchPosition } from './cpu'
import type { LoggedError } from './error-log'
import type { FaultAction } from './fault-kinds'
import type { ActiveFault, AnyAction, Fault } from './faults'
import type { OpenFile } from './files'

/**
 * Device memory as a program in the PLC sees it: no limit but the ranges of the profile applies.
 * Every method throws RequestError: BAD_ADDRESS, BAD_TYPE, BAD_VALUE, or OUT_OF_RANGE for a device that is not there.
 */
export interface ProgramMemory {
  /** The word of a word device, 0 to 65535, or of 16 bit devices. */
  word(device: DeviceName, number: number): number
  /** Sets the word of a word device, or 16 bit devices, to 0 to 65535. */
  setWord(device: DeviceName, number: number, value: number): void
  /** Whether a bit device is on. A bit of a word is reached by `get('D100.F')`. */
  bit(device: DeviceName, number: number): boolean
  /** Switches a bit device on or off. */
  setBit(device: DeviceName, number: number, value: boolean): void
  /**
   * The value at an address. Without a type: BOOL of a bit device or a bit of a word, DINT of a double-word device, INT.
   * @example memory.get('D100', 'REAL'); memory.get('M0'); memory.get('D100.F'); memory.get('K4M0')
   */
  get<T extends string>(address: string, type: T, format?: ValueFormat): ValueOf<T>
  /** The same for a type that is known at run time only. */
  get(address: string, type?: string, format?: ValueFormat): PlcValue
  /** Writes the value; all of it or, when it is refused, nothing. */
  set(address: string, type: string, value: PlcValue, format?: ValueFormat): void
  /**
   * As `get`, with the type in the text.
   * @example memory.read('D100:REAL')
   */
  read(item: string, format?: ValueFormat): PlcValue
  /**
   * As `set`, with the type in the text.
   * @example memory.write('D100:REAL', 1.5)
   */
  write(item: string, value: PlcValue, format?: ValueFormat): void
  /**
   * The address of a word device, as the instruction ADRSET gives it, for indirect specification: `@D0` reaches what
   * the address in D0 and D1 says. 32 bits without a meaning of their own, valid in this simulated PLC only.
   */
  addressOf(source: string): number
  /**
   * The instruction ADRSET: stores the address of `source` in two words, low word first.
   * @example memory.adrset('D100', 'D0') // a client's @D0 is D100 from now on
   */
  adrset(source: string, destination: string): void
  /** Sets devices to 0: those that are not latched, or all (default) but the special relays and registers. */
  clear(scope?: 'unlatched' | 'all'): void
}

/** Global labels as a program in the PLC sees them. */
export interface ProgramLabels {
  /** The value of a label or element; of an array named without an index its first element. @throws RequestError BAD_ADDRESS */
  get(name: string): PlcValue
  /** Sets a label or element; from an element of an array on also several. @throws RequestError BAD_ADDRESS, BAD_OPTION, BAD_VALUE */
  set(name: string, value: PlcValue | readonly PlcValue[]): void
}

/** Files as a program in the PLC sees them: no locks, no passwords. Names do not distinguish capital letters. */
export interface ProgramFiles {
  /** Files that clients have open, and so locked. */
  readonly open: readonly OpenFile[]
  /**
   * Content of a file; undefined when there is none of this name.
   * @throws RequestError OUT_OF_RANGE no such drive, BAD_VALUE no file name
   * @example plc.files.read(4, 'LINE.CSV')?.toString()
   */
  read(drive: number, name: string): Buffer | undefined
  /**
   * Makes a file, or replaces the one there is, whoever has it open. Text is written in UTF-8.
   * @throws RequestError OUT_OF_RANGE no such drive or no room, BAD_VALUE no file name or no such directory
   * @example plc.files.write(4, 'LINE.CSV', 'Product,Minutes\r\nA,15\r\n')
   */
  write(drive: number, name: string, data: string | Uint8Array): void
}

/** RUN, STOP and PAUSE of the simulated CPU. */
export interface SimulatedCpu {
  /** What it does now, by its switch and by remote control. */
  readonly state: CpuState
  /** The switch on the module. Remote RUN does not go beyond STOP of the switch. @throws RequestError BAD_OPTION */
  switch: SwitchPosition
  /** The remote STOP or PAUSE in force, also while the switch is at STOP. */
  readonly hold: Hold | undefined
  /** Remote STOP by another device, whose name you choose: others cannot start the CPU without force then. */
  stop(owner: string): void
}

/** The error LED of the port and what lit it. */
export interface SimulatedErrors {
  /** On since an error, until Clear Error or a restart. */
  readonly led: boolean
  /** The latest 64 errors, oldest first. */
  readonly entries: readonly LoggedError[]
  /** Clear Error: the LED goes out and the codes are forgotten. */
  clear(): void
}

/** The fault switches of a simulated PLC. Several may be on; of one kind the first that fits strikes. */
export interface FaultSwitches<Name extends string = CommandName, Action extends AnyAction = FaultAction> {
  /** The faults that are on. */
  readonly active: readonly Fault<Name, Action>[]
  /** Switches a fault on. @throws RequestError BAD_OPTION */
  add(fault: Fault<Name, Action>): ActiveFault<Name, Action>
  /** Switches everything off. */
  clear(): void
}
