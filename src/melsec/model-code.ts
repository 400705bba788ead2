// Model codes that Read Type Name (0101) answers: SLMP reference manual 5.6 and FX5 communication manual 38.3.
// The manuals say: identify a CPU by this code, not by the model name.
import type { ProfileId } from './profiles/profile'

/** Series of CPUs and modules. */
export type Series = 'iQ-R' | 'iQ-F' | 'iQ-L' | 'Q' | 'QS' | 'L' | 'MELIPC' | 'CC-Link IE Field'

/** What a model code stands for. Several models may share one code. */
export interface Model {
  /** Models that share the code. */
  readonly models: readonly string[]
  /** Series they belong to. */
  readonly series: Series
  /** The profile that fits. */
  readonly profile: ProfileId
  /** Where the code is from, when not from the two manuals. */
  readonly source?: string
}

type Row = readonly [code: number, ...models: string[]]

const qCpus: readonly Row[] = [
  [0x0041, 'Q02CPU', 'Q02HCPU', 'Q02PHCPU'],
  [0x0042, 'Q06HCPU', 'Q06PHCPU'],
  [0x0043, 'Q12HCPU', 'Q12PHCPU'],
  [0x0044, 'Q25HCPU', 'Q25PHCPU'],
  [0x004b, 'Q12PRHCPU'],
  [0x004c, 'Q25PRHCPU'],
  [0x0250, 'Q00JCPU'],
  [0x0251, 'Q00CPU'],
  [0x0252, 'Q01CPU'],
  [0x0260, 'Q00UJCPU'],
  [0x0261, 'Q00UCPU'],
  [0x0262, 'Q01UCPU'],
  [0x0263, 'Q02UCPU'],
  [0x0266, 'Q10UDHCPU', 'Q10UDEHCPU'],
  [0x0267, 'Q20UDHCPU', 'Q20UDEHCPU'],
  [0x0268, 'Q03UDCPU', 'Q03UDECPU'],
  [0x0269, 'Q04UDHCPU', 'Q04UDEHCPU'],
  [0x026a, 'Q06UDHCPU', 'Q06UDEHCPU'],
  [0x026b, 'Q13UDHCPU', 'Q13UDEHCPU'],
  [0x026c, 'Q26UDHCPU', 'Q26UDEHCPU'],
  [0x026d, 'Q50UDEHCPU'],
  [0x026e, 'Q100UDEHCPU'],
  [0x0366, 'Q03UDVCPU'],
  [0x0367, 'Q04UDVCPU', 'Q04UDPVCPU'],
  [0x0368, 'Q06UDVCPU', 'Q06UDPVCPU'],
  [0x036a, 'Q13UDVCPU', 'Q13UDPVCPU'],
  [0x036c, 'Q26UDVCPU', 'Q26UDPVCPU'],
]

const lCpus: readonly Row[] = [
  [0x0541, 'L02CPU', 'L02CPU-P'],
  [0x0542, 'L26CPU-BT', 'L26CPU-PBT'],
  [0x0543, 'L02SCPU', 'L02SCPU-P'],
  [0x0544, 'L06CPU', 'L06CPU-P'],
  [0x0545, 'L26CPU', 'L26CPU-P'],
  [0x0641, 'LJ72GF15-T2'],
]

const rCpus: readonly Row[] = [
  // An RCPU or a remote head module behind a connected station that is not iQ-R (SLMP reference manual 5.6).
  [0x0360, 'RCPU'],
  [0x4800, 'R04CPU'],
  [0x4801, 'R08CPU'],
  [0x4802, 'R16CPU'],
  [0x4803, 'R32CPU'],
  [0x4804, 'R120CPU'],
  [0x4805, 'R04ENCPU'],
  [0x4806, 'R08ENCPU'],
  [0x4807, 'R16ENCPU'],
  [0x4808, 'R32ENCPU'],
  [0x4809, 'R120ENCPU'],
  [0x4820, 'R12CCPU-V'],
  [0x4841, 'R08PCPU'],
  [0x4842, 'R16PCPU'],
  [0x4843, 'R32PCPU'],
  [0x4844, 'R120PCPU'],
  [0x4851, 'R08PSFCPU'],
  [0x4852, 'R16PSFCPU'],
  [0x4853, 'R32PSFCPU'],
  [0x4854, 'R120PSFCPU'],
  [0x4891, 'R08SFCPU'],
  [0x4892, 'R16SFCPU'],
  [0x4893, 'R32SFCPU'],
  [0x4894, 'R120SFCPU'],
  [0x48a0, 'R00CPU'],
  [0x48a1, 'R01CPU'],
  [0x48a2, 'R02CPU'],
]

const remoteHeads: readonly Row[] = [
  [0x4860, 'RJ72GF15-T2'],
  [0x4861, 'RJ72GF15-T2 (redundant system, single line)'],
  [0x4862, 'RJ72GF15-T2 (redundant system, dual line)'],
]

/** `FX5U-32MR/ES` and so on: one row per output and power supply type, one code per number of I/O points. */
type Fx5Row = readonly [cpu: string, io: readonly number[], type: string, codes: readonly number[]]

