// Makes demo/flow.json: `node demo/flow/build.mjs` after a change here or in the demo plant's tags.
import { writeFileSync } from 'node:fs'
import { pathToFileURL } from 'node:url'
import { demoPlantTags } from '../../dist/src/index.js'
import { flowPath } from '../flow-file.mjs'
import { plcs } from '../plcs.mjs'
import { dashboard, lookTab } from './dashboard.mjs'
import { connection, plcTab } from './plc-tab.mjs'

/** The flow as Node-RED stores it. */
export function demoFlow() {
  const tabs = plcs.flatMap((plc) => plcTab(plc, demoPlantTags[plc.profile]))
  return [...tabs, ...lookTab(), ...plcs.map(connection), ...dashboard()]
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  writeFileSync(flowPath, `${JSON.stringify(demoFlow(), null, 2)}\n`)
}
