// The bottling line on its page: what is shown and what is set. The tab of every PLC has the same form (plc-tab.mjs).
import * as widgets from './widgets.mjs'

const FILL_COLOUR = '#1f6fb2'
const SUPPLY_COLOUR = '#2a8c82'

/** @type {import('./plants.mjs').Process} */
export const bottlingLine = {
  name: 'bottling line',
  groups: { left: 'Filler', middle: 'Supply tank', states: 'Line', counts: 'Bottles', setpoints: 'Recipe' },
  alsoRead: [],
  // A Sharp JW tells its run state on a question of its own (E8H), and is started by releasing the stop (F8H).
  asked: ['runState'],
  texts: ({ title }) => ({
    WHAT: 'Memory',
    PROTOCOL: 'Computer link',
    HOW: 'TCP',
    START: 'release',
    START_BUTTON: 'RELEASE',
    START_TEXT: `Release the stop of the ${title}? Its program starts, and machines may move.`,
    STOP_TEXT: `Stop the ${title}? Its program ends, and all outputs go off.`,
  }),
  leds: [
    { name: 'running', title: 'Automatic', kind: 'state' },
    { name: 'alarm', title: 'Alarm', kind: 'alarm' },
    { name: 'conveyor', title: 'Conveyor', kind: 'state' },
    { name: 'bottlePresent', title: 'Bottle at filler', kind: 'state' },
    { name: 'fillValve', title: 'Filling valve', kind: 'state' },
    { name: 'rejecter', title: 'Rejecter', kind: 'warn' },
    { name: 'supplyPump', title: 'Supply pump', kind: 'state' },
  ],
  counts: { id: 'bottles', name: 'Bottles', file: 'bottles.vue' },
  gauges: (group) => [
    widgets.gauge(group('left'), {
      id: 'fill',
      name: 'Bottle under the filler',
      value: '$round(100 * payload.fillLevel / payload.bottleSize)',
      units: '%',
      gtype: 'gauge-tank',
      max: 100,
      segments: [{ from: 0, color: FILL_COLOUR }],
    }),
    widgets.text(group('left'), {
      id: 'fill-text',
      label: 'Content',
      value: "payload.fillLevel & ' of ' & payload.bottleSize & ' ml'",
    }),
    widgets.gauge(group('middle'), {
      id: 'supply',
      name: 'Supply tank',
      value: '$round(payload.supply, 1)',
      units: '%',
      gtype: 'gauge-34',
      max: 100,
      segments: [
        { from: 0, color: '#b3261e' },
        { from: 10, color: SUPPLY_COLOUR },
      ],
    }),
    widgets.text(group('middle'), {
      id: 'supply-text',
      label: 'Level',
      value: "$formatNumber(payload.supply, '0.0') & ' %'",
    }),
  ],
  trends: ['lastFill', 'supply'],
  charts: [
    { id: 'fill-trend', label: 'Last bottle [ml]', ymax: '', colour: FILL_COLOUR },
    { id: 'supply-trend', label: 'Supply tank [%]', ymax: 100, colour: SUPPLY_COLOUR },
  ],
  inputs: (group, input) => [
    widgets.slider(group('setpoints'), { id: 'bottle-size', step: 10, ...input('bottleSize', 'Content') }),
    widgets.slider(group('setpoints'), { id: 'conveyor-speed', step: 10, ...input('conveyorSpeed', 'Conveyor speed') }),
    widgets.numberInput(group('setpoints'), { id: 'tolerance', ...input('tolerance', 'Tolerance') }),
    widgets.numberInput(group('setpoints'), { id: 'settling-time', ...input('settlingTime', 'Settling time') }),
  ],
}
