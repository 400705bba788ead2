/** The nodes where the package serialport is not installed: the editor is told what to install. */
import { expect, jest, test } from '@jest/globals'
import type { NodeAPI } from 'node-red'
import { connectionTest } from '../../nodes/connection-test'
import { linePorts } from '../../nodes/line-ports'

jest.mock('serialport', () => {
  throw Object.assign(new Error("Cannot find module 'serialport'"), { code: 'MODULE_NOT_FOUND' })
})

interface Answer {
  readonly status: number
  readonly body: Record<string, unknown>
}
type Endpoint = (request: object, response: object) => void

const endpoints = new Map<string, { readonly permission: unknown; readonly endpoint: Endpoint }>()
const texts = (key: string): string => key

/** As much of Node-RED as an endpoint needs. */
const red = {
  httpAdmin: {
    post: (path: string, permission: unknown, endpoint: Endpoint) => endpoints.set(path, { permission, endpoint }),
  },
  auth: { needsPermission: (name: string) => name },
  nodes: { getNode: () => null },
  log: { error: () => {} },
  _: (key: string) => key,
} as unknown as NodeAPI

linePorts(red, texts)
connectionTest(red, texts, () => undefined)

function post(path: string, body: object): Promise<Answer> {
  return new Promise((resolve) => {
    let status = 0
    const response = {
      on: () => response,
      status: (code: number) => {
        status = code
        return response
      },
      json: (answer: Record<string, unknown>) => resolve({ status, body: answer }),
    }
    endpoints.get(path)?.endpoint({ body }, response)
  })
}

const INSTALL = expect.stringContaining('npm install serialport')

test('the list of ports says it', async () => {
  expect(await post('/melsec-jw/line/ports', {})).toEqual({ status: 200, body: { ok: false, message: INSTALL } })
})

test.each(['test', 'find'])('%s of a connection says it', async (what) => {
  const settings = { way: 'serial', line: 'line', lineStation: '1', profile: 'fx5-serial' }
  const line = { transport: 'serial', path: '/dev/ttyUSB0' }
  const { status, body } = await post(`/melsec-jw/connection/${what}`, { id: 'plc', settings, line })
  expect({ status, body }).toMatchObject({ status: 200, body: { ok: false, message: INSTALL } })
})

test('each endpoint needs its permission', () => {
  const permissions = [...endpoints].map(([path, { permission }]) => [path, permission])
  expect(Object.fromEntries(permissions)).toEqual({
    '/melsec-jw/line/ports': 'melsec-jw.read',
    '/melsec-jw/connection/test': 'melsec-jw.write',
    '/melsec-jw/connection/find': 'melsec-jw.write',
  })
})
