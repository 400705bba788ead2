/** The named calls of a client of a Sharp JW: control, clock, buffers, parameters, secret function, what it says of itself. */
import { afterEach, describe, expect, test } from '@jest/globals'
import type { JwClient } from '../../../src/client/jw/client'
import { failureOf } from '../line'
import { inMemory, SmallJw } from './small-jw'

let client: JwClient
let plc: SmallJw

function start(options: Parameters<typeof inMemory>[0] = {}, made?: SmallJw): void {
  const joined = inMemory(options, made)
  client = joined.client
  plc = joined.plc
}

afterEach(async () => {
  await client.close()
})

describe('control', () => {
  test('stops and releases the PLC and blocks of its program', async () => {
    start()
    await client.control.stop({ verify: true })
    expect([plc.state, await client.control.runState()]).toEqual([1, 'stopped'])
    await client.control.release({ verify: true })
    expect(plc.state).toBe(0)
    await client.control.stopBlock(0o777)
    expect(await client.control.blockState(0o777)).toBe('stopped')
    await client.control.releaseBlock(0o777)
    expect(await client.control.blockState(0o777)).toBe('running')
    expect(await failureOf(client.control.stopBlock(0o1000))).toMatchObject({ code: 'BAD_OPTION' })
  })

  test('a release that another unit keeps from having its effect is no success', async () => {
    start({ timeout: 150 })
    await client.connect()
    plc.script = (asked) => {
      asked.reply()
      plc.state = 2
    }
    const error = await failureOf(client.control.release({ verify: true }))
    expect(error).toMatchObject({ code: 'NOT_VERIFIED', state: 'stoppedElsewhere', outcome: 'unknown' })
    expect(plc.asked.filter((name) => name === 'setRunState')).toHaveLength(1)
  })

  test('the write mode is read first, and set only when it is another one', async () => {
    start()
    await client.connect()
    expect(await client.control.writeMode()).toBe('all')
    expect(await client.control.setWriteMode('all')).toBe('all')
    expect(plc.asked).toEqual(['readWriteMode', 'readWriteMode'])
    expect(await client.control.setWriteMode('data')).toBe('all')
    expect(plc.mode).toBe(1)
    expect(await failureOf(client.control.setWriteMode('some' as never))).toMatchObject({ code: 'BAD_OPTION' })
  })
})

describe('the clock', () => {
  test('is read as one moment, also at midnight', async () => {
    start()
    plc.date = { year: 4, month: 8, day: 18, dayOfWeek: 3 }
    plc.time = { hour: 23, minute: 59, second: 59 }
    let asked = 0
    plc.script = (request) => {
      request.reply()
      asked += 1
      if (asked === 2) {
        plc.date = { year: 4, month: 8, day: 19, dayOfWeek: 4 }
        plc.time = { hour: 0, minute: 0, second: 0 }
      }
    }
    expect(await client.clock.read()).toEqual({
      year: 4,
      month: 8,
      day: 19,
      dayOfWeek: 4,
      hour: 0,
      minute: 0,
      second: 0,
    })
  })

  test('is set and adjusted', async () => {
    start()
    await client.clock.set(new Date(2026, 10, 29, 14, 5, 6))
    expect(plc.date).toEqual({ year: 26, month: 11, day: 29, dayOfWeek: 0 })
    expect(plc.time).toEqual({ hour: 14, minute: 5, second: 6 })
    await client.clock.adjust()
    await client.clock.adjust({ stop: true, resetFraction: true })
    expect(plc.messages.slice(-2)).toEqual([{ control: 8 }, { control: 3 }])
    expect(await failureOf(client.clock.set(new Date(Number.NaN)))).toMatchObject({ code: 'BAD_VALUE' })
  })

  test.each([
    ['hour 25', { hour: 25 }],
    ['no second', { second: undefined }],
    ['29 February of a year that has none', { year: 26, month: 2, day: 29 }],
    ['31 April', { month: 4, day: 31 }],
    ['a setting there is none of', { minutes: 5 }],
  ])('is not set in part to what is no time: %s', async (_what, wrong) => {
    start()
    await client.connect()
    const time = { year: 4, month: 8, day: 18, dayOfWeek: 3, hour: 13, minute: 30, second: 0, ...wrong }
    expect(await failureOf(client.clock.set(time as never))).toMatchObject({ outcome: 'notSent' })
    expect(plc.asked).toEqual([])
  })

  test('has the right date when midnight passes in the PLC while it is set', async () => {
    start()
    const date = { year: 26, month: 11, day: 29, dayOfWeek: 0 }
    plc.script = (request) => {
      request.reply()
      if (plc.asked.length === 1) plc.date = { ...plc.date, day: 30, dayOfWeek: 1 }
    }
    await client.clock.set({ ...date, hour: 23, minute: 59, second: 59 })
    expect(plc.date).toEqual(date)
  })

  test('that was set just before midnight may show the next day', async () => {
    start()
    plc.script = (request) => {
      request.reply()
      if (request.name !== 'setTime') return
      plc.date = { year: 26, month: 11, day: 30, dayOfWeek: 1 }
      plc.time = { hour: 0, minute: 0, second: 0 }
    }
    const date = { year: 26, month: 11, day: 29, dayOfWeek: 0 }
    await client.clock.set({ ...date, hour: 23, minute: 59, second: 59 })
    expect(plc.asked.filter((name) => name === 'setDate')).toHaveLength(1)
  })

  test('that shows another day than it was set to is not set', async () => {
    start()
    plc.script = (request) => {
      request.reply()
      if (request.name === 'setDate') plc.date = { ...plc.date, day: 1 }
    }
    expect(await failureOf(client.clock.set(new Date(2026, 10, 29, 14, 5, 6)))).toMatchObject({ code: 'NOT_VERIFIED' })
  })

  test('that took the date and not the time says so', async () => {
    start()
    plc.refusals.set('setTime', 0x10)
    const error = await failureOf(client.clock.set(new Date()))
    expect(error).toMatchObject({ code: 'UNFINISHED', outcome: 'unknown' })
    expect(error.message).toContain('The date was set')
  })
})

