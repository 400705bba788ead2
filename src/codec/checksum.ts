/**
 * Low byte of the arithmetic sum of the bytes from `start` to before `end`: the sum check of the 1C, 3C and 4C frames
 * (FX5 communication manual, "Sum check code").
 */
export function sumOf(bytes: Uint8Array, start = 0, end = bytes.length): number {
  let sum = 0
  for (let i = start; i < end; i++) sum += bytes[i] as number
  return sum & 0xff
}
