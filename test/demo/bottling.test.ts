/** The page of the bottling line in a real browser, with a simulated Sharp JW of the test that goes away and comes back. */
import { afterAll, beforeAll, expect, jest, test } from '@jest/globals'
import type { Page } from 'playwright-core'
import { createJwSimulator, type JwSimulator, startDemoBottling } from '../../src/entry/simulator'
import { type HeadlessBrowser, launchBrowser, type OpenedPage } from '../support/browser'
import { eventually, type RunningNodeRed, startDemoNodeRed, widget } from './running'

jest.setTimeout(150_000)

let plc: JwSimulator
let port: number
let red: RunningNodeRed
let browser: HeadlessBrowser
let opened: OpenedPage
let page: Page

async function startPlc(at: number): Promise<JwSimulator> {
  const started = createJwSimulator({ writeMode: 1, tcp: { port: at }, udp: false })
  await started.listen()
  startDemoBottling(started)
  return started
}

beforeAll(async () => {
  plc = await startPlc(0)
  port = plc.tcp?.port ?? 0
  // The other PLCs are not needed; a port on which nobody listens for long stands for them.
  red = await startDemoNodeRed({ iqr: 9, fx5: 9, jw: port })
  browser = await launchBrowser()
  opened = await browser.openPage(`${red.dashboard}jw`)
  page = opened.page
})

afterAll(async () => {
  await browser?.close()
  await red?.stop()
  await plc?.close()
})

const head = () => widget(page, 'jw-head').innerText()
const press = (button: string) => widget(page, `jw-${button}`).locator('button').click()
const input = (id: string) => widget(page, `jw-${id}`).locator('input').last()
const figure = (name: string) => page.locator(`[data-value="${name}"]`).innerText()
const isOn = (led: string) =>
  page.locator(`[data-led="${led}"]`).evaluate((element) => element.classList.contains('on'))
const isTrue = (on: unknown) => on === true
const isFalse = (on: unknown) => on === false

/** The controls of a page that can be operated. */
async function operable(shown: Page): Promise<string[]> {
  const controls = [
    ...['bottle-size', 'conveyor-speed', 'tolerance', 'settling-time'].map((id) => `#nrdb-ui-widget-jw-${id} input`),
    ...['start', 'stop', 'acknowledge'].map((id) => `#nrdb-ui-widget-jw-${id} button`),
    '.plc-cpu-run',
    '.plc-cpu-stop',
  ]
  await shown.locator('.plc-cpu-stop').waitFor()
  const enabled = controls.map(async (each) => ((await shown.locator(each).first().isEnabled()) ? [each] : []))
  return (await Promise.all(enabled)).flat()
}

const allOperable = () =>
  eventually(
    'enabled controls',
    () => operable(page),
    (controls) => controls.length === 9,
  )

test('shows the connection, the size of the program memory, the run state and the round trip', async () => {
  const text = await eventually('the head', head, (shown) => /\d ms/.test(shown) && shown.includes('RUN'))
  expect(text).toContain('Connected')
  expect(text).toMatch(/Memory\s*\d+ K words/)
  await allOperable()
})

test('counts bottles as the PLC does, and shows filler, supply tank and product', async () => {
  const before = Number(
    await eventually(
      'a count',
      () => figure('bottles'),
      (shown) => /^\d+$/.test(shown),
    ),
  )
  await eventually(
    'more bottles',
    () => figure('bottles'),
    (shown) => Number(shown) > before,
  )
  // What is shown is a second old at most; a bottle takes longer than one.
  expect(Math.abs(Number(await figure('bottles')) - Number(plc.read('09000:UDINT')))).toBeLessThanOrEqual(2)
  plc.write('09010:UDINT', 1700)
  await eventually(
    'the rejected bottles',
    () => figure('rejected'),
    (shown) => /^170\d$/.test(shown),
  )
  expect(await widget(page, 'jw-fill-text').innerText()).toMatch(/\d+ of 500 ml/)
  expect(await widget(page, 'jw-supply-text').innerText()).toMatch(/\d\.\d %/)
  expect(await widget(page, 'jw-bottles').innerText()).toContain('麦茶')
  expect(await page.locator('.nrdb-ui-gauge svg, .nrdb-ui-gauge-tank').count()).toBeGreaterThanOrEqual(2)
  expect(await page.locator('.nrdb-ui-chart canvas').count()).toBe(2)
})

test('shows the conveyor running and standing', async () => {
  await eventually('a running conveyor', () => isOn('conveyor'), isTrue)
  await eventually('a standing conveyor', () => isOn('conveyor'), isFalse)
})

