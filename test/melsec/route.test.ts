import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { type EthernetFrameName, ethernetFrameNames } from '../../src/melsec/frame/frames'
import {
  checkRouteOf,
  completeRoute,
  describeRoute,
  isConnectedStation,
  moduleIoNumbers,
  ownStation,
  type Route,
} from '../../src/melsec/frame/route'

function refusal(run: () => unknown): RequestError {
  try {
    run()
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('not refused')
}

describe('a route', () => {
  test('is the connected station when nothing is given', () => {
    expect(completeRoute()).toEqual({ network: 0, station: 255, moduleIo: 0x3ff, multidrop: 0 })
    const fromJavaScript: unknown = { network: undefined }
    expect(completeRoute(fromJavaScript as Partial<Route>)).toEqual(ownStation)
  })

  test('reaches stations 1 to 120 and the master stations of networks 1 to 239', () => {
    for (const network of [1, 239]) {
      for (const station of [1, 120, 125, 126]) {
        expect(completeRoute({ network, station })).toEqual({ ...ownStation, network, station })
      }
    }
  })

  test('reaches every named module I/O number of the manual', () => {
    const numbers = moduleIoNumbers.map(({ number }) => number.toString(16)).sort()
    expect(numbers).toEqual(['3d0', '3d1', '3d2', '3d3', '3e0', '3e1', '3e2', '3e3', '3ff'])
    for (const { number } of moduleIoNumbers) expect(completeRoute({ moduleIo: number }).moduleIo).toBe(number)
  })

  test('reaches multidrop stations 0 to 31 behind a serial module', () => {
    expect(completeRoute({ moduleIo: 0, multidrop: 31 })).toEqual({ ...ownStation, moduleIo: 0, multidrop: 31 })
    expect(completeRoute({ network: 2, station: 5, moduleIo: 0x1ff, multidrop: 0 }).moduleIo).toBe(0x1ff)
  })

  const REFUSED: [Partial<Route>, string, string][] = [
    [{ network: 240, station: 1 }, 'network', '1 to 239'],
    [{ network: -1, station: 1 }, 'network', '1 to 239'],
    [{ network: 1.5, station: 1 }, 'network', '1 to 239'],
    [{ station: 1 }, 'network', 'number of its network'],
    [{ network: 1 }, 'station', 'in network 0'],
    [{ network: 1, station: 0 }, 'station', '1 to 120'],
    [{ network: 1, station: 65_535 }, 'station', '121 to 65534'],
    [{ network: 1, station: 124 }, 'station', '{ station: 124, extensionStation: 124 }'],
    [{ network: 1, station: 255 }, 'station', '{ station: 124, extensionStation: 255 }'],
    [{ network: 1, station: Number.NaN }, 'station', '1 to 120'],
    [{ station: 300 }, 'network', 'Station 300 needs the number of its network'],
    [{ station: 124, extensionStation: 125 }, 'network', 'Station 124, extension station 125 needs the number'],
    [{ network: 1, station: 300, extensionStation: 300 }, 'station', 'without an extensionStation, or as'],
    [{ network: 1, station: 124, extensionStation: 120 }, 'extensionStation', '1 to 120 stand in station'],
    [{ network: 1, station: 124, extensionStation: 65_536 }, 'extensionStation', '121 to 65534'],
    [{ network: 1, station: 124, extensionStation: 1.5 }, 'extensionStation', '121 to 65534'],
    [{ network: 1, station: 5, extensionStation: 5 }, 'extensionStation', 'needs station 124, not 5'],
    [{ extensionStation: 300 }, 'extensionStation', 'needs station 124, not 255'],
    [{ network: 1, station: 126, extensionStation: 126 }, 'extensionStation', 'needs station 124, not 126'],
    [{ moduleIo: 0x200 }, 'moduleIo', '03FF'],
    [{ moduleIo: 0x3e4 }, 'moduleIo', '03E3'],
    [{ moduleIo: 0x10000 }, 'moduleIo', '65536'],
    [{ multidrop: 1 }, 'multidrop', 'serial module'],
    [{ moduleIo: 0, multidrop: 32 }, 'multidrop', '0 to 31'],
    [{ moduleIo: 0, multidrop: -1 }, 'multidrop', '0 to 31'],
  ]
  test.each(REFUSED)('%j is refused because of its %s', (part, field, message) => {
    const error = refusal(() => completeRoute(part))
    expect(error.code).toBe('OUT_OF_RANGE')
    expect(error.field).toBe(`route.${field}`)
    expect(error.message).toContain(message)
  })

  test('reaches stations 121 to 65534 by the extension field', () => {
    for (const station of [121, 123, 127, 254, 256, 65_534]) {
      const route = { ...ownStation, network: 1, station: 124, extensionStation: station }
      expect(completeRoute({ network: 1, station })).toEqual(route)
      expect(completeRoute(route)).toEqual(route)
    }
  })

  test('says numbers that mean something else in the extension field only', () => {
    for (const extensionStation of [124, 125, 126, 255, 0]) {
      const route = { network: 1, station: 124, extensionStation }
      expect(completeRoute(route)).toEqual({ ...ownStation, ...route })
    }
    expect(completeRoute({ network: 1, station: 125, extensionStation: 0 }).station).toBe(125)
  })

  test('is the connected station by either field', () => {
    const own = { ...ownStation, station: 124, extensionStation: 65_535 }
    expect(completeRoute({ station: 124, extensionStation: 65_535 })).toEqual(own)
    expect([ownStation, own, { ...ownStation, extensionStation: 0 }].map(isConnectedStation)).toEqual([
      true,
      true,
      true,
    ])
    const others = [
      { network: 1, station: 255 },
      { network: 1, station: 124, extensionStation: 65_535 },
      { network: 0, station: 124, extensionStation: 0 },
      { network: 0, station: 255, extensionStation: 300 },
    ]
    expect(others.map(isConnectedStation)).toEqual([false, false, false, false])
  })

  test('a misspelt field is refused, not ignored', () => {
    const error = refusal(() => completeRoute({ stations: 1 } as Partial<Route>))
    expect(error.code).toBe('BAD_OPTION')
    expect(error.message).toContain('stations')
  })
})

describe('a frame', () => {
  const takers = (part: Partial<Route>) =>
    ethernetFrameNames.filter((frame) => {
      try {
        checkRouteOf(frame, completeRoute(part))
        return true
      } catch (error) {
        expect(error).toBeInstanceOf(RequestError)
        return false
      }
    })

  test('takes the routes it can say without two meanings', () => {
    expect(takers({})).toEqual(ethernetFrameNames)
    expect(takers({ network: 1, station: 120 })).toEqual(ethernetFrameNames)
    expect(takers({ network: 1, station: 125 })).toEqual(['3E', '4E', '1E'])
    expect(takers({ network: 1, station: 121 })).toEqual(['ext'])
    expect(takers({ network: 1, station: 125, extensionStation: 0 })).toEqual(['ext'])
    expect(takers({ network: 1, station: 124, extensionStation: 126 })).toEqual(['ext'])
    expect(takers({ station: 124, extensionStation: 65_535 })).toEqual(['ext'])
  })

  test('refuses the others with what to do', () => {
    const refused = (frame: EthernetFrameName, part: Partial<Route>) =>
      refusal(() => checkRouteOf(frame, completeRoute(part)))
    expect(refused('3E', { network: 1, station: 121 })).toMatchObject({
      code: 'OUT_OF_RANGE',
      field: 'route.station',
      message: expect.stringContaining(
        "A 3E frame cannot say station 121: stations above 120 need the station extension frame (frame 'ext'",
      ),
    })
    expect(refused('ext', { network: 1, station: 126 })).toMatchObject({
      code: 'OUT_OF_RANGE',
      field: 'route.station',
      message: expect.stringContaining('Add extensionStation: 0 for the present control or master station.'),
    })
  })
})

describe('text', () => {
  test('describes any station, also one a PLC reports that no request could name', () => {
    expect(describeRoute(ownStation)).toBe('network 0, station 255, module I/O 03FF, multidrop 0')
    expect(describeRoute({ network: 255, station: 254, moduleIo: 0xffff, multidrop: 200 })).toBe(
      'network 255, station 254, module I/O FFFF, multidrop 200',
    )
    const station = (part: Partial<Route>) => describeRoute({ ...ownStation, ...part }).split(', module')[0]
    expect(station({ network: 1, station: 124, extensionStation: 300 })).toBe('network 1, station 300')
    expect(station({ station: 255, extensionStation: 0 })).toBe('network 0, station 255')
    expect(station({ network: 1, station: 124 })).toBe('network 1, station 124')
    for (const extensionStation of [0, 7, 125, 255, 65_535]) {
      expect(station({ network: 1, station: 124, extensionStation })).toBe(
        `network 1, station 124, extension station ${extensionStation}`,
      )
    }
  })
})
