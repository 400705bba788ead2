// What an item that is a label is, as far as it is known without the PLC.

import { formatType } from '../../value/value'
import type { DeviceExplanation } from '../plan/explain'
import type { PlanProtocol } from '../plan/limit'
import { describeLabelRead } from './describe'
import type { LabelInItems } from './in-items'

/** An item that is a label. */
export interface LabelExplanation {
  /** The item as it was given. */
  readonly text: string
  /** The name as it is sent, e.g. `Line1.Values[2]`. */
  readonly label: string
  /** Index at the end of the name, one to three numbers. */
  readonly index?: readonly number[]
  /** The type it should have; missing: the PLC says it. */
  readonly type?: string
  /** Elements of an array. */
  readonly count?: number
  /** Requests that read it, as far as it is known: arrays are read by more once their type is known. */
  readonly requests: number
  /** What one should know. */
  readonly notes: readonly string[]
}

/** What an item is: `'label' in explanation` tells labels from devices. */
export type ItemExplanation = DeviceExplanation | LabelExplanation

/** What reading the label would do, without doing it. */
export function explainLabel(item: LabelInItems, protocol: PlanProtocol): LabelExplanation {
  const { address, type, count } = item.label
  const { requests, notes } = describeLabelRead(protocol, [item], new Map())
  return {
    text: item.text,
    label: address.name,
    ...(address.index === undefined ? {} : { index: address.index }),
    ...(type === undefined ? {} : { type: formatType(type) }),
    ...(count === undefined ? {} : { count }),
    requests: requests.length,
    notes: ['Labels answer only with "Access from External Device" ticked in GX Works3.', ...notes],
  }
}
