// The editor tab of one PLC: what is polled and shown, what is written, and how the connection is.
import { tab } from './canvas.mjs'
import { connectionId } from './connection.mjs'
import { catchNode, functionNode, inject, setPayload, settled } from './core.mjs'
import { groupId, text, ui } from './dashboard.mjs'
import { connectionState, done, setPointsThatChanged, trend, whatWentWrong } from './functions.mjs'
import { plantOf } from './plants.mjs'
import * as widgets from './widgets.mjs'

/** Every node of a PLC's tab. */
export function plcTab(plc) {
  const { process, tags } = plantOf(plc)
  const canvas = tab(plc.id, plc.title, info(plc))
  const part = {
    canvas,
    process,
    tags,
    group: (name) => groupId(plc, name),
    uses: { connection: connectionId(plc), version: 1 },
    filled: (file) => filledIn(text(file), process.texts(plc)).replace("'__LEDS__'", JSON.stringify(process.leds)),
  }
  poll(part)
  state(part)
  remote(part)
  operate(part)
  failures(part)
  return canvas.nodes
}

/** A component with `__NAME__` replaced. */
function filledIn(component, texts) {
  return component.replaceAll(/__([A-Z_]+)__/g, (whole, name) => texts[name] ?? whole)
}

function info({ title, portVariable }) {
  return [
    `# ${title}`,
    '',
    'Reads the simulated PLC every second, shows it on the dashboard, and writes what is operated there.',
    '',
    `The port comes from the environment (\`${portVariable}\`), because it may differ from start to start.`,
    '',
    'For a real PLC open the connection, give its address, and look at the addresses in the read node.',
  ].join('\n')
}

/** Rows of a read or write node: address and type apart, as the editor shows them. */
function rows(tags) {
  return tags.map(({ name, address }) => {
    const [device, type] = address.split(':')
    return { name, address: device, type }
  })
}

function poll({ canvas, process, tags, group, uses, filled }) {
  const column = 390
  const charts = process.charts.map((chart, index) => widgets.chart(group('trend'), { order: index + 1, ...chart }))
  const { file, ...counts } = process.counts
  const shown = [
    ...process.gauges(group),
    functionNode(trend, { id: 'trend', name: 'Trend', names: process.trends, wires: charts.map(({ id }) => [id]) }),
    widgets.template(group('states'), { id: 'states', name: 'States', format: filled('states.vue') }),
    widgets.template(group('counts'), { ...counts, format: filled(file) }),
    canvas.linkOut({ id: 'values-out', name: 'values', to: ['values-to-setpoints', 'values-to-state'] }),
  ]
  canvas.frame('poll', 'Read every second, and show', { x: 20, y: 20, width: 780, rows: shown.length }, [
    inject({ id: 'every-second', column: 0, row: 4, name: 'every second', every: 1, wires: [['read']] }),
    {
      id: 'read',
      column: 190,
      row: 4,
      type: 'melsec-jw-read',
      name: process.name,
      ...uses,
      addressesType: 'rows',
      addresses: '',
      items: [...rows(tags), ...process.alsoRead],
      output: 'object',
      property: 'payload',
      quality: false,
      partial: 'error',
      wires: [shown.map(({ id }) => id)],
    },
    ...shown.map((node, row) => ({ ...node, column, row })),
    catchNode({
      id: 'not-read',
      column: 0,
      row: 5,
      name: 'not read: a gap',
      scope: [canvas.name('read')],
      wires: [['trend']],
    }),
    ...charts.map((node, index) => ({ ...node, column: column + 170, row: index + 3.5 })),
  ])
}

function control({ uses, ...node }) {
  return {
    ...node,
    type: 'melsec-jw-control',
    ...uses,
    command: 'payload',
    commandType: 'msg',
    clear: 'keep',
    force: false,
  }
}

function state({ canvas, process, group, uses, filled }) {
  const known = [['connection-state']]
  canvas.frame('state', 'Connection and round trip', { x: 840, y: 20, width: 680, rows: 5 }, [
    inject({
      id: 'every-two',
      column: 0,
      row: 0,
      name: 'every 2 seconds',
      every: 2,
      payload: 'selfTest',
      wires: [['ask']],
    }),
    ...process.asked.map((payload) =>
      inject({ id: payload, column: 90, row: 1, name: payload, every: 1, payload, wires: [['ask']] }),
    ),
    canvas.linkIn({ id: 'identify-in', column: 0, row: 1, name: 'identify', from: ['identify-out'], wires: [['ask']] }),
    control({ id: 'ask', column: 230, row: 0, name: 'self test, identify', uses, wires: known }),
    {
      id: 'status',
      column: 0,
      row: 2,
      type: 'status',
      name: 'status of the read node',
      scope: [canvas.name('read')],
      wires: known,
    },
    catchNode({
      id: 'silent',
      column: 0,
      row: 3,
      name: 'why there are no values',
      scope: ['read', 'ask'].map(canvas.name),
      wires: known,
    }),
    canvas.linkIn({ id: 'values-to-state', column: 0, row: 4, name: 'values', from: ['values-out'], wires: known }),
    functionNode(connectionState, {
      id: 'connection-state',
      column: 240,
      row: 3,
      name: 'State of the connection',
      wires: [['head', 'state-out'], ['identify-out'], ['enabled-out']],
    }),
    {
      ...widgets.template(group('head'), { id: 'head', name: 'Head of the page', format: filled('head.vue') }),
      ...widgets.size(12, 1),
      column: 490,
      row: 2,
    },
    canvas.linkOut({ id: 'identify-out', column: 490, row: 3, name: 'identify', to: ['identify-in'] }),
    canvas.linkOut({
      id: 'enabled-out',
      column: 490,
      row: 4,
      name: 'on or off line',
      to: ['enabled-to-controls'],
    }),
    canvas.linkOut({ id: 'state-out', column: 490, row: 1, name: 'state', to: ['state-to-cpu'] }),
  ])
}

