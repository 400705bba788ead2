/** Two serial ports of this computer that are joined: what goes into one comes out of the other. Needs socat (Debian: apt-get install socat). */
import { spawn } from 'node:child_process'
import { once } from 'node:events'

export interface TtyPair {
  readonly near: string
  readonly far: string
  /** Pulls the cable out: both ports are gone. */
  close(): Promise<void>
}

/** @param link a path that leads to the near port as long as it is there, as adapters have one that stays */
export async function ttyPair(link?: string): Promise<TtyPair> {
  const near = link === undefined ? 'pty,raw,echo=0' : `pty,raw,echo=0,link=${link}`
  const socat = spawn('socat', ['-d', '-d', near, 'pty,raw,echo=0'], {
    stdio: ['ignore', 'ignore', 'pipe'],
  })
  const ended = once(socat, 'close')
  const names = await new Promise<string[]>((resolve, reject) => {
    let told = ''
    socat.stderr.setEncoding('utf8').on('data', (text: string) => {
      told += text
      if (told.includes('starting data transfer loop'))
        resolve([...told.matchAll(/PTY is (\S+)/g)].map(([, name = '']) => name))
    })
    socat.on('error', (cause) =>
      reject(new Error('The tests of serial ports need socat: apt-get install socat', { cause })),
    )
    ended.then(() => reject(new Error(`socat ended: ${told}`)), reject)
  })
  const [first, far] = names
  if (first === undefined || far === undefined) throw new Error('socat made no pair of ports')
  return {
    near: link ?? first,
    far,
    async close() {
      socat.kill()
      await ended
    },
  }
}
