// The simulated plant: PLCs with mixing tanks and a bottling line, in a process of its own. Started by `npm start`.
import {
  createJwSimulator,
  createPlcSimulator,
  startDemoBottling,
  startDemoPlant,
} from '../dist/src/entry/simulator.js'
import { endWithParent, tell } from './child.mjs'
import { plcs } from './plcs.mjs'
import { listenNear } from './ports.mjs'

/** The next port after a taken one: the PLCs stay together, 5007 to 5009, 5017 to 5019, … */
const STEP = 10

/** What simulates a PLC of each family, and what runs in it. */
const families = {
  melsec: { create: createPlcSimulator, startPlant: startDemoPlant },
  jw: { create: createJwSimulator, startPlant: startDemoBottling },
}

/** A PLC that listens, with its plant running. */
async function startPlc({ family, usualPort, simulator }) {
  const { create, startPlant } = families[family]
  return listenNear(usualPort, STEP, async (port) => {
    // TCP and UDP at the same number, as in the open settings of a PLC. Any port: the one TCP gets may be taken on UDP.
    const plc = create({ ...simulator, tcp: { port }, udp: port === 0 ? {} : { port } })
    await plc.listen()
    startPlant(plc)
    return plc
  })
}

const running = []
endWithParent(async () => {
  await Promise.all(running.map((plc) => plc.close()))
})

const ready = {}
for (const plc of plcs) {
  const started = await startPlc(plc)
  running.push(started)
  ready[plc.id] = { port: started.tcp.port, udpPort: started.udp.port }
}
tell({ ready })
