// The station extension frame beside its vectors: what it repeats, its fixed values, its other error information.
import { describe, expect, test } from '@jest/globals'
import { EndCodeError, ProtocolError, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { explainFrame, formatExplanation } from '../../src/melsec/explain/frame'
import { completeRoute } from '../../src/melsec/frame/route'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'

const head: SlmpHead = { ...completeRoute({ network: 1, station: 300 }), timer: 16 }
const framing = slmpFraming('ext', 'binary')
const protocol = new MelsecProtocol({ framing, head, profile: resolveProfile('iq-r'), code: 'binary' })
/** Read of 1 word from D100, short form; station 300 = 012CH. */
const REQUEST = '6800 3412 0000 01 7c ff03 00 00 2c01 1200 1000 0104 0000 00 0000000000 640000 a8 0100'.replaceAll(
  ' ',
  '',
)
const ROUTE = '01 7c ff03 00 00 2c01'
const ECHO = '0104 0000 00 0000000000'

function bytes(...parts: readonly string[]): Buffer {
  return Buffer.from(parts.join('').replaceAll(' ', ''), 'hex')
}

/** An answer with end code and what stands behind it. */
function answer(endCode: string, body: string, route = ROUTE): Buffer {
  const rest = bytes(endCode, body)
  const length = Buffer.of(rest.length, 0)
  return Buffer.concat([bytes('e800 3412 0000', route), length, rest])
}

function reading() {
  return protocol.exchange(commands.readWords, { head: { device: 'D', number: 100 }, points: 1 }, { form: 'short' })
}

/** What the request makes of an answer. */
function decoded(answered: Buffer): unknown {
  const scanned = framing.response.scan(answered, () => undefined)
  if (scanned?.used !== answered.length) throw new Error('not one answer')
  return reading().decode(scanned.frame)
}

function failure(run: () => unknown): Error {
  try {
    run()
  } catch (error) {
    if (error instanceof Error) return error
  }
  throw new Error('it did not fail')
}

describe('a request', () => {
  test('has the extension station behind the route, and fixed values behind the subcommand', () => {
    expect(framing.request.write(head, 0x1234, reading().body).toString('hex')).toBe(REQUEST)
  })

  test('says extension station 0 when the station field says all', () => {
    const own = framing.request.write({ ...completeRoute({ network: 3, station: 120 }), timer: 0 }, 1, Buffer.alloc(0))
    expect(own.subarray(6, 14).toString('hex')).toBe('0378ff0300000000')
  })

  test('is read back by the PLC side', () => {
    const scanned = framing.request.scan(bytes(REQUEST), () => undefined)
    expect(scanned?.frame.head).toEqual(head)
    if (scanned === undefined) throw new Error('not one request')
    expect(protocol.readRequest(scanned.frame)).toMatchObject({
      name: 'readWords',
      form: 'short',
      message: { head: { device: 'D', number: 100 }, points: 1 },
    })
  })

  test.each([
    ['fixedValue', 22],
    ['systemArea', 23],
    ['systemArea', 26],
    ['systemAreaEnd', 27],
  ])('with another value in its %s (byte %i) is none', (name, at) => {
    const broken = bytes(REQUEST)
    broken[at] = 1
    const scanned = framing.request.scan(broken, () => undefined)
    if (scanned === undefined) throw new Error('not one request')
    expect(failure(() => protocol.readRequest(scanned.frame))).toMatchObject({ code: 'BAD_FIELD' })
    expect(explainFrame(broken).fault).toMatchObject({ name })
  })

  test('with another value in front of the extension station is no frame', () => {
    const broken = bytes(REQUEST)
    broken[11] = 1
    expect(failure(() => framing.request.scan(broken, () => undefined))).toMatchObject({
      code: 'BAD_FRAME',
      offset: 11,
    })
    expect(explainFrame(broken).fault).toMatchObject({ name: 'fixedValue' })
  })

  test('exists in binary code only', () => {
    expect(failure(() => slmpFraming('ext', 'ascii'))).toBeInstanceOf(RequestError)
  })

  test.each(['3E', '4E'] as const)('of a %s frame cannot say an extension station: it is not left out', (frame) => {
    expect(failure(() => slmpFraming(frame, 'binary').request.write(head, 0, Buffer.alloc(0)))).toMatchObject({
      code: 'BAD_OPTION',
      field: 'route.extensionStation',
    })
  })
})

describe('an answer', () => {
  test('repeats the command in front of its data', () => {
    expect(decoded(answer('0000', `${ECHO} 3930`))).toEqual({ values: [12345] })
  })

  test.each([
    ['another command', '0114 0000 00 0000000000 3930', 'command 1401, subcommand 0000, not command 0401'],
    ['another subcommand', '0104 0100 00 0000000000 3930', 'command 0401, subcommand 0001, not command 0401'],
  ])('about %s is not believed', (_what, body, says) => {
    const error = failure(() => decoded(answer('0000', body)))
    expect(error).toBeInstanceOf(ProtocolError)
    expect(error).toMatchObject({ code: 'ECHO_MISMATCH', message: expect.stringContaining(says) })
  })

  test.each([
    ['nothing behind the end code', '', 'TRUNCATED'],
    ['half an echo', '0104 00', 'TRUNCATED'],
    ['another value in the system area', '0104 0000 00 0000000001 3930', 'BAD_FIELD'],
    ['no data', ECHO, 'TRUNCATED'],
    ['data of a 4E answer', '3930', 'TRUNCATED'],
    ['too much data', `${ECHO} 3930 00`, 'TRAILING'],
  ])('with %s is none', (_what, body, code) => {
    expect(failure(() => decoded(answer('0000', body)))).toMatchObject({ name: 'ProtocolError', code })
  })

  test('of another extension station is not the answer', () => {
    const answered = (route: string) => framing.response.scan(answer('0000', ECHO, route), () => undefined)?.frame.head
    const mismatch = (route: string) => {
      const found = answered(route)
      if (found === undefined) throw new Error('not one answer')
      return framing.mismatch(head, found)
    }
    expect(mismatch(ROUTE)).toBeUndefined()
    expect(mismatch('01 7c ff03 00 00 2d01')).toBe('extensionStation is 301, asked 300')
    expect(mismatch('01 7c ff03 00 00 0000')).toBe('extensionStation is 0, asked 300')
    expect(mismatch('01 05 ff03 00 00 2c01')).toBe('station is 5, asked 124')
  })
})

describe('a refusal', () => {
  test('names the station that failed, behind the command', () => {
    const error = failure(() => decoded(answer('51c0', `${ECHO} 02 7c e003 00 00 feff`)))
    expect(error).toBeInstanceOf(EndCodeError)
    expect(error).toMatchObject({ endCode: 0xc051, station: 'network 2, station 65534, module I/O 03E0, multidrop 0' })
  })

  test('of another command is not believed', () => {
    const error = failure(() => decoded(answer('51c0', '0114 0000 00 0000000000 00 ff ff03 00 00 0000')))
    expect(error).toMatchObject({ code: 'ECHO_MISMATCH', message: expect.stringContaining('end code C051') })
  })

  test.each([
    ['nothing', ''],
    ['the command alone', ECHO],
    ['the command and half the station', `${ECHO} 01 7c`],
    ['the station of a 4E answer', `${ECHO} 01 7c ff03 00`],
  ])('that says %s is one without a station', (_what, body) => {
    const error = failure(() => decoded(answer('51c0', body)))
    expect(error).toMatchObject({ name: 'EndCodeError', endCode: 0xc051, outcome: 'refused' })
    expect(error).not.toHaveProperty('station', expect.anything())
  })

  test('that says another command and no station is not believed either', () => {
    const error = failure(() => decoded(answer('51c0', '0114 0000 00 0000000000 01')))
    expect(error).toMatchObject({ code: 'ECHO_MISMATCH' })
  })

  test('is not in the order of a 4E frame', () => {
    // Read so, it would be a refusal of command 7C01.
    const error = failure(() => decoded(answer('51c0', '01 7c ff03 00 0104 0000 00 0000000000 0000')))
    expect(error).toMatchObject({ code: 'ECHO_MISMATCH' })
  })
})

describe('in words', () => {
  const request = bytes(REQUEST)

  test('a request with its station', () => {
    const text = formatExplanation(explainFrame(request))
    expect(text.split('\n')[0]).toBe('station extension request, binary code: Read (word units), D100, 1 point')
    expect(text).toMatch(/extensionStation +300 \(012CH\)/)
    expect(text).toMatch(/systemArea +fixed/)
    expect(text).toMatch(/command +0401H \(Read \(word units\)\)/)
  })

  test('an answer by its request, and without it by the command it repeats', () => {
    const good = answer('0000', `${ECHO} 3930`)
    const text = formatExplanation(explainFrame(good, { request }))
    expect(text.split('\n')[0]).toBe('station extension response, binary code: Read (word units), D100, 1 point')
    expect(text).toMatch(/values +D100: 12345 \(3039H\)/)
    expect(explainFrame(good)).toMatchObject({
      title: 'station extension response, binary code: Read (word units)',
      frame: 'ext',
      serial: 0x1234,
      command: 'readWords',
      endCode: 0,
      notes: [expect.stringContaining('give it to have them named')],
    })
  })

  test('an answer to another command than the request is said to be one', () => {
    const other = explainFrame(answer('0000', '0114 0000 00 0000000000'), { request })
    expect(other).toMatchObject({ command: 'writeWords', notes: [expect.stringContaining('another command')] })
    expect(other.fault).toBeUndefined()
  })

  test('a refusal with the station that failed', () => {
    const text = formatExplanation(explainFrame(answer('51c0', `${ECHO} 00 ff ff03 00 00 0000`), { request }))
    expect(text.split('\n')[0]).toBe('station extension response, binary code: refused (Read (word units))')
    expect(text).toMatch(/station +255 \(FFH: the connected station\)/)
    expect(text).toMatch(/extensionStation +0 \(0000H: the station field says it/)
  })
})
