// The codes of everything that can fail in a node, and the short text of each.
import type { PlcErrorCode } from '../src/index'
import type { Texts } from './texts'

/** Failures that only nodes know. */
export type NodeErrorCode =
  | 'NOT_CONFIGURED' // settings of the node or its connection
  | 'BAD_INPUT' // the message lacks what the node needs
  | 'READ_BACK' // written and acknowledged, but the PLC holds something else
  | 'UNEXPECTED' // a bug

export type FailureCode = PlcErrorCode | NodeErrorCode

/** Which short text stands for which failure; keys of `status` in the connection's catalogue. */
const FAILURE_TEXTS = {
  BAD_ADDRESS: 'badAddress',
  BAD_TYPE: 'badAddress',
  BAD_VALUE: 'badValue',
  BAD_OPTION: 'badSettings',
  BAD_MESSAGE: 'badInput',
  OUT_OF_RANGE: 'outOfRange',
  LIMIT_EXCEEDED: 'tooMuch',
  UNSUPPORTED: 'unsupported',
  NOT_PERMITTED: 'notAllowed',
  END_CODE: 'endCode',
  TRUNCATED: 'badAnswer',
  TRAILING: 'badAnswer',
  BAD_DIGIT: 'badAnswer',
  BAD_FIELD: 'badAnswer',
  BAD_FRAME: 'badAnswer',
  BAD_SUM: 'badAnswer',
  ECHO_MISMATCH: 'badAnswer',
  UNEXPECTED_ANSWER: 'badAnswer',
  TIMEOUT: 'timeout',
  CONNECT_FAILED: 'notReached',
  DISCONNECTED: 'disconnected',
  ENTRY_BUSY: 'entryBusy',
  PORT_UNAVAILABLE: 'portTaken',
  SILENT: 'silent',
  OFFLINE: 'disconnected',
  CLOSED: 'closed',
  ABORTED: 'closed',
  QUEUE_FULL: 'queueFull',
  OVERLOADED: 'overloaded',
  NOT_VERIFIED: 'notVerified',
  UNFINISHED: 'unfinished',
  NOT_ALL_WRITTEN: 'unfinished',
  NOT_CONFIGURED: 'badSettings',
  BAD_INPUT: 'badInput',
  READ_BACK: 'readBack',
  UNEXPECTED: 'failed',
} as const satisfies Record<FailureCode, string>

/** What a status has room for. */
export function shortText(code: FailureCode, texts: Texts): string {
  return texts(`status.${FAILURE_TEXTS[code]}`)
}

/** Whether what was received is no answer of a PLC. */
export function isBadAnswer(code: FailureCode): boolean {
  return FAILURE_TEXTS[code] === 'badAnswer'
}
