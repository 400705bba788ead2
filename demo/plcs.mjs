// The PLCs of the demo: what is simulated, and how the demo flow reaches it. The one place that says it.

/**
 * @typedef {object} DemoPlc
 * @property {'iqr' | 'fx5' | 'jw'} id begins the ids of its nodes
 * @property {'melsec' | 'jw'} family
 * @property {string} title
 * @property {string} page name of its page
 * @property {string} protocol that the simulator speaks
 * @property {'iq-r' | 'iq-f'} [profile] of a MELSEC PLC
 * @property {'3E' | '4E'} [frame] the flow's, of a MELSEC PLC
 * @property {number} usualPort
 * @property {string} portVariable environment variable that tells the flow the port
 * @property {object} simulator options of createPlcSimulator or createJwSimulator
 */

/** @type {readonly DemoPlc[]} */
export const plcs = [
  {
    id: 'iqr',
    family: 'melsec',
    profile: 'iq-r',
    title: 'MELSEC iQ-R',
    page: 'Mixing tank 1',
    protocol: 'SLMP 4E and 3E',
    frame: '4E',
    usualPort: 5007,
    portVariable: 'MELSEC_JW_DEMO_IQR_PORT',
    simulator: { profile: 'iq-r', frames: ['4E', '3E'] },
  },
  {
    id: 'fx5',
    family: 'melsec',
    profile: 'iq-f',
    title: 'MELSEC iQ-F FX5U',
    page: 'Mixing tank 2',
    protocol: 'SLMP 3E',
    frame: '3E',
    usualPort: 5008,
    portVariable: 'MELSEC_JW_DEMO_FX5_PORT',
    simulator: { profile: 'iq-f', frames: ['3E'] },
  },
  {
    id: 'jw',
    family: 'jw',
    title: 'Sharp JW300',
    page: 'Bottling line',
    protocol: 'computer link',
    usualPort: 5009,
    portVariable: 'MELSEC_JW_DEMO_JW_PORT',
    // Write mode 1: data memory may be written. Without it a Sharp JW refuses what the dashboard sets.
    simulator: { model: 'jw300', writeMode: 1 },
  },
]
