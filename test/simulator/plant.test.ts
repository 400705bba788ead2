import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import {
  demoPlantTags,
  type PlantTagName,
  type PlcSimulatorOptions,
  plantVariantOf,
  startDemoPlant,
} from '../../src/simulator/simulator'
import { parseType } from '../../src/value/value'
import { join } from './support'

function plant(options: PlcSimulatorOptions = {}, interval = 200) {
  const joined = join({ restartTime: 100, ...options })
  const { plc, clock } = joined
  const demo = startDemoPlant(plc, { interval })
  const tags = demoPlantTags[plantVariantOf(plc.profile.id)]
  const tagOf = (name: PlantTagName) => {
    const tag = tags.find((candidate) => candidate.name === name)
    if (tag === undefined) throw new Error(name)
    return tag
  }
  const get = (name: PlantTagName) => {
    const { address, encoding } = tagOf(name)
    return plc.read(address, encoding === undefined ? {} : { encoding })
  }
  const set = (name: PlantTagName, value: boolean | number | string) => plc.write(tagOf(name).address, value)
  const seconds = (count: number) => clock.advance(count * 1000)
  /** Lets time pass until it is so; at most five minutes. */
  const until = (name: PlantTagName, value: unknown) => {
    for (let passed = 0; passed < 300 && get(name) !== value; passed++) seconds(1)
    expect([name, get(name)]).toEqual([name, value])
  }
  return { ...joined, demo, tags, get, set, seconds, until }
}

describe.each(['iq-r', 'iq-f', 'q', 'fx3'] as const)('on %s', (profile) => {
  test('makes batches: fills, heats, mixes, empties, counts, and takes the next product', () => {
    const { get, until, seconds } = plant({ profile })
    seconds(1)
    expect([get('phase'), get('inlet'), get('running')]).toEqual([1, true, true])
    const levels = [0, 5, 10].map((wait) => {
      seconds(wait)
      return Number(get('level'))
    })
    expect(levels).toEqual([...levels].sort((a, b) => a - b))
    expect([get('product'), get('productJa')]).toEqual(['Apple juice', 'りんごジュース'])
    until('phase', 2)
    expect(get('level')).toBeGreaterThanOrEqual(800)
    expect([get('heater'), get('agitator'), get('lowLevel')]).toEqual([true, true, true])
    until('phase', 3)
    expect(get('temperature')).toBeGreaterThanOrEqual(40)
    until('phase', 4)
    expect([get('outlet'), get('inlet')]).toEqual([true, false])
    until('batches', 1)
    expect([get('product'), get('productJa'), get('recipe')]).toEqual(['Green tea', '緑茶', 2])
    until('batches', 3)
    expect(get('product')).toBe('Apple juice')
  })

  test('every tag can be read in its type, and every writable one takes its value back', () => {
    const { plc, tags } = plant({ profile })
    for (const { address, encoding, writable, name } of tags) {
      const value = plc.read(address, encoding === undefined ? {} : { encoding })
      expect([name, typeof value]).not.toEqual([name, 'undefined'])
      expect(() => parseType(address.slice(address.indexOf(':') + 1))).not.toThrow()
      if (writable) expect(() => plc.write(address, value, encoding === undefined ? {} : { encoding })).not.toThrow()
    }
    expect(new Set(tags.map(({ name }) => name)).size).toBe(tags.length)
  })

  test('no two tags share a device', () => {
    const { plc, tags } = plant({ profile }, 60_000)
    for (const tag of tags) {
      plc.memory.clear()
      const type = parseType(tag.address.slice(tag.address.indexOf(':') + 1))
      const full = type.name === 'BOOL' ? true : type.length === undefined ? -1 : 'x'.repeat(type.length)
      plc.write(tag.address, type.name.startsWith('U') ? 1 : full)
      const touched = tags.filter(({ address, encoding }) => {
        const value = plc.read(address, encoding === undefined ? {} : { encoding })
        return value !== 0 && value !== false && value !== ''
      })
      expect(touched).toEqual([tag])
    }
  })
})

describe('people', () => {
  test('the stop button ends automatic operation with outputs off, the start button resumes it', () => {
    const { get, set, seconds, until } = plant()
    seconds(10)
    set('stop', true)
    seconds(1)
    expect([get('running'), get('inlet'), get('stop'), get('phase')]).toEqual([false, false, false, 0])
    const level = get('level')
    seconds(10)
    expect(get('level')).toBe(level)
    set('start', true)
    until('phase', 2)
    expect(get('start')).toBe(false)
  })

  test('buttons can be pressed over the wire', () => {
    const { get, seconds, asker } = plant()
    asker.ask(commands.writeBits, { head: { device: 'M', number: 1 }, values: [true] })
    seconds(1)
    expect(get('running')).toBe(false)
  })

  test.each([
    ['levelSetPoint', 5000],
    ['levelSetPoint', -1],
    ['temperatureSetPoint', 99.5],
    ['mixingTime', 0],
  ] as const)('%s %d is an alarm, which is acknowledged and started again', (name, value) => {
    const { get, set, seconds, until } = plant()
    seconds(2)
    const before = get(name)
    set(name, value)
    until('alarm', true)
    expect([get('alarmCode'), get('running'), get('inlet')]).toEqual([1, false, false])
    set('start', true)
    seconds(1)
    expect(get('running')).toBe(false)
    set(name, Number(before))
    set('acknowledge', true)
    seconds(1)
    expect([get('alarm'), get('alarmCode')]).toEqual([false, 0])
    set('start', true)
    seconds(1)
    expect(get('running')).toBe(true)
  })

  test('a set-point that is not a number is an alarm', () => {
    const { plc, get, seconds } = plant()
    plc.memory.setWord('D', 110, 0)
    plc.memory.setWord('D', 111, 0x7fc0)
    seconds(1)
    expect(get('alarmCode')).toBe(1)
  })

  test('another recipe is the product of the next batch, an unknown one is the first', () => {
    const { get, set, until } = plant()
    set('recipe', 2)
    until('batches', 1)
    expect(get('product')).toBe('Oolong tea')
    set('recipe', 77)
    until('batches', 2)
    expect(get('product')).toBe('Green tea')
  })
})

