// Loaded into a real Node-RED by the tests (settings.nodesDir): tells the process that started it what happens inside
// and does what that process asks. It watches through Node-RED's public hooks and events and changes nothing.
const { encode, decode } = require('./portable')

// A wire to this node makes a message visible; the hook below sees where it came from.
const SINK = 'probe-sink'

function tell(event, details) {
  if (process.connected) process.send({ event, ...encode(details) })
}

module.exports = function probe(RED) {
  RED.nodes.registerType(SINK, function Sink(config) {
    RED.nodes.createNode(this, config)
    this.on('input', (_message, _send, done) => done())
  })

  RED.hooks.add('onSend.probe', (sends) => {
    for (const { msg, source, destination } of sends) {
      if (RED.nodes.getNode(destination.id)?.type === SINK) {
        tell('sent', { id: source.id, port: source.port, message: msg })
      }
    }
  })
  RED.hooks.add('onComplete.probe', ({ node, msg, error }) => {
    if (node.node.type !== SINK) tell('completed', { id: node.id, message: msg, ...(error ? { error } : {}) })
  })
  RED.events.on('node-status', ({ id, status }) => tell('status', { id, status }))
  RED.events.on('flows:started', () => tell('started', {}))
  RED.events.on('flows:stopped', () => tell('stopped', {}))
  RED.events.on('runtime-event', ({ id, payload }) => {
    if (id === 'runtime-state' && payload?.error) tell('refused', { reason: payload })
  })
  RED.log.addHandler({
    emit: (_event, { level, msg, id, type }) => {
      if (level <= RED.log.WARN)
        tell('logged', { level: level === RED.log.WARN ? 'warn' : 'error', text: msg, id, type })
    },
  })
  // Node-RED calls its handlers as listeners of the event 'log'.
  const actions = {
    receive({ id, message }) {
      const node = RED.nodes.getNode(id)
      if (!node) throw new Error(`there is no running node ${id}`)
      node.receive(message)
    },
    resources() {
      globalThis.gc?.()
      const active = {}
      for (const kind of process.getActiveResourcesInfo()) active[kind] = (active[kind] ?? 0) + 1
      const emitters = [RED.events, process]
      const listeners = emitters.flatMap((from) => from.eventNames().map((name) => from.listenerCount(name)))
      return {
        active,
        listeners: listeners.reduce((sum, count) => sum + count, 0),
        heap: process.memoryUsage().heapUsed,
      }
    },
  }

  process.on('message', (request) => {
    if (request?.action === undefined) return
    const { action, number } = request
    try {
      tell('answer', { number, value: actions[action](decode(request.argument)) })
    } catch (error) {
      tell('answer', { number, error })
    }
  })
  // The test is gone, however it ended: leave nothing behind.
  process.on('disconnect', () => process.exit(1))
  tell('loaded', {})
}
