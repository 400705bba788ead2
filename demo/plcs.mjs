// The two PLCs of the demo: what is simulated, and how the demo flow reaches it. The one place that says it.

/**
 * @typedef {object} DemoPlc
 * @property {'iqr' | 'fx5'} id begins the ids of its nodes
 * @property {'iq-r' | 'iq-f'} profile
 * @property {string} title
 * @property {'3E' | '4E'} frame the flow's
 * @property {number} usualPort
 * @property {string} portVariable environment variable that tells the flow the port
 * @property {object} simulator options of createPlcSimulator
 */

/** @type {readonly DemoPlc[]} */
export const plcs = [
  {
    id: 'iqr',
    profile: 'iq-r',
    title: 'MELSEC iQ-R',
    frame: '4E',
    usualPort: 5007,
    portVariable: 'MELSEC_JW_DEMO_IQR_PORT',
    simulator: { profile: 'iq-r', frames: ['4E', '3E'] },
  },
  {
    id: 'fx5',
    profile: 'iq-f',
    title: 'MELSEC iQ-F FX5U',
    frame: '3E',
    usualPort: 5008,
    portVariable: 'MELSEC_JW_DEMO_FX5_PORT',
    simulator: { profile: 'iq-f', frames: ['3E'] },
  },
]
