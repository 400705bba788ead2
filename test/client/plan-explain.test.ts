import { describe, expect, test } from '@jest/globals'
import { parseItem } from '../../src/client/item/item'
import { type DeviceExplanation, explainItem } from '../../src/client/plan/explain'
import type { ProfileId } from '../../src/melsec/profiles/profile'
import { protocolOf } from './plan-plc'

function explain(text: string, profile: ProfileId = 'iq-r'): DeviceExplanation {
  const protocol = protocolOf(profile)
  const { xyRadix } = protocol.profile
  return explainItem(parseItem(text, { xyRadix }), protocol, { xyRadix })
}

describe('an explanation', () => {
  test('says what will be read', () => {
    expect(explain('d100:real[10]')).toEqual({
      text: 'D100:REAL[10]',
      device: 'D',
      title: 'data register',
      unit: 'word',
      first: 'D100',
      last: 'D119',
      size: { count: 20, unit: 'word' },
      radix: 10,
      type: 'REAL',
      count: 10,
      requests: 1,
      notes: [],
    })
  })

  test.each<[string, string, string, number, string]>([
    ['D5', 'D5', 'D5', 1, 'word'],
    ['D5:LREAL', 'D5', 'D8', 4, 'word'],
    ['D5:STRING(5)', 'D5', 'D7', 3, 'word'],
    ['M0..M15', 'M0', 'M15', 16, 'bit'],
    ['X1F', 'X1F', 'X1F', 1, 'bit'],
    ['K4M0[2]', 'M0', 'M31', 32, 'bit'],
    ['K3X10', 'X10', 'X1B', 12, 'bit'],
    ['D5.E[3]', 'D5.E', 'D6.0', 3, 'bit'],
    ['LTN3[2]', 'LTN3', 'LTN4', 4, 'word'],
    ['LTS3[2]', 'LTS3', 'LTS4', 2, 'bit'],
    ['U3\\G5:DINT', 'U3\\G5', 'U3\\G6', 2, 'word'],
    ['D5Z2:DINT', 'D5Z2', 'D6Z2', 2, 'word'],
    ['@D5:DINT', '@D5', '@D5', 2, 'word'],
  ])('%s is %s to %s, %i %ss', (text, first, last, count, unit) => {
    expect(explain(text)).toMatchObject({ first, last, size: { count, unit } })
  })

  test.each<[string, ProfileId, number]>([
    ['D5', 'iq-r', 10],
    ['X5', 'iq-r', 16],
    ['X5', 'iq-f', 8],
    ['W5', 'iq-f', 16],
    ['ZR5', 'iq-r', 10],
    ['LZ1', 'iq-r', 10],
    ['D5Z2', 'iq-r', 10],
    ['B5Z2', 'iq-r', 16],
    ['J1\\X5', 'iq-r', 16],
    ['U3E0\\HG5', 'iq-r', 10],
  ])('%s on %s is numbered in radix %i', (text, profile, radix) => {
    expect(explain(text, profile).radix).toBe(radix)
  })

  test('counts the requests of a large array and warns', () => {
    const { requests, notes } = explain('D0[2000]')
    expect(requests).toBe(3)
    expect(notes).toEqual(['D0[2000] is read by 3 requests: its values may be of different moments.'])
  })

  test('passes on what the device table notes', () => {
    expect(explain('ZR5').notes[0]).toContain('decimal')
  })

  test('of what this PLC has not got is refused', () => {
    expect(() => explain('LTN0', 'q')).toThrow(/LTN0: MELSEC-Q has no device LTN/)
  })

  test.each<[string, ProfileId, string | undefined]>([
    ['D7999', 'iq-f', undefined],
    ['D8000', 'iq-f', 'D7999'],
    ['D7999:REAL', 'iq-f', 'D7999'],
    ['D7990[11]', 'iq-f', 'D7999'],
    ['D7999.F', 'iq-f', undefined],
    ['D7999.F[2]', 'iq-f', 'D7999'],
    ['X2000', 'iq-f', 'X1777'],
    ['D99999999', 'iq-r', 'D18431'],
    // What a module or a pointer has is not of the CPU's ranges.
    ['U3\\G99999', 'iq-r', undefined],
    ['D18431Z2[9]', 'iq-r', undefined],
    ['@D18431:DINT', 'iq-r', undefined],
    // The range of a generic PLC is not known.
    ['D99999', 'generic', undefined],
  ])('of %s on %s says when it is behind the last device', (text, profile, last) => {
    expect(explain(text, profile).beyond?.last).toBe(last)
    if (last !== undefined) expect(explain(text, profile).beyond?.profile).toBe(profile)
  })
})
