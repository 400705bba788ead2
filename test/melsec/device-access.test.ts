import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { accessProblem, addressProblem, checkAddress } from '../../src/melsec/device/access'
import { type DeviceAddress, type DeviceCommand, type DeviceName, devices } from '../../src/melsec/device/device'

const COMMANDS: readonly DeviceCommand[] = [
  'readBits',
  'readWords',
  'writeBits',
  'writeWords',
  'readRandom',
  'writeRandomBits',
  'writeRandomWords',
  'entryMonitorDevice',
  'readBlock',
  'writeBlock',
]

function addressOf(device: DeviceName): DeviceAddress {
  if (device === 'G') return { device, number: 0, extension: { kind: 'module', unit: 1 } }
  if (device === 'HG') return { device, number: 0, extension: { kind: 'cpu', cpu: 1 } }
  return { device, number: 0 }
}

function refusedBy(command: DeviceCommand): string {
  return devices
    .filter((info) => accessProblem(addressOf(info.name), { command }) !== undefined)
    .map((info) => info.name)
    .join(' ')
}

describe('which command may address which device (SLMP manual, sections of the commands)', () => {
  test('0401 word, 1401 word', () => {
    expect(refusedBy('readWords')).toBe('LTS LTC LSTS LSTC LZ')
    expect(refusedBy('writeWords')).toBe('LTS LTC LTN LSTS LSTC LSTN LZ')
  })

  test('0403, 0801, 1402 word', () => {
    expect(refusedBy('readRandom')).toBe('LTS LTC LSTS LSTC LCS LCC')
    expect(refusedBy('entryMonitorDevice')).toBe('TS TC LTS LTC LTN STS STC LSTS LSTC LSTN CS CC LCS LCC LCN')
    expect(refusedBy('writeRandomWords')).toBe('')
  })

  test('0406, 1406', () => {
    const refused = 'LTS LTC LTN LSTS LSTC LSTN LCS LCC LCN LZ'
    expect(refusedBy('readBlock')).toBe(refused)
    expect(refusedBy('writeBlock')).toBe(refused)
  })

  test('bit units take bit devices only, and of those 0401 and 1401 no long timer', () => {
    const bits = devices.filter((info) => info.unit === 'bit').map((info) => info.name)
    for (const command of ['readBits', 'writeBits', 'writeRandomBits'] as const) {
      const taken = devices.filter((info) => accessProblem(addressOf(info.name), { command }) === undefined)
      const except = command === 'writeRandomBits' ? [] : ['LTS', 'LTC', 'LSTS', 'LSTC']
      expect(taken.map((info) => info.name)).toEqual(bits.filter((name) => !except.includes(name)))
    }
  })

  test('contacts and coils of timers and counters go into bit blocks', () => {
    for (const command of ['readBlock', 'writeBlock'] as const) {
      const refused = devices.filter((info) =>
        accessProblem(addressOf(info.name), { command, list: 'wordBlocks' })?.message.includes('bit block'),
      )
      expect(refused.map((info) => info.name)).toEqual(['TS', 'TC', 'STS', 'STC', 'CS', 'CC'])
      expect(accessProblem(addressOf('TS'), { command, list: 'bitBlocks' })).toBeUndefined()
    }
  })

  test('a long timer is read four words at a time, a long counter written two at a time', () => {
    for (const device of ['LTN', 'LSTN'] as const) {
      expect(accessProblem({ device, number: 0 }, { command: 'readWords', points: 8 })).toBeUndefined()
      expect(accessProblem({ device, number: 0 }, { command: 'readWords', points: 6 })?.message).toContain('4 words')
    }
    expect(accessProblem({ device: 'LCN', number: 0 }, { command: 'writeWords', points: 4 })).toBeUndefined()
    expect(accessProblem({ device: 'LCN', number: 0 }, { command: 'writeWords', points: 3 })?.message).toContain(
      '2 words',
    )
    expect(accessProblem({ device: 'LCN', number: 0 }, { command: 'readWords', points: 3 })).toBeUndefined()
  })

  test('double-word devices stand among the double words of random access', () => {
    const use = { command: 'readRandom', list: 'words' } as const
    expect(accessProblem({ device: 'LTN', number: 0 }, use)?.message).toContain('32 bits')
    expect(accessProblem({ device: 'LTN', number: 0 }, { ...use, list: 'doubleWords' })).toBeUndefined()
    expect(accessProblem({ device: 'D', number: 0 }, use)).toBeUndefined()
  })

  test('index registers and @ go with random read, random write and monitor only', () => {
    const addresses: DeviceAddress[] = [
      { device: 'D', number: 0, index: { register: 'Z', number: 1 } },
      { device: 'D', number: 0, indirect: true },
      {
        device: 'W',
        number: 0,
        extension: { kind: 'link', network: 1 },
        extensionIndex: { register: 'Z', number: 1 },
      },
    ]
    for (const address of addresses) {
      const taken = COMMANDS.filter((command) => accessProblem(address, { command }) === undefined)
      expect(taken).toEqual(['readRandom', 'writeRandomWords', 'entryMonitorDevice'])
    }
    expect(accessProblem({ device: 'D', number: 0, indirect: true }, { command: 'readWords' })?.code).toBe(
      'UNSUPPORTED',
    )
  })

  test('a long timer contact tells where else to read it', () => {
    expect(accessProblem({ device: 'LTS', number: 0 }, { command: 'readWords' })?.message).toContain('Read LTN')
  })
})

