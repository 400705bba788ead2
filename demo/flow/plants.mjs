// What runs in the PLCs of the demo, and what the flow knows of it.
import { demoBottlingTags, demoPlantTags } from '../../dist/src/entry/simulator.js'
import { bottlingLine } from './bottling-line.mjs'
import { mixingTank } from './mixing-tank.mjs'

/**
 * @typedef {object} Process what one kind of plant shows and sets
 * @property {string} name
 * @property {Record<string, string>} groups titles of the page's groups that differ
 * @property {readonly object[]} alsoRead rows of the read node besides the tags
 * @property {readonly string[]} asked commands of the control node that ask every second
 * @property {(plc: object) => Record<string, string>} texts that its PLC fills into the components
 * @property {readonly object[]} leds
 * @property {{ id: string, name: string, file: string }} counts component of that group
 * @property {(group: Function) => object[]} gauges with their texts
 * @property {readonly string[]} trends tags of the charts
 * @property {readonly object[]} charts
 * @property {(group: Function, input: Function) => object[]} inputs set-points, in order; `input` gives what a
 *   tag says, under another title if one is given
 */

/** What runs in the PLCs of a family, and its tags. */
const families = {
  melsec: ({ profile }) => ({ process: mixingTank, tags: demoPlantTags[profile] }),
  jw: () => ({ process: bottlingLine, tags: demoBottlingTags }),
}

/** @returns {{ process: Process, tags: readonly object[] }} */
export const plantOf = (plc) => families[plc.family](plc)
