// Every way a simulated PLC can misbehave, as one table: the switches, the command line and the documentation read it.

/** A parameter that is a whole number. */
export interface NumberParameter {
  /** What it is, in English. */
  readonly title: string
  /** The least it can be. */
  readonly min: number
  /** The most it can be. */
  readonly max?: number
  /** Without it the parameter must be given. */
  readonly default?: number
}
/** A parameter that is one of some texts. */
export interface ChoiceParameter {
  /** What it is, in English. */
  readonly title: string
  /** What it can be. */
  readonly oneOf: readonly string[]
  /** What it is when it is left out. */
  readonly default: string
}
/** A parameter of a fault: a number, or one of some texts. */
export type FaultParameter = NumberParameter | ChoiceParameter

/** What is known of a kind of fault. */
export interface FaultDescription {
  /** What happens, in English. */
  readonly title: string
  /** What can be said beside the kind, by name. */
  readonly parameters: Readonly<Record<string, FaultParameter>>
}

const pause = { title: 'ms between the pieces', min: 0, default: 5 } as const
const how = { title: 'FIN, or RST that loses what is under way', oneOf: ['close', 'reset'], default: 'reset' } as const
const damage = {
  what: { title: 'what becomes of it', oneOf: ['lost', 'doubled', 'changed'], default: 'changed' },
  at: { title: 'which, counted from 0; the last one where there are not so many', min: 0, default: 3 },
  mask: { title: 'changed: bits that are inverted', min: 1, max: 0xff, default: 1 },
} as const

const rows = {
  silence: { title: 'The request is lost: not carried out, not answered', parameters: {} },
  drop: { title: 'The answer is lost: carried out, not answered', parameters: {} },
  delay: {
    title: 'Carried out at once, answered later; answers behind it on the connection wait',
    parameters: { ms: { title: 'ms', min: 0 } },
  },
  late: {
    title: 'The answer is held back until another request comes',
    parameters: {
      until: {
        title: 'sent before or after the answer to that request',
        oneOf: ['request', 'answer'],
        default: 'request',
      },
    },
  },
  duplicate: {
    title: 'The answer is sent more than once',
    parameters: { copies: { title: 'extra ones', min: 1, default: 1 } },
  },
  merge: { title: 'Two answers (or an answer and its duplicate) arrive in one piece', parameters: {} },
  split: {
    title: 'The answer arrives in two pieces',
    parameters: { at: { title: 'bytes of the first piece', min: 1 }, pause },
  },
  dribble: {
    title: 'The answer arrives in small pieces',
    parameters: { size: { title: 'bytes of a piece', min: 1, default: 1 }, pause: { ...pause, default: 1 } },
  },
  cut: {
    title: 'The rest of the answer never arrives',
    parameters: { at: { title: 'bytes that arrive', min: 1 } },
  },
  disconnect: {
    title: 'The connection ends within the answer',
    parameters: { at: { title: 'bytes that arrive before', min: 0, default: 0 }, how },
  },
  garbage: {
    title: 'Bytes that belong to no frame',
    parameters: {
      bytes: { title: 'how many', min: 1, default: 8 },
      place: { title: 'where', oneOf: ['before', 'after', 'instead'], default: 'before' },
    },
  },
  wrongSerial: {
    title: 'The answer has another serial number (4E only)',
    parameters: { add: { title: 'added to the serial number', min: 1, max: 0xffff, default: 1 } },
  },
  wrongRoute: {
    title: 'The answer comes from another station',
    parameters: {
      network: { title: 'network', min: 0, max: 255, default: 1 },
      station: { title: 'station', min: 0, max: 255, default: 2 },
    },
  },
  endCode: {
    title: 'Not carried out, refused',
    parameters: { endCode: { title: 'end code', min: 1, max: 0xffff } },
  },
  otherHeader: {
    title:
      'The answer has another header than the request: none where it has one, 40 bytes 00 where it has none (Sharp JW)',
    parameters: {},
  },
  shortError: {
    title: 'Refusals carry less than the whole error information',
    parameters: { bytes: { title: 'bytes of it that are left', min: 0, default: 0 } },
  },
  coalesce: {
    title:
      'Of requests that arrive together, or while one is waiting, only the last is carried out and answered (FX5U)',
    parameters: { window: { title: 'ms a request waits for the next one', min: 1, default: 5 } },
  },
  damaged: { title: 'A character (byte) of the answer is lost, doubled or changed', parameters: damage },
  misheard: {
    title: 'A character of the request arrives lost, doubled or changed (serial lines)',
    parameters: damage,
  },
  wrongSum: { title: 'The sum check code of the answer is wrong (serial lines)', parameters: {} },
  noise: {
    title: 'Bytes of any value some time after the answer was due',
    parameters: {
      bytes: { title: 'how many', min: 1, max: 4096, default: 3 },
      ms: { title: 'ms after the answer was due', min: 0, default: 5 },
      seed: { title: 'other ones for each number', min: 0, max: 0xffff_ffff, default: 1 },
    },
  },
  closeOnAccept: {
    title: 'A connection is accepted and ended at once, as when all entries are taken',
    parameters: { how: { ...how, default: 'close' } },
  },
} as const satisfies Readonly<Record<string, FaultDescription>>

type Kinds = typeof rows
/** Ways in which a simulated PLC can misbehave. */
export type FaultKind = keyof Kinds

/**
 * Every kind of fault. `times` and the commands a fault is for are in `FaultAim`. On UDP a piece is a datagram.
 */
export const faultKinds: Readonly<Record<FaultKind, FaultDescription>> = rows

/** Kinds that are about something MELSEC frames do not have. */
const onlyJw = ['otherHeader'] as const satisfies readonly FaultKind[]
/** Kinds that are about something messages of a Sharp JW do not have: serial numbers, stations, error information, sums. */
const onlyMelsec = [
  'wrongSerial',
  'wrongRoute',
  'shortError',
  'misheard',
  'wrongSum',
] as const satisfies readonly FaultKind[]

/** Ways in which a simulated MELSEC PLC can misbehave. */
export type MelsecFaultKind = Exclude<FaultKind, (typeof onlyJw)[number]>
/** Ways in which a simulated Sharp JW can misbehave. */
export type JwFaultKind = Exclude<FaultKind, (typeof onlyMelsec)[number]>

/** Kinds that a family of PLCs does not have. */
export const absentFaults: Readonly<Record<'melsec' | 'jw', readonly FaultKind[]>> = { melsec: onlyJw, jw: onlyMelsec }

type ValueOfParameter<P> = P extends { readonly oneOf: readonly (infer T)[] } ? T : number
type Parameters<K extends FaultKind> = Kinds[K]['parameters']
type OptionalName<P> = { [N in keyof P]: P[N] extends { readonly default: unknown } ? N : never }[keyof P]
type Given<P> = { readonly [N in Exclude<keyof P, OptionalName<P>>]: ValueOfParameter<P[N]> } & {
  readonly [N in OptionalName<P>]?: ValueOfParameter<P[N]>
}

type ActionOf<Kind extends FaultKind> = { [K in Kind]: { readonly kind: K } & Given<Parameters<K>> }[Kind]
/** A fault of one kind with its parameters, as it is switched on in a simulated MELSEC PLC. */
export type FaultAction = ActionOf<MelsecFaultKind>
/** A fault of one kind with its parameters, as it is switched on in a simulated Sharp JW. */
export type JwFaultAction = ActionOf<JwFaultKind>

/** The parameters of a kind with every default filled in. */
export type FaultSettings<K extends FaultKind> = {
  readonly [N in keyof Parameters<K>]: ValueOfParameter<Parameters<K>[N]>
}
