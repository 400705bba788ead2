// FL-net units JW-20FL5, JW-20FLT, JW-22FL5 and JW-22FLT (JW300 option unit manual, "FL-net unit"). What that manual leaves out
// is from the manual of the JW-20FL5: the transmission buffer (9-4), node numbers and units of the areas (15-26).
import { isPlainObject } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { badMessage, field, type MessageInput, type MessageOf, type ValueCodec } from '../../codec/codec'
import {
  addressThenFile,
  byteOf,
  leavesPage,
  type ParameterAddress,
  placeText,
  type StoredAddress,
  storedAddress,
} from './memory-address'
import { ParameterMap, type ParameterProblem } from './parameter-map'
import { choice, filledText, tenthsOfSecond } from './setting-values'

const { optional, spare, u8, u16, value } = field

/** Words of the common memory, and bytes of the transmission buffer in the CU. */
const WORDS = { 1: 0x200, 2: 0x2000 } as const
const BUFFER = 0o4056
/** Last byte of the IP address: the parameters are read from the data memory. */
const DATA_MEMORY = 0xff

/** Instead of an IP address: where in the data memory of the CU the unit finds its parameters, as the parameter holds it. */
export interface ParametersInDataMemory {
  /** Where they are. */
  readonly parameters: StoredAddress
}

/** Whose last byte is the number of the node, or where the parameters are. */
export type FlNetAddress = string | ParametersInDataMemory

const flNetAddress: ValueCodec<FlNetAddress> = {
  name: 'IP address',
  takes:
    'an IP address whose last number is that of the node, 1 to 254; or { parameters: { fileNumber, fileAddress } } where they are in the data memory',
  example: '192.168.250.1',
  write(writer, given) {
    if (typeof given === 'string') writer.bytes(ipBytes(given))
    else {
      const { fileNumber, fileAddress } = storedAddress(inDataMemory(given), 'whole')
      writer.uint(fileAddress, 2)
      writer.uint(fileNumber, 1)
      writer.uint(DATA_MEMORY, 1)
    }
  },
  read(reader) {
    const [first = 0, second = 0, third = 0, fourth = 0] = reader.bytes(4)
    if (fourth !== DATA_MEMORY) return [first, second, third, fourth].join('.')
    return { parameters: { fileNumber: third, fileAddress: first + 0x100 * second } }
  },
  size: () => 4,
}

function ipBytes(text: string): number[] {
  const bytes = text.split('.').map(Number)
  if (!/^(0|[1-9]\d{0,2})(\.(0|[1-9]\d{0,2})){3}$/.test(text) || bytes.some((byte) => byte > 0xff))
    badMessage(`is ${shown(text)}, must be an IP address of four numbers, e.g. 192.168.250.1`)
  if (bytes.at(-1) === DATA_MEMORY)
    badMessage('ends with 255, which makes the unit look for its parameters in the data memory; nodes are 1 to 254')
  return bytes
}

function inDataMemory(given: ParametersInDataMemory): StoredAddress {
  if (isPlainObject(given) && isPlainObject(given.parameters) && Object.keys(given).length === 1)
    return given.parameters
  return badMessage(`must be ${flNetAddress.takes}; it is ${shown(given)}`)
}

const place = addressThenFile('halved')
const NOWHERE: ParameterAddress = { fileNumber: 0, fileAddress: 0 }

