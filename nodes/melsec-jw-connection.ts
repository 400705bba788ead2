/** Node `melsec-jw-connection` (configuration): how to reach a PLC; its users share one client. */
import type { Node, NodeAPI, NodeDef } from 'node-red'
import { type MelsecClientOptions, type MelsecLine, type ProfileId, profileIds, profiles } from '../src/index'
import { addressCheck } from './address-check'
import { connectionOf, PlcConnection, setConnection } from './connection'
import { familyOptionsOf, LONGEST_PAUSE, settingsOf } from './connection-settings'
import { connectionTest } from './connection-test'
import { refusal } from './failure'
import { families } from './family'
import { type Resolve, resolverOf } from './fields'
import { lineOf } from './line'
import type { Migration } from './migration'
import { readSettings } from './node'
import { sharedTexts, type Texts } from './texts'

const migrations: readonly Migration[] = [
  // The way to the PLC: what is older knows Ethernet only.
  { version: 2, up: (settings) => ({ way: 'ethernet', ...settings }) },
  // The family of the PLC: what is older knows MELSEC only.
  { version: 3, up: (settings) => ({ family: 'melsec', ...settings }) },
]

function connect(RED: NodeAPI, node: Node, stored: NodeDef, texts: Texts): PlcConnection {
  const connection = PlcConnection.of(node, texts, () => {
    const current = readSettings({ ...stored }, migrations, texts)
    const resolve = resolverOf(RED, node, texts)
    const given = familyOptionsOf(settingsOf(current, { texts, resolve }), texts, (id) => deployedLine(RED, id, texts))
    if (given.family === 'jw') return given
    const { options } = given
    return { family: 'melsec', options: { ...options, ...(hasPassword(options) ? secretsOf(node, resolve) : {}) } }
  })
  if (connection.failure !== undefined) node.error(connection.failure)
  node.on('close', (done: () => void) => {
    connection.close().then(done, (error: unknown) => {
      node.error(error)
      done()
    })
  })
  return connection
}

/** @throws NodeFailure NOT_CONFIGURED where there is none, or its settings are wrong */
function deployedLine(RED: NodeAPI, id: string, texts: Texts): MelsecLine {
  const line = lineOf(RED.nodes.getNode(id))
  if (line === undefined) throw refusal('NOT_CONFIGURED', texts('error.noLine'), { field: 'line' })
  return line.line
}

/** The CPUs that have a serial line themselves have none there, and the dialog has no field for it; one of another way may be stored. */
function hasPassword({ line, profile }: MelsecClientOptions): boolean {
  return line === undefined || (typeof profile === 'string' && profiles[profile].serial?.reach === 'c24')
}

/** What Node-RED keeps apart from the flow: the remote password. Without one the PLC has none. */
function secretsOf(node: Node, resolve: Resolve): { readonly password?: string } {
  const { password } = (node.credentials ?? {}) as { readonly password?: unknown }
  return typeof password === 'string' && password !== '' ? { password: resolve(password) } : {}
}

/** What the editor knows of the library, so that nothing is written twice. Node-RED wants these names. */
const editorSettings = {
  melsecJwConnectionFamilies: { value: { ...families }, exportable: true },
  melsecJwConnectionProfiles: {
    value: Object.fromEntries(profileIds.map((id) => [id, factsOf(id)])),
    exportable: true,
  },
  melsecJwConnectionLongestPause: { value: LONGEST_PAUSE, exportable: true },
}

/** What a series makes of settings that are left empty. */
function factsOf(id: ProfileId): object {
  const { frame, frames, xyRadix, wRadix, asciiXy, monitoringTimer, serial } = profiles[id]
  const facts = { frame, xyRadix, wRadix, asciiXy, monitoringTimer: monitoringTimer.default }
  if (serial === undefined) return facts
  return { ...facts, serial: { frames, reach: serial.reach, lastStation: serial.lastStation } }
}

export = function register(RED: NodeAPI): void {
  const texts = sharedTexts(RED)
  const running = new Set<PlcConnection>()
  RED.nodes.registerType(
    'melsec-jw-connection',
    function (this: Node, stored: NodeDef) {
      RED.nodes.createNode(this, stored)
      const connection = connect(RED, this, stored, texts)
      setConnection(this, connection)
      running.add(connection)
      this.on('close', () => {
        running.delete(connection)
      })
    },
    { settings: editorSettings, credentials: { password: { type: 'password' } } },
  )
  // A deploy may move the last user away without touching the connection: only then is it known that nobody is left.
  RED.events.on('flows:started', () => {
    for (const connection of running) connection.releaseUnused()
  })
  addressCheck(RED, texts)
  connectionTest(RED, texts, (id) => connectionOf(RED.nodes.getNode(id)))
}
