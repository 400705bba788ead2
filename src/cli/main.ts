#!/usr/bin/env node
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { exitCodes } from './exit-code'
import { runProgram } from './program'
import { processTerminal } from './terminal'

/** dist/src/cli is three folders below the package. */
function version(): string {
  const manifest: unknown = JSON.parse(readFileSync(join(__dirname, '../../../package.json'), 'utf8'))
  return typeof manifest === 'object' && manifest !== null && 'version' in manifest
    ? String(manifest.version)
    : 'unknown'
}

// `melsec-jw read ... | head` closes the pipe early: that is no failure.
process.stdout.on('error', (error: NodeJS.ErrnoException) => {
  if (error.code !== 'EPIPE') throw error
  process.exit(exitCodes.ok.code)
})

runProgram(process.argv.slice(2), version(), processTerminal()).then(
  (code) => {
    process.exitCode = code
  },
  (error: unknown) => {
    process.stderr.write(
      `Unexpected failure, please report it: ${error instanceof Error ? error.stack : String(error)}\n`,
    )
    process.exitCode = exitCodes.bug.code
  },
)