test('stops the line with a button, and starts it again', async () => {
  await eventually('automatic operation', () => isOn('running'), isTrue)
  await press('stop')
  await eventually('the relay in the PLC', () => plc.read('004010'), isFalse)
  await eventually('the light', () => isOn('running'), isFalse)
  await press('start')
  await eventually('the relay in the PLC', () => plc.read('004010'), isTrue)
  await eventually('the light', () => isOn('running'), isTrue)
})

test('writes registers of the recipe with a slider and a number', async () => {
  const slider = widget(page, 'jw-bottle-size').getByRole('slider')
  await slider.focus()
  await slider.press('ArrowRight')
  await eventually(
    'the content in the PLC',
    () => plc.read('19000:UINT'),
    (value) => value === 510,
  )
  await input('tolerance').fill('20')
  await input('tolerance').press('Enter')
  await eventually(
    'the tolerance in the PLC',
    () => plc.read('19002:UINT'),
    (value) => value === 20,
  )
  expect(plc.read('19004:UINT')).toBe(250)
  expect(plc.read('19006:UINT')).toBe(400)
})

test('shows an alarm of the line with its reason, until it is acknowledged', async () => {
  // Somebody else sets a recipe that is out of range.
  plc.write('19002:UINT', 500)
  await eventually('the alarm', () => isOn('alarm'), isTrue)
  await page.getByText('Recipe out of range').waitFor()
  await eventually(
    'the tolerance on the page',
    () => input('tolerance').inputValue(),
    (value) => value === '500',
  )
  plc.write('19002:UINT', 15)
  await press('acknowledge')
  await eventually('no alarm in the PLC', () => plc.read('004020'), isFalse)
  await eventually('no alarm on the page', () => isOn('alarm'), isFalse)
  await press('start')
  await eventually('automatic operation', () => isOn('running'), isTrue)
})

test('stops the PLC and releases it, each after a question', async () => {
  await page.locator('.plc-cpu-stop').click()
  await page.locator('.plc-dialog-cancel').click()
  await page.locator('.plc-dialog').waitFor({ state: 'hidden' })
  expect(plc.cpu.state).toBe('RUN')
  await page.locator('.plc-cpu-stop').click()
  await page.locator('.plc-dialog-confirm').click()
  await eventually(
    'STOP in the PLC',
    () => plc.cpu.state,
    (state) => state === 'STOP',
  )
  await eventually('STOP on the page', head, (text) => text.includes('STOP'))
  await page.getByText('Remote STOP is done.').waitFor()
  await page.getByRole('button', { name: 'RELEASE' }).click()
  await page.locator('.plc-dialog-confirm').click()
  await eventually(
    'RUN in the PLC',
    () => plc.cpu.state,
    (state) => state === 'RUN',
  )
  await eventually('RUN on the page', head, (text) => text.includes('RUN'))
})

test('says so when the PLC refuses a write, and shows its value again', async () => {
  // As when somebody sets the write mode of the PLC to 0: nothing may be written.
  plc.cpu.writeMode = 0
  await input('settling-time').fill('700')
  await input('settling-time').press('Enter')
  await page.getByText('The PLC refused it.').waitFor()
  plc.cpu.writeMode = 1
  await eventually(
    'the value of the PLC',
    () => input('settling-time').inputValue(),
    (value) => value === '400',
  )
})

test('a PLC that has gone is offline, its values are grey, and nothing can be operated', async () => {
  await plc.close()
  const text = await eventually('the end of the connection', head, (shown) => shown.includes('Offline'))
  expect(text).not.toContain('RUN')
  await eventually('the reason', head, (shown) => /refused/.test(shown), 40_000)
  expect(await page.locator('.plc-stale').count()).toBeGreaterThan(0)
  await eventually(
    'disabled controls',
    () => operable(page),
    (controls) => controls.length === 0,
  )
})

test('a PLC that is back is connected again, and counts anew', async () => {
  plc = await startPlc(port)
  await eventually('the connection', head, (text) => text.includes('Connected'), 60_000)
  await eventually(
    'live values',
    () => page.locator('.plc-stale').count(),
    (count) => count === 0,
  )
  await allOperable()
  await eventually(
    'bottles of the new count',
    async () => Math.abs(Number(await figure('bottles')) - Number(plc.read('09000:UDINT'))),
    (difference) => difference <= 2,
  )
})

test('is as wide as a phone on a phone', async () => {
  const phone = await browser.openPage(`${red.dashboard}jw`, { viewport: { width: 390, height: 844 } })
  try {
    await widget(phone.page, 'jw-head').waitFor()
    expect(await phone.page.evaluate(() => document.scrollingElement?.scrollWidth ?? 0)).toBeLessThanOrEqual(390)
    expect(phone.problems).toEqual([])
  } finally {
    await phone.close()
  }
})

test('reports no problem to the browser', () => {
  expect(opened.problems).toEqual([])
})
