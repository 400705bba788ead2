import { describe, expect, test } from '@jest/globals'
import {
  type BottlingTagName,
  demoBottlingTags,
  type JwSimulatorOptions,
  startDemoBottling,
} from '../../src/simulator/simulator'
import { parseByteType } from '../../src/value/byte-type'
import { joinJw, jwCommands } from './jw-support'

function bottling(options: JwSimulatorOptions = {}) {
  const joined = joinJw({ restartTime: 100, ...options })
  const { plc, clock } = joined
  const demo = startDemoBottling(plc)
  const tagOf = (name: BottlingTagName) => {
    const tag = demoBottlingTags.find((candidate) => candidate.name === name)
    if (tag === undefined) throw new Error(name)
    return tag
  }
  const get = (name: BottlingTagName) => {
    const { address, encoding } = tagOf(name)
    return plc.read(address, encoding === undefined ? {} : { encoding })
  }
  const set = (name: BottlingTagName, value: boolean | number) => plc.write(tagOf(name).address, value)
  const seconds = (count: number) => clock.advance(count * 1000)
  return { ...joined, demo, get, set, seconds }
}

const OUTPUTS = ['supplyPump', 'conveyor', 'fillValve', 'rejecter'] as const

test('bottles come, are filled, counted, and one that foamed is rejected', () => {
  const { get, seconds } = bottling()
  const seen = new Set<unknown>()
  for (let i = 0; i < 120 && Number(get('rejected')) < 2; i++) {
    seconds(1)
    seen.add(get('phase'))
  }
  expect([...seen].sort()).toEqual([1, 2, 3])
  expect(get('rejected')).toBe(2)
  expect(Number(get('bottles'))).toBeGreaterThanOrEqual(34)
  expect(Number(get('good')) + Number(get('rejected'))).toBe(get('bottles'))
  expect(get('shiftCount')).toBe(get('good'))
  expect([get('product'), get('productJa'), get('running'), get('alarm')]).toEqual(['Barley tea', '麦茶', true, false])
})

test('the supply is filled up again', () => {
  const { get, seconds } = bottling()
  let pumped = false
  for (let i = 0; i < 900; i++) {
    seconds(1)
    pumped ||= get('supplyPump') === true
  }
  expect(pumped).toBe(true)
  expect(Number(get('supply'))).toBeGreaterThan(30)
  expect(get('alarm')).toBe(false)
})

test('buttons start and stop it; the last word is that of stop', () => {
  const { get, set, seconds } = bottling()
  seconds(2)
  set('stop', true)
  seconds(1)
  expect([get('running'), get('stop'), get('phase'), ...OUTPUTS.map(get)]).toEqual([
    false,
    false,
    0,
    false,
    false,
    false,
    false,
  ])
  set('start', true)
  set('stop', true)
  seconds(1)
  expect(get('running')).toBe(false)
  set('start', true)
  seconds(1)
  expect([get('running'), get('start')]).toEqual([true, false])
})

describe('an alarm stops it until it is acknowledged and started again', () => {
  test.each([
    ['recipeAlarm', 'bottleSize', 0, 500],
    ['recipeAlarm', 'conveyorSpeed', 501, 250],
  ] as const)('%s: %s is %i', (alarm, setting, wrong, right) => {
    const { get, set, seconds } = bottling()
    set(setting, wrong)
    seconds(1)
    expect([get('alarm'), get(alarm), get('running'), get('fillValve')]).toEqual([true, true, false, false])
    set('start', true)
    seconds(1)
    expect(get('running')).toBe(false)
    set(setting, right)
    set('acknowledge', true)
    set('start', true)
    seconds(1)
    expect([get('alarm'), get(alarm), get('running')]).toEqual([false, false, true])
  })

  test('rejectAlarm: three rejected bottles in a row', () => {
    const { clock, get, set, plc } = bottling()
    // The valve gives way whenever it opens.
    let rejected = 0
    for (let i = 0; i < 2000 && get('alarm') !== true; i++) {
      clock.advance(200)
      if (get('phase') === 2 && Number(get('fillLevel')) > 100) set('bottleSize', Number(get('fillLevel')) - 10)
      if (get('phase') === 3) set('bottleSize', 2000)
      rejected = Number(get('rejected'))
    }
    expect([get('rejectAlarm'), get('running'), rejected >= 3]).toEqual([true, false, true])
    expect(plc.read('004022')).toBe(true)
  })
})

test('a PLC that is stopped has its outputs off and counts no scans', () => {
  const { asker, get, seconds } = bottling()
  seconds(3)
  asker.ask(jwCommands.setRunState, { state: 1 })
  const scans = get('scans')
  expect(OUTPUTS.map(get)).toEqual([false, false, false, false])
  seconds(5)
  expect(get('scans')).toBe(scans)
  asker.ask(jwCommands.setRunState, { state: 0 })
  seconds(5)
  expect(Number(get('scans'))).toBeGreaterThan(Number(scans))
})

test('after a power failure it goes on with its counts; close() ends it', async () => {
  const { plc, clock, get, seconds } = bottling()
  seconds(20)
  const bottles = Number(get('bottles'))
  plc.restart()
  seconds(20)
  expect(Number(get('bottles'))).toBeGreaterThan(bottles)
  await plc.close()
  const scans = get('scans')
  clock.advance(5000)
  expect(get('scans')).toBe(scans)
})

test('an interval below 1 ms is refused before anything is written', () => {
  const { plc } = joinJw()
  expect(() => startDemoBottling(plc, { interval: 0 })).toThrow('interval is 1 ms or more, not 0.')
  expect(plc.read('19000:UINT')).toBe(0)
})

test('its tags are operands with types that do not overlap', () => {
  const taken = new Map<string, string>()
  for (const { name, address } of demoBottlingTags) {
    const [operand = '', type] = address.split(':')
    const size =
      type === undefined
        ? 1
        : ({ STRING: Number(/\d+/.exec(type)?.[0]), UINT: 2 }[parseByteType(type).name as 'UINT'] ?? 4)
    const start = Number.parseInt(operand.replace(/^(\d)9/, '$1'), 8)
    const isBit = operand.length === 6
    for (let at = start; at < start + size; at++) {
      const key = `${isBit ? 'bit' : 'byte'} ${at}`
      expect([key, taken.get(key)]).toEqual([key, undefined])
      taken.set(key, name)
    }
  }
})
