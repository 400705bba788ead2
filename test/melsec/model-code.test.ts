import { describe, expect, test } from '@jest/globals'
import { pcTypeCodes } from '../../src/melsec/a-compatible/type-code'
import { modelCodes, modelOf } from '../../src/melsec/model-code'
import { profileIds } from '../../src/melsec/profiles/profile'
import { fx5Models, pcTypes, slmpModels } from './model-tables'

describe('model codes', () => {
  test.each([
    [0x41, ['Q02CPU', 'Q02HCPU', 'Q02PHCPU'], 'Q', 'q'],
    [0x36c, ['Q26UDVCPU', 'Q26UDPVCPU'], 'Q', 'q'],
    [0x230, ['QS001CPU'], 'QS', 'q'],
    [0x542, ['L26CPU-BT', 'L26CPU-PBT'], 'L', 'l'],
    [0x641, ['LJ72GF15-T2'], 'L', 'l'],
    [0x4801, ['R08CPU'], 'iQ-R', 'iq-r'],
    [0x4844, ['R120PCPU'], 'iQ-R', 'iq-r'],
    [0x48a2, ['R02CPU'], 'iQ-R', 'iq-r'],
    [0x4a21, ['FX5U-32MR/ES'], 'iQ-F', 'iq-f'],
    [0x4a23, ['FX5U-64MR/ES'], 'iQ-F', 'iq-f'],
    [0x4a9b, ['FX5UC-96MT/DSS'], 'iQ-F', 'iq-f'],
    [0x4b32, ['FX5UJ-60MT/DSS'], 'iQ-F', 'iq-f'],
    [0x4b74, ['FX5S-80MT/DSS'], 'iQ-F', 'iq-f'],
    [0x642, ['NZ2GF-ETB'], 'CC-Link IE Field', 'nz2gf-etb'],
    [0x4860, ['RJ72GF15-T2'], 'iQ-R', 'remote-head'],
  ])('%#: code %i is %j', (code, models, series, profile) => {
    expect(modelOf(code)).toMatchObject({ models, series, profile })
  })

  test('an RCPU behind a foreign connected station answers 0360H and takes the iQ-R profile', () => {
    expect(modelOf(0x0360)).toEqual({ models: ['RCPU'], series: 'iQ-R', profile: 'iq-r' })
  })

  test('holds every code of both manuals: 27 Q, 1 QS, 6 L, 30 iQ-R, 69 iQ-F, and 3 others', () => {
    const counts = new Map<string, number>()
    for (const { series } of modelCodes.values()) counts.set(series, (counts.get(series) ?? 0) + 1)
    expect(Object.fromEntries(counts)).toEqual({
      Q: 27,
      QS: 1,
      L: 6,
      'iQ-R': 30,
      'iQ-F': 69,
      MELIPC: 1,
      'CC-Link IE Field': 1,
      'iQ-L': 1,
    })
  })

  test('every code of the tables of both manuals names their models, and no code stands for others', () => {
    for (const [code, ...models] of [...slmpModels, ...fx5Models]) {
      expect([code, [...(modelOf(Number.parseInt(code, 16))?.models ?? [])].sort()]).toEqual([code, models.sort()])
    }
    const printed = new Set([...slmpModels, ...fx5Models].map(([code]) => Number.parseInt(code, 16)))
    // A note of SLMP reference manual 5.6, and what only measurements know.
    const others = [...modelCodes].filter(([code, { source }]) => !printed.has(code) && source === undefined)
    expect(others.map(([code]) => code)).toEqual([0x0360])
  })

  test('the type codes of the command PC (1C) and of 1E name the models of the manual', () => {
    expect([...pcTypeCodes.keys()].sort()).toEqual(pcTypes.map(([code]) => Number.parseInt(code, 16)).sort())
    for (const [code, ...models] of pcTypes) {
      expect([code, [...(pcTypeCodes.get(Number.parseInt(code, 16)) ?? [])].sort()]).toEqual([code, models.sort()])
    }
  })

  test('every model has a name, no model has two codes, every profile exists', () => {
    const names = [...modelCodes.values()].flatMap(({ models }) => models)
    expect(new Set(names).size).toBe(names.length)
    for (const name of names) expect(name).not.toMatch(/undefined|^$/)
    for (const { profile } of modelCodes.values()) expect(profileIds).toContain(profile)
  })

  test('an unknown code is undefined', () => {
    expect(modelOf(0x1234)).toBeUndefined()
  })
})
