import { describe, expect, test } from '@jest/globals'
import { languages } from '../../src/basics/texts'
import { EndCodeError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { jwProtocol } from '../../src/jw/protocol'
import { explainResultCode } from '../../src/jw/result-codes/explain'
import { resultCodes } from '../../src/jw/result-codes/facts'
import { resultCodeTexts } from '../../src/jw/result-codes/texts'
import { each } from '../../src/link/link'

/** JW300 option unit manual, "Message form". */
const CODES = [
  0x01, 0x02, 0x04, 0x06, 0x07, 0x08, 0x0e, 0x0f, 0x10, 0x11, 0x12, 0x13, 0x1b, 0x21, 0x22, 0x23, 0x24, 0x25, 0x26,
  0x30, 0x31, 0x32, 0x33, 0x34, 0x38, 0x39, 0x40, 0x41, 0x42, 0x43, 0x44, 0x48, 0x49, 0x4b, 0x4c, 0x52, 0x53,
]

const write = jwProtocol().exchange(jwCommands.writeDataMemory, { head: { file: 0, address: 0 }, data: Buffer.of(1) })
const read = jwProtocol().exchange(jwCommands.readDataMemory, { head: { file: 0, address: 0 }, length: 1 })

function refused(exchange: typeof write | typeof read, endCode: number): EndCodeError {
  try {
    exchange.decode({ head: {}, serial: undefined, endCode, body: Buffer.alloc(0) })
  } catch (error) {
    if (error instanceof EndCodeError) return error
    throw error
  }
  throw new Error('it was taken')
}

test('the 37 codes of the manual have texts, and all are about something', () => {
  expect(resultCodeTexts.map(({ code }) => code)).toEqual(CODES)
  const about = Object.values(resultCodes.about).flatMap(each)
  expect([...about].sort((a, b) => a - b)).toEqual(CODES)
})

describe.each(languages)('texts in %s', (language) => {
  test('are whole sentences, each code its own', () => {
    const texts = CODES.map((code) => explainResultCode(code, { language }))
    for (const text of texts) {
      expect(text?.meaning).toMatch(/[.。]$/)
      expect(text?.remedy).toMatch(/[.。]$/)
    }
    expect(new Set(texts.map((text) => text?.meaning)).size).toBe(CODES.length)
  })
})

test('31H and 33H stay apart although the manual prints one text for both', () => {
  expect(explainResultCode(0x31)?.meaning).not.toBe(explainResultCode(0x33)?.meaning)
  expect(refused(write, 0x33).endCode).toBe(0x33)
})

test.each([0x05, 0x09, 0x99, 0xff])('%d, which the manual does not have, is passed on', (code) => {
  expect(explainResultCode(code)).toBeUndefined()
  expect(refused(read, code)).toMatchObject({ endCode: code, family: 'jw', about: 'unknown', meaning: undefined })
  // Nobody knows what it says of a write.
  expect(refused(write, code)).toMatchObject({ outcome: 'unknown', carriedOut: undefined })
})

test('an error says what the code means and what to do', () => {
  const error = refused(write, 0x10)
  expect(error.message).toBe(
    'Write data memory was refused with result code 10H. The write mode does not allow it. ' +
      'Set the write mode: 1 for data memory, 2 for all memory (command F9H).',
  )
  expect(error).toMatchObject({ about: 'state', outcome: 'refused', carriedOut: false })
})

test('where the manual leaves open how far a write came, so does the error; a read changes nothing', () => {
  for (const code of [0x02, 0x04, 0x07, 0x08, 0x0f, 0x11, 0x1b, 0x21, 0x44, 0x4c, 0x53]) {
    expect(refused(write, code).outcome).toBe('unknown')
    expect(refused(read, code).outcome).toBe('refused')
  }
})
