// Node-RED's settings for the demo.
import { mkdirSync, readFileSync, realpathSync, rmSync, symlinkSync, writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { root } from '../scripts/setup.mjs'

export const dashboardPath = 'dashboard'

const { name: packageName } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'))

/** @param userDir absolute */
export function settings(userDir) {
  return {
    userDir,
    flowFile: 'flows.json',
    flowFilePretty: true,
    // The demo flow has no credentials; without this Node-RED makes a key and warns about it.
    credentialSecret: 'demo',
    httpAdminRoot: '/',
    httpNodeRoot: '/',
    // The demo works without a network, and asks none.
    telemetry: { enabled: false, updateNotification: false },
    editorTheme: {
      page: { title: 'melsec-jw demo' },
      header: { title: 'melsec-jw demo' },
      tours: false,
      palette: { catalogues: [] },
    },
    externalModules: { autoInstall: false },
    logging: { console: { level: 'off' }, demo: { level: 'warn', handler: () => logged } },
  }
}

/** Errors, and the warnings of nodes: what Node-RED warns of while it starts is as it should be here. */
function logged({ level, type, name, id, msg }) {
  const isError = level <= 20
  if (!isError && type === undefined) return
  const node = type === undefined ? '' : ` ${type}${name || id ? `:${name || id}` : ''}`
  console.error(`Node-RED ${isError ? 'error' : 'warning'}${node}: ${msg?.stack ?? msg?.message ?? msg}`)
}

/** A user directory with this package installed in it, by a link to the working copy. */
export function prepareUserDir(userDir) {
  const link = join(userDir, 'node_modules', packageName)
  mkdirSync(dirname(link), { recursive: true })
  if (targetOf(link) !== realpathSync(root)) {
    rmSync(link, { recursive: true, force: true })
    // Windows makes a junction, which needs no rights; elsewhere the kind is ignored.
    symlinkSync(root, link, 'junction')
  }
  const manifest = { name: 'melsec-jw-demo', private: true, dependencies: { [packageName]: '*' } }
  writeFileSync(join(userDir, 'package.json'), `${JSON.stringify(manifest, null, 2)}\n`)
}

function targetOf(link) {
  try {
    return realpathSync(link)
  } catch {
    return undefined
  }
}
