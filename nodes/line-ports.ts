/**
 * `POST /melsec-jw/line/ports`: the serial ports of the computer that Node-RED runs on. Nothing is opened and no PLC is asked,
 * but it tells of the computer: it needs the permission `melsec-jw.read`.
 *
 * Body: `{}`. Answer: `{ ok: true, ports: [{ path, lastingPath?, manufacturer? }] }`, or `{ ok: false, message }`.
 */
import type { NodeAPI } from 'node-red'
import { serialPorts } from '../src/index'
import { endpoint } from './admin'
import { detailsOf } from './failure'
import type { Texts } from './texts'

export function linePorts(RED: NodeAPI, texts: Texts): void {
  endpoint(RED, '/melsec-jw/line/ports', 'melsec-jw.read', texts, async () => {
    try {
      return { status: 200, body: { ok: true, ports: await serialPorts() } }
    } catch (error) {
      return { status: 200, body: { ok: false, message: detailsOf(error, texts).message } }
    }
  })
}
