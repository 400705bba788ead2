import { describe, expect, test } from '@jest/globals'
import { createJwSimulator } from '../../src/simulator/simulator'
import { tcpTransport } from '../../src/transport/tcp'
import { udpTransport } from '../../src/transport/udp'
import { exchanged, joinJw } from './jw-support'

const bytes = (text: string) => Buffer.from(text.replaceAll(' ', ''), 'hex')
const READ_09012 = bytes('47 00 24 00 0A 08 02 00')
const ANSWER = bytes('45 00 24 00 00 0A 08 02 00 05 00')

describe('a simulated JW is reached', () => {
  test.each(['tcp', 'udp', 'memory'] as const)('over %s', async (protocol) => {
    const plc = createJwSimulator({ writeMode: 1 })
    await plc.listen()
    plc.write('09012', 5)
    const { tcp, udp } = plc
    if (tcp === undefined || udp === undefined) throw new Error('it does not listen')
    const open = { tcp: tcpTransport(tcp), udp: udpTransport(udp), memory: plc.connect() }[protocol]
    expect(await exchanged(open, READ_09012, ANSWER.length)).toEqual(ANSWER)
    await plc.close()
    expect([plc.tcp, plc.udp, plc.connections]).toEqual([undefined, undefined, []])
  })

  test('byte for byte as the JW-20FL5 manual prints it', () => {
    const { plc, asker } = joinJw({ timers: { TMR0000: {}, TMR0001: { direction: 'up' } } })
    plc.write('004033', true)
    plc.write('09000:UDINT', 0x01324f00)
    plc.write('TMR0000:WORD', 0x9234)
    plc.write('TMR0001:WORD', 0xd678)
    expect(asker.hex('47 00 20 00 03 01 03')).toBe('45002000' + '0003010301')
    expect(asker.hex('47 00 24 00 00 08 04 00')).toBe('45002400' + '0000080400004F3201')
    expect(asker.hex('47 00 23 00 00 02 00')).toBe('45002300' + '000002003492' + '78D6080A')
    expect(asker.hex('47 00 E9')).toBe('4500E90002')
  })
})
