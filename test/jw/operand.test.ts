import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../src/errors'
import { assumedJwAreas, type JwArea } from '../../src/jw/operand/area'
import { type JwKindName, jwKind, jwKindNames, lastByteOf } from '../../src/jw/operand/kind'
import { formatJwOperand, type JwOperand, readOperand } from '../../src/jw/operand/notation'
import { parseJwOperand } from '../../src/jw/operand/parse'

const ASSUMED = { areas: assumedJwAreas }

function messageOf(text: unknown, areas: readonly JwArea[] = []): string {
  try {
    parseJwOperand(text as string, { areas })
  } catch (error) {
    if (error instanceof RequestError) return `${error.code} ${error.message}`
    throw error
  }
  return 'no error'
}

/** Text, canonical text, kind, number in octal, bit. */
const SPELLINGS: readonly (readonly [string, string, JwKindName, number, number?])[] = [
  ['004033', '004033', 'relay', 0o4033],
  ['04033', '004033', 'relay', 0o4033],
  ['000000', '000000', 'relay', 0],
  ['015777', '015777', 'relay', 0o15777],
  ['KO0403', 'KO0403', 'KO', 0o403],
  ['ko0403', 'KO0403', 'KO', 0o403],
  ['KO00403', 'KO0403', 'KO', 0o403],
  ['コ0403', 'KO0403', 'KO', 0o403],
  ['ｺ0403', 'KO0403', 'KO', 0o403],
  ['KO0403.3', 'KO0403.3', 'KO', 0o403, 3],
  ['09012', '09012', 'register', 0o012],
  ['009012', '09012', 'register', 0o012],
  ['19012', '19012', 'register', 0o1012],
  ['019012', '19012', 'register', 0o1012],
  ['29000', '29000', 'register', 0o2000],
  ['89777', '89777', 'register', 8 * 0o1000 + 0o777],
  ['99777', '99777', 'register', 9 * 0o1000 + 0o777],
  ['09012.7', '09012.7', 'register', 0o012, 7],
  ['b0012', 'b0012', 'b', 0o12],
  ['B0012', 'b0012', 'b', 0o12],
  ['b01777', 'b1777', 'b', 0o1777],
  ['b0012.0', 'b0012.0', 'b', 0o12, 0],
  ['E0012', 'E0012', 'E', 0o12],
  ['e1577', 'E1577', 'E', 0o1577],
  ['T-C012', 'T-C0012', 'T-C', 0o12],
  ['TMR0012', 'TMR0012', 'TMR', 0o12],
  ['TMR012', 'TMR0012', 'TMR', 0o12],
  ['TMR00012', 'TMR0012', 'TMR', 0o12],
  ['tmr17777', 'TMR17777', 'TMR', 0o17777],
  ['TMR177777', 'TMR177777', 'TMR', 0xffff],
  ['CNT0012', 'CNT0012', 'CNT', 0o12],
  ['MD0012', 'MD0012', 'MD', 0o12],
  ['#201', '#0201', '#', 0o201],
  ['#2177', '#2177', '#', 0x47f],
  ['#0201.5', '#0201.5', '#', 0o201, 5],
  ['  09012\t', '09012', 'register', 0o012],
]

/** Text, canonical text, file, byte, bit. */
const FILES: readonly (readonly [string, string, number, number, number?])[] = [
  ['F0:000403', 'F0:000403', 0, 0o403],
  ['f0:403.3', 'F0:000403.3', 0, 0o403, 3],
  ['F00:403', 'F0:000403', 0, 0o403],
  ['F2:012345', 'F2:012345', 2, 0x14e5],
  ['F1:1234', 'F1:00001234', 1, 0o1234],
  ['F1:00001234.3', 'F1:00001234.3', 1, 0o1234, 3],
  ['F1:37777777.7', 'F1:37777777.7', 1, 0x7fffff, 7],
  ['F10:0', 'F10:000000', 0x10, 0],
  ['F2C:177777', 'F2C:177777', 0x2c, 0xffff],
  ['F80:177777', 'F80:177777', 0x80, 0xffff],
]

