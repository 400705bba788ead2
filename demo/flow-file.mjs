// Puts the demo flow where Node-RED reads it, and leaves alone what the user made of it.
import { createHash } from 'node:crypto'
import { existsSync, readFileSync, writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'

/** The demo flow, importable in any Node-RED that has the dashboard and this package. */
export const flowPath = join(dirname(fileURLToPath(import.meta.url)), 'flow.json')

/**
 * Writes flows.json, unless it is there and was changed since the demo wrote it.
 * @returns whether a changed flow was kept
 */
export function putFlow(userDir) {
  const target = join(userDir, 'flows.json')
  const stamp = join(userDir, 'demo-flow.sha256')
  const ours = existsSync(stamp) ? readFileSync(stamp, 'utf8').trim() : ''
  if (existsSync(target) && hashOf(readFileSync(target)) !== ours) return true
  const flow = readFileSync(flowPath)
  writeFileSync(target, flow)
  writeFileSync(stamp, `${hashOf(flow)}\n`)
  return false
}

function hashOf(bytes) {
  return createHash('sha256').update(bytes).digest('hex')
}
