// What a frame is to the session and the responder: no protocol, no I/O.
import type { PlcError } from '../errors'
import type { RoundTrips } from './round-trips'
import type { Scheduled } from './scheduler'

/**
 * What stands around the body, as numbers by the manuals' names: the route, a command number. Only the protocol that made
 * a head looks at what is in it; whoever carries frames does not.
 */
export type Head = Readonly<Record<string, number | undefined>>

/** A frame that carries a request, as the responder sees it. */
export interface RequestFrame<H = Head> {
  readonly head: H
  /** Serial number, where the frame has one. */
  readonly serial: number | undefined
  readonly body: Buffer
}

/** A frame that carries an answer, as the session sees it. */
export interface ResponseFrame<H = Head> {
  readonly head: H
  readonly serial: number | undefined
  /** 0 is success. */
  readonly endCode: number
  /** Response data, or with an end code other than 0 what the frame says about the error. */
  readonly body: Buffer
}

/** One frame found at the start of the bytes. */
export interface Scanned<Frame> {
  /** Bytes to take away from the front. */
  readonly used: number
  readonly frame: Frame
  /**
   * What some PLCs send behind this frame and others do not, where frames carry no length. It means nothing, no frame
   * begins like it, and over a stream it may come later than the frame.
   */
  readonly mayFollow?: Buffer
  /** More bytes behind it would show that it is another frame, damaged: it counts once the line is silent, where lines have noise. */
  readonly endsWithSilence?: true
  /** Whatever stands behind it in the same datagram means nothing; over a stream it is somebody's. */
  readonly surplus?: true
}

/**
 * The length of the body, for frames that carry none (1E, Sharp JW): asked with the head and the body's bytes so far.
 * `undefined` means: more bytes are needed to tell.
 */
export type BodyLength<H = Head> = (head: H, soFar: Buffer) => number | undefined

/**
 * How what a PLC sends is found among the bytes. The scans have three answers: a frame; `undefined` when more bytes are
 * needed; a thrown `ProtocolError` when the bytes are no such frame. They never change the bytes and never keep them.
 */
export interface AnswerFraming<H = Head> {
  readonly name: string
  /** How an answer finds its request: by a serial number in the frame, or only by the order of arrival. */
  readonly correlation: 'serial' | 'order'
  /** On a line that is no connection: what ends whatever the peer was asked, so that no answer to it comes any more; empty: nothing does, but time. */
  readonly recovery?: Buffer
  readonly request: {
    /** As `response.noise`, for the PLC's side. */
    noise?(bytes: Buffer): number
    scan(bytes: Buffer, bodyLength: BodyLength<H>): Scanned<RequestFrame<H>> | undefined
  }
  readonly response: {
    /**
     * Where lines have noise: bytes at the front that can be no frame and are thrown away; 0 when a frame begins there,
     * or may begin.
     */
    noise?(bytes: Buffer): number
    scan(bytes: Buffer, bodyLength: BodyLength<H>): Scanned<ResponseFrame<H>> | undefined
    /**
     * Whether a frame in the place of an answer is one the PLC sends unasked (On-demand). Such frames have the form
     * of a request, so `request.scan` reads them.
     */
    isUnsolicited?(bytes: Buffer): boolean
  }
}

/** The layout of a frame around its body: four pure functions. */
export interface Framing<H> extends AnswerFraming<H> {
  readonly request: AnswerFraming<H>['request'] & {
    write(head: H, serial: number, body: Uint8Array): Buffer
  }
  readonly response: AnswerFraming<H>['response'] & {
    write(head: H, serial: number, endCode: number, body: Uint8Array): Buffer
  }
  /** What of the head the answer must repeat and does not, in words; `undefined` when it is the answer's head. */
  mismatch(asked: H, answered: Head): string | undefined
}

/** A question as a frame, and how its answer is known. */
export interface Question {
  /** The frame, with this serial number where the frame has one. */
  write(serial: number): Buffer
  /** Length of the answer's body, asked only by frames that carry none. */
  readonly responseLength: BodyLength
  /** What of its head the answer must repeat and does not, in words; `undefined` when it is the answer's head. */
  mismatch(answered: Head): string | undefined
}

/** A request on its way: what the session needs to know about it. */
export interface Job extends Question, Scheduled {
  /** Of the PLC it goes to, where several share a session; default: the session's. */
  readonly roundTrips?: RoundTrips | undefined
  /** Absolute time, on the clock the session is given, after which nobody waits any more. */
  readonly deadline: number
  /** ms it was given in all, waiting included: once sent it may use at least a share of it (`SHARE` in allowance.ts). */
  readonly allowance?: number
  /** ms that the characters of request and answer take on a slow line: round trips are counted without them. */
  readonly lineTime?: number | undefined
  /** ms that the PLC is told to wait before it answers (message wait of the serial frames). */
  readonly answerDelay?: number | undefined
  /** Sent although nothing proves that earlier answers are not still on their way (see `Fence`): a locked PLC echoes nothing. */
  readonly needsNoProof?: boolean
}

/** How a job ended. */
export type JobEnd =
  | { readonly kind: 'answered'; readonly frame: ResponseFrame; readonly at: number }
  /** `isSilent`: not a byte of an answer came within the time that one may take. */
  | { readonly kind: 'timedOut'; readonly sent: boolean; readonly isSilent?: true }
  | { readonly kind: 'disconnected'; readonly sent: boolean }
  /** Not sent: what must come back before it, so that its answer can be known (see `Fence`), did not in time. */
  | { readonly kind: 'unproved' }
  /** Not sent: too late for an answer before its deadline. `waiting`: requests that wait, itself included. */
  | { readonly kind: 'tooLate'; readonly waiting: number; readonly roundTrip: number | undefined }
  | { readonly kind: 'failed'; readonly error: PlcError }

/** What a session tells its owner. */
export type SessionEvent<J extends Job = Job> =
  | {
      readonly kind: 'done'
      readonly job: J
      readonly outcome: JobEnd
      readonly sentAt: number | undefined
    }
  | { readonly kind: 'unsolicited'; readonly frame: RequestFrame }
  /** An answer to a request that was given up: thrown away. */
  | { readonly kind: 'stale'; readonly serial: number | undefined }
  /** Thrown away: noise, or while a fence is asked for an answer to anything else. It does not show that the peer takes requests. */
  | { readonly kind: 'stray' }
  /** The connection must be dropped: what arrives on it can no longer be attributed. */
  | { readonly kind: 'drop'; readonly error: PlcError }
  /** Datagrams without a serial number or a fence: the next request must leave from a new local port. */
  | { readonly kind: 'renew'; readonly reason: 'answered' | 'givenUp' }