function remote({ canvas, group, uses, filled }) {
  canvas.frame('remote-frame', 'Remote RUN / STOP, after a question', { x: 840, y: 350, width: 680, rows: 1 }, [
    canvas.linkIn({ id: 'state-to-cpu', column: 0, row: 0, name: 'state', from: ['state-out'], wires: [['cpu']] }),
    {
      ...widgets.template(group('operate'), { id: 'cpu', name: 'CPU RUN / STOP', format: filled('cpu.vue'), order: 4 }),
      ...widgets.size(3, 3),
      // Its last message is the one that says how the connection is.
      storeOutMessages: false,
      column: 50,
      row: 0,
      wires: [['remote']],
    },
    control({ id: 'remote', column: 190, row: 0, name: 'remote control', uses, wires: [['done']] }),
    functionNode(done, { id: 'done', column: 360, row: 0, name: 'Done', wires: [['done-message']] }),
    widgets.notification(ui, { id: 'done-message', column: 490, row: 0, name: 'carried out' }),
  ])
}

function operate({ canvas, process, tags, group, uses }) {
  const input = (name, title) => {
    const tag = tags.find((candidate) => candidate.name === name)
    const { unit, min, max } = tag
    return { label: `${title ?? tag.title} [${unit}]`, topic: name, min, max }
  }
  const inputs = process.inputs(group, input).map((node, index) => ({ ...node, order: index + 1 }))
  const buttons = [
    widgets.button(group('operate'), {
      id: 'start',
      order: 1,
      label: 'Start',
      topic: 'start',
      icon: 'play',
      colour: '#2e7d32',
    }),
    widgets.button(group('operate'), {
      id: 'stop',
      order: 2,
      label: 'Stop',
      topic: 'stop',
      icon: 'stop',
      colour: '#5f6b77',
    }),
    widgets.button(group('operate'), {
      id: 'acknowledge',
      order: 3,
      label: 'Acknowledge alarm',
      topic: 'acknowledge',
      icon: 'bell-check',
      colour: '#b07d00',
    }),
  ]
  canvas.frame('operate', 'Write what is set or pressed', { x: 20, y: 630, width: 1290, rows: 7 }, [
    canvas.linkIn({
      id: 'values-to-setpoints',
      column: 0,
      row: 1,
      name: 'values',
      from: ['values-out'],
      wires: [['setpoints']],
    }),
    canvas.linkIn({
      id: 'again-in',
      column: 0,
      row: 2,
      name: 'show again',
      from: ['again-out', 'failed-again-out'],
      wires: [['again']],
    }),
    canvas.linkIn({
      id: 'enabled-to-controls',
      column: 0,
      row: 0,
      name: 'on or off line',
      from: ['enabled-out'],
      wires: [['setpoints', ...buttons.map(({ id }) => id)]],
    }),
    setPayload('{ "written": [$keys(payload)] }', {
      id: 'again',
      column: 70,
      row: 2,
      name: 'show again',
      wires: [['setpoints']],
    }),
    functionNode(setPointsThatChanged, {
      id: 'setpoints',
      column: 230,
      row: 1,
      name: 'Set-points that changed',
      names: inputs.map(({ topic }) => topic),
      wires: inputs.map(({ id }) => [id]),
    }),
    ...[...inputs, ...buttons].map((node, row) => {
      const to = node.type === 'ui-slider' ? 'settled' : 'by-name'
      return { ...node, column: 480, row, wires: [[to]] }
    }),
    settled(400, { id: 'settled', column: 730, row: 1, name: 'stands still', wires: [['by-name']] }),
    setPayload('{ topic: payload }', { id: 'by-name', column: 890, row: 3, name: 'value by name', wires: [['write']] }),
    {
      id: 'write',
      column: 1060,
      row: 3,
      type: 'melsec-jw-write',
      name: process.name,
      ...uses,
      values: 'payload',
      valuesType: 'msg',
      items: rows(tags.filter(({ writable }) => writable)).map((row) => ({
        ...row,
        value: 'payload',
        valueType: 'msg',
      })),
      readBack: false,
      readModifyWrite: false,
      wires: [['again-out']],
    },
    canvas.linkOut({ id: 'again-out', column: 1220, row: 3, name: 'show again', to: ['again-in'] }),
  ])
}

function failures({ canvas }) {
  canvas.frame('failures', 'What was operated and has failed', { x: 840, y: 470, width: 680, rows: 2 }, [
    catchNode({
      id: 'failed',
      column: 0,
      row: 0,
      name: 'write, remote control',
      scope: ['write', 'remote'].map(canvas.name),
      wires: [['wrong', 'failed-again-out']],
    }),
    functionNode(whatWentWrong, {
      id: 'wrong',
      column: 240,
      row: 0,
      name: 'What went wrong',
      wires: [['failed-message']],
    }),
    widgets.notification(ui, { id: 'failed-message', column: 490, row: 0, name: 'failed' }),
    canvas.linkOut({ id: 'failed-again-out', column: 240, row: 1, name: 'show again', to: ['again-in'] }),
  ])
}