describe('which addresses exist', () => {
  const link = { kind: 'link', network: 1 } as const
  const module = { kind: 'module', unit: 3 } as const
  const cpu = { kind: 'cpu', cpu: 1 } as const

  test('link direct devices are X Y B SB W SW, a module has G, a CPU G and HG', () => {
    const behind = (extension: NonNullable<DeviceAddress['extension']>) =>
      devices
        .filter((info) => addressProblem({ device: info.name, number: 0, extension }) === undefined)
        .map((info) => info.name)
        .join(' ')
    expect(behind(link)).toBe('X Y B W SB SW')
    expect(behind(module)).toBe('G')
    expect(behind(cpu)).toBe('G HG')
  })

  const refused: [DeviceAddress, string, string][] = [
    [{ device: 'G', number: 0 }, 'BAD_ADDRESS', 'U3\\G100'],
    [{ device: 'HG', number: 0 }, 'BAD_ADDRESS', 'U3E0\\HG100'],
    [{ device: 'D', number: 0, extension: module }, 'BAD_ADDRESS', 'U takes G'],
    [{ device: 'HG', number: 0, extension: module }, 'BAD_ADDRESS', 'CPUs only'],
    [{ device: 'D', number: 0, extension: link }, 'BAD_ADDRESS', 'link direct'],
    [{ device: 'W', number: 0, extension: cpu }, 'BAD_ADDRESS', 'G and HG'],
    [{ device: 'D', number: -1 }, 'OUT_OF_RANGE', 'whole number'],
    [{ device: 'D', number: 0.5 }, 'OUT_OF_RANGE', 'whole number'],
    [{ device: 'D', number: Number.NaN }, 'OUT_OF_RANGE', 'whole number'],
    [{ device: 'D', number: 2 ** 32 }, 'OUT_OF_RANGE', 'whole number'],
    [{ device: 'W', number: 0, extension: { kind: 'link', network: 0 } }, 'OUT_OF_RANGE', '1 to 239'],
    [{ device: 'W', number: 0, extension: { kind: 'link', network: 240 } }, 'OUT_OF_RANGE', '1 to 239'],
    [{ device: 'G', number: 0, extension: { kind: 'module', unit: 0x1000 } }, 'OUT_OF_RANGE', 'three digits'],
    [{ device: 'G', number: 0, extension: { kind: 'module', unit: 0x3e1 } }, 'BAD_ADDRESS', 'kind cpu'],
    [{ device: 'D', number: 0, index: { register: 'Z', number: 25 } }, 'OUT_OF_RANGE', 'Z0 to Z24'],
    [{ device: 'D', number: 0, index: { register: 'LZ', number: 13 } }, 'OUT_OF_RANGE', 'LZ0 to LZ12'],
    [{ device: 'D', number: 0, extensionIndex: { register: 'Z', number: 0 } }, 'BAD_ADDRESS', 'needs an extension'],
    [
      { device: 'G', number: 0, extension: module, extensionIndex: { register: 'Z', number: 25 } },
      'OUT_OF_RANGE',
      'Z0 to Z24',
    ],
    [
      { device: 'G', number: 0, extension: cpu, extensionIndex: { register: 'Z', number: 1 } },
      'BAD_ADDRESS',
      'cannot be indexed',
    ],
    [{ device: 'M', number: 0, indirect: true }, 'BAD_ADDRESS', 'word devices only'],
    [{ device: 'LTN', number: 0, indirect: true }, 'BAD_ADDRESS', 'word devices only'],
    [{ device: 'Q' as DeviceName, number: 0 }, 'BAD_ADDRESS', 'no device'],
  ]
  test.each(refused)('%j is refused', (address, code, message) => {
    expect(addressProblem(address)).toEqual({ code, message: expect.stringContaining(message) })
    expect(() => checkAddress(address)).toThrow(RequestError)
  })

  test('an indexed network may start at 0', () => {
    const address: DeviceAddress = {
      device: 'W',
      number: 0,
      extension: { kind: 'link', network: 0 },
      extensionIndex: { register: 'Z', number: 0 },
    }
    expect(addressProblem(address)).toBeUndefined()
  })
})
