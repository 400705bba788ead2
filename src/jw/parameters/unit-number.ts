// The unit number switch of option units (JW300 option unit manual, "Number of units").

/** Numbers that a unit may have. */
export interface UnitNumbers {
  /** Names of the units. */
  readonly units: string
  /** Last number in a JW20H or JW30H, and in a JW300; the first is 0. */
  readonly last: {
    /** In a JW20H or JW30H. */
    readonly jw20h30h: number
    /** In a JW300. */
    readonly jw300: number
  }
}

/** Which numbers the unit number switch may have, as the manual lists them. */
export const unitNumbers: readonly UnitNumbers[] = [
  { units: 'JW-255CM, JW-25TCM', last: { jw20h30h: 6, jw300: 7 } },
  { units: 'JW-22FL5, JW-22FLT, JW-20FL5, JW-20FLT', last: { jw20h30h: 6, jw300: 7 } },
  { units: 'JW-22CM, JW-21MN, standard', last: { jw20h30h: 6, jw300: 7 } },
  { units: 'JW-22CM, JW-21MN, memory saving', last: { jw20h30h: 4, jw300: 4 } },
  { units: 'JW-21CM, remote I/O, DL1, DL9, M-NET', last: { jw20h30h: 5, jw300: 5 } },
  { units: 'JW-21CM, computer link', last: { jw20h30h: 6, jw300: 6 } },
  { units: 'JW-25CM', last: { jw20h30h: 6, jw300: 6 } },
  { units: 'JW-22SU', last: { jw20h30h: 6, jw300: 7 } },
]
