// How the simulated PLC says no. What a family answers is in its profile; here is what profiles do not hold.

/** Ends the work on a request; the PLC answers with the end code. It never leaves this room. */
export class Refusal extends Error {
  constructor(
    readonly endCode: number,
    /** For the error log, for people. */
    message: string,
    /** 1E: abnormal code behind end code 5B. */
    readonly abnormal?: number,
  ) {
    super(message)
    this.name = 'Refusal'
  }
}

/** End codes of the request itself, alike on all families (FX5 communication manual 47.4). */
export const requestErrors = {
  /** ASCII code: characters that are no digits. */
  asciiConversion: 0xc050,
  /** A field of the request with a value that cannot be. */
  content: 0xc05c,
  /** Set/reset of a bit that is neither. */
  bitData: 0xc060,
  /** Only logged, never answered: binary expected, ASCII received, or another frame. */
  dataCode: 0xc06f,
} as const
