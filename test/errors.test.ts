/** Errors as data and back, and what their types say. */
import { Worker } from 'node:worker_threads'
import { describe, expect, test } from '@jest/globals'
import {
  ClosedError,
  ConnectionError,
  EndCodeError,
  PlcError,
  ProtocolError,
  plcErrorFrom,
  RequestError,
  TimeoutError,
  UnfinishedError,
  VerifyError,
  WriteError,
} from '../src/index'

const refused = new EndCodeError(0xc056, 'refused', {
  family: 'slmp',
  about: 'item',
  carriedOut: false,
  command: 'Read (word units)',
  commandName: 'readWords',
  station: 'network 0',
  abnormalCode: 0x10,
  meaning: 'm',
  remedy: 'r',
})
const perhaps = new EndCodeError(0xc1a2, 'no answer of the target', { family: 'slmp', about: 'route' })
const offline = new ConnectionError('OFFLINE', 'offline', 'notSent', new Error('EPIPE'), ['a', 'b'])
const errors: readonly PlcError[] = [
  new RequestError('BAD_VALUE', 'bad', 'D0'),
  refused,
  perhaps,
  new ProtocolError('BAD_FRAME', 'frame', { offset: 2, bytes: Uint8Array.of(1, 0xff), field: 'words.0.device' }),
  new TimeoutError('late', 'unknown', ['cable']),
  offline,
  new ClosedError('ABORTED', 'aborted', 'unknown', refused),
  new VerifyError('not seen', 'STOP', offline),
  new UnfinishedError('half', refused),
  new WriteError(
    'partly',
    'unknown',
    [
      { item: 'D0', ok: true },
      { item: 'D1', ok: false, error: refused },
    ],
    refused,
  ),
]

describe.each(errors.map((error) => [error.name, error] as const))('%s', (_name, error) => {
  test('survives JSON with all that it carries', () => {
    const again = plcErrorFrom(JSON.parse(JSON.stringify(error)))
    expect(Object.getPrototypeOf(again)).toBe(Object.getPrototypeOf(error))
    expect(again).toBeInstanceOf(PlcError)
    expect(again.toJSON()).toEqual(error.toJSON())
    expect([again.name, again.code, again.outcome, again.message]).toEqual([
      error.name,
      error.code,
      error.outcome,
      error.message,
    ])
  })

  test('survives a structured clone of its data', () => {
    expect(plcErrorFrom(structuredClone(error.toJSON())).toJSON()).toEqual(error.toJSON())
  })
})

test('an error comes back from a worker', async () => {
  const worker = new Worker(
    'const { parentPort, workerData } = require("node:worker_threads"); parentPort.postMessage(workerData)',
    {
      eval: true,
      workerData: refused.toJSON(),
    },
  )
  const data = await new Promise((resolve) => worker.once('message', resolve))
  await worker.terminate()
  expect(plcErrorFrom(data)).toMatchObject(refused.toJSON())
})

test.each([
  null,
  'text',
  {},
  { name: 'RequestError', message: 'm', code: 'NONE', outcome: 'notSent' },
  { name: 'EndCodeError', message: 'm', family: 'slmp', about: 'item' },
  { name: 'EndCodeError', message: 'm', endCode: 0xc056, about: 'item' },
  { name: 'EndCodeError', message: 'm', endCode: 0xc056, family: 'slmp', about: 'weather' },
  { name: 'TimeoutError', message: 'm', outcome: 'refused' },
  { name: 'WriteError', message: 'm', outcome: 'unknown', results: [5] },
  { name: 'toString', message: 'm' },
])('what is no error as data is refused: %j', (data) => {
  expect(() => plcErrorFrom(data)).toThrow(RequestError)
})

test('a class of a program that extends one of ours is told apart', () => {
  class Own extends RequestError {}
  const own = new Own('BAD_VALUE', 'm')
  expect([own instanceof Own, own instanceof RequestError, own instanceof PlcError]).toEqual([true, true, true])
  expect(new RequestError('BAD_VALUE', 'm')).not.toBeInstanceOf(Own)
})

test('an end code that does not say that nothing was done has an unknown outcome', () => {
  expect([refused.carriedOut, refused.outcome]).toEqual([false, 'refused'])
  expect([perhaps.carriedOut, perhaps.outcome]).toEqual([undefined, 'unknown'])
  expect(new EndCodeError(0x9999, 'm', { family: 'jw' })).toMatchObject({ about: 'unknown', outcome: 'unknown' })
})

test('the code narrows the type', () => {
  const facts = errors.map((error): unknown => {
    switch (error.code) {
      case 'END_CODE':
        return error.endCode
      case 'NOT_ALL_WRITTEN':
        return error.results.length
      case 'TIMEOUT':
        return error.causes
      case 'BAD_VALUE':
        return error.field
      default:
        // @ts-expect-error not every error has an end code
        return error.endCode
    }
  })
  expect(facts).toEqual(['D0', 0xc056, 0xc1a2, undefined, ['cable'], undefined, undefined, undefined, undefined, 2])
})

test('instanceof narrows the type', () => {
  const thrown: unknown = refused
  expect(thrown instanceof PlcError && thrown.code === 'END_CODE' && thrown.endCode).toBe(0xc056)
})