describe('the CPU', () => {
  test('in STOP all outputs are off and the program stands still', () => {
    const { plc, get, seconds, asker } = plant()
    seconds(5)
    asker.ask(commands.remoteStop, {})
    expect(['inlet', 'outlet', 'heater', 'agitator'].map((name) => get(name as PlantTagName))).toEqual(
      new Array(4).fill(false),
    )
    const before = [get('scans'), get('level')]
    seconds(10)
    expect([get('scans'), get('level')]).toEqual(before)
    asker.ask(commands.remoteRun, { mode: 1 })
    seconds(1)
    expect([plc.cpu.state, get('inlet')]).toEqual(['RUN', true])
    expect(get('scans')).toBeGreaterThan(Number(before[0]))
  })

  test('in PAUSE the outputs stay, so the tank runs over; the program sees it in RUN', () => {
    const { get, set, seconds, asker } = plant()
    seconds(5)
    asker.ask(commands.remotePause, { mode: 1 })
    seconds(60)
    expect([get('inlet'), get('highLevel')]).toEqual([true, true])
    asker.ask(commands.remoteRun, { mode: 1 })
    seconds(1)
    expect([get('level'), get('alarmCode'), get('inlet')]).toEqual([1000, 2, false])
    set('acknowledge', true)
    set('start', true)
    seconds(1)
    expect([get('alarm'), get('phase')]).toEqual([false, 2])
  })

  test('a heater that stays on in PAUSE is an alarm in RUN', () => {
    const { get, seconds, until, asker } = plant()
    until('phase', 2)
    asker.ask(commands.remotePause, { mode: 1 })
    seconds(120)
    asker.ask(commands.remoteRun, { mode: 1 })
    seconds(1)
    expect([get('alarmCode'), get('heater')]).toEqual([3, false])
    expect(get('temperature')).toBeLessThanOrEqual(100)
  })

  test('after a restart and after a clear the program has its initial values', () => {
    const { plc, clock, get, seconds, until, asker } = plant()
    until('batches', 1)
    plc.restart()
    clock.advance(100)
    seconds(1)
    expect([get('batches'), get('levelSetPoint'), get('running')]).toEqual([0, 800, true])
    until('batches', 1)
    asker.close()
  })

  test('after Remote RUN with clearing it goes on from the beginning', () => {
    const { get, seconds, until, asker } = plant()
    until('batches', 1)
    asker.ask(commands.remoteStop, {})
    asker.ask(commands.remoteRun, { mode: 1, clearMode: 1 })
    seconds(1)
    expect([get('batches'), get('levelSetPoint'), get('alarm'), get('running')]).toEqual([0, 800, false, true])
  })
})

describe('physics', () => {
  test('stays within bounds for hours, whatever is forced', () => {
    const { plc, get, clock } = plant({}, 1000)
    for (let minute = 0; minute < 4 * 60; minute++) {
      if (minute % 7 === 0) plc.cpu.switch = plc.cpu.switch === 'RUN' ? 'STOP' : 'RUN'
      if (minute % 11 === 0) plc.memory.setWord('Y', 0x20, (minute * 2654435761) & 0xffff)
      clock.advance(60_000)
      expect(get('level')).toBeGreaterThanOrEqual(0)
      expect(get('level')).toBeLessThanOrEqual(1000)
      expect(get('temperature')).toBeGreaterThanOrEqual(14.9)
      expect(get('temperature')).toBeLessThanOrEqual(100)
    }
  })

  test('the temperature falls to the surroundings', () => {
    const { plc, get, set, seconds, until } = plant()
    until('phase', 3)
    set('stop', true)
    seconds(5000)
    expect(get('temperature')).toBeCloseTo(20, 0)
    expect(plc.cpu.state).toBe('RUN')
  })
})

describe('starting and ending', () => {
  test('stop ends it, close of the PLC too: no timer is left', async () => {
    const one = plant()
    one.demo.stop()
    expect(one.clock.pending).toBe(0)
    const two = plant()
    expect(two.clock.pending).toBe(1)
    await two.plc.close()
    expect(two.clock.pending).toBe(0)
  })

  test('without autoStart it waits for the start button', () => {
    const { plc, clock } = join()
    startDemoPlant(plc, { autoStart: false })
    clock.advance(10_000)
    expect(plc.read('D100:REAL')).toBe(0)
    plc.write('M0', true)
    clock.advance(10_000)
    expect(plc.read('D100:REAL')).toBeGreaterThan(100)
  })

  test.each([0, -1, Number.NaN])('interval %d is refused', (interval) => {
    expect(() => startDemoPlant(join().plc, { interval })).toThrow(RequestError)
  })
})
