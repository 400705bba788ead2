// What the flow's Function nodes do. They are ordinary functions here; build.mjs puts their source into the nodes.

/**
 * Function node "State of the connection": everything the page's head shows, gathered from several messages.
 * First output: the head. Second: asks the PLC what it is after each new connection. Third: whether the page's inputs
 * and buttons can be operated.
 */
export function connectionState(msg, context) {
  const begin = { name: 'connecting', reason: '', model: '', roundTrip: null, cpu: '', hasValues: false }
  const state = context.get('state') ?? begin
  const wasConnected = state.name === 'connected'
  const cpuStates = ['RUN', '', 'STOP', 'PAUSE']
  // A Sharp JW tells on a question whether it runs; 'stoppedElsewhere': another unit has stopped it, too.
  const runStates = { running: 'RUN', stopped: 'STOP', stoppedElsewhere: 'STOP' }
  if (msg.status !== undefined) {
    // Status of the read node: green, yellow and red say how the connection is.
    const { fill } = msg.status
    state.name = fill === 'green' ? 'connected' : fill === 'yellow' ? 'connecting' : 'offline'
    if (state.name !== 'offline') state.reason = ''
  } else if (msg.error !== undefined) {
    // Caught from the nodes that ask by themselves: why there are no values.
    state.reason = msg.error.cause?.message ?? msg.error.message
  } else if (msg.payload?.command === 'identify') {
    const { model, memorySize } = msg.payload
    state.model = model ?? (memorySize?.kiloWords === undefined ? '' : `${memorySize.kiloWords} K words`)
  } else if (msg.payload?.command === 'selfTest') {
    state.roundTrip = msg.payload.roundTrip
  } else if (msg.payload?.command === 'runState') {
    state.cpu = runStates[msg.payload.state] ?? ''
  } else {
    // Values have been read. SD203 of a MELSEC PLC says in its lower four bits what the CPU does.
    state.name = 'connected'
    state.reason = ''
    state.hasValues = true
    if ('cpuState' in msg.payload) state.cpu = cpuStates[msg.payload.cpuState & 15] ?? ''
  }
  if (state.name !== 'connected') Object.assign(state, { roundTrip: null, cpu: '' })
  context.set('state', state)
  const identify = state.name === 'connected' && !wasConnected ? { payload: 'identify' } : null
  const enabled = state.name === 'connected'
  // Once when there is a connection, because inputs show what comes; again and again while there is none: after a deploy
  // the dashboard enables everything.
  const told = enabled && context.get('enabled') === true
  context.set('enabled', enabled)
  return [{ payload: { ...state } }, identify, told ? null : { enabled }]
}

/**
 * Function node "Trend": one point for each chart, which keeps every message for its history. What could not be read is a
 * point without a value: the line has a gap there.
 */
export function trend(msg, _context, names) {
  const values = msg.error === undefined ? msg.payload : {}
  return names.map((name) => ({ payload: { y: Number.isFinite(values[name]) ? values[name] : null } }))
}

/**
 * Function node "Set-points that changed": what the PLC holds goes to the inputs when it is news to them, so that a
 * value somebody is about to type is not overwritten every second.
 */
export function setPointsThatChanged(msg, context, names) {
  const shown = { ...context.get('shown') }
  if (msg.payload?.written !== undefined) {
    // A write has succeeded or failed: its inputs, and no other that somebody may be typing into, show the PLC's value.
    for (const name of msg.payload.written) delete shown[name]
    context.set('shown', shown)
    return null
  }
  if (msg.enabled !== undefined) {
    // With the value, because the dashboard keeps the last message for pages that are opened later.
    return names.map((name) => ({ enabled: msg.enabled, ...(name in shown ? { payload: shown[name] } : {}) }))
  }
  const outputs = names.map((name) => (msg.payload[name] === shown[name] ? null : { payload: msg.payload[name] }))
  context.set('shown', Object.fromEntries(names.map((name) => [name, msg.payload[name]])))
  return outputs
}

/** Function node "What went wrong": a caught error as a notification. */
export function whatWentWrong(msg) {
  const outcomes = {
    notSent: 'Nothing was sent.',
    refused: 'The PLC refused it.',
    unknown: 'Whether it was carried out is not known.',
  }
  const { message = msg.error.message, outcome } = msg.error.cause ?? {}
  const sentence = message.endsWith('.') ? message : `${message}.`
  return { payload: `${sentence} ${outcomes[outcome] ?? ''}`, ui_update: { color: '#b3261e' } }
}

/** Function node "Done": a remote control command that the PLC has carried out, as a notification. */
export function done(msg) {
  return { payload: `Remote ${msg.payload.command.toUpperCase()} is done.`, ui_update: { color: '#2e7d32' } }
}
