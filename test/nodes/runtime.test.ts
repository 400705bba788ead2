/** What depends on how Node-RED itself is set up: its language, and who may do what. */
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import type { PlcSimulator } from '../../src/entry/simulator'
import { languages } from '../../src/index'
import { type Message, type NodeRed, startNodeRed } from '../support/node-red'
import { readText } from '../support/syntax'
import { type CaughtError, catchNode, connectionTo, portOf, readNode, startPlc, writeNode } from './flow'

let plc: PlcSimulator

beforeAll(async () => {
  plc = await startPlc()
})

afterAll(() => plc.close())

describe('in Japanese', () => {
  let red: NodeRed

  beforeAll(async () => {
    red = await startNodeRed({ language: 'ja' })
  }, 60_000)

  afterAll(() => red.stop())

  async function caught(id: string, message: object): Promise<CaughtError> {
    await red.receive(id, { ...message })
    return ((await red.next('catch')) as Message & { error: CaughtError }).error
  }

  test('the errors of the nodes, the meaning of end codes and statuses with numbers', async () => {
    plc.faults.add({ kind: 'endCode', endCode: 0xc056, commands: ['readWords'] })
    await red.deploy([connectionTo(plc), readNode(['D100']), writeNode(), catchNode()])
    expect((await caught('write', { payload: { D1: 1 } })).message).toContain('書込み')
    const { cause, message } = await caught('read', {})
    expect(message).toMatch(/が終了コード C056H で拒否されました。.*最大アドレス/)
    expect(cause.meaning).toMatch(/[\u3040-\u30ff]/)
    expect(cause.remedy).toMatch(/[\u3040-\u30ff]/)
    await red.status('read', { text: '終了コード C056' })
    plc.faults.clear()
  })

  test('why a message was not sent', async () => {
    plc.faults.add({ kind: 'delay', ms: 300, commands: ['readWords'] })
    await red.deploy([connectionTo(plc, { timeout: '500' }), readNode(['D100'], { busy: 'queue' }), catchNode()])
    await red.status('read', { fill: 'green' })
    for (let message = 0; message < 5; message++) await red.receive('read', {})
    const { error } = (await red.next('catch')) as Message & { error: CaughtError }
    expect(error).toMatchObject({ code: 'OVERLOADED', cause: { outcome: 'notSent' } })
    expect(error.message).toMatch(/^PlcError: .*要求が速すぎる: .*was not sent/)
    plc.faults.clear()
    await red.deploy([])
    red.forget()
  })

  test('likely causes, in the error, its message, the log and the connection test', async () => {
    const japanese = /^[^a-z]*[\u3040-\u30ff]/
    await red.deploy([connectionTo(plc, { port: '1' }), readNode(['D100']), catchNode()])
    await red.status('read', { fill: 'red' })
    const { cause, message } = await caught('read', {})
    expect(cause.causes).toEqual([expect.stringMatching(japanese), expect.any(String), expect.any(String)])
    expect(message).toMatch(/^PlcError: 切断: .* 考えられる原因/)
    expect(message).toContain((cause.causes as string[])[0])
    expect(red.log.map(({ text }) => text)).toContainEqual(expect.stringContaining('オープン設定'))
    const settings = { host: '127.0.0.1', port: '1', profile: 'iq-r' }
    const tested = (await red.http('POST', 'melsec-jw/connection/test', { settings })).json() as Record<string, unknown>
    expect(tested.causes).toEqual(cause.causes)
    expect(tested.message).toMatch(/^到達不可: [^\u3040-\u30ff]+\.$/)
    expect(tested.message).not.toContain('Likely')
  })
})

describe('for a user who may only look', () => {
  let red: NodeRed

  beforeAll(async () => {
    // Without signing in one has the permissions of `default`.
    red = await startNodeRed({
      settings: { adminAuth: { type: 'credentials', users: [], default: { permissions: 'read' } } },
    })
  }, 60_000)

  afterAll(() => red.stop())

  test('addresses are checked, and no connection is made', async () => {
    const check = await red.http('POST', 'melsec-jw/address/check', { settings: {}, items: [{ address: 'D100' }] })
    expect(check.json()).toMatchObject({ results: [{ ok: true }] })
    const settings = { host: '127.0.0.1', port: portOf(plc), profile: 'iq-r' }
    const before = plc.statistics.connections
    expect((await red.http('POST', 'melsec-jw/connection/test', { settings })).status).toBe(401)
    const browse = { connection: 'plc', directory: '4:/' }
    expect((await red.http('POST', 'melsec-jw/file/list', browse)).status).toBe(401)
    expect(plc.statistics.connections).toBe(before)
    // What ports there are may be seen, as everything may that asks no PLC.
    expect((await red.http('POST', 'melsec-jw/line/ports', {})).status).toBe(200)
    expect((await red.http('POST', 'melsec-jw/connection/find', { settings })).status).toBe(401)
  })
})

test('who may see nothing does not see the ports of the machine', async () => {
  const red = await startNodeRed({ settings: { adminAuth: { type: 'credentials', users: [] } } })
  expect((await red.http('POST', 'melsec-jw/line/ports', {})).status).toBe(401)
  await red.stop()
}, 60_000)

describe.each([...languages, 'de'])('in %s', (language) => {
  test('a status node gets readable texts, the code and the state of the connection', async () => {
    const red = await startNodeRed({ language })
    const catalogue = JSON.parse(
      readText(`nodes/locales/${language === 'de' ? 'en-US' : language}/melsec-jw-connection.json`),
    ) as { status: Record<string, string> }
    const shown = async (wanted: object): Promise<Record<string, unknown>> => {
      for (let count = 0; count < 20; count++) {
        const { status } = (await red.next('status')) as Message & { status: Record<string, unknown> }
        expect(String(status.text ?? '')).not.toMatch(/status\.|melsec-jw|node-red:|__/)
        if (Object.entries(wanted).every(([key, value]) => status[key] === value)) return status
      }
      throw new Error('not shown')
    }
    const statusNode = { id: 'status', type: 'status', scope: null, wires: [[]] }
    await red.deploy([statusNode, connectionTo(plc), readNode(['D100'])])
    const good = { fill: 'green', text: catalogue.status.connected, state: 'connected' }
    expect(await shown({ fill: 'green' })).toMatchObject(good)
    plc.faults.add({ kind: 'endCode', endCode: 0xc056, commands: ['readWords'] })
    await red.receive('read', {})
    const refused = catalogue.status.endCode?.replace('__code__', 'C056')
    const bad = { text: refused, code: 'END_CODE', endCode: 0xc056, state: 'connected' }
    expect(await shown({ fill: 'red' })).toMatchObject(bad)
    plc.faults.clear()
    await red.deploy([statusNode, connectionTo(plc, { port: '1' }), readNode(['D100'])])
    expect(await shown({ code: 'CONNECT_FAILED' })).toMatchObject({ fill: 'red', text: catalogue.status.notReached })
    await red.stop()
  }, 60_000)
})
