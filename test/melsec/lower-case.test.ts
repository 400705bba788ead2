/** ASCII digits in lower case: peers exist that send them. They are read everywhere; upper case is written. */
import { type AddressInfo, createServer, connect as dial, type Server, type Socket } from 'node:net'
import { afterEach, describe, expect, test } from '@jest/globals'
import { type DataCode, readerOf } from '../../src/codec/codec'
import { createPlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient } from '../../src/index'
import { deviceAddress, FORM_EXTENDED } from '../../src/melsec/device/codec'
import { explainFrame } from '../../src/melsec/explain/frame'
import { frame1e } from '../../src/melsec/frame/frame-1e'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { tcpTransport } from '../../src/transport/tcp'
import { record } from '../transport/recorder'

const closing: (() => Promise<unknown>)[] = []
afterEach(async () => {
  for (const close of closing.splice(0).reverse()) await close()
})

const lower = (bytes: Buffer): Buffer => Buffer.from(bytes.toString('latin1').toLowerCase(), 'latin1')
const route = { network: 0xab, station: 0xcd, moduleIo: 0x3ef, multidrop: 0x1f }
const ascii: DataCode = 'ascii'

describe('frames', () => {
  test.each(['3E', '4E'] as const)('%s: subheader, serial number, route, length, timer and end code', (name) => {
    const { request, response } = slmpFraming(name, ascii)
    const asked = request.write({ ...route, timer: 0xfed }, 0xabcd, Buffer.from('04010000ABCD'.repeat(4)))
    const answered = response.write({ ...route, timer: 0 }, 0xabcd, 0xc05c, Buffer.from('ABCDEF'))
    for (const [scan, frame] of [
      [request.scan, asked],
      [response.scan, answered],
    ] as const) {
      const found = scan(lower(frame), () => undefined)
      expect(found).toBeDefined()
      const { body, ...head } = found?.frame ?? { body: Buffer.alloc(0) }
      const { body: upper, ...same } = scan(frame, () => undefined)?.frame ?? { body: Buffer.alloc(0) }
      expect(head).toEqual(same)
      expect(body).toEqual(lower(upper))
    }
    // Also as the bytes come one by one: nothing is taken for rubbish.
    for (let end = 1; end < answered.length; end++) {
      expect(response.scan(lower(answered).subarray(0, end), () => undefined)).toBeUndefined()
    }
  })

  test('1E: subheader, PC number, timer and end code', () => {
    const { request, response } = frame1e(ascii)
    const asked = request.write({ command: 0x1e, pc: 0xfa, timer: 0xabcd }, 0, Buffer.alloc(0))
    expect(request.scan(lower(asked), () => 0)).toEqual(request.scan(asked, () => 0))
    const refused = response.write({ command: 0x1f, pc: 0, timer: 0 }, 0, 0x5f, Buffer.alloc(0))
    expect(response.scan(lower(refused), () => 0)).toEqual(response.scan(refused, () => 0))
  })

  test('4C format 5: the sum check code', () => {
    const { request } = serialFraming({ frame: '4C', format: 5 })
    const head = { ...route, pc: 0xff, selfStation: 0 }
    // Bodies differ, so that sums with letters are among them.
    for (let i = 0; i < 32; i++) {
      const frame = request.write(head, 0, Buffer.from([i]))
      const sum = frame.length - 2
      const small = Buffer.concat([frame.subarray(0, sum), lower(frame.subarray(sum))])
      expect(request.scan(small, () => undefined)).toEqual(request.scan(frame, () => undefined))
      expect(explainFrame(small, { frame: '4C' }).rows.at(-1)?.text).toMatch(/right/)
    }
  })
})

test.each([
  ['W*0000ab', 0, { device: 'W', number: 0xab }],
  ['X*00cdef', 0, { device: 'X', number: 0xcdef }],
  ['00J0abZ03W*00001fZ04', FORM_EXTENDED, { device: 'W', number: 0x1f, extension: { kind: 'link', network: 0xab } }],
  ['00U0bc000G*000100000', FORM_EXTENDED, { device: 'G', number: 100, extension: { kind: 'module', unit: 0xbc } }],
] as const)('device %s', (text, form, address) => {
  const reader = readerOf(ascii, Buffer.from(text), form)
  expect(deviceAddress.read(reader)).toMatchObject(address)
})

