/** The codes of NAK: what a program decides by when a serial PLC has refused. */
import { describe, expect, test } from '@jest/globals'
import { explainEndCode } from '../../src/end-code/explain'
import { commands } from '../../src/melsec/commands/commands'
import { languages } from '../../src/melsec/end-codes/end-code'
import { factsOf } from '../../src/melsec/end-codes/facts'
import { oneCCommands } from '../../src/melsec/one-c/commands'
import { codesOf, errorTables } from './error-tables'

const tables = [
  { family: '1C', place: '1C', write: oneCCommands.WW, damaged: '02' },
  { family: 'slmp', place: '3C/4C', write: commands.writeWords, damaged: '7F24 7F40 7F67-7F69' },
] as const

describe.each(tables)('a NAK of $place', ({ family, place, write, damaged }) => {
  const codes = errorTables.filter((table) => table.place === place).flatMap((table) => codesOf(table.codes))

  test('has a text in every language', () => {
    expect(codes.length).toBeGreaterThan(5)
    for (const code of codes) {
      for (const language of languages) {
        expect(explainEndCode(code, { family, language })).toMatchObject({ exact: true, answer: true })
      }
    }
  })

  test('says that nothing was carried out, and what it is about', () => {
    for (const code of codes) {
      const { about, carriedOut } = factsOf[family].refusal(write, code)
      expect([code, carriedOut]).toEqual([code, false])
      expect(about).not.toBe('unknown')
    }
  })

  test('is about the transmission only where our own frame arrived damaged, so that a write may be sent once more', () => {
    const found = codes.filter((code) => factsOf[family].about(code) === 'transmission')
    expect(found).toEqual(codesOf(damaged))
  })
})

test('of what a CPU itself found (4000 to 4FFF) a write may have been carried out, unless the code is known', () => {
  expect(explainEndCode(0x4abc, { family: 'slmp' })).toMatchObject({ exact: false })
  expect(factsOf.slmp.refusal(commands.writeWords, 0x4abc)).toMatchObject({ about: 'unknown' })
  expect(factsOf.slmp.refusal(commands.writeWords, 0x4abc).carriedOut).toBeUndefined()
  expect(factsOf.slmp.refusal(commands.readWords, 0x4abc).carriedOut).toBe(false)
})
