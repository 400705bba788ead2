// The error LED of the Ethernet port and what lit it.

/** An error that lit the LED. */
export interface LoggedError {
  /** Milliseconds since 1970. */
  readonly time: number
  /** The end code that was answered. */
  readonly endCode: number
  /** The client, e.g. `127.0.0.1:50231`. */
  readonly remote: string
  /** What was wrong, in English. */
  readonly message: string
}

/** Older ones are forgotten, as in the error log of an Ethernet module. */
const KEPT = 64

export class ErrorLog {
  #entries: LoggedError[] = []
  #led = false

  /** On since an error, until Clear Error or a restart. */
  get led(): boolean {
    return this.#led
  }

  /** The latest errors, oldest first. */
  get entries(): readonly LoggedError[] {
    return this.#entries
  }

  add(error: LoggedError): void {
    this.#led = true
    this.#entries = [...this.#entries, error].slice(-KEPT)
  }

  /** Clear Error: the LED goes out and the codes are forgotten. */
  clear(): void {
    this.#led = false
    this.#entries = []
  }
}
