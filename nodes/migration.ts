// Settings that older versions of a node stored, brought to what the node reads today.

/** Settings of a node as a flow stores them. */
export type StoredSettings = Readonly<Record<string, unknown>>

/** One step: `up` takes the settings of `version - 1` and gives those of `version`. */
export interface Migration {
  readonly version: number
  readonly up: (settings: StoredSettings) => StoredSettings
}

/** Version of the settings of the first release; a flow written by hand may leave it out. */
const FIRST = 1

/** The version that the newest of these migrations gives. */
export function currentVersion(migrations: readonly Migration[]): number {
  return migrations.at(-1)?.version ?? FIRST
}

/**
 * The settings at the version the node reads. Nothing is guessed: settings of a newer version are refused.
 * @param migrations oldest first
 * @throws RangeError when the settings were made by a newer version of the node.
 */
export function migrated(settings: StoredSettings, migrations: readonly Migration[]): StoredSettings {
  const stored = Number(settings.version ?? FIRST)
  const current = currentVersion(migrations)
  if (!(stored <= current)) throw new RangeError(`version ${String(settings.version)} is newer than ${current}`)
  const steps = migrations.filter(({ version }) => version > stored)
  return steps.reduce((older, { version, up }) => ({ ...up(older), version }), settings)
}