describe('buffers', () => {
  test('specified ones are read and written by their offset', async () => {
    start()
    await client.buffers.specified.write(0x1f, 16, Uint8Array.of(1, 2, 3))
    expect([...(await client.buffers.specified.read(0x1f, 16, 3))]).toEqual([1, 2, 3])
    expect(await client.buffers.specified.info(1)).toMatchObject({ definition: 1, address: 0x2000 })
    await client.buffers.specified.define(1, { definition: 2, file: 1, address: 0x2000, length: 1024 })
  })

  test('ring buffers give and take, and a request of unknown outcome is not repeated', async () => {
    start({ timeout: 100 })
    plc.rings.set(3, [])
    expect(await client.buffers.ring.write(3, Uint8Array.of(1, 2, 3))).toEqual({ written: 3, free: 100, pointer: 0 })
    const first = await client.buffers.ring.read(3, 2)
    expect([[...first.data], first.more]).toEqual([[1, 2], true])
    await client.buffers.ring.read(3, 5, { confirmed: true, acknowledge: true })
    expect(plc.messages.at(-1)).toMatchObject({ function: 0x83, length: 5 })
    plc.script = () => {}
    plc.asked.length = 0
    expect(await failureOf(client.buffers.ring.read(3))).toMatchObject({ outcome: 'unknown' })
    expect(plc.asked).toEqual(['readRingBuffer'])
  })
})

