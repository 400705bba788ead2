/** The character codes of text in the dialogs, in the real editor. */
import { afterAll, beforeAll, expect, test } from '@jest/globals'
import type { Page } from 'playwright-core'
import { encodings } from '../../src/index'
import { type HeadlessBrowser, launchBrowser } from '../support/browser'
import { type NodeRed, startNodeRed } from '../support/node-red'
import { readText } from '../support/syntax'

let red: NodeRed
let browser: HeadlessBrowser

beforeAll(async () => {
  ;[red, browser] = await Promise.all([startNodeRed(), launchBrowser()])
  // Written by hand: without an encoding.
  await red.deploy([
    { id: 'plc', type: 'melsec-jw-connection', version: 1, host: 'plc', port: '5007', profile: 'iq-r' },
    { id: 'read', type: 'melsec-jw-read', version: 1, connection: 'plc', items: [], wires: [[]] },
  ])
}, 90_000)

afterAll(async () => {
  await browser.close()
  await red.stop()
})

/** What the dialog of a connection shows. @param id `_ADD_`: a new one */
async function shown(page: Page, id: string): Promise<string> {
  await page.evaluate((connection) => {
    const { RED } = globalThis as unknown as {
      RED: { editor: { editConfig(name: string, type: string, id: string): void } }
    }
    RED.editor.editConfig('', 'melsec-jw-connection', connection)
  }, id)
  const encoding = page.locator('#node-config-input-encoding')
  await encoding.waitFor({ state: 'attached' })
  const value = await encoding.inputValue()
  await page.locator('#node-config-dialog-cancel').click()
  await encoding.waitFor({ state: 'detached' })
  return value
}

test.each([
  ['ja', 'shift-jis'],
  ['ja-JP', 'shift-jis'],
  ['en-US', 'ascii'],
  ['zh-CN', 'ascii'],
] as const)('a new connection in %s begins with %s, and one that is there keeps its own', async (locale, usual) => {
  const { page, close } = await browser.openEditor(red.url, { locale })
  expect(await shown(page, '_ADD_')).toBe(usual)
  expect(await shown(page, 'plc')).toBe('ascii')
  await close()
})

test.each(['connection', 'file'])('the dialog of the %s offers every one', (name) => {
  const [, select = ''] =
    /<select id="node-(?:config-)?input-encoding">(.*?)<\/select>/s.exec(readText(`nodes/melsec-jw-${name}.html`)) ?? []
  const offered = [...select.matchAll(/value="([^"]+)"/g)].map(([, value]) => value)
  expect(offered.sort()).toEqual([...encodings].sort())
})
