// Where the device addresses of a command stand in its message: found once per command from its declaration.
import { isArrayLike, type Message, type Shape } from '../../codec/codec'
import type { Command } from '../commands/command'
import type { DeviceUse } from './access'
import { deviceAddress } from './codec'
import type { DeviceAddress } from './device'

/** One address of a message and how the command is about to use it. */
export interface FoundDevice {
  /** Name of the field that holds it. */
  readonly field: string
  /** Place of the element it is in, where the use is in a list. */
  readonly index?: number | undefined
  readonly address: DeviceAddress
  readonly use: DeviceUse
}

interface Places {
  /** Name of the address field of the message itself. */
  readonly own: string | undefined
  readonly lists: readonly { readonly list: string; readonly field: string }[]
}

const known = new WeakMap<Shape, Places>()

function placesOf(shape: Shape): Places {
  const found = known.get(shape)
  if (found !== undefined) return found
  const lists: { list: string; field: string }[] = []
  for (const [list, field] of Object.entries(shape)) {
    const address = field.kind === 'list' ? addressField(field.item) : undefined
    if (address !== undefined) lists.push({ list, field: address })
  }
  const places = { own: addressField(shape), lists }
  known.set(shape, places)
  return places
}

function addressField(shape: Shape): string | undefined {
  return Object.entries(shape).find(([, field]) => field.kind === 'value' && field.codec === deviceAddress)?.[0]
}

/** Every device address of a message that is about to be encoded. Fields of a wrong type are left to the encoder. */
export function devicesOf(command: Command, message: Message): readonly FoundDevice[] {
  // Plain JavaScript callers pass anything; the encoder says what is wrong with it.
  if (!isMessage(message)) return []
  const { own, lists } = placesOf(command.request)
  const found: FoundDevice[] = []
  if (own !== undefined && isMessage(message[own])) found.push(foundIn(command, message, own))
  for (const { list, field } of lists) {
    const elements = message[list]
    if (!Array.isArray(elements)) continue
    elements.forEach((element, i) => {
      if (isMessage(element) && isMessage(element[field]))
        found.push(foundIn(command, element, field, { list, index: i }))
    })
  }
  return found
}

/** Where a device stands in its message, e.g. `words.3.device`: put together for messages only. */
export function pathOf({ use: { list }, index, field }: FoundDevice): string {
  return index === undefined ? field : `${list}.${index}.${field}`
}

function foundIn(
  command: Command,
  holder: Message,
  field: string,
  place?: { readonly list: string; readonly index: number },
): FoundDevice {
  const { points, values } = holder
  const count = typeof points === 'number' ? points : isArrayLike(values) ? values.length : undefined
  const use: { readonly command: string; list?: string; points?: number } = { command: command.name }
  if (place !== undefined) use.list = place.list
  if (count !== undefined) use.points = count
  // The names come from the declarations, which device-access knows: commands with an address and their lists.
  return { field, address: holder[field] as DeviceAddress, use: use as DeviceUse, index: place?.index }
}

function isMessage(value: unknown): value is Message {
  return typeof value === 'object' && value !== null
}
