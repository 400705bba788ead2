// The public names of this room.

export type { EndCodeExplanation } from './end-code-explanation'
export {
  type Codes,
  type EndCodeFacts,
  type EndCodeTable,
  each,
  endCodeFacts,
  endedWith,
  type RefusalFacts,
} from './end-code-facts'
export { answerBytes, type Envelope, type Exchange, framed, type OfFrame } from './exchange'
export { type Echo, Fence, type FenceOptions } from './fence'
export type { FrameExplainer, KnownFrames, ReceivedFrame, SentFrame } from './frame-explainer'
export type {
  AnswerFraming,
  BodyLength,
  Framing,
  Head,
  Job,
  JobEnd,
  Question,
  RequestFrame,
  ResponseFrame,
  Scanned,
  SessionEvent,
} from './framing'
export { type Front, HeadProtocol, type HeadProtocolParts, type NamedCommand } from './head-protocol'
export type { Echoing } from './own-echo'
export { Recovery, type RecoveryOptions } from './recovery'
export { Responder } from './responder'
export { RoundTrips } from './round-trips'
export { PRIORITIES, type Priority, type Scheduled, Scheduler } from './scheduler'
export { SerialNumbers } from './serial-numbers'
export { type Done, type Sent, Session, type SessionOptions } from './session'
