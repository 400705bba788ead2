import { describe, expect, test } from '@jest/globals'
import {
  type Context,
  type Declaration,
  decode,
  encode,
  measure,
  type Named,
  readerOf,
  type Shape,
  writerOf,
} from '../../src/codec/codec'
import type { BodyLength, Framing, Head } from '../../src/link/link'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { aCompatibleProtocol } from '../../src/melsec/a-compatible/protocol'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { FORM_BITS, subcommandOf } from '../../src/melsec/device/form'
import { bodies } from '../../src/melsec/frame/body'
import { frame1e, type Head1e, mayEndWithZero, zeroBehind } from '../../src/melsec/frame/frame-1e'
import type { Route } from '../../src/melsec/frame/route'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { type FrameCase, testFeedings } from '../vectors/feedings'
import { bytesOf, type FrameVector, type Vector, vectorsOfKind } from '../vectors/vectors'

const profile = resolveProfile('generic')
const own = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0 }
const noLength: BodyLength = () => {
  throw new Error('a frame with a length asked for one')
}

function given<T>(value: T | undefined, what: string): T {
  if (value === undefined) throw new Error(`the vector has no ${what}`)
  return value
}

/** Fixed value and system area of the station extension frame. */
const RESERVED = [0, 0, 0, 0, 0, 0]

/** Body of a frame of the SLMP set: command, subcommand and data, response data, or error information. */
function bodyOf(vector: FrameVector): Buffer {
  const { code, form = 'short', side, message } = vector
  const extended = vector.frame === 'ext'
  const command = commands[vector.command as CommandName]
  const writer = writerOf(code, FORM_BITS[form])
  if (side === 'request' || (extended && message !== undefined)) {
    writer.uint(command.code, 2)
    writer.uint(subcommandOf(command, form, profile), 2)
    if (extended) writer.bytes(RESERVED)
  }
  if (side === 'request') encode<Shape>(command.request, given(message, 'message'), writer)
  else if (message !== undefined) encode<Shape>(command.response, message, writer, contextOf(vector))
  else if (vector.errorInformation !== undefined) {
    encode<Shape>(bodies[frameOf(vector)].errorInformation, vector.errorInformation, writer)
  }
  return writer.take()
}

function contextOf({ command, request }: FrameVector): Context {
  return { shape: commands[command as CommandName].request, message: given(request, 'request') }
}

/** Those of serial frames are plain. */
function frameOf({ frame }: FrameVector): '3E' | '4E' | 'ext' {
  return frame === '4E' || frame === 'ext' ? frame : '3E'
}

function routeOf(vector: FrameVector): Route {
  const { network, station, moduleIo, multidrop, extensionStation } = vector.head?.route ?? {}
  return {
    network: given(network, 'network'),
    station: given(station, 'station'),
    moduleIo: given(moduleIo, 'module I/O'),
    multidrop: given(multidrop, 'multidrop'),
    ...(extensionStation === undefined ? {} : { extensionStation }),
  }
}

function slmpCase(vector: FrameVector): FrameCase<SlmpHead> {
  const { code, side, endCode, head } = vector
  const unit = code === 'ascii' ? 2 : 1
  const route = routeOf(vector)
  return {
    framing: slmpFraming(frameOf(vector), code),
    side,
    bytes: bytesOf(vector),
    head: { ...route, timer: side === 'request' ? given(head?.timer, 'timer') : 0 },
    askedHead: { ...route, timer: 0 },
    body: bodyOf(vector),
    ...(endCode === undefined ? {} : { endCode }),
    ...(head?.serial === undefined ? {} : { serial: head.serial, serialAt: { start: 2 * unit, end: 4 * unit } }),
    bodyLength: noLength,
  }
}

/** Length of the response data, told from the request alone. */
function measured(vector: FrameVector): number {
  const { command, code, form = 'short' } = vector
  const { response } = commands[command as CommandName]
  return measure(response, { ascii: code === 'ascii', form: FORM_BITS[form], context: contextOf(vector) })
}

describe.each(['slmp', 'mc-serial'] as const)('normal answers of %s', (family) => {
  const answers = vectorsOfKind(family, 'frame').filter(({ side, endCode }) => side === 'response' && endCode === 0)

  test.each(answers)('$id is measured from its request', (vector) => {
    const echo = vector.frame === 'ext' ? 4 + RESERVED.length : 0
    expect(echo + measured(vector)).toBe(bodyOf(vector).length)
  })
})

