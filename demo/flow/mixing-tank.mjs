// A mixing tank on its page: what is shown and what is set. The tab of every PLC has the same form (plc-tab.mjs).
import * as widgets from './widgets.mjs'

const LEVEL_COLOUR = '#1f6fb2'
const HEAT_COLOUR = '#d9660a'

/** @type {import('./plants.mjs').Process} */
export const mixingTank = {
  name: 'mixing tank',
  groups: { left: 'Level', middle: 'Temperature', states: 'Plant', counts: 'Batch', setpoints: 'Set-points' },
  // SD203 says what the CPU does.
  alsoRead: [{ name: 'cpuState', address: 'SD203', type: 'WORD' }],
  asked: [],
  texts: ({ title, frame }) => ({
    WHAT: 'CPU',
    PROTOCOL: 'SLMP',
    HOW: `${frame} binary, TCP`,
    START: 'run',
    START_BUTTON: 'RUN',
    START_TEXT: `Set the CPU of the ${title} to RUN? Its program starts, and machines may move.`,
    STOP_TEXT: `Set the CPU of the ${title} to STOP? Its program ends, and all outputs go off.`,
  }),
  leds: [
    { name: 'running', title: 'Automatic', kind: 'state' },
    { name: 'alarm', title: 'Alarm', kind: 'alarm' },
    { name: 'inlet', title: 'Inlet valve', kind: 'state' },
    { name: 'outlet', title: 'Outlet valve', kind: 'state' },
    { name: 'agitator', title: 'Agitator', kind: 'state' },
    { name: 'heater', title: 'Heater', kind: 'heat' },
    { name: 'lowLevel', title: 'Not empty', kind: 'state' },
    { name: 'highLevel', title: 'Full', kind: 'warn' },
  ],
  counts: { id: 'batch', name: 'Batch', file: 'batch.vue' },
  gauges: (group) => [
    widgets.gauge(group('left'), {
      id: 'level',
      name: 'Level',
      value: 'payload.level',
      units: 'l',
      gtype: 'gauge-tank',
      max: 1000,
      segments: [{ from: 0, color: LEVEL_COLOUR }],
    }),
    widgets.text(group('left'), {
      id: 'level-text',
      label: 'Level',
      value: "$formatNumber(payload.level, '0') & ' l'",
    }),
    widgets.gauge(group('middle'), {
      id: 'temperature',
      name: 'Temperature',
      value: '$round(payload.temperature, 1)',
      units: '°C',
      gtype: 'gauge-34',
      max: 100,
      segments: [
        { from: 0, color: '#5b8fb9' },
        { from: 30, color: HEAT_COLOUR },
        { from: 85, color: '#b3261e' },
      ],
    }),
    widgets.text(group('middle'), {
      id: 'temperature-text',
      label: 'Set-point',
      value: "$formatNumber(payload.temperatureSetPoint, '0.0') & ' °C'",
    }),
  ],
  trends: ['level', 'temperature'],
  charts: [
    { id: 'level-trend', label: 'Level [l]', ymax: 1000, colour: LEVEL_COLOUR },
    { id: 'temperature-trend', label: 'Temperature [°C]', ymax: 100, colour: HEAT_COLOUR },
  ],
  inputs: (group, input) => [
    widgets.slider(group('setpoints'), { id: 'level-setpoint', step: 10, ...input('levelSetPoint') }),
    widgets.slider(group('setpoints'), { id: 'temperature-setpoint', step: 1, ...input('temperatureSetPoint') }),
    widgets.numberInput(group('setpoints'), { id: 'mixing-time', ...input('mixingTime') }),
    widgets.dropdown(group('setpoints'), {
      id: 'recipe',
      label: 'Next product',
      topic: 'recipe',
      options: [
        [1, 'Apple juice'],
        [2, 'Green tea'],
        [3, 'Oolong tea'],
      ],
    }),
  ],
}
