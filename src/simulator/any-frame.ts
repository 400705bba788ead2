// Several frames on one port, told apart by their subheaders, as Ethernet ports of PLCs do it.
import { type DataCode, failAt, uintAt } from '../codec/codec'
import { PlcError } from '../errors'
import type { BodyLength, Framing, RequestFrame, Scanned } from '../link/link'
import { frame1e, type Head1e } from '../melsec/frame/frame-1e'
import { type EthernetFrameName, frameFacts, type SlmpFrameName, slmpFrameNames } from '../melsec/frame/frames'
import { type SlmpFraming, type SlmpHead, slmpFraming } from '../melsec/frame/slmp-frame'

/** A head that says in which frame it came, so that the answer goes out in the same one. */
export type AnyHead =
  | { readonly frame: SlmpFrameName; readonly head: SlmpHead }
  | { readonly frame: '1E'; readonly head: Head1e }

/** Subheaders of 1E requests go up to this; those of 3E, 4E and station extension are 50, 54 and 68. */
const LAST_COMMAND_1E = 0x1f

/**
 * Framing of a port that takes all of `frames`. One per connection: it looks first for the frame that came last.
 * `unreadable` is told of bytes that are none of them; nothing answers those. `length1e`: where a 1E request ends.
 */
export function anyFrame(
  frames: readonly EthernetFrameName[],
  code: DataCode,
  unreadable: (bytes: Buffer) => void,
  length1e: BodyLength<Head1e> = () => undefined,
): Framing<AnyHead> {
  const framings = slmpFramings(code)
  const aCompatible = frame1e(code)
  const read = (name: EthernetFrameName, bytes: Buffer): Scanned<RequestFrame<AnyHead>> | undefined => {
    if (name === '1E') {
      check1e(bytes, code)
      const scanned = aCompatible.request.scan(bytes, length1e)
      return scanned && { ...scanned, frame: { ...scanned.frame, head: { frame: name, head: scanned.frame.head } } }
    }
    const scanned = framings(name).request.scan(bytes, () => undefined)
    return scanned && { ...scanned, frame: { ...scanned.frame, head: { frame: name, head: scanned.frame.head } } }
  }
  let candidates = frames
  const scan = (bytes: Buffer): Scanned<RequestFrame<AnyHead>> | undefined => {
    let failure: unknown
    for (const frame of candidates) {
      try {
        const scanned = read(frame, bytes)
        if (scanned === undefined) return undefined
        if (frame !== candidates[0]) candidates = [frame, ...frames.filter((other) => other !== frame)]
        return scanned
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
      write: (any, serial, body) =>
        any.frame === '1E'
          ? aCompatible.request.write(any.head, serial, body)
          : framings(any.frame).request.write(any.head, serial, body),
      scan,
    },
    response: {
      write: (any, serial, endCode, body) =>
        any.frame === '1E'
          ? aCompatible.response.write(any.head, serial, endCode, body)
          : framings(any.frame).response.write(any.head, serial, endCode, body),
      scan: () => undefined,
    },
    mismatch: () => undefined,
  }
}

/** The framing of each frame that the code has. */
function slmpFramings(code: DataCode): (frame: SlmpFrameName) => SlmpFraming {
  const names = slmpFrameNames.filter((name) => frameFacts[name].codes.includes(code))
  const framings = new Map(names.map((name) => [name, slmpFraming(name, code)] as const))
  return (frame) => {
    const framing = framings.get(frame)
    if (framing === undefined) throw new TypeError(`a port in ${code} code takes no ${frameFacts[frame].title} frame`)
    return framing
  }
}

/** Before the head is whole: the first byte (two characters) tells 1E from the other frames. */
function check1e(bytes: Buffer, code: DataCode): void {
  const ascii = code === 'ascii'
  if (bytes.length < (ascii ? 2 : 1)) return
  if (uintAt(bytes, 0, 1, ascii) > LAST_COMMAND_1E) failAt('BAD_FRAME', 0, bytes, 'the subheader is not one of 1E')
}
