/** Messages of any declaration, made from its shapes: what the property tests run over. */
import fc from 'fast-check'
import type { Context, Field, Message, Shape } from '../../src/codec/codec'
import { boundsOf, isVisible, type VisibleField } from '../../src/codec/field'
import { jwAddress, jwExtendedAddress } from '../../src/jw/address-codec'
import { aCompatibleDevice, aCompatibleDevices } from '../../src/melsec/a-compatible/device'
import { deviceAddress, FORM_EXTENDED, FORM_XY_OCTAL, formProblem } from '../../src/melsec/device/codec'
import { devices } from '../../src/melsec/device/device'
import { setReset } from '../../src/melsec/device/set-reset'
import { labelArea, labelData, labelName, wordsOfArea, writtenLabelArea } from '../../src/melsec/label/codec'
import { longDevice, shortDevice } from '../../src/melsec/one-c/device'
import { onOff } from '../../src/melsec/one-c/on-off'
import { anyAddress } from '../melsec/device-bytes'
import { fileCodecs, fileValues } from './arbitrary-file'

/** How the message is going to be written: not every value can be said in every code and form. */
export interface Wanted {
  readonly ascii: boolean
  readonly form: number
  /** The request, when a response is wanted. */
  readonly context?: Context
}

/** Numbers of all sizes, the edges of fields and of the short forms among them. */
const numbers = fc.oneof(
  fc.nat(70_000),
  fc.nat(0xffffffff),
  fc.constantFrom(0, 1, 255, 256, 0o777777, 999_999, 0xffffff, 0x1000000, 99_999_999, 0xfffffffe, 0xffffffff),
)

const plainDevices = devices.filter((info) => info.extensionOnly !== true).map((info) => info.name)
const plainAddress = fc.record({ device: fc.constantFrom(...plainDevices), number: numbers })

/** Any number that the digits take, also the octal ones of X and Y. */
function oneCAddress(characters: 5 | 7): fc.Arbitrary<unknown> {
  return fc.constantFrom('X', 'Y', 'M', 'S', 'TS', 'TN', 'CS', 'CN', 'D', 'R').chain((device) => {
    const digits = characters - device.length
    const radix = device === 'X' || device === 'Y' ? 8 : 10
    return fc.record({ device: fc.constant(device), number: fc.nat(radix ** digits - 1) })
  })
}

/** Array data of labels: as many words as the length takes. */
const area = fc.record({ unit: fc.constantFrom(0, 1), length: fc.nat(40) }).chain(({ unit, length }) => {
  const words = wordsOfArea({ unit: unit === 0 ? 0 : 1, length })
  return fc.record({
    unit: fc.constant(unit),
    length: fc.constant(length),
    words: fc.array(fc.nat(0xffff), { minLength: words, maxLength: words }),
  })
})

type Values = (wanted: Wanted) => fc.Arbitrary<unknown>

const extendedAddress = fc.oneof(
  fc.record({ file: fc.constant(0), address: fc.nat(0xffff), extended: fc.constant(true) }),
  fc.record({ file: fc.constant(1), address: fc.nat(0x7fffff), extended: fc.constant(true) }),
)

const VALUES: ReadonlyMap<object, Values> = new Map<object, Values>([
  [
    deviceAddress,
    ({ ascii, form }) =>
      ((form & FORM_EXTENDED) === 0 ? plainAddress : fc.oneof(plainAddress, anyAddress)).filter(
        (address) => formProblem(address, ascii, form) === undefined,
      ),
  ],
  [
    aCompatibleDevice,
    ({ ascii, form }) =>
      fc
        .record({ device: fc.constantFrom(...aCompatibleDevices.map(({ name }) => name)), number: numbers })
        .filter(({ number }) => !ascii || (form & FORM_XY_OCTAL) === 0 || number < 8 ** 8),
  ],
  [shortDevice, () => oneCAddress(5)],
  [longDevice, () => oneCAddress(7)],
  [setReset, () => fc.boolean()],
  [onOff, () => fc.boolean()],
  ...fileCodecs.map((codec): [object, Values] => [
    codec,
    ({ form }) => fileValues(form).get(codec) as fc.Arbitrary<unknown>,
  ]),
  [labelName, () => fc.string({ minLength: 1, maxLength: 20, unit: 'binary' })],
  [labelData, () => fc.array(fc.nat(0xffff), { maxLength: 9 })],
  [labelArea, () => area],
  [writtenLabelArea, () => area],
  [jwAddress, () => fc.oneof(fc.record({ file: fc.nat(0x80), address: fc.nat(0xffff) }), extendedAddress)],
  [jwExtendedAddress, () => extendedAddress],
])

const CHARACTERS = {
  any: 'Az09 -\u00e9\u00ff\u0000',
  printable: 'Az09 -~',
  hexDigits: '0123456789ABCDEF',
  alphanumeric: 'AZaz09',
}

const ELEMENTS = {
  words: fc.nat(0xffff),
  doubleWords: fc.nat(0xffffffff),
  bits: fc.boolean(),
  bytes: fc.nat(0xff),
} as const

