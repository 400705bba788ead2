/** Items of every type and form through sockets, compared with what stands in the words of the simulated PLC. */
import { describe, expect, test } from '@jest/globals'
import type { DeviceName, Item, ReadValue } from '../../src/index'
import { brief, kind, kinds, type Line, withLine } from './line'

/** An item, its value, and the words (or bits) that hold it, written down from the manuals' data formats. */
interface Case {
  readonly item: Item
  readonly value: ReadValue
  readonly words?: readonly [device: DeviceName, first: number, words: readonly number[]]
  readonly bits?: readonly [device: DeviceName, first: number, bits: string]
  /** Only where the family has the device. */
  readonly only?: readonly string[]
  readonly readModifyWrite?: true
}

const cases: readonly Case[] = [
  { item: 'D0', value: -2, words: ['D', 0, [0xfffe]] },
  { item: 'D1:UINT', value: 65535, words: ['D', 1, [0xffff]] },
  { item: 'D2:WORD', value: 0xabcd, words: ['D', 2, [0xabcd]] },
  { item: 'D10:DINT', value: -2, words: ['D', 10, [0xfffe, 0xffff]] },
  { item: 'D12:UDINT', value: 0x12345678, words: ['D', 12, [0x5678, 0x1234]] },
  { item: 'D14:DWORD', value: 0xdeadbeef, words: ['D', 14, [0xbeef, 0xdead]] },
  { item: 'D16:LINT', value: -2n, words: ['D', 16, [0xfffe, 0xffff, 0xffff, 0xffff]] },
  { item: 'D20:ULINT', value: 0x0123456789abcdefn, words: ['D', 20, [0xcdef, 0x89ab, 0x4567, 0x0123]] },
  // IEEE 754: 1.5 = 3FC00000, -2.25 = C002000000000000.
  { item: 'D24:REAL', value: 1.5, words: ['D', 24, [0x0000, 0x3fc0]] },
  { item: 'D26:LREAL', value: -2.25, words: ['D', 26, [0, 0, 0, 0xc002]] },
  { item: 'D30:BCD16', value: 1234, words: ['D', 30, [0x1234]] },
  { item: 'D31:BCD32', value: 12345678, words: ['D', 31, [0x5678, 0x1234]] },
  { item: 'D33:TIME', value: 90_061, words: ['D', 33, [0x5fcd, 0x0001]] },
  // The first character is in the low byte.
  { item: 'D40:STRING(5)', value: 'ABC', words: ['D', 40, [0x4241, 0x0043, 0]] },
  {
    item: { address: 'D50:STRING(8)', encoding: 'utf8' },
    value: 'é€',
    words: ['D', 50, [0xa9c3, 0x82e2, 0x00ac, 0]],
  },
  {
    item: { address: 'D60:STRING(8)', encoding: 'shift-jis' },
    value: 'テスト',
    words: ['D', 60, [0x6583, 0x5883, 0x6783, 0]],
  },
  { item: { address: 'D70:STRING(8)', encoding: 'utf16' }, value: 'Ab', words: ['D', 70, [0x0041, 0x0062, 0, 0]] },
  { item: 'D80:WSTRING(4)', value: '山田', words: ['D', 80, [0x5c71, 0x7530, 0, 0]] },
  { item: { address: 'D90:STRING(6)', byteOrder: 'high-first' }, value: 'abc', words: ['D', 90, [0x6162, 0x6300, 0]] },
  {
    item: { address: 'D94:DINT', wordOrder: 'high-first' },
    value: 0x11223344,
    words: ['D', 94, [0x1122, 0x3344]],
  },
  { item: { address: 'D96', byteOrder: 'high-first' }, value: 0x1122, words: ['D', 96, [0x2211]] },
  {
    item: { address: 'D97', type: 'ULINT', wordOrder: 'high-first' },
    value: 0x0123456789abcdefn,
    words: ['D', 97, [0x0123, 0x4567, 0x89ab, 0xcdef]],
  },
  { item: 'D110:REAL[3]', value: [1, -1, 0.5], words: ['D', 110, [0, 0x3f80, 0, 0xbf80, 0, 0x3f00]] },
  { item: 'D120[4]', value: [1, 2, 3, -4], words: ['D', 120, [1, 2, 3, 0xfffc]] },
  { item: 'D124..D127', value: [5, 6, 7, 8], words: ['D', 124, [5, 6, 7, 8]] },
  { item: 'D130..D133:DINT', value: [1, -1], words: ['D', 130, [1, 0, 0xffff, 0xffff]] },
  { item: 'D140:STRING(3)[2]', value: ['ab', 'cde'], words: ['D', 140, [0x6261, 0, 0x6463, 0x0065]] },
  { item: { address: 'D146', type: 'UINT', count: 1 }, value: [7], words: ['D', 146, [7]] },
  { item: 'D200.3', value: true, words: ['D', 200, [0x0008]], readModifyWrite: true },
  {
    item: 'D201.4[20]',
    value: [...'10100000000110000001'].map((bit) => bit === '1'),
    words: ['D', 201, [0x8050, 0x0081]],
    readModifyWrite: true,
  },
  {
    item: 'D203.E..D204.1',
    value: [true, false, true, true],
    words: ['D', 203, [0x4000, 0x0003]],
    readModifyWrite: true,
  },
  { item: 'M0', value: true, bits: ['M', 0, '1'] },
  { item: 'M5[3]', value: [true, false, true], bits: ['M', 5, '101'] },
  { item: 'M16..M20', value: [false, true, true, false, true], bits: ['M', 16, '01101'] },
  { item: 'K4M32', value: -32767, bits: ['M', 32, '1000000000000001'] },
  { item: 'K1M51', value: 5, bits: ['M', 51, '1010'] },
  { item: 'K8M64:DWORD', value: 0x80000003, bits: ['M', 64, '11000000000000000000000000000001'] },
  { item: 'K2M100[2]', value: [1, 0x80], bits: ['M', 100, '1000000000000001'] },
  { item: 'K5M128', value: 0x80001, bits: ['M', 128, '10000000000000000001'] },
  { item: 'L7', value: true, bits: ['L', 7, '1'] },
  { item: 'F3', value: true, bits: ['F', 3, '1'] },
  { item: 'B1F', value: true, bits: ['B', 0x1f, '1'] },
  { item: 'SB1F', value: true, bits: ['SB', 0x1f, '1'] },
  { item: 'W1F', value: 31, words: ['W', 0x1f, [31]] },
  { item: 'SW1F', value: 32, words: ['SW', 0x1f, [32]] },
  { item: 'SD1000', value: 10, words: ['SD', 1000, [10]] },
  { item: 'SM1000', value: true, bits: ['SM', 1000, '1'] },
  { item: 'R100', value: 9, words: ['R', 100, [9]] },
  { item: 'Z3', value: 3, words: ['Z', 3, [3]] },
  { item: 'TN5', value: 500, words: ['TN', 5, [500]] },
  { item: 'TS5', value: true, bits: ['TS', 5, '1'] },
  { item: 'TC6', value: true, bits: ['TC', 6, '1'] },
  { item: 'STN5', value: 501, words: ['STN', 5, [501]] },
  { item: 'STS5', value: true, bits: ['STS', 5, '1'] },
  { item: 'CN5', value: 502, words: ['CN', 5, [502]] },
  { item: 'CC5', value: true, bits: ['CC', 5, '1'] },
  { item: 'X7', value: true, bits: ['X', 7, '1'] },
  { item: 'Y5[3]', value: [true, false, true], bits: ['Y', 5, '101'] },
  // Octal on iQ-F, hexadecimal elsewhere.
  { item: 'Y10', value: true, bits: ['Y', 8, '1'], only: ['iq-f'] },
  { item: 'X17', value: true, bits: ['X', 15, '1'], only: ['iq-f'] },
  { item: 'K2Y20', value: 0x81, bits: ['Y', 16, '10000001'], only: ['iq-f'] },
  { item: 'Y10', value: true, bits: ['Y', 16, '1'], only: ['iq-r', 'q', 'l'] },
  { item: 'X1F', value: true, bits: ['X', 31, '1'], only: ['iq-r', 'q', 'l'] },
  { item: 'XFF', value: true, bits: ['X', 255, '1'], only: ['iq-r', 'q', 'l'] },
  { item: 'V5', value: true, bits: ['V', 5, '1'], only: ['iq-r', 'q', 'l', 'generic'] },
  { item: 'ZR32768', value: 77, words: ['ZR', 32768, [77]], only: ['iq-r', 'q', 'l', 'generic'] },
  { item: 'DY30', value: true, bits: ['Y', 0x30, '1'], only: ['iq-r', 'q', 'l', 'generic'] },
  { item: 'RD12', value: 5, words: ['RD', 12, [5]], only: ['iq-r', 'generic'] },
  { item: 'LCS3', value: true, bits: ['LCS', 3, '1'], only: ['iq-r', 'iq-f', 'generic'] },
  { item: 'S8', value: true, bits: ['S', 8, '1'], only: ['iq-f', 'q', 'l'] },
]

