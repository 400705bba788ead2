// The list of the ports of this computer: as the package tells, or by their names where the system tells it nothing.
import { readdirSync } from 'node:fs'
import { describe, expect, jest, test } from '@jest/globals'
import { serialPorts } from '../../src/transport/serial-ports'

const list = jest.fn<() => Promise<object[]>>()

jest.mock('serialport', () => ({ SerialPort: { list: () => list() } }))

const isLinux = process.platform === 'linux'

describe('the serial ports of this computer', () => {
  test('are sorted as people count, with the maker and the name that lasts', async () => {
    list.mockResolvedValue([
      { path: '/dev/ttyUSB10' },
      { path: '/dev/ttyUSB2', manufacturer: 'FTDI', pnpId: 'usb-FTDI_FT232R-if00-port0', serialNumber: 'A1' },
    ])
    const lasting = isLinux ? { lastingPath: '/dev/serial/by-id/usb-FTDI_FT232R-if00-port0' } : {}
    expect(await serialPorts()).toEqual([
      { path: '/dev/ttyUSB2', manufacturer: 'FTDI', ...lasting },
      { path: '/dev/ttyUSB10' },
    ])
  })

  test('are found by their names where the system does not tell', async () => {
    list.mockRejectedValue(new Error('spawn udevadm ENOENT'))
    const ports = await serialPorts()
    const there = readdirSync('/dev').filter((name) => /^tty(S|USB|ACM)\d+$/.test(name))
    expect(ports.map(({ path }) => path)).toEqual(expect.arrayContaining(there.map((name) => `/dev/${name}`)))
    expect(ports.map(({ path }) => path)).not.toContain('/dev/tty')
  })
})
