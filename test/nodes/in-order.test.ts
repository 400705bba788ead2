/** The order of what changes the PLC, without a PLC. */
import { afterEach, describe, expect, jest, test } from '@jest/globals'
import { InOrder } from '../../nodes/in-order'
import type { Tools } from '../../nodes/node'

const tools = { texts: (key: string) => key, connection: { options: undefined } } as unknown as Tools

/** A promise, and what settles it. */
function later<T>(): { readonly promise: Promise<T>; resolve(value: T): void; reject(error: Error): void } {
  let settle: [(value: T) => void, (error: Error) => void] | undefined
  const promise = new Promise<T>((resolve, reject) => {
    settle = [resolve, reject]
  })
  return { promise, resolve: (value) => settle?.[0](value), reject: (error) => settle?.[1](error) }
}

afterEach(() => {
  jest.restoreAllMocks()
})

describe('messages of one node', () => {
  test('begin in their order, each without waiting for the end of the one before', async () => {
    const begun: string[] = []
    const inOrder = new InOrder(tools)
    const [slow, answer] = [later<string>(), later<string>()]
    const act = (what: string): Promise<string> => {
      begun.push(what)
      return answer.promise
    }
    const both = [inOrder.act(slow.promise, act), inOrder.act(Promise.resolve('second'), act)]
    await new Promise(setImmediate)
    expect(begun).toEqual([])
    slow.resolve('first')
    await new Promise(setImmediate)
    expect(begun).toEqual(['first', 'second'])
    answer.resolve('done')
    expect(await Promise.all(both)).toEqual(['done', 'done'])
  })

  test('begin when the one before is done, where that is asked for', async () => {
    const begun: string[] = []
    const inOrder = new InOrder(tools, true)
    const answers = [later<void>(), later<void>()]
    const act = (what: string): Promise<void> => answers[begun.push(what) - 1]?.promise ?? Promise.reject()
    const both = ['first', 'second'].map((what) => inOrder.act(Promise.resolve(what), act))
    await new Promise(setImmediate)
    expect(begun).toEqual(['first'])
    answers[0]?.reject(new Error('refused'))
    await expect(both[0]).rejects.toThrow('refused')
    await new Promise(setImmediate)
    expect(begun).toEqual(['first', 'second'])
    answers[1]?.resolve()
    await both[1]
  })

  test('are not kept up by one that cannot be found out', async () => {
    const inOrder = new InOrder(tools)
    const bad = inOrder.act(Promise.reject(new Error('no such variable')), async () => 'sent')
    const good = inOrder.act(Promise.resolve(1), async () => 'sent')
    await expect(bad).rejects.toThrow('no such variable')
    expect(await good).toBe('sent')
  })

  test('are refused when too many wait, and taken again when these are gone', async () => {
    const inOrder = new InOrder(tools)
    const slow = later<number>()
    const waiting = Array.from({ length: 256 }, () => inOrder.act(slow.promise, async () => 'sent'))
    const act = jest.fn(async () => 'sent')
    await expect(inOrder.act(Promise.resolve(1), act)).rejects.toMatchObject({ code: 'QUEUE_FULL', outcome: 'notSent' })
    expect(act).not.toHaveBeenCalled()
    slow.resolve(1)
    expect(new Set(await Promise.all(waiting))).toEqual(new Set(['sent']))
    expect(await inOrder.act(Promise.resolve(1), act)).toBe('sent')
  })

  test('that have waited too long are not sent', async () => {
    const timeout = jest.spyOn(AbortSignal, 'timeout').mockReturnValue(AbortSignal.abort())
    const act = jest.fn(async () => 'sent')
    const patient = { ...tools, connection: { options: { timeout: 60_000 } } } as unknown as Tools
    await expect(new InOrder(tools).act(Promise.resolve(1), act)).rejects.toMatchObject({
      code: 'OVERLOADED',
      outcome: 'notSent',
    })
    await expect(new InOrder(patient).act(Promise.resolve(1), act)).rejects.toMatchObject({ code: 'OVERLOADED' })
    expect(act).not.toHaveBeenCalled()
    expect(timeout.mock.calls).toEqual([[10_000], [60_000]])
  })
})