describe('3E, 4E and station extension frames', () => {
  const vectors = vectorsOfKind('slmp', 'frame')
  for (const vector of vectors) testFeedings(vector.id, vector.side, () => slmpCase(vector))

  const refusals = vectors.filter((vector) => vector.errorInformation !== undefined)
  test.each(refusals)('$id: error information is read', (vector) => {
    const reader = readerOf(vector.code, bodyOf(vector))
    expect(decode(bodies[frameOf(vector)].errorInformation, reader)).toEqual(vector.errorInformation)
    reader.end()
  })

  test('cover every frame, code and side, and refusals', () => {
    const kinds = vectors.map(({ frame, code, side }) => `${frame} ${code} ${side}`)
    // 4E ASCII requests are in print only as subheader and data.
    expect(new Set(kinds).size).toBe(9)
    const refused = new Set(refusals.map(({ frame, code }) => `${frame} ${code}`))
    expect(refused.size).toBeGreaterThanOrEqual(4)
    expect(refused).toContain('ext binary')
  })

  test.each(vectorsOfKind('slmp', 'subheader'))('$id: subheader', (vector) => {
    const framing = slmpFraming(vector.frame, vector.code)
    const head = { ...own, timer: 0 }
    const { serial = 0, side } = vector
    const bytes =
      side === 'request'
        ? framing.request.write(head, serial, Buffer.alloc(0))
        : framing.response.write(head, serial, 0, Buffer.alloc(0))
    expect(bytes.toString('hex').slice(0, vector.hex.length)).toBe(vector.hex)
  })
})

type FieldVector = Vector & { kind: 'field' }

/** The field as it stands in a written frame: `at` is its offset in bytes of binary code. */
function expectField(vector: FieldVector, frame: Buffer, at: number): void {
  const start = at * (vector.code === 'ascii' ? 2 : 1)
  expect(frame.subarray(start, start + bytesOf(vector).length).toString('hex')).toBe(vector.hex)
}

function valuesOf(vector: FieldVector): Record<string, number> {
  return Object.fromEntries(vector.fields.map(({ name, value }) => [name, value]))
}

describe('fields of the 3E frame', () => {
  const AT: Record<string, number> = {
    network: 2,
    station: 3,
    moduleIo: 4,
    multidrop: 6,
    requestDataLength: 7,
    responseDataLength: 7,
    timer: 9,
    endCode: 9,
  }
  const vectors = vectorsOfKind('slmp', 'field').filter(({ fields }) => AT[fields[0]?.name ?? ''] !== undefined)

  test.each(vectors)('$id', (vector) => {
    const { timer = 0, endCode = 0, requestDataLength, responseDataLength, ...route } = valuesOf(vector)
    const length = requestDataLength ?? responseDataLength
    // Monitoring timer or end code counts as well.
    const body = Buffer.alloc(length === undefined ? 0 : length - (vector.code === 'ascii' ? 4 : 2))
    const head = { ...own, ...route, timer }
    const framing = slmpFraming('3E', vector.code)
    const frame =
      responseDataLength === undefined && vector.fields[0]?.name !== 'endCode'
        ? framing.request.write(head, 0, body)
        : framing.response.write(head, 0, endCode, body)
    expectField(vector, frame, AT[vector.fields[0]?.name ?? ''] ?? 0)
  })

  test('are at least one of each', () => {
    expect(new Set(vectors.map(({ fields }) => fields[0]?.name)).size).toBe(Object.keys(AT).length)
  })
})

function command1e(name: string): Declaration {
  return given(
    Object.values<Named<Declaration, string>>(aCompatibleCommands).find((command) => command.name === name),
    `declared command ${name}`,
  )
}

function body1e(vector: FrameVector): Buffer {
  const command = command1e(vector.command)
  const writer = writerOf(vector.code)
  if (vector.side === 'request') encode<Shape>(command.request, given(vector.message, 'message'), writer)
  else encode<Shape>(command.response, given(vector.message, 'message'), writer, context1e(vector, command.request))
  return writer.take()
}

function context1e(vector: FrameVector, shape: Shape): Context {
  return { shape, message: given(vector.request, 'request') }
}

/** How long the body is, as the protocol knows it: from the bytes of a request, from the request of an answer. */
function length1e(vector: FrameVector, head: Head, soFar: Buffer): number | undefined {
  const { code } = vector
  if (vector.side === 'request') return aCompatibleProtocol({ code }).requestLength(head, soFar)
  const command = command1e(vector.command)
  return measure(command.response, { ascii: code === 'ascii', form: 0, context: context1e(vector, command.request) })
}

