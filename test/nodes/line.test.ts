/** The line node: one port or device server, shared by the connections to the stations on it. */
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import type { LineSimulator } from '../../src/entry/simulator'
import { type NodeRed, startNodeRed } from '../support/node-red'
import { type TtyPair, ttyPair } from '../support/tty-pair'
import { catchNode } from './flow'
import { lineNode, lineTo, readOf, startLine, stationNode } from './line-flow'

let red: NodeRed
let line: LineSimulator

beforeAll(async () => {
  line = await startLine()
  red = await startNodeRed()
}, 60_000)

afterAll(async () => {
  await red.stop()
  await line.close()
})

afterEach(async () => {
  line.faults.clear()
  await red.deploy([])
  red.forget()
})

const stations = [stationNode(1), stationNode(2)]
const reads = [readOf(1), readOf(2)]

async function value(station: number): Promise<unknown> {
  await red.receive(`read${station}`, {})
  const { payload } = await red.next(`read${station}`)
  expect(await red.completed(`read${station}`)).not.toHaveProperty('error')
  return payload
}

/** Resolves when the simulated line has as many hosts. */
function hosts(count: number): Promise<void> {
  return new Promise((resolve) => {
    const look = (): void => {
      if (line.hosts.length !== count) return
      ended()
      resolve()
    }
    const ended = line.on('host', look)
    look()
  })
}

describe('a line', () => {
  test('is opened once for both of its stations, and closed with the last', async () => {
    await red.deploy([lineTo(line), ...stations])
    expect(line.hosts).toHaveLength(0)
    await red.deploy([lineTo(line), ...stations, ...reads], 'nodes')
    for (const station of [1, 2]) {
      await red.status(`read${station}`, { fill: 'green', text: 'connected' })
      expect(await value(station)).toBe(station)
    }
    expect(line.hosts).toHaveLength(1)
    await red.deploy([lineTo(line), ...stations, readOf(2)], 'nodes')
    expect(await value(2)).toBe(2)
    expect(line.hosts).toHaveLength(1)
    await red.deploy([lineTo(line), ...stations], 'nodes')
    await hosts(0)
    expect(red.log.filter(({ level }) => level === 'error')).toEqual([])
  })

  test('stays open for the others when one connection is deployed anew', async () => {
    const opened: number[] = []
    const ended = line.on('host', ({ change, host }) => {
      if (change === 'opened') opened.push(host.id)
    })
    await red.deploy([lineTo(line), ...stations, ...reads])
    expect([await value(1), await value(2)]).toEqual([1, 2])
    red.forget()
    await red.deploy([lineTo(line), stationNode(1, { timeout: '2500' }), stationNode(2), ...reads], 'nodes')
    expect([await value(1), await value(2)]).toEqual([1, 2])
    expect(opened).toHaveLength(1)
    expect(red.statuses('read2')).toEqual([])
    ended()
  })

  test('that is deployed anew is opened anew, for all of them', async () => {
    const other = await startLine({ messageFormat: 1 })
    other.station(1).write('D100', 11)
    other.station(2).write('D100', 12)
    await red.deploy([lineTo(line), ...stations, ...reads])
    expect([await value(1), await value(2)]).toEqual([1, 2])
    await red.deploy([lineTo(other, { messageFormat: '1' }), ...stations, ...reads], 'nodes')
    expect([await value(1), await value(2)]).toEqual([11, 12])
    await hosts(0)
    expect(other.hosts).toHaveLength(1)
    await red.deploy([])
    await other.close()
  })

  test('a remote password that another way had is not sent to a CPU that has none', async () => {
    await red.deploy([lineTo(line), stationNode(1, { credentials: { password: 'Secret-1' } }), readOf(1)])
    expect(await value(1)).toBe(1)
  })

  test('a station that is silent does not stop the other', async () => {
    await red.deploy([lineTo(line), stationNode(1), stationNode(9, { timeout: '300' }), readOf(1), readOf(9)])
    await red.status('read9', { fill: 'red', text: 'PLC is silent' })
    expect(await value(1)).toBe(1)
  })

  test('speaks 4C format 5, and 1C with the series that has it', async () => {
    const binary = await startLine({ messageFormat: 5 })
    await red.deploy([
      lineTo(binary, { frame: '4C', messageFormat: '5', dataLength: '8' }),
      stationNode(1, { asciiXy: '' }),
      readOf(1),
    ])
    expect(await value(1)).toBe(1)
    await red.deploy([
      lineTo(line, { frame: '1C' }),
      stationNode(2, { profile: 'fx3-serial', asciiXy: '', messageWait: '10' }),
      readOf(2),
    ])
    expect(await value(2)).toBe(2)
    await red.deploy([])
    await binary.close()
  })
})

