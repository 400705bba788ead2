/** A misspelt option of a call is refused before anything is sent: it would be the usual one, and nobody would notice. */
import { afterAll, beforeAll, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, type MelsecClient } from '../../src/index'
import { clientOptions, failureOf, kind } from './line'

let plc: PlcSimulator
let client: MelsecClient

beforeAll(async () => {
  plc = createPlcSimulator({ profile: 'iq-r', labels: { Speed: { type: 'INT' } } })
  await plc.listen()
  client = createMelsecClient(clientOptions(kind('tcp 4E binary iq-r'), plc))
  await client.connect()
})
afterAll(async () => {
  await client.close()
  await plc.close()
})

const head = { device: 'D', number: 0 } as const
const entries = [{ item: 'D0', value: 1 }]

/** Every call with options, and the options it has. */
const calls: Readonly<Record<string, [run: (options: object) => unknown, own: string]>> = {
  connect: [(x) => client.connect(x), 'timeout, signal, caller, priority'],
  read: [(x) => client.read('D0', x), 'timeout, signal, caller, priority'],
  'read a list': [(x) => client.read(['D0'], x), 'timeout, signal, caller, priority'],
  readEach: [(x) => client.readEach({ a: 'D0' }, x), 'timeout, signal, caller, priority'],
  readValues: [(x) => client.readValues(['D0'], x), 'timeout, signal, caller, priority'],
  'plan().run': [(x) => client.plan(['D0']).run(x), 'timeout, signal, caller, priority'],
  'monitor().read': [(x) => client.monitor(['D0']).read(x), 'timeout, signal, caller, priority'],
  'monitor() with a label': [(x) => client.monitor(['D0', 'Speed']).read(x), 'timeout, signal, caller, priority'],
  write: [(x) => client.write('D0', 1, x), 'readModifyWrite, allOrNothing, timeout, signal, caller, priority'],
  'write an object': [
    (x) => client.write({ D0: 1 }, x),
    'readModifyWrite, allOrNothing, timeout, signal, caller, priority',
  ],
  writeValues: [
    (x) => client.writeValues({ D0: 1 }, x),
    'readModifyWrite, allOrNothing, timeout, signal, caller, priority',
  ],
  writeEach: [(x) => client.writeEach(entries, x), 'readModifyWrite, allOrNothing, timeout, signal, caller, priority'],
  planWrite: [async (x) => client.planWrite(entries, x), 'readModifyWrite, allOrNothing'],
  'planWrite().run': [(x) => client.planWrite(entries).run(x), 'timeout, signal, caller, priority'],
  'planWrite().runEach': [(x) => client.planWrite(entries).runEach(x), 'timeout, signal, caller, priority'],
  request: [
    (x) => client.request(commands.readWords, { head, points: 1 }, x),
    'form, subcommand, context, timeout, signal, caller, priority',
  ],
  requestByName: [
    (x) => client.requestByName('readWords', { head: 'D0', points: 1 }, x),
    'form, timeout, signal, caller, priority',
  ],
  identify: [(x) => client.identify(x), 'timeout, signal, caller, priority'],
  selfTest: [(x) => client.selfTest('AB', x), 'timeout, signal, caller, priority'],
  clearError: [(x) => client.clearError(x), 'timeout, signal, caller, priority'],
  'control.run': [(x) => client.control.run(x), 'force, clear, verify, timeout, signal, caller, priority'],
  'control.stop': [(x) => client.control.stop(x), 'verify, timeout, signal, caller, priority'],
  'control.pause': [(x) => client.control.pause(x), 'force, verify, timeout, signal, caller, priority'],
  'control.latchClear': [(x) => client.control.latchClear(x), 'value, timeout, signal, caller, priority'],
  'control.reset': [(x) => client.control.reset(x), 'timeout, signal, caller, priority'],
  'labels.read': [
    (x) => client.labels.read('Speed', x),
    'encoding, trimSpaces, asciiWordOrder, timeout, signal, caller, priority',
  ],
  'labels.write': [
    (x) => client.labels.write({ Speed: 1 }, x),
    'encoding, trimSpaces, asciiWordOrder, timeout, signal, caller, priority',
  ],
  'labels.writeEach': [
    (x) => client.labels.writeEach({ Speed: 1 }, x),
    'encoding, trimSpaces, asciiWordOrder, timeout, signal, caller, priority',
  ],
  'memory.read': [(x) => client.memory.read(0, 1, x), 'timeout, signal, caller, priority'],
  'memory.write': [(x) => client.memory.write(0, [1], x), 'timeout, signal, caller, priority'],
  'module.read': [(x) => client.module('Q62DA', { startIo: 0 }).read(0, 1, x), 'timeout, signal, caller, priority'],
  'module.write': [(x) => client.module('Q62DA', { startIo: 0 }).write(0, [1], x), 'timeout, signal, caller, priority'],
  'files.list': [(x) => client.files.list('4:/', x), 'timeout, signal, caller, priority'],
  'files.stat': [(x) => client.files.stat('4:/A.CSV', x), 'timeout, signal, caller, priority'],
  'files.read': [
    (x) => client.files.read('4:/A.CSV', x),
    'password, onProgress, limit, timeout, signal, caller, priority',
  ],
  'files.readStream': [
    async (x) => client.files.readStream('4:/A', x),
    'password, onProgress, timeout, signal, caller, priority',
  ],
  'files.write': [
    (x) => client.files.write('4:/A.CSV', Buffer.of(1), x),
    'password, onProgress, mode, size, timeout, signal, caller, priority',
  ],
  'files.copy': [
    (x) => client.files.copy('4:/A', '4:/B', x),
    'password, destinationPassword, timeout, signal, caller, priority',
  ],
  'files.remove': [(x) => client.files.remove('4:/A', x), 'password, timeout, signal, caller, priority'],
  'files.setAttribute': [
    (x) => client.files.setAttribute('4:/A', 'readOnly', x),
    'password, timeout, signal, caller, priority',
  ],
  'files.setDate': [
    (x) => client.files.setDate('4:/A', { year: 2024, month: 1, day: 1, hour: 0, minute: 0, second: 0 }, x),
    'timeout, signal, caller, priority',
  ],
  'files.closeAll': [(x) => client.files.closeAll(x), 'timeout, signal, caller, priority'],
}

test.each(Object.entries(calls))('%s', async (_name, [run, own]) => {
  const { requests } = plc.statistics
  for (const misspelt of ['allOrNoting', 'timeOut', 'Force']) {
    const error = await failureOf(Promise.resolve().then(() => run({ [misspelt]: true })))
    expect(error).toMatchObject({
      code: 'BAD_OPTION',
      outcome: 'notSent',
      field: misspelt,
      message: `There is no option ${misspelt}: use ${own}.`,
    })
  }
  expect(plc.statistics.requests).toBe(requests)
})

test('options of other calls are no options either', async () => {
  const stray = { timeout: 100, allOrNothing: true }
  expect(await failureOf(client.read('D0', stray))).toMatchObject({ code: 'BAD_OPTION', field: 'allOrNothing' })
  const early = { timeout: 100 } as object
  expect(() => client.planWrite(entries, early)).toThrow('There is no option timeout')
})
