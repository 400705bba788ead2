/** Monitors on serial lines, where a PLC remembers one registration, whoever made it. */
import { afterEach, expect, test } from '@jest/globals'
import { createLineSimulator, type LineSimulator } from '../../src/entry/simulator'
import { createMelsecClient, createMelsecLine, type MelsecClient } from '../../src/index'

const clients: MelsecClient[] = []
let line: LineSimulator | undefined

afterEach(async () => {
  for (const client of clients.splice(0)) await client.close()
  await line?.close()
})

const near = Array.from({ length: 8 }, (_, i) => `D${i * 7}`)
const far = Array.from({ length: 8 }, (_, i) => `D${1000 + i * 7}`)

async function simulated(): Promise<LineSimulator> {
  line = createLineSimulator({ profile: 'q-c24', frames: ['3C'], tcp: { port: 0 } })
  await line.listen()
  for (const item of [...near, ...far]) line.station(0).write(item, Number(item.slice(1)))
  return line
}

function made(client: MelsecClient): MelsecClient {
  clients.push(client)
  return client
}

test('two clients of one station never get the values of the other', async () => {
  const plc = await simulated()
  const shared = createMelsecLine({ frame: '3C', openTransport: plc.connect() })
  const [one, other] = [near, far].map((items) =>
    made(createMelsecClient({ line: shared, profile: 'q-c24' })).monitor(items),
  )
  for (let i = 0; i < 2; i++) {
    expect(await one?.read()).toMatchObject(near.map((item) => ({ item, value: Number(item.slice(1)) })))
    expect(await other?.read()).toMatchObject(far.map((item) => ({ item, value: Number(item.slice(1)) })))
  }
  expect([one?.mode, one?.note]).toEqual(['read', expect.stringContaining('remembers one registration')])
})

test('behind a device server others may be connected, too', async () => {
  const { tcp } = await simulated()
  const client = made(createMelsecClient({ host: '127.0.0.1', port: tcp?.port ?? 0, profile: 'q-c24', frame: '3C' }))
  expect(client.monitor(near).mode).toBe('read')
  const devices = [{ device: 'D0' }]
  const asked = client.requestByName('executeMonitor', { entryMonitorDevice: { words: devices, doubleWords: [] } })
  await expect(asked).rejects.toThrow('on a serial line that others may use is not safe')
})

test('alone at its line a client registers', async () => {
  const plc = await simulated()
  const client = made(createMelsecClient({ serial: { path: 'COM3' }, profile: 'q-c24', openTransport: plc.connect() }))
  const monitor = client.monitor(near)
  for (let i = 0; i < 2; i++) {
    expect(await monitor.read()).toMatchObject(near.map((item) => ({ value: Number(item.slice(1)) })))
  }
  expect(monitor.mode).toBe('monitor')
})
