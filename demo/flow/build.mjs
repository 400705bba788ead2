// Makes demo/flow.json, after a change here or in the demo plant's tags.
//   node demo/flow/build.mjs            writes it
//   node demo/flow/build.mjs --check    exit code 1 when it is not what this would write
import { execFileSync } from 'node:child_process'
import { readFileSync, writeFileSync } from 'node:fs'
import { createRequire } from 'node:module'
import { isDeepStrictEqual } from 'node:util'
import { flowPath } from '../flow-file.mjs'
import { plcs } from '../plcs.mjs'
import { connection } from './connection.mjs'
import { dashboard, lookTab } from './dashboard.mjs'
import { plcTab } from './plc-tab.mjs'

/** The flow as Node-RED stores it. */
function demoFlow() {
  return [...plcs.flatMap(plcTab), ...lookTab(), ...plcs.map(connection), ...dashboard()]
}

function write(flow) {
  writeFileSync(flowPath, `${JSON.stringify(flow, null, 2)}\n`)
  // As every file here is, or the lint check fails.
  const biome = createRequire(import.meta.url).resolve('@biomejs/biome/bin/biome')
  execFileSync(process.execPath, [biome, 'format', '--write', flowPath], { stdio: 'inherit' })
}

const flow = demoFlow()
if (!process.argv.includes('--check')) write(flow)
else if (!isDeepStrictEqual(JSON.parse(readFileSync(flowPath, 'utf8')), JSON.parse(JSON.stringify(flow)))) {
  console.error('demo/flow.json is out of date: run node demo/flow/build.mjs')
  process.exitCode = 1
}
