import type { ProtocolOptions, SerialProtocolOptions } from './client-protocol'

/** @throws TypeError when whoever made the options forgot them */
export function serialOptionsOf({ frame, serial }: ProtocolOptions): SerialProtocolOptions {
  if (serial === undefined) throw new TypeError(`A ${frame} frame needs its serial options`)
  return serial
}
