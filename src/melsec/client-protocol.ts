// What a client needs of a protocol: the SLMP command set in whatever frame. No client knows what stands in a head.
import type { DataCode } from '../codec/codec'
import type { ProtocolError } from '../errors'
import type { AnswerFraming, Exchange, FrameExplainer, RequestFrame } from '../link/link'
import type { Command, RequestOf, ResponseOf } from './commands/command'
import type { DeviceForm } from './device/device-form'
import type { FrameName } from './frame/frames'
import type { Route } from './frame/route'
import type { SerialHead } from './frame/serial-frames'
import type { SerialFrameOptions } from './frame/serial-framing'
import type { LineCost } from './line-cost'
import type { Profile } from './profiles/profile'
import type { ExchangeOptions } from './protocol'

/** How a client speaks to its PLC. */
export interface ProtocolOptions {
  readonly frame: FrameName
  readonly code: DataCode
  readonly profile: Profile
  readonly route: Route
  /** Monitoring timer in units of 250 ms. */
  readonly timer: number
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
  readonly asciiZr?: 'decimal' | 'hexadecimal' | undefined
  /** Of a serial frame; needed by it, and of no meaning to others. */
  readonly serial?: SerialProtocolOptions | undefined
}

/** What serial frames need beside what every frame does. */
export interface SerialProtocolOptions extends Omit<SerialFrameOptions, 'frame'> {
  /** Where requests go: instead of `route`. */
  readonly head: SerialHead
  /** 1C: ms before the PLC answers at the earliest, 0 to 150 in steps of 10. */
  readonly messageWait: number
  /** Waits of each request in which the line carries nothing, as bytes that it could carry; default 0. */
  readonly turnRound?: number
}

/** A frame that came unasked. */
export interface UnaskedFrame {
  readonly route: Route
  /** The data of On-demand, low byte of each word first; or why it is none that can be read. */
  readonly data: Buffer | ProtocolError
}

/** How addresses and devices are shown in explanations; default: as the profile has it. */
export interface ShownAs {
  readonly xyRadix?: 8 | 16
  readonly wRadix?: 10 | 16
}

export interface ClientProtocol {
  readonly framing: AnswerFraming
  readonly profile: Profile
  readonly code: DataCode
  /**
   * A request ready to be sent: to the station of the route, or to the connected one where its declaration says so.
   * @throws RequestError with what is wrong, where, and what to do
   */
  exchange<C extends Command>(command: C, message: RequestOf<C>, options?: ExchangeOptions): Exchange<ResponseOf<C>>
  /**
   * Refuses what `exchange` would refuse, as far as addresses and limits go, without making the request.
   * @throws RequestError as `exchange`
   */
  check<C extends Command>(command: C, message: RequestOf<C>): void
  /** Bytes of the bodies of a request in this form and of a success, without writing them. */
  bodyBytes<C extends Command>(command: C, message: RequestOf<C>, form: DeviceForm): number
  /** Where every byte takes time; absent where a request costs the same whatever it carries. */
  readonly lineCost?: LineCost | undefined
  /** The command as the frame says it, with its number, as people find it in the manual: `Read Type Name (0101)`. */
  nameOf(command: Command): string
  /** Turns the global signal of the station on or off, or that of all on the line; absent where there is none. */
  readonly globalSignal?: (on: boolean, to: 'station' | 'all') => Exchange<unknown>
  /** Reads a frame that came unasked; absent where none ever does. */
  readonly readUnasked?: (frame: RequestFrame) => UnaskedFrame
  /** Bytes of the frame of an answer with this body. */
  answerBytes(body: number): number
  explainer(shownAs: ShownAs): FrameExplainer
}
