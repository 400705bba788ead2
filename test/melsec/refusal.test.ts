/** What an error says of an end code, by the protocol that received it: programs decide by that, not by tables. */
import { describe, expect, test } from '@jest/globals'
import { EndCodeError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { jwProtocol } from '../../src/jw/protocol'
import type { Exchange, Head } from '../../src/link/link'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { aCompatibleProtocol } from '../../src/melsec/a-compatible/protocol'
import { commands } from '../../src/melsec/commands/commands'
import { protocolOf } from '../client/plan-plc'

const D0 = { device: 'D', number: 0 } as const

/** The error for an answer of an end code and what stands behind it. */
function refused(exchange: Exchange<unknown>, head: Head, endCode: number, behind = ''): EndCodeError {
  try {
    exchange.decode({ head, serial: undefined, endCode, body: Buffer.from(behind, 'hex') })
  } catch (error) {
    if (error instanceof EndCodeError) return error
    throw error
  }
  throw new Error('it was not refused')
}

/** What a message says: nothing is called refused that may have been carried out. */
const ENDED = { refused: 'was refused with', unknown: 'which leaves open whether anything of it was carried out' }

const slmp = protocolOf('iq-r')
const words = [{ device: D0, value: 1 }]
const write = slmp.exchange(commands.writeRandomWords, { words, doubleWords: [] })
const read = slmp.exchange(commands.readWords, { head: D0, points: 1 })

describe('a refusal', () => {
  test.each([
    [0xc056, 'item', 'refused'],
    [0xc054, 'size', 'refused'],
    [0xc059, 'command', 'refused'],
    [0xc061, 'request', 'refused'],
    [0xc201, 'state', 'refused'],
    [0x4a00, 'route', 'refused'],
    // The target did not answer the module that was asked.
    [0xc1a2, 'route', 'unknown'],
    [0x4042, 'item', 'unknown'],
    [0x9999, 'unknown', 'unknown'],
  ])('of a write with end code %i is about its %s and %s', (endCode, about, outcome) => {
    const error = refused(write, {}, endCode)
    expect(error).toMatchObject({ family: 'slmp', endCode, about, outcome, commandName: 'writeRandomWords' })
    expect(error.carriedOut).toBe(outcome === 'refused' ? false : undefined)
    expect(error.message).toContain(ENDED[error.outcome])
  })

  test('of a read changes nothing, whatever the end code', () => {
    const error = refused(read, {}, 0xc1a2)
    expect(error).toMatchObject({ about: 'route', outcome: 'refused', carriedOut: false, commandName: 'readWords' })
  })

  test('in a 1E frame is of the numbers of 1E, and an abnormal code says what it is about', () => {
    const { writeWords } = aCompatibleCommands
    const exchange = aCompatibleProtocol({ code: 'binary' }).exchange(writeWords, { head: D0, values: [1] })
    const head = { command: writeWords.code, pc: 0xff, timer: 0 }
    expect(refused(exchange, head, 0x56)).toMatchObject({ family: '1E', about: 'item', commandName: 'writeWords' })
    const behind = refused(exchange, head, 0x5b, '1000')
    expect(behind).toMatchObject({ family: '1E', endCode: 0x5b, abnormalCode: 0x10, about: 'route', carriedOut: false })
    expect(behind.meaning).toContain('PC No.')
    expect(behind.message).toContain('was refused with end code 5BH, abnormal code 10H: ')
    // The CPU did not answer the module within the monitoring timer.
    const silent = refused(exchange, head, 0x60)
    expect(silent).toMatchObject({ about: 'state', outcome: 'unknown' })
    expect(silent.message).toContain(`ended with end code 60H, ${ENDED.unknown}: `)
  })

  test.each([
    [0x06, 'state', 'refused', 'The PLC is not stopped.'],
    [0x12, 'state', 'refused', 'The memory is a ROM.'],
    [0x11, 'item', 'unknown', 'The address is not in the program area.'],
    [0x55, 'unknown', 'unknown', undefined],
  ])('of a JW with %i is about its %s and %s, and has no text of MELSEC', (endCode, about, outcome, meaning) => {
    const { writeDataMemory } = jwCommands
    const message = { head: { file: 0, address: 0o4000 }, data: Buffer.from([1, 2]) }
    const error = refused(jwProtocol().exchange(writeDataMemory, message), { command: writeDataMemory.code }, endCode)
    expect(error).toMatchObject({ family: 'jw', about, outcome, commandName: 'writeDataMemory' })
    expect(error.meaning).toBe(meaning)
    expect(error.message).toContain(ENDED[error.outcome])
  })
})
