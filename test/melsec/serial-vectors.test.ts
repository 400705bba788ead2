// Serial frames as the manual has them: 1C, 3C and 4C in formats 1, 4 and 5.
import { expect, test } from '@jest/globals'
import { sumOf } from '../../src/codec/codec'
import { type SerialHead, serialFrameFacts, serialRoute, serialRouteFields } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { testFeedings, testWrongSum } from '../vectors/feedings'
import { bodyOf, optionsOf, serialCase, serialVectors } from '../vectors/serial-case'
import { bytesOf, type FieldVector, vectorsOfKind } from '../vectors/vectors'

const noLength = () => undefined
const route4c = { station: 0, network: 0, pc: 0xff, moduleIo: 0x3ff, multidrop: 0, selfStation: 0 }

for (const vector of serialVectors) {
  testFeedings(vector.id, vector.side, () => serialCase(vector))
  // The sum is the last thing of a frame but in format 4.
  if (vector.sumCheck === true && !vector.frame.endsWith('4')) testWrongSum(vector.id, () => serialCase(vector))
}

test('every frame in every format, requests, answers with data and without, and refusals', () => {
  const starts = serialVectors.map(({ frame, hex }) => `${frame} ${hex.slice(0, 2)}`)
  expect(starts).toEqual(
    expect.arrayContaining([
      ...['1C1 05', '1C1 02', '1C1 06', '1C1 15', '1C4 05', '1C4 02'],
      ...['3C1 05', '3C1 06', '3C1 15', '3C4 05', '3C4 02', '3C4 06', '3C4 15'],
      ...['4C1 05', '4C4 02', '4C4 06', '4C5 10'],
    ]),
  )
})

const data1c = [
  ...vectorsOfKind('mc-serial-ascii', 'requestData'),
  ...vectorsOfKind('mc-serial-ascii', 'responseData'),
].filter(({ frame }) => frame === '1C1')
const with1cData = serialVectors.flatMap((vector) => {
  const same = data1c.find(
    ({ kind, command, message }) =>
      kind === `${vector.side}Data` &&
      command === vector.command &&
      JSON.stringify(message) === JSON.stringify(vector.message),
  )
  return same === undefined ? [] : [{ id: vector.id, vector, same }]
})

test.each(with1cData)('$id carries the data that are printed alone', ({ vector, same }) => {
  expect(bodyOf(vector).toString('hex')).toBe(same.hex)
})

test('most 1C frames carry such data', () => {
  expect(with1cData.length).toBeGreaterThan(12)
})

test.each(vectorsOfKind('mc-serial', 'additionalCode'))('$id: 10H is doubled', (vector) => {
  const framing = serialFraming({ frame: '4C', format: 5, sumCheck: false })
  const frame = framing.request.write(route4c, 0, Buffer.from(vector.unstuffed, 'hex'))
  expect(frame.subarray(12, -2).toString('hex')).toBe(vector.hex)
  expect(framing.request.scan(frame, noLength)?.frame.body.toString('hex')).toBe(vector.unstuffed)
})

test.each(vectorsOfKind('mc-serial-ascii', 'sum'))('$id: sum check code', (vector) => {
  const over = Buffer.from(vector.over, 'hex')
  expect(sumOf(over).toString(16).toUpperCase()).toBe(bytesOf(vector).toString('latin1'))
  // The frame that it is the sum of.
  const framing = serialFraming({ frame: '3C', format: 1 })
  const head = { station: 0, network: 0, pc: 0xff, selfStation: 0 }
  const frame = framing.request.write(head, 0, over.subarray(10))
  expect(frame.toString('hex')).toBe(`05${vector.over}${vector.hex}`)
})

test.each(vectorsOfKind('mc-serial-ascii', 'control'))('$id: what brings the PLC to a known state', (vector) => {
  const initialise = vector.id.includes('cl') ? 'CL' : 'EOT'
  const format = vector.frame === '1C4' ? 4 : 1
  const framing = serialFraming({ frame: '1C', format, initialise })
  expect(framing.recovery?.toString('hex')).toBe(vector.hex)
  // The PLC takes it for no request, also in the middle of one.
  const request = framing.request.write({ station: 0, pc: 0xff }, 0, Buffer.from('RR0'))
  const half = Buffer.concat([request.subarray(0, 6), bytesOf(vector)])
  expect(framing.request.noise?.(bytesOf(vector))).toBe(bytesOf(vector).length)
  expect(() => framing.request.scan(half, () => 3)).toThrow()
})

test('format 5 has no such code', () => {
  expect(serialFraming({ frame: '4C', format: 5 }).recovery).toHaveLength(0)
})

const fields = [...vectorsOfKind('mc-serial', 'field'), ...vectorsOfKind('mc-serial-ascii', 'field')].filter(
  (vector): vector is FieldVector & { frame: '3C1' | '4C1' | '4C5' } => /^[34]C/.test(vector.frame ?? ''),
)

/** Offset in bytes of binary code of a field behind the start code (format 5: behind DLE STX). */
function offsetOf(frame: '3C' | '4C', format: 1 | 4 | 5, name: string): number {
  const facts = serialFrameFacts[frame]
  if (name === 'dataBytes') return 0
  let at = format === 5 ? 2 : 0
  if (name === 'frameId') return at
  at += 1
  for (const field of facts.route) {
    if (field === name) return at
    at += serialRouteFields[field].width
  }
  throw new Error(`there is no field ${name}`)
}

test.each(fields)('$id: field', ({ frame: name, fields: parts, hex }) => {
  const { frame, format } = optionsOf({ ...serialVectors[0], frame: name } as (typeof serialVectors)[number])
  if (frame === '1C') throw new Error('1C has no such vector')
  const values = Object.fromEntries(parts.map((part) => [part.name, part.value]))
  const { dataBytes = 12, frameId: _, ...route } = values
  // Frame ID 1, route 7, response ID 2 and end code 2 count as well.
  const body = Buffer.alloc(dataBytes - 12)
  const known: SerialHead = { ...serialRoute(frame), ...route }
  const written = serialFraming({ frame, format }).response.write(known, 0, 0, body)
  const unit = format === 5 ? 1 : 2
  const start = (format === 5 ? 2 : 1) + offsetOf(frame, format, parts[0]?.name ?? '') * unit
  expect(written.toString('hex', start, start + hex.length / 2)).toBe(hex)
})