/** Elements of a bulk field or list: mostly few, now and then as many as the field takes or a request may carry. */
function sizes(min: number, max: number): fc.Arbitrary<number> {
  const most = Math.max(min, Math.min(max, 960))
  const few = fc.integer({ min, max: Math.min(most, min + 5) })
  return fc.oneof({ weight: 39, arbitrary: few }, { weight: 1, arbitrary: fc.constant(most) })
}

/** As many elements as are made one by one; longer rows repeat them, because making thousands takes seconds. */
const MADE = 8

/** Any message of `shape` that can be written as wanted. */
export function arbitrary(shape: Shape, wanted: Wanted): fc.Arbitrary<Message> {
  const values = valuesOf(shape, wanted)
  return fc.gen().map((generate) => new Maker(generate, values, wanted.context).message(shape))
}

/** The arbitraries of the shape's value codecs, made once. */
function valuesOf(shape: Shape, wanted: Wanted): Map<object, fc.Arbitrary<unknown>> {
  const found = new Map<object, fc.Arbitrary<unknown>>()
  for (const field of Object.values(shape)) {
    if (field.kind === 'list') for (const [codec, values] of valuesOf(field.item, wanted)) found.set(codec, values)
    if (field.kind !== 'value') continue
    const values = VALUES.get(field.codec)
    if (values === undefined) throw new Error(`No values are known for the codec ${field.codec.name}: add them here.`)
    found.set(field.codec, values(wanted))
  }
  return found
}

class Maker {
  constructor(
    private readonly generate: fc.GeneratorValue,
    private readonly values: ReadonlyMap<object, fc.Arbitrary<unknown>>,
    private readonly context: Context | undefined,
  ) {}

  message(shape: Shape): Message {
    const message: Record<string, unknown> = {}
    for (const [name, field] of Object.entries(shape)) {
      if (!isVisible(field)) continue
      message[name] = this.value(name, field, shape, message)
    }
    return message
  }

  private value(name: string, field: VisibleField, shape: Shape, message: Message): unknown {
    switch (field.kind) {
      case 'u8':
      case 'u16':
      case 'u32':
        return this.integer(name, field)
      case 'value':
        return this.generate(() => this.values.get(field.codec) as fc.Arbitrary<unknown>)
      case 'words':
      case 'doubleWords':
      case 'bits':
        return this.elements<unknown>(ELEMENTS[field.kind], this.size(name, field.count, shape, message))
      case 'bytes':
        return Buffer.from(this.elements(ELEMENTS.bytes, this.size(name, field.count, shape, message)))
      case 'text': {
        const characters = CHARACTERS[field.charset ?? 'any']
        return this.elements(fc.constantFrom(...characters), this.size(name, field.count, shape, message)).join('')
      }
      case 'rest':
        return Buffer.from(
          this.elements(
            ELEMENTS.bytes,
            this.generate(() => sizes(field.min, field.max)),
          ),
        )
      case 'list':
        return repeated(this.size(name, field.count, shape, message), () => this.message(field.item))
      case 'each': {
        const asked = this.context?.message[field.of] as readonly Message[]
        return asked.map((element) => this.value('', field.item, {}, element))
      }
      default:
        return field satisfies never
    }
  }

  private integer(name: string, field: Extract<Field, { kind: 'u8' | 'u16' | 'u32' }>): number {
    const { oneOf, multipleOf } = field
    const [min, max] = boundsOf(field)
    if (oneOf !== undefined) return this.generate(() => fc.constantFrom(...oneOf))
    // A number of points is also how much a response holds: it stays within what one request may carry.
    if (name === 'points' || name === 'length') return this.generate(() => sizes(min, max))
    return multipleAtMost(
      this.generate(() => fc.oneof(fc.integer({ min, max }), fc.constantFrom(min, max))),
      multipleOf,
    )
  }

  private elements<T>(element: fc.Arbitrary<T>, length: number): T[] {
    return repeated(length, () => this.generate(() => element))
  }

  private size(name: string, count: number | string, shape: Shape, message: Message): number {
    if (typeof count === 'number') return count
    const derived = Object.values(shape).find((field) => field.kind === 'count' && field.of === name)
    if (derived?.kind === 'count') {
      const { min = 0, atMost } = derived
      const asked = atMost === undefined ? derived.max : Number(this.context?.message[atMost])
      const max = asked ?? 2 ** (8 * derived.width) - 1
      return multipleAtMost(
        this.generate(() => sizes(min, max)),
        derived.multipleOf,
      )
    }
    const asked = this.context?.shape[count]
    const here = count === name ? undefined : message[count]
    const found = here ?? this.context?.message[asked?.kind === 'count' ? asked.of : count]
    return typeof found === 'number' ? found : (found as ArrayLike<unknown>).length
  }
}

/** Bounds of such fields are multiples themselves, so none is left. */
function multipleAtMost(number: number, of = 1): number {
  return number - (number % of)
}

function repeated<T>(length: number, make: () => T): T[] {
  const made = Array.from({ length: Math.min(length, MADE) }, make)
  return Array.from({ length }, (_, i) => made[i % MADE] as T)
}
