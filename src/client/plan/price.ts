// What reading costs on a serial line, in bytes on the line.
import { type DataCode, type Field, field, measure } from '../../codec/codec'
import type { Area } from './area'
import type { Stretch } from './chunk'
import type { BodyBytes } from './draft'

/** Of a command whose requests hold runs of several places. */
export interface ListPrice {
  /** A request, with nothing in it. */
  readonly request: number
  /** What a run of so many cells adds to it. */
  readonly run: (cells: number) => number
}

/** Sizes follow from area and count, so they are measured once for each area of a protocol. */
const known = { random: new WeakMap<Area, ListPrice>(), block: new WeakMap<Area, ListPrice>() } as const

/** Bytes of the values of so many cells in a row. */
export function valueBytes(code: DataCode, { kind, bitsPerCell }: Area, cells: number): number {
  if (kind === 'bit') return sizeOf(code, field.bits(cells))
  return cells * (bitsPerCell / 16) * wordBytes[code]
}

function sizeOf(code: DataCode, values: Field): number {
  return measure({ values }, { ascii: code === 'ascii', form: 0 })
}

const wordBytes: Readonly<Record<DataCode, number>> = {
  binary: sizeOf('binary', field.words(1)),
  ascii: sizeOf('ascii', field.words(1)),
}

export class Prices {
  readonly #bytes: BodyBytes
  readonly #request: number
  readonly #code: DataCode

  /** @param request bytes of a request and its answer around their bodies */
  constructor(bytes: BodyBytes, request: number, code: DataCode) {
    this.#bytes = bytes
    this.#request = request
    this.#code = code
  }

  /** A Read of this cell, without its value: 1C has a longer command for large numbers. */
  direct(area: Area, cell: number): number {
    const run: Stretch = { area, from: cell, to: cell + 1, members: [] }
    return this.#request + this.#bytes({ kind: 'direct', run }) - this.values(area, 1)
  }

  /** Values of so many cells in a row. */
  values(area: Area, cells: number): number {
    return valueBytes(this.#code, area, cells)
  }

  list(kind: 'random' | 'block', area: Area): ListPrice {
    let price = known[kind].get(area)
    if (price === undefined) {
      price = this.#listPrice(kind, area)
      known[kind].set(area, price)
    }
    return price
  }

  #listPrice(kind: 'random' | 'block', area: Area): ListPrice {
    const bytes = (...lengths: number[]) =>
      this.#bytes({ kind, runs: lengths.map((to): Stretch => ({ area, from: 0, to, members: [] })) })
    const one = bytes(1)
    const first = bytes(1, 1) - one
    const body = one - first
    const second = bytes(2) - body
    const inPairs = kind === 'random' && area.ways.random === 'words'
    return {
      request: this.#request + body,
      // Read Random has an entry for each two words and another for one that is left; a block has its head once.
      run: inPairs
        ? (cells) => (cells >> 1) * second + (cells & 1) * first
        : (cells) => first + (cells - 1) * (second - first),
    }
  }
}
