/** For `chunking`: pieces of `size` bytes. */
export function splitEvery(size: number): (pending: readonly Buffer[]) => Buffer[] {
  return (pending) => {
    const all = Buffer.concat(pending)
    const pieces: Buffer[] = []
    for (let at = 0; at < all.length; at += size) pieces.push(all.subarray(at, at + size))
    return pieces
  }
}

/** For `chunking`: everything under way in one piece. */
export function joinAll(pending: readonly Buffer[]): Buffer[] {
  return [Buffer.concat(pending)]
}
