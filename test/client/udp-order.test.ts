/**
 * Answers without a serial number over real UDP, from a PLC written by hand: D[n] holds n, late or twice when the test
 * says so. Whose answer is it?
 */
import { createSocket, type RemoteInfo, type Socket } from 'node:dgram'
import { once } from 'node:events'
import { afterEach, describe, expect, test } from '@jest/globals'
import { createMelsecClient, type MelsecClient, type MelsecOptions, type NetworkPlc } from '../../src/index'
import { failureOf, until } from './line'

interface Asked {
  /** `D100`, `D100=7` or `echo`. */
  readonly what: string
  readonly answer: Buffer
}

type Reader = (frame: Buffer) => Asked | undefined

const word = (value: number): Buffer => Buffer.of(value & 0xff, value >> 8)

/** 3E, binary: 0401, 1401, 0101 and 0619. D5000 takes no value. */
const read3e: Reader = (frame) => {
  const command = frame.readUInt16LE(11)
  const number = frame.length >= 18 ? frame.readUIntLE(15, 3) : 0
  const answer = (endCode: number, data: Buffer) =>
    Buffer.concat([Buffer.of(0xd0, 0), frame.subarray(2, 7), word(2 + data.length), word(endCode), data])
  switch (command) {
    case 0x0101:
      return undefined
    case 0x0619:
      return { what: 'echo', answer: answer(0, frame.subarray(15)) }
    case 0x0401:
      return { what: `D${number}`, answer: answer(0, word(number)) }
    case 0x1401: {
      const refused = Buffer.concat([frame.subarray(2, 7), frame.subarray(11, 15)])
      const what = `D${number}=${frame.readUInt16LE(21)}`
      return { what, answer: number === 5000 ? answer(0x4031, refused) : answer(0, Buffer.alloc(0)) }
    }
    default:
      throw new Error(`unexpected ${frame.toString('hex')}`)
  }
}

const typeName3e = (frame: Buffer): Buffer =>
  Buffer.concat([
    Buffer.of(0xd0, 0),
    frame.subarray(2, 7),
    word(20),
    word(0),
    Buffer.from('Q03UDVCPU       '),
    word(0x366),
  ])

/** 1E, binary: 01H, 03H, 15H and 16H. */
const read1e: Reader = (frame) => {
  const number = frame.length >= 8 ? frame.readUInt32LE(4) : 0
  switch (frame[0]) {
    case 0x15:
      return undefined
    case 0x16:
      return { what: 'echo', answer: Buffer.concat([Buffer.of(0x96, 0), frame.subarray(4)]) }
    case 0x01:
      return { what: `D${number}`, answer: Buffer.concat([Buffer.of(0x81, 0), word(number)]) }
    case 0x03:
      return {
        what: `D${number}=${frame.readUInt16LE(12)}`,
        answer: number === 5000 ? Buffer.of(0x83, 0x57) : Buffer.of(0x83, 0),
      }
    default:
      throw new Error(`unexpected ${frame.toString('hex')}`)
  }
}

const frames = {
  '3E': { read: read3e, typeName: typeName3e, client: { frame: '3E', profile: 'q' } },
  '1E': { read: read1e, typeName: () => Buffer.of(0x95, 0, 0xf3), client: { frame: '1E', profile: 'iq-f' } },
} as const

type FrameUnderTest = keyof typeof frames

const cleanups: (() => unknown)[] = []
afterEach(async () => {
  for (const cleanup of cleanups.splice(0)) await cleanup()
})

async function bound(): Promise<Socket> {
  const socket = createSocket('udp4')
  socket.bind(0, '127.0.0.1')
  await once(socket, 'listening')
  return socket
}

async function freePort(): Promise<number> {
  const socket = await bound()
  const { port } = socket.address()
  await new Promise<void>((resolve) => socket.close(() => resolve()))
  return port
}

async function line(frame: FrameUnderTest, options: Partial<MelsecOptions & NetworkPlc> = {}) {
  const socket = await bound()
  cleanups.push(() => new Promise<void>((resolve) => socket.close(() => resolve())))
  const { read, typeName, client: kind } = frames[frame]
  const plc = {
    /** With the number of the port they came from. */
    asked: [] as { what: string; port: number }[],
    script: (_what: string, reply: () => void): void => reply(),
  }
  const send = (bytes: Buffer, { port, address }: RemoteInfo) => socket.send(bytes, port, address)
  socket.on('message', (bytes, from) => {
    const asked = read(bytes)
    if (asked === undefined) return send(typeName(bytes), from)
    plc.asked.push({ what: asked.what, port: from.port })
    plc.script(asked.what, () => send(asked.answer, from))
  })
  const client: MelsecClient = createMelsecClient({
    host: '127.0.0.1',
    port: socket.address().port,
    transport: 'udp',
    ...kind,
    allowWrites: true,
    timeout: 1000,
    reconnect: { first: 5, longest: 20 },
    ...options,
  })
  cleanups.push(() => client.close())
  await client.connect()
  return { plc, client }
}

