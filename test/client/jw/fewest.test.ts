/** Plans of a Sharp JW against every distribution over requests: none has fewer. */
import { expect, test } from '@jest/globals'
import fc from 'fast-check'
import { parseJwItem } from '../../../src/client/jw/item'
import { JwSpaces, jwPiecesOf } from '../../../src/client/jw/layout'
import type { JwLimits } from '../../../src/client/jw/limits'
import { jwPacked } from '../../../src/client/jw/read-pack'
import { jwBatches } from '../../../src/client/jw/write-batch'
import { jwUnitsOf } from '../../../src/client/jw/write-unit'
import { leastCut, leastPartition } from '../plan-search'

/** Far below those of a PLC, so that few items meet them. */
const limits: JwLimits = {
  readBytes: 12,
  writeBytes: 6,
  readSystem: 12,
  writeSystem: 6,
  readTimers: 4,
  readParameters: 1,
  writeParameters: 1,
  readRegisters: 6,
  writeRegisters: 5,
  setRelays: 3,
}
const GAP = 3

const item = fc.oneof(
  {
    weight: 6,
    arbitrary: fc
      .tuple(fc.nat(40), fc.constantFrom('BYTE', 'INT', 'REAL'))
      .map(([at, type]) => `F0:${at.toString(8)}:${type}`),
  },
  { weight: 3, arbitrary: fc.nat(60).map((at) => `F2:${at.toString(8)}`) },
  { weight: 2, arbitrary: fc.nat(20).map((at) => `TMR${at.toString(8).padStart(4, '0')}`) },
  { weight: 2, arbitrary: fc.nat(30).map((at) => `#${at.toString(8).padStart(4, '0')}`) },
)

function piecesOf(texts: readonly string[]) {
  const spaces = new JwSpaces('jw300')
  return texts.flatMap((text, index) => {
    const parsed = parseJwItem(text)
    return jwPiecesOf(spaces.layoutOf(parsed), parsed, index, 12)
  })
}

type Pieces = ReturnType<typeof piecesOf>

/** Whether one request may read all of them. */
function isOneRead(pieces: Pieces): boolean {
  const [first] = pieces
  const space = first?.layout.space
  const bytes = new Set(
    pieces.flatMap(({ layout, from, to }) =>
      Array.from({ length: to - from }, (_, i) => `${layout.space.file} ${from + i}`),
    ),
  )
  const isList = pieces.every(({ layout }) => layout.space.in === 'file') && bytes.size <= limits.readRegisters
  if (isList || space === undefined) return true
  if (pieces.some(({ layout }) => layout.space !== space)) return false
  const sorted = [...pieces].sort((a, b) => a.from - b.from)
  let end = sorted[0]?.from ?? 0
  for (const { from, to } of sorted) {
    if (from - end > (space.in === 'timer' ? Math.floor(GAP / 3) : GAP)) return false
    end = Math.max(end, to)
  }
  const most = space.in === 'timer' ? limits.readTimers : limits.readBytes
  return end - (sorted[0]?.from ?? 0) <= most
}

test('no other distribution of reads has fewer requests', () => {
  fc.assert(
    fc.property(fc.array(item, { minLength: 1, maxLength: 8 }), (texts) => {
      const pieces = piecesOf(texts)
      const drafts = jwPacked(pieces, { limits, gap: GAP, lists: true })
      const least = leastPartition(pieces.length, (set) => {
        const part = pieces.filter((_, i) => (set & (1 << i)) !== 0)
        return isOneRead(part) ? 1 : Number.POSITIVE_INFINITY
      })
      expect(drafts.length).toBe(least)
    }),
    { numRuns: 1000 },
  )
})

const written = fc.oneof(
  {
    weight: 5,
    arbitrary: fc.tuple(fc.nat(12), fc.constantFrom('BYTE', 'INT')).map(([at, type]) => `F0:${at.toString(8)}:${type}`),
  },
  { weight: 3, arbitrary: fc.tuple(fc.nat(12), fc.nat(7)).map(([at, bit]) => `F0:${at.toString(8)}.${bit}`) },
  { weight: 2, arbitrary: fc.nat(12).map((at) => `F2:${at.toString(8)}`) },
  { weight: 1, arbitrary: fc.nat(12).map((at) => `#${at.toString(8).padStart(4, '0')}`) },
)

test('thousands of scattered items are planned at once', () => {
  const texts = Array.from(
    { length: 5000 },
    (_, i) => `F${(2 + (i % 3)).toString(16)}:${((i * 37) % 0x10000).toString(8)}`,
  )
  const real = { ...limits, readBytes: 1024, readRegisters: 128 }
  const pieces = piecesOf(texts)
  const began = performance.now()
  const drafts = jwPacked(pieces, { limits: real, gap: 16, lists: true })
  // Some 60 ms on an idle computer.
  expect(performance.now() - began).toBeLessThan(5000)
  expect(drafts.length).toBeLessThanOrEqual(Math.ceil(5000 / 128) + 1)
  const read = drafts.flatMap((draft) => (draft.kind === 'row' ? [draft.run] : draft.runs)).flatMap((run) => run.pieces)
  expect(new Set(read.map((piece) => piece.item)).size).toBe(5000)
})

test.each([true, false])('no other way to write in this order has fewer requests; lists: %s', (lists) => {
  fc.assert(
    fc.property(fc.array(written, { minLength: 1, maxLength: 8 }), (texts) => {
      const spaces = new JwSpaces('jw300')
      const taken = new Set<string>()
      const units = texts.flatMap((text, entry) => {
        const parsed = parseJwItem(text)
        const own = jwUnitsOf(spaces.layoutOf(parsed), parsed, parsed.type.name === 'BOOL' ? true : 5, entry, {
          limits,
          lists,
          readModifyWrite: false,
        })
        const cells = own.flatMap(({ space, from, to }) =>
          Array.from({ length: to - from }, (_, i) => `${space.in} ${space.file} ${from + i}`),
        )
        if (cells.some((cell) => taken.has(cell))) return []
        for (const cell of cells) taken.add(cell)
        return own
      })
      const least = leastCut(units.length, (from, to) => {
        const part = units.slice(from, to)
        const [first] = part
        if (first === undefined) return Number.POSITIVE_INFINITY
        if (part.every(({ content }) => content.kind === 'bits')) {
          return part.length === 1 || (lists && part.length <= limits.setRelays) ? 1 : Number.POSITIVE_INFINITY
        }
        if (part.some(({ content }) => content.kind !== 'bytes')) return Number.POSITIVE_INFINITY
        const size = part.reduce((sum, unit) => sum + unit.to - unit.from, 0)
        const span = Math.max(...part.map((unit) => unit.to)) - Math.min(...part.map((unit) => unit.from))
        const isRow = part.every(({ space }) => space === first.space) && span === size && size <= limits.writeBytes
        const isList = lists && part.every(({ space }) => space.in === 'file') && size <= limits.writeRegisters
        return isRow || isList ? 1 : Number.POSITIVE_INFINITY
      })
      expect(jwBatches(units, limits, lists)).toHaveLength(least)
    }),
    { numRuns: 500 },
  )
})
