/// <reference types="node" preserve="true" />
// The public names of `@melsec-jw/plc/simulator`: a PLC to try programs with. No code.

export type { JwModel } from '../jw/commands/command'
export type { JwCommandName } from '../jw/commands/commands'
export type { JwHeader, JwRelay } from '../jw/header'
export type { JwArea, JwConfidence } from '../jw/operand/area'
export type { ParameterProblem } from '../jw/parameters/parameter-map'
export type { OddBits } from '../melsec/a-compatible/rules'
export * from '../simulator/simulator'
