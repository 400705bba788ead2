/** The remote password of the command line: typed or from the environment, never an argument. */
import { afterAll, afterEach, beforeAll, expect, test } from '@jest/globals'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { runHere } from './in-process'

const PASSWORD = 'Secret-1'
let plc: PlcSimulator

beforeAll(async () => {
  plc = createPlcSimulator({ profile: 'iq-r', password: PASSWORD })
  await plc.listen()
})
afterAll(() => plc.close())
afterEach(() => {
  delete process.env.MELSEC_JW_PASSWORD
})

const read = (answer?: string, ...more: readonly string[]) =>
  runHere(['read', 'D100', `--plc=127.0.0.1:${plc.tcp?.port}`, '--profile', 'iq-r', ...more], answer)

test('without it a locked PLC says so', async () => {
  const { code, err } = await read()
  expect(code).not.toBe(0)
  expect(err).toContain('C201')
  expect(err).toMatch(/Say --password, or .*MELSEC_JW_PASSWORD/)
})

test('comes from the environment', async () => {
  process.env.MELSEC_JW_PASSWORD = PASSWORD
  const { code, out } = await read()
  expect([code, out]).toEqual([0, expect.stringContaining('0')])
})

test('is typed when --password says so, and not shown by --trace', async () => {
  process.env.MELSEC_JW_PASSWORD = 'something else'
  const { code, err, questions } = await read(PASSWORD, '--password', '--trace')
  expect([code, questions]).toEqual([0, ['Remote password: ']])
  expect(err).toContain('Unlock (remote password)')
  expect(err).not.toContain('Secret')
})

test('a wrong one is sent once and said to be wrong', async () => {
  process.env.MELSEC_JW_PASSWORD = 'Secret-2'
  const before = plc.statistics.refusals
  const { code, err } = await read()
  expect(code).toBe(3)
  expect(err).toContain('C810')
  expect(err).not.toContain('Secret')
  expect(plc.statistics.refusals - before).toBe(1)
})

test('cannot be asked for where nobody is', async () => {
  const { code, err } = await read(undefined, '--password')
  expect(code).not.toBe(0)
  expect(err).toContain('MELSEC_JW_PASSWORD')
})
