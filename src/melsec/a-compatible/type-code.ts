// Codes that Read PC Type Name (1E 15H, 1C PC) answers: FX5 communication manual 44.5 (1C). One code may stand
// for several series: F3H is FX5 and FX3U alike.

const rows: readonly (readonly [code: number, ...models: string[]])[] = [
  [0xf3, 'FX5S', 'FX5UJ', 'FX5U', 'FX5UC', 'FX3U', 'FX3UC'],
  [0xf4, 'FX3G', 'FX3GC'],
  [0xf5, 'FX3S'],
  [0xf2, 'FX1S'],
  [0x8e, 'FX0N'],
  [0x8d, 'FX2', 'FX2C'],
  [0x9e, 'FX1N', 'FX1NC'],
  [0x9d, 'FX2N', 'FX2NC'],
  [0x98, 'A0J2HCPU', 'A1SCPU', 'A1SJCPU'],
  [0xa1, 'A1CPU', 'A1NCPU'],
  [0xa2, 'A2CPU', 'A2CPU-S1', 'A2NCPU', 'A2NCPU-S1', 'A2SCPU'],
  [0x92, 'A2ACPU'],
  [0x93, 'A2ACPU-S1'],
  [0x9a, 'A2CCPU', 'A52GCPU'],
  [0x82, 'A2USCPU'],
  [0x83, 'A2CPU-S1', 'A2USCPU-S1'],
  [0xa3, 'A3CPU', 'A3NCPU', 'A73CPU', 'A7LMS-F'],
  [0x94, 'A3ACPU'],
  [0xa4, 'A3HCPU', 'A3MCPU'],
  [0x84, 'A3UCPU'],
  [0x85, 'A4UCPU'],
  [0xab, 'AJ72P25/R25'],
  [0x8b, 'AJ72LP25/BR15'],
]

/** Models by type code. */
export const pcTypeCodes: ReadonlyMap<number, readonly string[]> = new Map(
  rows.map(([code, ...models]) => [code, models]),
)