/** Devices of 32 bits: the program's side of the simulator reads them as such. */
const doubleWordCases: readonly (readonly [item: string, value: number, only: readonly string[]])[] = [
  ['LCN3', -5, ['iq-r', 'iq-f', 'generic']],
  ['LZ1', 0x12345678, ['iq-r', 'iq-f', 'generic']],
  ['LTN4', 100_000, ['iq-r', 'generic']],
  ['LSTN5:UDINT', 0xfffffffe, ['iq-r', 'generic']],
]

function casesOf(profile: string): Case[] {
  return cases.filter(({ only }) => only === undefined || only.includes(profile))
}

function rawOf({ plc: { memory } }: Line, { words, bits }: Case): unknown {
  if (words !== undefined) return words[2].map((_, i) => memory.word(words[0], words[1] + i))
  if (bits !== undefined) return [...bits[2]].map((_, i) => (memory.bit(bits[0], bits[1] + i) ? '1' : '0')).join('')
  return undefined
}

function setRaw({ plc: { memory } }: Line, { words, bits }: Case): void {
  words?.[2].forEach((word, i) => {
    memory.setWord(words[0], words[1] + i, word)
  })
  for (const [i, bit] of [...(bits?.[2] ?? '')].entries()) {
    if (bits !== undefined) memory.setBit(bits[0], bits[1] + i, bit === '1')
  }
}