const head = {
  address: value(flNetAddress, 'IP address and node'),
  tokenWatchdog: u8({
    doc: 'token watchdog time in ms; the manual advises 10 up to 5 KB sent, 30 below 10 KB, else 40',
  }),
  minimumFrameInterval: u8({ doc: 'minimum permissible frame interval, in 0.1 ms' }),
  function: optional(choice({ standard: 0, memorySaving: 1 }), 'standard', 'what of the common memory is in the CU'),
  reserved07: spare(1),
} as const
const sent = {
  area1SendOffset: u16({ doc: 'area 1: first word in the common memory that this node sends' }),
  area1SendWords: u16({ doc: 'area 1: words that this node sends' }),
  area2SendOffset: u16({ doc: 'area 2: first word in the common memory that this node sends' }),
  area2SendWords: u16({ doc: 'area 2: words that this node sends' }),
} as const
const places = {
  area1Place: value(place, 'area 1 in the CU'),
  reserved23: spare(1),
  area2Place: value(place, 'area 2 in the CU'),
  reserved27: spare(1),
  managementPlace: value(place, 'communication management area in the CU'),
  managementTransfer: optional(
    choice({ all: 0x00, none: 0x80, nodesAndStates: 0x81, all83: 0x83 }),
    'all',
    'what of it is transferred; nodesAndStates: participating nodes, run and error states; all83 is the same as all',
  ),
  bufferPlace: optional(place, NOWHERE, 'transmission buffer for messages in the CU'),
  bufferUse: u8({ default: 0, doc: 'whether the buffer is used; the values are not printed' }),
} as const
const rest = {
  nodeName: optional(filledText(10), '', 'name of the node'),
  reserved52: spare(1),
  sendReceiveTimeout: optional(tenthsOfSecond, 0, 'timeout of SEND and RECEIVE; 0 is 1 s'),
  reserved54: spare(4),
} as const
const received = {
  area1ReceiveOffset: u16({ default: 0, doc: 'memory saving, area 1: first word that comes into the CU' }),
  area1ReceiveWords: u16({ default: 0, doc: 'memory saving, area 1: words that come into the CU' }),
  area2ReceiveOffset: u16({ default: 0, doc: 'memory saving, area 2: first word that comes into the CU' }),
  area2ReceiveWords: u16({ default: 0, doc: 'memory saving, area 2: words that come into the CU' }),
} as const
/** Parameters 0000 to 0067 octal. Behind them stands nothing but the start switches. */
const layout = { ...head, ...sent, ...places, ...rest, ...received } as const

/** Settings of an FL-net unit as they are given. */
export type FlNetSettings = MessageInput<typeof layout>
/** Settings of an FL-net unit as they are read: all of them. */
export type FlNetSettingsRead = MessageOf<typeof layout>

/**
 * Settings and parameters of the FL-net units.
 * @example const { blocks, warnings } = flNetParameters.write(settings); startProcedure(blocks)
 */
export const flNetParameters = new ParameterMap<FlNetSettings, FlNetSettingsRead, void>({
  unit: 'FL-net unit',
  manual: 'JW300 option unit manual, FL-net unit',
  when: 'always; in a JW20H or JW30H the start switch is 0077',
  sections: [{ address: 0o0000, shape: layout }],
  rules: (settings) => [
    ...ofNode(settings),
    ...areaNumbers.flatMap((area) => ofArea(settings, area)),
    ...overlaps(settings),
  ],
  words: ({ value: found }) => {
    if (typeof found === 'string') return found
    if (isPlainObject(found) && 'parameters' in found) return 'parameters are in the data memory'
    return isPlace(found) ? placeText(found) : undefined
  },
})

function isPlace(found: unknown): found is ParameterAddress {
  return isPlainObject(found) && ('file' in found || 'fileNumber' in found)
}

type AreaNumber = keyof typeof WORDS
const areaNumbers = [1, 2] as const satisfies readonly AreaNumber[]

interface Area {
  readonly name: string
  readonly place: ParameterAddress
  readonly sendOffset: number
  readonly sendWords: number
  readonly receiveOffset: number
  readonly receiveWords: number
}

function areaOf(settings: FlNetSettingsRead, area: AreaNumber): Area {
  return {
    name: `area${area}`,
    place: settings[`area${area}Place`],
    sendOffset: settings[`area${area}SendOffset`],
    sendWords: settings[`area${area}SendWords`],
    receiveOffset: settings[`area${area}ReceiveOffset`],
    receiveWords: settings[`area${area}ReceiveWords`],
  }
}

const error = (setting: string, message: string): ParameterProblem => ({ severity: 'error', setting, message })
const warning = (setting: string, message: string): ParameterProblem => ({ severity: 'warning', setting, message })

