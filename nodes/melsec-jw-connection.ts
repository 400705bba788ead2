/** Node `melsec-jw-connection` (configuration): how to reach a PLC; its users share one client. */
import type { Node, NodeAPI, NodeDef } from 'node-red'
import { typeNames } from '../src/entry/address'
import { type ProfileId, profileIds, profiles } from '../src/index'
import { addressCheck } from './address-check'
import { connectionOf, PlcConnection, setConnection } from './connection'
import { LONGEST_PAUSE, optionsOf, type Resolve, resolverOf, settingsOf } from './connection-settings'
import { connectionTest } from './connection-test'
import type { Migration } from './migration'
import { readSettings } from './node'
import { sharedTexts, type Texts } from './texts'

const migrations: readonly Migration[] = []

function connect(RED: NodeAPI, node: Node, stored: NodeDef, texts: Texts): PlcConnection {
  const connection = PlcConnection.of(node, texts, () => {
    const current = readSettings({ ...stored }, migrations, texts)
    const resolve = resolverOf(RED, node, texts)
    return { ...optionsOf(settingsOf(current, { texts, resolve }), texts), ...secretsOf(node, resolve) }
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

/** What Node-RED keeps apart from the flow: the remote password. Without one the PLC has none. */
function secretsOf(node: Node, resolve: Resolve): { readonly password?: string } {
  const { password } = (node.credentials ?? {}) as { readonly password?: unknown }
  return typeof password === 'string' && password !== '' ? { password: resolve(password) } : {}
}

/** What the editor knows of the library, so that nothing is written twice. Node-RED wants these names. */
const editorSettings = {
  melsecJwConnectionTypes: { value: [...typeNames], exportable: true },
  melsecJwConnectionProfiles: {
    value: Object.fromEntries(profileIds.map((id) => [id, factsOf(id)])),
    exportable: true,
  },
  melsecJwConnectionLongestPause: { value: LONGEST_PAUSE, exportable: true },
}

/** What a series makes of settings that are left empty. */
function factsOf(id: ProfileId): object {
  const { frame, xyRadix, wRadix, asciiXy, monitoringTimer } = profiles[id]
  return { frame, xyRadix, wRadix, asciiXy, monitoringTimer: monitoringTimer.default }
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
