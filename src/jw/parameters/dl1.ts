// Data link DL1 of a JW-21CM with the transfer bytes set by parameters (JW300 option unit manual, "Data link DL1"): SW0 at 5,
// in a JW300 only. Number of slaves, link area and flags come from the switches of the master.
import { octal } from '../../basics/octal'
import { field, type MessageOf } from '../../codec/codec'
import { ParameterMap, type ParameterProblem } from './parameter-map'

const { list, u8 } = field

const STATIONS = 16
const MOST = { station: 63, sum: 64 } as const

const station = { bytes: u8({ doc: `bytes that station n sends: 1 to ${MOST.station}, ${MOST.sum} in all` }) } as const
const layout = { stations: list(STATIONS, station) } as const

/** Settings of DL1: the stations 00, 01 and so on, as many as are linked. */
export interface Dl1Settings {
  /** Stations 00, 01 and so on. */
  readonly stations: readonly MessageOf<typeof station>[]
}

/**
 * Settings and parameters of data link DL1.
 * @example dl1Parameters.write({ stations: [{ bytes: 16 }, { bytes: 8 }] })
 */
export const dl1Parameters = new ParameterMap<Dl1Settings, Dl1Settings, void>({
  unit: 'JW-21CM data link DL1',
  manual: 'JW300 option unit manual, Data link DL1',
  when: 'SW0 of the master at 5, in a JW300',
  sections: [{ address: 0o0100, shape: layout }],
  rules: ({ stations }) => [...ofStations(stations), ...ofOthers(stations.length)],
  words: ({ value }, _about, index = 0) => `station ${stationText(index)}: ${value} bytes`,
})

/** A station as the manual numbers it: 00 to 17. */
function stationText(index: number): string {
  return octal(index, 2)
}

function ofStations(stations: Dl1Settings['stations']): ParameterProblem[] {
  const error = (setting: string, message: string) => ({ severity: 'error', setting, message }) as const
  if (stations.length === 0) return [error('stations', 'There is none. Give the bytes of each station that is linked.')]
  const found: ParameterProblem[] = stations.flatMap(({ bytes }, i) => {
    if (bytes >= 1 && bytes <= MOST.station) return []
    return [
      error(
        `stations.${i}.bytes`,
        `Station ${stationText(i)} has ${bytes}, must have 1 to ${MOST.station} (error 70H).`,
      ),
    ]
  })
  const sum = stations.reduce((total, { bytes }) => total + bytes, 0)
  if (sum > MOST.sum) found.push(error('stations', `They have ${sum} bytes in all, may have ${MOST.sum} (error 70H).`))
  return found
}

/** The manual asks it of "each station" and does not say whether those count that are not linked. */
function ofOthers(linked: number): ParameterProblem[] {
  if (linked === 0 || linked >= STATIONS) return []
  const others = `${stationText(linked)} to ${stationText(STATIONS - 1)}`
  const message = `Stations ${others} have 0 bytes. If the unit reports error 70H, give each of them 1 byte or more.`
  return [{ severity: 'warning', setting: 'stations', message }]
}