function ofNode(settings: FlNetSettingsRead): ParameterProblem[] {
  const { address, tokenWatchdog, area1SendWords, area2SendWords } = settings
  const found: ParameterProblem[] = []
  if (typeof address === 'string' && address.endsWith('.0'))
    found.push(error('address', `${address} ends with node 0; nodes are 1 to 254.`))
  const bytes = 2 * (area1SendWords + area2SendWords)
  const advised = advisedWatchdog(bytes)
  if (tokenWatchdog < advised)
    found.push(
      warning(
        'tokenWatchdog',
        `${tokenWatchdog} ms for ${bytes} bytes that are sent; the manual advises ${advised} ms.`,
      ),
    )
  return found
}

const KB = 1024
function advisedWatchdog(bytes: number): number {
  if (bytes >= 10 * KB) return 40
  return bytes >= 5 * KB ? 30 : 10
}

function ofArea(settings: FlNetSettingsRead, number: AreaNumber): ParameterProblem[] {
  const area = areaOf(settings, number)
  const { name, sendOffset, sendWords, receiveOffset, receiveWords } = area
  const saving = settings.function === 'memorySaving'
  const found = [...withinCommon(number, `${name}SendWords`, 'sends', sendOffset, sendWords)]
  if (saving) found.push(...withinCommon(number, `${name}ReceiveWords`, 'receives', receiveOffset, receiveWords))
  else if (receiveOffset > 0 || receiveWords > 0)
    found.push(
      warning(
        `${name}ReceiveWords`,
        `It has no effect: function is standard. Set function to memorySaving, or leave it out.`,
      ),
    )
  return [...found, ...withinPage(number, area, saving)]
}

function withinCommon(
  area: AreaNumber,
  setting: string,
  what: string,
  offset: number,
  words: number,
): ParameterProblem[] {
  if (offset + words <= WORDS[area]) return []
  return [
    error(
      setting,
      `Words ${offset} to ${offset + words - 1} are what it ${what}; area ${area} has ${WORDS[area]} words.`,
    ),
  ]
}

/** Bytes of an area in the CU: all of the common memory, or with memory saving what is received. */
function bytesOf(area: AreaNumber, { receiveWords }: Area, saving: boolean): number {
  return 2 * (saving ? receiveWords : WORDS[area])
}

function withinPage(number: AreaNumber, area: Area, saving: boolean): ParameterProblem[] {
  const { name, place: where, sendWords } = area
  const setting = `${name}Place`
  const bytes = bytesOf(number, area, saving)
  const leaves = leavesPage(where, bytes, 'halved')
  if (leaves === undefined)
    return [
      warning(setting, 'It is in file 0, where the notation is not printed: whether the area fits is not checked.'),
    ]
  if (leaves)
    return [
      error(
        setting,
        `${bytes} bytes from ${placeText(where)} on cross a border of 64 KB. Move the area to one side of it.`,
      ),
    ]
  if (!saving || leavesPage(where, bytes + 2 * sendWords, 'halved') !== true) return []
  const message = `With the words that are sent it would cross a border of 64 KB; where they lie in the CU is not printed. Keep away from the border.`
  return [warning(setting, message)]
}

/** Bytes in the CU that more than one thing would fill. */
function overlaps(settings: FlNetSettingsRead): ParameterProblem[] {
  const saving = settings.function === 'memorySaving'
  const areas = areaNumbers.map((number) => {
    const area = areaOf(settings, number)
    return { setting: `${area.name}Place`, start: byteOf(area.place, 'halved'), bytes: bytesOf(number, area, saving) }
  })
  const { bufferPlace, bufferUse } = settings
  const buffer = { setting: 'bufferPlace', start: byteOf(bufferPlace, 'halved'), bytes: BUFFER }
  const used = bufferUse === 0 ? areas : [...areas, buffer]
  const found = used.flatMap((one, i) =>
    used.slice(i + 1).flatMap((other) => {
      if (one.start === undefined || other.start === undefined) return []
      const apart = one.start + one.bytes <= other.start || other.start + other.bytes <= one.start
      return apart ? [] : [warning(other.setting, `It overlaps ${one.setting}, which has ${one.bytes} bytes.`)]
    }),
  )
  if (bufferUse !== 0 && leavesPage(bufferPlace, BUFFER, 'halved') === true)
    found.push(warning('bufferPlace', `Its ${BUFFER} bytes cross a border of 64 KB, which the areas may not do.`))
  return found
}
