import { declare, field } from '../../codec/codec'
import { labelArea, labelData, labelName, writtenLabelArea } from '../label/codec'

const { countOf, echo, fixed, list, u16, u8, value } = field
const manual = 'SLMP reference manual 5.3'

const name = value(labelName, 'as spelt, %1 to %n for the abbreviations')
const abbreviationPoints = countOf('abbreviations', 2)
const abbreviations = list('abbreviationPoints', { name: value(labelName) }, 'what %1, %2 ... stand for')
const typeId = u8({ doc: 'data type ID' })

/** Access to global labels by name: SLMP reference manual 5.3. Only iQ-R has them. */
export const labelCommands = declare({
  readArrayLabels: {
    title: 'Array Label Read',
    code: 0x041a,
    unit: 'none',
    effect: 'read',
    manual,
    request: {
      arrayPoints: countOf('arrays', 2, { min: 1 }),
      abbreviationPoints,
      abbreviations,
      arrays: list('arrayPoints', {
        name,
        unit: u8({ max: 1, doc: '0: length in bits; 1: length in bytes' }),
        fixed: fixed(0, 1),
        length: u16({ min: 1, doc: 'of the data to be read' }),
      }),
    },
    response: { arrayPoints: echo('arrayPoints'), arrays: list('arrays', { typeId, area: value(labelArea) }) },
  },
  writeArrayLabels: {
    title: 'Array Label Write',
    code: 0x141a,
    unit: 'none',
    effect: 'write',
    manual,
    request: {
      arrayPoints: countOf('arrays', 2, { min: 1 }),
      abbreviationPoints,
      abbreviations,
      arrays: list('arrayPoints', { name, area: value(writtenLabelArea) }),
    },
    response: {},
  },
  readRandomLabels: {
    title: 'Label Read Random',
    code: 0x041c,
    unit: 'none',
    effect: 'read',
    manual,
    request: {
      points: countOf('labels', 2, { min: 1 }),
      abbreviationPoints,
      abbreviations,
      labels: list('points', { name }),
    },
    response: {
      points: echo('points'),
      labels: list('labels', {
        typeId,
        spare: u8({ default: 0, doc: 'undefined' }),
        data: value(labelData),
      }),
    },
  },
  writeRandomLabels: {
    title: 'Label Write Random',
    code: 0x141b,
    unit: 'none',
    effect: 'write',
    manual,
    request: {
      points: countOf('labels', 2, { min: 1 }),
      abbreviationPoints,
      abbreviations,
      labels: list('points', { name, data: value(labelData) }),
    },
    response: {},
  },
})