describe('parameters of option units', () => {
  const place = { rack: 0, unit: 2 }
  const blocks = [{ address: 0, bytes: new Uint8Array(1500).fill(9) }]

  test('go in between stop and start, and the check code comes back', async () => {
    start()
    plc.parameters[0x7ff] = 1
    const unit = client.parameters.optionUnit(place)
    expect(await unit.write(blocks)).toEqual({ checkCode: 0x5a })
    expect(plc.messages).toMatchObject([
      { address: 0x7ff, data: Uint8Array.of(0) },
      { address: 0 },
      { address: 1024 },
      { address: 0x7ff, data: Uint8Array.of(1) },
      { address: 0x7fe, length: 2 },
    ])
    expect(await unit.read(0, 2048)).toEqual(Buffer.from(plc.parameters))
  })

  test('of two calls go in one after the other, so that a unit starts on the parameters of one', async () => {
    start()
    await client.connect()
    const unit = client.parameters.optionUnit(place)
    const again = client.parameters.optionUnit(place)
    const writing = [1, 2].map((byte) => [unit, again][byte - 1]?.write([{ address: 0, bytes: Uint8Array.of(byte) }]))
    await Promise.all(writing)
    const one = ['writeOptionParameters', 'writeOptionParameters', 'writeOptionParameters', 'readOptionParameters']
    expect(plc.asked).toEqual([...one, ...one])
    expect(plc.messages[1]).toMatchObject({ address: 0, data: Uint8Array.of(1) })
    expect(plc.messages[5]).toMatchObject({ address: 0, data: Uint8Array.of(2) })
  })

  test('over UDP they are cut so that messages stay below 1024 bytes', async () => {
    start({ transport: 'udp', header: 'zero40' }, new SmallJw('datagram'))
    await client.parameters.optionUnit(place).write(blocks)
    expect(plc.messages.map(({ address }) => address)).toEqual([0x7ff, 0, 974, 0x7ff, 0x7fe])
  })

  test.each([
    [0, 'END_CODE', ''],
    [1, 'UNFINISHED', 'start switch of the unit is 0'],
    [2, 'UNFINISHED', 'The new parameters 0000 to 1777 are in it'],
    [3, 'UNFINISHED', 'all of them are written'],
    [4, 'UNFINISHED', 'its check code could not be read back'],
  ])('a refusal of request %i', async (refused, code, text) => {
    start()
    let count = 0
    plc.script = (asked) => {
      if (count++ === refused) asked.peer.send(asked.refuse(0x10))
      else asked.reply()
    }
    const error = await failureOf(client.parameters.optionUnit(place).write(blocks))
    expect(error).toMatchObject({ code })
    expect(error.message).toContain(text)
    expect(plc.asked).toHaveLength(refused + 1)
  })

  test('a unit that does not show its start switch at 1 has perhaps not taken them over', async () => {
    start()
    plc.script = (asked) => {
      if (asked.name === 'readOptionParameters') plc.parameters[0x7ff] = 0
      asked.reply()
    }
    const writing = client.parameters.optionUnit(place).write(blocks)
    expect(await failureOf(writing)).toMatchObject({ code: 'NOT_VERIFIED' })
  })

  test('check code and start switch are not for the caller to write, and nothing is no parameters', async () => {
    start()
    const writing = client.parameters.optionUnit(place).write([{ address: 0x7ff, bytes: Uint8Array.of(1) }])
    expect(await failureOf(writing)).toMatchObject({ code: 'BAD_VALUE' })
    expect(await failureOf(client.parameters.optionUnit(place).write([]))).toMatchObject({ code: 'BAD_VALUE' })
    expect(() => client.parameters.optionUnit({ rack: 8, unit: 0 })).toThrow('rack')
    expect(plc.asked).toEqual([])
  })
})

test('parameters of units are refused for a model that has no commands for them', async () => {
  start({ model: 'jw30h' })
  const option = client.parameters.optionUnit({ rack: 0, unit: 0 })
  const special = client.parameters.specialIo({ rack: 0, unit: 0 })
  const unsupported = { code: 'UNSUPPORTED', outcome: 'notSent' }
  expect(await failureOf(option.read(0, 1))).toMatchObject(unsupported)
  expect(await failureOf(option.write([{ address: 0, bytes: Uint8Array.of(1) }]))).toMatchObject(unsupported)
  expect(await failureOf(special.read(0, 1))).toMatchObject(unsupported)
  expect(await failureOf(special.write(0, Uint8Array.of(1)))).toMatchObject(unsupported)
})

test('parameters of special I/O units are read and written', async () => {
  start()
  const unit = client.parameters.specialIo({ rack: 1, unit: 3 })
  await unit.write(0, Uint8Array.of(0xaa, 0x55))
  expect([...(await unit.read(0, 2))]).toEqual([0xaa, 0x55])
})

test('the secret function is asked for, enabled, and given a password', async () => {
  start()
  expect(await client.secret.isEnabled()).toBe(false)
  await client.secret.enable()
  expect(await client.secret.isEnabled()).toBe(true)
  await client.secret.register('a1B2', true)
  await client.secret.erasePassword()
  expect(plc.messages.slice(-2)).toEqual([{ function: 2, password: 'a1B2' }, { function: 15 }])
  expect(await failureOf(client.secret.release('toolong'))).toMatchObject({ outcome: 'notSent' })
})

test('what the PLC says of itself; what it refuses to tell is missing', async () => {
  start()
  await client.connect()
  plc.refusals.set('readDate', 0x34)
  expect(await client.info()).toEqual({
    memorySize: { code: 7, kiloWords: 64 },
    runState: 'running',
    writeMode: 'all',
    secret: false,
  })
  plc.refusals.clear()
  expect((await client.info()).clock).toEqual({ ...plc.date, ...plc.time })
})
