/** The program at the other end of a pair of serial ports. */
import { type ChildProcess, fork } from 'node:child_process'
import { once } from 'node:events'
import { join } from 'node:path'
import { root } from '../support/root'
import { type TtyPair, ttyPair } from '../support/tty-pair'
import type { Carried } from './serial-judge'

export interface FarOptions {
  readonly baudRate: number
  readonly messageFormat: number
  readonly sumCheck: boolean
  readonly stations: readonly number[]
  /** Numbers of D that are used. */
  readonly cells: number
  /** What D0 of station 0 would hold at first; the others follow. */
  readonly first: number
  /** Characters take their time. */
  readonly pace: boolean
  /** Whoever sends hears it. */
  readonly echo: boolean
  readonly seed: number
  /** The end code of refusals. */
  readonly refusal: number
  /** `share`: of the requests with which something goes wrong. */
  readonly noise:
    | {
        readonly share: number
        readonly kinds: readonly string[]
        readonly answerTime: number
        readonly betweenBytes: number
      }
    | undefined
}

export interface Truth {
  readonly done: readonly Carried[]
  /** How often each kind of fault struck. */
  readonly struck: Readonly<Record<string, number>>
  /** Chunks that were lost because the program was not run for a while. */
  readonly asleep: number
  readonly requests: number
}

export class Far {
  readonly #child: ChildProcess
  readonly #pair: TtyPair

  private constructor(child: ChildProcess, pair: TtyPair) {
    this.#child = child
    this.#pair = pair
  }

  static async start(options: FarOptions): Promise<Far> {
    const pair = await ttyPair()
    const given = JSON.stringify({ ...options, path: pair.far })
    const child = fork(join(root, 'test', 'campaign', 'serial-plc.mjs'), [given], { stdio: 'inherit' })
    const ended = once(child, 'exit').then(([code]) => Promise.reject(new Error(`the stations ended: ${String(code)}`)))
    ended.catch(() => {})
    await Promise.race([once(child, 'message'), ended])
    return new Far(child, pair)
  }

  /** The port of this program. */
  get near(): string {
    return this.#pair.near
  }

  truth(): Promise<Truth> {
    return this.#ask<Truth>('truth')
  }

  /** What went over the wire, and when; nothing where nothing was to go wrong. */
  story(): Promise<readonly (readonly [number, string])[]> {
    return this.#ask('story')
  }

  async #ask<T>(what: string): Promise<T> {
    const told = once(this.#child, 'message')
    this.#child.send(what)
    const [answer] = (await told) as [T]
    return answer
  }

  async close(): Promise<void> {
    const gone = once(this.#child, 'exit')
    this.#child.disconnect()
    await gone
    await this.#pair.close()
  }
}