describe('a serial port', () => {
  let pair: TtyPair
  let far: LineSimulator

  beforeAll(async () => {
    pair = await ttyPair()
    far = await startLine({ serial: { path: pair.far, baudRate: 115_200 }, tcp: false })
  })

  afterAll(async () => {
    await far.close()
    await pair.close()
  })

  const port = (more: object = {}) => lineNode({ path: pair.near, ...more })

  test('carries two connections; deploys of every kind leave none behind and find it free', async () => {
    await red.deploy([port(), ...stations, ...reads])
    expect([await value(1), await value(2)]).toEqual([1, 2])
    red.forget()
    for (let round = 0; round < 12; round++) {
      const changed = [
        port({ quiet: String(90 + (round % 3)) }),
        stationNode(1, { timeout: String(2000 + round) }),
        stationNode(2),
        ...reads,
      ]
      await red.deploy(changed, (['full', 'flows', 'nodes'] as const)[round % 3])
      expect([await value(1), await value(2)]).toEqual([1, 2])
    }
    expect(red.log.filter(({ level }) => level !== 'warn' || level)).toEqual([])
    await red.deploy([])
    // Free again: another program can have it.
    const other = await startLine({ serial: { path: pair.near, baudRate: 115_200 }, tcp: false })
    await other.close()
  }, 60_000)

  test('its name may stand in the environment of the flow', async () => {
    const env = [{ name: 'PORT', value: pair.near, type: 'str' }]
    const tab = { id: 'tab', type: 'tab', label: 'Line', env }
    const inTab = [lineNode({ path: ['$', '{PORT}'].join('') }), stationNode(1), readOf(1)]
    await red.deploy([tab, ...inTab.map((node) => ({ ...node, z: 'tab' }))])
    expect(await value(1)).toBe(1)
  })

  test('that is not there is told with its name, and does not fill the log', async () => {
    await red.deploy([lineNode({ path: '/dev/tty-none' }), stationNode(1), readOf(1), catchNode()])
    await red.status('read1', { fill: 'red', text: 'port unavailable' })
    await red.receive('read1', {})
    const { error } = (await red.next('catch')) as unknown as { error: { message: string } }
    expect(error.message).toContain('/dev/tty-none')
    expect(red.log.filter(({ level }) => level === 'warn')).toHaveLength(1)
  })
})

describe('wrong settings', () => {
  test.each([
    ['no port', lineNode({ path: '' }), stationNode(1), 'Serial port is missing in the serial line'],
    ['a speed that is none', lineNode({ path: 'COM9', baudRate: '9601' }), stationNode(1), 'Baud rate is "9601"'],
    [
      '7 bits in format 5',
      lineNode({ path: 'COM9', frame: '4C', messageFormat: '5', dataLength: '7' }),
      stationNode(1),
      'needs? 8 bits',
    ],
    ['a format the frame lacks', lineNode({ path: 'COM9', messageFormat: '5' }), stationNode(1), 'formats 1, 4'],
    ['no line', lineNode({ path: 'COM9' }), stationNode(1, { line: '' }), 'Choose the serial line'],
    ['a series of Ethernet', lineNode({ path: 'COM9' }), stationNode(1, { profile: 'iq-f' }), 'reached by Ethernet'],
    [
      'a series without the frame',
      lineNode({ path: 'COM9' }),
      stationNode(1, { profile: 'fx3-serial', asciiXy: '' }),
      '1C',
    ],
    ['a station that does not exist', lineNode({ path: 'COM9' }), stationNode(16), 'Station 16 does not exist'],
    ['a line of the future', lineNode({ path: 'COM9', version: 99 }), stationNode(1), 'newer version'],
  ])('%s: told by status, log and Catch', async (_what, lineOf, station, told) => {
    await red.deploy([lineOf, station, readOf(Number(station.id.slice(3))), catchNode()])
    const id = `read${station.id.slice(3)}`
    await red.status(id, { fill: 'red', text: 'bad settings' })
    await red.receive(id, {})
    const { error } = (await red.next('catch')) as unknown as { error: { message: string; code: string } }
    expect(error).toMatchObject({ code: 'NOT_CONFIGURED', message: expect.stringMatching(told) })
    expect(red.log.filter(({ level }) => level === 'error').length).toBeGreaterThan(0)
  })

  test('a series of a serial line is refused where the way is Ethernet', async () => {
    await red.deploy([{ ...stationNode(1), way: 'ethernet', host: '127.0.0.1', port: '1' }, readOf(1), catchNode()])
    await red.receive('read1', {})
    const { error } = (await red.next('catch')) as unknown as { error: { message: string } }
    expect(error.message).toContain('reached by a serial line')
  })
})

