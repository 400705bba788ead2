import { describe, expect, test } from '@jest/globals'
import { findDevice } from '../../src/melsec/device/device'
import { bytesOf, FAMILIES, vectorsOf } from './vectors'

/** Kinds whose bytes in ASCII code may hold control codes (STX, ETX, CR …) or the text of the message. */
const WITH_CONTROL_CODES = ['frame', 'control']

describe.each(FAMILIES)('vectors of %s', (family) => {
  const vectors = vectorsOf(family)

  test('have unique ids', () => {
    expect(new Set(vectors.map((vector) => vector.id)).size).toBe(vectors.length)
  })

  test('have whole bytes in lower-case hexadecimal digits', () => {
    for (const vector of vectors) expect(vector.hex).toMatch(/^(?:[0-9a-f]{2})+$/)
  })

  test('hold printable characters only in ASCII code', () => {
    const ascii = vectors.filter((vector) => vector.code === 'ascii' && !WITH_CONTROL_CODES.includes(vector.kind))
    for (const vector of ascii) expect(bytesOf(vector).toString('latin1')).toMatch(/^[ -~]+$/)
  })

  test('explain what is corrected or assumed', () => {
    const doubtful = vectors.filter((vector) => vector.basis === 'corrected' || vector.basis === 'assumed')
    for (const vector of doubtful) expect(vector.note).toMatch(/\w+/)
  })

  test('name devices that exist', () => {
    for (const name of JSON.stringify(vectors).matchAll(/"device":"(\w+)"/g))
      expect(findDevice(name[1] ?? '')).toBeDefined()
  })
})
