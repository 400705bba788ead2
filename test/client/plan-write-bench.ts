// A prepared write and the PLC it goes to.
import { parseItem } from '../../src/client/item/item'
import type { PlainValue } from '../../src/client/item/item-value'
import type { SendExchange } from '../../src/client/plan/request'
import { type DeviceWrite, planWrite, type WriteOptions, type WriteResult } from '../../src/client/plan/write'
import type { DataCode } from '../../src/codec/codec'
import { EndCodeError, type PlcError } from '../../src/errors'
import type { ProfileId, ProfileOverrides } from '../../src/melsec/profiles/profile'
import type { PlcValue } from '../../src/value/value'
import { expectedValue } from './plan-arbitrary'
import { items, PlanPlc, protocolOf } from './plan-plc'

export interface Setting extends WriteOptions {
  readonly profile?: ProfileId
  readonly code?: DataCode
  readonly overrides?: ProfileOverrides
}

export interface Bench {
  readonly plc: PlanPlc
  readonly plan: DeviceWrite
  run(send?: SendExchange): Promise<WriteResult[]>
  texts(): string[]
  value(text: string): PlcValue | PlcValue[]
}

export type Entries = readonly (readonly [text: string, value: PlainValue])[]

export function bench(
  entries: Entries,
  { profile = 'iq-r', code = 'binary', overrides, ...options }: Setting = {},
): Bench {
  const protocol = protocolOf(profile, code, overrides)
  const plc = new PlanPlc(protocol)
  const plan = planWrite(
    entries.flatMap(([text, value]) => items(protocol, [text]).map((item) => ({ item, value }))),
    protocol,
    options,
  )
  return {
    plc,
    plan,
    run: (send = plc.send) => plan.run(send),
    texts: () => plan.describe().requests.map(({ text }) => text),
    value: (text) => expectedValue(plc, parseItem(text, { xyRadix: 16 })),
  }
}

export function errorOf(result: WriteResult | undefined): PlcError {
  if (result === undefined || result.ok) throw new Error('it was written')
  return result.error
}

export function codes(results: readonly WriteResult[]): (string | number)[] {
  return results.map((result) => {
    if (result.ok) return 'ok'
    return result.error instanceof EndCodeError ? result.error.endCode : `${result.error.code} ${result.error.outcome}`
  })
}

/** Bits of words may be written. */
export const RMW = { readModifyWrite: true }
