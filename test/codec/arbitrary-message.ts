/** Messages of any declaration, made from its shapes: what the property tests run over. */
import fc from 'fast-check'
import type { Context, Message, Shape } from '../../src/codec/codec'
import { isVisible, type VisibleField } from '../../src/codec/field'
import { jwAddress, jwExtendedAddress } from '../../src/jw/address-codec'
import { aCompatibleDevice } from '../../src/melsec/a-compatible/device'
import { deviceAddress } from '../../src/melsec/device/codec'
import { setReset } from '../../src/melsec/device/set-reset'
import { labelArea, labelData, labelName, wordsOfArea, writtenLabelArea } from '../../src/melsec/label/codec'
import { longDevice, shortDevice } from '../../src/melsec/one-c/device'
import { onOff } from '../../src/melsec/one-c/on-off'
import { fileValues } from '../support/arbitrary-file'

type Generate = fc.GeneratorValue

const number = fc.integer({ min: 0, max: 0x7fff })
const device = (names: readonly string[], last?: number) =>
  fc.record({ device: fc.constantFrom(...names), number: last === undefined ? number : fc.nat(last) })

/** Array data of labels: as many words as the length takes. */
const area = fc.record({ unit: fc.constantFrom(0, 1), length: fc.nat(40) }).chain(({ unit, length }) => {
  const words = wordsOfArea({ unit: unit === 0 ? 0 : 1, length })
  return fc.record({
    unit: fc.constant(unit),
    length: fc.constant(length),
    words: fc.array(fc.nat(0xffff), { minLength: words, maxLength: words }),
  })
})

const extendedAddress = fc.record({
  file: fc.integer({ min: 0, max: 1 }),
  address: number,
  extended: fc.constant(true),
})

/** Values of the value codecs, which any form can say. */
const VALUES: ReadonlyMap<object, fc.Arbitrary<unknown>> = new Map<object, fc.Arbitrary<unknown>>([
  [deviceAddress, device(['D', 'M', 'X', 'Y', 'W', 'ZR', 'TN', 'SB'])],
  [aCompatibleDevice, device(['D', 'M', 'X', 'R', 'TN'])],
  [shortDevice, device(['D', 'M', 'X', 'S'], 0o377)],
  [longDevice, device(['D', 'R', 'X', 'TN'], 0o377)],
  [setReset, fc.boolean()],
  [onOff, fc.boolean()],
  ...fileValues(0),
  [labelName, fc.string({ minLength: 1, maxLength: 20, unit: 'binary' })],
  [labelData, fc.array(fc.nat(0xffff), { maxLength: 9 })],
  [labelArea, area],
  [writtenLabelArea, area],
  [jwAddress, fc.oneof(fc.record({ file: fc.integer({ min: 0, max: 0x80 }), address: number }), extendedAddress)],
  [jwExtendedAddress, extendedAddress],
])

const ELEMENT = {
  words: fc.integer({ min: 0, max: 0xffff }),
  doubleWords: fc.nat(0xffffffff),
  bits: fc.boolean(),
  bytes: fc.integer({ min: 0, max: 0xff }),
} satisfies Record<string, fc.Arbitrary<unknown>>
const CHARACTERS = { any: 'Az09 -é', printable: 'Az09 -~', hexDigits: '0123456789ABCDEF', alphanumeric: 'AZaz09' }
const MOST = 20

/** A message of `shape`; a response's with the request it answers. */
export function messageOf(shape: Shape, generate: Generate, context?: Context): Message {
  const message: Record<string, unknown> = {}
  for (const [name, field] of Object.entries(shape)) {
    if (!isVisible(field)) continue
    message[name] = valueFor(name, field, shape, message, generate, context)
  }
  return message
}

function valueFor(
  name: string,
  field: VisibleField,
  shape: Shape,
  message: Message,
  generate: Generate,
  context: Context | undefined,
): unknown {
  const size = () => sizeOf(name, 'count' in field ? field.count : 0, shape, message, generate, context)
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32': {
      const { min = 0, max = MOST, oneOf, multipleOf = 1 } = field
      return generate(() =>
        oneOf === undefined
          ? fc.integer({ min, max: Math.max(min, Math.min(max, MOST)) }).map((made) => made - (made % multipleOf))
          : fc.constantFrom(...oneOf),
      )
    }
    case 'value': {
      const values = VALUES.get(field.codec)
      if (values === undefined) throw new Error(`no values for the codec ${field.codec.name}`)
      return generate(() => values)
    }
    case 'bytes':
      return Buffer.from(array(ELEMENT.bytes, size(), generate))
    case 'words':
    case 'doubleWords':
    case 'bits':
      return array<unknown>(ELEMENT[field.kind], size(), generate)
    case 'text': {
      const characters = CHARACTERS[field.charset ?? 'any']
      return array(fc.constantFrom(...characters), size(), generate).join('')
    }
    case 'rest':
      return Buffer.from(
        array(
          ELEMENT.bytes,
          Math.max(
            field.min,
            generate(() => fc.nat(MOST)),
          ),
          generate,
        ),
      )
    case 'list':
      return Array.from({ length: size() }, () => messageOf(field.item, generate, context))
    case 'each': {
      const elements = context?.message[field.of] as readonly Message[]
      return elements.map((element) => valueFor('', field.item, {}, element, generate, undefined))
    }
    default:
      return field satisfies never
  }
}

function array<T>(element: fc.Arbitrary<T>, length: number, generate: Generate): T[] {
  return generate(() => fc.array(element, { minLength: length, maxLength: length }))
}

function sizeOf(
  name: string,
  count: number | string,
  shape: Shape,
  message: Message,
  generate: Generate,
  context: Context | undefined,
): number {
  if (typeof count === 'number') return count
  const derived = Object.values(shape).find((field) => field.kind === 'count' && field.of === name)
  const asked = context?.shape[count]
  // What the request says goes before a free length: an encoder holds a response against its request.
  const found =
    (count === name ? undefined : message[count]) ?? context?.message[asked?.kind === 'count' ? asked.of : count]
  if (typeof found === 'number') return found
  if (found !== undefined) return (found as ArrayLike<unknown>).length
  if (derived?.kind !== 'count') throw new Error(`nothing tells the count of ${name}`)
  const most = derived.atMost === undefined ? MOST : Math.min(MOST, Number(context?.message[derived.atMost]))
  const made = generate(() => fc.integer({ min: derived.min ?? 0, max: most }))
  return made - (made % (derived.multipleOf ?? 1))
}
