// The simulated plant: two PLCs, each with a mixing tank, in a process of its own. Started by `npm start`.
import { createPlcSimulator, startDemoPlant } from '../dist/src/entry/simulator.js'
import { endWithParent, tell } from './child.mjs'
import { plcs } from './plcs.mjs'
import { listenNear } from './ports.mjs'

/** The next port after a taken one: the two PLCs stay a pair, 5007 and 5008, 5017 and 5018, … */
const STEP = 10

/** A PLC that listens, with its plant running. */
async function startPlc({ usualPort, simulator }) {
  return listenNear(usualPort, STEP, async (port) => {
    // TCP and UDP at the same number, as in the open settings of a PLC. Any port: the one TCP gets may be taken on UDP.
    const plc = createPlcSimulator({ ...simulator, tcp: { port }, udp: port === 0 ? {} : { port } })
    await plc.listen()
    startDemoPlant(plc)
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
