// Several frames on one port, told apart by their subheaders, as Ethernet ports of PLCs do it.
import type { DataCode } from '../codec/codec'
import { PlcError } from '../errors'
import type { Framing, RequestFrame, Scanned } from '../link/link'
import { frame3e, type Head3e } from '../melsec/frame-3e'
import type { FrameName } from '../melsec/profile'

/** A head that says in which frame it came, so that the answer goes out in the same one. */
export interface AnyHead {
  readonly frame: FrameName
  readonly head: Head3e
}

/**
 * Framing of a port that takes all of `frames`. One per connection: it looks first for the frame that came last.
 * `unreadable` is told of bytes that are none of them; nothing answers those.
 */
export function anyFrame(
  frames: readonly FrameName[],
  code: DataCode,
  unreadable: (bytes: Buffer) => void,
): Framing<AnyHead> {
  const framings = { '3E': frame3e('3E', code), '4E': frame3e('4E', code) } satisfies Record<FrameName, unknown>
  let candidates = frames
  const scan = (bytes: Buffer): Scanned<RequestFrame<AnyHead>> | undefined => {
    let failure: unknown
    for (const frame of candidates) {
      try {
        const scanned = framings[frame].request.scan(bytes, () => undefined)
        if (scanned === undefined) return undefined
        if (frame !== candidates[0]) candidates = [frame, ...frames.filter((other) => other !== frame)]
        return { used: scanned.used, frame: { ...scanned.frame, head: { frame, head: scanned.frame.head } } }
      } catch (error) {
        if (!(error instanceof PlcError)) throw error
        failure = error
      }
    }
    unreadable(bytes)
    throw failure
  }
  return {
    name: frames.join('/'),
    correlation: 'order',
    request: {
      write: ({ frame, head }, serial, body) => framings[frame].request.write(head, serial, body),
      scan,
    },
    response: {
      write: ({ frame, head }, serial, endCode, body) => framings[frame].response.write(head, serial, endCode, body),
      scan: () => undefined,
    },
    mismatch: () => undefined,
  }
}
