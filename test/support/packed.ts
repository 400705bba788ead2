// The package as a user gets it: packed, and installed into an empty project.
import { execFile } from 'node:child_process'
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { promisify } from 'node:util'
import { root } from './root'

const run = promisify(execFile)

async function npm(args: readonly string[], cwd: string): Promise<string> {
  const { stdout } = await run('npm', [...args, '--no-audit', '--no-fund', '--loglevel=error'], { cwd })
  return stdout
}

export interface PackedProject {
  readonly project: string
  remove(): void
}

export async function packedProject(): Promise<PackedProject> {
  const folder = mkdtempSync(join(tmpdir(), 'melsec-jw-packed-'))
  const project = join(folder, 'project')
  const packed = await npm(['pack', '--ignore-scripts', '--json', '--pack-destination', folder], root)
  const [{ filename }] = JSON.parse(packed) as [{ filename: string }]
  mkdirSync(project)
  writeFileSync(join(project, 'package.json'), JSON.stringify({ name: 'user', private: true }))
  await npm(['install', join(folder, filename)], project)
  return { project, remove: () => rmSync(folder, { recursive: true, force: true }) }
}
