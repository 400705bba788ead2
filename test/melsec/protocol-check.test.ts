/** What the planner asks about requests it does not make: the answers are those of the requests themselves. */
import { expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { DataCode } from '../../src/codec/codec'
import { RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { type DeviceAddress, devices } from '../../src/melsec/device/device'
import { profileIds } from '../../src/melsec/profiles/profile'
import { parseType } from '../../src/value/value'
import { protocolOf } from '../client/plan-plc'

const number = fc.oneof(fc.nat(40), fc.nat(5000), fc.nat(0xffffffff))
const extension = fc.constantFrom<DeviceAddress['extension']>(
  undefined,
  undefined,
  { kind: 'module', unit: 3 },
  { kind: 'cpu', cpu: 1 },
  { kind: 'link', network: 2 },
)
const index = fc.constantFrom<DeviceAddress['index']>(
  undefined,
  undefined,
  { register: 'Z', number: 2 },
  { register: 'LZ', number: 12 },
)
const address = fc
  .record({ device: fc.constantFrom(...devices.map(({ name }) => name)), number, extension, index })
  .map(
    ({ extension, index, ...plain }): DeviceAddress => ({
      ...plain,
      ...(extension === undefined ? {} : { extension }),
      ...(index === undefined ? {} : { index }),
    }),
  )
const device = address.map((one) => ({ device: one }))
const points = fc.integer({ min: 1, max: 1000 })
const block = fc.record({ head: address, points })
const few = { maxLength: 5 }

const asked = fc.oneof(
  fc.record({ head: address, points }).map((message) => ({ command: commands.readWords, message }) as const),
  fc.record({ head: address, points }).map((message) => ({ command: commands.readBits, message }) as const),
  fc
    .record({ words: fc.array(device, few), doubleWords: fc.array(device, few) })
    .map((message) => ({ command: commands.readRandom, message }) as const),
  fc
    .record({ wordBlocks: fc.array(block, few), bitBlocks: fc.array(block, few) })
    .map((message) => ({ command: commands.readBlock, message }) as const),
)

function refusalOf(make: () => unknown): string | undefined {
  try {
    make()
    return undefined
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return `${error.code} ${error.field} ${error.message}`
  }
}

const BY_ENCODER = /^(BAD_ADDRESS|BAD_MESSAGE|OUT_OF_RANGE) /

/** The form that the subcommand of a request says. */
function formOf(body: Buffer, code: DataCode) {
  const bits = code === 'ascii' ? Number.parseInt(body.toString('latin1', 4, 8), 16) : body.readUInt16LE(2)
  if ((bits & 0x80) !== 0) return (bits & 2) !== 0 ? 'extendedLong' : 'extendedShort'
  return (bits & 2) !== 0 ? 'long' : 'short'
}

const codes: readonly DataCode[] = ['binary', 'ascii']

test.each(profileIds.flatMap((id) => codes.map((code) => [id, code] as const)))(
  '%s, %s: a request is refused by check as by exchange, and measured as it is sent',
  (id, code) => {
    const protocol = protocolOf(id, code)
    fc.assert(
      fc.property(asked, ({ command, message }) => {
        const refusal = refusalOf(() => protocol.exchange(command, message as never))
        const checked = refusalOf(() => protocol.check(command, message as never))
        // An address that cannot be at all is no item's: the parser refuses it, and the encoder.
        if (checked === undefined && refusal !== undefined && BY_ENCODER.test(refusal)) return
        expect(checked).toBe(refusal)
        if (refusal !== undefined) return
        const { body, answerBody } = protocol.exchange(command, message as never)
        const form = formOf(body, code)
        expect(protocol.bodyBytes(command, message as never, form)).toBe(body.length + (answerBody() ?? 0))
      }),
      { numRuns: 200 },
    )
  },
)

test('a type that was parsed before is a type of its own', () => {
  const first = parseType('STRING(20)')
  Object.assign(first, { length: 1 })
  expect(parseType('STRING(20)')).toEqual({ name: 'STRING', length: 20 })
})
