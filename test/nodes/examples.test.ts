/** Every example flow, deployed against the simulated tank, sends what test/matrix/expectations.json says. */
import { afterAll, beforeAll, expect, test } from '@jest/globals'
import {
  type JwSimulator,
  type LineSimulator,
  type PlcSimulator,
  startDemoBottling,
  startDemoPlant,
} from '../../src/entry/simulator'
import { connectedTo, type Expectation, isOfJw, isOnLine, isOurs, onDemandOf, take } from '../support/examples'
import { type FlowNode, type NodeRed, startNodeRed } from '../support/node-red'
import { filesBelow, readText } from '../support/syntax'
import { startPlc } from './flow'
import { startJw } from './jw-flow'
import { startLine } from './line-flow'

const expectations = JSON.parse(readText('test/matrix/expectations.json')) as Record<string, Expectation>
const files = filesBelow('examples', '.json').map((path) => path.replace(/^examples\//, ''))
const flows = files.map((file): [string, FlowNode[]] => [file, JSON.parse(readText(`examples/${file}`)) as FlowNode[]])

let red: NodeRed
let plc: PlcSimulator
let line: LineSimulator
let jw: JwSimulator

beforeAll(async () => {
  // What `--module` and `--label` of the expectations' `simulate` make.
  plc = await startPlc({
    extensions: { modules: [{ unit: 3, points: 4096, model: 'Q62DA' }] },
    labels: {
      'Line1.Speed': { type: 'REAL', value: 12.5 },
      'Line1.Ready': { type: 'BOOL', value: true },
      'Line1.Counts': { type: 'INT', dimensions: [5], value: [1, 2, 3] },
    },
  })
  startDemoPlant(plc)
  // As `--stations 1,2 --message-format 4 --plant`.
  line = await startLine()
  for (const station of line.stations.values()) startDemoPlant(station)
  // As `--family jw --plant`.
  jw = await startJw()
  startDemoBottling(jw)
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await plc.close()
  await line.close()
  await jw.close()
})

test('every example has expectations', () => {
  expect(Object.keys(expectations).sort()).toEqual([...files].sort())
})

test.each(flows)('%s explains itself, needs no other package, and has ids of its own', (file, flow) => {
  expect(flow.filter(({ type }) => type === 'comment').length).toBeGreaterThan(0)
  const core = ['tab', 'comment', 'inject', 'debug', 'catch', 'status', 'switch', 'change']
  expect(flow.filter((node) => !core.includes(node.type) && !isOurs(node))).toEqual([])
  const others = flows.filter(([other]) => other !== file).flatMap(([, nodes]) => nodes.map(({ id }) => id))
  expect(flow.filter(({ id }) => others.includes(id))).toEqual([])
})

test.each(flows)('%s works', async (file, flow) => {
  const expectation = expectations[file] ?? { steps: [] }
  const words = onDemandOf(expectation)
  red.forget()
  const { tcp } = isOnLine(flow) ? line : isOfJw(flow) ? jw : plc
  await red.deploy(connectedTo(flow, tcp?.port ?? 0, expectation.connection))
  const sending = words && setInterval(() => plc.sendOnDemand(words), 100)
  try {
    for (const step of expectation.steps) await take(red, step)
  } finally {
    clearInterval(sending)
  }
  expect(red.log.filter(({ level }) => level === 'error')).toEqual([])
  await red.deploy([])
})
