// The options of a client: what is filled in, and what is refused before anything is connected.
import { describe, expect, test } from '@jest/globals'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { MelsecClientOptions } from '../../src/client/melsec/options'
import { createMelsecLine } from '../../src/client/melsec/serial-line'
import { settle } from '../../src/client/melsec/settings'
import { RequestError } from '../../src/errors'
import { ownStation } from '../../src/melsec/frame/route'
import { profileIds } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { realClock } from '../../src/transport/clock'

const peer = { host: '192.168.3.39', port: 5007 }

describe('defaults', () => {
  test('a host and a port are enough', () => {
    const { profile, clock, random, ...settings } = settle(peer)
    expect(profile.id).toBe('generic')
    expect([clock, random]).toEqual([realClock, Math.random])
    expect(settings).toEqual({
      transport: 'tcp',
      frame: '3E',
      code: 'binary',
      serial: undefined,
      serialLine: undefined,
      route: ownStation,
      timer: 0,
      xyRadix: 16,
      wRadix: 16,
      xyUnknown: true,
      timeout: 3000,
      connectTimeout: 5000,
      inFlight: 1,
      queueLimit: 256,
      allowWrites: false,
      allowControl: false,
      probe: 'auto',
      gap: 64,
      format: {},
      labelFormat: {},
      first: 500,
      longest: 30_000,
      settleGap: 50,
    })
  })

  test.each(profileIds)('of the profile %s are its own', (id) => {
    const { profile, frame, code, timer, xyRadix } = settle({ ...peer, profile: id })
    expect([frame, code, timer * 250, xyRadix]).toEqual([
      profile.frame,
      profile.code,
      profile.monitoringTimer.default,
      profile.xyRadix,
    ])
  })

  test('what is given wins over the profile', () => {
    const given = { profile: 'iq-r', frame: '3E', code: 'ascii', xyRadix: 8, monitoringTimer: 500 } as const
    expect(settle({ ...peer, ...given })).toMatchObject({ frame: '3E', code: 'ascii', xyRadix: 8, timer: 2 })
  })

  test('the numbering of X and Y is known with a profile, with xyRadix, and with an override', () => {
    expect(settle({ ...peer, profile: 'iq-f' })).toMatchObject({ xyRadix: 8, xyUnknown: false })
    expect(settle({ ...peer, xyRadix: 16 })).toMatchObject({ xyRadix: 16, xyUnknown: false })
    expect(settle({ ...peer, profileOverrides: { xyRadix: 8 } })).toMatchObject({ xyRadix: 8, xyUnknown: false })
  })

  test('the CPUs of the connected station are reached by the built-in port of one of them', () => {
    expect(settle({ ...peer, profile: 'q-built-in', route: { moduleIo: 0x3e1 } }).route.moduleIo).toBe(0x3e1)
    expect(settle({ ...peer, profile: 'q-e71', route: { network: 1, station: 3 } }).route.station).toBe(3)
    expect(settle({ ...peer, profile: 'iq-f', route: { moduleIo: 0x3ff } }).route.moduleIo).toBe(0x3ff)
  })

  test('the Ethernet module of an iQ-F takes a monitoring timer, the CPU module does not', () => {
    expect(settle({ ...peer, profile: 'fx5-enet', monitoringTimer: 500 }).timer).toBe(2)
  })

  test('a part of the route is completed', () => {
    expect(settle({ ...peer, route: { network: 1, station: 3 } }).route).toEqual({
      ...ownStation,
      network: 1,
      station: 3,
    })
  })

  test('a station above 120 is one of the extension field', () => {
    expect(settle({ ...peer, frame: 'ext', route: { network: 1, station: 300 } }).route).toEqual({
      ...ownStation,
      network: 1,
      station: 124,
      extensionStation: 300,
    })
    expect(settle({ ...peer, frame: 'ext' }).route).toEqual(ownStation)
  })

  test('with a transport of its own the client needs no host and no port', () => {
    const openTransport = () => {
      throw new Error('not yet')
    }
    expect(settle({ host: '', port: 0, openTransport })).toMatchObject({ transport: 'tcp' })
  })
})