const told = (call: Promise<unknown>) =>
  call.then(
    (value) => value ?? 'done',
    (error: { code: string; outcome: string }) => `${error.code} ${error.outcome}`,
  )

describe.each(['3E', '1E'] as const)('%s over UDP', (frame) => {
  test('several calls ended by one signal: what was given up is never sent, and nobody gets its answer', async () => {
    const { plc, client } = await line(frame)
    const abort = new AbortController()
    const { signal } = abort
    const given = [100, 200, 300].map((number) => told(client.read(`D${number}`, { signal })))
    const mine = told(client.read('D400'))
    abort.abort()
    expect(await Promise.all(given)).toEqual(['ABORTED unknown', 'ABORTED notSent', 'ABORTED notSent'])
    expect(await mine).toBe(400)
    expect(plc.asked.map(({ what }) => what).sort()).toEqual(['D100', 'D400'])
    expect(new Set(plc.asked.map(({ port }) => port)).size).toBe(2)
  })

  test('the same with writes: a refused one is never told as done', async () => {
    const { plc, client } = await line(frame)
    const abort = new AbortController()
    const { signal } = abort
    const given = [1000, 2000].map((number) => told(client.write(`D${number}`, 1, { signal })))
    const mine = told(client.write('D5000', 7))
    abort.abort()
    expect(await Promise.all(given)).toEqual(['ABORTED unknown', 'ABORTED notSent'])
    expect(await mine).toBe('END_CODE refused')
    expect(plc.asked.map(({ what }) => what)).not.toContain('D2000=1')
  })

  test('from ports of its own: every answer again and again, later, and no value is another one', async () => {
    const { plc, client } = await line(frame)
    const earlier: (() => void)[] = []
    plc.script = (_what, reply) => {
      // To the ports they were asked from, before and behind the answer of this one.
      for (const again of earlier.slice(-20)) again()
      reply()
      for (const again of earlier.slice(-20)) again()
      earlier.push(reply)
    }
    for (let number = 1; number <= 150; number++) expect(await client.read(`D${number}`)).toBe(number)
    expect(await told(client.write('D5000', 7))).toBe('END_CODE refused')
    expect(await told(client.write('D7', 7))).toBe('done')
    expect(new Set(plc.asked.map(({ port }) => port)).size).toBe(plc.asked.length)
  })

  test('from a fixed port: an answer later than everything is not taken for the next one', async () => {
    const { plc, client } = await line(frame, { localPort: await freePort(), timeout: 60 })
    // In order, as a PLC answers: what is held back comes before all that was asked behind it.
    const held: (() => void)[] = []
    let slow = false
    plc.script = (what, reply) => {
      if (what === 'D100') slow = true
      if (slow) held.push(reply)
      else reply()
    }
    expect(await told(client.read('D100'))).toBe('TIMEOUT unknown')
    for (let round = 0; round < 4; round++) expect(await told(client.read('D200'))).toContain('notSent')
    expect(plc.asked.map(({ what }) => what)).not.toContain('D200')
    const next = told(client.read('D200', { timeout: 2000 }))
    slow = false
    for (const reply of held.splice(0)) reply()
    const value = await next
    // It may have met the pause before the next attempt; then it says so, and sent nothing.
    if (value !== 200) expect(value).toBe('OFFLINE notSent')
    await until(() => client.state.name === 'connected')
    expect(await client.read('D200')).toBe(200)
    expect(await client.read('D201')).toBe(201)
  })

  test('from a fixed port: an attempt whose proof comes back behind the deadline ends, and the next one connects', async () => {
    const { plc, client } = await line(frame, { localPort: await freePort(), timeout: 100 })
    plc.script = () => {}
    while (client.state.name === 'connected') expect(await told(client.read('D100'))).toBe('TIMEOUT notSent')
    let stalls = 1
    plc.script = (what, reply) => {
      reply()
      if (what !== 'echo' || client.state.name !== 'connecting' || stalls-- < 1) return
      // The whole program stands still until the first request of the connection is overdue.
      for (const end = performance.now() + 250; performance.now() < end; );
    }
    await until(() => client.state.name === 'connected')
    expect(stalls).toBeLessThan(1)
    expect(await client.read('D200', { timeout: 5000 })).toBe(200)
  })

  test('from a fixed port: every answer twice, the second one later, and no value is another one', async () => {
    const { plc, client } = await line(frame, { localPort: await freePort() })
    let again = () => {}
    plc.script = (_what, reply) => {
      // The copy of the answer before, still in order, and this one.
      again()
      reply()
      again = reply
    }
    for (const number of [1, 2, 3, 4, 5, 6]) expect(await client.read(`D${number}`)).toBe(number)
    expect(await told(client.write('D5000', 7))).toBe('END_CODE refused')
    expect(await told(client.write('D7', 7))).toBe('done')
  })
})

