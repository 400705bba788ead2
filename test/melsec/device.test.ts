import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { type DeviceName, deviceInfo, devices, devicesOfGroup, findDevice } from '../../src/melsec/device/device'

describe('the device table', () => {
  test('has every device of the SLMP manual, S of the FX5 and the buffer memory devices, once', () => {
    const names = devices.map((info) => info.name)
    expect(names.join(' ')).toBe(
      'SM SD X Y M L F V B D W TS TC TN LTS LTC LTN STS STC STN LSTS LSTC LSTN CS CC CN LCS LCC LCN SB SW S DX DY Z LZ R ZR RD G HG',
    )
    expect(new Set(names).size).toBe(names.length)
  })

  test('has no device code twice and no ASCII code twice', () => {
    for (const key of ['code', 'text2', 'text4'] as const) {
      const codes = devices.flatMap((info) => info[key] ?? [])
      expect(new Set(codes).size).toBe(codes.length)
    }
  })

  test('long timers, long counters, LZ, RD and HG are the long-form devices of the SLMP manual', () => {
    expect(devices.filter((info) => info.longOnly).map((info) => info.name)).toEqual(
      'LTS LTC LTN LSTS LSTC LSTN LCS LCC LCN LZ RD HG'.split(' '),
    )
  })

  test('every long-form device but LZ, which the FX5 has a short form of, lacks the two-character code', () => {
    const without = devices.filter((info) => info.text2 === undefined).map((info) => info.name)
    expect(without).toEqual('LTS LTC LTN LSTS LSTC LSTN LCS LCC LCN RD HG'.split(' '))
    expect(deviceInfo('LZ').text2).toBe('LZ')
  })

  test('hexadecimal devices are X Y B W SB SW DX DY', () => {
    const hexadecimal = devices.filter((info) => info.radix === 16).map((info) => info.name)
    expect(hexadecimal).toEqual('X Y B W SB SW DX DY'.split(' '))
  })

  test('double-word devices are LTN LSTN LCN LZ', () => {
    const long = devices.filter((info) => info.unit === 'doubleWord').map((info) => info.name)
    expect(long).toEqual('LTN LSTN LCN LZ'.split(' '))
  })

  test('each timer and counter has a contact, a coil and a current value', () => {
    for (const group of ['T', 'LT', 'ST', 'LST', 'C', 'LC']) {
      const parts = devicesOfGroup(group).map((info) => [info.name, info.part])
      expect(parts).toEqual([
        [`${group}S`, 'contact'],
        [`${group}C`, 'coil'],
        [`${group}N`, 'current value'],
      ])
    }
    expect(devicesOfGroup('D')).toEqual([])
  })

  test('a name that is no device is undefined in a search and refused by deviceInfo', () => {
    expect(findDevice('T')).toBeUndefined()
    expect(findDevice('toString')).toBeUndefined()
    expect(() => deviceInfo('Q' as DeviceName)).toThrow(RequestError)
  })
})