const expectedRaw = ({ words, bits }: Case) => words?.[2] ?? bits?.[2]

describe.each(kinds)('%s', (text) => {
  const list = casesOf(kind(text).profile)

  test('each value alone is written into its words and bits, and read back', () =>
    withLine(text, {}, async (line) => {
      for (const one of list) {
        await line.client.write(one.item, one.value, { readModifyWrite: one.readModifyWrite ?? false })
        expect([one.item, rawOf(line, one)]).toEqual([one.item, expectedRaw(one)])
        expect([one.item, await line.client.read(one.item)]).toEqual([one.item, one.value])
      }
    }))

  test('all values by one call are written into their words and bits, and nothing beside them', () =>
    withLine(text, {}, async (line) => {
      const entries = list.map(({ item, value }) => ({ item, value }))
      const results = await line.client.writeEach(entries, { readModifyWrite: true })
      expect(results.filter(({ ok }) => !ok)).toEqual([])
      for (const one of list) expect([one.item, rawOf(line, one)]).toEqual([one.item, expectedRaw(one)])
      expect(setOutside(line, list)).toEqual([])
    }))

  test('all values are read by one call, as list and as object, again and again', () =>
    withLine(text, {}, async (line) => {
      for (const one of list) setRaw(line, one)
      const items = list.map(({ item }) => item)
      const values = list.map(({ value }) => value)
      expect((await line.client.read(items)).map(brief)).toEqual(values)
      expect(await line.client.readValues(items)).toEqual(values)
      const named = Object.fromEntries(items.map((item, i) => [`n${i}`, item]))
      expect(Object.values(await line.client.readValues(named))).toEqual(values)
      const plan = line.client.plan(items)
      const { requests } = line.plc.statistics
      for (const again of [1, 2]) {
        expect((await plan.run()).map(brief)).toEqual(values)
        expect(line.plc.statistics.requests - requests).toBe(again * plan.describe().requests.length)
      }
    }))

  test('devices of 32 bits are written and read as one', () =>
    withLine(text, {}, async (line) => {
      for (const [item, value, only] of doubleWordCases) {
        if (!only.includes(line.profile)) continue
        await line.client.write(item, value)
        expect([item, line.plc.read(item)]).toEqual([item, value])
        expect([item, await line.client.read(item)]).toEqual([item, value])
      }
    }))
})

/** Words and bits that are set although no case has them. */
function setOutside({ plc: { memory } }: Line, list: readonly Case[]): string[] {
  const own = new Set<string>()
  for (const { words, bits } of list) {
    const [device, first, held] = words ?? bits ?? ['D', 0, []]
    for (let i = 0; i < held.length; i++) own.add(`${device}${first + i}`)
  }
  const set: string[] = []
  for (let i = 0; i < 250; i++) {
    for (const device of ['D', 'W', 'R', 'TN'] as const) {
      if (memory.word(device, i) !== 0 && !own.has(`${device}${i}`)) set.push(`${device}${i}`)
    }
    for (const device of ['M', 'X', 'Y', 'B'] as const) {
      if (memory.bit(device, i) && !own.has(`${device}${i}`)) set.push(`${device}${i}`)
    }
  }
  return set
}
