import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { checkLimits, limitsOf } from '../../src/melsec/device/limit'
import {
  abbreviated,
  expandLabel,
  inRequests,
  labelDataType,
  labelDataTypes,
  parseLabel,
} from '../../src/melsec/label/label'
import { labelCommandNames } from '../../src/melsec/profiles/no-labels'
import { lackOf } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { parseType } from '../../src/value/value'

describe('names', () => {
  test.each([
    ['Speed', { name: 'Speed', stem: 'Speed' }],
    [' Line1.Speed ', { name: 'Line1.Speed', stem: 'Line1.Speed' }],
    ['BBB[20]', { name: 'BBB[20]', stem: 'BBB', index: [20] }],
    ['BBB[20, 10, 30]', { name: 'BBB[20,10,30]', stem: 'BBB', index: [20, 10, 30] }],
    ['XXX.YYY[ 2 , 1 ]', { name: 'XXX.YYY[2,1]', stem: 'XXX.YYY', index: [2, 1] }],
    ['Line[03].Speed', { name: 'Line[3].Speed', stem: 'Line[3].Speed' }],
    ['速度.実績', { name: '速度.実績', stem: '速度.実績' }],
  ])('%s', (text, address) => {
    expect(parseLabel(text)).toEqual(address)
    expect(parseLabel(parseLabel(text).name)).toEqual(address)
  })

  test.each([
    ['', 'it is empty'],
    ['AAA.3', 'the bit of a label cannot be named'],
    ['BBB[XXX]', '[XXX] is not one to three numbers'],
    ['BBB[1,2,3,4]', '[1,2,3,4] is not one to three numbers'],
    ['BBB[-1]', '[-1] is not one to three numbers'],
    ['%1.Speed', "there is something wrong at '%1'"],
    ['A..B', "there is something wrong at ''"],
    ['A B', "there is something wrong at 'A B'"],
    ['A[1]B', '[1] is not one to three numbers'],
  ])('%s is refused', (text, reason) => {
    expect(() => parseLabel(text)).toThrow(RequestError)
    expect(() => parseLabel(text)).toThrow(reason)
  })
})

describe('abbreviations', () => {
  test('the labels of the example of the manual', () => {
    const names = ['LabelA.memberA1', 'LabelA.memberA2', 'LabelA.memberA3.memberB1', 'LabelA.memberA3.memberB2']
    // The manual abbreviates LabelA and memberA3 and writes %1.%2.memberB1. Here only beginnings of names are taken.
    expect(abbreviated(names)).toEqual({
      abbreviations: [{ name: 'LabelA.memberA3' }, { name: 'LabelA' }],
      names: ['%2.memberA1', '%2.memberA2', '%1.memberB1', '%1.memberB2'],
    })
    expect(expandLabel('%1.%2.memberB1', ['LabelA', 'memberA3'])).toBe('LabelA.memberA3.memberB1')
    expect(expandLabel('%3.x', ['LabelA'])).toBeUndefined()
    expect(expandLabel('%01.x', ['LabelA'])).toBeUndefined()
  })

  test('none where it would not be shorter, none for elements of arrays', () => {
    const plain = ['A.x', 'A.y', 'Recipe.Speed', 'Level']
    expect(abbreviated(plain)).toEqual({ abbreviations: [], names: plain })
    const elements = ['LongArrayName[0].Speed', 'LongArrayName[0].Level', 'LongArrayName[0].Weight']
    expect(abbreviated(elements)).toEqual({ abbreviations: [], names: elements })
    const members = elements.map((name) => `LongStructure.${name}`)
    expect(abbreviated(members).names).toEqual(elements.map((name) => `%1.${name}`))
  })

  test('give the same names, never longer, whatever the names are', () => {
    const member = fc.constantFrom('A', 'Line1', 'LongMemberName', 'Values[3]', 'M', 'LongArray[1,2]')
    const names = fc.array(fc.array(member, { minLength: 1, maxLength: 5 }).map((members) => members.join('.')))
    fc.assert(
      fc.property(names, (given) => {
        const found = abbreviated(given)
        const prefixes = found.abbreviations.map(({ name }) => name)
        expect(found.names.map((name) => expandLabel(name, prefixes))).toEqual(given)
        expect(prefixes.filter((prefix) => prefix.includes('['))).toEqual([])
        const units = (all: readonly string[]) => all.reduce((sum, name) => sum + 1 + name.length, 0)
        expect(units([...prefixes, ...found.names])).toBeLessThanOrEqual(units(given))
      }),
    )
  })
})

test('entries stay in order and fill each request before the next', () => {
  const fits = (some: readonly number[]) => some.reduce((sum, entry) => sum + entry, 0) <= 10
  expect(inRequests([4, 6, 1, 20, 3, 7], fits)).toEqual([[4, 6], [1], [20], [3, 7]])
  expect(inRequests([], fits)).toEqual([])
})

describe('data types', () => {
  test('are those of the label editor', () => {
    const names = labelDataTypes.map(({ title, bytes }) => parseType(bytes === undefined ? `${title}(1)` : title).name)
    expect(names).toEqual(['BOOL', 'WORD', 'DWORD', 'INT', 'DINT', 'REAL', 'LREAL', 'TIME', 'STRING', 'WSTRING'])
  })

  test('10H is what one example prints for 10', () => {
    expect([labelDataType(10)?.title, labelDataType(0x10)?.title]).toEqual(['String [Unicode]', 'String [Unicode]'])
    expect([labelDataType(0), labelDataType(11)]).toEqual([undefined, undefined])
  })
})

describe('limits', () => {
  const message = (characters: number) => ({ abbreviations: [], labels: [{ name: 'n'.repeat(characters) }] })

  // Command, subcommand, two counts and a length are 10 bytes.
  test.each([
    ['binary', 955],
    ['ascii', 475],
  ] as const)('%s: 1920 bytes of request data', (code, most) => {
    const check = (characters: number) =>
      checkLimits(profiles['iq-r'], 'readRandomLabels', 'long', code, message(characters))
    expect(() => check(most)).not.toThrow()
    expect(() => check(most + 1)).toThrow(expect.objectContaining({ code: 'LIMIT_EXCEEDED' }))
  })

  test('a message that is none is refused with the path of its field', () => {
    const wrong = { abbreviations: [], labels: [{ name: 5 }] }
    expect(() => checkLimits(profiles['iq-r'], 'readRandomLabels', 'short', 'binary', wrong)).toThrow('labels.0.name')
  })

  test('only iQ-R has labels', () => {
    for (const name of labelCommandNames) {
      expect(commands[name].unit).toBe('none')
      expect(lackOf(profiles['iq-r'], name)).toBeUndefined()
      expect(limitsOf(profiles['iq-r'], name, 'long', 'binary').map(({ max }) => max)).toEqual([1920])
      for (const id of ['iq-f', 'q', 'l'] as const) expect(lackOf(profiles[id], name)?.endCode).toBe(0xc059)
    }
  })
})