describe('the test of a connection on a line', () => {
  const run = async (path: 'test' | 'find', body: object) => {
    const answer = await red.http('POST', `melsec-jw/connection/${path}`, body)
    return { status: answer.status, body: answer.json() as Record<string, unknown> & { causes: string[] } }
  }

  test('works before anything is deployed, also without a series, and gives the line back', async () => {
    const { body } = await run('test', { id: 'plc1', settings: stationNode(1, { profile: '' }), line: lineTo(line) })
    expect(body).toMatchObject({ ok: true, model: expect.stringContaining('FX5U'), profile: 'fx5-serial' })
    await hosts(0)
  })

  test('uses the running line, whose users go on', async () => {
    await red.deploy([lineTo(line), ...stations, readOf(1)])
    expect(await value(1)).toBe(1)
    const { body } = await run('test', { id: 'plc2', settings: stationNode(2), line: lineTo(line) })
    expect(body).toMatchObject({ ok: true })
    expect((await run('test', { id: 'plc1', settings: stationNode(1) })).body).toMatchObject({ ok: true })
    expect(line.hosts).toHaveLength(1)
    expect(await value(1)).toBe(1)
  })

  test('never opens a port that the runtime has open', async () => {
    await red.deploy([lineTo(line), ...stations, readOf(1)])
    expect(await value(1)).toBe(1)
    const { body } = await run('test', {
      id: 'plc1',
      settings: stationNode(1),
      line: lineTo(line, { messageFormat: '1' }),
    })
    expect(body).toMatchObject({ ok: false, message: expect.stringContaining('deploy the changes') })
    expect(line.hosts).toHaveLength(1)
  })

  test('ranks the causes of silence, and the search finds the stations that answer', async () => {
    const asked = { id: 'plc7', settings: stationNode(7, { timeout: '300', probe: 'read' }), line: lineTo(line) }
    const { body } = await run('test', asked)
    expect(body).toMatchObject({ ok: false, code: 'SILENT', mayFind: true })
    expect(body.causes[0]).toContain('device server')
    expect(body.causes.join()).toMatch(/MC protocol.+115200.+7O1.+station number 7.+format 4.+sum check/)
    const found = await run('find', asked)
    expect(found.body).toMatchObject({ ok: true, stations: [{ station: 1 }, { station: 2 }] })
    expect(found.body).toMatchObject({ stations: [{ profile: 'fx5-serial', model: expect.any(String) }, {}] })
    await hosts(0)
  }, 60_000)

  test('of a silent station on the running line, beside those that answer', async () => {
    await red.deploy([lineTo(line), ...stations, readOf(1)])
    expect(await value(1)).toBe(1)
    const asked = { id: 'plc7', settings: stationNode(7, { timeout: '500' }), line: lineTo(line) }
    const { body } = await run('test', asked)
    expect(body).toMatchObject({ ok: false, code: 'SILENT', mayFind: true })
    expect(body.causes[0]).toContain('No PLC on the line has station number 7')
    const found = await run('find', asked)
    expect(found.body).toMatchObject({ ok: true, stations: [{ station: 1 }, { station: 2 }] })
    expect(await value(1)).toBe(1)
  }, 60_000)

  test('where no station answers the search tries other formats, unless the line is in use', async () => {
    const other = await startLine({ messageFormat: 1, sumCheck: false, frames: ['3C'] })
    const given = lineTo(other, { answerTime: '200', quiet: '20', betweenBytes: '50' })
    const asked = { id: 'plc2', settings: stationNode(2, { timeout: '300' }), line: given }
    const found = (await run('find', asked)).body
    expect(found).toEqual({ ok: true, station: 2, forms: [{ frame: '3C', messageFormat: 1, sumCheck: false }] })
    // One that asks nobody keeps the port open.
    await red.deploy([given, stationNode(2, { probe: 'none' }), readOf(2)])
    await red.status('read2', { fill: 'green' })
    expect((await run('find', asked)).body).toMatchObject({ ok: false, causes: [expect.stringContaining('deployed')] })
    await red.deploy([])
    await other.close()
  }, 60_000)

  test('a port that cannot be opened, and no line', async () => {
    const none = { id: 'x', settings: stationNode(1), line: lineNode({ path: '/dev/tty-none' }) }
    for (const path of ['test', 'find'] as const) {
      expect((await run(path, none)).body).toMatchObject({
        ok: false,
        message: expect.stringContaining('no such port'),
      })
    }
    expect((await run('test', { settings: stationNode(1, { line: '' }) })).body).toMatchObject({
      ok: false,
      message: expect.stringContaining('Choose the serial line'),
    })
  })
})

describe('the list of ports', () => {
  test('is that of the machine', async () => {
    const { status, json } = await red.http('POST', 'melsec-jw/line/ports', {})
    expect(status).toBe(200)
    expect(json()).toEqual({ ok: true, ports: expect.any(Array) })
  })

  test('and the address check speaks as the line does', async () => {
    const check = async (settings: object) => {
      const answer = await red.http('POST', 'melsec-jw/address/check', {
        settings,
        items: [{ address: 'X17', type: '' }],
      })
      return (answer.json() as { results: object[] }).results[0]
    }
    const settings = { way: 'serial', profile: 'fx5-serial', lineFrame: '3C', messageFormat: '1', asciiXy: 'octal' }
    expect(await check(settings)).toMatchObject({ ok: true, radix: 8 })
    expect(await check({ ...settings, lineFrame: '4C', messageFormat: '5', asciiXy: '' })).toMatchObject({ ok: true })
  })
})
