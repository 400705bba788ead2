// Which messages a simulated JW takes, by what stands in front of them.
import { failAt } from '../../codec/codec'
import { PlcError } from '../../errors'
import { type JwHead, jwFrame } from '../../jw/frame'
import { headerBytes, type JwHeader } from '../../jw/header'
import type { Framing } from '../../link/link'

/**
 * Framing of a port that takes messages with a header, or with any. `unreadable` is told of bytes that are none; nothing
 * answers those.
 */
export function takenFrames(header: JwHeader | 'any', unreadable: (bytes: Buffer) => void): Framing<JwHead> {
  const framing = jwFrame(header === 'any' ? {} : { header })
  const wanted = header === 'any' ? undefined : headerBytes(header)
  return {
    ...framing,
    request: {
      ...framing.request,
      scan(bytes, bodyLength) {
        try {
          const scanned = framing.request.scan(bytes, bodyLength)
          if (scanned === undefined || wanted === undefined) return scanned
          const { header: length = 0, command } = scanned.frame.head
          if (!wanted.equals(bytes.subarray(0, length))) failAt('BAD_FRAME', 0, bytes, 'the unit takes another header')
          // Without its length the answer gets the header of the options; a relay is turned round in it.
          return header instanceof Uint8Array ? { ...scanned, frame: { ...scanned.frame, head: { command } } } : scanned
        } catch (error) {
          if (!(error instanceof PlcError)) throw error
          unreadable(bytes)
          throw error
        }
      },
    },
  }
}
