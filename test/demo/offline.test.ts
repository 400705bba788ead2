/** The demo flow when its PLC goes away: the page says so, and its values do not pass for live ones. */
import { afterAll, beforeAll, expect, jest, test } from '@jest/globals'
import type { Page } from 'playwright-core'
import { createPlcSimulator, type PlcSimulator, startDemoPlant } from '../../src/entry/simulator'
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
  // The other PLCs are not needed; a port on which nobody listens for long stands for them.
  red = await startDemoNodeRed({ iqr: port, fx5: 9, jw: 9 })
  browser = await launchBrowser()
  opened = await browser.openPage(`${red.dashboard}iqr`)
  page = opened.page
})

afterAll(async () => {
  await browser?.close()
  await red?.stop()
  await plc?.close()
})

const trends = ['level-trend', 'temperature-trend']
const head = () => widget(page, 'iqr-head').innerText()
const isStale = async () => (await page.locator('.plc-stale').count()) > 0

/** The controls of a page that can be operated. */
const operable = async (shown: Page): Promise<string[]> => {
  const controls = [
    ...['level-setpoint', 'temperature-setpoint', 'mixing-time', 'recipe'].map(
      (id) => `#nrdb-ui-widget-iqr-${id} input`,
    ),
    ...['start', 'stop', 'acknowledge'].map((id) => `#nrdb-ui-widget-iqr-${id} button`),
    '.plc-cpu-run',
    '.plc-cpu-stop',
  ]
  await shown.locator('.plc-cpu-stop').waitFor()
  const enabled = controls.map(async (each) => ((await shown.locator(each).first().isEnabled()) ? [each] : []))
  return (await Promise.all(enabled)).flat()
}

test('a PLC that is there is connected, its values are live, and its controls can be operated', async () => {
  await eventually('the connection', head, (text) => text.includes('Connected'))
  expect(await isStale()).toBe(false)
  for (const id of trends) {
    await eventually(
      `a line in the ${id}`,
      () => columnsOf(page, `iqr-${id}`),
      (drawn) => /#{20,}/.test(drawn),
    )
  }
  await eventually(
    'enabled controls',
    () => operable(page),
    (controls) => controls.length === 9,
  )
})

test('a PLC that has gone is offline, with the reason, and its values are grey', async () => {
  await plc.close()
  const text = await eventually('the end of the connection', head, (shown) => shown.includes('Offline'))
  expect(text).not.toContain('RUN')
  await eventually('the reason', head, (shown) => /refused/.test(shown), 40_000)
  expect(await isStale()).toBe(true)
})

test('nothing can be operated meanwhile, also on a page that is opened then', async () => {
  await eventually(
    'disabled controls',
    () => operable(page),
    (controls) => controls.length === 0,
  )
  const other = await browser.openPage(`${red.dashboard}iqr`)
  try {
    await eventually(
      'disabled controls',
      () => operable(other.page),
      (controls) => controls.length === 0,
    )
  } finally {
    await other.close()
  }
})

test('a PLC that is back is connected again, without a deploy', async () => {
  plc = await startPlc(port)
  await eventually('the connection', head, (text) => text.includes('Connected'), 60_000)
  await eventually('live values', isStale, (stale) => !stale)
  await eventually(
    'enabled controls',
    () => operable(page),
    (controls) => controls.length === 9,
  )
  expect(opened.problems).toEqual([])
})

test('the trends have a gap where the PLC was away', async () => {
  for (const id of trends) {
    await eventually(
      `a gap in the ${id}`,
      () => columnsOf(page, `iqr-${id}`),
      (drawn) => /#+\.{10,}#+/.test(drawn),
    )
  }
})

/** Columns of pixels of a chart with its line in them (`#`) and without (`.`); the plot begins right of its axis. */
function columnsOf(shown: Page, id: string): Promise<string> {
  return widget(shown, id)
    .locator('canvas')
    .evaluate((element) => {
      const canvas = element as HTMLCanvasElement
      const { width, height } = canvas
      const { data } = canvas.getContext('2d')?.getImageData(0, 0, width, height) ?? { data: [] }
      const strong = (x: number, y: number) => {
        const [red = 0, green = 0, blue = 0, alpha = 0] = data.slice(4 * (y * width + x), 4 * (y * width + x) + 4)
        // Axes and letters are grey.
        return alpha > 100 && Math.max(red, green, blue) - Math.min(red, green, blue) > 60
      }
      const rows = Array.from({ length: height }, (_, y) => y)
      return Array.from({ length: width }, (_, x) => (rows.some((y) => strong(x, y)) ? '#' : '.')).join('')
    })
}

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
