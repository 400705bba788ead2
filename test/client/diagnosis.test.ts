// Why a PLC that can be reached says nothing.
import { describe, expect, test } from '@jest/globals'
import { explainSilence, type LinkSettings } from '../../src/client/melsec/diagnosis'
import { ownStation } from '../../src/melsec/frame/route'
import { serialSettings } from '../../src/transport/serial'

const settings: LinkSettings = { transport: 'tcp', port: 5007, frame: '3E', code: 'binary', route: ownStation }
const fresh = { peer: 'tcp 192.168.3.39:5007', answeredBefore: false }
const explain = (given: Partial<LinkSettings>) => explainSilence({ ...settings, ...given }, fresh)

describe('a PLC that has never answered', () => {
  test('over TCP has most likely another data code, then another service on the port, then another frame', () => {
    const causes = explain({})
    expect(causes).toHaveLength(4)
    expect(causes[0]).toContain('set to ASCII code and this connection to binary')
    expect(causes[1]).toContain('Port 5007 is open for something else')
    expect(causes[2]).toContain('does not know the 3E frame: try 4E (an FX3 knows 1E only')
    expect(causes[3]).toContain('raise the timeout')
  })

  test('over UDP most likely answers another peer', () => {
    const [first, second, ...rest] = explain({ transport: 'udp' })
    expect(first).toContain("register this computer's address and set a fixed local port here")
    expect(second).toContain('ASCII code')
    expect(rest).toHaveLength(3)
    expect(explain({ transport: 'udp', localPort: 6000 })[0]).toContain("this computer's address and port 6000")
  })

  test.each([
    [{ code: 'ascii' }, 'set to binary code and this connection to ASCII code'],
    [{ frame: '4E' }, 'does not know the 4E frame: try 3E (iQ-F and older E71 modules have 3E only)'],
  ] as const)('%j is named as it is set', (given, says) => {
    expect(explain(given).join('\n')).toContain(says)
  })

  test.each([
    { network: 1, station: 0xff },
    { network: 0, station: 3 },
  ])('behind a route ($network, $station) is most likely not there', (route) => {
    expect(explain({ route })[0]).toContain(`Network ${route.network}, station ${route.station} does not answer`)
    expect(explain({ route })).toHaveLength(5)
  })

  test('in 4E frames most likely knows 3E only: the series is another one than chosen (an FX5U set as iQ-R)', () => {
    expect(explain({ frame: '4E', frames: ['3E', '4E'] })[0]).toContain('does not know the 4E frame: try 3E')
    expect(explain({ frame: '4E', code: 'ascii' })[0]).toContain('set to binary code')
  })

  test('of a family with one frame is not told to try another', () => {
    expect(explain({ frames: ['3E'] }).join('\n')).not.toContain('frame: try')
    expect(explain({ frames: ['3E', '4E'] }).join('\n')).toContain('frame: try 4E')
  })

  test('every cause says what to check', () => {
    for (const cause of explain({ transport: 'udp', frame: '4E', route: { network: 2, station: 1 } })) {
      expect(cause).toMatch(/compare|register|use the port|try|check|raise/)
    }
  })
})

test('a PLC that has answered before is off, slow, or was set differently', () => {
  const causes = explainSilence(settings, { ...fresh, answeredBefore: true })
  expect(causes[0]).toContain('off, restarting, or its cable')
  expect(causes.join(' ')).not.toContain('ASCII code and this connection')
  expect(causes).toHaveLength(4)
})

describe('a PLC on a serial line', () => {
  const port = serialSettings({ path: 'COM3', baudRate: 19_200, dataLength: 8, parity: 'even' })
  const link = { station: 2, format: 4, sumCheck: true, port, isRemote: false } as const
  const onLine: LinkSettings = { ...settings, transport: 'serial', frame: '3C', code: 'ascii', link }
  const silent = (more: object = {}, given: Partial<LinkSettings> = {}) =>
    explainSilence({ ...onLine, ...given }, { ...fresh, ...more }).map((cause) => cause.slice(0, 24))

  test('most likely speaks another protocol, then at another speed; wires and converter come later', () => {
    const causes = explainSilence(onLine, fresh)
    expect(causes[0]).toContain('does not speak MC protocol')
    expect(causes[1]).toContain('here it is 19200 bps')
    expect(causes[2]).toContain('here they are 8E1')
    expect(causes[3]).toContain('station number 2')
    expect(causes[4]).toContain('here it is format 4')
    expect(causes[5]).toContain('has no sum check code, and this line adds one')
    expect(causes[6]).toContain('does not know the 3C frame: try 4C')
    expect(causes[7]).toMatch(/SDA.+RDA/)
    expect(causes[8]).toContain('RTS "while sending"')
    expect(causes).toHaveLength(11)
  })

  test('of which something was heard has its wires right: most likely the speed differs', () => {
    const causes = silent({ heard: true })
    expect(causes.slice(0, 3)).toEqual([
      'The baud rate of the PLC',
      'Data length, parity bit ',
      'The converter does not l',
    ])
    expect(causes.join()).not.toContain('The wires')
  })

  test('beside others that answer most likely has another number', () => {
    const causes = silent({ othersAnswer: true })
    expect(causes.slice(0, 2)).toEqual(['No PLC on the line has s', 'The PLC is off, restarti'])
  })

  test('behind a device server most likely has one that is set differently', () => {
    expect(silent({}, { link: { ...link, isRemote: true } })[0]).toBe('The device server is not')
  })

  test('without sum check code, of a family with one frame', () => {
    const causes = explainSilence({ ...onLine, frames: ['3C'], link: { ...link, sumCheck: false } }, fresh).join()
    expect(causes).toContain('has a sum check code, and this line adds none')
    expect(causes).not.toContain('frame: try')
  })

  test('that has answered before is off, slow, or disturbed', () => {
    expect(silent({ answeredBefore: true })).toHaveLength(5)
  })

  test('that answers too late needs a longer answer time: the timeout alone changes nothing', () => {
    for (const answeredBefore of [false, true]) {
      const causes = explainSilence(onLine, { ...fresh, answeredBefore })
      expect(causes.filter((cause) => cause.includes('answer time of the line (answerTime)'))).toHaveLength(1)
    }
  })
})
