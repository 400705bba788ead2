// Free ports, found the way a user expects: the usual one, or the next one that can be had.
import { connect } from 'node:net'

/** How many ports to try before the system chooses one. */
const TRIES = 20
const ANSWER_TIME = 500

/** The usual port, those after it, and at last 0: any. */
function* candidates(usual, step) {
  for (let i = 0; i < TRIES; i++) yield usual + i * step
  yield 0
}

/**
 * Calls `listen(port)` with one port after the other until it does not fail because the port is taken.
 * @param listen throws an error with the code EADDRINUSE, EACCES (a port Windows has reserved) or PORT_UNAVAILABLE
 * @returns what `listen` returned
 */
export async function listenNear(usual, step, listen) {
  let last
  for (const port of candidates(usual, step)) {
    if (port !== 0 && (await somebodyAnswers(port))) continue
    try {
      return await listen(port)
    } catch (error) {
      if (!['EADDRINUSE', 'EACCES', 'PORT_UNAVAILABLE'].includes(error?.code)) throw error
      last = error
    }
  }
  throw last
}

/**
 * Whether a program listens there. Windows and macOS let a second one listen on 127.0.0.1 beside another on all
 * addresses, and would so take that one's visitors away.
 */
function somebodyAnswers(port) {
  return new Promise((resolve) => {
    const socket = connect({ host: '127.0.0.1', port })
    const end = (answered) => {
      socket.destroy()
      resolve(answered)
    }
    socket.setTimeout(ANSWER_TIME, () => end(false))
    socket.once('connect', () => end(true))
    socket.once('error', () => end(false))
  })
}
