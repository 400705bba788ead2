// Node-RED's own nodes with the settings they store.

/** A Function node that calls one of functions.mjs. @param names of the values it is about, where it wants some */
export function functionNode(run, { wires, names, ...node }) {
  const listed = names === undefined ? '' : `, [${names.map((name) => `'${name}'`).join(', ')}]`
  return {
    ...node,
    type: 'function',
    func: `${run.toString()}\n\nreturn ${run.name}(msg, context${listed})\n`,
    outputs: wires.length,
    timeout: 0,
    noerr: 0,
    initialize: '',
    finalize: '',
    libs: [],
    wires,
  }
}

/** @param every seconds */
export function inject({ every, payload, ...node }) {
  const props = payload === undefined ? [] : [{ p: 'payload', v: payload, vt: 'str' }]
  return { ...node, type: 'inject', props, repeat: String(every), crontab: '', once: true, onceDelay: '0.5', topic: '' }
}

/** @param scope ids of the nodes whose errors it catches */
export function catchNode(node) {
  return { ...node, type: 'catch', uncaught: false }
}

/** A Change node with one rule: the payload becomes what a JSONata expression says. */
export function setPayload(expression, node) {
  return {
    ...node,
    type: 'change',
    rules: [{ t: 'set', p: 'payload', pt: 'msg', to: expression, tot: 'jsonata' }],
    action: '',
    property: '',
    from: '',
    to: '',
    reg: false,
  }
}

/** A Trigger node that passes the last message on when no other has come for a while; each topic by itself. */
export function settled(ms, node) {
  return {
    ...node,
    type: 'trigger',
    op1: '',
    op1type: 'nul',
    op2: '',
    op2type: 'payl',
    duration: String(ms),
    units: 'ms',
    extend: true,
    overrideDelay: false,
    reset: '',
    bytopic: 'topic',
    topic: 'topic',
    outputs: 1,
  }
}