test.each([
  { network: 1, station: 2 },
  { moduleIo: 0x3e0 },
  { moduleIo: 0x3e1 },
  { moduleIo: 0x3d0 },
  { moduleIo: 0x3d1 },
  { moduleIo: 0x10 },
  { moduleIo: 0x10, multidrop: 1 },
])('3E from a fixed port to %j is refused, because the self test proves nothing there', async (route) => {
  const routed = { host: '127.0.0.1', port: 1, transport: 'udp', profile: 'q', route } as const
  expect(() => createMelsecClient({ ...routed, frame: '3E', localPort: 5000 })).toThrow(
    'With the 3E frame over UDP and a fixed localPort only the connected station and its own CPU (module I/O 03FF) can be reached',
  )
  await createMelsecClient({ ...routed, frame: '3E' }).close()
  await createMelsecClient({ ...routed, frame: '4E', localPort: 5000 }).close()
  await createMelsecClient({ ...routed, frame: '3E', transport: 'tcp', localPort: 5000 }).close()
  await createMelsecClient({ ...routed, frame: '3E', localPort: 5000, route: { moduleIo: 0x3ff } }).close()
})

test.each<[string, Answer0619]>([
  [
    'refuses the self test',
    (bytes) => answer3e(bytes, 0xc059, Buffer.concat([bytes.subarray(2, 7), bytes.subarray(11, 15)])),
  ],
  ['answers it with something else', (bytes) => answer3e(bytes, 0, word(7))],
])('a PLC that %s is used from a fixed port until it leaves a request unanswered', async (_what, selfTest) => {
  let late = (): void => {}
  const { port, asked } = await plainPlc((bytes, reply) => {
    const command = bytes.readUInt16LE(11)
    if (command === 0x0619) return reply(selfTest(bytes))
    if (command === 0x0101) return reply(typeName3e(bytes))
    const what = bytes.readUIntLE(15, 3)
    const answer = answer3e(bytes, 0, word(what))
    if (what !== 100) return reply(answer)
    late = () => reply(answer)
  })
  const client = createMelsecClient({
    host: '127.0.0.1',
    port,
    transport: 'udp',
    frame: '3E',
    profile: 'q',
    localPort: await freePort(),
    timeout: 80,
    reconnect: { first: 5, longest: 20 },
  })
  cleanups.push(() => client.close())
  await client.connect()
  expect(await client.read('D1')).toBe(1)
  expect(await client.read('D2')).toBe(2)
  expect(await told(client.read('D100'))).toBe('TIMEOUT unknown')
  const error = await failureOf(client.read('D200'))
  expect(error).toMatchObject({ outcome: 'notSent' })
  expect(error.message).toContain('did not return the self test')
  expect(error.message).toContain('leave localPort out')
  late()
  for (let round = 0; round < 5; round++) expect(await told(client.read('D200'))).toContain('notSent')
  expect(asked).not.toContain(200)
})

test('a PLC that does not answer self tests is not believed on a fixed port: nothing is sent, and the error says what helps', async () => {
  const { port, asked } = await plainPlc((bytes, reply) => {
    const command = bytes.readUInt16LE(11)
    if (command !== 0x0619) reply(command === 0x0101 ? typeName3e(bytes) : answer3e(bytes, 0, word(1)))
  })
  const options = { host: '127.0.0.1', port, transport: 'udp', profile: 'q', timeout: 80 } as const
  const fixed = createMelsecClient({ ...options, frame: '3E', localPort: await freePort() })
  cleanups.push(() => fixed.close())
  const error = await failureOf(fixed.read('D1', { timeout: 1000 }))
  expect(error.outcome).toBe('notSent')
  expect(error.message).toContain('leave localPort out')
  expect(asked).toEqual([])
  const free = createMelsecClient({ ...options, frame: '3E' })
  cleanups.push(() => free.close())
  expect(await free.read('D1')).toBe(1)
})