describe('operands are read and written', () => {
  test.each(SPELLINGS)('%s is %s', (...[text, canonical, kind, number, bit]) => {
    const operand = { kind, number, ...(bit === undefined ? {} : { bit }) }
    expect(parseJwOperand(text, ASSUMED)).toEqual(operand)
    expect(formatJwOperand(operand)).toBe(canonical)
    expect(parseJwOperand(canonical, ASSUMED)).toEqual(operand)
  })

  test.each(FILES)('%s is %s', (...[text, canonical, file, number, bit]) => {
    const operand = { kind: 'F', file, number, ...(bit === undefined ? {} : { bit }) } as const
    expect(parseJwOperand(text)).toEqual(operand)
    expect(formatJwOperand(operand)).toBe(canonical)
    expect(parseJwOperand(canonical)).toEqual(operand)
  })

  test('every kind is in the table, by its example', () => {
    for (const kind of jwKindNames) {
      expect(readOperand(jwKind(kind).example).kind).toBe(kind)
      expect(formatJwOperand(readOperand(jwKind(kind).example))).toBe(jwKind(kind).example)
    }
    expect(new Set([...SPELLINGS.map((row) => row[2]), 'F'])).toEqual(new Set(jwKindNames))
  })

  const operands: fc.Arbitrary<JwOperand> = fc.constantFrom(...jwKindNames).chain((kind) =>
    fc
      .record({ file: fc.integer({ min: 0, max: 0x80 }), bit: fc.option(fc.integer({ min: 0, max: 7 })) })
      .chain(({ file, bit }) => {
        const last = kind === 'F' ? lastByteOf(file) : jwKind(kind).last
        const hasBit = bit !== null && jwKind(kind).unit === 'byte'
        return fc
          .integer({ min: 0, max: last })
          .map((number) => ({ kind, number, ...(kind === 'F' ? { file } : {}), ...(hasBit ? { bit } : {}) }))
      }),
  )

  test('what is written is read as the same, in either case, and its text is the only one', () => {
    fc.assert(
      fc.property(operands, (operand) => {
        const text = formatJwOperand(operand)
        expect(readOperand(text)).toEqual(operand)
        expect(readOperand(text.toLowerCase())).toEqual(operand)
        expect(formatJwOperand(readOperand(text))).toBe(text)
      }),
    )
  })

  test('any text is an operand or a RequestError, and an operand is written as what it was read from', () => {
    const letters = '0123456789abEFKOTMRCNDコ#:.-'
    const texts = fc.string({ unit: fc.constantFrom(...letters), maxLength: 12 })
    fc.assert(
      fc.property(fc.oneof(texts, fc.string({ maxLength: 30 })), (text) => {
        const message = messageOf(text, assumedJwAreas)
        if (message !== 'no error') return
        const operand = parseJwOperand(text, ASSUMED)
        expect(parseJwOperand(formatJwOperand(operand), ASSUMED)).toEqual(operand)
      }),
    )
  })
})

