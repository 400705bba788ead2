// Files that are parts of a project: they cannot be made by New File (SLMP reference manual 5.8, Procedure).

/** Extensions of title, program, FB, device comment and initial device value files. */
export const PROJECT_EXTENSIONS: readonly string[] = ['DAT', 'QPG', 'PRG', 'PFB', 'QCD', 'DCM', 'QDI', 'DID']

/**
 * Whether a file of this name is part of a project. It is made under another extension and then copied to its name.
 * @example isProjectFile('MAIN.QPG') // true
 */
export function isProjectFile(name: string): boolean {
  const period = name.lastIndexOf('.')
  return period >= 0 && PROJECT_EXTENSIONS.includes(name.slice(period + 1).toUpperCase())
}
