/**
 * `POST /melsec-jw/file/list`: the drives of a PLC, or what is in a directory, for the editor.
 *
 * Body: `{ connection, directory }`: the id of a connection that is deployed, so that nobody is asked whom the flows do
 * not ask; `directory` is `''` for the drives. Answer: `{ ok: true, drives }` or `{ ok: true, entries }`, or
 * `{ ok: false, message }`.
 */
import type { NodeAPI } from 'node-red'
import type { Drive, FileEntry } from '../src/index'
import { endpoint, type Reply } from './admin'
import { connectionOf, type PlcConnection } from './connection'
import { detailsOf } from './failure'
import type { Texts } from './texts'

export type Listed =
  | { readonly ok: true; readonly drives: readonly Pick<Drive, 'number' | 'title'>[] }
  | { readonly ok: true; readonly entries: readonly FileEntry[] }
  | { readonly ok: false; readonly message: string }

export function fileList(RED: NodeAPI, texts: Texts): void {
  endpoint(RED, '/melsec-jw/file/list', 'melsec-jw.write', texts, async (body): Promise<Reply> => {
    const { connection: id, directory } = body
    if (typeof id !== 'string' || typeof directory !== 'string') {
      return { status: 400, body: { message: texts('error.badBody') } }
    }
    return { status: 200, body: await list(connectionOf(RED.nodes.getNode(id)), directory, texts) }
  })
}

async function list(connection: PlcConnection | undefined, directory: string, texts: Texts): Promise<Listed> {
  try {
    if (connection === undefined) return { ok: false, message: texts('error.notDeployed') }
    const client = connection.melsec('files')
    if (directory === '') {
      return { ok: true, drives: client.files.drives.map(({ number, title }) => ({ number, title })) }
    }
    // Not given up earlier than by any node: that can cost the connection, and others use it.
    return { ok: true, entries: await client.files.list(directory) }
  } catch (error) {
    return { ok: false, message: detailsOf(error, texts).message }
  } finally {
    // Without nodes that use it the connection would be kept up until the next deploy.
    connection?.releaseUnused()
  }
}