/** What is refused, and what the message says. */
const REFUSED: readonly (readonly [unknown, ...string[]])[] = [
  ['', 'BAD_ADDRESS', '"": no operand', '004033', '09012'],
  [undefined, 'BAD_ADDRESS', 'An address is a text such as 09012'],
  [9012, 'BAD_ADDRESS', 'An address is a text such as 09012, not 9012'],
  ['04083', 'BAD_ADDRESS', '"04083": a relay has an octal number (digits 0 to 7: behind 17 comes 20), and "8" is none'],
  ['90000', 'BAD_ADDRESS', 'a relay has an octal number', '"9" is none'],
  ['09082', 'BAD_ADDRESS', 'behind the 9 of a register stand three octal digits (0 to 7), not 082'],
  ['b0018', 'BAD_ADDRESS', 'has an octal number', '"8" is none'],
  ['#0289', 'BAD_ADDRESS', 'a byte of the system memory has an octal number'],
  ['F1:00001238', 'BAD_ADDRESS', 'a byte of a file has an octal number'],
  ['F2:9', 'BAD_ADDRESS', 'a byte of a file has an octal number'],
  ['F81:0', 'OUT_OF_RANGE', 'files have the numbers 00 to 80 (hexadecimal)'],
  ['FFF:0', 'OUT_OF_RANGE', 'files have the numbers'],
  ['F123:0', 'BAD_ADDRESS', 'one or two hexadecimal digits, e.g. F2:012345'],
  ['FG:0', 'BAD_ADDRESS', 'one or two hexadecimal digits'],
  ['F:12', 'BAD_ADDRESS', 'one or two hexadecimal digits'],
  ['F2:', 'BAD_ADDRESS', 'the number is missing behind the file'],
  ['F0:200000', 'OUT_OF_RANGE', 'file 0 ends at byte 177777 (octal)'],
  ['F2:200000', 'OUT_OF_RANGE', 'file 2 ends at byte 177777 (octal)', 'F1:, up to 37777777'],
  ['F1:40000000', 'OUT_OF_RANGE', 'the last byte of a file that can be written is 37777777'],
  ['F1:777777777', 'BAD_ADDRESS', 'has 1 to 8 digits', 'this has 9'],
  ['#2200', 'OUT_OF_RANGE', 'the last byte of the system memory that can be written is 2177'],
  ['TMR200000', 'OUT_OF_RANGE', 'the last timer that can be written is 177777'],
  ['4033', 'BAD_ADDRESS', 'a relay has 5 or 6 digits', 'write 004033'],
  ['0403', 'BAD_ADDRESS', 'a relay has 5 or 6 digits', 'write 000403 or KO0403'],
  ['9012', 'BAD_ADDRESS', 'a register has 5 digits: write 09012'],
  ['9012.3', 'BAD_ADDRESS', 'write 09012.3'],
  ['00004033', 'BAD_ADDRESS', 'a file register is written with its file', 'write F1:00004033 or 004033'],
  ['00001234.5', 'BAD_ADDRESS', 'write F1:00001234.5'],
  ['123456789', 'BAD_ADDRESS', 'has 5 or 6 digits', 'this has 9'],
  ['b12', 'BAD_ADDRESS', 'write b0012'],
  ['KO403', 'BAD_ADDRESS', 'write KO0403'],
  ['TMR5', 'BAD_ADDRESS', 'write TMR0005'],
  ['E12', 'BAD_ADDRESS', 'a register E has 4 or 5 digits, e.g. E0012; this has 2'],
  ['0403.3', 'BAD_ADDRESS', 'a byte of relays begins with KO: write KO0403.3'],
  ['004033.3', 'BAD_ADDRESS', 'a relay is one bit already', 'write 004033 or KO0403.3'],
  ['TMR0012.3', 'BAD_ADDRESS', 'a timer is taken as a whole and has no bits: leave .3 out'],
  ['09012.8', 'BAD_ADDRESS', 'behind the dot stands the bit of a byte, one digit from 0 to 7'],
  ['09012.F', 'BAD_ADDRESS', 'one digit from 0 to 7'],
  ['09012.', 'BAD_ADDRESS', 'one digit from 0 to 7'],
  ['T0012', 'BAD_ADDRESS', 'a timer has a current value and a contact: write TMR0012'],
  ['C12', 'BAD_ADDRESS', 'a counter has a current value and a contact: write CNT0012'],
  ['F1.1234', 'BAD_ADDRESS', 'stands a colon: write F1:00001234'],
  ['F1-1234', 'BAD_ADDRESS', 'stands a colon: write F1:00001234'],
  ['1:1234', 'BAD_ADDRESS', 'a file number begins with F: write F1:00001234'],
  ['b 0012', 'BAD_ADDRESS', 'it has a space: write b0012'],
  ['F1: 1234', 'BAD_ADDRESS', 'it has a space: write F1:00001234'],
  ['０９０１２', 'BAD_ADDRESS', 'full-width characters: write 09012'],
  ['D100', 'BAD_ADDRESS', 'there is no operand "D100"', 'a device of a MELSEC PLC', 'registers (09000)'],
  ['M10', 'BAD_ADDRESS', 'a device of a MELSEC PLC'],
  ['X1F', 'BAD_ADDRESS', 'a device of a MELSEC PLC'],
  ['W1F.3', 'BAD_ADDRESS', 'a device of a MELSEC PLC'],
  ['U3\\G100', 'BAD_ADDRESS', 'there is no operand'],
  ['%MW10', 'BAD_ADDRESS', 'IEC notation'],
  ['DB1.DBW2', 'BAD_ADDRESS', 'Siemens'],
  ['0x403', 'BAD_ADDRESS', 'Numbers are octal, without a sign for it'],
  ['0403H', 'BAD_ADDRESS', 'Numbers are octal, without a sign for it'],
  ['09012[3]', 'BAD_ADDRESS', 'The count ([10]) is not part of an operand'],
  ['Д0012', 'BAD_ADDRESS', 'a letter that is not of an address'],
  [`b${'0'.repeat(200)}`, 'BAD_ADDRESS', '...'],
  // No source says where these lie.
  ['016000', 'OUT_OF_RANGE', 'no source says where', 'Known are 000000 to 015777', 'option areas', 'F0:'],
  ['KO1600', 'OUT_OF_RANGE', 'no source says where', 'Known are KO0000 to KO1577'],
  ['b2000', 'OUT_OF_RANGE', 'Known are b0000 to b1777'],
  ['109000', 'OUT_OF_RANGE', 'Known are 09000 to 99777'],
  ['E0012', 'OUT_OF_RANGE', 'assumed, and not confirmed, that E0000 to E1777 begin at byte 016000', 'assumedJwAreas'],
  ['E2000', 'OUT_OF_RANGE', 'no source says where'],
  ['T-C0012', 'OUT_OF_RANGE', 'assumed, and not confirmed', 'not the bits'],
]

describe('what is no operand is refused', () => {
  test('the numbers of an MD are named, too', () => {
    expect(messageOf('MD5')).toContain('write MD0005')
    expect(messageOf('MD1234567')).toContain('a number of an MD has 3 to 6 digits')
  })

  test.each(REFUSED)('%p', (text, ...parts) => {
    for (const part of parts) expect(messageOf(text)).toContain(part)
  })

  test('a contact is named where its place is given', () => {
    expect(messageOf('T0012', assumedJwAreas)).toContain('write TMR0012 or T-C0012')
    expect(messageOf('E12', assumedJwAreas)).toContain('write E0012')
  })
})
