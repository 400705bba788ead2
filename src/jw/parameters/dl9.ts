// Data link DL9 of a JW-21CM with areas set by parameters (JW300 option unit manual, "Data link DL9"): SW0 at 6, in a JW300 only.
// The parameters say where the data are in the master; those of the slaves cannot be set there.
import { octal } from '../../basics/octal'
import { shown } from '../../basics/show'
import { field, type MessageOf } from '../../codec/codec'
import { RequestError } from '../../errors'
import { ParameterMap, type ParameterProblem } from './parameter-map'

const { list, u16, u8 } = field

const SLAVES = 15
const MOST = { bytes: 128, sum: 512 } as const

/**
 * Data link area by the unit number switch: bytes `first` to `last`, as they are numbered behind `prefix`. Its size is the most
 * the data link can have in all.
 */
export const dl9Areas = [
  { prefix: 'KO', first: 0o1000, last: 0o1477 },
  { prefix: 'KO', first: 0o1100, last: 0o1477 },
  { prefix: 'KO', first: 0o1200, last: 0o1477 },
  { prefix: 'KO', first: 0o1300, last: 0o1477 },
  { prefix: 'KO', first: 0o1400, last: 0o1477 },
  { prefix: '89', first: 0o000, last: 0o777 },
] as const

/** What the switches of the master say. */
export interface Dl9Switches {
  /** SW8, 0 to 5: which area the offsets count from. */
  readonly unitNumber: number
}

const offsets = {
  sendOffset: u16({ doc: 'first byte that goes from the master to slave 1 + n, from the start of the area' }),
  receiveOffset: u16({ doc: 'first byte that comes from slave 1 + n, from the start of the area' }),
} as const
const bytes = {
  sendBytes: u8({ doc: `bytes from the master to slave 1 + n, 0 to ${MOST.bytes}` }),
  receiveBytes: u8({ doc: `bytes from slave 1 + n to the master, 0 to ${MOST.bytes}; ${MOST.sum} of all in all` }),
} as const

/** Settings of one slave: bytes and where they are in the area of the master. */
export type Dl9Slave = MessageOf<typeof offsets> & MessageOf<typeof bytes>

/** Settings of DL9: the slaves 01, 02 and so on. */
export interface Dl9Settings {
  /** Slaves 01, 02 and so on. */
  readonly slaves: readonly Dl9Slave[]
}

/**
 * Settings and parameters of data link DL9.
 * @example dl9Parameters.write({ slaves: [{ sendOffset: 0o40, sendBytes: 8, receiveOffset: 0o60, receiveBytes: 4 }] }, { unitNumber: 1 })
 */
export const dl9Parameters = new ParameterMap<Dl9Settings, Dl9Settings, Dl9Switches>({
  unit: 'JW-21CM data link DL9',
  manual: 'JW300 option unit manual, Data link DL9',
  when: 'SW0 of the master at 6, in a JW300',
  sections: [
    { address: 0o1000, shape: { slaves: list(SLAVES, offsets) } },
    { address: 0o1100, shape: { slaves: list(SLAVES, bytes) } },
  ],
  rules(settings, switches) {
    const area = areaOf(switches)
    const ranges = settings.slaves.flatMap(rangesOf)
    return [...ranges.flatMap((range) => ofRange(range, area)), ...ofSum(ranges, area), ...overlaps(ranges)]
  },
  words: ({ name, value }, switches, index = 0) => {
    const slave = slaveText(index)
    const way = name.startsWith('send') ? `00 -> ${slave}` : `${slave} -> 00`
    if (name.endsWith('Bytes')) return `${way}: ${value} bytes`
    const place = switches === undefined ? '' : `, ${placeIn(areaOf(switches), Number(value))}`
    return `${way}: offset ${octal(Number(value), 6)} octal${place}`
  },
})

type Area = (typeof dl9Areas)[number]

function areaOf(switches: Dl9Switches): Area {
  const number: unknown = switches?.unitNumber
  const area = typeof number === 'number' ? dl9Areas[number] : undefined
  if (area !== undefined) return area
  throw new RequestError(
    'BAD_OPTION',
    `unitNumber is ${shown(number)}; the unit number switch of a DL9 master is 0 to ${dl9Areas.length - 1}.`,
    'unitNumber',
  )
}

function sizeOf({ first, last }: Area): number {
  return last - first + 1
}

function placeIn({ prefix, first, last }: Area, offset: number): string {
  if (first + offset > last) return 'behind the area'
  return `${prefix}${octal(first + offset, octal(last).length)}`
}

function slaveText(index: number): string {
  return octal(index + 1, 2)
}

/** What goes one way between master and a slave. */
interface Range {
  readonly way: 'send' | 'receive'
  readonly setting: string
  readonly slave: string
  readonly offset: number
  readonly bytes: number
}

function rangesOf(slave: Dl9Slave, index: number): Range[] {
  return (['send', 'receive'] as const).map((way) => ({
    way,
    setting: `slaves.${index}.${way}`,
    slave: slaveText(index),
    offset: slave[`${way}Offset`],
    bytes: slave[`${way}Bytes`],
  }))
}

const error = (setting: string, message: string): ParameterProblem => ({ severity: 'error', setting, message })
const warning = (setting: string, message: string): ParameterProblem => ({ severity: 'warning', setting, message })

function ofRange({ setting, slave, offset, bytes: count }: Range, area: Area): ParameterProblem[] {
  const found: ParameterProblem[] = []
  if (count > MOST.bytes)
    found.push(error(`${setting}Bytes`, `Slave ${slave} has ${count}, may have 0 to ${MOST.bytes} (error 70H).`))
  if (offset + count > sizeOf(area)) {
    const all = `${placeIn(area, 0)} to ${placeIn(area, sizeOf(area) - 1)}`
    const message = `Slave ${slave}: ${count} bytes from offset ${octal(offset, 6)} octal on leave the area ${all} of ${sizeOf(area)} bytes (error 70H).`
    found.push(error(`${setting}Offset`, message))
  }
  return found
}

function ofSum(ranges: readonly Range[], area: Area): ParameterProblem[] {
  const sum = ranges.reduce((total, range) => total + range.bytes, 0)
  if (sum > MOST.sum) return [error('slaves', `They have ${sum} bytes in all, may have ${MOST.sum} (error 70H).`)]
  if (sum <= sizeOf(area)) return []
  return [
    warning(
      'slaves',
      `They have ${sum} bytes in all; the manual prints ${sizeOf(area)} as the most of this unit number.`,
    ),
  ]
}

/** The manual does not forbid it. What two slaves send to the same bytes is lost. */
function overlaps(ranges: readonly Range[]): ParameterProblem[] {
  const used = ranges.filter((range) => range.bytes > 0)
  return used.flatMap((one, i) =>
    used.slice(i + 1).flatMap((other) => {
      const apart = one.offset + one.bytes <= other.offset || other.offset + other.bytes <= one.offset
      if (apart) return []
      const message = `Its bytes overlap those of ${one.setting}Offset.`
      return [warning(`${other.setting}Offset`, message)]
    }),
  )
}
