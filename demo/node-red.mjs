// Node-RED with the demo flow, in a process of its own. Started by `npm start`.
//
//   node demo/node-red.mjs <folder>     folder: where this and further instances keep their files
//
// The environment has the PLCs' ports (plcs.mjs). It is embedded rather than started by its own command, so that the
// port is held before Node-RED loads: two demos started together never fight for one.
import { createServer } from 'node:http'
import { createRequire } from 'node:module'
import { join, resolve } from 'node:path'
import { endWithParent, tell } from './child.mjs'
import { putFlow } from './flow-file.mjs'
import { listenNear } from './ports.mjs'
import { dashboardPath, prepareUserDir, settings } from './settings.mjs'

const USUAL_PORT = 1880

const RED = createRequire(import.meta.url)('node-red')
const server = createServer()

/** Nothing else can have this port, so nothing else has a folder of its number. */
function listen() {
  return listenNear(USUAL_PORT, 1, (port) => {
    return new Promise((done, failed) => {
      server.once('error', failed)
      server.listen({ host: '127.0.0.1', port, exclusive: true }, () => {
        server.off('error', failed)
        done(server.address().port)
      })
    })
  })
}

/** Node-RED 4 lets every page that is open in the same browser deploy flows; nobody has to log in here. */
function isFromElsewhere({ headers: { origin, host } }) {
  if (origin === undefined) return false
  return !URL.canParse(origin) || new URL(origin).host !== host
}

/** Settles when the flows run, or cannot: a node type is missing, or its module failed to load. */
function flowsStarted() {
  return new Promise((done, failed) => {
    RED.events.once('flows:started', done)
    RED.events.on('runtime-event', ({ payload }) => {
      if (payload?.error === undefined) return
      const what = payload.types ?? payload.modules?.map(({ module }) => module) ?? []
      failed(new Error(`Node-RED does not start the demo flow (${[payload.error, ...what].join(' ')}).`))
    })
  })
}

async function start(folder) {
  const port = await listen()
  const userDir = join(resolve(folder), `node-red-${port}`)
  prepareUserDir(userDir)
  const kept = putFlow(userDir)
  RED.init(server, settings(userDir))
  server.on('request', (request, response) => {
    if (isFromElsewhere(request)) response.writeHead(403).end()
    else RED.httpAdmin(request, response, () => RED.httpNode(request, response))
  })
  const started = flowsStarted()
  await RED.start()
  await started
  const editor = `http://127.0.0.1:${port}/`
  tell({ ready: { editor, dashboard: `${editor}${dashboardPath}/`, port, usualPort: USUAL_PORT, userDir, kept } })
}

endWithParent(async () => {
  await RED.stop()
})
start(process.argv[2] ?? '.demo').catch((error) => {
  console.error(error)
  process.exit(1)
})
