// A program that stood still for longer than the times of a serial line: what came meanwhile waits in the port and has not been
// read. It is neither silence, nor a line that was quiet. The far end of a real pair of ports is played here, by hand.
import { closeSync, constants, openSync, readSync, writeSync } from 'node:fs'
import { afterEach, expect, test } from '@jest/globals'
import { createMelsecClient, type MelsecClient } from '../../src/index'
import { ttyPair } from '../support/tty-pair'
import { until } from './line'

const ends: (() => unknown)[] = []
afterEach(async () => {
  for (const end of ends.splice(0).reverse()) await end()
})

const ANSWER_TIME = 200
const QUIET = 100

class Far {
  readonly #file: number
  #heard = ''

  constructor(path: string) {
    this.#file = openSync(path, constants.O_RDWR | constants.O_NONBLOCK | constants.O_NOCTTY)
    ends.push(() => closeSync(this.#file))
  }

  /** What has come since it was asked last. */
  heard(): string {
    const bytes = Buffer.alloc(4096)
    try {
      this.#heard += bytes.toString('latin1', 0, readSync(this.#file, bytes))
    } catch (error) {
      if ((error as NodeJS.ErrnoException).code !== 'EAGAIN') throw error
    }
    const heard = this.#heard
    this.#heard = ''
    return heard
  }

  async hears(text: string): Promise<void> {
    let heard = ''
    await until(() => {
      heard += this.heard()
      return heard.includes(text)
    }, text)
  }

  /** The value of a word, in 3C format 4 from station 0. */
  says(value: number, sum?: string): void {
    const body = `F90000FF00${value.toString(16).toUpperCase().padStart(4, '0')}\x03`
    const right = [...body].reduce((total, letter) => (total + letter.charCodeAt(0)) & 255, 0)
    writeSync(this.#file, `\x02${body}${sum ?? right.toString(16).toUpperCase().padStart(2, '0')}\r\n`, null, 'latin1')
  }
}

async function started(): Promise<{ readonly far: Far; readonly client: MelsecClient }> {
  const pair = await ttyPair()
  ends.push(() => pair.close())
  const far = new Far(pair.far)
  const client = createMelsecClient({
    serial: {
      path: pair.near,
      baudRate: 115_200,
      dataLength: 8,
      parity: 'none',
      answerTime: ANSWER_TIME,
      quiet: QUIET,
    },
    profile: 'fx5-serial',
    frame: '3C',
    messageFormat: 4,
    asciiXy: 'octal',
    probe: 'none',
  })
  ends.push(() => client.close())
  await client.connect()
  return { far, client }
}

const READ = 'D*000000'

/** Stands still, as a program does that computes for long. */
function standStill(ms: number): void {
  Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, ms)
}

test('an answer that came meanwhile is read: nobody was silent', async () => {
  const { far, client } = await started()
  const value = client.read('D0', { timeout: 5000 })
  await far.hears(READ)
  far.says(1)
  standStill(2 * ANSWER_TIME)
  expect(await value).toBe(1)
})

test('a late answer that came meanwhile is none to the next request, also one that somebody makes at once', async () => {
  const { far, client } = await started()
  const value = client.read('D0', { timeout: 5000 })
  await far.hears(READ)
  far.says(1, '00')
  await far.hears('\x04')
  far.says(2)
  standStill(3 * QUIET)
  // Asked once more, because it was damaged.
  await far.hears(READ)
  far.says(3)
  expect(await value).toBe(3)
})

test.each([0, 1, 2, 5])('a late answer that came while nobody asked anything: %d ms behind the pause', async (ms) => {
  const { far, client } = await started()
  const first = client.read('D0', { timeout: 300 }).catch(() => {})
  await far.hears(READ)
  await first
  await far.hears('\x04')
  far.says(2)
  // The timer of a program that asks again and again.
  const next = new Promise<unknown>((resolve) =>
    setTimeout(() => resolve(client.read('D9', { timeout: 5000 })), QUIET + ms),
  )
  standStill(3 * QUIET)
  await far.hears('D*000009')
  far.says(4)
  expect(await next).toBe(4)
})