const SUBHEADER_1E: Record<string, number> = {
  readBits: 0x00,
  readWords: 0x01,
  writeBits: 0x02,
  writeWords: 0x03,
  writeRandomBits: 0x04,
  writeRandomWords: 0x05,
  remoteRun: 0x13,
  remoteStop: 0x14,
  readPcType: 0x15,
  loopback: 0x16,
}

function case1e(vector: FrameVector): FrameCase<Head1e> {
  const command = given(SUBHEADER_1E[vector.command], 'known command')
  const { pc = 0, timer = 0 } = vector.head ?? {}
  const framing: Framing<Head1e> = frame1e(vector.code)
  return {
    framing,
    side: vector.side,
    bytes: bytesOf(vector),
    head: { command, pc, timer },
    askedHead: { command, pc: 0xff, timer: 0 },
    body: body1e(vector),
    ...(vector.endCode === undefined ? {} : { endCode: vector.endCode }),
    ...(vector.side === 'response' && mayEndWithZero(command, vector.endCode ?? 0)
      ? { mayFollow: zeroBehind[vector.code] }
      : {}),
    bodyLength: (head, soFar) => length1e(vector, head, soFar),
  }
}

describe('1E frame', () => {
  const vectors = vectorsOfKind('mc-ethernet-1e', 'frame')
  for (const vector of vectors) testFeedings(vector.id, vector.side, () => case1e(vector))

  test('cover every command that is declared, and no other', () => {
    const commands = vectors.map(({ command }) => command)
    const prefixes = vectorsOfKind('mc-ethernet-1e', 'prefix').map(({ command }) => command)
    expect(new Set([...commands, ...prefixes])).toEqual(new Set(Object.keys(aCompatibleCommands)))
    expect(SUBHEADER_1E).toEqual(
      Object.fromEntries(Object.entries(aCompatibleCommands).map(([name, { code }]) => [name, code])),
    )
  })

  test.each(vectorsOfKind('mc-ethernet-1e', 'prefix'))('$id: prefix', (vector) => {
    const { pc = 0, timer = 0 } = vector.head ?? {}
    const writer = writerOf(vector.code)
    encode<Shape>(command1e(vector.command).request, vector.message, writer)
    const head = { command: given(SUBHEADER_1E[vector.command], 'known command'), pc, timer }
    const frame = frame1e(vector.code).request.write(head, 0, writer.take())
    expect(frame.subarray(0, bytesOf(vector).length).toString('hex')).toBe(vector.hex)
    expect(frame.length).toBeGreaterThan(bytesOf(vector).length)
  })

  const data = vectorsOfKind('mc-ethernet-1e', 'responseData')
  test.each(data)('$id: response data', (vector) => {
    const command = command1e(vector.command)
    const context = { shape: command.request, message: vector.request }
    const writer = writerOf(vector.code)
    encode<Shape>(command.response, vector.message, writer, context)
    expect(writer.take().toString('hex')).toBe(vector.hex)
    const reader = readerOf(vector.code, bytesOf(vector))
    expect(decode<Shape>(command.response, reader, context)).toEqual(vector.message)
    reader.end()
  })

  const request = (code: 'binary' | 'ascii', device: 'D' | 'X', number: number, points: number) => {
    const writer = writerOf(code)
    encode<Shape>(aCompatibleCommands.readWords.request, { head: { device, number }, points }, writer)
    return writer.take()
  }

  test.each(vectorsOfKind('mc-ethernet-1e', 'deviceCode'))('$id: code of $device', (vector) => {
    expect(request(vector.code, 'X', 0, 1).subarray(4, 6).toString('hex')).toBe(vector.hex)
  })

  test.each(vectorsOfKind('mc-ethernet-1e', 'field'))('$id: field', (vector) => {
    const { deviceNumber = 0, points = 1, subheader } = valuesOf(vector)
    if (subheader !== undefined) {
      expect(given(SUBHEADER_1E[vector.command ?? ''], 'known command')).toBe(subheader)
      const head = { command: subheader, pc: 0xff, timer: 0 }
      expectField(vector, frame1e(vector.code).request.write(head, 0, Buffer.alloc(0)), 0)
      return
    }
    const at: Record<string, number> = { deviceNumber: vector.code === 'ascii' ? 2 : 0, points: 6, fixed: 7 }
    const body = request(vector.code, 'D', deviceNumber, points)
    expectField(vector, body, given(at[vector.fields[0]?.name ?? ''], 'known field'))
  })
})