test('a self test that was asked twice proves nothing before the second one is back: the PLC may refuse that', async () => {
  const held: (() => void)[] = []
  let hold = false
  const refusal = (bytes: Buffer) =>
    answer3e(bytes, 0x0055, Buffer.concat([bytes.subarray(2, 7), bytes.subarray(11, 15)]))
  const { port, asked } = await plainPlc((bytes, reply) => {
    const command = bytes.readUInt16LE(11)
    if (command === 0x0101) return reply(typeName3e(bytes))
    if (command === 0x0401) return reply(answer3e(bytes, 0, word(bytes.readUIntLE(15, 3))))
    const number = held.length
    const answer = number === 1 ? refusal(bytes) : answer3e(bytes, 0, bytes.subarray(15))
    if (!hold) return reply(answer)
    held.push(() => reply(answer))
    // In order: the echo of the first, the refusal of the second, and from then on as it should be.
    if (held.length === 2) {
      hold = false
      for (const one of held) one()
    }
  })
  const client = createMelsecClient({
    host: '127.0.0.1',
    port,
    transport: 'udp',
    frame: '3E',
    profile: 'q',
    localPort: await freePort(),
    timeout: 400,
  })
  cleanups.push(() => client.close())
  await client.connect()
  hold = true
  expect(await client.read('D7', { timeout: 5000 })).toBe(7)
  expect(asked).toEqual([7])
})

test('late echoes of the program before do not make a PLC one that has no self test', async () => {
  const held: (() => void)[] = []
  let holds = true
  const { port, asked } = await plainPlc((bytes, reply) => {
    const command = bytes.readUInt16LE(11)
    const answer = {
      257: () => typeName3e(bytes),
      1025: () => answer3e(bytes, 0, word(bytes.readUIntLE(15, 3))),
      1561: () => answer3e(bytes, 0, bytes.subarray(15)),
    }[command]
    if (answer === undefined) throw new Error(bytes.toString('hex'))
    if (holds) held.push(() => reply(answer()))
    else reply(answer())
  })
  const options = {
    host: '127.0.0.1',
    port,
    transport: 'udp',
    frame: '3E',
    profile: 'q',
    localPort: await freePort(),
  } as const
  const before = createMelsecClient({ ...options, timeout: 160 })
  expect(await told(before.read('D1'))).toContain('notSent')
  await before.close()
  const late = held.splice(0)
  expect(late.length).toBeGreaterThan(2)
  const after = createMelsecClient({ ...options, timeout: 400 })
  cleanups.push(() => after.close())
  const read = told(after.read('D7', { timeout: 5000 }))
  await until(() => held.length >= 2)
  // In order: all that the program before had asked, and only later what this one asks.
  for (const one of late) one()
  await until(() => after.statistics.stale >= late.length)
  await until(() => held.length >= 3)
  holds = false
  for (const one of held.splice(0)) one()
  expect(await read).toBe(7)
  expect(asked).toEqual([7])
})

test('4E on a fixed port: an answer to the program before is not taken for one with the same number', async () => {
  const socket = await bound()
  cleanups.push(() => new Promise<void>((resolve) => socket.close(() => resolve())))
  const late: (() => void)[] = []
  socket.on('message', (bytes, from) => {
    const command = bytes.readUInt16LE(15)
    const number = bytes.length >= 22 ? bytes.readUIntLE(19, 3) : 0
    const data =
      command === 0x0101 ? typeName3e(bytes).subarray(11) : command === 0x0619 ? bytes.subarray(19) : word(number)
    const frame = Buffer.concat([Buffer.of(0xd4, 0), bytes.subarray(2, 11), word(2 + data.length), word(0), data])
    const send = () => socket.send(frame, from.port, from.address)
    if (number === 100) return void late.push(send)
    // In order: what is late comes before all that was asked behind it.
    for (const one of late.splice(0)) one()
    send()
  })
  const options = {
    host: '127.0.0.1',
    port: socket.address().port,
    transport: 'udp',
    frame: '4E',
    profile: 'q',
    localPort: await freePort(),
    timeout: 100,
    // Both programs begin with the same number.
    random: () => 0.5,
  } as const
  const before = createMelsecClient(options)
  expect(await told(before.read('D100'))).toBe('TIMEOUT unknown')
  await before.close()
  const after = createMelsecClient({ ...options, timeout: 2000 })
  cleanups.push(() => after.close())
  expect(await after.read('D200')).toBe(200)
  expect(after.statistics.stale).toBeGreaterThan(0)
})

type Answer0619 = (request: Buffer) => Buffer | undefined

function answer3e(request: Buffer, endCode: number, data: Buffer): Buffer {
  return Buffer.concat([Buffer.of(0xd0, 0), request.subarray(2, 7), word(2 + data.length), word(endCode), data])
}

/** Answers as the test says; `asked` has the device numbers of the reads. */
async function plainPlc(serve: (bytes: Buffer, reply: (answer: Buffer | undefined) => void) => void) {
  const socket = await bound()
  cleanups.push(() => new Promise<void>((resolve) => socket.close(() => resolve())))
  const asked: number[] = []
  socket.on('message', (bytes, from) => {
    if (bytes.readUInt16LE(11) === 0x0401) asked.push(bytes.readUIntLE(15, 3))
    serve(bytes, (answer) => answer && socket.send(answer, from.port, from.address))
  })
  return { port: socket.address().port, asked }
}
