/** Node `melsec-jw-line` (configuration): one serial line; the connections to the PLCs on it share it. */
import type { Node, NodeAPI, NodeDef } from 'node-red'
import { baudRates, createMelsecLine, type SerialFormat, type SerialFrameName, serialFrameNames } from '../src/index'
import { resolverOf } from './fields'
import { PlcLine, setLine } from './line'
import { linePorts } from './line-ports'
import { lineOptionsOf, lineSettingsOf } from './line-settings'
import type { Migration } from './migration'
import { readSettings } from './node'
import { sharedTexts, textsOf } from './texts'

const TYPE = 'melsec-jw-line'
const migrations: readonly Migration[] = []

/** What the editor knows of the library, so that nothing is written twice. Node-RED wants these names. */
const editorSettings = {
  melsecJwLineBaudRates: { value: [...baudRates], exportable: true },
  melsecJwLineFormats: {
    value: Object.fromEntries(serialFrameNames.map((frame) => [frame, formatsOf(frame)])),
    exportable: true,
  },
} as const

/** The message formats of a frame. */
function formatsOf(frame: SerialFrameName): readonly SerialFormat[] {
  return ([1, 4, 5] as const).filter((messageFormat) => {
    try {
      return createMelsecLine({ host: 'nowhere', port: 1, frame, messageFormat }).frame === frame
    } catch {
      return false
    }
  })
}

export = function register(RED: NodeAPI): void {
  const texts = sharedTexts(RED)
  const labels = textsOf(RED, TYPE)
  RED.nodes.registerType(
    TYPE,
    function (this: Node, stored: NodeDef) {
      RED.nodes.createNode(this, stored)
      const line = PlcLine.of(texts, () => {
        const current = readSettings({ ...stored }, migrations, texts)
        const context = { texts, labels, resolve: resolverOf(RED, this, texts) }
        return lineOptionsOf(lineSettingsOf(current, context), context)
      })
      if (line.failure !== undefined) this.error(line.failure)
      this.on('close', setLine(this, line))
    },
    { settings: editorSettings },
  )
  linePorts(RED, texts)
}
