import { describe, expect, test } from '@jest/globals'
import { ProtocolError } from '../../src/errors'
import type { JwKindName } from '../../src/jw/operand/kind'
import { timerAttributes, timerValue } from '../../src/jw/operand/timer'

function messageOf(word: number, attribute: number, kind: JwKindName): string {
  try {
    timerValue(word, attribute, kind)
  } catch (error) {
    if (error instanceof ProtocolError) return `${error.code} ${error.message}`
    throw error
  }
  return 'no error'
}

describe('the current value of a timer or counter', () => {
  test('is that of the printed example: 34 92 and 78 D6 are 1234 and 5678, with bit 15 beside them', () => {
    expect(timerValue(0x9234, 0x08, 'TMR')).toMatchObject({ value: 1234, flag: true, direction: 'down', coding: 'BCD' })
    expect(timerValue(0xd678, 0x0a, 'TMR')).toMatchObject({ value: 5678, flag: true, direction: 'up', coding: 'BCD' })
  })

  test.each([
    [0x7999, 0x0c, 'CNT', 7999],
    [0x0000, 0x0e, 'CNT', 0],
    [0x7fff, 0x0d, 'CNT', 32767],
    [0xffff, 0x0f, 'CNT', 32767],
    [0x8010, 0x09, 'TMR', 16],
    [0x0010, 0x0b, 'TMR', 16],
    [0x0010, 0x0a, 'TMR', 10],
  ] as const)('%p with the attribute %p of a %s is %p', (word, attribute, kind, value) => {
    expect(timerValue(word, attribute, kind).value).toBe(value)
    expect(timerValue(word, attribute, kind).flag).toBe(word >= 0x8000)
  })

  test('is none where the number is something else, or nobody says how it is coded', () => {
    expect(messageOf(0x1234, 0x0c, 'TMR')).toBe(
      'BAD_FIELD In the PLC this number is DCNT (BCD), not TMR. Its word is 1234H; the type WORD gives it as it is.',
    )
    expect(messageOf(0, 0x08, 'CNT')).toContain('DTMR (BCD), not CNT')
    expect(messageOf(0, 0x00, 'TMR')).toContain('this number is not used, not TMR')
    expect(messageOf(1, 0x01, 'MD')).toContain('this number is MD, and no source says how its value is coded')
    expect(messageOf(1, 0x04, 'TMR')).toContain('ZW timer, and no source says')
    expect(messageOf(1, 0x02, 'CNT')).toContain('ZW counter, and no source says')
    expect(messageOf(1, 0x03, 'CNT')).toContain('the attribute 03H, which is not printed')
    expect(messageOf(0x12a4, 0x08, 'TMR')).toContain('A digit of the current value is above 9')
  })

  test('has an attribute 0000JXYZ: X 1 is a counter, Y 1 up, Z 1 binary where J is 1', () => {
    for (let attribute = 0x08; attribute <= 0x0f; attribute++) {
      expect(timerAttributes[attribute]).toMatchObject({
        use: attribute & 4 ? 'CNT' : 'TMR',
        direction: attribute & 2 ? 'up' : 'down',
        coding: attribute & 1 ? 'binary' : 'BCD',
      })
    }
    expect(Object.keys(timerAttributes)).toHaveLength(12)
  })
})
