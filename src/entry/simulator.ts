/// <reference types="node" preserve="true" />
// The public names of `@melsec-jw/plc/simulator`: a PLC to try programs with. No code.

export * from '../simulator/simulator'
