/// <reference types="node" preserve="true" />
// The public names of `@melsec-jw/plc/simulator`: a PLC to try programs with. No code.

export type { OddBits } from '../melsec/a-compatible/rules'
export * from '../simulator/simulator'
