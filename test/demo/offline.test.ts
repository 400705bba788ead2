/** The demo flow when its PLC goes away: the page says so, and its values do not pass for live ones. */
import { afterAll, beforeAll, expect, jest, test } from '@jest/globals'
import type { Page } from 'playwright-core'
import { createPlcSimulator, type PlcSimulator, startDemoPlant } from '../../src/index'
import { type HeadlessBrowser, launchBrowser, type OpenedPage } from '../support/browser'
import { eventually, type RunningNodeRed, startDemoNodeRed, widget } from './running'

jest.setTimeout(150_000)

let plc: PlcSimulator
let port: number
let red: RunningNodeRed
let browser: HeadlessBrowser
let opened: OpenedPage
let page: Page

async function startPlc(port: number): Promise<PlcSimulator> {
  const started = createPlcSimulator({ profile: 'iq-r', tcp: { port }, udp: false })
  await started.listen()
  startDemoPlant(started)
  return started
}

beforeAll(async () => {
  plc = await startPlc(0)
  port = plc.tcp?.port ?? 0
  // The other PLC is not needed; a port on which nobody listens for long stands for it.
  red = await startDemoNodeRed({ iqr: port, fx5: 9 })
  browser = await launchBrowser()
  opened = await browser.openPage(`${red.dashboard}iqr`)
  page = opened.page
})

afterAll(async () => {
  await browser?.close()
  await red?.stop()
  await plc?.close()
})

const head = () => widget(page, 'iqr-head').innerText()
const isStale = async () => (await page.locator('.plc-stale').count()) > 0

test('a PLC that is there is connected, and its values are live', async () => {
  await eventually('the connection', head, (text) => text.includes('Connected'))
  expect(await isStale()).toBe(false)
})

test('a PLC that has gone is offline, with the reason, and its values are grey', async () => {
  await plc.close()
  const text = await eventually('the end of the connection', head, (shown) => shown.includes('Offline'))
  expect(text).not.toContain('RUN')
  await eventually('the reason', head, (shown) => /refused/.test(shown), 40_000)
  expect(await isStale()).toBe(true)
})

test('what is pressed meanwhile is not sent, and the page says so', async () => {
  await widget(page, 'iqr-start').locator('button').click()
  await page.getByText('Nothing was sent.').waitFor()
})

test('a PLC that is back is connected again, without a deploy', async () => {
  plc = await startPlc(port)
  await eventually('the connection', head, (text) => text.includes('Connected'), 60_000)
  await eventually('live values', isStale, (stale) => !stale)
  expect(opened.problems).toEqual([])
})

test('the page of a PLC that was never reached shows no values at all', async () => {
  const other = await browser.openPage(`${red.dashboard}fx5`)
  try {
    const text = () => widget(other.page, 'fx5-head').innerText()
    await eventually('the state', text, (shown) => shown.includes('Offline'))
    await eventually(
      'hidden gauges',
      () => other.page.locator('.nrdb-ui-gauge:visible').count(),
      (count) => count === 0,
    )
  } finally {
    await other.close()
  }
})
