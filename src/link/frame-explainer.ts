import type { FrameExplanation } from '../codec/explanation'

/** What a trace remembers of a frame that was sent. */
export interface SentFrame {
  /** 0 in a frame without one. */
  readonly serial: number
  /** Answers to other requests refer to it (the registration of a monitor). */
  readonly isRegistration: boolean
  /** Something in it may be secret. */
  readonly isSecret: boolean
}

/** The frame at the front of what was received. */
export interface ReceivedFrame {
  readonly used: number
  /** Of the request it answers; `undefined`: it came unasked, so that the request waits on. */
  readonly serial: number | undefined
}

/** Frames that one frame refers to. */
export interface KnownFrames {
  /** The request that it answers. */
  readonly request?: Buffer
  /** The last registration: what a reading of registered devices reads. */
  readonly registration?: Buffer
}

/** How a trace makes sense of what goes over the wire: what a protocol family hands to whoever shows frames to people. */
export interface FrameExplainer {
  /** Whether an answer could hold a secret. */
  readonly hasSecretAnswers: boolean
  /** An answer ends where its request says it ends: with the next request, what came before it is over. */
  readonly endsWithRequest: boolean
  /** `undefined` when the bytes are no request. */
  sent(frame: Buffer): SentFrame | undefined
  /**
   * `undefined` when it is not whole yet.
   * @param request the frame of the request in flight, where answers go by order
   * @throws PlcError when the bytes are no frame
   */
  received(bytes: Buffer, request: Buffer | undefined): ReceivedFrame | undefined
  /** Never throws for what is in the bytes. */
  explain(frame: Buffer, known: KnownFrames): FrameExplanation
}
