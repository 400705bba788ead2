// Files that are parts of a project: they cannot be made by New File (SLMP reference manual 5.8, Procedure).

/** Extensions of title, program, FB, device comment and initial device value files. */
const PROJECT_EXTENSIONS: readonly string[] = ['DAT', 'QPG', 'PRG', 'PFB', 'QCD', 'DCM', 'QDI', 'DID']

/**
 * Whether a file of this name is part of a project. It is made under another extension and then copied to its name.
 * @example isProjectFile('MAIN.QPG') // true
 */
export function isProjectFile(name: string): boolean {
  return PROJECT_EXTENSIONS.includes(extensionOf(name))
}

/** Program and FB files of iQ-R: replaced by Delete, New and Copy only, whatever their size (5.8, Procedure). */
const NEVER_IN_PLACE: readonly string[] = ['PRG', 'PFB']

/** Whether nothing may be written into a file of this name that is in its place. */
export function isNeverInPlace(name: string): boolean {
  return NEVER_IN_PLACE.includes(extensionOf(name))
}

function extensionOf(name: string): string {
  const period = name.lastIndexOf('.')
  return period < 0 ? '' : name.slice(period + 1).toUpperCase()
}