describe('refused', () => {
  // As programs without types call it.
  const cases: readonly [what: string, given: Record<string, unknown>, field: string, says: string][] = [
    ['a misspelt option', { allowWrite: true }, 'allowWrite', 'There is no option allowWrite'],
    ['a misspelt pause', { reconnect: { max: 5 } }, 'reconnect.max', 'There is no option reconnect.max'],
    ['half a word for the digits of X and Y', { asciiXy: 'oct' }, 'asciiXy', 'must be'],
    ['a radix for the digits of ZR', { asciiZr: 16 }, 'asciiZr', 'must be'],
    ['no host', { host: undefined }, 'host', 'host is missing'],
    ['an empty host', { host: ' ' }, 'host', 'host is missing'],
    ['no port', { port: undefined }, 'port', 'port is undefined; it must be a whole number from 1 to 65535'],
    ['port 0', { port: 0 }, 'port', 'port is 0'],
    ['a port that is text', { port: '5007' }, 'port', 'port is 5007'],
    ['another transport', { transport: 'rs485' }, 'transport', 'must be tcp or udp or serial'],
    ['UDP to a device server', { profile: 'fx5-serial', transport: 'udp' }, 'transport', 'reached by TCP'],
    ['a local port of a serial line', { profile: 'fx5-serial', localPort: 5000 }, 'localPort', 'leave it out'],
    ['a serial line without a port', { transport: 'serial' }, 'serial.path', 'give serial.path'],
    ['another profile', { profile: 'fx9' }, 'profile', `Choose one of: ${profileIds.join(', ')}`],
    ['another frame', { frame: '2E' }, 'frame', 'has no 2E frame'],
    ['a frame the family lacks', { profile: 'iq-f', frame: '4E' }, 'frame', 'has no 4E frame: use 3E'],
    ...(['iq-f', 'fx5-enet', 'q-built-in'] as const).map(
      (profile): [string, Record<string, unknown>, string, string] => [
        `another station by a port that reaches none: ${profile}`,
        { profile, route: { network: 1, station: 3 } },
        'route',
        'reaches the connected station only: leave route out',
      ],
    ),
    ['CPU No. 2 of an iQ-F', { profile: 'iq-f', route: { moduleIo: 0x3e1 } }, 'route', 'the connected station only'],
    ['a route with a field less', { profile: 'q-built-in', route: { multidrop: 3, moduleIo: 1 } }, 'route', 'only'],
    ['another code', { code: 'hex' }, 'code', 'must be binary or ascii'],
    [
      'a serial frame with the profile of the Ethernet port',
      { profile: 'iq-f', frame: '3C' },
      'frame',
      'On a serial line its profile is another one: fx5-serial,',
    ],
    ['a station extension frame the family lacks', { profile: 'q', frame: 'ext' }, 'frame', 'has no ext frame: use 3E'],
    [
      'a station extension frame in ASCII code',
      { profile: 'iq-r', frame: 'ext', code: 'ascii' },
      'code',
      'exists in binary code only: set code to binary',
    ],
    [
      'station 300 in a 4E frame',
      { profile: 'iq-r', route: { network: 1, station: 300 } },
      'route.station',
      "cannot say station 300: stations above 120 need the station extension frame (frame 'ext', by an RJ71GN11-T2)",
    ],
    [
      'an extension station in a 3E frame',
      { frame: '3E', route: { network: 1, station: 5, extensionStation: 0 } },
      'route.extensionStation',
      'A 3E frame cannot say',
    ],
    [
      'a station number with two meanings',
      { frame: 'ext', route: { network: 1, station: 125 } },
      'route.station',
      '{ station: 124, extensionStation: 125 }',
    ],
    [
      'two in flight with the station extension frame',
      { transport: 'udp', profile: 'iq-r', frame: 'ext', inFlight: 2 },
      'inFlight',
      'more needs the 4E frame over UDP',
    ],
    ['another radix', { xyRadix: 10 }, 'xyRadix', 'must be 8 or 16'],
    ['another radix of W', { wRadix: 8 }, 'wRadix', 'must be 10 or 16'],
    ['W in decimal in ASCII code', { wRadix: 10, code: 'ascii' }, 'wRadix', 'binary code only'],
    ['the same by an override', { profileOverrides: { wRadix: 10 }, code: 'ascii' }, 'wRadix', 'binary code only'],
    ['a station that does not exist', { route: { network: 1, station: 0 } }, 'route.station', 'cannot be addressed'],
    ['a misspelt field of the route', { route: { net: 1 } }, 'route.net', 'A route has no "net"'],
    ['half a timer step', { profile: 'iq-r', monitoringTimer: 300 }, 'monitoringTimer', 'steps of 250 ms'],
    ['a timer that is too long', { profile: 'iq-r', monitoringTimer: 250 * 65_536 }, 'monitoringTimer', 'to 16383750'],
    [
      'a timer where only 0 is taken',
      { profile: 'iq-f', monitoringTimer: 250 },
      'monitoringTimer',
      'takes monitoringTimer 0 only',
    ],
    ['no time at all', { timeout: 0 }, 'timeout', 'from 1 to'],
    ['time without end', { timeout: Number.POSITIVE_INFINITY }, 'timeout', 'timeout is Infinity'],
    ['a time that is text', { connectTimeout: '5000' }, 'connectTimeout', 'connectTimeout is 5000'],
    ['no request in flight', { inFlight: 0 }, 'inFlight', 'from 1 to'],
    [
      'two in flight with 3E',
      { transport: 'udp', profile: 'iq-r', frame: '3E', inFlight: 2 },
      'inFlight',
      'more needs the 4E frame over UDP',
    ],
    ['two in flight over TCP', { profile: 'iq-r', inFlight: 2 }, 'inFlight', 'more needs the 4E frame over UDP'],
    ['more than the receive buffer holds', { transport: 'udp', profile: 'iq-r', inFlight: 34 }, 'inFlight', 'takes 33'],
    ['no queue', { queueLimit: 0 }, 'queueLimit', 'from 1 to'],
    ['permission that is text', { allowWrites: 'true' }, 'allowWrites', 'must be true or false'],
    ['control that is a number', { allowControl: 1 }, 'allowControl', 'must be true or false'],
    ['a gap longer than a request', { gap: 961 }, 'gap', 'from 0 to 960'],
    ['another word order', { format: { wordOrder: 'big' } }, 'wordOrder', ''],
    ['no first pause', { reconnect: { first: 0 } }, 'reconnect.first', 'from 1 to'],
    [
      'a first pause over the longest',
      { reconnect: { first: 900, longest: 800 } },
      'reconnect.first',
      'cannot be longer',
    ],
    ['a longest pause that is no number', { reconnect: { longest: Number.NaN } }, 'reconnect.longest', 'is NaN'],
    ['a negative settle gap', { settleGap: -1 }, 'settleGap', 'from 0 to'],
  ]
  test.each(cases)('%s', (_what, given, field, says) => {
    const refused = () => settle({ ...peer, ...given } as MelsecClientOptions)
    expect(refused).toThrow(RequestError)
    expect(refused).toThrow(expect.objectContaining({ field, outcome: 'notSent' }))
    expect(refused).toThrow(says)
  })

  test.each(profileIds)('every frame of %s makes a client', async (profile) => {
    for (const frame of profiles[profile].frames) {
      const client = createMelsecClient({ ...peer, profile, frame })
      await client.close()
    }
  })

  test('more in flight is taken with 4E over UDP, up to what the profile bears', () => {
    expect(settle({ ...peer, transport: 'udp', profile: 'iq-r', inFlight: 33 }).inFlight).toBe(33)
    const profileOverrides = { inFlight: { udpBuffer: 4 } }
    expect(settle({ ...peer, transport: 'udp', profile: 'iq-r', profileOverrides, inFlight: 5 }).inFlight).toBe(5)
  })

  test('what belongs to the line is refused of a client on it, also its port', () => {
    const line = createMelsecLine({ host: '127.0.0.1', port: 4001 })
    const given = { line, profile: 'fx5-serial', port: 4002 } as unknown as MelsecClientOptions
    expect(() => settle(given)).toThrow('port belongs to the line: give it to createMelsecLine().')
  })
})