const fx5Rows: readonly Fx5Row[] = [
  ['FX5U', [32, 64, 80], 'MR/ES', [0x4a21, 0x4a23, 0x4a24]],
  ['FX5U', [32, 64, 80], 'MT/ES', [0x4a29, 0x4a2b, 0x4a2c]],
  ['FX5U', [32, 64, 80], 'MT/ESS', [0x4a31, 0x4a33, 0x4a34]],
  ['FX5U', [32, 64, 80], 'MR/DS', [0x4a41, 0x4a43, 0x4a44]],
  ['FX5U', [32, 64, 80], 'MT/DS', [0x4a49, 0x4a4b, 0x4a4c]],
  ['FX5U', [32, 64, 80], 'MT/DSS', [0x4a51, 0x4a53, 0x4a54]],
  ['FX5UC', [32, 64, 96], 'MT/D', [0x4a91, 0x4a92, 0x4a93]],
  ['FX5UC', [32, 64, 96], 'MT/DSS', [0x4a99, 0x4a9a, 0x4a9b]],
  ['FX5UC', [32], 'MR/DS-TS', [0x4aa9]],
  ['FX5UC', [32], 'MT/DS-TS', [0x4ab1]],
  ['FX5UC', [32], 'MT/DSS-TS', [0x4ab9]],
  ['FX5UJ', [24, 40, 60], 'MR/ES', [0x4b0d, 0x4b0e, 0x4b0f]],
  ['FX5UJ', [24, 40, 60], 'MT/ES', [0x4b14, 0x4b15, 0x4b16]],
  ['FX5UJ', [24, 40, 60], 'MT/ESS', [0x4b1b, 0x4b1c, 0x4b1d]],
  ['FX5UJ', [24, 40, 60], 'MR/DS', [0x4b22, 0x4b23, 0x4b24]],
  ['FX5UJ', [24, 40, 60], 'MT/DS', [0x4b29, 0x4b2a, 0x4b2b]],
  ['FX5UJ', [24, 40, 60], 'MT/DSS', [0x4b30, 0x4b31, 0x4b32]],
  ['FX5S', [30, 40, 60, 80], 'MR/ES', [0x4b4e, 0x4b4f, 0x4b50, 0x4b51]],
  ['FX5S', [30, 40, 60, 80], 'MT/ES', [0x4b55, 0x4b56, 0x4b57, 0x4b58]],
  ['FX5S', [30, 40, 60, 80], 'MT/ESS', [0x4b5c, 0x4b5d, 0x4b5e, 0x4b5f]],
  ['FX5S', [30, 40, 60, 80], 'MR/DS', [0x4b63, 0x4b64, 0x4b65, 0x4b66]],
  ['FX5S', [30, 40, 60, 80], 'MT/DS', [0x4b6a, 0x4b6b, 0x4b6c, 0x4b6d]],
  ['FX5S', [30, 40, 60, 80], 'MT/DSS', [0x4b71, 0x4b72, 0x4b73, 0x4b74]],
]

function fx5Cpus(): readonly Row[] {
  return fx5Rows.flatMap(([cpu, io, type, codes]) =>
    codes.map((code, index): Row => [code, `${cpu}-${io[index]}${type}`]),
  )
}

function entries(rows: readonly Row[], about: Omit<Model, 'models'>): [number, Model][] {
  return rows.map(([code, ...models]) => [code, { models, ...about }])
}

/** Every known model by its code. */
export const modelCodes: ReadonlyMap<number, Model> = new Map([
  ...entries(qCpus, { series: 'Q', profile: 'q' }),
  ...entries([[0x0230, 'QS001CPU']], { series: 'QS', profile: 'q' }),
  ...entries(lCpus, { series: 'L', profile: 'l' }),
  ...entries(rCpus, { series: 'iQ-R', profile: 'iq-r' }),
  ...entries(remoteHeads, { series: 'iQ-R', profile: 'remote-head' }),
  ...entries(fx5Cpus(), { series: 'iQ-F', profile: 'iq-f' }),
  ...entries([[0x4e01, 'MI5122-VW']], { series: 'MELIPC', profile: 'generic' }),
  ...entries([[0x0642, 'NZ2GF-ETB']], { series: 'CC-Link IE Field', profile: 'nz2gf-etb' }),
  ...entries([[0x48c2, 'L16HCPU']], { series: 'iQ-L', profile: 'iq-r', source: 'measured by others' }),
])

/** SLMP inverters by the name they answer; their codes stand in no manual at hand (FR-E800-E is said to answer 054F). */
const INVERTER = /^FR-/

/** What to know about addresses of a device that says it is this model; undefined: nothing special. */
export function decimalWNote(model: string): string | undefined {
  if (!INVERTER.test(model)) return undefined
  return (
    `${model} is an inverter, and SLMP inverters (FR-E800) are said to number W in decimal: W902 is Pr. 902. Here W is hexadecimal, ` +
    'so W902 asks for number 2306. Set wRadix to 10 if the manual of the inverter says so.'
  )
}

/**
 * The models, series and fitting profile of a model code; undefined when it is not in the manuals.
 *
 * @example modelOf(0x4801) // { models: ['R08CPU'], series: 'iQ-R', profile: 'iq-r' }
 */
export function modelOf(code: number): Model | undefined {
  return modelCodes.get(code)
}
