// Attributes of files and directories (SLMP reference manual 5.8, Read Directory/File and Change File State).

/** What an attribute says. */
export interface FileAttributes {
  readonly directory: boolean
  readonly readOnly: boolean
  /** Not one of the manual's: a file of the system, which must be left alone. */
  readonly system: boolean
}

const ATTRIBUTES: ReadonlyMap<number, FileAttributes> = new Map([
  [0x00, { directory: false, readOnly: false, system: false }],
  [0x20, { directory: false, readOnly: false, system: false }],
  [0x01, { directory: false, readOnly: true, system: false }],
  [0x21, { directory: false, readOnly: true, system: false }],
  [0x10, { directory: true, readOnly: false, system: false }],
  [0x30, { directory: true, readOnly: false, system: false }],
  [0x11, { directory: true, readOnly: true, system: false }],
  [0x31, { directory: true, readOnly: true, system: false }],
])

/** @example attributesOf(0x31) // { directory: true, readOnly: true, system: false } */
export function attributesOf(attribute: number): FileAttributes {
  const known = ATTRIBUTES.get(attribute)
  // Bits of the file system: 01 read-only, 10 directory.
  return known ?? { directory: (attribute & 0x10) !== 0, readOnly: (attribute & 0x01) !== 0, system: true }
}

/** The number that a list of files has for it: the ones of the manual's examples. */
export function attributeNumber({ directory, readOnly }: Omit<FileAttributes, 'system'>): number {
  if (directory) return readOnly ? 0x31 : 0x30
  return readOnly ? 0x01 : 0x20
}

/** e.g. `read-only file` */
export function attributeText(attribute: number): string {
  const { directory, readOnly, system } = attributesOf(attribute)
  const kind = directory ? 'directory' : 'file'
  return `${readOnly ? 'read-only ' : ''}${kind}${system ? ' of the system' : ''}`
}
