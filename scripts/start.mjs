// npm start: sets up, starts the simulated plant and Node-RED with the demo flow, and says where to look.
// Ctrl-C ends all of it. When one of the two processes ends by itself, the other is ended too: exit code 1.
//   npm start -- <folder>          keeps the files of the demo there instead of .demo
import { fork } from 'node:child_process'
import { once } from 'node:events'
import { join, relative, resolve } from 'node:path'
import { plcs } from '../demo/plcs.mjs'
import { main, root, SetupError, setup } from './setup.mjs'

/** Everything the demo writes; .demo is ignored by git. */
const folder = resolve(process.argv[2] ?? join(root, '.demo'))
const READY_TIME = 90_000
const ANSWER_TIME = 10_000
/** More than the children allow themselves, less than a person waits. */
const END_TIME = 8000

const children = []
let ending = false

/** Resolves at the first signal to end; later ones are ignored, because ending is bounded in time anyway. */
const askedToEnd = new Promise((resolve) => {
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP', 'SIGBREAK']) process.on(signal, resolve)
})

/**
 * Starts one of the demo's processes. `ready` resolves with what it says when it is; `gone` rejects when it ends
 * before it is asked to.
 */
function start(title, script, args, variables = {}) {
  const child = fork(join(root, 'demo', script), args, {
    cwd: root,
    env: { ...process.env, ...variables },
    stdio: ['ignore', 'inherit', 'inherit', 'ipc'],
    windowsHide: true,
  })
  children.push(child)
  const ended = once(child, 'exit')
  const gone = ended.then(([code, signal]) => {
    if (ending) return new Promise(() => {})
    throw new SetupError(`${title} has ended by itself (${signal ?? `exit code ${code}`}); the demo ends.`)
  })
  const ready = new Promise((resolve) => {
    child.on('message', (message) => {
      if (message?.ready !== undefined) resolve(message.ready)
    })
  })
  // Every wait below includes it; what is left over has been told already.
  gone.catch(() => {})
  return { title, gone, ready: within(READY_TIME, `${title} is not ready`, Promise.race([ready, gone])) }
}

async function within(ms, what, promise) {
  let timer
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new SetupError(`${what} after ${ms / 1000} s.`)), ms)
    // Waiting for nothing any more after Ctrl-C.
    timer.unref()
  })
  try {
    return await Promise.race([promise, late])
  } finally {
    clearTimeout(timer)
  }
}

/** The last to start ends first, so that the dashboard does not show a plant that has gone. */
async function endAll() {
  ending = true
  for (const child of children.toReversed()) {
    if (child.exitCode !== null || child.signalCode !== null) continue
    const ended = once(child, 'exit')
    if (child.connected) child.send('end', () => {})
    const late = setTimeout(() => child.kill('SIGKILL'), END_TIME)
    await ended
    clearTimeout(late)
  }
}

/** A page that answers with 200; an address nobody answers at is not printed. */
async function check(what, url) {
  const answer = await fetch(url, { signal: AbortSignal.timeout(ANSWER_TIME) }).catch((error) => error)
  if (answer.status === 200) return
  throw new SetupError(
    `${what} does not answer at ${url} (${answer.status ?? answer.cause?.message ?? answer.message}).`,
  )
}

/** Asks the PLC what it is, as the flow's connection does. */
async function identify({ family, title, profile, frame }, port) {
  const { createJwClient, createMelsecClient } = await import('../dist/src/index.js')
  const reached = { host: '127.0.0.1', port, timeout: ANSWER_TIME }
  const client = family === 'jw' ? createJwClient(reached) : createMelsecClient({ ...reached, profile, frame })
  try {
    // A Sharp JW does not tell its model, but what its program has room for.
    return family === 'jw' ? `${(await client.info()).memorySize.kiloWords} K words` : (await client.identify()).model
  } catch (error) {
    throw new SetupError(`The simulated ${title} does not answer: ${error.message}`)
  } finally {
    await client.close()
  }
}

function replaced(what, usual, actual) {
  return actual === usual ? [] : [`Port ${usual} is taken: ${what} has ${actual} instead.`]
}

async function run() {
  const plant = start('The simulated plant', 'plant.mjs', [])
  const ports = await plant.ready
  const models = await Promise.all(plcs.map((plc) => identify(plc, ports[plc.id].port)))
  const variables = Object.fromEntries(plcs.map(({ id, portVariable }) => [portVariable, String(ports[id].port)]))
  const nodeRed = start('Node-RED', 'node-red.mjs', [folder], variables)
  const red = await Promise.race([nodeRed.ready, plant.gone])
  await check('The editor', red.editor)
  await check('The dashboard', red.dashboard)
  console.log(announcement(red, ports, models).join('\n'))
  await Promise.race([plant.gone, nodeRed.gone])
}

function announcement(red, ports, models) {
  const simulated = plcs.map(({ id, title, protocol }, index) => {
    const { port, udpPort } = ports[id]
    const where = port === udpPort ? `127.0.0.1:${port} (TCP and UDP)` : `127.0.0.1:${port} (TCP), ${udpPort} (UDP)`
    return `  ${`${title}:`.padEnd(20)}${where}, ${protocol}, ${models[index]}`
  })
  return [
    '',
    ...plcs.flatMap(({ id, title, usualPort }) => replaced(`the simulated ${title}`, usualPort, ports[id].port)),
    ...replaced('Node-RED', red.usualPort, red.port),
    ...(red.kept ? [`The flow you changed is kept; remove ${relative('.', red.userDir)} for the original one.`] : []),
    'The demo runs. Simulated PLCs:',
    ...simulated,
    '',
    `  Dashboard:  ${red.dashboard}`,
    `  Editor:     ${red.editor}`,
    '',
    'Ctrl-C ends it.',
  ]
}

await main(async () => {
  await setup()
  try {
    await Promise.race([run(), askedToEnd])
  } finally {
    await endAll()
  }
  console.log('The demo has ended.')
})