test.each(['0401', '0401 in 4E'])('a frame is explained as the one in upper case: %s', (name) => {
  const start = name === '0401' ? '5000' : '5400ABCD0000'
  const frame = Buffer.from(`${start}00FF03FF000018001004010000W*0000AB000A`)
  const small = Buffer.from(frame.toString('latin1').toLowerCase().replace('w*', 'W*'))
  const texts = (bytes: Buffer) => explainFrame(bytes).rows.map(({ name: field, text }) => [field, text])
  expect(explainFrame(small).fault).toBeUndefined()
  expect(texts(small).slice(1)).toEqual(texts(frame).slice(1))
})

test('the answer of an error is explained, and a 1E frame is known for ASCII code', () => {
  const answer = Buffer.from('d00000ff03ff000016c05c00ff03ff0004010001')
  expect(explainFrame(answer)).toMatchObject({ code: 'ascii', direction: 'response', endCode: 0xc05c })
  expect(explainFrame(answer).fault).toBeUndefined()
  expect(explainFrame(Buffer.from('8a00'), { frame: '1E' }).code).toBe('ascii')
})

describe('the simulator', () => {
  test.each([
    ['3E', 'iq-r', '500000ff03ff00001c001014010000W*0000ab0001beef', 'd00000ff03ff0000040000'],
    ['4E', 'iq-r', '5400abcd000000ff03ff00001c001014010000W*0000ab0001beef', 'd400abcd000000ff03ff0000040000'],
    ['1E', 'fx3', '03ff000a44200000000a0100beef', '8300'],
  ] as const)('%s: reads lower case and answers in upper case', async (_frame, profile, request, answer) => {
    const plc = createPlcSimulator({ profile, code: ascii })
    await plc.listen()
    const { host, port } = plc.tcp ?? { host: '', port: 0 }
    const client = record(tcpTransport({ host, port })())
    closing.push(
      () => plc.close(),
      async () => client.transport.close(),
    )
    await client.opened
    client.transport.send(Buffer.from(request))
    const upper = answer.toUpperCase()
    expect((await client.bytes(upper.length)).toString('latin1')).toBe(upper)
    expect(plc.read(profile === 'fx3' ? 'D10:UINT' : 'WAB:UINT')).toBe(0xbeef)
  })
})

/** A PLC whose answers have their digits in lower case. */
async function lowerCase(port: number): Promise<number> {
  const sockets: Socket[] = []
  const server: Server = createServer((peer) => {
    const plc = dial(port, '127.0.0.1')
    sockets.push(peer, plc)
    peer.pipe(plc)
    plc.on('data', (chunk: Buffer) => void peer.write(lower(chunk)))
    for (const [socket, other] of [
      [peer, plc],
      [plc, peer],
    ] as const) {
      socket.on('error', () => {}).on('close', () => other.destroy())
    }
  })
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve))
  closing.push(() => {
    for (const socket of sockets) socket.destroy()
    return new Promise((resolve) => server.close(resolve))
  })
  return (server.address() as AddressInfo).port
}

test.each([
  ['3E', 'iq-r'],
  ['4E', 'iq-r'],
  ['1E', 'iq-f'],
] as const)('a client reads values and end codes in %s', async (frame, profile) => {
  const xy = profile === 'iq-f' ? ({ asciiXy: 'octal' } as const) : {}
  const plc = createPlcSimulator({ profile, code: ascii, frames: [frame], ...xy })
  await plc.listen()
  closing.push(() => plc.close())
  const port = await lowerCase(plc.tcp?.port ?? 0)
  const client = createMelsecClient({ host: '127.0.0.1', port, profile, frame, code: ascii, ...xy })
  closing.push(() => client.close())
  plc.write('D100:UINT', 0xabcd)
  plc.write('D101:UINT', 0xbeef)
  expect(await client.read('D100:UINT[2]')).toEqual([0xabcd, 0xbeef])
  const endCode = frame === '1E' ? 0x5f : 0xc0de
  plc.faults.add({ kind: 'endCode', endCode, times: 1 })
  await expect(client.read('D100')).rejects.toMatchObject({ endCode })
})
