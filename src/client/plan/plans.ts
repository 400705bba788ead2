// Prepared reads and writes, as users see them.
import type { WriteResult } from '../../errors'
import type { CallOptions } from '../connection/call'
import type { ReadResult } from '../item/item-value'
import type { PlanDescription } from './request'

/** A prepared read: run it again and again; nothing is parsed or encoded anew. */
export interface ReadPlan<R = ReadResult[]> {
  /** Reads all items once. Each has its own result; it rejects only for a bug. */
  run(options?: CallOptions): Promise<R>
  /** Requests, points, bytes and notes, for people. */
  describe(): PlanDescription
  /** `describe()` as text: a line for each request, then the notes. */
  toString(): string
}

/** A prepared write. */
export interface WritePlan {
  /**
   * Writes all entries once, in their order. Needs `allowWrites`.
   * @throws WriteError when anything was not written
   */
  run(options?: CallOptions): Promise<void>
  /** As `run`, with a result for each entry instead of an error. Look at each of them. */
  runEach(options?: CallOptions): Promise<WriteResult[]>
  /** Requests, points, bytes and notes, for people. */
  describe(): PlanDescription
  /** `describe()` as text: a line for each request, then the notes. */
  toString(): string
}
